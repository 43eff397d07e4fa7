//! The content of each panel: its name, axes, and the part of the trace that it shows.

use std::f64::consts::TAU;

use impact_pair::pair::Wall;

use super::trace::{Crossing, Part, Point, Span, Stroke, Trace};
use crate::picture::Axis;

/// Free room beyond the walls, as a fraction of the gap.
const WALL_MARGIN: f64 = 0.08;

/// A panel of the paper's figures 12-17.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum Panel {
    /// (a) y over t
    #[cfg_attr(feature = "clap", value(alias = "a"))]
    Displacement,
    /// (b) y' over t
    #[cfg_attr(feature = "clap", value(alias = "b"))]
    Velocity,
    /// (c) y' over y
    #[cfg_attr(feature = "clap", value(alias = "c"))]
    PhasePlane,
    /// (d) x' over x, with x = y + E(t)
    #[cfg_attr(feature = "clap", value(alias = "d"))]
    AbsolutePhasePlane,
    /// (e) impacts on both walls, y' over W t + tau mod 2 pi, (18)-(21)
    #[cfg_attr(feature = "clap", value(alias = "e"))]
    SwitchPlane,
    /// (f) impacts on both walls, x' over x, (22)
    #[cfg_attr(feature = "clap", value(alias = "f"))]
    AbsoluteSwitchPlane,
    /// (g) impacts on the left wall, y' over W t + tau mod 2 pi: the Poincaré section of Sigma-
    #[cfg_attr(feature = "clap", value(alias = "g"))]
    SectionLeft,
    /// (h) impacts on the right wall: the Poincaré section of Sigma+
    #[cfg_attr(feature = "clap", value(alias = "h"))]
    SectionRight,
}

impl Panel {
    /// All panels, in the order of the paper.
    pub const ALL: [Self; 8] = [
        Self::Displacement,
        Self::Velocity,
        Self::PhasePlane,
        Self::AbsolutePhasePlane,
        Self::SwitchPlane,
        Self::AbsoluteSwitchPlane,
        Self::SectionLeft,
        Self::SectionRight,
    ];
}

/// A panel of a trace: its axes and the content drawn on them.
pub struct Frame<'t> {
    pub panel: Panel,
    /// The letter of the panel on its sheet: the paper's letter, or another.
    letter: char,
    trace: &'t Trace,
    /// Beginning and end of the curves and of the time axis, in forcing periods since the start.
    begin: f64,
    end: f64,
    /// True if the panel magnifies a part of the time.
    pub is_magnified: bool,
}

/// What the content of a panel is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A curve over time.
    Time,
    /// A curve in a plane of two quantities.
    Plane,
    /// Impacts alone, as points.
    Section,
}

/// What the paper says of a panel.
#[derive(Clone, Copy, Debug)]
pub struct Caption {
    /// The letter of the panel in figures 12-17.
    pub letter: char,
    /// The name of the panel.
    pub title: &'static str,
    /// The quantities on the axes, with their units.
    pub quantities: [&'static str; 2],
    /// What the content is made of.
    pub kind: Kind,
}

impl Panel {
    /// The letter, title, axes and kind of the panel.
    pub fn caption(self) -> Caption {
        let phase = "$Ωt + τ$ mod 2π [rad]";
        let before = "$y′$ before the impact [length/time]";
        let (letter, title, quantities, kind) = match self {
            Self::Displacement => ('a', "time–displacement", ["$t$ [time]", "$y$ [length]"], Kind::Time),
            Self::Velocity => ('b', "time–velocity", ["$t$ [time]", "$y′$ [length/time]"], Kind::Time),
            Self::PhasePlane => ('c', "phase plane, relative", ["$y$ [length]", "$y′$ [length/time]"], Kind::Plane),
            Self::AbsolutePhasePlane => {
                ('d', "phase plane, absolute", ["$x = y + E(t)$ [length]", "$x′$ [length/time]"], Kind::Plane)
            }
            Self::SwitchPlane => ('e', "switch-planes, relative", [phase, before], Kind::Section),
            Self::AbsoluteSwitchPlane => {
                let quantities = ["$x$ [length]", "$x′$ before the impact [length/time]"];
                ('f', "switch-planes, absolute", quantities, Kind::Section)
            }
            Self::SectionLeft => ('g', "Poincaré section of $Σ_-$, the left wall", [phase, before], Kind::Section),
            Self::SectionRight => ('h', "Poincaré section of $Σ_+$, the right wall", [phase, before], Kind::Section),
        };
        Caption { letter, title, quantities, kind }
    }

