//! The state of the ball at any time of an orbit that has been followed: dense output.

use std::cmp::Ordering;
use std::ops::ControlFlow;

use super::{Clock, Course, Impact, Orbit, Outcome, Progress, Rest};
use crate::exact::{Enclosure, Exact};
use crate::number::Ball;
use crate::pair::Wall;
use crate::turns;
use crate::watch::Watch;

/// Bits in which a time becomes a phase: more than twice those of a double and of the forcing periods up to 2^53.
const BITS: u32 = 192;

/// A phase: whole forcing periods since the clock's origin and the rest.
pub(super) type Phase = (i64, Ball);

/// The motion of the ball between two events.
#[derive(Clone, Copy, Debug)]
enum Part {
    Flight(Course),
    Rest(Wall),
    /// Infinitely many impacts, or what follows is not known.
    Unknown,
}

/// An orbit that has been followed to its end, and the parts of its motion, recorded event by event.
///
/// **Enclosure** (Lemma O1): [`Dense::at`] holds the displacement and the velocity of every motion of the orbit's set at that time.
#[derive(Debug)]
pub struct Dense {
    orbit: Orbit,
    parts: Vec<(Phase, Part)>,
    /// Exact start; `None` if the orbit of a start near by is followed.
    start: Option<Exact>,
    dial: PhaseConverter,
}

/// The parts of a motion as far as it has been followed.
struct Parts {
    /// The phase at which each part begins, and the part, which ends at the beginning of the next one.
    parts: Vec<(Phase, Part)>,
    has_grazed: bool,
}

impl Parts {
    /// The flight from the start.
    fn of(orbit: &Orbit) -> Self {
        let (course, turns, phase) = orbit.first_course();
        Self { parts: vec![((turns, phase), Part::Flight(course))], has_grazed: false }
    }

    /// Records the next event.
    fn record(&mut self, orbit: &Orbit, event: &Progress) {
        match event {
            Progress::Impact(impact) => self.impact(orbit, impact),
            Progress::Graze(graze) => {
                // The flight that follows is determined backwards from the next impact.
                self.has_grazed = true;
                self.parts.push((graze.at.at(), Part::Unknown));
            }
            Progress::Rest(Rest { at, is_accumulation }) => {
                if *is_accumulation && let Some((_, part)) = self.parts.last_mut() {
                    *part = Part::Unknown;
                }
                self.has_grazed = false;
                self.parts.push((at.at(), Part::Rest(at.wall)));
            }
            Progress::Release(release) => {
                let course = orbit.course_from(release);
                self.parts.push((release.at(), Part::Flight(course)));
            }
            Progress::Retraced(_) | Progress::Ended => {}
        }
    }

    fn impact(&mut self, orbit: &Orbit, impact: &Impact) {
        if self.has_grazed
            && let Some((_, part)) = self.parts.last_mut()
        {
            *part = Part::Flight(orbit.course_before(impact));
        }
        self.has_grazed = false;
        let course = orbit.course_after(impact);
        self.parts.push(((impact.turns, impact.phase), Part::Flight(course)));
    }
}

/// Bounds of `y` \[length\] and of `y'` \[length/time\], as doubles.
pub type DenseState = [[f64; 2]; 2];

impl Dense {
    /// Follows an orbit that has not advanced yet, until it ends or the watch stops it; `each` receives every event.
    pub fn of(mut orbit: Orbit, watch: &dyn Watch, mut each: impl FnMut(&Orbit, &Progress)) -> Self {
        let start = orbit.shadow().is_none().then(|| orbit.start().time().clone());
        let mut parts = Parts::of(&orbit);
        let _ = orbit.follow(watch, |orbit, event| {
            each(orbit, &event);
            parts.record(orbit, &event);
            ControlFlow::<()>::Continue(())
        });
        Self { parts: parts.parts, start, dial: PhaseConverter::new(orbit.clock()), orbit }
    }

    /// The orbit.
    pub fn orbit(&self) -> &Orbit {
        &self.orbit
    }

    /// Bounds of `y` and `y'` at a time; `None` before the start, after the end of the list, and while infinitely many impacts pass or nothing is
    /// proved.
    ///
    /// If an impact may come before or after the time, the bounds hold the states of both flights.
    pub fn at(&self, time: f64) -> Option<DenseState> {
        let (exact, phase) = (Exact::from_f64(time)?, self.dial.phase(time)?);
        let last = self.parts.len() - 1;
        let middle = self.parts.partition_point(|(begin, _)| between(*begin, phase).mid().is_sign_positive());
        // Lemma O1: part `first` has begun, part `end` has not.
        let begun = (0..=middle.min(last)).rev().find(|&part| is_certain(between(self.parts[part].0, phase)));
        let is_started = |start: &Exact| matches!(start.compare(&exact), Some(Ordering::Less | Ordering::Equal));
        let first = begun.or_else(|| self.start.as_ref().is_some_and(is_started).then_some(0))?;
        let end = (first + 1..=last).find(|&part| is_certain(between(phase, self.parts[part].0)));
        if end.is_none() && !self.lasts(&exact) {
            return None;
        }
        let mut hull: Option<DenseState> = None;
        let possible = match end {
            Some(end) => &self.parts[first..end],
            None => &self.parts[first..],
        };
        for (_, part) in possible {
            let Some(state) = self.state(part, phase)? else { continue };
            let joined = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a.min(c), b.max(d)]; // O1: the hull
            hull = Some(hull.map_or(state, |known| [joined(known[0], state[0]), joined(known[1], state[1])]));
        }
        hull
    }

    /// State of a part at a phase; `Some(None)` for a flight that would be beyond a wall: the part cannot be there.
    fn state(&self, part: &Part, (turns, phase): Phase) -> Option<Option<DenseState>> {
        let orbit = &self.orbit;
        let point = match part {
            Part::Flight(course) => orbit.course_point(course, turns, phase)?,
            Part::Rest(wall) => orbit.rest_point(*wall, turns, phase)?,
            Part::Unknown => return None,
        };
        let wall = orbit.wall_displacement();
        let inside = point.displacement.intersection(&wall.negated().hull(&wall));
        Some(inside.map(|inside| [inside.to_f64_bounds().into(), point.velocity.to_f64_bounds().into()]))
    }

    /// Whether the last part is proved to last up to a time.
    fn lasts(&self, time: &Exact) -> bool {
        match self.orbit.outcome() {
            Some(Outcome::RestsForever(_) | Outcome::NeverImpacts) => true,
            Some(_) => self
                .orbit
                .listed_until()
                .is_some_and(|until| matches!(time.compare(until), Some(Ordering::Less | Ordering::Equal))),
            None => false,
        }
    }
}

