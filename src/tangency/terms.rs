//! Sums, differences and products of numbers that are dear to copy.

use crate::number::Number;

/// [`Number`]'s operations on two references.
pub(super) trait Terms: Number {
    /// `self + b`
    fn plus_ref(&self, b: &Self) -> Self {
        self.clone().plus(b)
    }

    /// `self - b`
    fn minus_ref(&self, b: &Self) -> Self {
        self.clone().minus(b)
    }

    /// `self * b`
    fn times_ref(&self, b: &Self) -> Self {
        self.clone().times(b)
    }
}

impl<N: Number> Terms for N {}
