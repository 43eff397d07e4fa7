//! Follows an orbit event by event and records what figures draw of it.

use impact_pair::exact::{Enclosure, Exact};
use impact_pair::number::Ball;
use impact_pair::orbit::{Course, CoursePoint, Impact, Orbit, Outcome, Progress, Settings};
use impact_pair::pair::Wall;

use super::trace::{Crossing, Kind, Mark, Part, Point, Span, Stroke, Trace};

/// Points drawn in a turn of a flight, and in a shorter one.
const IN_A_TURN: f64 = 48.0;
const IN_A_HOP: u32 = 8;

/// A phase: whole turns since the clock's origin and the rest.
type Phase = (i64, Ball);

/// What the ball does.
#[derive(Clone, Copy, Debug)]
enum Now {
    Flies(Course),
    Rests(Wall),
}

/// Records one orbit.
#[derive(Debug)]
pub struct Recorder {
    trace: Trace,
    /// Turns since the start up to which curves are drawn.
    window: f64,
    start: Phase,
    /// The last event, what the ball does since, and whether a graze has come before that.
    last: Phase,
    now: Now,
    has_grazed: bool,
}

/// When `cycles` have passed since the start \[time\]; `None` where that is beyond what exact numbers hold.
pub fn end_of(scene: &impact_pair::Scene, cycles: u32) -> Option<Exact> {
    let turns = Exact::pi().checked_mul(&Exact::from(2 * i64::from(cycles))).ok()?;
    let lasting = turns.checked_div(scene.pair().excitation().frequency()).ok()?;
    let end = scene.start().time().checked_add(&lasting).ok()?;
    if end.is_point() { Some(end) } else { end.upper() }
}

impl Recorder {
    /// For an orbit that has not gone on yet, and the curves of so many cycles.
    pub fn new(orbit: &Orbit, cycles: u32) -> Self {
        let (course, turns, phase) = orbit.first_course();
        let wall = Span::from(&orbit.wall_displacement());
        let time = |phase: f64| {
            let rest = Enclosure::from_f64_bounds(phase, phase).expect("a finite number");
            Span::from(&orbit.clock().time(turns, &rest)).middle()
        };
        let trace = Trace {
            strokes: Vec::new(),
            marks: Vec::new(),
            crossings: Vec::new(),
            walls: Span { low: -wall.high, high: wall.high },
            wall,
            start: time(phase.mid()),
            period: time(1.0) - time(0.0),
            known: 0.0,
            is_open: false,
        };
        let start = (turns, phase);
        Self { trace, window: f64::from(cycles), start, last: start, now: Now::Flies(course), has_grazed: false }
    }

    /// Turns since the start.
    fn at(&self, (turns, phase): Phase) -> f64 {
        turns.saturating_sub(self.start.0) as f64 + (phase.mid() - self.start.1.mid())
    }

    /// The phase of so many turns since the start.
    fn phase(&self, at: f64) -> Phase {
        let turns = self.start.1.mid() + at;
        (self.start.0.saturating_add(turns.round() as i64), Ball::exact(turns - turns.round()))
    }