    /// Whether the panel shows only impacts.
    pub fn is_section(self) -> bool {
        self.caption().kind == Kind::Section
    }

    /// Whether one axis is time.
    pub fn is_of_time(self) -> bool {
        self.caption().kind == Kind::Time
    }

    /// Whether the panel shows the impacts on a wall.
    fn has_impacts_on(self, wall: Wall) -> bool {
        match self {
            Self::SwitchPlane | Self::AbsoluteSwitchPlane => true,
            Self::SectionLeft => wall == Wall::Left,
            Self::SectionRight => wall == Wall::Right,
            Self::Displacement | Self::Velocity | Self::PhasePlane | Self::AbsolutePhasePlane => false,
        }
    }
}

impl<'t> Frame<'t> {
    /// The panel with the curves of `cycles` cycles.
    pub fn new(panel: Panel, trace: &'t Trace, cycles: u32) -> Self {
        // After the last proved event the rest of the requested time is shown as undecided.
        let end = if trace.is_open { f64::from(cycles) } else { f64::from(cycles).min(trace.known) };
        Self { panel, letter: panel.caption().letter, trace, begin: 0.0, end, is_magnified: false }
    }

    /// The panel with another letter than the paper's.
    pub fn lettered(self, letter: char) -> Self {
        Self { letter, ..self }
    }

    /// The heading of the panel: its letter, and its name in the paper.
    pub fn heading(&self) -> String {
        let magnified = if self.is_magnified { ", magnified" } else { "" };
        format!("({})  {}{magnified}", self.letter, self.panel.caption().title)
    }

    /// The time panel between two times.
    pub fn magnified(panel: Panel, trace: &'t Trace, [from, to]: [f64; 2]) -> Self {
        let turns = |time: f64| (time - trace.start) / trace.period;
        Self { panel, letter: panel.caption().letter, trace, begin: turns(from), end: turns(to), is_magnified: true }
    }

    /// The place of a state on this panel.
    pub fn place(&self, point: &Point) -> [Span; 2] {
        match self.panel {
            Panel::Displacement => [point.time, point.displacement],
            Panel::Velocity => [point.time, point.velocity],
            Panel::PhasePlane => [point.displacement, point.velocity],
            // Panels of impacts alone have no curves.
            Panel::AbsolutePhasePlane
            | Panel::SwitchPlane
            | Panel::AbsoluteSwitchPlane
            | Panel::SectionLeft
            | Panel::SectionRight => [point.absolute.0, point.absolute.1],
        }
    }

    /// The derivative of the place of a state, per forcing period.
    pub fn rate(&self, point: &Point) -> [f64; 2] {
        let (acceleration, absolute) = point.accelerations;
        let rate = match self.panel {
            Panel::Displacement => [1.0, point.velocity.middle],
            Panel::Velocity => [1.0, acceleration],
            Panel::PhasePlane => [point.velocity.middle, acceleration],
            Panel::AbsolutePhasePlane
            | Panel::SwitchPlane
            | Panel::AbsoluteSwitchPlane
            | Panel::SectionLeft
            | Panel::SectionRight => [point.absolute.1.middle, absolute],
        };
        rate.map(|rate| rate * self.trace.period)
    }

    /// The curves shown, jumps of impacts included. A magnified panel has whole strokes, which its frame clips.
    pub fn strokes(&self) -> impl Iterator<Item = (&'t Stroke, &'t [Point])> {
        let strokes = if self.panel.is_section() { &[] } else { self.trace.strokes.as_slice() };
        let (begin, end) = (self.begin, self.end);
        let is_magnified = self.is_magnified;
        strokes.iter().filter_map(move |stroke| {
            let points = stroke.points.as_slice();
            let shown = points.partition_point(|point| point.at <= end);
            if is_magnified {
                let meets = shown > 0 && points.last().is_some_and(|last| last.at >= begin);
                return meets.then_some((stroke, points));
            }
            (shown > 0).then(|| (stroke, &points[..shown]))
        })
    }

    /// The coordinates of the points of the curves shown.
    fn places(&self) -> impl Iterator<Item = [Span; 2]> {
        let shown = self.begin..=self.end;
        let points = self.strokes().flat_map(|(_, points)| points);
        points.filter(move |point| shown.contains(&point.at)).map(|point| self.place(point))
    }

