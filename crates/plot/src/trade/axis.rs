//! The axes of the plot: digits, with comparable space for few and many digits, and times.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

/// Digits at which the axis has labels, within its range.
const TICKS: [f64; 18] =
    [-2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1e3, 2e3, 5e3, 1e4, 1e5];
/// Free room beyond the marks, as a fraction of the axis.
const MARGIN: f64 = 0.05;
/// Free room beyond the marks on the axis of times, as a factor.
const TIME_MARGIN: f64 = 2.0;
/// Least ratio of the ends of the axis of times, without its margins.
const MIN_TIME_RATIO: f64 = 100.0;

/// An axis of digits `n`, on the scale `log(1 + n)`; mirrored below zero.
#[derive(Clone, Debug)]
pub struct Digits(Range<f64>);

impl Digits {
    /// The axis that holds 0, 10 and all of `digits`.
    pub fn around(digits: impl Iterator<Item = f64>) -> Self {
        let (low, high) = digits.fold((0.0f64, 10.0f64), |(low, high), x| (low.min(x), high.max(x)));
        let margin = MARGIN * (scale(high) - scale(low));
        Self(unscale(scale(low) - margin)..unscale(scale(high) + margin))
    }
}

fn scale(digits: f64) -> f64 {
    digits.signum() * digits.abs().ln_1p()
}

fn unscale(at: f64) -> f64 {
    at.signum() * at.abs().exp_m1()
}

impl Ranged for Digits {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, &digits: &f64, (left, right): (i32, i32)) -> i32 {
        let (low, high) = (scale(self.0.start), scale(self.0.end));
        let part = (scale(digits) - low) / (high - low);
        left + (f64::from(right - left) * part).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        TICKS.into_iter().filter(|tick| self.0.contains(tick)).collect()
    }

    fn range(&self) -> Range<f64> {
        self.0.clone()
    }
}

impl ValueFormatter<f64> for Digits {
    fn format(digits: &f64) -> String {
        digits.to_string().replace('-', "−")
    }
}

/// A logarithmic axis of these times, with free room around them.
pub fn times(times: impl Iterator<Item = f64> + Clone) -> Range<f64> {
    let fast = times.clone().reduce(f64::min).unwrap_or(0.1);
    let slow = times.reduce(f64::max).unwrap_or(10.0);
    fast / TIME_MARGIN..slow.max(MIN_TIME_RATIO * fast) * TIME_MARGIN
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_stand_inside_and_in_order() {
        let marks = [-0.3, 0.0, 0.7, 15.2, 108.0, 277.0];
        let axis = Digits::around(marks.into_iter());
        let at = marks.map(|digits| axis.map(&digits, (100, 900)));
        assert!(at.is_sorted_by(|a, b| a < b) && at[0] > 100 && at[5] < 900, "{at:?}");
        assert_eq!(times([0.25, 64.0, 33.0].into_iter()), 0.125..128.0);
        assert_eq!(times([1.0, 2.0].into_iter()), 0.5..200.0);
        assert!(!times(std::iter::empty()).is_empty());
    }
}
