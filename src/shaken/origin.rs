//! Where a motion starts, without units, in any arithmetic.

use impact_pair_model::{Place, Start};

use crate::Error;
use crate::clock::Clock;
use crate::exact::{Enclosure, Exact};
use crate::flight::Launch;
use crate::number::Ball;
use crate::pair::{ImpactPair, Wall, rebound, within};
use crate::several::Zero;

/// A start in turns and gaps; the phase is in `[-1/2, 1/2]` (about).
#[derive(Clone, Debug)]
pub(crate) struct Origin<N> {
    pub place: Location<N>,
    /// Whole turns since the clock's origin.
    pub turns: i64,
    pub phase: N,
    /// Before the impact for a start on a wall.
    pub velocity: N,
    /// The phases of several harmonics, exactly; none at a release.
    pub phases: Vec<Exact>,
    /// The release that it is, if it is one.
    pub release: Option<Released>,
}

/// Where the ball is.
#[derive(Clone, Debug)]
pub(crate) enum Location<N> {
    Wall(Wall),
    /// The height in gaps above the left wall.
    Inside(N),
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
        let (phase, velocity) = (f("start.time", &self.phase)?, f("start.velocity", &self.velocity)?);
        let (turns, phases, release) = (self.turns, self.phases.clone(), self.release.clone());
        Ok(Origin { place, turns, phase, velocity, phases, release })
    }
}

impl Origin<Exact> {
    /// The exact start of a pair, told by the clock; `phases` are those of several harmonics there.
    pub fn new(pair: &ImpactPair, start: &Start, clock: &Clock, phases: Vec<Exact>) -> Result<Self, Error> {
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
        Ok(Self { place, turns, phase, velocity, phases, release: None })
    }

    /// A release: no velocity, and the phase as exactly as it can be shown.
    pub fn released(release: Released) -> Self {
        let [lo, hi] = [release.phase.inf(), release.phase.sup()].map(|end| Exact::from_rational(end.to_rational()));
        Self {
            place: Location::Wall(release.wall),
            turns: release.turns,
            phase: Exact::interval(&lo, &hi).expect("bounds are in order"),
            velocity: Exact::from(0),
            phases: Vec::new(),
            release: Some(release),
        }
    }
}

impl Origin<Ball> {
    /// The flight from the middle of the start, in floats.
    pub fn launch(&self, restitution: f64) -> Launch<f64> {
        let (turns, phase, velocity) = (self.turns, self.phase.mid(), self.velocity.mid());
        match self.place {
            Location::Wall(wall) => {
                Launch::from_wall(wall, turns, phase, rebound(&restitution, velocity), self.release.is_some())
            }
            Location::Inside(height) => Launch::from_inside(height.mid(), turns, phase, velocity),
        }
    }
}

/// When a ball that rested on a wall leaves it.
#[derive(Clone, Debug)]
pub(crate) struct Released {
    pub wall: Wall,
    /// Whole turns since the clock's origin.
    pub turns: i64,
    /// Encloses the rest of the phase.
    pub phase: Enclosure,
    /// The zero of the pressure that it is, under several harmonics; one harmonic has it at an exact phase.
    pub zero: Option<Zero>,
}

impl Released {
    /// The turns of `later`, told as those of `self` are, if the motion is the same from both on (Lemmas Z3, H9).
    pub fn turns_of_same(&self, later: &Self) -> Option<i64> {
        match (&self.zero, &later.zero) {
            (Some(zero), Some(other)) => zero.turns_of_same(other),
            _ => (self.wall == later.wall).then_some(later.turns),
        }
    }
}
