//! Cells of a slice, and how their states fly along a word (Lemma V39).

use super::super::Law;
use super::super::beam::{FlightBundle, Landing, Quad, Spot, State};
use super::super::cones::Frame;
use super::super::span::Span;
use super::course::Course;
use super::side::Slice;

/// A part of a slice: fractions of the way from left to right, and of that from bottom to top, all from -1 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cell {
    pub across: [f64; 2],
    pub heights: [f64; 2],
}

/// The least side of a cell, `2^-19` of the whole way of 2: a slice is halved 20 times.
const LEAST: f64 = 1.0 / (1_u64 << 19) as f64; // exact: a power of two

impl Cell {
    pub const WHOLE: Self = Self { across: [-1.0, 1.0], heights: [-1.0, 1.0] };

    /// The left or the right side of a slice: a cell of no breadth.
    pub fn side(is_right: bool) -> Self {
        let at = if is_right { 1.0 } else { -1.0 };
        Self { across: [at; 2], ..Self::WHOLE }
    }

    /// Returns both halves; `None` where they would be too small. All fractions are exact.
    pub fn halves(&self, is_tall: bool) -> Option<[Self; 2]> {
        let cut = |[a, b]: [f64; 2]| {
            let middle = 0.5 * (a + b);
            (b - a > LEAST).then_some([[a, middle], [middle, b]])
        };
        Some(if is_tall {
            cut(self.heights)?.map(|heights| Self { heights, ..*self })
        } else {
            cut(self.across)?.map(|across| Self { across, ..*self })
        })
    }
}

/// Holds what is at a fraction of the way from one number to another, from -1 to 1.
fn between(at: f64, [a, b]: [Span; 2]) -> Span {
    let (one, at) = (Span::point(1.0), Span::point(at));
    ((one - at) * a + (one + at) * b).scaled(0.5)
}

impl Slice {
    /// Holds the state at fractions of the ways from left to right and from bottom to top.
    fn state(&self, frame: &Frame, across: f64, height: f64) -> Spot {
        let [left, right, eta] =
            [self.left, self.right, self.heights].map(|ends| between(height, ends.map(Span::point)));
        let offset = frame.vector(between(across, [left, right]), eta);
        [0, 1].map(|i| Span::point(frame.centre[i]) + offset[i])
    }

    /// The states of a cell: bilinear, as sides of slices are straight.
    pub fn states(&self, frame: &Frame, cell: &Cell) -> Quad {
        let [[a, b], [low, high]] = [cell.across, cell.heights];
        Quad { corners: [(a, low), (a, high), (b, low), (b, high)].map(|(t, s)| self.state(frame, t, s)) }
    }
}

/// Proves that the flights of all states of a set are those of a word, one after another: their last first contacts.
pub(super) fn last_landing(law: &Law, states: &Quad, walls: &[bool], course: &Course) -> Option<Landing> {
    let mut flights = FlightBundle::new(law, states);
    for (k, leg) in course.legs(walls.len())?.iter().enumerate() {
        let landing = flights.land(walls[k], leg.time)?;
        if k + 1 == walls.len() {
            return Some(landing);
        }
        flights = onward(law, &landing, leg.directions)?;
    }
    None
}

/// The flights from a parallelogram along two directions that holds all images of a set.
fn onward(law: &Law, landing: &Landing, directions: [State; 2]) -> Option<FlightBundle> {
    let centre = landing.centre.map(|x| Span::point(x.mid()));
    let [g, h] = directions.map(|direction| direction.map(Span::point));
    let area = g[0] * h[1] - g[1] * h[0];
    let reach = |normal: Spot| Some(Span::point(landing.along(normal, centre).over(area)?.most()));
    let (x, y) = (reach([h[1], -h[0]])?, reach([-g[1], g[0]])?);
    let sides = [g.map(|part| part * x), h.map(|part| part * y)];
    let bounds = [0, 1].map(|i| centre[i] + sides[0][i].around() + sides[1][i].around());
    Some(FlightBundle::of(law, bounds, centre, [sides[0], sides[1], [Span::point(0.0); 2]]))
}
