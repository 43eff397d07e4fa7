//! Images of the half sides of a cell under the derivative: Lemma D24 (sides) of `docs/proofs/hyperbolic.md#D24`.

use crate::chaos::flights::Landing;
use crate::chaos::frame::cross;
use crate::number::{Ball, Number, up};

/// Two vectors at each state of a cell, the second one being `part first + rest`.
///
/// **Enclosure**: the vectors, the number `part`, and the determinant of `first` and `rest`, at each state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sides {
    pub first: [Ball; 2],
    part: Ball,
    rest: [Ball; 2],
    area: Ball,
}

impl Sides {
    pub fn new(first: [Ball; 2], second: [Ball; 2]) -> Self {
        Self { first, part: Ball::exact(0.0), rest: second, area: cross(first, second) }
    }

    pub fn second(&self) -> [Ball; 2] {
        self.combined(Ball::exact(0.0), Ball::exact(1.0))
    }

    pub fn both(&self) -> [[Ball; 2]; 2] {
        [self.first, self.second()]
    }

    /// Upper bound of the modulus of a coordinate over all sums of parts of both sides, from -1 to 1.
    pub fn reach(&self, axis: usize) -> f64 {
        up(self.first[axis].mag() + self.second()[axis].mag())
    }

    /// Holds the sum of multiples of both, at each state.
    pub fn combined(&self, first: Ball, second: Ball) -> [Ball; 2] {
        let along = first + self.part * second;
        [0, 1].map(|i| self.first[i] * along + self.rest[i] * second)
    }

    /// Sides of the images of states. Given: the coefficient of restitution, the speeds before the flight, and the speeds of the middle's
    /// image after it.
    pub fn landed(&self, landing: &Landing<2>, [restitution, before, after]: [Ball; 3]) -> Self {
        let [first, rest] = [self.first, self.rest].map(|side| landing.derivative(side));
        let moved = Self { first, rest, area: cross(first, rest), ..*self };
        let after = after.widened(moved.reach(1));
        let by = (restitution * restitution * before).checked_div(after);
        by.map_or(moved, |by| Self { area: self.area * by, ..moved }.split_along_first())
    }

    /// The vectors, with the component of `rest` along `first` added to `part`.
    fn split_along_first(self) -> Self {
        let [u, w] = self.first.map(Ball::mid);
        // D24: any vector
        let normal = [-w, u].map(Ball::exact);
        let along = cross(self.first, normal);
        let (Some(part), Some(length)) = (cross(self.rest, normal).checked_div(along), self.area.checked_div(along))
        else {
            return self;
        };
        Self { part: self.part + part, rest: normal.map(|x| x * length), ..self }
    }

    /// The vectors in other coordinates, `None` where these are not known.
    pub fn seen(&self, coordinates: impl Fn([Ball; 2]) -> Option<[Ball; 2]>) -> Option<Self> {
        let (first, rest) = (coordinates(self.first)?, coordinates(self.rest)?);
        Some(Self { first, rest, area: cross(first, rest), ..*self })
    }
}
