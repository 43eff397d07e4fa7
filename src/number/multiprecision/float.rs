//! Numbers of many bits: a whole number of any size times a power of two.
//!
//! A [`Float`] is `mantissa * 2^exponent`, and a number of bits that results are rounded to. Each operation of
//! [`super::operations`] computes the whole result, or enough of it to round as the whole would be, and says whether
//! it was exact: a radius of 0 decides grazes and signs. **Lemma M1**, `docs/proofs/multiprecision.md#M1`.
//!
//! - Mantissas have no unneeded bits below: 1 is one bit long in any precision, and products with it cost nothing.
//! - A sum of numbers that are far apart moves no mantissa by more bits than the result has, and 3: of the smaller one
//!   only its sign is left. So `1 + 2^-1000000000` needs no memory.
//! - Beyond `2^(2^40)`, and below its inverse, and where a quotient or a root is not defined, there is no number:
//!   [`Float::is_number`] is false, nothing is compared with it, and its size has no bound.

use std::cmp::Ordering;
use std::ops::Neg;

use num_bigint::{BigInt, BigUint, Sign};
use num_traits::Zero;

use crate::exact::Dyadic;
use crate::number::Magnitude;

/// Greatest exponent in size: beyond it a result is no number.
const MOST_EXPONENT: i64 = 1 << 40;

/// The direction of a rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Round {
    /// To the nearest number, of two equally near ones to the one farther from 0.
    Nearest,
    /// Towards minus infinity.
    Down,
    /// Towards plus infinity.
    Up,
}

/// `mantissa * 2^exponent`, rounded to a number of bits when it was computed; or no number.
///
/// ```
/// use impact_pair::number::Float;
/// let third = Float::new(1.0).over(&Float::new(3.0), 200);
/// assert_eq!(third.bits(), 200);
/// assert!(third.plus(&third.times(&Float::new(2.0), 200), 100) == 1.0);
/// ```
#[derive(Clone, Debug)]
pub struct Float {
    pub(super) mantissa: BigInt,
    /// 0 for 0; `i64::MAX` where there is no number.
    pub(super) exponent: i64,
    pub(super) bits: u32,
}

/// A length in bits.
pub(super) fn length(x: &BigInt) -> i64 {
    x.bits() as i64 // exact: memory has fewer bits
}

impl Float {
    /// The double `x`, exactly; no number for one that is not finite.
    pub fn new(x: f64) -> Self {
        match Dyadic::from_f64(x) {
            Some(dyadic) => Self::exactly(&dyadic, f64::MANTISSA_DIGITS),
            None => Self::none(f64::MANTISSA_DIGITS),
        }
    }

    /// The double `x`, rounded to `bits` bits.
    pub fn with_bits(x: f64, bits: u32) -> Self {
        Self::new(x).rounded(bits)
    }

    /// 0, for results of `bits` bits.
    pub fn zero(bits: u32) -> Self {
        Self { mantissa: BigInt::ZERO, exponent: 0, bits }
    }

    /// The whole number `n`, exactly.
    pub fn whole(n: i64) -> Self {
        Self { mantissa: n.into(), exponent: 0, bits: u64::BITS }
    }

    /// The result that is no number.
    pub(super) fn none(bits: u32) -> Self {
        Self { mantissa: BigInt::ZERO, exponent: i64::MAX, bits }
    }

    /// A dyadic number with all of its bits, and `bits` at least.
    pub(crate) fn exactly(x: &Dyadic, bits: u32) -> Self {
        let own = u32::try_from(x.mantissa().bits()).expect("exact numbers are far shorter");
        Self { mantissa: x.mantissa().clone(), exponent: x.exponent(), bits: bits.max(own) } // exact: all of its bits
    }

    /// `mantissa * 2^exponent`, rounded to `bits` bits, and whether that is exact (Lemma M1).
    pub(super) fn rounding(mantissa: BigInt, exponent: i64, bits: u32, round: Round) -> (Self, bool) {
        let excess = mantissa.bits().saturating_sub(u64::from(bits)); // M1: 0 where the number is short enough
        if excess == 0 {
            return Self { mantissa, exponent, bits }.in_range(true);
        }
        let is_exact = mantissa.trailing_zeros().is_none_or(|zeros| zeros >= excess);
        let (sign, mut size) = mantissa.into_parts();
        let is_away = match round {
            Round::Nearest => size.bit(excess - 1),
            Round::Down => sign == Sign::Minus,
            Round::Up => sign == Sign::Plus,
        };
        size >>= excess;
        if is_away && !is_exact {
            size += 1u32;
        }
        let exponent = exponent + excess as i64; // exact: a length in bits
        Self { mantissa: BigInt::from_biguint(sign, size), exponent, bits }.in_range(is_exact)
    }

