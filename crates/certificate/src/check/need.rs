//! Bits that an orbit takes: an error at its start grows along the claimed impacts, up to bounds that still have to hold it.
//!
//! Labels: proposes throughout.

use super::frame::{ClaimedImpact, Frame};
use crate::Certificate;
use crate::attraction::Bounds;
use impact_pair_exact::Real;
use num_bigint::BigInt;

/// Bits beyond those of the growth: for the errors of the first impacts, which are rounded to the same bits (35 were measured on figure
/// 14), and for bounds that hold the truth near an end.
const SPARE_BITS: f64 = 96.0;
/// Greatest ratio of the bits of two attempts.
const MOST: u32 = 64;
/// Bits of what is converted to doubles.
const GUESS_BITS: u32 = 96;

/// A claimed impact in doubles.
struct Impact {
    event: usize,
    /// Phase since the origin \[rad\].
    phase: f64,
    /// `y'` before the impact \[length/rad\].
    velocity: f64,
    /// `y''` at the impact.
    acceleration: f64,
    /// Leading digits that the bounds show, in bits.
    digits: f64,
}

impl Certificate {
    /// The bits to try after `bits`, which were not enough for all events.
    pub(super) fn more_bits(&self, frame: &Frame, bits: u32) -> u32 {
        let needed = self.needed_bits(frame);
        if f64::from(bits) < needed { (needed as u32).min(MOST * bits) } else { 2 * bits }
    }

    /// Bits to follow all events with from an exact start.
    fn needed_bits(&self, frame: &Frame) -> f64 {
        let e = frame.parameters.restitution.centre.to_f64();
        let hits = self.events().iter().enumerate().filter_map(ClaimedImpact::of);
        let impacts: Vec<_> = hits.map(|hit| Impact::new(frame, &hit)).collect();
        let (mut axis, mut grown, mut needed) = ([1.0, 0.0], 0.0, 0.0_f64);
        for pair in impacts.windows(2) {
            // What comes after a rest does not depend on what came before.
            (axis, grown) = if pair[1].event == pair[0].event + 1 {
                let [x, y] = pair[0].stretched(&pair[1], e, axis);
                let length = f64::hypot(x, y);
                ([x / length, y / length], grown + length.log2())
            } else {
                ([1.0, 0.0], 0.0)
            };
            let bits = grown + pair[1].digits + SPARE_BITS;
            needed = if bits.is_finite() { needed.max(bits) } else { needed };
        }
        needed
    }
}

impl Impact {
    fn new(frame: &Frame, hit: &ClaimedImpact<'_>) -> Self {
        let middle = |[lower, upper]: &Bounds| Real::rational(&((lower + upper) / BigInt::from(2)), GUESS_BITS);
        let phase = frame.clock.phase_at(&middle(hit.time)).to_f64();
        let velocity = frame.clock.slowed(&middle(hit.velocity)).to_f64();
        let acceleration = frame.parameters.terms.iter().map(|term| {
            let rate = term.rate.as_ref().map_or(1.0, |rate| rate.centre.to_f64());
            term.amplitude.centre.to_f64() * rate * rate * (term.phase.centre.to_f64() + rate * phase).sin()
        });
        let digits = |bounds: &Bounds| {
            let [size, width] =
                [&bounds[1].clone(), &(&bounds[1] - &bounds[0])].map(|x| Real::rational(x, GUESS_BITS).to_f64().abs());
            (size / width).log2()
        };
        let digits = digits(hit.time).max(digits(hit.velocity));
        Self { event: hit.event, phase, velocity, acceleration: acceleration.sum(), digits }
    }

    /// The image of an error of phase and velocity at the next impact, after a rebound with the restitution `e`. **Equation** (A.7)
    fn stretched(&self, next: &Self, e: f64, [phase, velocity]: [f64; 2]) -> [f64; 2] {
        let (lasting, after) = (next.phase - self.phase, -e * self.velocity);
        let later = ((self.acceleration * lasting + after) * phase + e * lasting * velocity) / next.velocity;
        [later, next.acceleration * later - self.acceleration * phase - e * velocity]
    }
}
