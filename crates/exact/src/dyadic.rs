//! Dyadic numbers `mantissa * 2^exponent`: the end points of every [`Enclosure`](super::Enclosure).
//!
//! A dyadic is exact. The only inexact functions are named for their direction: `Round::Down` never exceeds the true
//! value and `Round::Up` never falls below it.

use std::cmp::Ordering;

use num_bigint::{BigInt, Sign};
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// Magnitudes below `2^-UNDERFLOW` are rounded outward to zero or to `2^-UNDERFLOW`, so exponents stay far from
/// the ends of `i64` however often tiny numbers are multiplied.
const UNDERFLOW: i64 = 1 << 40;

/// The direction of a rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Round {
    /// Towards minus infinity.
    Down,
    /// Towards plus infinity.
    Up,
}

/// The exact number `mantissa * 2^exponent`.
///
/// The mantissa is kept odd (zero has exponent zero), so equal numbers are equal field by field.
///
/// **Panics** where a sum of exponents leaves `i64`, which needs magnitudes beyond `2^(2^62)`.
///
/// ```
/// use impact_pair_exact::Dyadic;
/// assert_eq!(Dyadic::new(12.into(), -3), Dyadic::from_f64(1.5).unwrap());
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Dyadic {
    mantissa: BigInt,
    exponent: i64,
}

impl Dyadic {
    /// The exact value `mantissa * 2^exponent`.
    pub fn new(mantissa: BigInt, exponent: i64) -> Dyadic {
        match mantissa.trailing_zeros() {
            None => Dyadic { mantissa, exponent: 0 },
            Some(0) => Dyadic { mantissa, exponent },
            // exact: a length in bits
            Some(zeros) => Dyadic { mantissa: mantissa >> zeros, exponent: join(exponent, zeros as i64) },
        }
    }

    /// Zero.
    pub fn zero() -> Dyadic {
        Dyadic { mantissa: BigInt::zero(), exponent: 0 }
    }

    /// The exact value `2^exponent`.
    pub fn power_of_two(exponent: i64) -> Dyadic {
        Dyadic { mantissa: BigInt::one(), exponent }
    }

    /// The exact value of a double; `None` for NaN and the infinities.
    pub fn from_f64(x: f64) -> Option<Dyadic> {
        if !x.is_finite() {
            return None;
        }
        let bits = x.to_bits();
        let (stored, fraction) = ((bits >> 52) as i64 & 0x7ff, bits & ((1 << 52) - 1)); // exact: 11 bits
        let magnitude = if stored == 0 { fraction } else { fraction | 1 << 52 };
        let mantissa = BigInt::from(magnitude);
        // exact: subnormals have the least exponent
        Some(Dyadic::new(if x.is_sign_negative() { -mantissa } else { mantissa }, stored.max(1) - 1075))
    }

    /// The odd integer `m` of `m * 2^e`, or zero.
    pub fn mantissa(&self) -> &BigInt {
        &self.mantissa
    }

    /// The exponent `e` of `m * 2^e`.
    pub fn exponent(&self) -> i64 {
        self.exponent
    }

    /// How the number compares with zero.
    pub fn sign(&self) -> Ordering {
        match self.mantissa.sign() {
            Sign::Minus => Ordering::Less,
            Sign::NoSign => Ordering::Equal,
            Sign::Plus => Ordering::Greater,
        }
    }

    /// True for zero only.
    pub fn is_zero(&self) -> bool {
        self.mantissa.is_zero()
    }

    /// The exact value as a fraction. **Cost**: memory proportional to the size of the exponent.
    pub fn to_rational(&self) -> BigRational {
        if self.exponent >= 0 {
            BigRational::from_integer(&self.mantissa << self.exponent)
        } else {
            // The mantissa is odd, so the fraction is in lowest terms.
            BigRational::new_raw(self.mantissa.clone(), BigInt::one() << self.exponent.unsigned_abs())
        }
    }

    /// The largest double not above the number, `-inf` below the finite doubles.
    pub fn to_f64_down(&self) -> f64 {
        match self.sign() {
            Ordering::Less => -self.magnitude_to_f64(Round::Up),
            _ => self.magnitude_to_f64(Round::Down),
        }
    }

    /// The smallest double not below the number, `inf` above the finite doubles.
    pub fn to_f64_up(&self) -> f64 {
        match self.sign() {
            Ordering::Less => -self.magnitude_to_f64(Round::Down),
            _ => self.magnitude_to_f64(Round::Up),
        }
    }

