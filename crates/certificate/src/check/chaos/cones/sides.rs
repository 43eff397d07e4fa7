//! Images of the half sides of a cell under the derivative (Lemma V14, half sides).

use super::super::beam::{Landing, Spot};
use super::super::span::Span;

/// Two vectors at each state of a cell, the second one being `part first + rest`.
///
/// **Enclosure**: the vectors, the number and the slope with which the first one is a multiple of `(1, slope)`, as far as they are known, the number
/// `part`, and the determinant of `first` and `rest`, at each state.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sides {
    pub first: Spot,
    line: Option<[Span; 2]>,
    part: Span,
    rest: Spot,
    area: Span,
}

/// The number and the slope of a vector; `None` where its phase may be 0.
fn line([u, w]: Spot) -> Option<[Span; 2]> {
    Some([u, w.over(u)?])
}

/// Holds what two enclosures of the same vectors have in common.
fn both(one: Spot, other: Option<Spot>) -> Spot {
    // V14: both hold the same ones
    [0, 1].map(|i| other.and_then(|other| one[i].common(other[i])).unwrap_or(one[i]))
}

pub(super) fn cross([a, b]: Spot, [c, d]: Spot) -> Span {
    a * d - b * c
}

impl Sides {
    pub fn new(first: Spot, second: Spot) -> Self {
        Self { first, line: line(first), part: Span::point(0.0), rest: second, area: cross(first, second) }
    }

    pub fn second(&self) -> Spot {
        [0, 1].map(|i| self.part * self.first[i] + self.rest[i])
    }

    /// Holds a coordinate of all sums of parts of both, from -1 to 1.
    pub fn spread(&self, i: usize) -> Span {
        self.first[i].around() + self.second()[i].around()
    }

    /// Returns the sides of the image of states of these speeds, `centre` being that of their middle.
    pub fn landed(&self, landing: &Landing, (restitution, speed): (Span, Span), centre: Spot) -> Self {
        let line = self.line.or_else(|| line(self.first)).and_then(|[length, slope]| {
            let [by, slope] = landing.direction(slope)?;
            Some([length * by, slope])
        });
        let [first, rest] = [self.first, self.rest].map(|side| landing.derivative(side));
        let first = both(first, line.map(|[length, slope]| [length, length * slope]));
        let moved = Self { first, line, rest, area: cross(first, rest), ..*self };
        let after = centre[1] + moved.spread(1);
        let area = (restitution * restitution * speed).over(after).map(|by| self.area * by);
        area.map_or(moved, |area| Self { area, ..moved }.split_along_first())
    }

    /// The same vectors, with what the rest has along the first one counted to its part.
    fn split_along_first(self) -> Self {
        let [u, w] = self.first.map(Span::mid);
        // V14: any vector
        let normal = [-w, u].map(Span::point);
        let along = cross(self.first, normal);
        let (Some(part), Some(length)) = (cross(self.rest, normal).over(along), self.area.over(along)) else {
            return self;
        };
        Self { part: self.part + part, rest: normal.map(|x| x * length), ..self }
    }

    /// The vectors in other coordinates, `None` where these are not known.
    pub fn seen(&self, coordinates: impl Fn(Spot) -> Option<Spot>) -> Option<Self> {
        let (first, rest) = (coordinates(self.first)?, coordinates(self.rest)?);
        let along =
            self.line.and_then(|[length, slope]| Some(coordinates([Span::point(1.0), slope])?.map(|x| x * length)));
        let first = both(first, along);
        Some(Self { first, line: None, rest, area: cross(first, rest), ..*self })
    }

    /// Holds the sum of multiples of both, at each state.
    pub fn combined(&self, first: Span, second: Span) -> Spot {
        [0, 1].map(|i| self.first[i] * (first + self.part * second) + self.rest[i] * second)
    }
}

#[cfg(test)]
mod tests {
    use impact_pair_model::watch::Unwatched;

    use super::super::super::allowance::Allowance;
    use super::super::super::bases::Chord;
    use super::super::super::bases::HSet;
    use super::super::super::beam::FlightBundle;
    use super::super::super::guess::Guess;
    use super::super::super::tests::figure_14;
    use super::super::strip::{Branch, Cell, Frame, Map, Strip};
    use super::*;

