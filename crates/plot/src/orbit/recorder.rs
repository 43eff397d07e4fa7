//! Follows an orbit event by event and records its trace for figures.

use impact_pair::exact::{Enclosure, Exact};
use impact_pair::number::Ball;
use impact_pair::orbit::{Course, Impact, Orbit, Outcome, Progress, Settings};
use impact_pair::pair::Wall;

use super::trace::{Crossing, Kind, MarkedEvent, Part, Point, Span, Stroke, Trace};

/// Points of a flight: per forcing period, and the least number.
const POINTS_PER_PERIOD: f64 = 96.0;
const POINTS_PER_HOP: u32 = 32;

/// A phase: whole forcing periods since the clock's origin, and the rest.
type Phase = (i64, Ball);

/// The present motion of the ball.
#[derive(Clone, Copy, Debug)]
enum Now {
    Flies(Course),
    Rests(Wall),
}

/// Records one orbit.
#[derive(Debug)]
pub struct Recorder {
    trace: Trace,
    /// Forcing periods since the start up to which curves are drawn.
    window: f64,
    start: Phase,
    /// The last event, the state after an impact, the motion since, and whether the ball has
    /// grazed a wall since the last impact.
    last: Phase,
    after: Option<Point>,
    now: Now,
    has_grazed: bool,
}

/// The time at which `cycles` cycles have passed since the start \[time\]; `None` beyond the range of exact expressions.
pub fn end_of(scene: &impact_pair::Scene, cycles: u32) -> Option<Exact> {
    let turns = Exact::pi().checked_mul(&Exact::from(2 * i64::from(cycles))).ok()?;
    let lasting = turns.checked_div(scene.pair().excitation().reference().frequency()).ok()?;
    let end = scene.start().time().checked_add(&lasting).ok()?;
    if end.is_point() { Some(end) } else { end.upper() }
}

impl Recorder {
    /// The recorder of an orbit that has not advanced yet, for the curves of `cycles` cycles.
    pub fn new(orbit: &Orbit, cycles: u32) -> Self {
        let (course, turns, phase) = orbit.first_course();
        let wall = Span::from(&orbit.wall_displacement());
        let time = |phase: f64| {
            let rest = Enclosure::from_f64_bounds(phase, phase).expect("a finite number");
            Span::from(&orbit.clock().time(turns, &rest)).middle
        };
        let trace = Trace {
            strokes: Vec::new(),
            marks: Vec::new(),
            crossings: Vec::new(),
            wall,
            start: time(phase.mid()),
            period: time(1.0) - time(0.0),
            known: 0.0,
            is_open: false,
        };
        let start = (turns, phase);
        Self {
            trace,
            window: f64::from(cycles),
            start,
            last: start,
            after: None,
            now: Now::Flies(course),
            has_grazed: false,
        }
    }

    /// Forcing periods since the start.
    fn at(&self, (turns, phase): Phase) -> f64 {
        turns.saturating_sub(self.start.0) as f64 + (phase.mid() - self.start.1.mid())
    }

    /// The phase `at` forcing periods after the start.
    fn phase(&self, at: f64) -> Phase {
        let turns = self.start.1.mid() + at;
        (self.start.0.saturating_add(turns.round() as i64), Ball::exact(turns - turns.round()))
    }

    /// Records the next event.
    pub fn record(&mut self, orbit: &Orbit, event: &Progress) {
        match event {
            Progress::Impact(impact) => self.impact(orbit, impact),
            Progress::Graze(graze) => {
                self.touch(orbit, Kind::Graze, graze.at.at());
                self.has_grazed = true;
            }
            Progress::Rest(rest) => {
                let phase = rest.at.at();
                self.now = Now::Rests(rest.at.wall);
                if rest.is_accumulation {
                    // The last bounces are too small to be distinguished from the wall.
                    self.after = None;
                    self.sweep(orbit, Part::Chatter, phase, None);
                    self.last = phase;
                }
                self.touch(orbit, Kind::Rest, phase);
            }
            Progress::Release(release) => {
                self.touch(orbit, Kind::Release, release.at());
                self.now = Now::Flies(orbit.course_from(release));
            }
            Progress::Retraced(_) | Progress::Ended => {}
        }
    }

    fn impact(&mut self, orbit: &Orbit, impact: &Impact) {
        let phase = (impact.turns, impact.phase);
        if self.has_grazed {
            self.now = Now::Flies(orbit.course_before(impact));
        }
        let at = self.at(phase);
        let ends =
            orbit.impact_points(impact).map(|ends| ends.map(|point| Point::new(at, &point, self.trace.wall.high)));
        self.sweep(orbit, Part::Flight, phase, ends.map(|[before, _]| before));
        if let Some(ends) = ends
            && at <= self.window
        {
            self.stroke(Part::Jump, ends.to_vec());
            if let Some(either) = self.either(orbit, impact) {
                self.stroke(Part::Either, either);
            }
        }
        self.trace.crossings.push(Crossing::new(orbit, impact));
        (self.now, self.has_grazed) = (Now::Flies(orbit.course_after(impact)), false);
        (self.last, self.after) = (phase, ends.map(|[_, after]| after));
    }

