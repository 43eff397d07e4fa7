//! Periodic orbits of any word, proved: sections 3 and 4 of the paper.
//!
//! A [`Problem`] is a pair, a closed word and a number of cycles. Its unknowns are the phases of the impacts, its
//! equations Newton's impact law at each ([`legs`]); Newton's iteration in floating point approximates ([`newton`]), Krawczyk's
//! operator verifies ([`krawczyk`]), first in doubles and then at the requested precision. Then each flight is proved to
//! end at its first contact, and trace, determinant and eigenvalues of the period's Jacobian are enclosed (38).
//! [`Problem::find_all`] searches the whole state space, so that its list is complete. With several harmonics
//! with a common period ([`Problem::period`]) the same methods apply. Lemmas T1-T14, H10-H12 and H14 are in
//! `docs/proofs/periodic.md#T1`.

mod attractor;
mod basin;
pub mod bifurcation;
mod census;
pub mod chain;
mod chained;
pub(crate) mod document;
pub mod entries;
mod equations;
mod guess;
mod identity;
pub mod krawczyk;
pub mod legs;
mod measured;
pub mod newton;
mod orbit;
mod physical;
pub mod precondition;
mod prove;
mod quarters;
mod search;
mod several;
mod stability;
mod unshaken;

use std::sync::Arc;

use num_bigint::BigInt;

use crate::Error;
use crate::exact::log2_of_digits;
use crate::mapping::Word;
use crate::number::Ball;
use crate::number::interval::Interval;
use crate::pair::{ImpactPair, Reduced, Wall};
use crate::several::Spectrum;
pub use crate::shaken::shaking;
use crate::shaken::{Either, OneHarmonic, SeveralHarmonics, under};
use crate::watch::{Unwatched, Watch};
pub use attractor::Attractor;
pub(crate) use attractor::{MAX_PERIOD, find as find_attractor};
pub use basin::Basin;
pub use census::{Census, Region};
pub use chain::Chain;
use chained::Chained;
pub(crate) use identity::Identity;
use identity::{is_one_orbit, is_one_reduced};
use impact_pair_model::{MAX_BITS, Start};
pub use krawczyk::Proved;
pub use measured::MeasuredOrbit;
pub use orbit::{Finding, PeriodicImpact, PeriodicOrbit};
pub use search::Budget;
use several::repetition;
pub use stability::{Eigenvalue, Stability, determinant, eigenvalues, trace};

/// Requested widths of the enclosures of an orbit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Precision {
    /// Digits: enclosures are at most `10^-digits` wide, of phases in forcing periods, of velocities in `A W`.
    pub digits: u32,
    /// Greatest number of bits.
    pub max_bits: u32,
}

impl Default for Precision {
    fn default() -> Self {
        Self { digits: 9, max_bits: MAX_BITS }
    }
}

impl Precision {
    /// `log2` of the requested width: a hundredth of a digit is for printing.
    fn log2_width(self) -> f64 {
        -log2_of_digits(f64::from(self.digits) + 0.01)
    }
}

/// Digits that distinguish orbits, where the requested digits do not.
const FINE_DIGITS: u32 = 14;

/// Whether the excitation of a pair is proved to be periodic; without a common period of its harmonics no motion with impacts is.
///
/// # Errors
/// If a value is beyond the range of exact expressions.
pub fn has_common_period(pair: &ImpactPair) -> Result<bool, Error> {
    let spectrum = Spectrum::new(pair, &BigInt::ZERO)?;
    Ok(spectrum.is_none_or(|spectrum| spectrum.period.is_some()))
}

