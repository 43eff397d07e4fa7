//! The proof of one orbit: floating point approximates, doubles prove, more bits where those do not suffice. Lemmas T3-T5

mod precise;

use super::chained::Chained;
use super::equations::Orbits;
use super::krawczyk::{self, Limits, MAX_RADIUS};
use super::legs::Legs;
use super::newton;
use super::orbit::{Finding, PeriodicOrbit};
use super::precondition::Preconditioner;
use super::shaking::Shaking;
use super::{Precision, Problem};
use crate::number::{Ball, Enclosing};
use crate::shaken::{Parameters, under};

/// Images that may take less than a quarter of a bit off an orbit's enclosure: near a bifurcation the first ones do.
const MAX_SLOW_IMAGES: u32 = 64;
/// Limits of the proof of an orbit in `bits` bits.
fn limits(bits: u32) -> Limits {
    // Radii from 2^-5 in steps of 2^-3, down to eight bits above the last one.
    let domains = (bits - 8).min(1000).saturating_sub(5) / 3 + 1; // proposes: which domains are tried
    // Four images that are not slow take a bit.
    Limits { largest: MAX_RADIUS, domains, images: MAX_SLOW_IMAGES + 4 * bits, slow: MAX_SLOW_IMAGES }
}

impl Problem {
    /// Proves the orbit near these phases (in forcing periods, in time order) in doubles. Lemmas T3-T5
    ///
    /// `None` where the orbit is not proved.
    pub fn prove_in_doubles(&self, guess: &[f64]) -> Option<Finding<Ball>> {
        under!(&self.shaken, shaken => self.prove_in_balls(&**shaken, guess))
    }

    fn prove_in_balls<S: Chained>(&self, shaken: &S, guess: &[f64]) -> Option<Finding<Ball>> {
        let inverse = newton::precondition(&self.chain, shaken.floats(), guess)?;
        let guess: Vec<Ball> = guess.iter().map(|&x| Ball::exact(x)).collect();
        self.attempt(shaken.balls(), &inverse, &guess, f64::MANTISSA_DIGITS, |phases, legs| {
            let is_physical = shaken.is_physical(&self.chain, phases, legs);
            is_physical.or_else(|| shaken.is_physical_at_quarters(&self.chain, phases))
        })
    }

    /// Proves an orbit and its properties in an arithmetic of `bits` bits.
    fn attempt<N: Enclosing, B: Shaking<N>>(
        &self,
        shaking: &B,
        inverse: &Preconditioner,
        guess: &[N],
        bits: u32,
        is_physical: impl FnOnce(&[N], &Legs<N, B::Moment>) -> Option<bool>,
    ) -> Option<Finding<N>> {
        let orbits = Orbits { chain: &self.chain, shaking };
        let proved = krawczyk::prove(&orbits, inverse, guess, limits(bits))?;
        Finding::new(&self.chain, shaking, proved, is_physical)
    }

    /// Phases nearer to an orbit's, by Newton's iteration in floating point.
    pub(super) fn polished(&self, guess: &[f64]) -> Option<Vec<f64>> {
        under!(&self.shaken, shaken => newton::polish(&self.chain, shaken.floats(), guess.to_vec()))
    }

    /// Proves the orbit near these phases (in forcing periods, in time order), to the requested width.
    ///
    /// In doubles first; in more and more bits where doubles do not prove, decide or narrow enough. `None` where no orbit could be proved, or
    /// the number of phases is not the word's number of impacts. An orbit may be wider than requested, if the allowed bits end or parameters are
    /// intervals.
    pub fn prove(&self, guess: &[f64], precision: Precision) -> Option<PeriodicOrbit> {
        if guess.len() != self.chain.impacts() {
            return None;
        }
        under!(&self.shaken, shaken => self.prove_under(&**shaken, guess, precision))
    }

    fn prove_under<S: Chained>(&self, shaken: &S, guess: &[f64], precision: Precision) -> Option<PeriodicOrbit> {
        let guess = self.polished(guess)?;
        let finding = self.prove_in_balls(shaken, &guess);
        let is_narrow = finding.as_ref().is_some_and(|finding| is_narrow(shaken, finding, precision));
        let best = finding.and_then(|finding| {
            finding.finish(&self.chain, self.impact_pair.restitution(), f64::MANTISSA_DIGITS, is_narrow)
        });
        match best {
            Some(orbit) if is_narrow && orbit.is_decided() => Some(orbit),
            best => self.prove_precisely(shaken, &guess, precision, is_narrow, best),
        }
    }
}

/// Whether the widths are at most the requested ones.
fn is_narrow<N: Enclosing>(shaken: &impl Chained, finding: &Finding<N>, precision: Precision) -> bool {
    let requested = precision.log2_width();
    let speed = shaken.speed().log2();
    let [phase, velocity] = finding.widths();
    phase <= requested && velocity <= requested + if speed.is_finite() { speed } else { 0.0 }
}
