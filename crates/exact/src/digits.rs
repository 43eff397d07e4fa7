//! Enclosures in short decimal form: the digits that are certain, then the two ends.

use std::fmt;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::Signed;

use super::decimal::{POINT_DIGITS, decimal_bounds, exact_decimal, is_coarse, multiple, power_of_ten_below};
use super::dyadic::Round;
use super::enclosure::Enclosure;

/// Bits that `digits` decimal digits are worth, rounded down: `digits log2(10)`.
pub fn whole_bits(digits: u32) -> u32 {
    log2_of_digits(f64::from(digits)) as u32 // proposes: bits to try
}

/// Bits to compute with first, so that a result may be known to `digits` decimal digits.
///
/// No proof depends on this precision: a result wider than requested is computed again with more bits. The slack of 64 bits suffices
/// while a computation makes its roundings less than `2^64` times as large. A chain of a thousand impacts adds ten bits for its length; a
/// nearly double zero, whose derivative is `2^-40`, adds another 40.
pub fn working_bits(digits: u32) -> u32 {
    const SPARE_BITS: u32 = 64;
    whole_bits(digits) + SPARE_BITS
}

/// `log2(10^digits)`, to nearest.
pub fn log2_of_digits(digits: f64) -> f64 {
    digits * 10f64.log2()
}

/// The enclosure as one decimal number, rounded outward by less than its width on either side.
///
/// In parentheses are the lower and the upper end; the digits before them are certain: `1.23(4,6)` is `[1.234, 1.236]`, and
/// `-1.23(6,4)` is `[-1.236, -1.234]`. Ends without common digits are signed units of the last place:
/// `2.00(-1,+3)` is `[1.99, 2.03]`. A point has no parentheses.
///
/// ```
/// # use impact_pair_exact::{Exact, decimal_digits};
/// let shown = |text: &str| decimal_digits(&Exact::parse(text).unwrap().enclose(30));
/// assert_eq!(shown("[3.140625, 3.15625]"), "3.1(4,6)");
/// assert_eq!(shown("[-3.15625, -3.140625]"), "-3.1(6,4)");
/// assert_eq!(shown("[-0.125, 0.25]"), "0.0(-2,+3)");
/// assert_eq!(shown("0.25"), "0.25");
/// ```
pub fn decimal_digits(x: &Enclosure) -> String {
    let (lo, hi) = (x.inf(), x.sup());
    if is_coarse(lo) || is_coarse(hi) {
        let [lower, upper] = decimal_bounds(x);
        return format!("[{lower}, {upper}]");
    }
    if let Some(point) = Some(lo).filter(|_| lo == hi).and_then(exact_decimal) {
        return point;
    }
    let quantum = match (lo == hi, lo.top()) {
        (true, Some(top)) => power_of_ten_below(top, 1) - POINT_DIGITS + 1,
        _ => hi.plus(&lo.negated(), 64, Round::Down).top().map_or(0, |top| power_of_ten_below(top, 1)),
    };
    let (low, high) = (multiple(lo, quantum, Round::Down), multiple(hi, quantum, Round::Up));
    common_digits(&low, &high, quantum).unwrap_or_else(|| {
        let centre = most_trailing_zeros(&low, &high);
        let [number, power] = spelled(&centre, quantum);
        format!("{number}({:+},{:+}){power}", low - &centre, high - &centre)
    })
}

/// [`decimal_digits`]
impl fmt::Display for Enclosure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&decimal_digits(self))
    }
}

/// `1.23(4,6)`, if the ends have leading digits in common.
fn common_digits(low: &BigInt, high: &BigInt, quantum: i64) -> Option<String> {
    let ([lower, power], [upper, same_power]) = (spelled(low, quantum), spelled(high, quantum));
    if lower.len() != upper.len() || power != same_power || low.sign() != high.sign() {
        return None;
    }
    let common = lower.bytes().zip(upper.bytes()).take_while(|(a, b)| a == b).count();
    let (certain, low_end) = lower.split_at(common);
    let high_end = &upper[common..];
    let has_digits = certain.bytes().any(|digit| matches!(digit, b'1'..=b'9'));
    (has_digits && !low_end.contains('.')).then(|| format!("{certain}({low_end},{high_end}){power}"))
}

/// Integer of `low..=high` with the most trailing zeros; the middle if none ends in a zero.
fn most_trailing_zeros(low: &BigInt, high: &BigInt) -> BigInt {
    let tens = std::iter::successors(Some(BigInt::from(10u8)), |power| Some(power * 10u8));
    tens.map(|ten| high.div_floor(&ten) * ten)
        .take_while(|candidate| candidate >= low)
        .take(high.bits().max(low.bits()) as usize + 1) // exact: as many as it can end on
        .last()
        .unwrap_or_else(|| (low + high).div_floor(&BigInt::from(2u8)))
}

