//! Numbers in Coq's notation.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed};

use impact_pair_exact::{Exact, Operation};
use impact_pair_model::Error;

/// Largest exponent that is written out as a product.
const MAX_POWER: u32 = 64;

/// A value or an interval of values.
pub(super) fn range(x: &Exact) -> Result<String, Error> {
    let ends = x.ends().ok_or_else(|| Error::certificate(format!("{x} holds an interval inside an expression")))?;
    let (low, high) = (number(&ends.0)?, number(&ends.1)?);
    Ok(if x.is_point() { format!("(Exactly ({low}))") } else { format!("(Between ({low}) ({high}))") })
}

/// An expression.
fn number(x: &Exact) -> Result<String, Error> {
    let refused = |what: &str| Error::certificate(format!("{x} has {what}, which Coq's expressions do not hold here"));
    x.fold(&mut |operation: Operation<'_, Result<String, Error>>| {
        Ok(match operation {
            Operation::Rational(x) => rational(x),
            Operation::PiPower(x, n) => {
                let power = power("Pi", n.unsigned_abs()).ok_or_else(|| refused("a large power of pi"))?;
                match (x.is_one(), n > 0) {
                    (true, true) => power,
                    (_, true) => format!("Times ({}) ({power})", rational(x)),
                    (_, false) => format!("Over ({}) ({power})", rational(x)),
                }
            }
            Operation::Interval(..) => return Err(refused("an interval inside")),
            Operation::Negative(a) => format!("Minus (Rational 0) ({})", a?),
            Operation::Sum(a, b) => format!("Plus ({}) ({})", a?, b?),
            Operation::Difference(a, b) => format!("Minus ({}) ({})", a?, b?),
            Operation::Product(a, b) => format!("Times ({}) ({})", a?, b?),
            Operation::Quotient(a, b) => format!("Over ({}) ({})", a?, b?),
            Operation::Power(a, n) => power(&format!("({})", a?), n).ok_or_else(|| refused("a large power"))?,
            Operation::SquareRoot(a) => format!("Root ({})", a?),
            Operation::Sine(a) => format!("Sine ({})", a?),
            Operation::Cosine(a) => format!("Cosine ({})", a?),
        })
    })
}

/// `x^n` written out; `None` for exponent 0 or above `MAX_POWER`.
fn power(x: &str, n: u32) -> Option<String> {
    let mut product = (1..=MAX_POWER).contains(&n).then(|| x.to_owned())?;
    for _ in 1..n {
        product = format!("Times {x} ({product})");
    }
    Some(product)
}

/// A fraction as an expression.
fn rational(x: &BigRational) -> String {
    format!("Rational {}", fraction(x))
}

/// A fraction as Coq's Q reads it.
pub(super) fn fraction(x: &BigRational) -> String {
    let plain = if x.denom().is_one() {
        x.numer().to_string()
    } else {
        decimal(x).unwrap_or(format!("{} # {}", x.numer(), x.denom()))
    };
    if x.is_negative() || plain.contains('#') { format!("({plain})") } else { plain }
}

/// A fraction as a decimal, if the decimal is of moderate length.
fn decimal(x: &BigRational) -> Option<String> {
    const LONGEST: u32 = 2000;
    let mut digits = x.denom().bits() as u32 / 3;
    let mut scaled = x * BigRational::from_integer(BigInt::from(10).pow(digits.min(LONGEST)));
    while !scaled.is_integer() {
        digits += 1;
        scaled *= BigInt::from(10);
        if digits > LONGEST {
            return None;
        }
    }
    let sign = if x.is_negative() { "-" } else { "" };
    let digits = digits as usize;
    let all = format!("{:0>1$}", scaled.to_integer().abs().to_string(), digits + 1);
    let (whole, part) = all.split_at(all.len() - digits);
    Some(format!("{sign}{whole}.{}", part.trim_end_matches('0')))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_coq_reads_them() {
        let written = |text: &str| number(&Exact::parse(text).unwrap()).unwrap();
        assert_eq!(written("9.42497"), "Rational 9.42497");
        assert_eq!(written("-0.5"), "Rational (-0.5)");
        assert_eq!(written("1/3"), "Rational (1 # 3)");
        assert_eq!(written("pi"), "Pi");
        assert_eq!(written("2*pi^2"), "Times (Rational 2) (Times Pi (Pi))");
        assert_eq!(written("sqrt(2)+sin(1)"), "Plus (Root (Rational 2)) (Sine (Rational 1))");
        assert_eq!(
            range(&Exact::parse("[9.42, 3*pi]").unwrap()).unwrap(),
            "(Between (Rational 9.42) (Times (Rational 3) (Pi)))"
        );
    }
}
