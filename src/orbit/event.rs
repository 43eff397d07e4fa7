//! What an orbit consists of: its impacts, and how it ended.

use crate::contact::Reason;
use crate::exact::Enclosure;
use crate::mapping::Mapping;
use crate::number::Ball;
use crate::pair::Wall;

/// One impact of an orbit.
#[derive(Clone, Debug, PartialEq)]
pub struct Impact {
    /// Counts the impacts from 1; the start is not counted.
    pub index: u64,
    /// The mapping that led here; `None` for the first contact of a start inside the gap.
    pub mapping: Option<Mapping>,
    /// The wall.
    pub wall: Wall,
    /// Whole turns since the clock's origin.
    pub turns: i64,
    /// The rest of the phase `(W t + tau) / (2 pi)`, in turns, in about `[-1/2, 1/2]`.
    pub phase: Ball,
    /// The relative velocity `y'` just before the impact, in gaps a turn.
    pub velocity: Ball,
    /// Phase and velocity more narrowly than these balls, where that was asked for.
    pub precise: Option<Box<(Enclosure, Enclosure)>>,
}

impl Impact {
    /// Phase less the whole turns, and velocity, as narrow as they are known.
    pub(super) fn enclosures(&self) -> (Enclosure, Enclosure) {
        match &self.precise {
            Some(precise) => (**precise).clone(),
            None => (finite(self.phase), finite(self.velocity)),
        }
    }
}

/// What [`Orbit::advance`] has done.
#[derive(Clone, Debug, PartialEq)]
pub enum Progress {
    /// The next impact is certified.
    Impact(Impact),
    /// The precision has risen and an impact that was listed before was computed anew.
    Retraced(u64),
    /// The orbit has ended.
    Ended,
}

/// Why an orbit ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// All the impacts asked for.
    ImpactsReached,
    /// All the impacts up to the time asked for.
    TimeReached,
    /// The next impact could not be proved.
    Undecided {
        /// Why.
        reason: Reason,
        /// The wall concerned, when it is one.
        wall: Option<Wall>,
        /// When the wall may be touched \[time\]: from, and to unless it is open.
        time: (Enclosure, Option<Enclosure>),
    },
}

impl Outcome {
    /// The word of the orbit JSON.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::ImpactsReached => "impacts-reached",
            Self::TimeReached => "time-reached",
            Self::Undecided { .. } => "undecided",
        }
    }
}

/// The ball as an interval.
pub(super) fn finite(ball: Ball) -> Enclosure {
    ball.enclosure().expect("certified balls are finite")
}
