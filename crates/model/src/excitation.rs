//! The motion of the box, equations (1) and (9): `E(t) = sum A_k sin(W_k t + tau_k)`.

mod harmonic;

use std::cmp::Ordering;

use crate::error::{Error, within};
pub use harmonic::Harmonic;
use impact_pair_exact::{Exact, ExactError};

/// The displacement of the box: one harmonic or several. **Equations** (1), (9)
///
/// Terms that do not move the box are dropped, and terms with equal frequency and phase are added: the sums are
/// the [`harmonics`](Self::harmonics), the fastest first. With a single harmonic the motion is that of
/// equation (9) and costs no more.
///
/// ```
/// use impact_pair_model::{Excitation, Harmonic};
/// let term = |a: &str, w: &str| Harmonic::new(a.parse().unwrap(), w.parse().unwrap(), "0".parse().unwrap());
/// let square_wave = Excitation::new(vec![term("1", "pi")?, term("1/3", "3*pi")?, term("1/5", "5*pi")?])?;
/// assert_eq!(square_wave.reference().frequency().text(), "5*pi");
/// assert!(Excitation::new(vec![term("1/2", "pi")?, term("1/2", "pi")?])?.only().is_some());
/// # Ok::<(), impact_pair_model::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Excitation {
    terms: Vec<Harmonic>,
    harmonics: Vec<Harmonic>,
    /// Index of the first term of the fastest harmonic.
    fastest: usize,
}

impl Excitation {
    /// The sum of the given harmonics.
    ///
    /// # Errors
    /// If there is none, or a sum of amplitudes exceeds the range of exact expressions.
    pub fn new(terms: Vec<Harmonic>) -> Result<Self, Error> {
        let first = terms.first().ok_or_else(|| Error::scene("an excitation has at least one term".to_owned()))?;
        let (mut harmonics, mut numbers): (Vec<Harmonic>, Vec<usize>) = (Vec::new(), Vec::new());
        for (number, term) in terms.iter().enumerate() {
            let amplitude = term.amplitude();
            if amplitude.sign() == Some(Ordering::Equal) {
                continue;
            }
            match harmonics.iter_mut().find(|other| are_in_step(other, term)) {
                Some(other) => {
                    let sum = other.amplitude().checked_add(amplitude);
                    *other = other.with_amplitude(within("excitation.amplitude", amplitude, sum)?);
                }
                None => {
                    harmonics.push(term.clone());
                    numbers.push(number);
                }
            }
        }
        if harmonics.is_empty() {
            harmonics.push(first.clone());
            numbers.push(0);
        }
        let fastest = fastest(&harmonics);
        harmonics.swap(0, fastest);
        Ok(Self { terms, harmonics, fastest: numbers[fastest] })
    }

    /// The terms as given.
    pub fn terms(&self) -> &[Harmonic] {
        &self.terms
    }

    /// The distinct harmonics that move the box, the fastest first; a harmonic of zero amplitude if none moves the box.
    pub fn harmonics(&self) -> &[Harmonic] {
        &self.harmonics
    }

    /// The fastest harmonic: its period is the forcing period, and phases are its `W t + tau`.
    pub fn reference(&self) -> &Harmonic {
        &self.harmonics[0]
    }

    /// Index of the [reference](Self::reference) among the terms; the first of several terms with equal frequency and phase.
    pub fn reference_term(&self) -> usize {
        self.fastest
    }

    /// The harmonic, if there is only one.
    pub fn only(&self) -> Option<&Harmonic> {
        match self.harmonics.as_slice() {
            [only] => Some(only),
            _ => None,
        }
    }

    /// Index of the harmonic of a term that moves the box, and the total amplitude of the other terms in that harmonic, if
    /// any; `None` if intervals leave the harmonic undecided, or the amplitude exceeds the range of exact expressions.
    pub fn harmonic_of(&self, term: &Harmonic) -> Option<(usize, Option<Exact>)> {
        let number = match self.only() {
            Some(_) => 0,
            None => self.harmonics.iter().position(|harmonic| are_in_step(harmonic, term))?,
        };
        let others = self.harmonics[number].amplitude().checked_sub(term.amplitude()).ok()?;
        Some((number, (others.sign() != Some(Ordering::Equal)).then_some(others)))
    }

