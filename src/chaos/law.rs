//! The reduced map: its parameters, and the walls that its flights end on.

use crate::number::{Ball, Number};
use crate::pair::Wall;

/// The pair as the reduced map sees it: every impact mirrored to the left wall, lengths in amplitudes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Law {
    /// `D = d/A`
    pub gap: Ball,
    /// `e`
    pub restitution: Ball,
}

/// A parameter with a radius below this part of it is one number: a bound of what rounding adds.
pub(super) const POINT: f64 = 1e-12;

impl Law {
    /// Whether it is one pair, but for rounding.
    pub fn is_point(&self) -> bool {
        [self.gap, self.restitution].iter().all(|all| all.rad() <= POINT * all.mid()) // proposes: whether anything moves with a parameter
    }

    /// The pair in the middle.
    pub fn middle(&self) -> Self {
        Self { gap: Ball::exact(self.gap.mid()), restitution: Ball::exact(self.restitution.mid()) }
    }

    /// `2 pi A/d`: the greatest speed of the box in gap widths per forcing period; `None` where the gap may be 0.
    pub fn beta(&self) -> Option<Ball> {
        Ball::exact(1.0).turn().checked_div(self.gap)
    }
}

/// The wall that a flight ends on, relative to the one it left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Side {
    /// The wall it left.
    Near,
    /// The other one.
    Far,
}

impl Side {
    /// Sign of the speed at which a flight arrives, where the wall it leaves is at 0 and the other one above.
    pub(crate) fn sign(self) -> f64 {
        match self {
            Self::Near => -1.0,
            Self::Far => 1.0,
        }
    }

    /// The wall that a flight from this one ends on.
    pub(super) fn lands_on(self, wall: Wall) -> Wall {
        match self {
            Self::Near => wall,
            Self::Far => wall.other(),
        }
    }

    /// The shift of the phase of an impact on it, in forcing periods.
    pub(crate) fn shift(self) -> f64 {
        match self {
            Self::Near => 0.0,
            Self::Far => 0.5,
        }
    }
}
