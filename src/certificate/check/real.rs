//! Real numbers known to lie in an interval, at a working precision: [`Enclosure`] with operators.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use num_rational::BigRational;

use crate::exact::{Dyadic, Enclosure, Exact};

/// Holds a real number; results are rounded outward to `bits`, the larger of the operands'.
#[derive(Clone, Debug)]
pub(in crate::certificate) struct Real {
    set: Enclosure,
    bits: u32,
}

impl Real {
    pub fn new(set: Enclosure, bits: u32) -> Self {
        Self { set, bits }
    }

    pub fn zero(bits: u32) -> Self {
        Self::point(Dyadic::zero(), bits)
    }

    pub fn point(x: Dyadic, bits: u32) -> Self {
        Self::new(Enclosure::point(x), bits)
    }

    pub fn of(x: &Exact, bits: u32) -> Self {
        Self::new(x.enclose(bits), bits)
    }

    pub fn rational(x: &BigRational, bits: u32) -> Self {
        Self::new(Enclosure::from_rational(x, bits), bits)
    }

    pub fn integer(x: i64, bits: u32) -> Self {
        Self::point(Dyadic::new(x.into(), 0), bits)
    }

    pub fn pi(bits: u32) -> Self {
        Self::new(Enclosure::pi(bits), bits)
    }

    /// `[-x, x]`
    pub fn within(x: &Dyadic, bits: u32) -> Self {
        let x = Enclosure::point(x.clone());
        Self::new(x.hull(&x.negated()), bits)
    }

    pub fn bits(&self) -> u32 {
        self.bits
    }

    pub fn set(&self) -> &Enclosure {
        &self.set
    }

    /// The same set at another precision, not rounded.
    pub fn at(&self, bits: u32) -> Self {
        Self { set: self.set.clone(), bits }
    }

    /// The set rounded outward to another precision.
    pub fn rounded(&self, bits: u32) -> Self {
        Self { set: self.set.rounded(bits), bits }
    }

    pub fn hull(&self, other: &Self) -> Self {
        Self::new(self.set.hull(&other.set), self.bits)
    }

    /// The common part of two sets that hold the same number; the first where they have none.
    pub fn cut(&self, other: &Self) -> Self {
        Self::new(self.set.intersection(&other.set).unwrap_or_else(|| self.set.clone()), self.bits)
    }

    /// A point near the middle.
    pub fn middle(&self) -> Dyadic {
        let sum = Real::point(self.set.lo().clone(), self.bits) + &Real::point(self.set.hi().clone(), self.bits);
        sum.half().set.lo().clone()
    }

    pub fn half(&self) -> Self {
        let half = |x: &Dyadic| x.scaled(-1);
        let set = Enclosure::new(half(self.set.lo()), half(self.set.hi())).expect("ends in order");
        Self { set, bits: self.bits }
    }

    pub fn over(&self, divisor: &Self) -> Option<Self> {
        let bits = self.bits.max(divisor.bits);
        Some(Self::new(self.set.div(&divisor.set, bits)?, bits))
    }

    pub fn sqrt(&self) -> Option<Self> {
        Some(Self::new(self.set.sqrt(self.bits)?, self.bits))
    }

    pub fn sin_cos(&self) -> (Self, Self) {
        let Self { set, bits } = self;
        (Self::new(set.sin(*bits), *bits), Self::new(set.cos(*bits), *bits))
    }

    pub fn is_positive(&self) -> bool {
        self.set.sign() == Some(Ordering::Greater)
    }

    pub fn is_negative(&self) -> bool {
        self.set.sign() == Some(Ordering::Less)
    }

    /// Whether it may be 0 and may not be.
    pub fn is_across(&self) -> bool {
        self.set.sign().is_none()
    }

    /// Whether it is 0, known exactly.
    pub fn is_zero(&self) -> bool {
        self.set.sign() == Some(Ordering::Equal)
    }

    pub fn is_below(&self, other: &Self) -> bool {
        self.set.hi() < other.set.lo()
    }
}

impl Add<&Real> for Real {
    type Output = Self;

    fn add(self, other: &Self) -> Self {
        let bits = self.bits.max(other.bits);
        Self::new(self.set.add(&other.set, bits), bits)
    }
}

impl Sub<&Real> for Real {
    type Output = Self;

    fn sub(self, other: &Self) -> Self {
        let bits = self.bits.max(other.bits);
        Self::new(self.set.sub(&other.set, bits), bits)
    }
}

impl Mul<&Real> for Real {
    type Output = Self;

    fn mul(self, other: &Self) -> Self {
        let bits = self.bits.max(other.bits);
        Self::new(self.set.mul(&other.set, bits), bits)
    }
}

impl Neg for Real {
    type Output = Self;

    fn neg(self) -> Self {
        Self::new(self.set.negated(), self.bits)
    }
}