    /// No number, and not exact, beyond the range of exponents.
    fn in_range(mut self, is_exact: bool) -> (Self, bool) {
        if self.mantissa.is_zero() {
            self.exponent = 0;
        } else if (self.exponent + length(&self.mantissa)).abs() > MOST_EXPONENT {
            return (Self::none(self.bits), false);
        }
        (self, is_exact)
    }

    /// Bits that results are rounded to.
    #[inline]
    pub fn bits(&self) -> u32 {
        self.bits
    }

    /// Returns whether it is a number.
    #[inline]
    pub fn is_number(&self) -> bool {
        self.exponent != i64::MAX
    }

    /// Returns whether it is 0.
    #[inline]
    pub fn is_zero(&self) -> bool {
        self.is_number() && self.mantissa.is_zero()
    }

    /// `e` such that it is in `[2^(e - 1), 2^e)` in size; `None` for 0 and for no number.
    #[inline]
    pub fn top(&self) -> Option<i64> {
        (!self.mantissa.is_zero()).then(|| self.exponent + length(&self.mantissa))
    }

    /// How it compares with 0.
    #[inline]
    pub fn sign(&self) -> Option<Ordering> {
        self.is_number().then(|| self.mantissa.sign().cmp(&Sign::NoSign))
    }

    /// The nearest number of `bits` bits.
    pub fn rounded(&self, bits: u32) -> Self {
        self.clone().into_bits(bits, Round::Nearest).0
    }

    /// The number rounded to `bits` bits, and whether the rounding is exact.
    pub(super) fn into_bits(self, bits: u32, round: Round) -> (Self, bool) {
        if !self.is_number() {
            return (Self { bits, ..self }, false);
        }
        Self::rounding(self.mantissa, self.exponent, bits, round)
    }

    /// The product with `2^by`, exactly.
    pub fn scaled(mut self, by: i64) -> Self {
        if self.is_number() && !self.is_zero() {
            self.exponent += by.clamp(-4 * MOST_EXPONENT, 4 * MOST_EXPONENT); // M1: farther is no number either
        }
        self.in_range(true).0
    }

    /// `|x|`
    pub fn abs(self) -> Self {
        let (_, size) = self.mantissa.into_parts();
        Self { mantissa: size.into(), ..self }
    }

    /// The whole number at or below it, exactly.
    pub fn floor(&self) -> Self {
        self.whole_near(Round::Down)
    }

    /// The whole number at or above it, exactly.
    pub fn ceil(&self) -> Self {
        self.whole_near(Round::Up)
    }

    /// The nearest whole number, exactly.
    pub fn round(&self) -> Self {
        self.whole_near(Round::Nearest)
    }

    fn whole_near(&self, round: Round) -> Self {
        if self.exponent >= 0 {
            return self.clone();
        }
        // Below 1 there are no bits left to round to.
        let whole = match (self.top(), round) {
            (Some(..0), Round::Nearest) | (None, _) => return Self::zero(self.bits),
            (Some(..=0), _) => return self.whole_below_one(round),
            (Some(top), _) => u32::try_from(top).expect("fewer bits than the mantissa has"),
        };
        Self { bits: self.bits, ..self.clone().into_bits(whole, round).0 }
    }

    /// The same for a number below 1 in size, and not 0; of at least 1/2 if it is the nearest one.
    fn whole_below_one(&self, round: Round) -> Self {
        let is_negative = self.mantissa.sign() == Sign::Minus;
        let is_away = match round {
            Round::Nearest => true,
            Round::Down => is_negative,
            Round::Up => !is_negative,
        };
        let size = BigInt::from(i32::from(is_away)); // exact: 0 or 1
        Self { mantissa: if is_negative { -size } else { size }, exponent: 0, bits: self.bits }
    }

