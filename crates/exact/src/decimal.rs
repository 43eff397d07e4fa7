//! Decimal printing, rounded outward: the printed lower bound is never above the true one, nor the upper one below.
//!
//! The strings are JSON numbers and are read back exactly by [`Exact::parse`](super::Exact::parse).

use std::sync::OnceLock;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Signed, Zero};

use super::dyadic::{Dyadic, Round, divide_to_integer, scale_to_integer};
use super::enclosure::Enclosure;

/// A point whose exact decimal has more significant digits than this is rounded outward instead.
const LONGEST_EXACT: usize = 60;
/// Significant digits of a point whose exact decimal is too long.
pub(super) const POINT_DIGITS: i64 = 40;
/// Ends beyond `2^MAX_PRINTED_EXPONENT` or below `2^-COARSE` are printed as the nearest power of ten outward.
const MAX_PRINTED_EXPONENT: i64 = 1 << 18;
/// Powers of ten kept in a table.
const CACHED_POWERS: usize = 512;

/// Decimal bounds `[lower, upper]` that hold the whole enclosure and are at most 1.01 times as wide.
///
/// A point with a short decimal is printed exactly, any other point to 40 digits outward. (The factor is not promised where an
/// end is not zero but beyond `2^(+-2^18)`.)
///
/// ```
/// use impact_pair_exact::{Enclosure, Exact, decimal_bounds};
/// let third = Exact::parse("1/3").unwrap().enclose(10);
/// assert_eq!(decimal_bounds(&third), ["0.3333129", "0.3333741"]);
/// assert_eq!(decimal_bounds(&Enclosure::from_f64_bounds(0.25, 0.25).unwrap()), ["0.25", "0.25"]);
/// ```
pub fn decimal_bounds(x: &Enclosure) -> [String; 2] {
    bounds(x.inf(), x.sup())
}

/// Decimal bounds that hold every real number between two doubles, whichever comes first; as [`decimal_bounds`].
///
/// An infinite end is printed as `inf` or `-inf`; a NaN stands for the whole line.
///
/// ```
/// # use impact_pair_exact::decimal_bounds_f64;
/// assert_eq!(decimal_bounds_f64(1.0, 2.5), ["1", "2.5"]);
/// assert_eq!(decimal_bounds_f64(1e-300, f64::INFINITY)[1], "inf");
/// ```
pub fn decimal_bounds_f64(lo: f64, hi: f64) -> [String; 2] {
    if lo.is_nan() || hi.is_nan() {
        return ["-inf".into(), "inf".into()];
    }
    let (lo, hi) = if lo <= hi { (lo, hi) } else { (hi, lo) };
    match (Dyadic::from_f64(lo), Dyadic::from_f64(hi)) {
        (Some(lo), Some(hi)) => bounds(&lo, &hi),
        (finite_lo, finite_hi) => {
            let lower = finite_lo.map_or_else(|| infinite(lo), |lo| point_bound(&lo, Round::Down));
            let upper = finite_hi.map_or_else(|| infinite(hi), |hi| point_bound(&hi, Round::Up));
            [lower, upper]
        }
    }
}

/// The shortest decimal that reads back as the same double; not a bound.
///
/// ```
/// # use impact_pair_exact::decimal_f64;
/// assert_eq!([decimal_f64(0.1), decimal_f64(-2.0), decimal_f64(1e-300)], ["0.1", "-2", "1e-300"]);
/// ```
pub fn decimal_f64(x: f64) -> String {
    let text = format!("{x:e}");
    let Some((digits, exponent)) = text.split_once('e').filter(|_| x.is_finite()) else {
        return if x.is_nan() { "nan".into() } else { infinite(x) };
    };
    let places = digits.split_once('.').map_or(0, |(_, places)| places.len() as i64); // exact: a length
    let integer: BigInt = digits.replace('.', "").parse().expect("digits of a finite double");
    let exponent: i64 = exponent.parse().expect("the exponent of a finite double");
    DecimalDigits::new(&integer, exponent - places).to_string()
}

/// The name of an infinite double.
fn infinite(x: f64) -> String {
    if x > 0.0 { "inf".into() } else { "-inf".into() }
}

