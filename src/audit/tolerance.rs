//! The tolerance of an audit: distances to the certified orbit, compared with it.

use crate::exact::{Dyadic, Enclosure, Exact};
use crate::scales::Scales;
use crate::{Error, Scene};

/// The tolerance of a scene.
pub(super) struct Tolerance {
    /// Relative tolerance, as requested.
    pub relative: Exact,
    pub scales: Scales<Enclosure>,
    /// Upper bounds of the accepted difference of a time \[time\], and of a velocity \[length/time\].
    time: Dyadic,
    velocity: Dyadic,
    /// Bits of the comparisons.
    pub bits: u32,
}

impl Tolerance {
    /// Bits beyond those of the digits: for large times, and so that roundings do not matter.
    pub const GUARD: u32 = 256;

    /// Tolerance relative to the scene's period and velocity, for enclosures of `digits` decimal digits.
    ///
    /// # Errors
    /// If these exceed the range of exact expressions.
    pub fn new(scene: &Scene, relative: &Exact, digits: u32) -> Result<Self, Error> {
        let scales = Scales::of(scene)?;
        let bits = digits.saturating_mul(10) / 3 + Self::GUARD; // proposes
        let allowed = |scale: &Enclosure| relative.enclose(bits).mul(scale, bits).sup().clone();
        let (time, velocity) = (allowed(&scales.period), allowed(&scales.velocity));
        Ok(Self { relative: relative.clone(), scales, time, velocity, bits })
    }

    /// Encloses the distance between a point of one enclosure and a point of the other.
    pub fn distance(&self, one: &Enclosure, other: &Enclosure) -> Enclosure {
        let difference = one.sub(other, self.bits);
        Enclosure::new(difference.mig(), difference.mag()).expect("the least is at most the greatest")
    }

    /// Whether a distance in time is proved to be greater than the tolerance.
    pub fn is_outside_in_time(&self, distance: &Enclosure) -> bool {
        distance.inf() > &self.time
    }

    /// Whether a distance in velocity is proved to be greater than the tolerance.
    pub fn is_outside_in_velocity(&self, distance: &Enclosure) -> bool {
        distance.inf() > &self.velocity
    }

    /// The interval widened by the tolerance of times on both sides.
    pub fn around_time(&self, time: &Enclosure) -> Enclosure {
        let most = Enclosure::point(self.time.clone());
        time.add(&most.hull(&most.negated()), self.bits)
    }
}
