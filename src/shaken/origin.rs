//! The start of a motion, without units, in any arithmetic.

use std::cmp::Ordering;

use impact_pair_model::{Place, Start};

use super::later::decided;
use crate::Error;
use crate::clock::Clock;
use crate::exact::Exact;
use crate::flight::Launch;
use crate::impact::Touch;
use crate::number::{Ball, Enclosing};
use crate::pair::{ImpactPair, Wall, rebound, within};
use crate::several::Zero;
use crate::units::in_gaps;

/// A state of a motion, in forcing periods and gaps; the phase is in `[-1/2, 1/2]` (about).
#[derive(Clone, Debug)]
pub(crate) struct State<N> {
    pub place: Location<N>,
    /// Whole forcing periods since the clock's origin.
    pub turns: i64,
    pub phase: N,
    /// Velocity, before the impact for a state on a wall.
    pub velocity: N,
}

/// State that a motion is followed from, with the motion before.
#[derive(Clone, Debug)]
pub(crate) struct Origin<N> {
    pub state: State<N>,
    /// The phases of several harmonics, exactly; none at a release.
    pub phases: Vec<Exact>,
    past: Past<N>,
}

/// The motion before a state that a motion is followed from.
#[derive(Clone, Debug)]
enum Past<N> {
    /// No motion: the state is the requested start, or stands for itself.
    Nothing,
    /// A flight that touches no wall, from the requested start. Lemma R3
    Flight(State<N>),
    /// A rest, which ends with this release.
    Rest(Released),
}

/// The position of the ball.
#[derive(Clone, Debug)]
pub(crate) enum Location<N> {
    Wall(Wall),
    /// The height in gaps above the left wall.
    Inside(N),
}

impl<N> Location<N> {
    /// The wall; `None` inside the gap.
    pub fn wall(&self) -> Option<Wall> {
        match self {
            Self::Wall(wall) => Some(*wall),
            Self::Inside(_) => None,
        }
    }

    /// The height; `None` on a wall.
    pub fn height(&self) -> Option<N>
    where
        N: Copy,
    {
        match self {
            Self::Wall(_) => None,
            Self::Inside(height) => Some(*height),
        }
    }

    fn map<M, E>(&self, f: impl Fn(&'static str, &N) -> Result<M, E>) -> Result<Location<M>, E> {
        Ok(match self {
            Self::Wall(wall) => Location::Wall(*wall),
            Self::Inside(height) => Location::Inside(f("start.position", height)?),
        })
    }
}

impl<N> State<N> {
    /// The state in another arithmetic; `f` also gets the key of the value that it reads.
    pub fn map<M, E>(&self, f: impl Fn(&'static str, &N) -> Result<M, E>) -> Result<State<M>, E> {
        let (phase, velocity) = (f("start.time", &self.phase)?, f("start.velocity", &self.velocity)?);
        Ok(State { place: self.place.map(f)?, turns: self.turns, phase, velocity })
    }
}

impl<N> Origin<N> {
    /// A state without a past.
    pub fn of(state: State<N>) -> Self {
        Self { state, phases: Vec::new(), past: Past::Nothing }
    }

    /// The requested start, where the origin is that start or a later state of its motion; else the origin's state.
    pub fn initial(&self) -> &State<N> {
        match &self.past {
            Past::Flight(start) => start,
            Past::Nothing | Past::Rest(_) => &self.state,
        }
    }

    /// The release, if the origin is one.
    pub fn release(&self) -> Option<&Released> {
        match &self.past {
            Past::Rest(release) => Some(release),
            Past::Nothing | Past::Flight(_) => None,
        }
    }

    /// The origin in another arithmetic; `f` also gets the key of the value that it reads.
    pub fn map<M, E>(&self, f: impl Fn(&'static str, &N) -> Result<M, E>) -> Result<Origin<M>, E> {
        let past = match &self.past {
            Past::Nothing => Past::Nothing,
            Past::Flight(start) => Past::Flight(start.map(&f)?),
            Past::Rest(release) => Past::Rest(release.clone()),
        };
        Ok(Origin { state: self.state.map(f)?, phases: self.phases.clone(), past })
    }
}

impl Origin<Exact> {
    /// State that the motion of `pair` from `start` is followed from: a little later where the direction of the start is not certain (Lemma R3).
    /// `phases` gives those of several harmonics at a time.
    ///
    /// # Errors
    /// If the start is not in the box of `pair`, or a value is beyond the range of exact expressions.
    pub fn new(
        pair: &ImpactPair,
        start: &Start,
        clock: &Clock,
        phases: impl Fn(&Start) -> Result<Vec<Exact>, Error>,
    ) -> Result<Self, Error> {
        start.require_in(pair)?;
        let requested = Self::at(pair, start, clock, phases(start)?)?;
        let Some(later) = decided(pair, start) else { return Ok(requested) };
        Ok(Self { past: Past::Flight(requested.state), ..Self::at(pair, &later, clock, phases(&later)?)? })
    }

