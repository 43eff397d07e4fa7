//! Linear axes with round ticks, and axes of angles.

use std::f64::consts::{FRAC_PI_4, TAU};
use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

/// Free room beyond the data, as a fraction of their range.
const MARGIN: f64 = 0.05;
/// Approximate number of ticks on an axis.
const TARGET_TICKS: f64 = 6.0;
/// Tolerance for numbers of steps in doubles: 0.9 - 0.3 is more than 0.6.
const TOLERANCE: f64 = 1e-9;

/// Least number of doubles on an axis: more than there are pixels along any axis.
const LEAST_DOUBLES: f64 = 4096.0;
/// The shortest axis around 0: steps are quotients of normal doubles.
const SHORTEST: f64 = LEAST_DOUBLES * f64::MIN_POSITIVE;
/// Labels of more characters are written with a power of ten where that is shorter.
const LONGEST_LABEL: usize = 12;

/// A linear axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    range: Range<f64>,
    labels: Labels,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Labels {
    /// Multiples of a step, with a number of decimals.
    Step(f64, usize),
    /// Multiples of this number of eighths of `2 pi`.
    Angle(i32),
    /// Names of 0, 1, 2, ...
    Names(&'static [&'static str]),
}

impl Axis {
    /// The axis from `low` to `high`; with some room around the number if both are equal.
    pub fn over(low: f64, high: f64) -> Self {
        let room = if high > low { 0.0 } else { low.abs().max(1.0) };
        let range = low - room..high + room;
        let (step, decimals) = step((range.end - range.start) / TARGET_TICKS);
        Self { range, labels: Labels::Step(step, decimals) }
    }

    /// The axis that holds all values, with free room beyond them. Its length is at least a tenth of the greatest value, lest the tail of
    /// a spiral look like a motion.
    pub fn around(values: impl Iterator<Item = f64>) -> Self {
        Self::holding(values, 0.1)
    }

    /// The axis that holds all values, with free room beyond them, however close the values are.
    pub fn close_around(values: impl Iterator<Item = f64>) -> Self {
        Self::holding(values, 0.0)
    }

    fn holding(values: impl Iterator<Item = f64>, least: f64) -> Self {
        // Near 0 no axis is resolved; beyond the finite doubles there is no room.
        let values = values.filter(|x| x.is_finite()).map(|x| if x.abs() < SHORTEST { 0.0 } else { x });
        let (low, high) = values.fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
        if low > high {
            return Self::over(-1.0, 1.0);
        }
        let lacking = (least * low.abs().max(high.abs()) - (high - low)).max(0.0) / 2.0;
        let room = lacking + MARGIN * (high - low);
        Self::over(low - room, high + room)
    }

    /// The axis from `low` to `high`, even if the two are equal doubles.
    pub fn between(low: f64, high: f64) -> Self {
        Self { range: low..high, ..Self::over(low, high) }
    }

    /// Refuses an axis that doubles do not resolve: infinite numbers, or fewer doubles than pixels from end to end.
    ///
    /// # Errors
    /// Returns an error if a drawing over the axis would not be visible.
    pub fn require_resolved(&self) -> Result<(), String> {
        let Range { start, end } = self.range;
        let largest = start.abs().max(end.abs());
        let least = (LEAST_DOUBLES * (largest.next_up() - largest)).max(SHORTEST);
        if largest.is_finite() && (end - start).is_finite() && end - start >= least {
            return Ok(());
        }
        let accepted = format!("accepted are axes of at least {LEAST_DOUBLES} doubles from end to end");
        Err(format!("the picture has an axis from {start:e} to {end:e}, but {accepted}"))
    }

    /// Rows with these names, the lowest at 0.
    pub fn named(names: &'static [&'static str]) -> Self {
        Self { range: -0.5..names.len() as f64 - 0.5, labels: Labels::Names(names) }
    }

    /// Angles in `[0, 2 pi]`.
    pub fn angle() -> Self {
        Self::turn(0.0)
    }

    /// Angles from `from` to `to`, in eighths of `2 pi`.
    pub fn eighths(from: i32, to: i32) -> Self {
        let step = if to - from > 4 { 2 } else { 1 };
        Self { range: f64::from(from) * FRAC_PI_4..f64::from(to) * FRAC_PI_4, labels: Labels::Angle(step) }
    }

    /// The position of a value on the axis: 0 at the beginning, 1 at the end.
    pub fn part(&self, value: f64) -> f64 {
        (value - self.range.start) / (self.range.end - self.range.start)
    }

    /// Angles in `[0, 2 pi]`, with `room` at both ends.
    pub fn turn(room: f64) -> Self {
        Self { range: -room..TAU + room, labels: Labels::Angle(2) }
    }
}

/// The least of 1, 2, 5, 10, ... times a power of ten that is at least `least`, and its decimals.
fn step(least: f64) -> (f64, usize) {
    let exponent = least.log10().floor() as i32;
    let decade = 10f64.powi(exponent);
    let (times, exponent) = match least / decade {
        part if part <= 1.0 + TOLERANCE => (1.0, exponent),
        part if part <= 2.0 + TOLERANCE => (2.0, exponent),
        part if part <= 5.0 + TOLERANCE => (5.0, exponent),
        _ => (10.0, exponent.saturating_add(1)),
    };
    (times * decade, exponent.min(0).unsigned_abs() as usize)
}