/// Both bounds of `[lo, hi]`.
fn bounds(lo: &Dyadic, hi: &Dyadic) -> [String; 2] {
    if lo == hi {
        return [point_bound(lo, Round::Down), point_bound(hi, Round::Up)];
    }
    if is_coarse(lo) || is_coarse(hi) {
        return [coarse_or_point_bound(lo, Round::Down), coarse_or_point_bound(hi, Round::Up)];
    }
    // Both ends move by less than 10^t <= width / 200, so the width grows by less than a hundredth.
    let width = hi.plus(&lo.negated(), 64, Round::Down);
    let quantum = width.top().map_or(0, |top| power_of_ten_below(top, 200));
    [rounded_at(lo, quantum, Round::Down), rounded_at(hi, quantum, Round::Up)]
}

/// One bound of a point: its exact decimal if short, else 40 digits outward.
fn point_bound(x: &Dyadic, round: Round) -> String {
    let Some(top) = x.top() else {
        return "0".into();
    };
    if is_coarse(x) {
        return coarse_bound(x, round);
    }
    exact_decimal(x).unwrap_or_else(|| rounded_at(x, power_of_ten_below(top, 1) - POINT_DIGITS + 1, round))
}

/// The exact decimal of a dyadic of moderate size, if it is short.
pub(super) fn exact_decimal(x: &Dyadic) -> Option<String> {
    // m * 2^-k = (m * 5^k) / 10^k, and 5^k alone has more than 60 digits for k > 85.
    let (digits, exponent) = if x.exponent() >= 0 {
        (x.mantissa() << x.exponent(), 0)
    } else if x.exponent() >= -86 {
        (x.mantissa() * BigInt::from(5u8).pow(x.exponent().unsigned_abs() as u32), x.exponent()) // exact: at most 86
    } else {
        return None;
    };
    let digits = DecimalDigits::new(&digits, exponent);
    (digits.digits.len() <= LONGEST_EXACT).then(|| digits.to_string())
}

/// `x` rounded to a multiple of `10^quantum` in the requested direction.
fn rounded_at(x: &Dyadic, quantum: i64, round: Round) -> String {
    DecimalDigits::new(&multiple(x, quantum, round), quantum).to_string()
}

/// `x / 10^quantum`, rounded to an integer in the requested direction.
pub(super) fn multiple(x: &Dyadic, quantum: i64, round: Round) -> BigInt {
    let (m, e) = (x.mantissa(), x.exponent());
    if quantum <= 0 {
        with_power_of_ten(quantum.unsigned_abs(), |power| scale_to_integer(&(m * power), e, round))
    } else {
        with_power_of_ten(quantum.unsigned_abs(), |power| {
            if e >= 0 {
                divide_to_integer(&(m << e), power, round)
            } else {
                divide_to_integer(m, &(power << e.unsigned_abs()), round)
            }
        })
    }
}

/// An integer t with `10^t <= 2^top / divisor`, short of the largest by at most one (`divisor` 1 or 200).
pub(super) fn power_of_ten_below(top: i64, divisor: u8) -> i64 {
    // log10 2 = 0.30102999566398119...; the 13-digit bounds below are on the safe side for either sign of top.
    let log_two: i128 = if top >= 0 { 3_010_299_956_639 } else { 3_010_299_956_640 };
    // log10 200 = 2.3010299956639...
    let log_divisor: i128 = if divisor == 1 { 0 } else { 23_010_299_956_640 };
    let scaled = i128::from(top) * log_two - log_divisor;
    Integer::div_floor(&scaled, &10_000_000_000_000) as i64 // exact: less than |top|
}

/// True for a number, not zero, too large or too small to be written out digit by digit.
pub(super) fn is_coarse(x: &Dyadic) -> bool {
    x.top().is_some_and(|top| top.abs() > MAX_PRINTED_EXPONENT || x.exponent() < -8 * MAX_PRINTED_EXPONENT)
}

/// The bound of an end whose partner is extreme.
fn coarse_or_point_bound(x: &Dyadic, round: Round) -> String {
    if is_coarse(x) { coarse_bound(x, round) } else { point_bound(x, round) }
}