/// The problem of finding the periodic orbits of a word with a given number of forcing periods.
///
/// A cycle is a period of the fastest harmonic; with several harmonics an orbit takes whole common periods.
///
/// ```
/// use impact_pair::{Harmonic, ImpactPair};
/// use impact_pair::periodic::{Precision, Problem, Stability};
/// // The exact equispaced orbit of figure 12: d = 3 pi, v = -4 pi.
/// let harmonic = Harmonic::new("1".parse()?, "pi".parse()?, "0".parse()?)?;
/// let pair = ImpactPair::new(harmonic, "3*pi".parse()?, "0.5".parse()?)?;
/// let problem = Problem::new(&pair, &"P1 P2".parse()?, 1)?;
/// let orbit = problem.prove(&[0.01, 0.49], Precision::default()).expect("proved");
/// assert_eq!((orbit.physical, orbit.symmetric, orbit.stability), (Some(true), Some(true), Stability::Stable));
/// let (low, high) = orbit.impacts[1].phase.to_f64_bounds();
/// assert!(high - low < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Problem {
    impact_pair: ImpactPair,
    word: Word,
    chain: Chain,
    shaken: Either,
}

/// Excitation of a pair, and equations of a word that takes `cycles` forcing periods under that excitation.
fn of_word(pair: &ImpactPair, word: &Word, cycles: u32) -> Result<(Either, Chain), Error> {
    Ok(match SeveralHarmonics::new(pair, &BigInt::ZERO)? {
        None => (Either::One(Arc::new(OneHarmonic::of(pair)?)), Chain::new(word, cycles)?),
        Some(several) => {
            let chain = Chain::under(repetition(pair, &several.spectrum)?, word, cycles)?;
            (Either::Several(Arc::new(several)), chain)
        }
    })
}

impl Problem {
    /// The problem for `pair` with this word and this number of cycles.
    ///
    /// # Errors
    /// If the word is not closed, there is no cycle or too many of them, or `A/d` is beyond doubles. With several harmonics also if their
    /// frequencies are not proved to be commensurate, or the cycles are no multiple of the common period.
    pub fn new(pair: &ImpactPair, word: &Word, cycles: u32) -> Result<Self, Error> {
        let (shaken, chain) = of_word(pair, word, cycles)?;
        Ok(Self { impact_pair: pair.clone(), word: word.clone(), chain, shaken })
    }

    /// The pair.
    pub fn pair(&self) -> &ImpactPair {
        &self.impact_pair
    }

    /// The word.
    pub fn word(&self) -> &Word {
        &self.word
    }

    /// The equations.
    pub fn chain(&self) -> &Chain {
        &self.chain
    }

    /// The parameters in doubles; `None` with several harmonics.
    pub fn reduced(&self) -> Option<&Reduced<Ball>> {
        match &self.shaken {
            Either::One(one) => Some(&one.bounds_of_pair.pair),
            Either::Several(_) => None,
        }
    }

    /// The common period of all harmonics, in periods of the fastest: 1 for one harmonic.
    pub fn period(&self) -> u32 {
        self.chain.period()
    }

    /// Proves all the orbits that guesses lead to: from the motion of `start`, and from starts spread over the states.
    ///
    /// Each once, in the order of their first phases. It proves that these exist, not that there are no others.
    pub fn find(&self, start: &Start, precision: Precision) -> Census {
        self.find_while(start, precision, &Unwatched)
    }

    /// Finds orbits until the watch stops it, which is called between guesses.
    pub fn find_while(&self, start: &Start, precision: Precision, watch: &dyn Watch) -> Census {
        if let Some(census) = self.settled() {
            return census;
        }
        under!(&self.shaken, shaken => self.find_under(&**shaken, start, precision, watch))
    }

    fn find_under<S: Chained>(&self, shaken: &S, start: &Start, precision: Precision, watch: &dyn Watch) -> Census {
        let mut found: Vec<PeriodicOrbit> = Vec::new();
        let mut interrupted = false;
        for guess in guess::guesses(&self.chain, shaken, &self.impact_pair, start) {
            if !watch.goes_on() {
                interrupted = true;
                break;
            }
            if self.is_known(&guess, &found) || self.settles_on_known(shaken, &guess, &found) {
                continue;
            }
            if let Some((orbit, Identity::New)) = self.prove_beside(&guess, precision, found.iter()) {
                found.push(orbit);
            }
        }
        found.sort_by(|a, b| a.phases()[0].mid().total_cmp(&b.phases()[0].mid()));
        Census { orbits: found, interrupted, ..Census::default() }
    }

