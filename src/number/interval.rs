//! Closed intervals of doubles: how enclosures are handed to users.

use std::fmt;

/// All real numbers from [`Interval::inf`] to [`Interval::sup`]; words as in IEEE 1788.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    inf: f64,
    sup: f64,
}

impl Interval {
    /// The interval `[inf, sup]`.
    ///
    /// # Panics
    /// When `inf > sup` or either is NaN: no enclosure has such bounds.
    pub fn new(inf: f64, sup: f64) -> Self {
        assert!(inf <= sup, "[{inf}, {sup}] is not an interval");
        Self { inf, sup }
    }

    /// The lower bound.
    pub fn inf(self) -> f64 {
        self.inf
    }

    /// The upper bound.
    pub fn sup(self) -> f64 {
        self.sup
    }

    /// A double near the middle (a label, not a bound).
    pub fn mid(self) -> f64 {
        0.5 * self.inf + 0.5 * self.sup
    }

    /// An upper bound of the width.
    pub fn wid(self) -> f64 {
        if self.inf == self.sup { 0.0 } else { (self.sup - self.inf).next_up() }
    }

    /// Whether `x` lies inside.
    pub fn contains(self, x: f64) -> bool {
        self.inf <= x && x <= self.sup
    }
}

impl fmt::Display for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Rust prints the shortest decimal that reads back as the same double, which may lie inside:
        // one double further out, it lies outside (Interval Arithmetic's oldest printing bug).
        write!(f, "[{:?}, {:?}]", self.inf.next_down(), self.sup.next_up())
    }
}