/// `n * 10^quantum` with its last digit in the place of `10^quantum`, and the power of ten, if one is written.
fn spelled(n: &BigInt, quantum: i64) -> [String; 2] {
    let digits = n.magnitude().to_string();
    let leading = quantum + digits.len() as i64 - 1; // exact: a length
    let (places, power) = match leading {
        _ if (-20..=0).contains(&quantum) => (-quantum, String::new()),
        -7..21 if quantum <= 0 => (-quantum, String::new()),
        _ => (leading - quantum, format!("e{leading}")),
    };
    // No format pads to more than 65,535 places.
    let digits = "0".repeat((places as usize + 1).saturating_sub(digits.len())) + &digits; // exact: places are not negative
    let (whole, rest) = digits.split_at(digits.len() - places as usize); // exact: as above
    let (sign, point) = (if n.is_negative() { "-" } else { "" }, if rest.is_empty() { "" } else { "." });
    [format!("{sign}{whole}{point}{rest}"), power]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Dyadic, Exact};
    use num_rational::BigRational;
    use proptest::prelude::*;

    fn value(text: &str) -> BigRational {
        Exact::parse(text).unwrap().as_rational().unwrap().clone()
    }

    #[test]
    fn whole_bits_are_those_of_the_power_of_ten() {
        for digits in 1..=2000 {
            let power = BigInt::from(10).pow(digits);
            // 2^(bits - 1) <= power < 2^bits
            assert_eq!(u64::from(whole_bits(digits)), power.bits() - 1, "{digits}");
        }
    }

    fn enclosure(lo: BigInt, hi: BigInt, e: i64) -> Enclosure {
        Enclosure::new(Dyadic::new(lo, e), Dyadic::new(hi, e)).unwrap()
    }

    /// The ends that a text in this form stands for.
    fn ends(shown: &str) -> [BigRational; 2] {
        let Some((certain, rest)) = shown.split_once('(') else { return [value(shown), value(shown)] };
        let (ends, power) = rest.split_once(')').unwrap();
        let (lower, upper) = ends.split_once(',').unwrap();
        if !lower.starts_with(['-', '+']) {
            return [lower, upper].map(|end| value(&format!("{certain}{end}{power}")));
        }
        let places = certain.split_once('.').map_or(0, |(_, places)| places.len());
        let centre = value(&format!("{certain}{power}"));
        let unit = value(&format!("1{}", if power.is_empty() { "e0" } else { power })) * value(&format!("1e-{places}"));
        [lower, upper].map(|end| &centre + value(end) * &unit)
    }

    #[test]
    fn the_forms_are_distinguished() {
        let shown = |lo: i64, hi: i64, e| decimal_digits(&enclosure(lo.into(), hi.into(), e));
        assert_eq!(shown(20010, 20019, 0), "2001(0,9)");
        assert_eq!(shown(1999, 2001, 0), "2000(-1,+1)");
        assert_eq!(shown(0, 3, 0), "0(+0,+3)");
        assert_eq!(shown(-7, -5, 0), "-6(-1,+1)");
        assert_eq!(shown(-3, 5, -10), "0.000(-3,+5)");
        assert_eq!(shown(123_456, 123_956, 0), "1.2(34,40)e5");
        // 10^70000 in units of 10^-70000
        let [whole, power] = spelled(&BigInt::from(10u8).pow(70_000), -70_000);
        assert!(whole == format!("1.{}", "0".repeat(65_000) + &"0".repeat(5_000)) && power.is_empty());
        assert_eq!(shown((1 << 40) + 1, (1 << 40) + 2, -140), "7.8886090522(17,25)e-31");
    }

    proptest! {
        #[test]
        fn the_printed_bounds_are_within_three_widths(m: i64, n in 0u64..1000, e in -400i64..100, gap in 0u32..60) {
            let lo = BigInt::from(m) << gap;
            let x = enclosure(lo.clone(), lo + n, e);
            let [lower, upper] = ends(&decimal_digits(&x));
            let (lo, hi) = (x.inf().to_rational(), x.sup().to_rational());
            prop_assert!(lower <= lo && hi <= upper);
            prop_assert!(n == 0 || upper - lower <= (hi - lo) * BigRational::from_integer(3.into()));
        }
    }
}
