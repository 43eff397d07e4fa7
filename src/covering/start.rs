//! The segment of starts that a chain begins with: Lemma F3 of `docs/proofs/covering.md#F3`.

use super::node::Landing;
use crate::contact::{SetContact, Undecided};
use crate::exact::Exact;
use crate::flight::Launch;
use crate::mapping::Sheared;
use crate::number::{Ball, Number};
use crate::pair::{Reduced, Wall};
use crate::shaken::{Flying, Location, Origin, State};

/// A state on a wall: whole forcing periods, the rest of the phase, and the velocity before the impact.
pub(crate) type OnWall = (Wall, i64, Ball, Ball);

/// A curve of starts that a chain begins with, and the first landing of all these starts: Lemmas F3, F6.
pub(crate) trait Beginning<S>: std::fmt::Debug + Send {
    /// The unit of velocities, a power of two.
    fn scale(&self) -> f64;

    /// The starts within `a`, in units of the curve's parameter.
    fn starts(&self, a: f64) -> Starts;

    /// Proves that all starts within `a` come to one wall, in one forcing period, transversally. The derivative is by the curve's parameter.
    fn land(&mut self, shaken: &S, a: f64) -> Result<Landing, Undecided>;

    /// The given start, if it is on a wall, and its phases with several harmonics where they are known exactly.
    fn on_wall(&self) -> Option<(OnWall, &[Exact])>;
}

/// Quantity in which starts differ from the requested one; all else is as requested.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Varied {
    Time,
    Velocity,
}

impl Varied {
    /// The velocity; the time where no velocity is left after the impact. Lemma F3
    pub fn of(pair: &Reduced<Ball>, initial: &State<Ball>) -> Self {
        let is_left = initial.place.wall().is_none() || pair.rebound_of(initial.velocity) != Ball::exact(0.0);
        if is_left { Self::Velocity } else { Self::Time }
    }

    /// Direction of the quantity, in (phase, velocity).
    pub fn direction(self) -> [f64; 2] {
        match self {
            Self::Time => [1.0, 0.0],
            Self::Velocity => [0.0, 1.0],
        }
    }

    /// The states that differ from one by at most `apart`, in forcing periods or in gap widths per forcing period.
    fn widened(self, state: &State<Ball>, apart: f64) -> State<Ball> {
        let State { phase, velocity, .. } = *state;
        match self {
            Self::Time => State { phase: phase.widened(apart), ..state.clone() },
            Self::Velocity => State { velocity: velocity.widened(apart), ..state.clone() },
        }
    }
}

/// Starts near the requested one that differ from it in a known quantity.
#[derive(Clone, Debug)]
pub(crate) struct Starts {
    pub varied: Varied,
    /// Bounds of all starts.
    pub bounds: State<Ball>,
}

impl Starts {
    /// Starts that differ by at most `apart`, in forcing periods or in gap widths per forcing period.
    pub fn within(apart: f64, varied: Varied, requested: &State<Ball>) -> Self {
        Self { varied, bounds: varied.widened(requested, apart) }
    }
}

/// Starts that differ from a given one in the velocity alone; in the time alone where no velocity is left after the impact.
#[derive(Debug)]
pub(crate) struct Segment<W> {
    /// The requested start.
    initial: State<Ball>,
    varied: Varied,
    /// The state that flights are followed from.
    origin: Origin<Ball>,
    /// The harmonics at that state, where they are known better than by the phase.
    waves: Option<W>,
    scale: f64,
}

impl<W> Segment<W> {
    /// Segment around the start of a motion that is followed from an origin.
    pub fn new<S: Flying<Waves<Ball> = W>>(shaken: &S, origin: Origin<Ball>) -> Self {
        let initial = origin.initial().clone();
        let varied = Varied::of(shaken.pair(), &initial);
        let waves = shaken.waves(&origin.phases, &origin.state.phase, f64::MANTISSA_DIGITS);
        let waves = waves.filter(|_| varied == Varied::Velocity);
        let scale = shaken.pair().scale(origin.state.velocity);
        Self { initial, varied, origin, waves, scale }
    }

    /// `a` in forcing periods, or in gap widths per forcing period.
    fn apart(&self, a: f64) -> f64 {
        match self.varied {
            Varied::Time => a,
            Varied::Velocity => a * self.scale,
        }
    }