    /// The image of `(1, slope)` by its number and slope is that of the derivative.
    #[test]
    fn directions_are_those_of_derivatives() {
        let (law, middle) = (figure_14(), [0.72, 1.25]);
        let image = Guess::new(&law).map(middle).expect("a flight");
        let at = middle.map(Span::point);
        let bundle = FlightBundle::of(&law, at, at, [[Span::point(0.0); 2]; 3]);
        let landing = bundle.land(image.is_far, image.time).expect("a first contact");
        for slope in [-30.0, -2.0, 0.0, 0.5, 7.0].map(Span::point) {
            let [by, next] = landing.direction(slope).expect("a direction");
            for (one, other) in [by, by * next].into_iter().zip(landing.derivative([Span::point(1.0), slope])) {
                let away = one - other;
                assert!(away.lo() <= 0.0 && 0.0 <= away.hi() && away.hi() - away.lo() < 1e-9, "{one:?} {other:?}");
            }
        }
    }

    /// Derivatives along orbits in doubles are an independent route: the map's Jacobian by its implicit function.
    #[test]
    fn derivatives_of_a_cell_hold_those_at_its_states() {
        let (law, allowance) = (figure_14(), Allowance::new(1 << 40, &Unwatched));
        let guess = Guess::new(&law);
        let at = |u: f64, w: f64| [u, w];
        let base = HSet {
            left: Chord { bottom: at(0.70, 1.2), top: at(0.70, 1.3) },
            right: Chord { bottom: at(0.74, 1.2), top: at(0.74, 1.3) },
        };
        let frame = Frame::of(&base);
        let strip = Strip { left: [-0.5, 0.0], right: [0.5, 0.0] };
        let mut flights = Vec::new();
        let mut state = frame.centre;
        for _ in 0..4 {
            let image = guess.map(state).expect("a flight");
            flights.push(image.is_far);
            state = image.state;
        }
        let branch = Branch { from: 0, to: 0, flights, half_cycles: 4, turns: 4.0, strip, rises: true };
        let map = Map { law: &law, guess: &guess, frames: &[frame], work: &allowance };
        let cell = Cell { across: [-0.001, 0.001], heights: [-0.02, 0.02] };
        let image = map.image(&branch, cell, &|_, _, _| true).unwrap().expect("an image");
        for (a, b) in [(-1.0, -1.0), (-1.0, 1.0), (0.0, 0.3), (1.0, -1.0), (1.0, 1.0)] {
            let mut state = [0, 1].map(|i| frame.centre[i] + 0.0005 * a * frame.along[i] + 0.02 * b * frame.across[i]);
            let mut sides = [frame.along.map(|x| 0.0005 * x), frame.across.map(|x| 0.02 * x)];
            for _ in &branch.flights {
                let next = guess.map(state).expect("a flight");
                let [row, other] = next.jacobian;
                sides = sides.map(|[u, w]| [row[0] * u + row[1] * w, other[0] * u + other[1] * w]);
                state = next.state;
            }
            let [first, second] = sides.map(|side| frame.coordinates(side.map(Span::point)).expect("coordinates"));
            let holds = |known: Spot, side: Spot| {
                (0..2).all(|i| known[i].lo() - 1e-9 <= side[i].mid() && side[i].mid() <= known[i].hi() + 1e-9)
            };
            assert!(holds(image.sides.first, first) && holds(image.sides.second(), second), "{image:?} {sides:?}");
            let known = image.sides.combined(Span::point(-3.0), Span::point(2.0));
            let sum = [0, 1].map(|i| Span::point(-3.0 * first[i].mid() + 2.0 * second[i].mid()));
            assert!(holds(known, sum), "{sum:?} is not in {known:?}");
            // The rest is known far better than a product of intervals would have it.
            assert!(
                image
                    .sides
                    .rest
                    .iter()
                    .all(|x| x.hi() - x.lo() < 0.1 * (second[1].mid().abs() + second[0].mid().abs()))
            );
        }
    }
}