    /// The double next to `|self|` in the requested direction.
    fn magnitude_to_f64(&self, round: Round) -> f64 {
        let Some(top) = self.top() else { return 0.0 };
        if top > 1023 {
            return if round == Round::Up { f64::INFINITY } else { f64::MAX };
        }
        // Doubles near 2^top are the multiples of 2^quantum.
        let quantum = (top - 52).max(-1074); // X1: the finest double; rounded outward below
        let steps = scale_to_integer(&self.mantissa.abs(), join(self.exponent, -quantum), round);
        let steps: u64 = steps.iter_u64_digits().next().unwrap_or(0); // exact: at most 2^53, no digits for 0
        // steps <= 2^53, and the bit patterns of nonnegative doubles count the multiples of 2^quantum without a
        // gap: a carry into 2^53 runs into the exponent field, and at the very top into the pattern of infinity.
        f64::from_bits((((quantum + 1074) as u64) << 52) + steps) // exact: not negative
    }

    /// `floor(log2 |self|)`, or `None` for zero.
    pub fn top(&self) -> Option<i64> {
        (!self.is_zero()).then(|| join(self.exponent, self.mantissa.bits() as i64 - 1)) // exact: a length in bits
    }

    /// The exact negative.
    pub(crate) fn negated(&self) -> Dyadic {
        Dyadic { mantissa: -&self.mantissa, exponent: self.exponent }
    }

    /// The exact absolute value.
    pub(crate) fn magnitude(&self) -> Dyadic {
        Dyadic { mantissa: self.mantissa.abs(), exponent: self.exponent }
    }

    /// The exact product.
    pub fn times(&self, other: &Dyadic) -> Dyadic {
        Dyadic::new(&self.mantissa * &other.mantissa, join(self.exponent, other.exponent))
    }

    /// The exact product with `2^shift`.
    pub fn scaled(&self, shift: i64) -> Dyadic {
        if self.is_zero() {
            return Dyadic::zero();
        }
        Dyadic { mantissa: self.mantissa.clone(), exponent: join(self.exponent, shift) }
    }

    /// The exact middle of two dyadics. **Cost**: memory proportional to the difference of their exponents.
    pub fn middle(&self, other: &Dyadic) -> Dyadic {
        let unit = self.exponent.min(other.exponent); // exact: the unit of both
        let sum = (&self.mantissa << (self.exponent - unit)) + (&other.mantissa << (other.exponent - unit));
        Dyadic::new(sum, join(unit, -1))
    }

    /// A dyadic of at most `bits` mantissa bits, on the side of `mantissa * 2^exponent` that `round` says.
    fn near(mantissa: BigInt, exponent: i64, bits: u32, round: Round) -> Dyadic {
        if mantissa.is_zero() {
            return Dyadic::zero();
        }
        let length = mantissa.bits() as i64; // exact: a length in bits
        if join(exponent, length - 1) < -UNDERFLOW {
            return match (mantissa.sign(), round) {
                (Sign::Plus, Round::Up) => Dyadic::power_of_two(-UNDERFLOW),
                (Sign::Minus, Round::Down) => Dyadic::power_of_two(-UNDERFLOW).negated(),
                _ => Dyadic::zero(),
            };
        }
        let excess = length - i64::from(bits.max(1)); // X1: one bit at least, rounded outward
        match u64::try_from(excess) {
            Ok(times @ 1..) => Dyadic::new(halved(mantissa, times, round), join(exponent, excess)),
            _ => Dyadic::new(mantissa, exponent),
        }
    }

    /// A dyadic of at most `bits` mantissa bits, on the side of `self` that `round` says.
    pub(crate) fn rounded(self, bits: u32, round: Round) -> Dyadic {
        Dyadic::near(self.mantissa, self.exponent, bits, round)
    }