/// Forcing periods from one phase to another.
fn between(from: Phase, to: Phase) -> Ball {
    // Lemma N1: exact below 2^53; beyond, rounding keeps the sign.
    Ball::exact(to.0.saturating_sub(from.0) as f64) + (to.1 - from.1)
}

/// Whether all of a ball is greater than 0.
fn is_certain(ball: Ball) -> bool {
    ball.mid() > ball.rad()
}

/// Converts times into phases, and velocities into gap widths per forcing period.
#[derive(Debug)]
pub(super) struct PhaseConverter {
    rate: Enclosure,
    shift: Enclosure,
    slowness: Enclosure,
}

impl PhaseConverter {
    pub fn new(clock: &Clock) -> Self {
        let [rate, shift, slowness] = clock.factors(BITS);
        Self { rate, shift, slowness }
    }

    /// Phase of a time.
    pub fn phase(&self, time: f64) -> Option<Phase> {
        let since = Enclosure::from_f64_bounds(time, time)?.mul(&self.rate, BITS).add(&self.shift, BITS);
        let whole = since.mid_rad().0.round(); // proposes: any whole number
        let rest = since.sub(&Enclosure::from_f64_bounds(whole, whole)?, BITS);
        Some((turns::after(0, whole)?, ball(&rest)))
    }

    /// Velocity in gap widths per forcing period.
    pub fn velocity(&self, velocity: f64) -> Option<Ball> {
        Some(ball(&Enclosure::from_f64_bounds(velocity, velocity)?.mul(&self.slowness, BITS)))
    }
}

fn ball(x: &Enclosure) -> Ball {
    let (mid, rad) = x.mid_rad();
    Ball::new(mid, rad)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::watch::Unwatched;

    fn followed(scene: &str, settings: &str) -> (Dense, Vec<Progress>) {
        let scene = crate::tests::scene(scene);
        let settings = crate::orbit::Settings { arithmetic: settings.parse().unwrap(), ..scene.settings() };
        let mut events = Vec::new();
        let dense = Dense::of(Orbit::of(&scene, settings).unwrap(), &Unwatched, |_, event| events.push(event.clone()));
        (dense, events)
    }

    /// (10)-(12) with A = 1, W = pi, d = 3 pi, e = 1/2, v = -4 pi: `y = -d/2 + 3 pi t - sin(pi t)` up to the impact at t = 1.
    #[test]
    fn the_exact_orbit_of_figure_12_is_on_its_walls_at_whole_times_and_moves_between() {
        let (dense, _) = followed("figure-12-exact", "interval");
        let wall = dense.orbit().wall_displacement().to_f64_bounds().1;
        assert!(dense.at(-0.25).is_none());
        // At the start the ball leaves the left wall with 2 pi, e being 1/2; at an impact both velocities are possible.
        let [y, v] = dense.at(0.0).unwrap();
        let turn = std::f64::consts::TAU;
        assert!(y[0] <= -wall + 1e-12 && y[1] >= -wall && v[0] <= turn && turn <= v[1] && v[1] - v[0] < 1e-9);
        let [y, v] = dense.at(1.0).unwrap();
        assert!(y[1] >= wall - 1e-9 && v[0] <= -turn && v[1] >= 2.0 * turn, "{y:?} {v:?}");
        let [y, v] = dense.at(0.5).unwrap();
        assert!(y[0] <= -1.0 && -1.0 <= y[1] && y[1] - y[0] < 1e-12, "{y:?}");
        let speed = 3.0 * std::f64::consts::PI;
        assert!(v[0] <= speed && speed <= v[1] && v[1] - v[0] < 1e-11, "{v:?}");
    }

    #[test]
    fn rests_and_chatter_are_distinguished_from_flights() {
        let (dense, events) = followed("chatter", "auto");
        let wall = dense.orbit().wall_displacement().to_f64_bounds().1;
        let rest = events.iter().find_map(|event| match event {
            Progress::Rest(rest) => Some(dense.orbit().rest_time(rest).to_f64_bounds()),
            _ => None,
        });
        let rest = rest.unwrap();
        // Just before it infinitely many impacts pass; then the ball is on the left wall up to the release at t = 1.
        assert!(dense.at(0.5 * (rest.0 + rest.1)).is_none());
        let [y, v] = dense.at(0.5 * (rest.1 + 1.0)).unwrap();
        assert!(y[0] <= -wall + 1e-15 && y[1] <= -wall + 1e-12 && v == [0.0, 0.0]);
        let [y, v] = dense.at(1.5).unwrap();
        assert!(y[0] > -wall && v[0] > 0.0);
        assert!(dense.at(1e9).is_none());
    }
}