/// A power of ten (or zero) on the side of x that `round` says, found from the binary exponent alone.
fn coarse_bound(x: &Dyadic, round: Round) -> String {
    let Some(top) = x.top() else {
        return "0".into();
    };
    let negative = x.sign().is_lt();
    let away_from_zero = negative == (round == Round::Down);
    let sign = if negative { "-" } else { "" };
    if away_from_zero {
        // |x| < 2^(top + 1) = 1 / 2^-(top + 1) <= 10^-t.
        format!("{sign}1e{}", -power_of_ten_below(-(top + 1), 1))
    } else {
        format!("{sign}1e{}", power_of_ten_below(top, 1))
    }
}

/// Calls `f` with `10^n`, from a table when n is moderate.
fn with_power_of_ten<T>(n: u64, f: impl FnOnce(&BigInt) -> T) -> T {
    static POWERS: OnceLock<Vec<BigInt>> = OnceLock::new();
    let powers = POWERS.get_or_init(|| {
        std::iter::successors(Some(BigInt::from(1u8)), |power| Some(power * 10u8)).take(CACHED_POWERS).collect()
    });
    let n = usize::try_from(n).expect("a power of ten that fits into memory");
    match powers.get(n) {
        Some(power) => f(power),
        None => f(&num_traits::pow(BigInt::from(10u8), n)),
    }
}

/// The decimal `+-digits * 10^exponent`, with no trailing zero digits.
pub(crate) struct DecimalDigits {
    negative: bool,
    pub(crate) digits: String,
    exponent: i64,
}

impl DecimalDigits {
    /// Exactly `integer * 10^exponent`.
    pub(crate) fn new(integer: &BigInt, exponent: i64) -> DecimalDigits {
        let mut digits = match u128::try_from(integer.magnitude()) {
            Ok(small) => small.to_string(),
            Err(_) => integer.magnitude().to_string(),
        };
        let kept = digits.trim_end_matches('0').len();
        let exponent = exponent + (digits.len() - kept) as i64; // exact: a length
        digits.truncate(kept);
        DecimalDigits {
            negative: integer.is_negative(),
            digits,
            exponent: if integer.is_zero() { 0 } else { exponent },
        }
    }
}

