//! The parallelogram of an h-set and its coordinates: Lemma D25 of `docs/proofs/hyperbolic.md#D25`.

use super::flights::is_positive;
use super::quad::State;
use super::words::HSet;
use crate::number::{Ball, Number, UNIT};

/// The states `centre + xi along + eta across` with `|xi|, |eta| <= 1`, all numbers exact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub centre: State,
    pub along: State,
    pub across: State,
    determinant: Ball,
    /// Strips reach from below to above all corners of the h-set: to this height, `1 + 2^-k`. Lemma D34
    pub tall: f64,
}

/// Corners of h-sets are rounded: strips are at least this much taller than their parallelogram, by a power of two.
const LEAST_TALL: i32 = -30;

fn point(x: State) -> [Ball; 2] {
    x.map(Ball::exact)
}

pub(crate) fn cross([a, b]: [Ball; 2], [c, d]: [Ball; 2]) -> Ball {
    a * d - b * c
}

/// Lower bound of the absolute values of all members: negative where a member may be 0.
pub(crate) fn least(x: Ball) -> f64 {
    (x.mid().abs() - x.rad()) * (1.0 - 4.0 * UNIT)
}

impl Frame {
    /// Parallelogram of the half vectors between the middles of opposite edges.
    pub fn of(HSet { left, right }: &HSet) -> Self {
        let mean = |f: &dyn Fn(usize) -> f64| [0, 1].map(|i| 0.25 * f(i));
        let (p, q, r, s) = (left.bottom, left.top, right.bottom, right.top);
        let centre = mean(&|i| (p[i] + q[i]) + (r[i] + s[i]));
        let along = mean(&|i| (r[i] - p[i]) + (s[i] - q[i]));
        let across = mean(&|i| (q[i] - p[i]) + (s[i] - r[i]));
        let determinant = cross(point(along), point(across));
        let frame = Self { centre, along, across, determinant, tall: f64::INFINITY };
        let heights = [p, q, r, s].map(|corner| frame.place(point(corner), 0.0).map(|[_, eta]| eta));
        let is_above = |tall: &f64| {
            let tall = Ball::exact(*tall);
            heights.iter().all(|eta| eta.is_some_and(|eta| is_positive(tall - eta) && is_positive(tall + eta)))
        };
        let tall = (LEAST_TALL..=0).map(|power| 1.0 + f64::powi(2.0, power)).find(is_above); // D34: exact
        Self { tall: tall.unwrap_or(f64::INFINITY), ..frame } // D34: no strip is as tall
    }

    /// Whether the two directions are proved not to be parallel, the second one to the left.
    pub fn is_proper(&self) -> bool {
        is_positive(self.determinant)
    }

    /// Holds the coordinates of a vector.
    pub fn coordinates(&self, vector: [Ball; 2]) -> Option<[Ball; 2]> {
        let xi = cross(vector, point(self.across)).checked_div(self.determinant)?;
        let eta = cross(point(self.along), vector).checked_div(self.determinant)?;
        Some([xi, eta])
    }

    /// Holds the coordinates of a state, `turns` forcing periods earlier.
    pub fn place(&self, [u, w]: [Ball; 2], turns: f64) -> Option<[Ball; 2]> {
        let [centre, speed] = point(self.centre);
        self.coordinates([u - Ball::exact(turns) - centre, w - speed])
    }

    /// Holds the vector of coordinates.
    pub fn vector(&self, xi: Ball, eta: Ball) -> [Ball; 2] {
        [0, 1].map(|i| xi * Ball::exact(self.along[i]) + eta * Ball::exact(self.across[i]))
    }

    /// Holds the state of coordinates.
    pub fn state(&self, xi: Ball, eta: Ball) -> [Ball; 2] {
        let [u, w] = self.vector(xi, eta);
        [u + Ball::exact(self.centre[0]), w + Ball::exact(self.centre[1])]
    }

    /// Whether no state of `other`, `turns` forcing periods earlier, is proved to be between two opposite edges of this parallelogram.
    fn parts(&self, other: &Self, turns: f64) -> bool {
        let Some(centre) = self.place(point(other.centre), turns) else { return false };
        let (Some(a), Some(b)) = (self.coordinates(point(other.along)), self.coordinates(point(other.across))) else {
            return false;
        };
        (0..2).any(|i| {
            is_positive(Ball::exact(least(centre[i])) - Ball::exact(1.0).widened(a[i].mag()).widened(b[i].mag()))
        })
    }

    /// Whether this parallelogram and `other` have no state in common, also whole forcing periods earlier or later, if both are near. Lemma D25
    pub fn is_apart(&self, other: &Self) -> bool {
        (-3..=3).all(|turns| self.is_parted(other, f64::from(turns)))
    }

    /// Whether the parallelogram is disjoint from its translates by whole forcing periods: by convexity one translate is enough. Lemma D9
    pub fn is_apart_from_its_translates(&self) -> bool {
        self.is_parted(self, 1.0)
    }

    fn is_parted(&self, other: &Self, turns: f64) -> bool {
        self.parts(other, turns) || other.parts(self, -turns)
    }

    /// Whether all phases are from -1 to 2 and all speeds positive, which those of the h-set need not imply. Lemma D25
    pub fn is_near(&self) -> bool {
        let [u, w] = [0, 1].map(|i| Ball::new(self.centre[i], 0.0).widened(self.along[i].abs() + self.across[i].abs()));
        is_positive(u + Ball::exact(1.0)) && is_positive(Ball::exact(2.0) - u) && is_positive(w)
    }
}