    /// The possible states of the ball around an uncertain impact: in the second half of the impact's time without the impact,
    /// and in the first half after it. `None` if the time is exact.
    fn either(&self, orbit: &Orbit, impact: &Impact) -> Option<Vec<Point>> {
        let half = 0.5 * impact.phase.rad();
        let over = |course: &Course, from_middle: f64| {
            // Half of the ball, and the rounding error of the sum.
            let middle = impact.phase.mid() + from_middle;
            let phase = Ball::new(middle, half).widened(middle.abs() * f64::EPSILON);
            let point = orbit.course_point(course, impact.turns, phase)?;
            Some(Point::new(self.at((impact.turns, impact.phase)), &point, self.trace.wall.high))
        };
        let Now::Flies(before) = &self.now else { return None };
        let points = vec![over(before, half)?, over(&orbit.course_after(impact), -half)?];
        (half > 0.0).then_some(points)
    }

    fn stroke(&mut self, part: Part, points: Vec<Point>) {
        self.trace.strokes.push(Stroke { part, impacts: self.trace.crossings.len(), points });
    }

    /// Records an event with zero velocity.
    fn touch(&mut self, orbit: &Orbit, kind: Kind, phase: Phase) {
        self.follow(orbit, phase);
        let point = self.point(orbit, phase).filter(|point| point.at <= self.window);
        self.trace.marks.extend(point.map(|point| MarkedEvent { kind, point }));
        (self.last, self.after) = (phase, None);
    }

    /// The state of the ball at a phase.
    fn point(&self, orbit: &Orbit, phase: Phase) -> Option<Point> {
        let point = match &self.now {
            Now::Flies(course) => orbit.course_point(course, phase.0, phase.1),
            Now::Rests(wall) => orbit.rest_point(*wall, phase.0, phase.1),
        };
        point.map(|point| Point::new(self.at(phase), &point, self.trace.wall.high))
    }

    /// Records the motion of the ball up to an event.
    fn follow(&mut self, orbit: &Orbit, to: Phase) {
        let part = match self.now {
            Now::Flies(_) => Part::Flight,
            Now::Rests(_) => Part::Rest,
        };
        self.sweep(orbit, part, to, None);
    }

    /// Records the motion up to a phase, with the state `end` there if it is given.
    fn sweep(&mut self, orbit: &Orbit, part: Part, to: Phase, end: Option<Point>) {
        let (first, last) = (self.at(self.last), self.at(to));
        self.trace.known = self.trace.known.max(last);
        if first >= self.window || first >= last {
            return;
        }
        let is_cut = last > self.window;
        let end = match end.filter(|_| !is_cut) {
            Some(end) => Some(end),
            None => self.point(orbit, if is_cut { self.phase(self.window) } else { to }),
        };
        let inner = inner(first, last.min(self.window)).into_iter().filter_map(|at| self.point(orbit, self.phase(at)));
        let start = self.after.or_else(|| self.point(orbit, self.last));
        let points = start.into_iter().chain(inner).chain(end).collect();
        self.stroke(part, points);
    }

    /// The trace, with the end of the known motion.
    pub fn finish(mut self, orbit: &Orbit, settings: &Settings, impacts: u64) -> Trace {
        match orbit.outcome() {
            None | Some(Outcome::Undecided { .. }) => self.trace.is_open = true,
            Some(_) if settings.impacts == Some(impacts) => {}
            Some(_) => {
                let until = settings
                    .until
                    .as_ref()
                    .map(|until| (Span::from(&until.enclose(64)).middle - self.trace.start) / self.trace.period);
                let end = self.phase(until.map_or(self.window, |until| until.min(self.window)));
                self.follow(orbit, end);
            }
        }
        self.trace
    }
}

/// Times between `first` and `last`: of the grid on which the time panels end, or of a finer grid for a short flight.
fn inner(first: f64, last: f64) -> Vec<f64> {
    if (last - first) * POINTS_PER_PERIOD < f64::from(POINTS_PER_HOP) {
        let step = (last - first) / f64::from(POINTS_PER_HOP);
        return (1..POINTS_PER_HOP).map(|k| f64::from(k).mul_add(step, first)).collect();
    }
    let from = (first * POINTS_PER_PERIOD).floor() as i64 + 1;
    (from..).map(|k| k as f64 / POINTS_PER_PERIOD).take_while(|at| *at < last).collect()
}
