//! States, and sets of them whose flights are followed at once: Lemma D1 of `docs/proofs/chaos.md#D1`.

use crate::number::{TINY, UNIT, up};

/// State of the reduced map: phase in forcing periods, and speed before the impact over `A W`.
pub type State = [f64; 2];

/// Segment across a cell chain, from its lower to its upper end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chord {
    /// End on the right, seen along the cell chain.
    pub bottom: State,
    /// End on the left.
    pub top: State,
}

/// States `centre + a sides[0] + b sides[1] + c twist`, `|a|, |b|, |c| <= 1`, and all states within `slack` of one of them, unless slower than
/// `floor`. A quadrilateral has `c = ab`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quad {
    pub centre: State,
    pub sides: [State; 2],
    pub twist: State,
    pub slack: State,
    /// None is slower than this.
    pub floor: f64,
}

pub(super) fn each(f: impl Fn(usize) -> f64) -> State {
    [f(0), f(1)]
}

impl Quad {
    /// The rectangle of these radii.
    pub fn rectangle(centre: State, radii: State, floor: f64) -> Self {
        Self { centre, sides: [[radii[0], 0.0], [0.0, radii[1]]], twist: [0.0; 2], slack: [0.0; 2], floor }
    }

    /// Holds the quadrilateral between two chords: `a` from the one to the other, `b` from below to above. Lemma D1
    pub fn between(from: &Chord, to: &Chord) -> Self {
        let ([p, q], [r, s]) = ([from.bottom, from.top], [to.bottom, to.top]);
        let centre = each(|i| 0.25 * ((p[i] + q[i]) + (r[i] + s[i])));
        let along = each(|i| 0.25 * ((r[i] - p[i]) + (s[i] - q[i])));
        let across = each(|i| 0.25 * ((q[i] - p[i]) + (s[i] - r[i])));
        let twist = each(|i| 0.25 * ((s[i] - r[i]) - (q[i] - p[i])));
        let slack = each(|i| up(8.0 * UNIT * (p[i].abs() + q[i].abs() + r[i].abs() + s[i].abs()) + TINY));
        let floor = p[1].min(q[1]).min(r[1]).min(s[1]); // D1: the slowest corner
        Self { centre, sides: [along, across], twist, slack, floor }
    }

    /// Holds the part of the `a` within `radii[0]` of `at[0]` and the `b` within `radii[1]` of `at[1]`.
    pub fn part(&self, at: [f64; 2], radii: [f64; 2]) -> Self {
        let Self { centre, sides: [s, t], twist: k, slack, floor } = *self;
        let [a, b] = at;
        let size = each(|i| centre[i].abs() + s[i].abs() + t[i].abs() + k[i].abs());
        Self {
            centre: each(|i| (a * b).mul_add(k[i], b.mul_add(t[i], a.mul_add(s[i], centre[i])))),
            sides: [each(|i| radii[0] * b.mul_add(k[i], s[i])), each(|i| radii[1] * a.mul_add(k[i], t[i]))],
            twist: each(|i| radii[0] * radii[1] * k[i]),
            slack: each(|i| up(slack[i] + 32.0 * UNIT * size[i] + TINY)),
            floor,
        }
    }

    /// Bounds of the distances from the centre, if the centre is displaced by `moved` in one or two directions.
    pub fn radii(&self, moved: &[State]) -> State {
        let by = |i: usize| moved.iter().map(|by| by[i].abs()).sum::<f64>();
        each(|i| up(self.sides[0][i].abs() + self.sides[1][i].abs() + self.twist[i].abs() + self.slack[i] + by(i)))
    }
}
