//! One base in coordinates of its own: along its leaf and across it, the base itself from -1 to 1 in both.

use impact_pair::chaos::{Base, Chaos, State};

use super::{RIGHT, layers, round};
use crate::picture::{Axis, Canvas, Drawn, Plane};

/// How far is shown, in half sides of the base.
const SHOWN: f64 = 1.3;

/// The coordinates of a base, exact for a parallelogram.
pub struct Leaf {
    centre: State,
    along: State,
    across: State,
}

impl Leaf {
    pub fn of(base: &Base) -> Self {
        let [a, b, c, d, _] = round(base);
        let of = |signs: [f64; 4]| {
            [0, 1].map(|i| 0.25 * (signs[0] * a[i] + signs[1] * b[i] + signs[2] * c[i] + signs[3] * d[i]))
        };
        Self { centre: of([1.0; 4]), along: of([-1.0, 1.0, 1.0, -1.0]), across: of([-1.0, -1.0, 1.0, 1.0]) }
    }

    /// Where a state is, the phase less whole turns.
    fn place(&self, state: &State) -> State {
        let (phase, w) = (state[0] - self.centre[0], state[1] - self.centre[1]);
        let u = phase - phase.round();
        let ([a, b], [c, d]) = (self.along, self.across);
        let area = a * d - b * c;
        [(u * d - w * c) / area, (a * w - b * u) / area]
    }

    /// The base with what lies across it.
    pub fn draw(&self, found: &Chaos, area: &Canvas<'_>, root: &Canvas<'_>) -> Drawn {
        let axes = [Axis::over(-SHOWN, SHOWN), Axis::over(-SHOWN, SHOWN)];
        let names = ["along the base, in half lengths of it", "across the base, in half widths of it"];
        let plane = Plane::draw(area, axes, names, RIGHT)?;
        let is_shown = |place: &State| place.iter().all(|part| part.abs() <= SHOWN);
        let states = found.attractor().iter().map(|state| self.place(state)).filter(is_shown).collect();
        layers(found, (&|curve: &[State]| self.pieces(curve), states), &plane, root)
    }

    /// What of a curve may be seen.
    fn pieces(&self, curve: &[State]) -> Vec<Vec<State>> {
        let places: Vec<State> = curve.iter().map(|state| self.place(state)).collect();
        let is_seen = |pair: &[State]| {
            (0..2).all(|i| pair[0][i].min(pair[1][i]) <= SHOWN && pair[0][i].max(pair[1][i]) >= -SHOWN)
        };
        let mut pieces: Vec<Vec<State>> = Vec::new();
        for pair in places.windows(2).filter(|pair| is_seen(pair)) {
            match pieces.last_mut().filter(|piece| piece.last() == Some(&pair[0])) {
                Some(piece) => piece.push(pair[1]),
                None => pieces.push(pair.to_vec()),
            }
        }
        pieces
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_base_is_its_own_square() {
        let leaf = Leaf::of(&Base::new([0.9, 1.2], [0.03, 0.08], [-0.0002, 0.001]));
        let near = |at: State, place: State| (0..2).all(|i| (leaf.place(&at)[i] - place[i]).abs() < 1e-9);
        assert!(near([0.9, 1.2], [0.0, 0.0]) && near([0.93, 1.28], [1.0, 0.0]) && near([0.8998, 1.201], [0.0, 1.0]));
        // A turn later.
        assert!(near([1.8702, 1.119], [-1.0, -1.0]));
    }

    #[test]
    fn curves_are_kept_where_they_may_be_seen() {
        let leaf = Leaf::of(&Base::new([0.5, 1.0], [0.1, 0.0], [0.0, 0.1]));
        let across = |speeds: &[f64]| speeds.iter().map(|w| [0.5, *w]).collect::<Vec<State>>();
        assert_eq!(leaf.pieces(&across(&[0.5, 0.8, 0.9, 1.0])).concat().len(), 3);
        assert_eq!(leaf.pieces(&across(&[0.5, 1.0, 1.5, 1.6, 0.9])).len(), 2);
    }
}