/// Positional for `1e-7 <= |x| < 1e21`, else scientific; zero is `0`, never `-0`.
impl std::fmt::Display for DecimalDigits {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.digits.is_empty() {
            return f.write_str("0");
        }
        if self.negative {
            f.write_str("-")?;
        }
        let digits = self.digits.as_str();
        // The value lies in [10^leading, 10^(leading + 1)).
        let leading = self.exponent + digits.len() as i64 - 1; // exact: a length
        let zeros = |n: i64| &"000000000000000000000"[..n as usize]; // exact: from 0 to 21
        match leading {
            -7..0 => {
                f.write_str("0.")?;
                f.write_str(zeros(-leading - 1))?;
                f.write_str(digits)
            }
            0..21 if self.exponent >= 0 => {
                f.write_str(digits)?;
                f.write_str(zeros(self.exponent))
            }
            0..21 => {
                let (whole, places) = digits.split_at(leading as usize + 1); // exact: from 0 to 20
                f.write_str(whole)?;
                f.write_str(".")?;
                f.write_str(places)
            }
            _ => {
                let (whole, places) = digits.split_at(1);
                f.write_str(whole)?;
                if !places.is_empty() {
                    f.write_str(".")?;
                    f.write_str(places)?;
                }
                write!(f, "e{leading}")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Exact;
    use num_rational::BigRational;
    use proptest::prelude::*;

    fn value(text: &str) -> BigRational {
        Exact::parse(text).unwrap().as_rational().unwrap().clone()
    }

    fn dyadic(m: i64, e: i64) -> Dyadic {
        Dyadic::new(m.into(), e)
    }

    #[test]
    fn short_points_are_printed_exactly() {
        let cases = [
            (dyadic(0, 0), "0"),
            (dyadic(-1, 0), "-1"),
            (dyadic(100, 0), "100"),
            (dyadic(1, -2), "0.25"),
            (dyadic(-3, -20), "-0.000002861022949219"),
            (Dyadic::new(BigInt::from(10u8).pow(20), 0), "100000000000000000000"),
            (Dyadic::new(BigInt::from(10u8).pow(21) * 3, 0), "3e21"),
            (Dyadic::new(BigInt::from(10u8).pow(300) * 15, 0), "1.5e301"),
        ];
        for (x, text) in cases {
            let printed = decimal_bounds(&Enclosure::point(x.clone()));
            assert_eq!(printed[0], printed[1]);
            assert_eq!(value(&printed[0]), x.to_rational());
            if text.len() < 18 {
                assert_eq!(printed[0], text);
            }
        }
    }

    #[test]
    fn long_points_are_rounded_outward_at_forty_digits() {
        let [lower, upper] = decimal_bounds_f64(-1e-300, -1e-300);
        assert!(value(&lower) < value(&upper));
        assert!(
            lower.starts_with("-1.00000000000000002505909") && lower.ends_with("e-300") && lower.len() <= 49,
            "{lower}"
        );
        let exact = Dyadic::from_f64(-1e-300).unwrap().to_rational();
        assert!(value(&lower) < exact && exact < value(&upper));
    }

    #[test]
    fn infinite_and_extreme_ends() {
        assert_eq!(decimal_bounds_f64(f64::NAN, 1.0), ["-inf", "inf"]);
        assert_eq!(decimal_bounds_f64(f64::NEG_INFINITY, 2.5), ["-inf", "2.5"]);
        assert_eq!(decimal_bounds_f64(3.0, -0.0), ["0", "3"]);
        // Of 1e-300 the forty digits that are printed are not all.
        let exact = Dyadic::from_f64(1e-300).unwrap().to_rational();
        assert!(value(&decimal_bounds_f64(1e-300, f64::INFINITY)[0]) < exact);
        assert!(exact < value(&decimal_bounds_f64(f64::NEG_INFINITY, 1e-300)[1]));
        let tiny = Enclosure::new(dyadic(-1, -1 << 40), dyadic(1, 1 << 40)).unwrap();
        assert_eq!(decimal_bounds(&tiny), ["-1e-330985980541", "1e330985980543"]); // 2^(2^40) = 10^330985980541.9...
    }

    proptest! {
        #[test]
        fn shortest_decimals_read_back(bits: u64) {
            let x = f64::from_bits(bits);
            prop_assume!(x.is_finite());
            prop_assert_eq!(decimal_f64(x).parse::<f64>().unwrap(), x);
        }

        #[test]
        fn printed_bounds_bracket_tightly(m: i64, n in prop_oneof![Just(0u64), 1u64..5, any::<u64>()], e in -1100i64..1000, gap in 0u32..60) {
            let lo = BigInt::from(m) << gap;
            let x = Enclosure::new(Dyadic::new(lo.clone(), e), Dyadic::new(lo + n, e)).unwrap();
            let [lower, upper] = decimal_bounds(&x);
            let (printed_lo, printed_hi) = (value(&lower), value(&upper));
            let (lo, hi) = (x.inf().to_rational(), x.sup().to_rational());
            prop_assert!(printed_lo <= lo && hi <= printed_hi);
            prop_assert!(lower != "-0" && upper != "-0");
            if n != 0 {
                prop_assert!((printed_hi - printed_lo) * BigRational::from_integer(100.into()) <= (hi - lo) * BigRational::from_integer(101.into()));
            }
        }

        #[test]
        fn printed_doubles_bracket(a: u64, ulps in 0u64..3) {
            let lo = f64::from_bits(a);
            let hi = f64::from_bits(a.saturating_add(ulps));
            let [lower, upper] = decimal_bounds_f64(lo, hi);
            if lo.is_finite() && hi.is_finite() {
                let exact = |x: f64| Dyadic::from_f64(x).unwrap().to_rational();
                prop_assert!(value(&lower) <= exact(lo.min(hi)) && exact(lo.max(hi)) <= value(&upper));
            }
        }
    }
}
