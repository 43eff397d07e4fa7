//! The proof of one orbit: floating point approximates, doubles prove, more bits where those do not suffice. Lemmas T3-T5

use super::chain::Legs;
use super::chained::Chained;
use super::equations::Orbits;
use super::krawczyk::{self, Effort, LARGEST};
use super::newton;
use super::orbit::{Finding, PeriodicOrbit};
use super::precondition::Preconditioner;
use super::shaking::Shaking;
use super::{Precision, Problem};
#[cfg(feature = "multiprecision")]
use crate::exact::working_bits;
#[cfg(feature = "multiprecision")]
use crate::number::MpBall;
use crate::number::{Ball, Enclosing};
use crate::shaken::{Parameters, under};

/// Images that may take less than a quarter of a bit off an orbit's enclosure: near a bifurcation the first ones do.
const MOST_SLOW: u32 = 64;
/// Bits that what is not about widths (stability, first contacts) is tried with at most.
#[cfg(feature = "multiprecision")]
const DECIDING_BITS: u32 = 1024;

/// What an orbit is worth in N bits.
fn effort(bits: u32) -> Effort {
    // Radii from 2^-5 in steps of 2^-3, down to eight bits above the last one.
    let domains = (bits - 8).min(1000).saturating_sub(5) / 3 + 1; // proposes: which domains are tried
    // Four images that are not slow take a bit.
    Effort { largest: LARGEST, domains, images: MOST_SLOW + 4 * bits, slow: MOST_SLOW }
}

impl Problem {
    /// Proves the orbit near these phases (in forcing periods, in time order) in doubles. Lemmas T3-T5
    ///
    /// `None` where that is not proved.
    pub fn prove_in_doubles(&self, guess: &[f64]) -> Option<Finding<Ball>> {
        under!(&self.shaken, shaken => self.prove_in_balls(&**shaken, guess))
    }

    fn prove_in_balls<S: Chained>(&self, shaken: &S, guess: &[f64]) -> Option<Finding<Ball>> {
        let inverse = newton::precondition(&self.chain, shaken.floats(), guess)?;
        let guess: Vec<Ball> = guess.iter().map(|&x| Ball::exact(x)).collect();
        self.attempt(shaken.balls(), &inverse, &guess, f64::MANTISSA_DIGITS, |phases, legs| {
            shaken.is_physical(&self.chain, phases, legs)
        })
    }

    /// Proves an orbit and all that follows in an arithmetic of N bits.
    fn attempt<N: Enclosing, B: Shaking<N>>(
        &self,
        shaking: &B,
        inverse: &Preconditioner,
        guess: &[N],
        bits: u32,
        is_physical: impl FnOnce(&[N], &Legs<N, B::Moment>) -> Option<bool>,
    ) -> Option<Finding<N>> {
        let orbits = Orbits { chain: &self.chain, shaking };
        let proved = krawczyk::prove(&orbits, inverse, guess, effort(bits))?;
        Finding::new(&self.chain, shaking, proved, is_physical)
    }

    /// Phases nearer to an orbit's, by Newton's iteration in floating point.
    pub(super) fn polished(&self, guess: &[f64]) -> Option<Vec<f64>> {
        under!(&self.shaken, shaken => newton::polish(&self.chain, shaken.floats(), guess.to_vec()))
    }

