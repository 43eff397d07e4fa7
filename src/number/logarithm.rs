//! The natural logarithm of a ball, without a library's: Lemma B3.

use super::{Ball, Number, up};

/// `1/(2 k + 1)` for `k < 12` are the coefficients of `atanh(z)/z` in `z^2`.
const TERMS: u32 = 12;
/// The rest of that series for `z^2 <= 0.0295`: at most `0.0295^12/(25 * 0.97) < 2^-65`.
const REST: f64 = 1.0 / (1_u128 << 65) as f64; // B3: exact, a power of two
/// Bound of the distance of `ln 2 = 0.69314718055994530941723...` from the nearest double.
const LN_2_ERROR: f64 = 2.4e-17;

/// Encloses `ln x` of every `x` in the ball; `None` when it may be 0 or less, or is no normal double.
///
/// ```
/// use impact_pair::number::{Ball, logarithm};
/// let x = logarithm(Ball::exact(10.0)).unwrap();
/// assert!((x.mid() - 10f64.ln()).abs() < 1e-15 && x.rad() < 1e-15);
/// ```
pub fn logarithm(x: Ball) -> Option<Ball> {
    let least = (x.mid() - x.rad()).next_down();
    if !(x.mid().is_normal() && least > 0.0) {
        return None;
    }
    let middle = logarithm_of(x.mid());
    // The slope of ln is at most 1/least on the ball.
    Some(middle.widened(up(x.rad() / least)))
}

/// Encloses `ln x` of a normal double `x > 0`. Lemma B3
fn logarithm_of(x: f64) -> Ball {
    let exponent = ((x.to_bits() >> 52) & 0x7ff) as i32 - 1023; // B3: 11 bits
    // x = m 2^k with m in [sqrt(1/2), sqrt(2)], about; both factors are exact.
    let m = f64::from_bits((x.to_bits() & ((1 << 52) - 1)) | (1023 << 52));
    let (m, k) = if m > std::f64::consts::SQRT_2 { (0.5 * m, exponent + 1) } else { (m, exponent) };
    let one = Ball::exact(1.0);
    // ln m = 2 atanh z
    let z = (Ball::exact(m) - one).checked_div(Ball::exact(m) + one).expect("m + 1 is positive");
    let square = z * z;
    let coefficient = |k: u32| one.checked_div(Ball::exact(f64::from(2 * k + 1))).expect("positive");
    let series = (0..TERMS - 1).rev().fold(coefficient(TERMS - 1), |sum, k| sum * square + coefficient(k));
    let ln_2 = Ball::new(std::f64::consts::LN_2, LN_2_ERROR);
    Ball::exact(2.0) * z * series.widened(REST) + Ball::exact(f64::from(k)) * ln_2
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithms_of_fractions_add_up() {
        let ln = |a: f64, b: f64| logarithm(Ball::exact(a).checked_div(Ball::exact(b)).unwrap()).unwrap();
        // 2 = (4/3)^2 (9/8): no power of two is taken out on the left.
        let sum = ln(4.0, 3.0) + ln(4.0, 3.0) + ln(9.0, 8.0);
        let two = logarithm(Ball::exact(2.0)).unwrap();
        assert!((sum.mid() - two.mid()).abs() <= sum.rad() + two.rad() && sum.rad() < 1e-14);
        assert_eq!(logarithm(Ball::exact(1.0)).map(Ball::mid), Some(0.0));
        assert!([0.0, -1.0, f64::NAN, f64::INFINITY].iter().all(|&x| logarithm(Ball::exact(x)).is_none()));
        assert!(logarithm(Ball::new(1.0, 1.0)).is_none());
    }
}
