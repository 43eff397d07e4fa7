//! Periodic orbits of any word, proved: sections 3 and 4 of the paper.
//!
//! A [`Problem`] is a pair, a closed word and a number of cycles. Its unknowns are the phases of the impacts, its
//! equations the impact law at each ([`chain`]); Newton's iteration in floats proposes ([`newton`]), Krawczyk's operator
//! disposes ([`krawczyk`]), in doubles first and in as many bits as asked after that. Then each flight is proved to
//! end at its first contact, and trace, determinant and eigenvalues of the period's Jacobian are enclosed (38).
//! [`Problem::find_all`] searches the whole state space, so that what it lists is all there is. Lemmas T1-T9 are in
//! `docs/proofs.md`.

mod attractor;
mod basin;
pub mod bifurcation;
mod census;
pub mod chain;
mod guess;
mod identity;
pub mod krawczyk;
pub mod newton;
mod orbit;
mod physical;
pub mod precondition;
mod search;
mod stability;

use crate::contact::Margins;
use crate::error::Error;
use crate::exact::Exact;
use crate::mapping::Word;
#[cfg(feature = "multiprecision")]
use crate::number::MpBall;
use crate::number::{Ball, Enclosing};
use crate::orbit::{MAX_BITS, Start};
use crate::pair::{ImpactPair, Reduced};
pub use attractor::{Attractor, Passing};
pub(crate) use attractor::{LONGEST, find as find_attractor};
pub use basin::Basin;
pub use census::{Census, Region};
pub use chain::Chain;
use identity::is_one_orbit;
pub use krawczyk::Proved;
pub use orbit::{Finding, PeriodicImpact, PeriodicOrbit};
use physical::Court;
use precondition::Preconditioner;
pub use search::Budget;
pub use stability::{Eigenvalue, Stability, determinant, eigenvalues, trace};

/// How narrow the enclosures of an orbit are asked to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Precision {
    /// At most `10^-digits` wide: phases in turns, velocities in `A W`.
    pub digits: u32,
    /// Bits to take at most.
    pub max_bits: u32,
}

impl Default for Precision {
    fn default() -> Self {
        Self { digits: 9, max_bits: MAX_BITS }
    }
}

/// The smallest radius of a domain that is tried in doubles.
const LEAST_DOMAIN: f64 = 1.0 / (1_u64 << 46) as f64;
/// Bits that what is not about widths (stability, first contacts) is tried with at most.
#[cfg(feature = "multiprecision")]
const DECIDING_BITS: u32 = 1024;

/// The periodic orbits of a word in so many cycles, as a question.
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
    word: Word,
    chain: Chain,
    exact: Reduced<Exact>,
    court: Court,
    /// No interval among the parameters: more precision narrows.
    #[cfg(feature = "multiprecision")]
    is_point: bool,
}

impl Problem {
    /// The orbits of `pair` with this word and so many cycles.
    ///
    /// # Errors
    /// When the word is not closed, there is no cycle or too many of them, or `A/d` is beyond doubles.
    pub fn new(pair: &ImpactPair, word: &Word, cycles: u32) -> Result<Self, Error> {
        Self::of(pair.exact()?, pair.reduced()?, word, cycles)
    }

    /// The same of a pair that is known reduced.
    pub(crate) fn of(exact: Reduced<Exact>, reduced: Reduced<Ball>, word: &Word, cycles: u32) -> Result<Self, Error> {
        let court = Court { pair: reduced, centre: reduced.centre(), margins: Margins::new(&reduced) };
        let chain = Chain::new(word, cycles)?;
        Ok(Self {
            word: word.clone(),
            chain,
            #[cfg(feature = "multiprecision")]
            is_point: [&exact.alpha, &exact.restitution].iter().all(|x| x.is_point()),
            exact,
            court,
        })
    }

    /// The word.
    pub fn word(&self) -> &Word {
        &self.word
    }

    /// The equations.
    pub fn chain(&self) -> &Chain {
        &self.chain
    }

    /// The parameters in doubles.
    pub fn reduced(&self) -> &Reduced<Ball> {
        &self.court.pair
    }

    /// Proves the orbit near these phases (in turns, in time order) in doubles. Lemmas T3-T5
    ///
    /// `None` where that is not proved.
    pub fn prove_in_doubles(&self, guess: &[f64]) -> Option<Finding<Ball>> {
        let inverse = newton::precondition(&self.chain, &self.court.centre, guess)?;
        let guess: Vec<Ball> = guess.iter().map(|&x| Ball::exact(x)).collect();
        self.attempt(&self.court.pair, &inverse, &guess, LEAST_DOMAIN, |phases, legs| {
            physical::is_physical(&self.court, &self.chain, phases, legs)
        })
    }

    /// Proves an orbit and all that follows in one arithmetic.
    fn attempt<N: Enclosing>(
        &self,
        pair: &Reduced<N>,
        inverse: &Preconditioner,
        guess: &[N],
        least: f64,
        is_physical: impl FnOnce(&[N], &chain::Legs<N>) -> Option<bool>,
    ) -> Option<Finding<N>> {
        let mut proved = krawczyk::prove(&self.chain, pair, inverse, guess, least)?;
        krawczyk::refine(&self.chain, pair, inverse, &mut proved);
        Finding::new(&self.chain, pair, proved, is_physical)
    }