    /// The number of 64 bits next to its size or equal to it, towards 0, its exponent, and whether it is equal.
    fn leading(&self) -> (u64, i64, bool) {
        let size = self.mantissa.magnitude();
        let Some(top) = self.top() else { return (0, 0, true) };
        let mut digits = size.iter_u64_digits().rev();
        let [first, second] = [0; 2].map(|none| digits.next().unwrap_or(none)); // exact: no digits are zeros
        let (zeros, length) = (first.leading_zeros(), size.bits());
        let lead = first << zeros | second.checked_shr(u64::BITS - zeros).unwrap_or(0); // exact: no digits are zeros
        let is_equal = length <= 64 || size.trailing_zeros().is_none_or(|zeros| zeros >= length - 64);
        (lead, top - 64, is_equal)
    }

    /// The nearest double; of subnormal ones one of the two nearest.
    pub fn to_f64(&self) -> f64 {
        if !self.is_number() {
            return f64::NAN;
        }
        let (lead, exponent, is_equal) = self.leading();
        let size = (lead | u64::from(!is_equal)) as f64; // M1: the last bit says on which side of the middle it is
        let steps = exponent.clamp(-1200, 1200) as i32; // M1: beyond that it is 0 or infinite
        let half = steps / 2;
        let size = size * 2f64.powi(half) * 2f64.powi(steps - half);
        if self.mantissa.sign() == Sign::Minus { -size } else { size }
    }

    /// `|x|` rounded up.
    #[inline]
    pub(crate) fn magnitude(&self) -> Magnitude {
        if !self.is_number() {
            return Magnitude::INFINITE;
        }
        let (lead, exponent, is_equal) = self.leading();
        // 53 bits, and one more unit for all that is below.
        let (size, rest) = (lead >> 11, lead & 0x7ff);
        let more = u64::from(rest != 0 || !is_equal);
        Magnitude::new((size + more) as f64, exponent + 11) // M0: at most 2^53
    }

    /// `|x|` rounded down.
    pub(super) fn least(&self) -> Magnitude {
        let (lead, exponent, _) = self.leading();
        Magnitude::new((lead >> 11) as f64, exponent + 11) // M0: below 2^53
    }

    /// A power of two that `|x|` does not reach.
    #[inline]
    pub(super) fn above(&self) -> Magnitude {
        match self.top() {
            Some(top) => Magnitude::power_of_two(top),
            None if self.is_zero() => Magnitude::ZERO,
            None => Magnitude::INFINITE,
        }
    }

    /// Half a unit in the last place: what a rounding to nearest is off by at most (Lemma M1).
    #[inline]
    pub(super) fn half_unit(&self) -> Magnitude {
        match self.top() {
            Some(top) => Magnitude::power_of_two(top - i64::from(self.bits) - 1),
            None => Magnitude::INFINITE,
        }
    }

    /// The same as a dyadic number.
    pub(crate) fn dyadic(&self) -> Option<Dyadic> {
        self.is_number().then(|| Dyadic::new(self.mantissa.clone(), self.exponent))
    }

    /// Its size in units of `2^unit`, which it has no bits below.
    pub(super) fn in_units_of(&self, unit: i64) -> BigUint {
        self.mantissa.magnitude() << (self.exponent - unit).unsigned_abs()
    }
}

impl Neg for Float {
    type Output = Self;
    fn neg(self) -> Self {
        Self { mantissa: -self.mantissa, ..self }
    }
}

impl PartialOrd for Float {
    fn partial_cmp(&self, b: &Self) -> Option<Ordering> {
        let (sign, other) = (self.sign()?, b.sign()?);
        if sign != other || sign.is_eq() {
            return Some(sign.cmp(&other));
        }
        let sizes = match self.top().cmp(&b.top()) {
            // Equal tops: the shift is bounded by the longer mantissa.
            Ordering::Equal => {
                let unit = self.exponent.min(b.exponent); // exact: the unit of both
                self.in_units_of(unit).cmp(&b.in_units_of(unit))
            }
            unequal => unequal,
        };
        Some(if sign.is_lt() { sizes.reverse() } else { sizes })
    }
}

impl PartialEq for Float {
    fn eq(&self, b: &Self) -> bool {
        self.partial_cmp(b) == Some(Ordering::Equal)
    }
}

impl PartialEq<f64> for Float {
    fn eq(&self, b: &f64) -> bool {
        *self == Self::new(*b)
    }
}

impl PartialOrd<f64> for Float {
    fn partial_cmp(&self, b: &f64) -> Option<Ordering> {
        self.partial_cmp(&Self::new(*b))
    }
}
