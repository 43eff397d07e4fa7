//! Sets of states that move with the parameters, followed from one impact to the next: one that lies in an earlier one holds a stable periodic
//! orbit (Lemma V36).

use std::f64::consts::TAU;

use super::super::Law;
use super::super::beam::{FlightBundle, Spot, State};
use super::super::guess::{Guess, applied};
use super::super::span::Span;

/// States `middle + a sides[0] + b sides[1] + c moved[0] + d moved[1]`, where `c` and `d` tell `e` and `D`, all of them in `[-1, 1]`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Set {
    pub middle: State,
    sides: [State; 2],
    moved: [State; 2],
    /// Whole forcing periods that were taken off the phase.
    pub turns: f64,
}

/// A set, and whether its states are on the other wall than those of which they are the images; the time of about its middle's flight.
pub(super) struct Landed {
    pub set: Set,
    pub is_far: bool,
    pub time: f64,
}

/// Sides are that much longer than they have to be, so that it can be proved that they are long enough.
const SIDE_FACTOR: f64 = 1.0 + 1.0 / (1 << 20) as f64; // exact: a power of two
/// Wider sets are not followed.
const MAX_WIDTH: f64 = 0.2;

fn spot(state: State) -> Spot {
    state.map(Span::point)
}

/// Length of a difference of states, phase in radians and speed.
fn length([u, w]: State) -> f64 {
    (TAU * u).hypot(w)
}

/// The two vectors whose products with a vector are its coordinates by two sides; `None` if these are not proved to be independent.
fn coordinates([p, q]: [State; 2]) -> Option<[Spot; 2]> {
    let [[a, b], [c, d]] = [p, q].map(spot);
    let area = a * d - b * c;
    let over = |x: Span| x.over(area);
    Some([[over(d)?, over(-c)?], [over(-b)?, over(a)?]])
}

fn product(n: &Spot, [u, w]: Spot) -> Span {
    n[0] * u + n[1] * w
}

impl Set {
    /// The states of which a phase, less whole forcing periods, and a speed are between bounds.
    pub fn around([phase, speed]: Spot) -> Self {
        let ([u, ahead], [w, faster]) = (halved(phase), halved(speed));
        let ahead = ahead + f64::EPSILON; // V36: larger sets hold as much, and are not a line
        Self { middle: [u, w], sides: [[ahead, 0.0], [0.0, faster]], moved: [[0.0; 2]; 2], turns: 0.0 }
    }

    /// Returns the set of the images; `None` where it is not proved that all of them are on one wall, without a graze.
    pub fn next(&self, law: &Law, guess: &Guess) -> Option<Landed> {
        let Self { middle, sides, moved, turns } = *self;
        if sides.iter().any(|side| length(*side) > MAX_WIDTH) {
            return None; // exact: given up, nothing is certified
        }
        let spread = |i: usize| {
            sides.iter().chain(&moved).fold(Span::point(middle[i]), |all, side| all + Span::point(side[i]).around())
        };
        let beam = FlightBundle::moved(
            law,
            [spread(0), spread(1)],
            spot(middle),
            [sides[0], sides[1], moved[1]].map(spot),
            spot(moved[0]),
        );
        // proposes: where the images are, and how they lie there
        let image = guess.map(middle)?;
        let passed = image.state[0].floor(); // exact: whole forcing periods
        let to = [image.state[0] - passed, image.state[1]];
        let [by_gap, by_restitution] = image.moved;
        let moves = |by: State, own: State| {
            let [u, w] = applied(image.jacobian, by);
            [u + own[0], w + own[1]]
        };
        let moved = [moves(moved[0], by_restitution), moves(moved[1], by_gap)];
        let directions = square(sides.map(|side| applied(image.jacobian, side)));
        let landing = beam.land(image.is_far, image.time)?;
        let there = [Span::point(to[0]) + Span::point(passed), Span::point(to[1])];
        let reach = |sides: [State; 2]| -> Option<[f64; 2]> {
            Some(coordinates(sides)?.map(|n| landing.beside(n, there, moved.map(spot)).most()))
        };
        let long = reach(directions)?;
        let sides = [0, 1].map(|i| directions[i].map(|x| x * long[i] * SIDE_FACTOR));
        // V36: the sides reach as far as the images; no comparison with NaN holds
        if !reach(sides)?.iter().all(|reach| *reach <= 1.0) {
            return None;
        }
        let set = Self { middle: to, sides, moved, turns: turns + passed };
        Some(Landed { set, is_far: image.is_far, time: image.time })
    }