    /// The flights of the starts within `a`, from the origin on; `None` where they may touch a wall before it. Lemma R3
    fn launch(&self, pair: &Reduced<Ball>, a: f64) -> Option<Launch<Ball>> {
        let apart = self.apart(a);
        let State { turns, phase, velocity, .. } = self.varied.widened(&self.origin.state, apart);
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
        let State { ref place, turns, phase, velocity } = self.origin.state;
        place.wall().map(|wall| ((wall, turns, phase, velocity), &*self.origin.phases))
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
        // F3: the flight begins at the requested start.
        let time = self.origin.delay() + all.time;
        let jacobian = Sheared::between(restitution, time, swings, velocities).ok_or(Undecided::width(&all))?;
        let jacobian = jacobian.along(|[by_time, by_velocity]| match self.varied {
            Varied::Time => by_time,
            Varied::Velocity => by_velocity * Ball::exact(self.scale),
        });
        let image = SetContact { phase: given.phase, velocity: given.velocity, slope: Ball::exact(0.0), all: given };
        Landing::new(self.origin.state.turns, &image, jacobian)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;
    use crate::clock::Clock;
    use crate::pair::ball;
    use crate::shaken::{Either, OneHarmonic};
    use std::sync::Arc;

    /// A start whose direction is not certain, as it is followed.
    fn followed() -> (Arc<OneHarmonic>, Origin<Ball>) {
        let text = r#"
            excitation = { amplitude = 8, frequency = "pi", phase = 0.3 }
            pair = { gap = 9.42497, restitution = 0.5 }
            start = { time = "1/3", position = 1.5, velocity = "cos(pi/5) - cos(2*pi/5) - 1/2" }"#;
        let scene = Scene::parse(text).unwrap();
        let clock = Clock::new(scene.pair(), scene.start().time(), 0).unwrap();
        let either = Either::new(scene.pair(), &clock).unwrap();
        let origin = either.origin(scene.pair(), scene.start(), &clock).unwrap().map(ball).unwrap();
        let Either::One(one) = either else { panic!("one harmonic") };
        (one, origin)
    }

    fn is_near(x: Ball, to: f64) -> bool {
        (x.mid() - to).abs() < 1e-12 * to.abs() + x.rad()
    }

    /// By (11), `dt1/dv0 = -(t1 - t0)/v1` of the flight from `t0 = 1/3`, which mpmath has end at 0.62232607566923914 with
    /// 21.460093619252802; by (12), `dv1/dv0 = 1` at a fixed time. A forcing period takes 2, so that a gap per forcing period is a velocity of `d/2`.
    #[test]
    fn r32_the_derivative_by_the_start_is_that_of_the_flight_from_the_time_of_the_scene() {
        let (one, origin) = followed();
        let mut segment = Segment::new(&*one, origin);
        let [time, speed] = [0.5 * (0.622_326_075_669_239_1 - 1.0 / 3.0), 21.460_093_619_252_802 / (0.5 * 9.42497)];
        for a in [0.0, 1e-13] {
            let Landing { jacobian, .. } = segment.land(&*one, a).unwrap();
            assert!(is_near(jacobian.time[0], -time / speed * segment.scale), "{jacobian:?}");
            assert!(is_near(jacobian.velocity[0], segment.scale), "{jacobian:?}");
        }
    }

    /// Starts that are faster are farther at the later state by as much as the time times what they are faster by; those that might
    /// come to a wall are refused.
    #[test]
    fn r32_faster_starts_are_farther_at_the_state_that_is_followed() {
        let (_, origin) = followed();
        let (delay, Location::Inside(height)) = (origin.delay(), &origin.state.place) else { panic!("inside") };
        assert!(1e-3 < delay.mid() && delay.mid() < 0.1 && delay.rad() < 1e-15, "{delay:?}");
        for apart in [0.0, 1e-12, 1.0] {
            let Some(Location::Inside(all)) = origin.place_after(apart) else { panic!("inside") };
            let reach = height.rad() + apart * delay.mid();
            assert!(all.mid() == height.mid() && all.rad() >= reach && all.rad() <= 1.001 * reach + 1e-15, "{all:?}");
        }
        // The right wall is nearer: 1/2 - 1.5/9.42497 gaps away.
        let half = 0.5 * (0.5 - 1.5 / 9.42497) / delay.mid();
        assert!(origin.place_after(0.999 * half).is_some() && origin.place_after(1.001 * half).is_none());
    }
}