    /// The sum, rounded to `bits` mantissa bits. **Cost**: bounded by `bits` and the mantissas, not by the exponents.
    pub(crate) fn plus(&self, other: &Dyadic, bits: u32, round: Round) -> Dyadic {
        let (large, small) = if self.top() >= other.top() { (self, other) } else { (other, self) };
        let Some(top) = large.top() else {
            return Dyadic::zero();
        };
        if small.is_zero() {
            return large.clone().rounded(bits, round);
        }
        let exact = small.exponent.min(large.exponent); // exact: the unit of both
        // Tops that differ by two or more cannot cancel: the sum keeps the top of `large` up to one bit, so bits of
        // `small` far below the last bit wanted only matter by their direction. Otherwise the sum is formed exactly,
        // in no more bits than the two mantissas have.
        let cancels = small.top().is_some_and(|small| top - small <= 1);
        // X1: coarser units round outward
        let unit = if cancels { exact } else { large.exponent.min(top - i64::from(bits) - 4).max(exact) };
        let small = scale_to_integer(&small.mantissa, join(small.exponent, -unit), round);
        let sum = match large.exponent - unit {
            0 => small + &large.mantissa,
            shift => small + (&large.mantissa << shift),
        };
        Dyadic::near(sum, unit, bits, round)
    }

    /// The quotient, rounded to `bits` mantissa bits; the divisor must not be zero.
    pub(crate) fn over(&self, divisor: &Dyadic, bits: u32, round: Round) -> Dyadic {
        let Dyadic { mantissa, exponent } = divide(&self.mantissa, &divisor.mantissa, bits, round);
        Dyadic::near(mantissa, join(exponent, join(self.exponent, -divisor.exponent)), bits, round)
    }
}

impl Ord for Dyadic {
    fn cmp(&self, other: &Dyadic) -> Ordering {
        let by_sign = self.sign().cmp(&other.sign());
        if by_sign.is_ne() || self.is_zero() {
            return by_sign;
        }
        let by_top = match self.top().cmp(&other.top()) {
            // Equal tops: the shift is bounded by the longer mantissa.
            Ordering::Equal => {
                return match self.exponent - other.exponent {
                    0 => self.mantissa.cmp(&other.mantissa),
                    shift @ 1.. => (&self.mantissa << shift).cmp(&other.mantissa),
                    shift => self.mantissa.cmp(&(&other.mantissa << -shift)),
                };
            }
            unequal => unequal,
        };
        if self.sign().is_lt() { by_top.reverse() } else { by_top }
    }
}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Dyadic) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Compares a dyadic with a fraction, exactly.
pub fn compare_rational(x: &Dyadic, y: &BigRational) -> Ordering {
    let scaled = &x.mantissa * y.denom();
    Dyadic::new(scaled, x.exponent).cmp(&Dyadic::new(y.numer().clone(), 0))
}

/// `numerator / denominator` (not zero), rounded to at least `bits` significant bits.
pub(crate) fn divide(numerator: &BigInt, denominator: &BigInt, bits: u32, round: Round) -> Dyadic {
    // The quotient of integers of lengths n + shift and d has at least n + shift - d bits.
    let shift = i64::from(bits) + 2 + denominator.bits() as i64 - numerator.bits() as i64; // exact: lengths in bits
    let (numerator, denominator) = if shift >= 0 {
        (numerator << shift, denominator.clone())
    } else {
        (numerator.clone(), denominator << shift.unsigned_abs())
    };
    Dyadic::new(divide_to_integer(&numerator, &denominator, round), -shift)
}

/// `numerator / denominator` rounded to an integer in the requested direction.
pub(crate) fn divide_to_integer(numerator: &BigInt, denominator: &BigInt, round: Round) -> BigInt {
    use num_integer::Integer;
    match round {
        Round::Down => numerator.div_floor(denominator),
        Round::Up => -(-numerator).div_floor(denominator),
    }
}

/// `x * 2^shift` rounded to an integer in the requested direction.
pub(crate) fn scale_to_integer(x: &BigInt, shift: i64, round: Round) -> BigInt {
    if shift >= 0 { x << shift } else { halved(x.clone(), shift.unsigned_abs(), round) }
}

/// `x / 2^times` rounded to an integer in the requested direction.
fn halved(x: BigInt, times: u64, round: Round) -> BigInt {
    match round {
        // NOTE: `>>` of a negative BigInt rounds towards minus infinity (tested below).
        Round::Down => x >> times,
        Round::Up => -(-x >> times),
    }
}

