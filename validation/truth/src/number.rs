//! Numbers known exactly, rounded once.

use rug::float::Constant;
use rug::ops::Pow;
use rug::{Float, Integer, Rational};

/// A number known exactly: a rational, or a rational multiple of pi.
///
/// Made from `&str` (`"9.42497"`, `"-1/3"`, `"1e-3"`, `"10*pi"`, `"pi/3"`), `f64`, `i32`, [`Rational`] or [`Float`]
/// (each the exact value it holds). It is rounded once, to nearest, when a [`Float`] is made from it.
///
/// **Panics** (every conversion): text that is none of the above, or a number that is not finite.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    factor: Rational,
    times_pi: bool,
}

impl Number {
    /// The number `factor` times pi.
    pub fn pi_times(factor: impl Into<Number>) -> Number {
        let factor = factor.into();
        assert!(!factor.times_pi, "pi times a multiple of pi is not supported");
        Number { times_pi: true, ..factor }
    }

    /// This number rounded to nearest at `precision` bits.
    pub fn to_float(&self, precision: u32) -> Float {
        if self.times_pi {
            // 64 guard bits: the product is off by under 2^-(precision+60) before its one rounding that matters.
            let pi = Float::with_val(precision + 64, Constant::Pi);
            Float::with_val(precision, Float::with_val(precision + 64, pi * &self.factor))
        } else {
            Float::with_val(precision, &self.factor)
        }
    }
}

/// Rounds `factor` times pi to nearest at `precision` bits.
pub fn pi_times(precision: u32, factor: impl Into<Number>) -> Float {
    Number::pi_times(factor).to_float(precision)
}

impl From<Rational> for Number {
    fn from(factor: Rational) -> Number {
        Number { factor, times_pi: false }
    }
}

impl From<i32> for Number {
    fn from(value: i32) -> Number {
        Rational::from(value).into()
    }
}

impl From<f64> for Number {
    fn from(value: f64) -> Number {
        Rational::from_f64(value).unwrap_or_else(|| panic!("{value} is not finite")).into()
    }
}

impl From<&Float> for Number {
    fn from(value: &Float) -> Number {
        value.to_rational().unwrap_or_else(|| panic!("{value} is not finite")).into()
    }
}

impl From<&str> for Number {
    fn from(text: &str) -> Number {
        parse(text).unwrap_or_else(|| panic!("`{text}` is not a decimal, a fraction or a multiple of pi"))
    }
}

/// Factors joined by `*` and `/`, at most one of them `pi` (never a divisor).
fn parse(text: &str) -> Option<Number> {
    let (sign, mut rest) = match text.trim().strip_prefix('-') {
        Some(unsigned) => (-1, unsigned),
        None => (1, text.trim()),
    };
    let mut number = Number::from(sign);
    let mut divides = false;
    loop {
        let end = rest.find(['*', '/']).unwrap_or(rest.len());
        let token = rest[..end].trim();
        if token == "pi" {
            if divides || number.times_pi {
                return None;
            }
            number.times_pi = true;
        } else {
            let value = parse_decimal(token)?;
            if divides && value == 0 {
                return None;
            }
            number.factor = if divides { number.factor / value } else { number.factor * value };
        }
        if end == rest.len() {
            return Some(number);
        }
        divides = rest.as_bytes()[end] == b'/';
        rest = &rest[end + 1..];
    }
}

/// An unsigned decimal with optional point and exponent, exactly.
fn parse_decimal(token: &str) -> Option<Rational> {
    let (mantissa, exponent) = match token.find(['e', 'E']) {
        Some(at) => (&token[..at], token[at + 1..].parse::<i32>().ok()?),
        None => (token, 0),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = format!("{whole}{fraction}");
    if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    let shift = exponent - i32::try_from(fraction.len()).ok()?;
    Some(Rational::from(digits.parse::<Integer>().ok()?) * Rational::from(10).pow(shift))
}