    /// Proves the orbit near these phases (in turns, in time order), as narrowly as asked.
    ///
    /// In doubles first; in more and more bits where they do not prove, decide or narrow enough. `None` where no orbit
    /// could be proved; one that is may be wider than asked, where the bits allowed end or parameters are intervals.
    pub fn prove(&self, guess: &[f64], precision: Precision) -> Option<PeriodicOrbit> {
        let guess = newton::polish(&self.chain, &self.court.centre, guess.to_vec())?;
        let finding = self.prove_in_doubles(&guess);
        let is_narrow = finding.as_ref().is_some_and(|finding| self.is_narrow(finding, precision));
        let best = finding
            .and_then(|finding| finding.finish(&self.chain, &self.exact.restitution, f64::MANTISSA_DIGITS, is_narrow));
        match best {
            Some(orbit) if is_narrow && orbit.is_decided() => Some(orbit),
            best => self.prove_precisely(&guess, precision, is_narrow, best),
        }
    }

    /// Whether the widths are those asked for.
    fn is_narrow<N: Enclosing>(&self, finding: &Finding<N>, precision: Precision) -> bool {
        // A hundredth of a digit for printing.
        let asked = -(f64::from(precision.digits) + 0.01) * 10f64.log2();
        let speed = self.court.centre.beta.log2();
        let [phase, velocity] = finding.widths();
        phase <= asked && velocity <= asked + if speed.is_finite() { speed } else { 0.0 }
    }

    /// The same in balls of rising precision; what is known already is `best`.
    #[cfg(feature = "multiprecision")]
    fn prove_precisely(
        &self,
        guess: &[f64],
        precision: Precision,
        mut is_narrow: bool,
        mut best: Option<PeriodicOrbit>,
    ) -> Option<PeriodicOrbit> {
        let inverse = newton::precondition(&self.chain, &self.court.centre, guess)?;
        let wanted = (f64::from(precision.digits) * 10f64.log2()) as u32 + 64;
        let mut last = f64::INFINITY;
        let mut bits = if is_narrow { 128 } else { wanted.max(128) };
        while bits <= precision.max_bits && (bits <= DECIDING_BITS || (best.is_some() && !is_narrow)) {
            let pair = self.exact.map(|x| MpBall::enclosing(&x.enclose(bits + 8), bits));
            let guess = self.polish_precisely(&pair, &inverse, guess, bits);
            let least = 2f64.powi(-((bits - 8).min(1000) as i32));
            let finding = self.attempt(&pair, &inverse, &guess, least, |phases, legs| {
                physical::is_physical_precisely(&self.court, &pair, &self.chain, phases, legs)
            });
            if let Some(finding) = finding {
                let [phase, _] = finding.widths();
                is_narrow = self.is_narrow(&finding, precision);
                // Where more bits do not narrow, still more will not.
                if phase >= last {
                    break;
                }
                last = phase;
                best = finding.finish(&self.chain, &self.exact.restitution, bits, is_narrow).or(best);
                if is_narrow && best.as_ref().is_some_and(PeriodicOrbit::is_decided) {
                    break;
                }
            }
            // No precision narrows what intervals among the parameters leave open.
            if !self.is_point {
                break;
            }
            bits *= 2;
        }
        best
    }

    /// Doubles are all there is.
    #[cfg(not(feature = "multiprecision"))]
    fn prove_precisely(&self, _: &[f64], _: Precision, _: bool, best: Option<PeriodicOrbit>) -> Option<PeriodicOrbit> {
        best
    }

    /// A guess in so many bits, by simplified Newton steps; nothing is proved.
    #[cfg(feature = "multiprecision")]
    fn polish_precisely(
        &self,
        pair: &Reduced<MpBall>,
        inverse: &Preconditioner,
        guess: &[f64],
        bits: u32,
    ) -> Vec<MpBall> {
        let mut phases: Vec<MpBall> = guess.iter().map(|&x| MpBall::from_f64_bits(x, bits)).collect();
        // Each step in doubles adds some forty bits.
        for _ in 0..bits / 32 {
            match krawczyk::image(&self.chain, pair, inverse, &phases) {
                Some(next) => phases = next.iter().map(Enclosing::centre).collect(),
                None => break,
            }
        }
        phases
    }

    /// Proves all the orbits that guesses lead to: from the motion of `start`, and from starts spread over the states.
    ///
    /// Each once, in the order of their first phases. It proves that these exist, not that there are no others.
    pub fn find(&self, pair: &ImpactPair, start: &Start, precision: Precision) -> Census {
        if !self.chain.crosses() {
            // Lemma T7: on one wall there is none.
            return Census { exhaustive: true, is_search: true, ..Census::default() };
        }
        let mut found: Vec<PeriodicOrbit> = Vec::new();
        for guess in guess::guesses(&self.chain, &self.court.centre, pair, start) {
            if self.is_known(&guess, &found) {
                continue;
            }
            if let Some(orbit) = self.prove(&guess, precision) {
                let is_new =
                    |known: &PeriodicOrbit| is_one_orbit(&self.chain, &orbit.proved, &known.proved) != Some(true);
                if found.iter().all(is_new) {
                    found.push(orbit);
                }
            }
        }
        found.sort_by(|a, b| a.proved.phases[0].mid().total_cmp(&b.proved.phases[0].mid()));
        Census { orbits: found, ..Census::default() }
    }

    /// Whether a guess lies where a known orbit is the only one.
    fn is_known(&self, guess: &[f64], found: &[PeriodicOrbit]) -> bool {
        let point: Vec<Ball> = guess.iter().map(|&x| Ball::exact(x)).collect();
        let point = Proved { domain: point.clone(), phases: point };
        found.iter().any(|known| is_one_orbit(&self.chain, &point, &known.proved) == Some(true))
    }
}
