//! Impacts and touches of a motion, in forcing periods and gaps.

use crate::exact::Enclosure;
use crate::mapping::Mapping;
use crate::number::Ball;
use crate::pair::Wall;

/// One impact of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Impact {
    /// Counts the impacts from 1; the start is not counted.
    pub index: u64,
    /// Mapping of the flight before; `None` for the first contact of a start inside the gap, and where a graze of the other wall may have been a
    /// touch.
    pub mapping: Option<Mapping>,
    /// The wall.
    pub wall: Wall,
    /// Whole forcing periods since the clock's origin.
    pub turns: i64,
    /// The rest of the phase `(W t + tau) / (2 pi)`, in forcing periods, in about `[-1/2, 1/2]`.
    pub phase: Ball,
    /// The relative velocity `y'` just before the impact, in gap widths per forcing period.
    pub velocity: Ball,
    /// Phase and velocity more narrowly than in these balls, where requested.
    pub precise: Option<Box<(Enclosure, Enclosure)>>,
}

impl Impact {
    /// Phase less the whole forcing periods, and velocity, as narrowly as they are known.
    pub(crate) fn enclosures(&self) -> (Enclosure, Enclosure) {
        match &self.precise {
            Some(precise) => (**precise).clone(),
            None => (finite(self.phase), finite(self.velocity)),
        }
    }
}

/// A touch of a wall, or a departure, without velocity: wall and phase.
#[derive(Clone, Debug, PartialEq)]
pub struct Touch {
    /// The wall.
    pub wall: Wall,
    /// Whole forcing periods since the clock's origin.
    pub turns: i64,
    /// Encloses the rest of the phase, in forcing periods.
    pub phase: Enclosure,
}

/// An extremum of a flight at which the ball may touch a wall, or pass it by.
#[derive(Clone, Debug, PartialEq)]
pub struct Graze {
    /// The wall, and the times at which it may be touched.
    pub at: Touch,
    /// Encloses the distance by which the wall is missed at the extremum, in gaps: negative where the extremum lies beyond the wall. 0 is
    /// one of the values.
    pub distance: Enclosure,
    /// Speeds at which the wall may be touched, in gap widths per forcing period: from 0 on.
    pub speed: Enclosure,
}

impl Touch {
    /// Whole forcing periods, and a ball that holds the rest of the phase.
    pub fn at(&self) -> (i64, Ball) {
        let (mid, rad) = self.phase.mid_rad();
        (self.turns, Ball::new(mid, rad))
    }
}

/// The ball as an interval.
pub(crate) fn finite(ball: Ball) -> Enclosure {
    ball.enclosure().expect("certified balls are finite")
}
