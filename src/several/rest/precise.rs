//! Releases in balls of any precision. Lemma H8

use std::sync::Arc;

use super::super::harmonics::Harmonics;
use super::super::phased::FlightNumber;
use super::super::spectrum::Spectrum;
use super::{STEPS, Unproved, Zero, first_zero, pressure};
use crate::exact::Enclosure;
use crate::number::{Magnitude, MpBall, Number};
use crate::pair::Wall;

/// Bits that are tried to distinguish a change of sign from a touch.
const BITS: [u32; 3] = [128, 512, 2048];

/// Decides the zero in more bits, where doubles leave it undecided.
pub(super) fn decided(
    found: Result<Zero, Unproved>,
    spectrum: &Arc<Spectrum>,
    wall: Wall,
    turns: i64,
    phase: f64,
) -> Result<Zero, Unproved> {
    BITS.into_iter().fold(found, |found, bits| match found {
        Err(Unproved::Digits) => {
            let harmonics = Harmonics::<MpBall>::new(spectrum, bits);
            let from = MpBall::from_f64_bits(phase, bits);
            first_zero(spectrum, &harmonics, wall, turns, from).map_err(|stopped| stopped.why)
        }
        decided => decided,
    })
}

/// Encloses the phase of a release in `bits` bits.
pub(super) fn enclosure(zero: &Zero, bits: u32) -> Option<Enclosure> {
    zero.refined(bits).enclosure()
}

impl Zero {
    /// Encloses the phase of the release in `bits` bits.
    pub fn refined(&self, bits: u32) -> MpBall {
        let near = MpBall::from_f64_bits(self.near, bits);
        let limit = MpBall::from_ball(self.phase());
        let mut at = near;
        let mut known = MpBall::from_ball(self.phase());
        // Newton doubles the bits, the last steps are at full precision.
        let mut level = 64;
        for _ in 0..STEPS {
            let harmonics = Harmonics::<MpBall>::new(&self.spectrum, level + 32);
            let p = pressure(&harmonics, self.wall, self.turns, &at);
            // The mean value theorem between here and the zero.
            let error = p.mag().over(Magnitude::new(self.least, 0));
            let here = MpBall::new(at.mid().clone(), error);
            if limit.contains(&at) && here.rad() < known.rad() {
                known = here;
            } else if level > bits {
                return known.rounded(bits + 32);
            }
            let slope = harmonics.jerk(self.turns, &at).signed(-self.wall.sign());
            match p.ratio_to(&slope) {
                Some(back) => at = at.later(&-back),
                None => return known.rounded(bits + 32),
            }
            level = if level > bits { level } else { (2 * level).min(bits + 1) }; // proposes: bits
        }
        known.rounded(bits + 32)
    }
}
