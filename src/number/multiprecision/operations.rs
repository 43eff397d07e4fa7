//! Sums, products, quotients and roots of [`Float`]s, and whether they are exact (Lemma M1).

use num_bigint::{BigInt, BigUint, Sign};
use num_integer::Integer;
use num_traits::Zero;

use super::float::{Float, Round, length};
use super::upper::upper_product;
use crate::number::Magnitude;

/// Bits from which on the upper half of a product costs much less than all of it, which a fused sum needs.
pub(super) const SHORT_PRODUCT_BITS: u32 = 10 * 64;
/// Bits of an upper part beyond those that it is rounded to, at least.
const GUARD: u64 = 65;

impl Float {
    /// `self + b`, to the nearest number of `bits` bits.
    pub fn plus(&self, b: &Self, bits: u32) -> Self {
        self.clone().add(b, bits, Round::Nearest).0
    }

    /// `self - b`, to the nearest number of `bits` bits.
    pub fn minus(&self, b: &Self, bits: u32) -> Self {
        self.clone().sub(b, bits, Round::Nearest).0
    }

    /// `self * b`, to the nearest number of `bits` bits.
    pub fn times(&self, b: &Self, bits: u32) -> Self {
        self.mul(b, bits).0
    }

    /// `self / b`, to the nearest number of `bits` bits; no number for `b = 0`.
    pub fn over(&self, b: &Self, bits: u32) -> Self {
        self.div(b, bits).0
    }

    /// An upper bound of `|self - b|`.
    pub(crate) fn distance(&self, b: &Self) -> Magnitude {
        let (difference, is_exact) = self.clone().sub(b, u64::BITS, Round::Nearest);
        let size = difference.magnitude();
        if is_exact { size } else { size + difference.half_unit() }
    }

    /// `self + b`, rounded, and whether that is exact.
    pub(super) fn add(self, b: &Self, bits: u32, round: Round) -> (Self, bool) {
        self.signed_sum(b, false, bits, round)
    }

    /// `self - b`, rounded, and whether that is exact.
    pub(super) fn sub(self, b: &Self, bits: u32, round: Round) -> (Self, bool) {
        self.signed_sum(b, true, bits, round)
    }

    fn signed_sum(self, b: &Self, is_difference: bool, bits: u32, round: Round) -> (Self, bool) {
        let signed = |b: &Self| if is_difference { -b.clone() } else { b.clone() };
        if !(self.is_number() && b.is_number()) {
            return (Self::none(bits), false);
        }
        let (Some(top), Some(b_top)) = (self.top(), b.top()) else {
            return if b.is_zero() { self.into_bits(bits, round) } else { signed(b).into_bits(bits, round) };
        };
        let b_is_negative = (b.mantissa.sign() == Sign::Minus) != is_difference;
        // Lemma M1: of a number below this unit of the other the sign is enough.
        let unit = |x: &Self, top: i64| x.exponent.min(top - i64::from(bits) - 2); // M1: the finer one
        if b_top <= unit(&self, top) {
            let unit = unit(&self, top);
            return self.nudged(b_is_negative, unit, bits, round);
        }
        if top <= unit(b, b_top) {
            let is_negative = self.mantissa.sign() == Sign::Minus;
            return signed(b).nudged(is_negative, unit(b, b_top), bits, round);
        }
        let (mut mantissa, exponent) = (self.mantissa, self.exponent.min(b.exponent)); // exact: the unit of both
        let (left, right) = ((self.exponent - exponent).unsigned_abs(), (b.exponent - exponent).unsigned_abs());
        if left > 0 {
            mantissa <<= left;
        }
        match (right, is_difference) {
            (0, false) => mantissa += &b.mantissa,
            (0, true) => mantissa -= &b.mantissa,
            (_, false) => mantissa += &b.mantissa << right,
            (_, true) => mantissa -= &b.mantissa << right,
        }
        Self::rounding(mantissa, exponent, bits, round)
    }

    /// The sum with a number of this sign, not 0 and below `2^unit`, rounded; it is never exact.
    fn nudged(self, is_negative: bool, unit: i64, bits: u32, round: Round) -> (Self, bool) {
        let mut mantissa = self.mantissa << (self.exponent - (unit - 1)).unsigned_abs();
        if is_negative {
            mantissa -= 1u32;
        } else {
            mantissa += 1u32;
        }
        Self::rounding(mantissa, unit - 1, bits, round)
    }

    /// The product with all its bits.
    fn whole_product(&self, b: &Self) -> Self {
        if !(self.is_number() && b.is_number()) {
            return Self::none(self.bits);
        }
        Self { mantissa: &self.mantissa * &b.mantissa, exponent: self.exponent + b.exponent, bits: self.bits }
    }

    /// `self * b`, to nearest, and whether that is exact.
    pub(super) fn mul(&self, b: &Self, bits: u32) -> (Self, bool) {
        self.upper_mul(b, bits).unwrap_or_else(|| self.whole_product(b).into_bits(bits, Round::Nearest)) // M1: both round correctly
    }

