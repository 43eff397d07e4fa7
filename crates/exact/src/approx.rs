//! Nearness by the traits of the package `approx`: a result holds for all members of two enclosures.

use approx::{AbsDiffEq, RelativeEq};

use super::{Dyadic, Enclosure};

/// Whether every number of one enclosure is within `epsilon` of every number of the other: so are the two enclosed numbers.
///
/// An enclosure wider than `epsilon` is not near itself: two numbers inside may be farther apart.
impl AbsDiffEq for Enclosure {
    type Epsilon = f64;

    fn default_epsilon() -> f64 {
        f64::EPSILON
    }

    fn abs_diff_eq(&self, other: &Self, epsilon: f64) -> bool {
        Dyadic::from_f64(epsilon).is_some_and(|epsilon| self.farthest(other) <= epsilon)
    }
}

/// Equality, or nearness within `max_relative` of the greater absolute value, for every two numbers.
impl RelativeEq for Enclosure {
    fn default_max_relative() -> f64 {
        f64::EPSILON
    }

    fn relative_eq(&self, other: &Self, epsilon: f64, max_relative: f64) -> bool {
        // X1: of each two numbers the greater one is at least this
        let size = self.mig().max(other.mig());
        let is_near = |part: Dyadic| self.farthest(other) <= part.times(&size);
        self.abs_diff_eq(other, epsilon) || Dyadic::from_f64(max_relative).is_some_and(is_near)
    }
}

impl Enclosure {
    /// An upper bound of the distance between a number of one and a number of the other.
    fn farthest(&self, other: &Self) -> Dyadic {
        self.sub(other, 64).mag()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Exactly as the ends show: they are the members that are farthest apart.
        #[test]
        fn sets_are_near_if_all_members_are(
            [a, b] in [-1e3..1e3f64, -1e3..1e3f64], [r, s] in [0.0..1e-3f64, 0.0..1e-3f64], near: bool, slack in 0.9..1.1f64,
        ) {
            let b = if near { a * (1.0 + 1e-3 * s) } else { b };
            let [x, y] = [(a, r), (b, s)].map(|(mid, rad)| Enclosure::from_f64_bounds(mid - rad, mid + rad).unwrap());
            let [(low, high), (lower, higher)] = [&x, &y].map(Enclosure::to_f64_bounds);
            let farthest = (high - lower).max(higher - low);
            let least = |low: f64, high: f64| if low * high <= 0.0 { 0.0 } else { low.abs().min(high.abs()) };
            let size = least(low, high).max(least(lower, higher));
            // Doubles cannot tell where it is that close.
            if (slack - 1.0).abs() > 1e-9 {
                prop_assert_eq!(x.abs_diff_eq(&y, slack * farthest), slack > 1.0);
                prop_assert_eq!(x.relative_eq(&y, 0.0, slack * farthest / size), slack > 1.0 && size > 0.0);
            }
        }
    }

    #[test]
    fn a_point_is_near_itself_and_what_is_wide_is_not() {
        let pi = Enclosure::pi(100);
        assert!(pi.abs_diff_eq(&pi, 1e-28) && !pi.abs_diff_eq(&pi, 1e-32) && !pi.abs_diff_eq(&pi, f64::NAN));
        let one = Enclosure::from_f64_bounds(1.0, 1.0).unwrap();
        assert!(one.abs_diff_eq(&one, 0.0) && one.relative_eq(&one, 0.0, 0.0));
        let wide = Enclosure::from_f64_bounds(1.0, 2.0).unwrap();
        assert!(wide.abs_diff_eq(&wide, 1.0) && !wide.abs_diff_eq(&wide, 0.99) && !wide.abs_diff_eq(&one, 0.99));
    }
}
