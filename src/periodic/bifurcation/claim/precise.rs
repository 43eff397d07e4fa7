//! Proofs of bifurcations in more bits than doubles have.

use super::super::super::precondition::Preconditioner;
use super::super::between::{BITS, Between};
use super::super::family::{Family, Varied};
use super::super::point::Point;
use super::{Claim, Setting};
use crate::exact::{Enclosure, working_bits};
use crate::number::MpBall;

/// Bits that an extended system loses besides: it is solved for a kernel as well.
const EXTENDED_BITS: u32 = 16;
/// Precisions that are tried beyond doubles, each twice the one before: twice is enough where precision alone is missing.
const MOST_PRECISIONS: u32 = 3;

impl<S: Varied> Setting<'_, S> {
    /// The family in balls of `bits` bits.
    pub fn balls(&self, bits: u32) -> Family<S, MpBall> {
        Family { unknown: self.unknown, base: self.base.precise(bits) }
    }
}

impl<S: Varied> Claim<'_, S> {
    /// Proves the zero near a guess in more and more bits; `best` is the point proved so far. An interval among the parameters
    /// that do not vary is narrowed by no precision.
    pub(super) fn prove_precisely(
        &self,
        inverse: &Preconditioner,
        (guess, largest): (&[f64], f64),
        is_point: bool,
        best: Option<Point>,
    ) -> Option<Point> {
        let mut best = best;
        let mut bits = working_bits(self.precision.digits) + EXTENDED_BITS;
        for _ in 0..MOST_PRECISIONS {
            if bits > self.precision.max_bits {
                break;
            }
            let balls: Vec<MpBall> = guess.iter().map(|&x| MpBall::from_f64_bits(x, bits)).collect();
            let family = self.setting.balls(bits);
            let found = self.certify(&family, inverse, balls, (bits, largest)).and_then(|zero| {
                self.point(&family, &zero, bits, |shaken, chain, phases, legs| {
                    shaken.is_physical_precisely(&shaken.precise(bits), chain, phases, legs)
                })
            });
            best = found.or(best);
            if best.as_ref().is_some_and(|point| point.is_narrow) || !is_point {
                break;
            }
            bits *= 2;
        }
        best
    }
}

impl Between<'_> {
    /// Proves the orbits of a window that is too narrow for doubles.
    pub fn prove_precisely(&self) -> Result<(), &'static str> {
        let pad = (24.0 - f64::from(BITS)).exp2();
        let of_ball = |x: &Enclosure| MpBall::enclosing(x, BITS);
        self.prove_in(&self.setting.balls(BITS), (BITS / 4, pad), &of_ball)
    }
}
