//! Sums, products and quotients of multiprecision balls (Lemma M1).

use std::mem;
use std::ops::{Add, AddAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use super::float::{Float, Round};
use super::operations::SHORT_PRODUCT_BITS;
use super::{MpBall, error_of, rounding, sine};
use crate::number::{Magnitude, Number};

impl Add for MpBall {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        if self.bits() < b.bits() { b.plus(&self) } else { self.plus(&b) }
    }
}

impl Neg for MpBall {
    type Output = Self;
    fn neg(self) -> Self {
        Self { mid: -self.mid, rad: self.rad }
    }
}

impl Sub for MpBall {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        if self.bits() < b.bits() { (-b).plus(&self) } else { self.minus(&b) }
    }
}

impl MpBall {
    /// A `n`-th of it.
    pub(super) fn divided(self, n: u32) -> Self {
        let (rad, bits) = (self.rad.over(Magnitude::new(f64::from(n), 0)), self.bits());
        Self::found(self.mid.div_whole(n, bits), rad)
    }

    /// A result of centres and the radius that those of the operands make.
    #[inline]
    fn found(mid: (Float, bool), rad: Magnitude) -> Self {
        let (mid, error) = rounding(mid);
        Self { mid, rad: rad + error }
    }

    /// Returns the part of the radius of a sum or difference that comes from the radii.
    fn sum_spread(&self, b: &Self) -> Magnitude {
        self.rad + b.rad
    }

    /// Returns the part of the radius of a product that comes from the radii.
    fn product_spread(&self, b: &Self) -> Magnitude {
        match (self.rad.is_zero(), b.rad.is_zero()) {
            (true, true) => Magnitude::ZERO,
            (true, false) => self.mid.magnitude() * b.rad,
            (false, true) => self.rad * b.mid.magnitude(),
            (false, false) => self.rad * b.mag() + self.mid.magnitude() * b.rad,
        }
    }

    /// The product in `bits` bits; what the radii add is bounded within a factor of two.
    pub(crate) fn product(&self, b: &Self, bits: u32) -> Self {
        let spread = |rad: Magnitude, of: Magnitude| if rad.is_zero() { rad } else { rad * of };
        let rad = spread(self.rad, b.mid.above() + b.rad) + spread(b.rad, self.mid.above());
        Self::found(self.mid.mul(&b.mid, bits), rad)
    }

    /// The bits of a result: the more of both.
    fn common_bits(&self, b: &Self) -> u32 {
        self.bits().max(b.bits()) // M1: any number of bits
    }

    /// `op` on the centre, which it takes the memory of, and radii that add up to `rad` (Lemma M1).
    #[inline]
    fn set(&mut self, rad: Magnitude, op: impl FnOnce(Float) -> (Float, bool)) {
        let (mid, is_exact) = op(mem::replace(&mut self.mid, Float::zero(0)));
        self.rad = rad + error_of(&mid, is_exact);
        self.mid = mid;
    }
}

impl AddAssign<&Self> for MpBall {
    fn add_assign(&mut self, b: &Self) {
        let bits = self.common_bits(b);
        self.set(self.sum_spread(b), |mid| mid.add(&b.mid, bits, Round::Nearest));
    }
}

impl SubAssign<&Self> for MpBall {
    fn sub_assign(&mut self, b: &Self) {
        let bits = self.common_bits(b);
        self.set(self.sum_spread(b), |mid| mid.sub(&b.mid, bits, Round::Nearest));
    }
}

impl MulAssign<&Self> for MpBall {
    fn mul_assign(&mut self, b: &Self) {
        let (rad, bits) = (self.product_spread(b), self.common_bits(b));
        self.set(rad, |mid| mid.mul(&b.mid, bits));
    }
}

impl Mul for MpBall {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        self.times(&b)
    }
}

impl Number for MpBall {
    fn from_f64(x: f64) -> Self {
        Self::exact(Float::new(x))
    }

    fn mul_add(self, b: Self, c: Self) -> Self {
        self.mul_add_ref(&b, c)
    }

    fn checked_div(self, b: Self) -> Option<Self> {
        let least = b.mig()?;
        let (mid, error) = rounding(self.mid.div(&b.mid, self.common_bits(&b)));
        let spread = (self.rad + mid.magnitude() * b.rad).over(least);
        // The rounding is that of the centres' quotient; a member's quotient differs by |m| r_b / |b| of it more.
        let error = error + error * b.rad.over(least);
        Some(Self { mid, rad: spread + error })
    }

    fn plus(mut self, b: &Self) -> Self {
        self += b;
        self
    }

    fn minus(mut self, b: &Self) -> Self {
        self -= b;
        self
    }

    fn times(mut self, b: &Self) -> Self {
        self *= b;
        self
    }

    fn mul_add_ref(&self, b: &Self, c: Self) -> Self {
        self.fused(b, false, c)
    }

    fn mul_sub_ref(&self, b: &Self, c: Self) -> Self {
        self.fused(b, true, c)
    }

    fn turn(&self) -> Self {
        let (turn, error) = sine::turn(self.bits());
        Self { mid: turn, rad: error }
    }

    fn signed(self, sign: f64) -> Self {
        if sign < 0.0 { -self } else { self }
    }
}

impl MpBall {
    /// `c + self * b`, or `c - self * b`; rounded once, or twice where that is faster.
    fn fused(&self, b: &Self, is_difference: bool, c: Self) -> Self {
        let bits = self.common_bits(b).max(c.bits()); // M1: any number of bits
        if bits >= SHORT_PRODUCT_BITS {
            let product = self.product(b, bits);
            return if is_difference { c.minus(&product) } else { c.plus(&product) };
        }
        Self::found(self.mid.fused(&b.mid, is_difference, &c.mid, bits), self.product_spread(b) + c.rad)
    }
}