    /// Whether each orbit in a box of phases, impact by impact, is proved to be this one or its mirror image. Lemma T6
    pub(crate) fn is_all_of(&self, phases: &[Interval], orbit: &PeriodicOrbit) -> bool {
        let balls: Vec<Ball> = phases.iter().map(|&x| x.into()).collect();
        let whole = Proved { domain: balls.clone(), at: balls };
        is_one_reduced(&self.chain, &whole, &orbit.proved) == Some(true)
    }

    /// Whether two orbits are one, or mirror images; `None` if undecided. Lemma T6
    pub(crate) fn is_reduced(&self, one: &PeriodicOrbit, other: &PeriodicOrbit) -> Option<bool> {
        is_one_reduced(&self.chain, &one.proved, &other.proved)
    }

    /// Least number of impacts after which an orbit repeats itself or its mirror image; `None` if undecided. Lemma T6
    pub(crate) fn reduced_impacts(&self, orbit: &PeriodicOrbit) -> Option<usize> {
        identity::reduced_impacts(&self.chain, &orbit.proved)
    }

    /// Problem and phases of an orbit that repeats itself or its mirror image after `impacts` impacts: of one such round, or of two rounds where
    /// the walls are exchanged.
    pub(crate) fn least(&self, impacts: usize, orbit: &PeriodicOrbit) -> Option<(Self, Vec<Interval>)> {
        let (walls, count) = (self.chain.walls(), self.chain.impacts());
        let rounds = if walls[impacts % count] == walls[0] { 1 } else { 2 };
        let least = rounds * impacts;
        let text: String = walls[..least].iter().map(|wall| if *wall == Wall::Left { 'L' } else { 'R' }).collect();
        let cycles = self.chain.cycles() as usize * least / count; // exact: a divisor
        let problem = Self::new(&self.impact_pair, &text.parse().ok()?, u32::try_from(cycles).ok()?).ok()?;
        let phases = orbit.proved.at[..least].iter().map(|&phase| Interval::from(phase)).collect();
        Some((problem, phases))
    }

    /// Proves the orbit near a guess, and whether it is known: orbits that the requested digits do not distinguish are proved to more. Lemma T6
    fn prove_beside<'o>(
        &self,
        guess: &[f64],
        precision: Precision,
        known: impl Iterator<Item = &'o PeriodicOrbit> + Clone,
    ) -> Option<(PeriodicOrbit, Identity)> {
        self.prove_beside_by(guess, precision, known, is_one_orbit)
    }

    /// As `prove_beside`, but an orbit and its mirror image count as one.
    pub(crate) fn prove_reduced<'o>(
        &self,
        guess: &[f64],
        precision: Precision,
        known: impl Iterator<Item = &'o PeriodicOrbit> + Clone,
    ) -> Option<(PeriodicOrbit, Identity)> {
        self.prove_beside_by(guess, precision, known, is_one_reduced)
    }

    fn prove_beside_by<'o>(
        &self,
        guess: &[f64],
        precision: Precision,
        known: impl Iterator<Item = &'o PeriodicOrbit> + Clone,
        is_one: impl Fn(&Chain, &Proved<Ball>, &Proved<Ball>) -> Option<bool>,
    ) -> Option<(PeriodicOrbit, Identity)> {
        let mut found = None;
        for digits in [precision.digits, FINE_DIGITS, 2 * FINE_DIGITS] {
            let digits = digits.max(precision.digits); // proposes: digits to prove it to
            let orbit = self.prove(guess, Precision { digits, ..precision })?;
            let verdicts = known.clone().map(|other| is_one(&self.chain, &orbit.proved, &other.proved));
            let identity = Identity::of(verdicts);
            found = Some((orbit, identity));
            if identity != Identity::Open {
                break;
            }
        }
        found
    }

    /// Whether a guess lies where a known orbit is the only one.
    fn is_known(&self, guess: &[f64], found: &[PeriodicOrbit]) -> bool {
        let point: Vec<Ball> = guess.iter().map(|&x| Ball::exact(x)).collect();
        let point = Proved { domain: point.clone(), at: point };
        found.iter().any(|known| is_one_orbit(&self.chain, &point, &known.proved) == Some(true))
    }
}