/// Sum of exponents. NOTE: checked, since a wrapped exponent would be a silently wrong enclosure.
fn join(a: i64, b: i64) -> i64 {
    a.checked_add(b).expect("magnitude beyond 2^(2^62): exponent overflow in `exact`")
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn dyadic(m: i64, e: i64) -> Dyadic {
        Dyadic::new(m.into(), e)
    }

    #[test]
    fn right_shift_of_negative_integers_rounds_down() {
        assert_eq!(BigInt::from(-5) >> 1u64, BigInt::from(-3));
        assert_eq!(BigInt::from(-5) >> 1000u64, BigInt::from(-1));
        assert_eq!(scale_to_integer(&BigInt::from(-5), -1, Round::Up), BigInt::from(-2));
    }

    #[test]
    fn sums_of_far_apart_magnitudes_stay_small_and_outward() {
        let (one, tiny) = (dyadic(1, 0), dyadic(-1, -1_000_000_000_000));
        let (lo, hi) = (one.plus(&tiny, 53, Round::Down), one.plus(&tiny, 53, Round::Up));
        assert!(lo < one && hi == one && lo.mantissa().bits() <= 53);
    }

    #[test]
    fn differences_that_cancel_are_exact() {
        let below_one = dyadic(1, 0).plus(&dyadic(-1, -72), 80, Round::Down);
        assert_eq!(dyadic(1, 0).plus(&below_one.negated(), 4, Round::Up), dyadic(1, -72));
    }

    #[test]
    fn doubles_at_the_edges_of_the_format() {
        assert_eq!(dyadic(1, -1075).to_f64_down(), 0.0);
        assert_eq!(dyadic(1, -1075).to_f64_up(), 5e-324);
        assert_eq!(dyadic(-1, -9999).to_f64_down(), -5e-324);
        assert!(dyadic(-1, -9999).to_f64_up() == 0.0);
        assert_eq!(dyadic(1, 1024).to_f64_down(), f64::MAX);
        assert_eq!(dyadic((1 << 54) - 1, 970).to_f64_up(), f64::INFINITY);
        assert_eq!(dyadic((1 << 54) - 1, 970).to_f64_down(), f64::MAX);
        assert_eq!(dyadic((1 << 53) - 1, -1075).to_f64_up(), f64::MIN_POSITIVE);
    }

    proptest! {
        #[test]
        fn a_double_survives_the_round_trip(bits: u64) {
            let x = f64::from_bits(bits);
            if let Some(d) = Dyadic::from_f64(x) {
                prop_assert_eq!(d.to_f64_down(), x);
                prop_assert_eq!(d.to_f64_up(), x);
            }
        }

        #[test]
        fn a_middle_is_as_far_from_both(m: i64, e in -300i64..300, n: i64, f in -300i64..300) {
            let (a, b) = (dyadic(m, e), dyadic(n, f));
            prop_assert_eq!(a.middle(&b).scaled(1).to_rational(), a.to_rational() + b.to_rational());
        }

        #[test]
        fn doubles_bracket_and_are_neighbours(m: i64, n: i64, e in -1200i64..900) {
            let d = Dyadic::new(BigInt::from(m) * BigInt::from(n), e);
            let (lo, hi) = (d.to_f64_down(), d.to_f64_up());
            prop_assert!(Dyadic::from_f64(lo).is_none_or(|lo| lo <= d) && Dyadic::from_f64(hi).is_none_or(|hi| d <= hi));
            prop_assert!(lo == hi || lo.next_up() == hi);
        }

        #[test]
        fn rounded_operations_bracket_the_exact_ones(m: i64, e in -90i64..90, n: i64, g in -90i64..90, bits in 1u32..70) {
            let (a, b) = (dyadic(m, e), dyadic(n, g));
            let exact = a.to_rational() + b.to_rational();
            let (lo, hi) = (a.plus(&b, bits, Round::Down), a.plus(&b, bits, Round::Up));
            prop_assert!(lo.to_rational() <= exact && exact <= hi.to_rational());
            prop_assert!(lo.mantissa().bits() <= u64::from(bits));
            prop_assert_eq!(a.cmp(&b), a.to_rational().cmp(&b.to_rational()));
            if n != 0 {
                let exact = a.to_rational() / b.to_rational();
                let (lo, hi) = (a.over(&b, bits, Round::Down), a.over(&b, bits, Round::Up));
                prop_assert!(lo.to_rational() <= exact && exact <= hi.to_rational());
                prop_assert_eq!(compare_rational(&lo, &exact), lo.to_rational().cmp(&exact));
            }
        }
    }
}
