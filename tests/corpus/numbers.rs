//! Exact decimals.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Pow, Signed, Zero};
use serde_json::{Value, json};

/// Places of decimals that are written.
const PLACES: u32 = 80;

/// The value of a decimal or of another exact expression that is rational.
pub fn rational(text: &Value) -> Option<BigRational> {
    impact_pair_exact::Exact::parse(text.as_str()?).ok()?.as_rational().cloned()
}

/// Two numbers, in order or not.
pub fn bounds(pair: &Value) -> Option<[BigRational; 2]> {
    let [lower, upper] = pair.as_array()?.as_slice() else { return None };
    Some([rational(lower)?, rational(upper)?])
}

/// A decimal of 80 places, rounded down.
pub fn decimal(x: &BigRational) -> String {
    let places = BigRational::from_integer(Pow::pow(BigInt::from(10), PLACES));
    format!("{}e-{PLACES}", (x * places).floor().to_integer())
}

pub fn pair(lower: &BigRational, upper: &BigRational) -> Value {
    json!([decimal(lower), decimal(upper)])
}

/// A rational of small numbers.
pub fn fraction(numerator: i64, denominator: i64) -> BigRational {
    BigRational::new(numerator.into(), denominator.into())
}

/// A number in 30 digits that is nearly pi.
pub fn pi() -> BigRational {
    rational(&json!("3.14159265358979323846264338328")).expect("a decimal")
}

/// An expression with the sign changed; of a decimal a decimal.
pub fn negated(text: &Value) -> Value {
    let text = text.as_str().unwrap();
    let is_decimal = text.parse::<f64>().is_ok();
    json!(match text.strip_prefix('-') {
        Some(rest) if is_decimal => rest.to_owned(),
        None if is_decimal => format!("-{text}"),
        _ => format!("-({text})"),
    })
}

/// The unit of the last place of a decimal; of another fraction that of the last place written.
pub fn unit(x: &BigRational) -> BigRational {
    let (mut unit, tenth) = (BigRational::one(), fraction(1, 10));
    for _ in 0..PLACES {
        if (x / &unit).is_integer() {
            break;
        }
        unit *= &tenth;
    }
    unit
}

/// The power of ten at the first digit of a number; of 0 it is 1.
pub fn leading(x: &BigRational) -> BigRational {
    let (mut power, ten, size) = (BigRational::one(), fraction(10, 1), x.abs());
    if size.is_zero() {
        return power;
    }
    while &power * &ten <= size {
        power *= &ten;
    }
    while power > size {
        power /= &ten;
    }
    power
}
