//! The segment of starts that a chain begins with: Lemma F3 of `docs/proofs.md`.

use super::chain::{Beginning, OnWall};
use super::node::Landing;
use crate::contact::{SetContact, Undecided};
use crate::exact::Exact;
use crate::flight::Launch;
use crate::mapping::Sheared;
use crate::number::{Ball, Number};
use crate::pair::Reduced;
use crate::shaken::{Flying, Initial, Location, Origin};

/// What starts differ in from the one asked for; all else is as it is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Varied {
    Time,
    Velocity,
}

impl Varied {
    /// The velocity; the time where no velocity is left after the impact. Lemma F3
    pub fn of(pair: &Reduced<Ball>, initial: &Initial<Ball>) -> Self {
        let is_left = initial.place.wall().is_none() || pair.rebound_of(initial.velocity) != Ball::exact(0.0);
        if is_left { Self::Velocity } else { Self::Time }
    }

    /// Its direction, in (phase, velocity).
    pub fn direction(self) -> [f64; 2] {
        match self {
            Self::Time => [1.0, 0.0],
            Self::Velocity => [0.0, 1.0],
        }
    }
}

/// Starts near the one asked for, for which it is known what they differ in.
#[derive(Clone, Debug)]
pub(crate) struct Starts {
    pub varied: Varied,
    /// Holds them all.
    pub bounds: Initial<Ball>,
}

impl Starts {
    /// Those that differ by at most `apart`, in turns or in gaps a turn.
    pub fn within(apart: f64, varied: Varied, asked: &Initial<Ball>) -> Self {
        let Initial { phase, velocity, .. } = *asked;
        let bounds = match varied {
            Varied::Time => Initial { phase: phase.widened(apart), ..asked.clone() },
            Varied::Velocity => Initial { velocity: velocity.widened(apart), ..asked.clone() },
        };
        Self { varied, bounds }
    }
}

/// Starts that differ from a given one in the velocity alone; in the time alone where no velocity is left after the impact.
#[derive(Debug)]
pub(crate) struct Segment<W> {
    /// The start asked for.
    initial: Initial<Ball>,
    varied: Varied,
    /// The state that flights are followed from.
    origin: Origin<Ball>,
    /// There, where they are known better than by the phase.
    waves: Option<W>,
    scale: f64,
}

impl<W> Segment<W> {
    /// The segment around the start of a motion that is followed from an origin.
    pub fn new<S: Flying<Waves<Ball> = W>>(shaken: &S, origin: Origin<Ball>) -> Self {
        let initial = origin.initial();
        let varied = Varied::of(shaken.pair(), &initial);
        let waves = shaken.waves(&origin.phases, &origin.phase, f64::MANTISSA_DIGITS);
        let waves = waves.filter(|_| varied == Varied::Velocity);
        let scale = shaken.pair().scale(origin.velocity);
        Self { initial, varied, origin, waves, scale }
    }

    /// `a` in turns, or in gaps a turn.
    fn apart(&self, a: f64) -> f64 {
        match self.varied {
            Varied::Time => a,
            Varied::Velocity => a * self.scale,
        }
    }

    /// The flights of the starts within `a`, from the origin on; `None` where they may touch a wall before it. Lemma R3
    fn launch(&self, pair: &Reduced<Ball>, a: f64) -> Option<Launch<Ball>> {
        let Origin { turns, phase, velocity, .. } = self.origin;
        let apart = self.apart(a);
        let (phase, velocity) = match self.varied {
            Varied::Time => (phase.widened(apart), velocity),
            Varied::Velocity => (phase, velocity.widened(apart)),
        };
        Some(match self.origin.place_after(apart)? {
            Location::Wall(wall) => Launch::from_wall(wall, turns, phase, pair.rebound_of(velocity), false),
            Location::Inside(height) => Launch::from_inside(height, turns, phase, velocity),
        })
    }
}

impl<S: Flying> Beginning<S> for Segment<S::Waves<Ball>> {
    fn scale(&self) -> f64 {
        self.scale
    }

    fn starts(&self, a: f64) -> Starts {
        Starts::within(self.apart(a), self.varied, &self.initial)
    }

    fn on_wall(&self) -> Option<(OnWall, &[Exact])> {
        let Origin { turns, phase, velocity, .. } = self.origin;
        self.origin.wall().map(|wall| ((wall, turns, phase, velocity), &*self.origin.phases))
    }

    fn land(&mut self, shaken: &S, a: f64) -> Result<Landing, Undecided> {
        let first = |a| {
            let launch = self.launch(shaken.pair(), a).ok_or(Undecided::endless())?;
            shaken.first_contact(launch, self.waves.as_ref())
        };
        let (all, swings) = first(a)?;
        let (given, _) = first(0.0)?;
        // F3: inside the gap the velocity is that of the flight, as after an impact with e = -1.
        let restitution = match self.initial.place {
            Location::Wall(_) => shaken.pair().restitution,
            Location::Inside(_) => Ball::from_f64(-1.0),
        };
        let velocities = [Beginning::<S>::starts(self, a).bounds.velocity, all.velocity];
        // F3: the flight begins at the start asked for.
        let time = self.origin.delay() + all.time;
        let jacobian = Sheared::between(restitution, time, swings, velocities).ok_or(Undecided::width(&all))?;
        let jacobian = jacobian.along(|[by_time, by_velocity]| match self.varied {
            Varied::Time => by_time,
            Varied::Velocity => by_velocity * Ball::exact(self.scale),
        });
        let image = SetContact { phase: given.phase, velocity: given.velocity, slope: Ball::exact(0.0), all: given };
        Landing::new(self.origin.turns, &image, jacobian)
    }
}
