//! Nearness of balls by the traits of the package `approx`: that of the intervals they are.

use approx::{AbsDiffEq, RelativeEq};

use super::Ball;
use crate::exact::Enclosure;

impl Ball {
    /// Returns whether both are finite, and near as intervals.
    fn is_near(&self, other: &Self, near: impl Fn(&Enclosure, &Enclosure) -> bool) -> bool {
        self.enclosure().zip(other.enclosure()).is_some_and(|(a, b)| near(&a, &b))
    }
}

/// Every number of one is within `epsilon` of every number of the other; so are the two numbers that are enclosed.
impl AbsDiffEq for Ball {
    type Epsilon = f64;

    fn default_epsilon() -> f64 {
        f64::EPSILON
    }

    fn abs_diff_eq(&self, other: &Self, epsilon: f64) -> bool {
        self.is_near(other, |a, b| a.abs_diff_eq(b, epsilon))
    }
}

/// The same, or within `max_relative` of the greater absolute value of every two numbers.
impl RelativeEq for Ball {
    fn default_max_relative() -> f64 {
        f64::EPSILON
    }

    fn relative_eq(&self, other: &Self, epsilon: f64, max_relative: f64) -> bool {
        self.is_near(other, |a, b| a.relative_eq(b, epsilon, max_relative))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn balls_are_near_when_all_their_members_are() {
        let (a, b) = (Ball::new(100.0, 0.25), Ball::new(101.0, 0.25));
        assert!(a.abs_diff_eq(&b, 1.5) && !a.abs_diff_eq(&b, 1.499));
        assert!(a.relative_eq(&b, 0.0, 0.0149) && !a.relative_eq(&b, 0.0, 0.0148));
        let unknown = Ball::new(0.0, f64::NAN);
        assert!(!unknown.abs_diff_eq(&unknown, 1e300) && !unknown.relative_eq(&a, f64::INFINITY, 1.0));
    }
}