    /// Approximate distance of the middles of two sets, phases modulo whole forcing periods: in radians and speeds.
    pub fn away(&self, other: &Self) -> f64 {
        apart(self.middle, other.middle)
    }

    /// Returns the set with sides that are at least twice as long, and at least of a length.
    pub fn with_room(self, least: f64) -> Self {
        let longer = |side: State| {
            let power = (least / length(side)).log2().ceil().clamp(1.0, 64.0); // proposes: longer sides hold as much
            side.map(|x| x * power.exp2())
        };
        Self { sides: self.sides.map(longer), ..self }
    }

    /// Returns the whole forcing periods by which another one has to be shifted to lie inside this one, for all parameters; `None` where that is not proved.
    pub fn holds(&self, other: &Self) -> Option<f64> {
        let reach: f64 = self.sides.iter().map(|side| length(*side)).sum();
        if self.away(other) > reach {
            return None; // V36: not proved
        }
        let shift = (other.middle[0] - self.middle[0]).round(); // V36: any whole number
        let less = |x: Spot, y: Spot| [x[0] - y[0], x[1] - y[1]];
        let mut away = less(spot(other.middle), spot(self.middle));
        away[0] = away[0] - Span::point(shift);
        let is_inside = |n: &Spot| {
            let moved = [0, 1].map(|k| less(spot(other.moved[k]), spot(self.moved[k])));
            let all = [away, spot(other.sides[0]), spot(other.sides[1])].into_iter().chain(moved);
            let sum = all.fold(Span::point(0.0), |sum, by| sum + Span::point(product(n, by).most()));
            (Span::point(1.0) - sum).is_positive()
        };
        coordinates(self.sides)?.iter().all(is_inside).then_some(shift)
    }
}

/// Two states' distance, whole forcing periods aside, about: in radians and speeds.
pub(super) fn apart([u, w]: State, [v, x]: State) -> f64 {
    let ahead = u - v;
    length([ahead - ahead.round(), w - x]) // proposes: where to look
}

/// The middle of a span, and how far its ends are from it at most.
fn halved(x: Span) -> [f64; 2] {
    let (middle, around) = x.centred_parts();
    [middle.mid(), around.hi()]
}