    /// Records the next event.
    pub fn record(&mut self, orbit: &Orbit, event: &Progress) {
        match event {
            Progress::Impact(impact) => self.impact(orbit, impact),
            Progress::Graze(graze) => {
                let (middle, radius) = graze.phase.mid_rad();
                self.touch(orbit, Kind::Graze, (graze.turns, Ball::new(middle, radius)));
                self.has_grazed = true;
            }
            Progress::Rest(rest) => {
                let (middle, radius) = rest.phase.mid_rad();
                let phase = (rest.turns, Ball::new(middle, radius));
                if rest.is_accumulation {
                    self.stay(orbit, Part::Chatter, rest.wall, phase);
                }
                self.now = Now::Rests(rest.wall);
                self.touch(orbit, Kind::Rest, phase);
            }
            Progress::Release(release) => {
                self.touch(orbit, Kind::Release, (release.turns, Ball::exact(release.phase)));
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
        self.follow(orbit, phase);
        let (before, after) = (orbit.course_before(impact), orbit.course_after(impact));
        if self.at(phase) <= self.window {
            let ends = [before, after].map(|course| orbit.course_point(&course, phase.0, phase.1));
            self.stroke(Part::Jump, phase, ends);
        }
        self.trace.crossings.push(Crossing::new(orbit, impact, self.trace.period));
        (self.now, self.last, self.has_grazed) = (Now::Flies(after), phase, false);
    }

    /// An event with no velocity.
    fn touch(&mut self, orbit: &Orbit, kind: Kind, phase: Phase) {
        self.follow(orbit, phase);
        let at = self.at(phase);
        let point = self.point(orbit, phase);
        if at <= self.window
            && let Some(point) = point
        {
            self.trace.marks.push(Mark { kind, point: Point::new(at, &point, self.trace.walls) });
        }
        self.last = phase;
    }

    /// Where the ball is.
    fn point(&self, orbit: &Orbit, (turns, phase): Phase) -> Option<CoursePoint> {
        match &self.now {
            Now::Flies(course) => orbit.course_point(course, turns, phase),
            Now::Rests(wall) => orbit.rest_point(*wall, turns, phase),
        }
    }

    /// What the ball does up to an event.
    fn follow(&mut self, orbit: &Orbit, to: Phase) {
        let part = match self.now {
            Now::Flies(_) => Part::Flight,
            Now::Rests(_) => Part::Rest,
        };
        self.sweep(orbit, part, to);
    }

    /// The last bounces before a rest: too small to be told from the wall.
    fn stay(&mut self, orbit: &Orbit, part: Part, wall: Wall, to: Phase) {
        let now = std::mem::replace(&mut self.now, Now::Rests(wall));
        self.sweep(orbit, part, to);
        (self.now, self.last) = (now, to);
    }

    fn sweep(&mut self, orbit: &Orbit, part: Part, to: Phase) {
        let (first, last) = (self.at(self.last), self.at(to));
        self.trace.known = self.trace.known.max(last);
        if first >= self.window || first >= last {
            return;
        }
        let mut phases = vec![(first, self.last)];
        phases.extend(inner(first, last.min(self.window)).into_iter().map(|at| (at, self.phase(at))));
        phases.push(if last <= self.window { (last, to) } else { (self.window, self.phase(self.window)) });
        let walls = self.trace.walls;
        let points =
            phases.into_iter().filter_map(|(at, phase)| Some(Point::new(at, &self.point(orbit, phase)?, walls)));
        let points = points.collect();
        self.trace.strokes.push(Stroke { part, points });
    }

    fn stroke(&mut self, part: Part, phase: Phase, points: [Option<CoursePoint>; 2]) {
        let at = self.at(phase);
        let points = points.iter().flatten().map(|point| Point::new(at, point, self.trace.walls)).collect();
        self.trace.strokes.push(Stroke { part, points });
    }

    /// What is known after the last event.
    pub fn finish(mut self, orbit: &Orbit, settings: &Settings, impacts: u64) -> Trace {
        match orbit.outcome() {
            None | Some(Outcome::Undecided { .. }) => self.trace.is_open = true,
            Some(_) if settings.impacts == Some(impacts) => {}
            Some(_) => {
                let until = settings.until.as_ref().map(|until| {
                    (Span::from(&until.enclose(64)).middle() - self.trace.start) / self.trace.period
                });
                let end = self.phase(until.map_or(self.window, |until| until.min(self.window)));
                self.follow(orbit, end);
            }
        }
        self.trace
    }
}

/// Times between two others: of the grid that the time panels end on, or of a finer one for a hop.
fn inner(first: f64, last: f64) -> Vec<f64> {
    if (last - first) * IN_A_TURN < f64::from(IN_A_HOP) {
        let step = (last - first) / f64::from(IN_A_HOP);
        return (1..IN_A_HOP).map(|k| f64::from(k).mul_add(step, first)).collect();
    }
    let from = (first * IN_A_TURN).floor() as i64 + 1;
    (from..).map(|k| k as f64 / IN_A_TURN).take_while(|at| *at < last).collect()
}