    /// The same by the upper part of the product alone; `None` for short ones, and where that does not tell how to round.
    ///
    /// **Lemma M1, products.** The zeros below the last digit of a product are those of both factors, so it is exact or not whatever
    /// its upper part is. Of that, 64 bits or more are rounded off; the product is not below it, and above it by less than 2. So the
    /// rounding is the same, unless these bits are one or two short of the middle.
    fn upper_mul(&self, b: &Self, bits: u32) -> Option<(Self, bool)> {
        let (x, y) = (self.mantissa.magnitude(), b.mantissa.magnitude());
        let shift = (x.bits() + y.bits()).checked_sub(u64::from(bits) + GUARD)?;
        if bits < SHORT_PRODUCT_BITS || x.trailing_zeros()? + y.trailing_zeros()? >= shift {
            return None;
        }
        let upper = upper_product(x, y, shift);
        let excess = upper.bits() - u64::from(bits);
        let mut low = upper.iter_u64_digits();
        let low = [low.next()?, low.next()?];
        let low = (u128::from(low[1]) << 64 | u128::from(low[0])) & ((1 << excess) - 1);
        let middle = 1u128 << (excess - 1);
        if (middle - 2..middle).contains(&low) {
            return None;
        }
        let is_negative = self.mantissa.sign() != b.mantissa.sign();
        let mantissa = BigInt::from_biguint(if is_negative { Sign::Minus } else { Sign::Plus }, upper);
        let exponent = self.exponent + b.exponent + shift as i64; // exact: a length in bits
        let (found, _) = Self::rounding(mantissa, exponent, bits, Round::Nearest);
        Some((found, false))
    }

    /// `self * b + c`, or `c - self * b`, rounded once to nearest, and whether that is exact.
    pub(super) fn fused(&self, b: &Self, is_difference: bool, c: &Self, bits: u32) -> (Self, bool) {
        let product = self.whole_product(b);
        let product = if is_difference { -product } else { product };
        product.add(c, bits, Round::Nearest)
    }

    /// `self / b`, to nearest, and whether that is exact; no number for `b = 0`.
    pub(super) fn div(&self, b: &Self, bits: u32) -> (Self, bool) {
        if !(self.is_number() && b.is_number()) || b.is_zero() {
            return (Self::none(bits), false);
        }
        let (n, d) = (self.mantissa.magnitude(), b.mantissa.magnitude());
        // Two bits more than the result has, at least.
        let shift = (i64::from(bits) + 2 + length(&b.mantissa) - length(&self.mantissa)).max(0); // M1: no fewer
        let (quotient, rest) = (n << shift).div_rem(d);
        let exponent = self.exponent - b.exponent - shift;
        let is_negative = self.mantissa.sign() != b.mantissa.sign();
        Self::truncated(quotient, rest.is_zero(), is_negative, exponent, bits)
    }

    /// An `n`-th of it, to nearest, and whether that is exact.
    pub(super) fn div_whole(self, n: u32, bits: u32) -> (Self, bool) {
        if !self.is_number() || n == 0 {
            return (Self::none(bits), false);
        }
        let shift = (i64::from(bits + u32::BITS) + 2 - length(&self.mantissa)).max(0); // M1: no fewer
        let (exponent, is_negative) = (self.exponent - shift, self.mantissa.sign() == Sign::Minus);
        let (_, mut size) = self.mantissa.into_parts();
        size <<= shift;
        let is_whole = (&size % n).is_zero();
        Self::truncated(size / n, is_whole, is_negative, exponent, bits)
    }

    /// The square root, to nearest, and whether that is exact; no number for one below 0.
    pub fn sqrt(&self, bits: u32) -> Self {
        if !self.is_number() || self.mantissa.sign() == Sign::Minus {
            return Self::none(bits);
        }
        // An even exponent, and a root of two bits more than the result has.
        let missing = (2 * (i64::from(bits) + 2) - length(&self.mantissa)).max(0); // M1: no fewer
        let shift = missing + (self.exponent - missing).rem_euclid(2);
        let square = self.mantissa.magnitude() << shift;
        let root = square.sqrt();
        let is_whole = &root * &root == square;
        Self::truncated(root, is_whole, false, (self.exponent - shift) / 2, bits).0
    }

    /// A number of this whole part, of more bits than are kept, with a fraction below it unless `is_whole`; to nearest.
    fn truncated(whole: BigUint, is_whole: bool, is_negative: bool, exponent: i64, bits: u32) -> (Self, bool) {
        let mut size = whole << 1u32;
        if !is_whole {
            size += 1u32;
        }
        let sign = if is_negative { Sign::Minus } else { Sign::Plus };
        Self::rounding(BigInt::from_biguint(sign, size), exponent - 1, bits, Round::Nearest)
    }
}