    /// The impacts shown, each with the number of impacts before it.
    pub fn crossings(&self) -> impl Iterator<Item = (usize, Wall, [Span; 2])> {
        let shown = move |(_, crossing): &(usize, &Crossing)| self.panel.has_impacts_on(crossing.wall);
        self.trace.crossings.iter().enumerate().filter(shown).map(|(impacts, crossing)| {
            let place = if self.panel == Panel::AbsoluteSwitchPlane {
                [crossing.absolute.0, crossing.absolute.1]
            } else {
                [crossing.phase, crossing.velocity]
            };
            (impacts, crossing.wall, place)
        })
    }

    /// A place on an axis of angles, in two parts where the place extends beyond a whole forcing period.
    pub fn wrapped(&self, place: [Span; 2]) -> impl Iterator<Item = [Span; 2]> {
        let [angle, other] = place;
        let is_angle = self.panel.is_section() && self.panel != Panel::AbsoluteSwitchPlane;
        let beyond = (is_angle && angle.high > TAU).then(|| {
            let high = (angle.high - TAU).min(TAU);
            [Span { low: 0.0, middle: 0.5 * high, high }, other]
        });
        [place].into_iter().chain(beyond)
    }

    /// Grazes, rests and releases shown.
    pub fn marks(&self) -> impl Iterator<Item = (super::trace::Kind, [Span; 2])> {
        let marks = if self.panel.is_section() { &[] } else { self.trace.marks.as_slice() };
        let shown = self.begin..=self.end;
        marks.iter().filter(move |mark| shown.contains(&mark.point.at)).map(|mark| (mark.kind, self.place(&mark.point)))
    }

    /// The axis across the walls, and the places of the walls on that axis.
    pub fn walls(&self) -> Option<(usize, [Span; 2])> {
        let wall = self.trace.wall;
        let walls = [wall.negated(), wall];
        match self.panel {
            Panel::Displacement => Some((1, walls)),
            Panel::PhasePlane => Some((0, walls)),
            Panel::Velocity
            | Panel::AbsolutePhasePlane
            | Panel::SwitchPlane
            | Panel::AbsoluteSwitchPlane
            | Panel::SectionLeft
            | Panel::SectionRight => None,
        }
    }

    /// The range of time in which nothing is proved \[time\].
    pub fn open(&self) -> Option<(f64, f64)> {
        let (from, to) = (self.trace.known.max(self.begin), self.end);
        (self.panel.is_of_time() && self.trace.is_open && from < to).then(|| (self.time(from), self.time(to)))
    }

    /// The last proved state, on panels without a time axis.
    pub fn last(&self) -> Option<[Span; 2]> {
        let is_cut =
            !self.trace.is_open || self.panel.is_of_time() || self.panel.is_section() || self.trace.known > self.end;
        let mut lines = self.trace.strokes.iter().filter(|stroke| stroke.part != Part::Either);
        let last = lines.next_back().and_then(|stroke| stroke.points.last());
        last.filter(|_| !is_cut).map(|point| self.place(point))
    }

    fn time(&self, turns: f64) -> f64 {
        turns.mul_add(self.trace.period, self.trace.start)
    }

    /// The axis from wall to wall.
    pub fn gap(&self) -> Axis {
        let half = (1.0 + 2.0 * WALL_MARGIN) * self.trace.wall.high;
        Axis::between(-half, half)
    }

    /// The axes: everything shown lies on them.
    pub fn axes(&self) -> [Axis; 2] {
        let all = |axis: usize| {
            let curves = self.places().map(move |place| place[axis]);
            let crossings = self.crossings().map(move |(_, _, place)| place[axis]);
            let ends: Vec<f64> = curves.chain(crossings).flat_map(|span| [span.low, span.high]).collect();
            if ends.iter().any(|end| end.is_infinite()) {
                return Axis::between(f64::NEG_INFINITY, f64::INFINITY);
            }
            let ends = ends.into_iter();
            if self.is_magnified { Axis::close_around(ends) } else { Axis::around(ends) }
        };
        let time = || {
            let of = if self.begin < self.end { Axis::between } else { Axis::over };
            of(self.time(self.begin), self.time(self.end))
        };
        match self.panel {
            Panel::Displacement => [time(), if self.is_magnified { all(1) } else { self.gap() }],
            Panel::Velocity => [time(), all(1)],
            Panel::PhasePlane => [self.gap(), all(1)],
            Panel::SwitchPlane | Panel::SectionLeft | Panel::SectionRight => [Axis::angle(), all(1)],
            Panel::AbsolutePhasePlane | Panel::AbsoluteSwitchPlane => [all(0), all(1)],
        }
    }
}