    /// State of the start, its phase given by the clock.
    pub fn at(pair: &ImpactPair, start: &Start, clock: &Clock, phases: Vec<Exact>) -> Result<Self, Error> {
        let (turns, phase) = clock.split("start.time", start.time())?;
        let velocity = clock.reduced_velocity(start.velocity())?;
        let place = match start.place() {
            Place::Wall(wall) => Location::Wall(*wall),
            Place::Inside(position) => {
                let half = Exact::from(1).checked_div(&Exact::from(2));
                let ratio = in_gaps("start.position", position, pair)?;
                let height = half.and_then(|half| ratio.checked_add(&half));
                Location::Inside(within("start.position", position, height)?)
            }
        };
        Ok(Self { phases, ..Self::of(State { place, turns, phase, velocity }) })
    }

    /// Origin at a release: no velocity, and the phase as exactly as it is shown.
    pub fn released(release: Released) -> Self {
        let Touch { wall, turns, phase } = &release.at;
        let [lo, hi] = [phase.inf(), phase.sup()].map(|end| Exact::from_rational(end.to_rational()));
        let state = State {
            place: Location::Wall(*wall),
            turns: *turns,
            phase: Exact::interval(&lo, &hi).expect("bounds are in order"),
            velocity: Exact::from(0),
        };
        Self { past: Past::Rest(release), ..Self::of(state) }
    }
}

impl Origin<Ball> {
    /// Flight from the middle of the start, in floating point.
    pub fn launch(&self, restitution: f64) -> Launch<f64> {
        let State { ref place, turns, phase, velocity } = self.state;
        let (phase, velocity) = (phase.mid(), velocity.mid());
        match *place {
            Location::Wall(wall) => {
                Launch::from_wall(wall, turns, phase, rebound(&restitution, velocity), self.release().is_some())
            }
            Location::Inside(height) => Launch::from_inside(height.mid(), turns, phase, velocity),
        }
    }

    /// Forcing periods since the requested start: exactly 0 where the origin is that start.
    pub fn delay(&self) -> Ball {
        let (now, Past::Flight(start)) = (&self.state, &self.past) else { return Ball::exact(0.0) };
        // Lemma N1: the two are less than a forcing period apart (R3).
        Ball::exact((now.turns - start.turns) as f64) + (now.phase - start.phase)
    }

    /// Place of the ball for starts that are up to `apart` gap widths per forcing period faster or slower than the requested one. `None` where
    /// one of them may touch a wall before. Lemma R3
    pub fn place_after(&self, apart: f64) -> Option<Location<Ball>> {
        let (Past::Flight(start), Location::Inside(height)) = (&self.past, &self.state.place) else {
            return Some(self.state.place.clone());
        };
        let Location::Inside(from) = start.place else { return None };
        let farther = Ball::exact(apart) * self.delay();
        let rooms = [from, Ball::exact(1.0) - from];
        // R3: half of the way to the nearer wall at most
        let is_free = |room: Ball| (room - farther - farther).certain_sign() == Some(Ordering::Greater);
        rooms.into_iter().all(is_free).then(|| Location::Inside(height.widened(farther.mag())))
    }
}

/// The release of a ball that rested on a wall.
#[derive(Clone, Debug)]
pub(crate) struct Released {
    pub at: Touch,
    /// The zero of the contact force at the release, with several harmonics; one harmonic has it at an exact phase.
    pub zero: Option<Zero>,
}

impl Released {
    /// Forcing periods of `later`, counted as those of `self`, if the motion is the same from both releases on (Lemmas Z3, H9).
    pub fn turns_of_same(&self, later: &Self) -> Option<i64> {
        match (&self.zero, &later.zero) {
            (Some(zero), Some(other)) => zero.turns_of_same(other),
            _ => (self.at.wall == later.at.wall).then_some(later.at.turns),
        }
    }
}
