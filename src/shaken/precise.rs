//! First contacts in balls of many digits.

mod one;
mod several;

use super::Parameters;
use crate::contact::multiprecision::Passed;
use crate::contact::{Contact, Grazed, Undecided};
use crate::flight::Launch;
use crate::number::{Ball, Float, Magnitude, MpBall};
use crate::pair::Wall;

/// Bits enough to lose nothing of doubles on the way past a graze.
pub(crate) const PASSING_BITS: u32 = 128;

/// First contacts in balls of any precision.
pub(crate) trait Precise: Parameters {
    /// The parameters in `bits` bits.
    fn precise(&self, bits: u32) -> Self::In<MpBall>;

    /// The parameters of [`Shaken::pair`] in `bits` bits.
    fn widened(&self, bits: u32) -> Self::In<MpBall>;

    /// The parameters rounded to fewer bits.
    fn rounded(&self, parameters: &Self::In<MpBall>, bits: u32) -> Self::In<MpBall>;

    /// Goes past the first extremum that may touch its wall. Lemmas G1, H13
    fn pass(
        &self,
        parameters: &Self::In<MpBall>,
        all: Launch<MpBall>,
        waves: Option<&Self::Waves<MpBall>>,
    ) -> Option<Passed>;

    /// Goes past the first extremum that may touch its wall, of flights in doubles.
    fn pass_graze(&self, all: Launch<Ball>) -> Option<Grazed> {
        let all = all.map(|x| MpBall::from_ball(*x).rounded(PASSING_BITS));
        self.pass(&self.widened(PASSING_BITS), all, None)?.in_doubles()
    }

    /// First contacts of a set of flights from a wall, its velocities before the impact in doubles; the centre's contact to `bits` bits. Lemma M3
    fn arrive(
        &self,
        parameters: &Self::In<MpBall>,
        flights: Flights<'_, Self::Waves<MpBall>>,
        bits: u32,
    ) -> Result<Arrival<Self::Waves<MpBall>>, Undecided>;

    /// First contacts of all flights from inside the gap, to `bits` bits: in doubles, phase less the whole forcing periods, velocity.
    fn arrive_from_inside(
        &self,
        parameters: &Self::In<MpBall>,
        all: Launch<MpBall>,
        waves: Option<&Self::Waves<MpBall>>,
        bits: u32,
    ) -> Result<Precisely<Self::Waves<MpBall>>, Undecided>;
}

/// A set of flights that leave a wall.
pub(crate) struct Flights<'w, W> {
    pub all: &'w dyn Fn() -> Launch<MpBall>,
    pub centre: Launch<MpBall>,
    /// Wall that the flights leave, with phases and velocities before the impact, in doubles.
    pub wall: Wall,
    pub phase: Ball,
    pub before: Ball,
    /// Sines and cosines at the start of the centre.
    pub waves: Option<&'w W>,
}

/// The first contacts of a set of flights that left a wall.
pub(crate) struct Arrival<W> {
    /// Encloses the contact of every flight of the set.
    pub contact: Contact<Ball>,
    /// Encloses `y''` of all flights, at the start and at the contact.
    pub accelerations: [Ball; 2],
    /// Phase, less the whole forcing periods, within `error` of which the contact of the centre lies.
    pub phase: Float,
    pub error: Magnitude,
    /// Velocity of the centre at this phase; at the contact the slope times the distance is added.
    pub velocity: MpBall,
    pub slope: Ball,
    /// Sines and cosines at this phase, where they are known.
    pub waves: Option<W>,
}

/// Encloses the first contacts of all flights of a set: in doubles; phase less the whole forcing periods and velocity in balls; sines and cosines
/// at the middle of the phases, where they are known.
pub(crate) type Precisely<W> = (Contact<Ball>, [MpBall; 2], Option<W>);
