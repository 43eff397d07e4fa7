//! Decimal literals as exact fractions in lowest terms.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Zero};

/// Zero and magnitudes from 1e-10000 to 1e10000 are accepted.
const LARGEST_DECIMAL_EXPONENT: i64 = 10_000;

/// `digits * 10^exponent`, exactly; `None` if it is neither zero nor between the accepted magnitudes.
pub(super) fn exact_decimal(digits: &str, exponent: i64) -> Option<BigRational> {
    let kept = digits.trim_end_matches('0');
    let exponent = exponent.saturating_add((digits.len() - kept.len()) as i64); // exact: what is cut off is refused
    let kept = kept.trim_start_matches('0');
    if kept.is_empty() {
        return Some(BigRational::zero());
    }
    let leading = exponent.saturating_add(kept.len() as i64 - 1); // exact: what is cut off is refused
    if leading.abs() > LARGEST_DECIMAL_EXPONENT {
        return None;
    }
    let integer: BigInt = kept.parse().ok()?;
    let ten = |n: u64| u32::try_from(n).ok().map(|n| BigInt::from(10u8).pow(n));
    if exponent >= 0 {
        return Some(BigRational::from_integer(integer * ten(exponent.unsigned_abs())?));
    }
    lowest_terms(integer, exponent.unsigned_abs())
}

/// `integer / 10^places` in lowest terms. The last digit is not 0, so only twos or only fives can cancel.
fn lowest_terms(integer: BigInt, places: u64) -> Option<BigRational> {
    let exponent = u32::try_from(places).ok()?;
    let five = BigInt::from(5u8).pow(exponent);
    let twos = integer.trailing_zeros().unwrap_or(0).min(places); // exact: the twos of both
    if twos > 0 {
        return Some(BigRational::new_raw(integer >> twos, five << (places - twos)));
    }
    let common = if (&integer % 5u8).is_zero() { integer.gcd(&five) } else { BigInt::one() };
    Some(BigRational::new_raw(integer / &common, (five / common) << places))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn magnitudes_are_those_of_the_number_not_of_its_spelling() {
        let zeros = "0".repeat(10_000);
        assert_eq!(exact_decimal(&zeros, i64::MAX / 4), Some(BigRational::zero()));
        assert_eq!(exact_decimal(&format!("1{zeros}"), -10_000), Some(BigRational::one()));
        assert!(exact_decimal("1", -10_000).is_some() && exact_decimal("1", -10_001).is_none());
        assert!(exact_decimal("99", 9_999).is_some() && exact_decimal("99", 10_000).is_none());
        assert_eq!(exact_decimal("1", i64::MIN / 4), None);
    }

    proptest! {
        #[test]
        fn fractions_are_in_lowest_terms(twos in 0u32..20, fives in 0u32..20, odd in 1u64..1000, exponent in -30i64..5) {
            let digits = BigInt::from(odd) * BigInt::from(2u8).pow(twos) * BigInt::from(5u8).pow(fives);
            let ten = BigRational::from_integer(10.into());
            let expected = BigRational::from_integer(digits.clone()) * ten.pow(exponent as i32);
            let found = exact_decimal(&digits.to_string(), exponent).unwrap();
            // Field by field: equality of fractions that are not in lowest terms would not show it.
            prop_assert_eq!((found.numer(), found.denom()), (expected.numer(), expected.denom()));
        }
    }
}
