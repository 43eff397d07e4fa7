//! Sums, products and quotients of multiprecision balls (Lemma M1).

use std::cmp::Ordering;
use std::ops::{Add, AddAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use rug::Float;
use rug::float::{Constant, Round};
use rug::ops::{AddAssignRound, DivAssignRound, MulAssignRound, SubAssignRound};

use super::{MpBall, above, error_of, magnitude, rounding};
use crate::number::{Magnitude, Number};

/// Bits from which on the upper half of a product costs much less than all of it, which a fused sum needs.
pub(super) const SHORT_PRODUCT_BITS: u32 = 24 * 64;

/// Results take the place of the left operand, where it has the bits: no memory is allocated.
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
    pub(super) fn divided(mut self, n: u32) -> Self {
        let rad = self.rad.over(Magnitude::new(f64::from(n), 0));
        self.set(rad, |mid| mid.div_assign_round(n, Round::Nearest));
        self
    }

    /// Returns the part of the radius of a sum or difference that comes from the radii.
    fn sum_spread(&self, b: &Self) -> Magnitude {
        self.rad + b.rad
    }

    /// Returns the part of the radius of a product that comes from the radii.
    fn product_spread(&self, b: &Self) -> Magnitude {
        match (self.rad.is_zero(), b.rad.is_zero()) {
            (true, true) => Magnitude::ZERO,
            (true, false) => magnitude(&self.mid) * b.rad,
            (false, true) => self.rad * magnitude(&b.mid),
            (false, false) => self.rad * b.mag() + magnitude(&self.mid) * b.rad,
        }
    }

    /// The product in N bits; what the radii add is bounded within a factor of two.
    pub(crate) fn product(&self, b: &Self, bits: u32) -> Self {
        let (mid, error) = rounding(Float::with_val_round(bits, &self.mid * &b.mid, Round::Nearest));
        let spread = |rad: Magnitude, of: Magnitude| if rad.is_zero() { rad } else { rad * of };
        Self { mid, rad: spread(self.rad, above(&b.mid) + b.rad) + spread(b.rad, above(&self.mid)) + error }
    }

    /// Gives the centre as many bits as `b` has, and no fewer than before; its value is the same.
    fn grow(&mut self, b: &Self) {
        if self.bits() < b.bits() {
            self.mid.set_prec(b.bits());
        }
    }

    /// `op` in place, rounded to nearest, on radii that add up to `rad` (Lemma M1).
    #[inline]
    fn set(&mut self, rad: Magnitude, op: impl FnOnce(&mut Float) -> Ordering) {
        let ordering = op(&mut self.mid);
        self.rad = rad + error_of(&self.mid, ordering);
    }
}

impl AddAssign<&Self> for MpBall {
    fn add_assign(&mut self, b: &Self) {
        self.grow(b);
        self.set(self.sum_spread(b), |mid| mid.add_assign_round(&b.mid, Round::Nearest));
    }
}

impl SubAssign<&Self> for MpBall {
    fn sub_assign(&mut self, b: &Self) {
        self.grow(b);
        self.set(self.sum_spread(b), |mid| mid.sub_assign_round(&b.mid, Round::Nearest));
    }
}

impl MulAssign<&Self> for MpBall {
    fn mul_assign(&mut self, b: &Self) {
        let rad = self.product_spread(b);
        self.grow(b);
        self.set(rad, |mid| mid.mul_assign_round(&b.mid, Round::Nearest));
    }
}

impl Mul for MpBall {
    type Output = Self;
    fn mul(mut self, mut b: Self) -> Self {
        let rad = self.product_spread(&b);
        if self.bits() < b.bits() {
            std::mem::swap(&mut self, &mut b);
        }
        self.set(rad, |mid| mid.mul_assign_round(&b.mid, Round::Nearest));
        self
    }
}

impl Number for MpBall {
    fn from_f64(x: f64) -> Self {
        Self::exact(Float::with_val(f64::MANTISSA_DIGITS, x))
    }

    fn mul_add(mut self, b: Self, c: Self) -> Self {
        // M1: any number of bits
        if self.bits().max(b.bits()) <= c.bits() {
            return self.mul_add_ref(&b, c);
        }
        let rad = self.product_spread(&b) + c.rad;
        [&b, &c].into_iter().for_each(|x| self.grow(x));
        self.set(rad, |mid| mid.mul_add_round(&b.mid, &c.mid, Round::Nearest));
        self
    }

    fn checked_div(mut self, b: Self) -> Option<Self> {
        let least = b.mig()?;
        let rad = self.rad;
        self.grow(&b);
        self.set(Magnitude::ZERO, |mid| mid.div_assign_round(&b.mid, Round::Nearest));
        let spread = (rad + magnitude(&self.mid) * b.rad).over(least);
        // The rounding is that of the centres' quotient; a member's quotient differs by |m| r_b / |b| of it more.
        let error = self.rad + self.rad * b.rad.over(least);
        Some(Self { rad: spread + error, ..self })
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

    fn mul_add_ref(&self, b: &Self, mut c: Self) -> Self {
        [self, b].into_iter().for_each(|x| c.grow(x));
        if c.bits() >= SHORT_PRODUCT_BITS {
            let product = self.product(b, c.bits());
            return c.plus(&product);
        }
        let rad = self.product_spread(b) + c.rad;
        c.set(rad, |mid| mid.add_assign_round(&self.mid * &b.mid, Round::Nearest));
        c
    }

    fn mul_sub_ref(&self, b: &Self, mut c: Self) -> Self {
        [self, b].into_iter().for_each(|x| c.grow(x));
        if c.bits() >= SHORT_PRODUCT_BITS {
            let product = self.product(b, c.bits());
            return c.minus(&product);
        }
        let rad = self.product_spread(b) + c.rad;
        c.set(rad, |mid| mid.sub_assign_round(&self.mid * &b.mid, Round::Nearest));
        c
    }

    fn turn(&self) -> Self {
        let (pi, error) = rounding(Float::with_val_round(self.bits(), Constant::Pi, Round::Nearest));
        let two = Magnitude::new(2.0, 0);
        Self { mid: pi * 2u32, rad: error * two }
    }

    fn signed(self, sign: f64) -> Self {
        if sign < 0.0 { -self } else { self }
    }
}
