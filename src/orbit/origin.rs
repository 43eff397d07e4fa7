//! Where a motion starts, without units, in any arithmetic.

use super::clock::Clock;
use super::{Place, Start};
use crate::Error;
use crate::exact::Exact;
use crate::pair::{ImpactPair, Wall, within};

/// A start in turns and gaps; the phase is in `[-1/2, 1/2]` (about).
#[derive(Clone, Debug)]
pub(super) struct Origin<N> {
    pub place: Location<N>,
    pub phase: N,
    /// Before the impact for a start on a wall.
    pub velocity: N,
}

/// Where the ball is.
#[derive(Clone, Debug)]
pub(super) enum Location<N> {
    Wall(Wall),
    /// The height in gaps above the left wall.
    Inside(N),
}

impl Origin<Exact> {
    /// The exact start, and the whole turns of its phase since the clock's origin.
    pub fn new(pair: &ImpactPair, start: &Start, clock: &Clock) -> Result<(i64, Self), Error> {
        let (turns, phase) = clock.split("start.time", start.time())?;
        let velocity = clock.reduced_velocity(start.velocity())?;
        let place = match start.place() {
            Place::Wall(wall) => Location::Wall(*wall),
            Place::Inside(position) => {
                let half = Exact::from(1).checked_div(&Exact::from(2));
                let ratio = position.checked_div(pair.gap());
                let height = ratio.and_then(|ratio| ratio.checked_add(&half?));
                Location::Inside(within("start.position", position, height)?)
            }
        };
        Ok((turns, Self { place, phase, velocity }))
    }
}

impl<N> Origin<N> {
    /// The wall it starts on, if it does.
    pub fn wall(&self) -> Option<Wall> {
        match self.place {
            Location::Wall(wall) => Some(wall),
            Location::Inside(_) => None,
        }
    }

    /// The same start in another arithmetic; `f` also gets the key of what it reads.
    pub fn map<M, E>(&self, f: impl Fn(&'static str, &N) -> Result<M, E>) -> Result<Origin<M>, E> {
        let place = match &self.place {
            Location::Wall(wall) => Location::Wall(*wall),
            Location::Inside(height) => Location::Inside(f("start.position", height)?),
        };
        Ok(Origin { place, phase: f("start.time", &self.phase)?, velocity: f("start.velocity", &self.velocity)? })
    }
}
