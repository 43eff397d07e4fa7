//! Positive numbers far beyond the range of doubles.

use crate::number::{Ball, Number, logarithm, up};

/// A positive number `mantissa 2^exponent`, out of the range of doubles as well.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scaled {
    mantissa: Ball,
    exponent: i64,
}

/// A mantissa beyond `2^(+-LARGEST)` is brought back.
const MAX_EXPONENT: i32 = 200;
/// The smaller term of a sum is bounded, not computed, when it is less than `2^-NEGLIGIBLE_EXPONENT` of the larger one.
const NEGLIGIBLE_EXPONENT: i32 = 300;

impl Scaled {
    pub fn one() -> Self {
        Self { mantissa: Ball::exact(1.0), exponent: 0 }
    }

    /// `self * |factor|`
    pub fn times(self, factor: Ball) -> Self {
        let product = self.mantissa * factor;
        let mantissa = if product.mid() < 0.0 { -product } else { product };
        let binary = mantissa.mid().log2();
        if binary.abs() <= f64::from(MAX_EXPONENT) || !binary.is_finite() {
            return Self { mantissa, ..self };
        }
        // A power of two that keeps the centre exact; the radius may lose what is below the normal range.
        let shift = binary.clamp(-1000.0, 1000.0) as i32; // exact: 2^+-shift is a normal double
        let scale = 2f64.powi(-shift);
        let mantissa = Ball::new(mantissa.mid() * scale, up(mantissa.rad() * scale + f64::MIN_POSITIVE));
        Self { mantissa, exponent: self.exponent + i64::from(shift) }
    }

    pub fn squared(self) -> Self {
        let once = Self { mantissa: Ball::exact(1.0), exponent: 2 * self.exponent };
        once.times(self.mantissa).times(self.mantissa)
    }

    /// Mantissa in units of `2^exponent`, for an exponent that is not much smaller than the number's own.
    pub fn in_units_of(self, exponent: i64) -> Ball {
        let shift = self.exponent - exponent;
        if shift < -i64::from(NEGLIGIBLE_EXPONENT + 2 * MAX_EXPONENT) {
            // 2^shift is far less than 2^-NEGLIGIBLE_EXPONENT; what is no number stays none.
            return Ball::new(0.0, 2f64.powi(-NEGLIGIBLE_EXPONENT) * (self.mantissa.mag() + 1.0));
        }
        self.mantissa * Ball::exact(2f64.powi(shift as i32)) // exact: at most 800 in size
    }

    pub fn plus(self, other: Self) -> Self {
        let exponent = self.exponent.max(other.exponent); // exact: the greater unit
        Self { mantissa: self.in_units_of(exponent) + other.in_units_of(exponent), exponent }
    }

    /// Encloses the logarithm; `None` when the number may be 0.
    pub fn logarithm(self) -> Option<Ball> {
        let two = logarithm(Ball::exact(2.0))?;
        Some(logarithm(self.mantissa)? + Ball::exact(self.exponent as f64) * two) // exact: below 2^53, 1000 a flight
    }

    /// `self / sum` for a `sum` that is at least twice as large, up to rounding.
    pub fn in_units_of_sum(self, sum: Self) -> Option<Ball> {
        if self.exponent > sum.exponent + 4 * i64::from(MAX_EXPONENT) {
            return None;
        }
        self.in_units_of(sum.exponent).checked_div(sum.mantissa)
    }
}
