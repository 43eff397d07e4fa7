//! Several harmonics without units, exactly.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, ToPrimitive};

use crate::Error;
use crate::exact::{Exact, ExactError};
use crate::excitation::Harmonic;
use crate::pair::{ImpactPair, Reduced, within};
use crate::units::{Phases, in_gaps, turn};

/// The harmonics of a pair, time in periods of the fastest and length in gaps.
///
/// At the phase `u` of the fastest (`W t + tau = 2 pi u`) the phase of harmonic `k` is `ratio u + shift`, in periods of harmonic `k`.
#[derive(Clone, Debug)]
pub(crate) struct Spectrum {
    pub terms: Vec<Term>,
    pub restitution: Exact,
    /// Forcing periods after which all phases are the same, when the frequencies are proved to be commensurate.
    pub period: Option<u64>,
}

/// One harmonic.
#[derive(Clone, Debug)]
pub(crate) struct Term {
    /// `A_k / d`
    pub alpha: Exact,
    /// `W_k / W`
    pub ratio: Exact,
    /// The phase at `u = 0`, in periods.
    pub shift: Exact,
}

impl Spectrum {
    /// The harmonics of `pair`, phases counted from the forcing period `origin`; `None` of a single one.
    ///
    /// # Errors
    /// If a value is beyond the range of exact expressions.
    pub fn new(pair: &ImpactPair, origin: &BigInt) -> Result<Option<Self>, Error> {
        let excitation = pair.excitation();
        if excitation.only().is_some() {
            return Ok(None);
        }
        let fastest = excitation.reference();
        let own = Phases::of(fastest)?.shift;
        let mut common = Some(BigInt::one());
        let mut terms = Vec::new();
        for harmonic in excitation.harmonics() {
            let fraction = harmonic.frequency().fraction_of(fastest.frequency());
            common = common.zip(fraction.as_ref()).map(|(common, fraction)| common.lcm(fraction.denom()));
            let ratio = match fraction {
                Some(fraction) => Exact::from_rational(fraction),
                None => {
                    let frequency = harmonic.frequency();
                    within("excitation.frequency", frequency, frequency.checked_div(fastest.frequency()))?
                }
            };
            let phases = Phases::of(harmonic)?;
            let shift = || -> Result<Exact, ExactError> {
                let before = own.checked_sub(&Exact::from(origin.clone()))?;
                whole_turns_off(phases.shift.checked_sub(&ratio.checked_mul(&before)?)?)
            };
            let shift = within("excitation.phase", harmonic.phase(), shift())?;
            let alpha = in_gaps("excitation.amplitude", harmonic.amplitude(), pair)?;
            terms.push(Term { alpha, ratio, shift });
        }
        let period = common.and_then(|common| common.to_u64());
        Ok(Some(Self { terms, restitution: pair.restitution().clone(), period }))
    }

    /// Whether each harmonic is its own opposite half a common period later. `None` without a common period. Also `None` if an amplitude may be
    /// 0, or harmonics of one frequency may cancel, and only the other harmonics may be odd. Lemma T6
    pub fn is_odd(&self) -> Option<bool> {
        let period = BigInt::from(self.period?);
        let is_odd = |term: &Term| {
            let turns = term.ratio.as_rational().map(|ratio| ratio * &period);
            turns.is_some_and(|turns| turns.is_integer() && turns.numer().is_odd())
        };
        let is_alone = |term: &Term| {
            self.terms.iter().filter(|other| other.ratio.as_rational() == term.ratio.as_rational()).count() == 1
        };
        let may_vanish = |term: &Term| term.alpha.sign() != Some(Ordering::Greater) || !is_alone(term);
        let is_known = self.terms.iter().all(is_odd) || !self.terms.iter().any(may_vanish);
        is_known.then(|| self.terms.iter().all(is_odd))
    }

    /// Bounds of the motion without units: the sums of `A_k/d` and of `2 pi A_k W_k / (d W)`.
    ///
    /// # Errors
    /// If a sum is beyond the range of exact expressions.
    pub fn sums(&self) -> Result<Reduced<Exact>, ExactError> {
        let zero = Exact::from(0);
        let sum = |of: &dyn Fn(&Term) -> Result<Exact, ExactError>| {
            self.terms.iter().try_fold(zero.clone(), |sum, term| sum.checked_add(&of(term)?))
        };
        Ok(Reduced {
            alpha: sum(&|term| Ok(term.alpha.clone()))?,
            beta: sum(&|term| term.alpha.checked_mul(&term.ratio)?.checked_mul(&turn()))?,
            restitution: self.restitution.clone(),
        })
    }
}