    /// Proves the orbit near these phases (in forcing periods, in time order), to the requested width.
    ///
    /// In doubles first; in more and more bits where they do not prove, decide or narrow enough. `None` where no orbit
    /// could be proved; an orbit may be wider than requested, if the allowed bits end or parameters are intervals.
    pub fn prove(&self, guess: &[f64], precision: Precision) -> Option<PeriodicOrbit> {
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
            Some(orbit) if is_narrow && orbit.is_settled() => Some(orbit),
            best => self.prove_precisely(shaken, &guess, precision, is_narrow, best),
        }
    }

    /// The same in balls of rising precision; what is known already is `best`.
    #[cfg(feature = "multiprecision")]
    fn prove_precisely<S: Chained>(
        &self,
        shaken: &S,
        guess: &[f64],
        precision: Precision,
        mut narrow: bool,
        mut best: Option<PeriodicOrbit>,
    ) -> Option<PeriodicOrbit> {
        let inverse = newton::precondition(&self.chain, shaken.floats(), guess)?;
        let wanted = working_bits(precision.digits);
        let mut last = f64::INFINITY;
        let mut bits = if narrow { 128 } else { wanted.max(128) }; // proposes
        while bits <= precision.max_bits && (bits <= DECIDING_BITS || (best.is_some() && !narrow)) {
            let shaking = shaken.precise(bits);
            let guess = self.polish_precisely(&shaking, &inverse, guess, bits, bits / krawczyk::GAINED);
            let finding = self.attempt(&shaking, &inverse, &guess, bits, |phases, legs| {
                shaken.is_physical_precisely(&shaking, &self.chain, phases, legs)
            });
            if let Some(finding) = finding {
                let [phase, _] = finding.widths();
                narrow = is_narrow(shaken, &finding, precision);
                // Where more bits do not narrow, still more will not.
                if phase >= last {
                    break;
                }
                last = phase;
                best = finding.finish(&self.chain, self.impact_pair.restitution(), bits, narrow).or(best);
                if narrow && best.as_ref().is_some_and(PeriodicOrbit::is_settled) {
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
    fn prove_precisely<S: Chained>(
        &self,
        _: &S,
        _: &[f64],
        _: Precision,
        _: bool,
        best: Option<PeriodicOrbit>,
    ) -> Option<PeriodicOrbit> {
        best
    }

    /// Whether a guess, polished in more than doubles, lies where a known orbit is the only one: asked where an orbit is known
    /// that doubles did not prove, near a bifurcation, to which Newton's iteration in floating point comes no nearer than to many points.
    #[cfg(feature = "multiprecision")]
    pub(super) fn settles_on_known<S: Chained>(&self, shaken: &S, guess: &[f64], known: &[PeriodicOrbit]) -> bool {
        const BITS: u32 = 128;
        let is_precise = known.iter().any(|orbit| orbit.bits > f64::MANTISSA_DIGITS);
        let settled = || {
            let guess = self.polished(guess)?;
            let inverse = newton::precondition(&self.chain, shaken.floats(), &guess)?;
            // Near a bifurcation a step adds a few bits.
            let settled = self.polish_precisely(&shaken.precise(BITS), &inverse, &guess, BITS, BITS / 8);
            Some(settled.iter().map(|x| x.as_ball().mid()).collect::<Vec<f64>>())
        };
        is_precise && settled().is_some_and(|guess| self.is_known(&guess, known))
    }

    /// Doubles are all there is.
    #[cfg(not(feature = "multiprecision"))]
    pub(super) fn settles_on_known<S: Chained>(&self, _: &S, _: &[f64], _: &[PeriodicOrbit]) -> bool {
        false
    }

    /// A guess in N bits after some steps; nothing is proved.
    #[cfg(feature = "multiprecision")]
    fn polish_precisely<B: Shaking<MpBall>>(
        &self,
        shaking: &B,
        inverse: &Preconditioner,
        guess: &[f64],
        bits: u32,
        steps: u32,
    ) -> Vec<MpBall> {
        let guess = guess.iter().map(|&x| MpBall::from_f64_bits(x, bits)).collect();
        krawczyk::polish(&Orbits { chain: &self.chain, shaking }, inverse, guess, steps)
    }
}

/// Whether the widths are those requested.
fn is_narrow<N: Enclosing>(shaken: &impl Chained, finding: &Finding<N>, precision: Precision) -> bool {
    let asked = precision.log2_width();
    let speed = shaken.speed().log2();
    let [phase, velocity] = finding.widths();
    phase <= asked && velocity <= asked + if speed.is_finite() { speed } else { 0.0 }
}