/// A direction of length 1 along the longer one of two vectors, and the one square to it.
fn square([p, q]: [State; 2]) -> [State; 2] {
    let [u, w] = if length(p) > length(q) { p } else { q };
    let size = length([u, w]);
    [[u / size, w / size], [-w / (TAU * size), TAU * u / size]]
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRACTIONS: [f64; 5] = [-1.0, -0.5, 0.0, 0.5, 1.0];

    /// All parts of both sides, and of what `e` and `D` move.
    fn parts() -> impl Iterator<Item = [f64; 4]> {
        (0..FRACTIONS.len().pow(4)).map(|k| [1, 5, 25, 125].map(|step| FRACTIONS[k / step % 5]))
    }

    fn state(set: &Set, parts: [f64; 4]) -> State {
        let by = set.sides.iter().chain(&set.moved).zip(parts);
        by.fold(set.middle, |[u, w], (by, part)| [u + part * by[0], w + part * by[1]])
    }

    /// Returns whether a state is one of a set, phases modulo whole forcing periods, for these parameters.
    fn is_in(set: &Set, at: State, [_, _, c, d]: [f64; 4]) -> bool {
        let middle = state(set, [0.0, 0.0, c, d]);
        let ahead = at[0] - middle[0];
        let away = [ahead - ahead.round(), at[1] - middle[1]];
        let [[a, b], [p, q]] = set.sides;
        let area = a * q - b * p;
        [away[0] * q - away[1] * p, a * away[1] - b * away[0]].iter().all(|part| (part / area).abs() <= 1.0)
    }

    /// Each state of a set has its image in the next one, for the parameters that it moves with, where each of sides and moves is long.
    #[test]
    fn v36_the_next_set_holds_the_images_of_all_states() {
        let laws = [
            ([2.0, 2.04], [0.5, 0.53]),
            ([2.0, 2.0], [0.5, 0.5]),
            ([1.2, 1.23], [0.8, 0.8]),
            ([3.0, 3.0], [0.2, 0.24]),
        ];
        let long = [[[0.01, 0.0], [0.0, 0.03]], [[0.001, 0.03], [0.0, 0.001]]];
        let short = [[1e-6, 0.0], [0.0, 1e-6]];
        let still = [[0.0; 2]; 2];
        for (gap, restitution) in laws {
            for [sides, moved] in
                [[long[0], still], [long[1], long[0]], [short, long[0]], [short, long[1]], [short, still]]
            {
                for middle in [[0.1, 1.5], [0.6, 2.0], [0.95, 1.0]] {
                    let law =
                        Law { gap: Span::new(gap[0], gap[1]), restitution: Span::new(restitution[0], restitution[1]) };
                    let set = Set { middle, sides, moved, turns: 0.0 };
                    let Landed { set: next, is_far, .. } =
                        set.next(&law, &Guess::new(&law)).expect("all are on one wall");
                    for parts in parts() {
                        let [gap, restitution] = [(law.gap, parts[3]), (law.restitution, parts[2])]
                            .map(|(x, part)| Span::point(x.mid() + part * 0.5 * (x.hi() - x.lo())));
                        let image = Guess::new(&Law { gap, restitution }).map(state(&set, parts)).expect("it lands");
                        assert!(
                            image.is_far == is_far && is_in(&next, image.state, parts),
                            "{law:?} {set:?} {parts:?}"
                        );
                    }
                }
            }
        }
    }

    /// A move of a set is mapped by the derivative to a move of its image, and makes no side longer, up to squares.
    #[test]
    fn v36_what_moves_a_set_is_no_side_of_its_image() {
        let law = Law { gap: Span::point(2.0), restitution: Span::point(0.5) };
        for moved in [[[1e-4, 0.0], [0.0; 2]], [[0.0; 2], [0.0, 1e-4]], [[0.0; 2], [1e-4, 1e-4]]] {
            let set = Set { middle: [0.1, 1.5], sides: [[1e-9, 0.0], [0.0, 1e-9]], moved, turns: 0.0 };
            let next = set.next(&law, &Guess::new(&law)).expect("all are on one wall").set;
            let longest = |sides: [State; 2]| sides.map(length).into_iter().fold(0.0, f64::max);
            assert!(longest(next.sides) < 0.01 * longest(next.moved), "{next:?}");
        }
    }

    /// A set is inside another one with its sides and all that moves it, whole forcing periods aside, and by how many.
    #[test]
    fn v36_a_set_holds_no_more_than_its_states() {
        let sides = |by: f64| [[0.75 * by, 0.0], [0.25 * by, by]];
        let whole = Set { middle: [0.5, 1.0], sides: sides(0.01), moved: [[0.02, 0.01], [0.01, 0.03]], turns: 0.0 };
        let beside = |middle: State, part: f64, [e, gap]: State| {
            let moved = [whole.moved[0].map(|x| x + e), whole.moved[1].map(|x| x + gap)];
            Set { middle, sides: sides(0.01 * part), moved, ..whole }
        };
        let inside = [([0.5, 1.0], 0.9, [0.0; 2]), ([0.5, 1.003], 0.6, [0.0; 2]), ([0.5, 1.0], 0.5, [0.001, 0.002])];
        let outside = [
            ([0.5, 1.0], 1.1, [0.0; 2]),
            ([0.5, 1.005], 0.6, [0.0; 2]),
            ([0.506, 1.0], 0.4, [0.0; 2]),
            ([0.5, 1.0], 0.5, [0.008, 0.0]),
            ([0.5, 1.0], 0.5, [0.0, 0.008]),
            ([0.5, 1.0], 0.5, [0.004, 0.004]),
        ];
        for ((middle, part, moved), is_inside) in
            inside.map(|set| (set, true)).into_iter().chain(outside.map(|set| (set, false)))
        {
            let other = beside(middle, part, moved);
            assert_eq!(whole.holds(&other).is_some(), is_inside, "{other:?}");
            assert_eq!(parts().all(|parts| is_in(&whole, state(&other, parts), parts)), is_inside, "{other:?}");
        }
        for ahead in [-1.0, 0.0, 2.0] {
            assert_eq!(whole.holds(&beside([0.501 + ahead, 1.0], 0.5, [0.0; 2])), Some(ahead));
        }
    }
}
