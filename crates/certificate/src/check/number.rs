//! The intervals that flights are computed in: of many bits, or of doubles.

use std::ops::{Add, Mul, Neg, Sub};

use super::span::Span;
use impact_pair_exact::{Enclosure, Real};

/// All numbers between two bounds. The result of an operation holds the results for all members.
pub(crate) trait Number:
    Clone
    + Neg<Output = Self>
    + for<'a> Add<&'a Self, Output = Self>
    + for<'a> Sub<&'a Self, Output = Self>
    + for<'a> Mul<&'a Self, Output = Self>
{
    /// Exactly 0, with the bits of `self`.
    fn nothing(&self) -> Self;

    /// The bits that operations round to.
    fn bits(&self) -> u32;

    /// The set rounded outward to `bits` bits, if it has more.
    fn rounded(&self, bits: u32) -> Self;

    fn half(&self) -> Self;

    /// A point near the middle, and a member.
    fn middle(&self) -> Self;

    /// The least interval that holds both sets.
    fn hull(&self, other: &Self) -> Self;

    /// The common part of two enclosures of the same number; either one where they have none.
    fn cut(&self, other: &Self) -> Self;

    /// `None` if the divisor may be 0.
    fn over(&self, divisor: &Self) -> Option<Self>;

    /// Encloses the sine of angles in radians.
    fn sin(&self) -> Self;

    /// Encloses the cosine of angles in radians.
    fn cos(&self) -> Self;

    /// Encloses sine and cosine of angles in radians.
    fn sine_and_cosine(&self) -> (Self, Self);

    fn is_positive(&self) -> bool;

    fn is_negative(&self) -> bool;

    /// Whether 0 is the only member.
    fn is_zero(&self) -> bool;

    /// Whether each member of `self` is less than each member of `other`.
    fn is_below(&self, other: &Self) -> bool;

    /// Whether each member of `other` is a member.
    fn holds(&self, other: &Self) -> bool;

    /// About log2 of the greatest magnitude; `None` for 0, and where nothing is known.
    fn top(&self) -> Option<i64>;

    /// The greatest magnitude.
    fn size(&self) -> Self;

    /// Upper bound of the distance of two members.
    fn width(&self) -> Self;

    /// A double near the middle.
    fn to_f64(&self) -> f64;
}

impl Number for Real {
    fn nothing(&self) -> Self {
        Self::zero(self.bits())
    }

    fn bits(&self) -> u32 {
        self.bits()
    }

    fn rounded(&self, bits: u32) -> Self {
        self.rounded(bits)
    }

    fn half(&self) -> Self {
        self.half()
    }

    fn middle(&self) -> Self {
        self.middle()
    }

    fn hull(&self, other: &Self) -> Self {
        self.hull(other)
    }

    fn cut(&self, other: &Self) -> Self {
        self.cut(other)
    }

    fn over(&self, divisor: &Self) -> Option<Self> {
        self.over(divisor)
    }

    fn sin(&self) -> Self {
        self.sin()
    }

    fn cos(&self) -> Self {
        self.cos()
    }

    fn sine_and_cosine(&self) -> (Self, Self) {
        self.sin_cos()
    }

    fn is_positive(&self) -> bool {
        self.is_positive()
    }

    fn is_negative(&self) -> bool {
        self.is_negative()
    }

    fn is_zero(&self) -> bool {
        self.is_zero()
    }

    fn is_below(&self, other: &Self) -> bool {
        self.is_below(other)
    }

    fn holds(&self, other: &Self) -> bool {
        self.enclosure().contains_enclosure(other.enclosure())
    }

    fn top(&self) -> Option<i64> {
        self.enclosure().mag().top()
    }

    fn size(&self) -> Self {
        Self::point(self.enclosure().mag(), self.bits())
    }

    fn width(&self) -> Self {
        Self::point(self.wid(), self.bits())
    }

    fn to_f64(&self) -> f64 {
        self.to_f64()
    }
}

impl Number for Span {
    fn nothing(&self) -> Self {
        Self::point(0.0)
    }

    fn bits(&self) -> u32 {
        f64::MANTISSA_DIGITS
    }

    fn rounded(&self, _: u32) -> Self {
        *self
    }

    fn half(&self) -> Self {
        self.scaled(0.5)
    }

    fn middle(&self) -> Self {
        Self::point(self.mid())
    }

    fn hull(&self, other: &Self) -> Self {
        Self::hull(*self, *other)
    }

    fn cut(&self, other: &Self) -> Self {
        self.common(*other).unwrap_or(*self) // V1: either holds it
    }

    fn over(&self, divisor: &Self) -> Option<Self> {
        Self::over(*self, *divisor)
    }

    fn sin(&self) -> Self {
        self.unturned().sin_cos().0
    }

    fn cos(&self) -> Self {
        self.unturned().sin_cos().1
    }

    fn sine_and_cosine(&self) -> (Self, Self) {
        self.unturned().sin_cos()
    }

    fn is_positive(&self) -> bool {
        Self::is_positive(*self)
    }

    fn is_negative(&self) -> bool {
        Self::is_negative(*self)
    }

    fn is_zero(&self) -> bool {
        self.lo() == 0.0 && self.hi() == 0.0 // V11: neither is NaN
    }

    fn is_below(&self, other: &Self) -> bool {
        self.hi() < other.lo() // V11: neither is NaN
    }

    fn holds(&self, other: &Self) -> bool {
        self.lo() <= other.lo() && other.hi() <= self.hi() // V11: none is NaN
    }

    fn top(&self) -> Option<i64> {
        let most = self.most();
        (most > 0.0).then(|| most.log2().floor() as i64) // proposes
    }

    fn size(&self) -> Self {
        Self::point(self.most())
    }

    fn width(&self) -> Self {
        Self::point((Self::point(self.hi()) - Self::point(self.lo())).hi())
    }

    fn to_f64(&self) -> f64 {
        self.mid()
    }
}

impl Span {
    /// The same interval in many bits; `None` where nothing is known.
    pub fn in_bits(self, bits: u32) -> Option<Real> {
        Enclosure::from_f64_bounds(self.lo(), self.hi()).map(|value| Real::new(value, bits))
    }
}
