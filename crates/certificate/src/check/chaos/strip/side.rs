//! Strips of a document: the states between two curves across an h-set (Lemma V39).

use impact_pair_document::StripDocument;

use super::super::bases::HSet;
use super::super::cones::Frame;
use super::super::span::Span;
use super::curve::{Curve, Heights, Shift};

/// The states between two curves, from below an h-set to above it.
#[derive(Clone, Debug)]
pub(super) struct Strip {
    pub left: Curve,
    pub right: Curve,
}

impl Strip {
    /// Reads a strip; `None` if its sides are no curves.
    pub fn read(document: &StripDocument) -> Option<Self> {
        let StripDocument { left, right, moved } = document;
        let left = Curve::read(left, moved.iter().map(|moved| (moved, &moved.left)))?;
        Some(Self { left, right: Curve::read(right, moved.iter().map(|moved| (moved, &moved.right)))? })
    }

    /// Returns the strip for some of the parameters.
    pub fn of(&self, shift: Shift) -> Self {
        Self { left: self.left.of(shift), right: self.right.of(shift) }
    }

    /// Returns whether both sides separate the left edge of an h-set from its right one within it, the left side being left of the right one.
    pub fn parts(&self, frame: &Frame, base: &HSet) -> bool {
        let Some(heights) = Heights::of(frame, base) else { return false };
        let places = [base.left.bottom, base.left.top, base.right.bottom, base.right.top]
            .map(|corner| frame.place(corner.map(Span::point), 0.0));
        let [Some(a), Some(b), Some(c), Some(d)] = places else { return false };
        let [left, right] = [a[0].hull(b[0]).hi(), c[0].hull(d[0]).lo()].map(Curve::upright);
        left.is_before(&self.left, &heights)
            && self.left.is_before(&self.right, &heights)
            && self.right.is_before(&right, &heights)
    }
}

/// The first two of some strips across one h-set that are not proved to have no state in common; each has its sides in order.
pub(super) fn overlap(strips: &[(usize, &Strip)], heights: &Heights) -> Option<[usize; 2]> {
    let mut strips = strips.to_vec();
    let middle = |strip: &Strip| strip.left.at(Span::point(0.0)).mid();
    // proposes: an order, in which neighbours are compared
    strips.sort_by(|(_, one), (_, other)| middle(one).total_cmp(&middle(other)));
    strips
        .windows(2)
        .find(|pair| !pair[0].1.right.is_before(&pair[1].1.left, heights))
        .map(|pair| [pair[0].0, pair[1].0])
}

#[cfg(test)]
mod tests {
    use impact_pair_document::{Decimal, MovedDocument};

    use super::super::super::bases::Chord;
    use super::*;

    fn document(left: &[&str], right: &[&str]) -> StripDocument {
        let side = |places: &[&str]| places.iter().map(|&place| Decimal::printed(place.to_owned())).collect();
        StripDocument { left: side(left), right: side(right), moved: Vec::new() }
    }

    fn strip(left: &[&str], right: &[&str]) -> Strip {
        Strip::read(&document(left, right)).expect("a strip")
    }

    #[test]
    fn sides_have_some_finite_coefficients() {
        assert!(Strip::read(&document(&["0"], &["1", "2", "3"])).is_some());
        let many = vec!["0"; 33];
        let bad: [(&[&str], &[&str]); 4] = [(&[], &[]), (&["0"], &[]), (&["0", "1e400"], &["1", "1"]), (&many, &["1"])];
        for (left, right) in bad {
            assert!(Strip::read(&document(left, right)).is_none(), "{left:?} {right:?}");
        }
        assert!(Strip::read(&document(&many[1..], &["1"])).is_some());
    }

    #[test]
    fn sides_move_with_some_powers() {
        let read = |all: &[[u32; 2]]| {
            let side = || vec![Decimal::printed("1".to_owned())];
            let moved = |&by: &[u32; 2]| MovedDocument { by, left: side(), right: side() };
            Strip::read(&StripDocument { moved: all.iter().map(moved).collect(), ..document(&["0"], &["1"]) })
        };
        assert!(read(&[[1, 0], [0, 1], [8, 8]]).is_some());
        for bad in [&[[0, 0]][..], &[[9, 0]], &[[1, 1], [1, 0], [1, 1]]] {
            assert!(read(bad).is_none(), "{bad:?}");
        }
    }

    /// The sides reach from below the h-set to above it, and no place is beside it.
    #[test]
    fn sides_part_the_h_set() {
        let base = |lean: f64| HSet {
            left: Chord { bottom: [0.0, 1.0], top: [0.0, 1.5 + lean] },
            right: Chord { bottom: [0.5, 1.0], top: [0.5, 1.5 - lean] },
        };
        let even = base(0.0);
        let parts = |base: &HSet, left: &[&str], right: &[&str]| strip(left, right).parts(&Frame::of(base), base);
        assert!(parts(&even, &["-0.85", "0.05"], &["0.85", "-0.05"]));
        for (left, right) in [
            (["-0.9", "0.11"], ["0.85", "0"]),
            (["-0.85", "0"], ["0.95", "0.06"]),
            (["0.85", "-0.05"], ["-0.85", "0.05"]),
            (["0", "0.5"], ["0.5", "0"]),
        ] {
            assert!(!parts(&even, &left, &right), "{left:?} {right:?}");
        }
        assert!(!parts(&even, &["-0.5", "0", "0", "0", "-0.6"], &["0"]), "beside the h-set at its top and its bottom");
        // An h-set with a corner above its parallelogram: strips reach there as well.
        let bent = ["-0.9", "0", "0", "0", "-0.01"];
        assert!(parts(&base(1e-11), &bent, &["0.9"]) && parts(&base(0.1), &["-0.5"], &["0.5"]));
        assert!(
            parts(&even, &["-0.9", "0", "-0.09"], &["0.9"]) && !parts(&base(0.1), &["-0.9", "0", "-0.09"], &["0.9"])
        );
    }

    /// Touching is too near.
    #[test]
    fn strips_are_apart_at_all_heights() {
        let all = Heights { low: -1.0, high: 1.0 };
        let low = strip(&["-0.5"], &["0", "0.1"]);
        let next = strip(&["0.05", "0.08", "0.05"], &["0.3"]);
        let bent = strip(&["0.05", "0.08", "-0.05"], &["0.3"]);
        let touching = strip(&["0", "0.1"], &["0.2"]);
        let last = strip(&["0.4", "-0.05"], &["0.5"]);
        assert_eq!(overlap(&[(7, &last), (3, &low), (5, &next)], &all), None);
        assert_eq!(overlap(&[(7, &last), (3, &low), (5, &bent)], &all), Some([3, 5]));
        assert_eq!(overlap(&[(3, &low), (5, &touching)], &all), Some([3, 5]));
        assert_eq!(overlap(&[(3, &low), (5, &low)], &all), Some([3, 5]));
    }
}
