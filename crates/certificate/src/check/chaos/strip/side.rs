//! Strips of a document: the states between two curves across an h-set (Lemma V39).

use impact_pair_document::{Decimal, StripDocument};

use super::super::bases::HSet;
use super::super::cones::Frame;
use super::super::span::Span;

/// A curve across an h-set, in the coordinates of its parallelogram: coefficients of the powers of the height, from the constant on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Curve(Vec<f64>);

/// The states between two curves, from below an h-set to above it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Strip {
    pub left: Curve,
    pub right: Curve,
}

/// Heights from one to another, both dyadic fractions of the whole height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Heights {
    pub low: f64,
    pub high: f64,
}

/// Coefficients of a curve at most.
const MAX_COEFFICIENTS: usize = 32;
/// The topmost height, `1 + 2^-30`: corners of h-sets are within it, though they are rounded.
const TOP: f64 = 1.0 + 1.0 / (1_u64 << 30) as f64; // exact: a power of two
/// Halvings of the whole height where two curves are compared.
const MAX_HALVINGS: u32 = 16;

impl Heights {
    pub const WHOLE: Self = Self { low: -TOP, high: TOP };

    /// Holds all of them.
    pub fn all(&self) -> Span {
        Span::new(self.low, self.high)
    }

    /// Returns the lower and the upper half.
    pub fn halves(&self) -> [Self; 2] {
        let middle = 0.5 * (self.low + self.high); // V39: exact
        [Self { high: middle, ..*self }, Self { low: middle, ..*self }]
    }
}

impl Curve {
    /// Reads a curve; `None` if a coefficient is no finite double, or if there are none, or too many.
    fn read(document: &[Decimal]) -> Option<Self> {
        // V39: the nearest doubles
        let coefficient = |part: &Decimal| part.text().parse().ok().filter(|part: &f64| part.is_finite());
        let is_sound = (1..=MAX_COEFFICIENTS).contains(&document.len());
        is_sound.then(|| document.iter().map(coefficient).collect()).flatten().map(Self)
    }

    /// Holds its places at some heights.
    pub fn at(&self, height: Span) -> Span {
        self.0.iter().rev().fold(Span::point(0.0), |sum, &part| sum * height + Span::point(part))
    }

    /// Bounds how far it is from the straight line between its places at two heights.
    pub fn bulge(&self, heights: &Heights) -> Span {
        let twice = |(k, &part): (usize, &f64)| Span::point((k * k - k) as f64) * Span::point(part); // exact: small numbers
        let bends = self.0.iter().enumerate().skip(2).map(twice).rev();
        let bend = bends.fold(Span::point(0.0), |sum, part| sum * heights.all() + part);
        let height = Span::point(heights.high) - Span::point(heights.low);
        (bend * height * height).scaled(0.125).around()
    }

    /// Returns whether it is left of another curve at all heights.
    fn is_before(&self, other: &Self) -> bool {
        let count = self.0.len().max(other.0.len()); // exact: of two numbers
        let part = |curve: &Self, k: usize| Span::point(curve.0.get(k).copied().unwrap_or(0.0)); // exact: there is none
        let away: Vec<Span> = (0..count).map(|k| part(other, k) - part(self, k)).collect();
        let is_positive = |heights: &Heights| {
            away.iter().rev().fold(Span::point(0.0), |sum, &part| sum * heights.all() + part).is_positive()
        };
        let mut open = vec![(Heights::WHOLE, 0)];
        while let Some((heights, halvings)) = open.pop() {
            if is_positive(&heights) {
                continue;
            }
            if halvings == MAX_HALVINGS {
                return false;
            }
            open.extend(heights.halves().map(|half| (half, halvings + 1)));
        }
        true
    }
}

impl Strip {
    /// Reads a strip; `None` if its sides are no curves.
    pub fn read(document: &StripDocument) -> Option<Self> {
        Some(Self { left: Curve::read(&document.left)?, right: Curve::read(&document.right)? })
    }