    /// Whether no parameter is an interval.
    pub fn is_point(&self) -> bool {
        self.terms.iter().all(Harmonic::is_point)
    }
}

impl From<Harmonic> for Excitation {
    fn from(harmonic: Harmonic) -> Self {
        Self { terms: vec![harmonic.clone()], harmonics: vec![harmonic], fastest: 0 }
    }
}

/// Whether two harmonics are proved to have one frequency, and phases that differ by a multiple of `2 pi`.
fn are_in_step(a: &Harmonic, b: &Harmonic) -> bool {
    let turns = || -> Result<Exact, ExactError> {
        let turn = Exact::pi() * Exact::from(2);
        a.phase().checked_sub(b.phase())?.checked_div(&turn)
    };
    // Two intervals with the same text need not have the same value.
    let are_points = [a.frequency(), b.frequency(), a.phase(), b.phase()].into_iter().all(Exact::is_point);
    are_points
        && a.frequency().compare(b.frequency()) == Some(Ordering::Equal)
        && turns().is_ok_and(|turns| turns.as_rational().is_some_and(|turns| turns.is_integer()))
}

/// Index of the harmonic of the highest frequency; intervals that overlap are compared by their middles.
fn fastest(harmonics: &[Harmonic]) -> usize {
    let middle = |harmonic: &Harmonic| harmonic.frequency().enclose(64).mid_rad().0;
    let faster = |a: &Harmonic, b: &Harmonic| match a.frequency().compare(b.frequency()) {
        Some(ordering) => ordering == Ordering::Greater,
        None => middle(a) > middle(b),
    };
    let mut best = 0;
    for (i, harmonic) in harmonics.iter().enumerate() {
        if faster(harmonic, &harmonics[best]) {
            best = i;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    fn harmonic(amplitude: &str, frequency: &str, phase: &str) -> Harmonic {
        let value = |text: &str| text.parse().unwrap();
        Harmonic::new(value(amplitude), value(frequency), value(phase)).unwrap()
    }

    #[test]
    fn equal_terms_are_one_and_terms_without_amplitude_are_none() {
        let halves =
            [harmonic("1/2", "2*pi", "pi/3"), harmonic("0.5", "6*pi/3", "pi/3 - 4*pi"), harmonic("0", "9", "1")];
        let sum = Excitation::new(halves.to_vec()).unwrap();
        assert_eq!(sum.terms().len(), 3);
        assert_eq!(sum.only().unwrap().amplitude().as_rational().unwrap().to_string(), "1");
        let still = Excitation::new(vec![harmonic("0", "1", "0"), harmonic("0", "2", "0")]).unwrap();
        assert_eq!(still.only().unwrap().frequency().text(), "1");
    }

    #[test]
    fn different_terms_stay_different_and_the_fastest_leads() {
        let terms = [harmonic("1", "1", "0"), harmonic("1", "sqrt(2)", "0"), harmonic("1", "1", "0.1")];
        let sum = Excitation::new(terms.to_vec()).unwrap();
        assert_eq!((sum.harmonics().len(), sum.reference().frequency().text().as_str()), (3, "sqrt(2)"));
        assert_eq!(sum.reference_term(), 1);
        let without =
            [harmonic("0", "3", "0"), harmonic("1", "1", "0"), harmonic("1", "2", "0"), harmonic("1", "2", "0")];
        assert_eq!(Excitation::new(without.to_vec()).unwrap().reference_term(), 2);
        let unknown = [harmonic("1", "[1, 2]", "0"), harmonic("1", "[1, 2]", "0")];
        assert!(Excitation::new(unknown.to_vec()).unwrap().only().is_none());
    }

    #[test]
    fn an_excitation_has_a_term() {
        assert!(Excitation::new(Vec::new()).is_err());
    }
}
