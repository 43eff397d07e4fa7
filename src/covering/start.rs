//! The segment of starts that a chain begins with: Lemma F3 of `docs/proofs.md`.

use super::chain::{Beginning, OnWall};
use super::node::{Axes, Landing};
use crate::contact::{SetContact, Undecided};
use crate::exact::Exact;
use crate::flight::Launch;
use crate::mapping::Sheared;
use crate::number::{Ball, Number};
use crate::shaken::{Flying, Location, Origin};

/// Starts that differ from a given one in the velocity alone; in the time alone where no velocity is left after the impact.
#[derive(Debug)]
pub(crate) struct Segment<W> {
    origin: Origin<Ball>,
    /// At the start, where they are known better than by the phase.
    waves: Option<W>,
    is_of_times: bool,
    axes: Axes,
}

impl<W> Segment<W> {
    /// The segment around an origin.
    pub fn new<S: Flying<Waves<Ball> = W>>(shaken: &S, origin: Origin<Ball>) -> Self {
        let zero = Ball::exact(0.0);
        let is_of_times = origin.wall().is_some() && shaken.pair().rebound_of(origin.velocity) == zero;
        let axes = |unstable, stable| Axes { unstable, stable, scale: shaken.pair().scale(origin.velocity) };
        let axes = if is_of_times { axes([1.0, 0.0], [0.0, 1.0]) } else { axes([0.0, 1.0], [1.0, 0.0]) };
        let waves = shaken.waves(&origin.phases, &origin.phase, f64::MANTISSA_DIGITS).filter(|_| !is_of_times);
        Self { origin, waves, is_of_times, axes }
    }
}

impl<S: Flying> Beginning<S> for Segment<S::Waves<Ball>> {
    fn axes(&self) -> Axes {
        self.axes
    }

    fn starts(&self, a: f64) -> (Ball, Ball) {
        let Origin { phase, velocity, .. } = self.origin;
        let apart = a * self.axes.scale;
        if self.is_of_times { (phase.widened(a), velocity) } else { (phase, velocity.widened(apart)) }
    }

    fn on_wall(&self) -> Option<(OnWall, &[Exact])> {
        let Origin { turns, phase, velocity, .. } = self.origin;
        self.origin.wall().map(|wall| ((wall, turns, phase, velocity), &*self.origin.phases))
    }

    fn land(&mut self, shaken: &S, a: f64) -> Result<Landing, Undecided> {
        let turns = self.origin.turns;
        let starts = |a| Beginning::<S>::starts(self, a);
        let first = |(phase, velocity)| {
            let launch = match &self.origin.place {
                Location::Wall(wall) => {
                    Launch::from_wall(*wall, turns, phase, shaken.pair().rebound_of(velocity), false)
                }
                Location::Inside(height) => Launch::from_inside(*height, turns, phase, velocity),
            };
            shaken.first_contact(launch, self.waves.as_ref())
        };
        let (all, swings) = first(starts(a))?;
        let (given, _) = first(starts(0.0))?;
        // F3: inside the gap the velocity is that of the flight, as after an impact with e = -1.
        let restitution = match self.origin.place {
            Location::Wall(_) => shaken.pair().restitution,
            Location::Inside(_) => Ball::from_f64(-1.0),
        };
        let velocities = [starts(a).1, all.velocity];
        let jacobian = Sheared::between(restitution, all.time, swings, velocities).ok_or(Undecided::width(&all))?;
        let image = SetContact { phase: given.phase, velocity: given.velocity, slope: Ball::exact(0.0), all: given };
        Landing::new(turns, &image, jacobian)
    }
}