    /// Returns whether both sides separate the left edge of an h-set from its right one within it, the left side being left of the right one.
    pub fn parts(&self, frame: &Frame, base: &HSet) -> bool {
        let places = [base.left.bottom, base.left.top, base.right.bottom, base.right.top]
            .map(|corner| frame.place(corner.map(Span::point), 0.0));
        let [Some(a), Some(b), Some(c), Some(d)] = places else { return false };
        let top = Span::point(TOP);
        let is_within = |eta: Span| (top - eta).is_positive() && (top + eta).is_positive();
        let [left, right] = [a[0].hull(b[0]).hi(), c[0].hull(d[0]).lo()].map(|place| Curve(vec![place]));
        [a, b, c, d].iter().all(|corner| is_within(corner[1]))
            && left.is_before(&self.left)
            && self.left.is_before(&self.right)
            && self.right.is_before(&right)
    }
}

/// The first two of some strips across one h-set that are not proved to have no state in common; each has its sides in order.
pub(super) fn overlap(strips: &[(usize, &Strip)]) -> Option<[usize; 2]> {
    let mut strips = strips.to_vec();
    let middle = |strip: &Strip| strip.left.at(Span::point(0.0)).mid();
    // proposes: an order, in which neighbours are compared
    strips.sort_by(|(_, one), (_, other)| middle(one).total_cmp(&middle(other)));
    strips.windows(2).find(|pair| !pair[0].1.right.is_before(&pair[1].1.left)).map(|pair| [pair[0].0, pair[1].0])
}

#[cfg(test)]
mod tests {
    use super::super::super::tube::Chord;
    use super::*;

    fn document(left: &[&str], right: &[&str]) -> StripDocument {
        let side = |places: &[&str]| places.iter().map(|&place| Decimal::printed(place.to_owned())).collect();
        StripDocument { left: side(left), right: side(right) }
    }

    fn strip(left: &[&str], right: &[&str]) -> Strip {
        Strip::read(&document(left, right)).expect("a strip")
    }

    #[test]
    fn sides_have_some_finite_coefficients() {
        assert!(Strip::read(&document(&["0"], &["1", "2", "3"])).is_some());
        let many = vec!["0"; MAX_COEFFICIENTS + 1];
        let bad: [(&[&str], &[&str]); 4] = [(&[], &[]), (&["0"], &[]), (&["0", "1e400"], &["1", "1"]), (&many, &["1"])];
        for (left, right) in bad {
            assert_eq!(Strip::read(&document(left, right)), None, "{left:?} {right:?}");
        }
        assert!(Strip::read(&document(&many[1..], &["1"])).is_some());
    }

    /// The curve is within its bulge of the chord at places in between, and a parabola is that far in the middle.
    #[test]
    fn a_curve_is_within_its_bulge() {
        let curve = Curve(vec![0.3, -0.2, 0.7, 0.4, -0.1]);
        let mut open = vec![Heights::WHOLE];
        while let Some(heights) = open.pop() {
            let at = |height: f64| curve.at(Span::point(height)).mid();
            for part in [0.1, 0.35, 0.5, 0.8] {
                let chord = at(heights.low) + part * (at(heights.high) - at(heights.low));
                let own = at(heights.low + part * (heights.high - heights.low));
                assert!((own - chord).abs() <= curve.bulge(&heights).hi() + 1e-15, "{heights:?} {part}");
            }
            if heights.high - heights.low > 0.1 {
                open.extend(heights.halves());
            }
        }
        let parabola = Curve(vec![0.0, 0.0, 1.0]);
        assert!((parabola.bulge(&Heights::WHOLE).hi() - TOP * TOP).abs() < 1e-12);
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
        // Corners above the topmost places: a curve could pass there.
        assert!(parts(&base(1e-11), &["-0.9", "0.05"], &["0.9", "-0.05"]));
        assert!(!parts(&base(1e-9), &["-0.9", "0.05"], &["0.9", "-0.05"]));
    }

    /// Touching is too near.
    #[test]
    fn strips_are_apart_at_all_heights() {
        let low = strip(&["-0.5"], &["0", "0.1"]);
        let next = strip(&["0.05", "0.08", "0.05"], &["0.3"]);
        let bent = strip(&["0.05", "0.08", "-0.05"], &["0.3"]);
        let touching = strip(&["0", "0.1"], &["0.2"]);
        let last = strip(&["0.4", "-0.05"], &["0.5"]);
        assert_eq!(overlap(&[(7, &last), (3, &low), (5, &next)]), None);
        assert_eq!(overlap(&[(7, &last), (3, &low), (5, &bent)]), Some([3, 5]));
        assert_eq!(overlap(&[(3, &low), (5, &touching)]), Some([3, 5]));
        assert_eq!(overlap(&[(3, &low), (5, &low)]), Some([3, 5]));
    }
}