/// The phases of all harmonics of `pair` at a time, in periods, less whole ones: exact where expressions show it.
///
/// # Errors
/// If a phase is beyond the range of exact expressions.
pub(crate) fn phases_at(pair: &ImpactPair, time: &Exact) -> Result<Vec<Exact>, Error> {
    let phase = |harmonic: &Harmonic| {
        let phase = Phases::of(harmonic)?.at(time);
        within("start.time", time, phase.and_then(whole_turns_off))
    };
    pair.excitation().harmonics().iter().map(phase).collect()
}

/// Bits of the whole forcing periods of a phase: with as many bits more its fraction is enclosed as finely as a phase below 1.
fn whole_bits(phase: &Exact) -> u32 {
    let top = phase.enclose(64).mag().top();
    top.and_then(|top| u32::try_from(top).ok()).unwrap_or(0) // X1: any number of bits encloses
}

/// The phase less whole forcing periods: within 2 of 0 (Lemma H1).
fn whole_turns_off(phase: Exact) -> Result<Exact, ExactError> {
    let near = match phase.as_rational() {
        Some(fraction) => fraction.round().to_integer(), // exact: any whole number is taken off
        // exact: any whole number is taken off
        None => phase.enclose(160 + whole_bits(&phase)).inf().to_rational().round().to_integer(),
    };
    phase.checked_sub(&Exact::from(near))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::{exact, pair_of};

    fn spectrum(frequencies: &[&str]) -> Spectrum {
        let terms: Vec<[&str; 3]> = frequencies.iter().map(|w| ["2", w, "pi/3"]).collect();
        Spectrum::new(&pair_of(&terms, "4", "0.5"), &BigInt::from(7)).unwrap().unwrap()
    }

    #[test]
    fn commensurate_frequencies_have_a_period_in_periods_of_the_fastest() {
        assert_eq!(spectrum(&["pi", "3*pi"]).period, Some(3));
        assert_eq!(spectrum(&["2*sqrt(2)", "3*sqrt(2)", "sqrt(2)/5"]).period, Some(15));
        assert_eq!(spectrum(&["1", "sqrt(2)"]).period, None);
        let is_odd = [&["pi", "3*pi"][..], &["1", "2"], &["3", "5", "15"], &["6", "10"]].map(|w| spectrum(w).is_odd());
        assert_eq!(is_odd, [Some(true), Some(false), Some(true), Some(true)]);
        assert_eq!(spectrum(&["1", "sqrt(2)"]).is_odd(), None);
    }

    /// Three harmonics of one frequency, a third of a period apart, cancel: what is left may have a mirror that all together have not.
    #[test]
    fn r44_harmonics_of_one_frequency_may_cancel() {
        let of = |terms: &[(&str, &str)]| {
            let terms: Vec<[&str; 3]> = terms.iter().map(|(w, tau)| ["2", w, tau]).collect();
            Spectrum::new(&pair_of(&terms, "4", "0.5"), &BigInt::from(7)).unwrap().unwrap().is_odd()
        };
        assert_eq!(of(&[("1", "0"), ("2", "0"), ("2", "2*pi/3"), ("2", "4*pi/3")]), None);
        assert_eq!(of(&[("2", "0"), ("1", "0"), ("1", "pi")]), None);
        // As far as all are odd nothing is left that is not.
        assert_eq!(of(&[("1", "0"), ("3", "0"), ("3", "pi")]), Some(true));
    }

    #[test]
    fn phases_are_those_of_equation_1() {
        let pair = pair_of(&[["2", "pi", "pi/3"], ["2", "3*pi", "pi/3"]], "4", "0.5");
        let spectrum = Spectrum::new(&pair, &BigInt::from(7)).unwrap().unwrap();
        // In forcing period 7 of 3 pi with tau = pi/3 the time is (7 - 1/6) 2/3, and pi t + pi/3 is 2 pi (7/3 + 1/9).
        let phases = phases_at(&pair, &exact("(7 - 1/6)*2/3")).unwrap();
        let texts = |x: &[Exact]| x.iter().map(|x| x.as_rational().unwrap().to_string()).collect::<Vec<_>>();
        assert_eq!(texts(&phases), ["0", "4/9"]);
        assert_eq!(texts(&spectrum.terms.iter().map(|term| term.shift.clone()).collect::<Vec<_>>()), ["0", "4/9"]);
    }
}
