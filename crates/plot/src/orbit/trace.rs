//! An orbit as figures draw it: sampled flights, jumps, rests, marks and crossings of the switch-planes.

use std::f64::consts::TAU;

use impact_pair::exact::Enclosure;
use impact_pair::orbit::{CoursePoint, Orbit};
use impact_pair::pair::Wall;

/// Proved bounds of a coordinate, and its most likely value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    pub low: f64,
    pub middle: f64,
    pub high: f64,
}

impl Span {
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self { low: f(self.low), middle: f(self.middle), high: f(self.high) }
    }

    /// The span mirrored at 0.
    pub fn negated(self) -> Self {
        Self { low: -self.high, middle: -self.middle, high: -self.low }
    }
}

impl From<&Enclosure> for Span {
    fn from(x: &Enclosure) -> Self {
        let (low, high) = x.to_f64_bounds();
        Self { low, middle: low + 0.5 * (high - low), high }
    }
}

/// The motion at some time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Forcing periods since the start.
    pub at: f64,
    pub time: Span,
    /// `y` and `y'`
    pub displacement: Span,
    pub velocity: Span,
    /// `x` and `x'`
    pub absolute: (Span, Span),
    /// Approximate `y''` and `x''`, which bend the curves between the points.
    pub accelerations: (f64, f64),
}

impl Point {
    /// The state `at` forcing periods after the start; the walls are at most `wall` from the middle.
    pub fn new(at: f64, point: &CoursePoint, wall: f64) -> Self {
        Self {
            at,
            time: (&point.time).into(),
            // The ball is in the gap.
            displacement: Span::from(&point.displacement).map(|y| y.clamp(-wall, wall)),
            velocity: (&point.velocity).into(),
            absolute: ((&point.absolute_displacement).into(), (&point.absolute_velocity).into()),
            accelerations: (Span::from(&point.acceleration).middle, Span::from(&point.absolute_acceleration).middle),
        }
    }
}

/// A part of the motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Between two events.
    Flight,
    /// Jump of the velocity at an impact.
    Jump,
    /// The flights before and after an uncertain impact, while it may have happened or not. Enclosures without a line.
    Either,
    /// Infinitely many bounces, each smaller than the requested digits.
    Chatter,
    /// On a wall.
    Rest,
}

/// A part of the motion, as points.
#[derive(Clone, Debug)]
pub struct Stroke {
    pub part: Part,
    /// Number of impacts before the stroke.
    pub impacts: usize,
    pub points: Vec<Point>,
}

/// An event other than an impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    Graze,
    Rest,
    Release,
}

/// An event other than an impact, and its place.
#[derive(Clone, Copy, Debug)]
pub struct MarkedEvent {
    pub kind: Kind,
    pub point: Point,
}

/// An impact as a point of its switch-plane.
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    pub wall: Wall,
    /// `W t + tau mod 2 pi` \[rad\]; the lower end lies in `[0, 2 pi)`.
    pub phase: Span,
    /// `y'` just before the impact.
    pub velocity: Span,
    /// `x` and `x'` just before the impact.
    pub absolute: (Span, Span),
}

impl Crossing {
    /// The impact of `orbit`.
    pub fn new(orbit: &Orbit, impact: &impact_pair::orbit::Impact) -> Self {
        let point = orbit.switch_point(impact);
        let phase = Span::from(&orbit.phase(impact));
        // The double above the lower end may be a whole forcing period.
        let phase = if phase.low < TAU { phase } else { phase.map(|phase| (phase - TAU).max(0.0)) };
        let absolute = ((&point.displacement).into(), (&point.absolute_velocity).into());
        Self { wall: point.wall, phase, velocity: (&point.relative_velocity).into(), absolute }
    }
}

/// The content of a figure of an orbit.
#[derive(Clone, Debug)]
pub struct Trace {
    /// Flights, jumps and rests.
    pub strokes: Vec<Stroke>,
    /// Events.
    pub marks: Vec<MarkedEvent>,
    /// Impacts.
    pub crossings: Vec<Crossing>,
    /// `d/2`
    pub wall: Span,
    /// \[time\]
    pub start: f64,
    /// `2 pi/W` \[time\]
    pub period: f64,
    /// Forcing periods from the start to the end of the known, or requested, motion.
    pub known: f64,
    /// True if nothing is proved after `known`.
    pub is_open: bool,
}
