//! Requested widths.

use crate::exact::log2_of_digits;

/// A requested width; `linear` is 0 where the width is below the range of doubles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Width {
    pub linear: f64,
    pub log2: f64,
}

impl Width {
    /// `10^-digits` of `unit`, less a fiftieth, which printing may add.
    pub fn new(digits: u32, unit: f64) -> Self {
        let log2 = unit.log2() - log2_of_digits(f64::from(digits));
        Self { linear: 0.98 * unit * 10f64.powi(-(digits.min(400) as i32)), log2: log2 + 0.98f64.log2() } // shown
    }
}
