//! H-sets: convex quadrilaterals, disjoint in exact fractions (Lemma V12).

use num_rational::BigRational;
use num_traits::Signed;

use super::beam::State;
use impact_pair_document::{Corner, CornersDocument};

/// A left or a right edge, from its lower to its upper end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Chord {
    pub bottom: State,
    pub top: State,
}

/// A quadrilateral of states by its left and its right edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct HSet {
    pub left: Chord,
    pub right: Chord,
}

type Exact = [BigRational; 2];

/// Phases of h-sets are within N forcing periods of 0, so that any two of them are this much apart at most.
const LARGEST_PHASE: f64 = 4.0;
const SHIFTS: i64 = 8;

impl HSet {
    pub fn of(CornersDocument { left, right }: &CornersDocument) -> Self {
        let chord = |[bottom, top]: [Corner; 2]| Chord { bottom: bottom.0, top: top.0 };
        Self { left: chord(*left), right: chord(*right) }
    }

    /// Counter-clockwise.
    fn corners(&self) -> [State; 4] {
        [self.left.bottom, self.right.bottom, self.right.top, self.left.top]
    }

    /// The corners as fractions; `None` where one is no finite number.
    pub fn exact(&self) -> Option<[Exact; 4]> {
        let corner = |[u, w]: State| Some([BigRational::from_float(u)?, BigRational::from_float(w)?]);
        let [a, b, c, d] = self.corners().map(corner);
        Some([a?, b?, c?, d?])
    }

    /// Returns whether it is convex, its tops to the left, its speeds positive, and its phases not far.
    pub fn is_sound(&self) -> bool {
        let is_near = self.corners().iter().all(|[u, w]| u.abs() < LARGEST_PHASE && w.is_finite() && *w > 0.0); // V12: these states
        let turns = |corners: [Exact; 4]| {
            (0..4).all(|i| side(&corners[i], &corners[(i + 1) % 4], &corners[(i + 2) % 4]).is_positive())
        };
        is_near && self.exact().is_some_and(turns)
    }

    /// Returns whether it has no state in common with another one, whole forcing periods later or earlier either.
    pub fn is_apart(&self, other: &Self) -> bool {
        let (Some(one), Some(two)) = (self.exact(), other.exact()) else { return false };
        // Beyond these shifts their phases are apart.
        (-SHIFTS..=SHIFTS).all(|turns| {
            let later = later(&two, turns);
            is_parted(&one, &later) || is_parted(&later, &one)
        })
    }

    /// Returns whether it has no state in common with itself whole forcing periods later: none one forcing period later, and so, as it is convex, none (D9).
    pub fn is_apart_from_its_translates(&self) -> bool {
        let Some(one) = self.exact() else { return false };
        let later = later(&one, 1);
        is_parted(&one, &later) || is_parted(&later, &one)
    }
}

/// The corners N forcing periods later.
fn later(corners: &[Exact; 4], turns: i64) -> [Exact; 4] {
    corners.clone().map(|[u, w]| [u + BigRational::from_integer(turns.into()), w])
}

/// Positive where the third one is to the left of the way from the first to the second.
fn side(from: &Exact, to: &Exact, state: &Exact) -> BigRational {
    (&to[0] - &from[0]) * (&state[1] - &from[1]) - (&to[1] - &from[1]) * (&state[0] - &from[0])
}

/// Returns whether an edge of the first, which is convex, has all of the second on its outer side.
fn is_parted(one: &[Exact; 4], two: &[Exact; 4]) -> bool {
    (0..4).any(|i| two.iter().all(|state| side(&one[i], &one[(i + 1) % 4], state).is_negative()))
}
