//! The start of an orbit: on a wall just before an impact, or inside the gap.

use std::cmp::Ordering;

use crate::error::{Error, is_at_least, is_at_most, within};
use crate::pair::{ImpactPair, Wall};
use impact_pair_exact::Exact;

/// The initial data of an orbit, exact or intervals; interval data are a set of starts.
#[derive(Clone, Debug)]
pub struct Start {
    pub(crate) time: Exact,
    pub(crate) velocity: Exact,
    pub(crate) place: Place,
}

/// The position of the ball at the start.
#[derive(Clone, Debug)]
pub enum Place {
    /// On a wall; the start's velocity is the relative velocity just before the impact.
    Wall(Wall),
    /// At this relative displacement `y` \[length\] inside the gap.
    Inside(Exact),
}

impl Start {
    /// Start on `wall` at `time`, with relative velocity `velocity` \[length/time\] just before the impact.
    ///
    /// # Errors
    /// If the velocity does not point at the wall (left: `<= 0`, right: `>= 0`), or this cannot be proved.
    pub fn on_wall(time: Exact, wall: Wall, velocity: Exact) -> Result<Self, Error> {
        let (points_at_it, accepted) = match wall {
            Wall::Left => (is_at_most(&velocity, 0), "on the left wall it must be at most 0"),
            Wall::Right => (is_at_least(&velocity, 0), "on the right wall it must be at least 0"),
        };
        if !points_at_it {
            return Err(Error::range("start.velocity", &velocity, accepted));
        }
        Ok(Self { time, velocity, place: Place::Wall(wall) })
    }

    /// Start inside the gap of `pair`, at relative displacement `position` \[length\] and velocity `velocity`.
    ///
    /// # Errors
    /// If the position is not strictly between the walls, or this cannot be proved.
    pub fn inside(pair: &ImpactPair, time: Exact, position: Exact, velocity: Exact) -> Result<Self, Error> {
        let start = Self { time, velocity, place: Place::Inside(position) };
        start.require_in(pair)?;
        Ok(start)
    }

    /// Refuses a start that is not in the box of `pair`. Every function that follows an orbit from a start calls it with the pair it uses.
    ///
    /// # Errors
    /// If the start is not on a wall and its position is not strictly between the walls, or this cannot be proved.
    pub fn require_in(&self, pair: &ImpactPair) -> Result<(), Error> {
        let Place::Inside(position) = &self.place else { return Ok(()) };
        let accepted = "must lie strictly between the walls at -d/2 and d/2 (on a wall: give start.wall)";
        let doubled = within("start.position", position, position.checked_mul(&Exact::from(2)))?;
        for room in [pair.gap().checked_sub(&doubled), pair.gap().checked_add(&doubled)] {
            if within("start.position", position, room)?.sign() != Some(Ordering::Greater) {
                return Err(Error::range("start.position", position, accepted));
            }
        }
        Ok(())
    }

    /// The time of the start \[time\].
    pub fn time(&self) -> &Exact {
        &self.time
    }

    /// The relative velocity \[length/time\]: before the impact for a start on a wall.
    pub fn velocity(&self) -> &Exact {
        &self.velocity
    }

    /// Whether none of the data is an interval.
    pub fn is_point(&self) -> bool {
        let place = match &self.place {
            Place::Wall(_) => true,
            Place::Inside(position) => position.is_point(),
        };
        place && self.time.is_point() && self.velocity.is_point()
    }

    /// The position of the ball.
    pub fn place(&self) -> &Place {
        &self.place
    }
}