/// An angle in words, from its number of eighths of `2 pi`.
fn angle(eighths: i32) -> String {
    let sign = if eighths < 0 { "−" } else { "" };
    let (times, parts) = match eighths.abs() {
        0 => return "0".into(),
        whole if whole % 4 == 0 => (whole / 4, 1),
        half if half % 2 == 0 => (half / 2, 2),
        quarter => (quarter, 4),
    };
    let times = if times == 1 { String::new() } else { times.to_string() };
    let parts = if parts == 1 { String::new() } else { format!("/{parts}") };
    format!("{sign}{times}π{parts}")
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, &value: &f64, (left, right): (i32, i32)) -> i32 {
        left.saturating_add((f64::from(right - left) * self.part(value)).round() as i32)
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        match self.labels {
            Labels::Step(step, _) => {
                let first = (self.range.start / step - TOLERANCE).ceil() as i64;
                let last = (self.range.end / step + TOLERANCE).floor() as i64;
                (first..=last).map(|k| k as f64 * step).collect()
            }
            Labels::Names(names) => (0..names.len()).map(|k| k as f64).collect(),
            Labels::Angle(step) => {
                let step = f64::from(step) * FRAC_PI_4;
                let first = (self.range.start / step - TOLERANCE).ceil() as i32;
                let last = (self.range.end / step + TOLERANCE).floor() as i32;
                (first..=last).map(|k| f64::from(k) * step).collect()
            }
        }
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, &value: &f64) -> String {
        match self.labels {
            Labels::Step(_, decimals) => {
                let mut text = format!("{value:.decimals$}");
                if text.len() > LONGEST_LABEL && value != 0.0 {
                    let digits = decimals as i32 + value.abs().log10().floor() as i32;
                    let short = format!("{value:.*e}", digits.max(0) as usize);
                    text = if short.len() < text.len() { short } else { text };
                }
                if text.chars().any(|digit| ('1'..='9').contains(&digit)) {
                    text.replace('-', "−")
                } else {
                    "0".into()
                }
            }
            Labels::Names(names) => names.get(value.round() as usize).copied().unwrap_or_default().to_owned(),
            Labels::Angle(_) => angle((value / FRAC_PI_4).round() as i32),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<String> {
        axis.key_points(10).iter().map(|value| axis.format_ext(value)).collect()
    }

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(labels(&Axis::over(0.0, 0.7)), ["0", "0.2", "0.4", "0.6"]);
        assert_eq!(labels(&Axis::over(-4.7, 4.7)), ["−4", "−2", "0", "2", "4"]);
        assert_eq!(labels(&Axis::over(-9000.0, 9000.0)), ["−5000", "0", "5000"]);
        assert_eq!(labels(&Axis::angle()), ["0", "π/2", "π", "3π/2", "2π"]);
        assert_eq!(labels(&Axis::eighths(-3, 1)), ["−3π/4", "−π/2", "−π/4", "0", "π/4"]);
        assert_eq!(labels(&Axis::eighths(-3, 3)), ["−π/2", "0", "π/2"]);
        assert_eq!(Axis::over(0.0, 10.0).map(&2.5, (100, 500)), 200);
    }

    #[test]
    fn r35_the_ends_of_a_range_have_ticks() {
        assert_eq!(labels(&Axis::over(0.3, 0.9)), ["0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9"]);
        // In every range of tenths whose ends are whole numbers of steps, both ends have a label.
        for (low, high) in (-12..12).flat_map(|low| (low + 1..=low + 6).map(move |high| (low, high))) {
            let axis = Axis::over(f64::from(low) * 0.1, f64::from(high) * 0.1);
            let ticks = axis.key_points(10);
            let is_tick = |tenths: i32| ticks.iter().any(|tick| (tick * 10.0 - f64::from(tenths)).abs() < 1e-6);
            assert!(is_tick(low) && is_tick(high), "{low} {high}: {ticks:?}");
        }
    }

    #[test]
    fn an_axis_that_doubles_do_not_resolve_is_refused() {
        for (low, high) in [(0.0, 1e-320), (0.0, 1e-305), (1e17, 1e17 + 800.0), (f64::MIN, f64::MAX), (1e17, 1e17)] {
            let refused = Axis::between(low, high).require_resolved().unwrap_err();
            assert!(
                refused.starts_with(&format!("the picture has an axis from {low:e} to {high:e}, but")),
                "{refused}"
            );
        }
        let tiny = Axis::over(0.0, 1e-300);
        assert!(tiny.require_resolved().is_ok());
        assert_eq!(labels(&tiny), ["0", "2e−301", "4e−301", "6e−301", "8e−301", "1.0e−300"]);
        assert!(Axis::over(1e17, 1e17 + 1e6).require_resolved().is_ok() && Axis::angle().require_resolved().is_ok());
    }

    #[test]
    fn an_axis_holds_its_data_and_is_never_too_fine() {
        let axis = Axis::around([-3.0, 5.0].into_iter()).range();
        assert!(axis.start < -3.0 && axis.end > 5.0 && axis.end < 6.0);
        let axis = Axis::around([12.5663, 12.5664].into_iter()).range();
        assert!(axis.end - axis.start > 1.2 && axis.contains(&12.5663));
        assert!(!Axis::around(std::iter::empty()).range().is_empty());
        for odd in
            [[0.0, 0.0], [-5e-324, 5e-324], [f64::NEG_INFINITY, f64::INFINITY], [f64::MIN, f64::MAX], [1e300, 1e300]]
        {
            let axis = Axis::around(odd.into_iter());
            assert!(labels(&axis).len() < 20, "{axis:?}");
            axis.map(&f64::INFINITY, (100, 500));
        }
    }
}
