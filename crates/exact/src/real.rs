//! Numbers known to lie between two bounds, with operators, so that formulas read as on paper.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use num_rational::BigRational;

use super::{Dyadic, Enclosure, Exact, Round};

/// An enclosure and the bits that further operations round it to.
///
/// **Enclosure**: the result of an operation holds the result for every choice of members. Integers may stand on the right of
/// an operator.
///
/// ```
/// use impact_pair_exact::{Exact, Real};
/// let x = Real::of(&Exact::parse("1/3").unwrap(), 80);
/// assert!((x.sin().square() + x.cos().square() - 1).to_f64().abs() < 1e-23);
/// ```
#[derive(Clone, Debug)]
pub struct Real {
    value: Enclosure,
    bits: u32,
}

/// Bits with which an exact value is enclosed, beyond those requested.
const GUARD: u32 = 8;

impl Real {
    /// Returns all numbers of an enclosure.
    pub fn new(value: Enclosure, bits: u32) -> Self {
        Self { value, bits }
    }

    /// Encloses an exact number.
    pub fn of(x: &Exact, bits: u32) -> Self {
        Self::new(x.enclose(bits + GUARD), bits)
    }

    /// Exactly the dyadic.
    pub fn point(x: Dyadic, bits: u32) -> Self {
        Self::new(Enclosure::point(x), bits)
    }

    /// Exactly 0.
    pub fn zero(bits: u32) -> Self {
        Self::point(Dyadic::zero(), bits)
    }

    /// Encloses a fraction.
    pub fn rational(x: &BigRational, bits: u32) -> Self {
        Self::new(Enclosure::from_rational(x, bits), bits)
    }

    /// `[-x, x]`
    pub fn within(x: &Dyadic, bits: u32) -> Self {
        let x = Self::point(x.clone(), bits);
        x.hull(&-&x)
    }

    /// Exactly the integer.
    pub fn int(n: i64, bits: u32) -> Self {
        Self::new(Enclosure::point(Dyadic::new(n.into(), 0)), bits)
    }

    /// Encloses pi.
    pub fn pi(bits: u32) -> Self {
        Self::new(Enclosure::pi(bits), bits)
    }

    /// Returns its bounds.
    pub fn enclosure(&self) -> &Enclosure {
        &self.value
    }

    /// Returns the bits that operations round to.
    pub fn bits(&self) -> u32 {
        self.bits
    }

    fn with(&self, value: Enclosure) -> Self {
        Self::new(value, self.bits)
    }

    /// Returns the same set, further operations rounded to other bits.
    pub fn at(&self, bits: u32) -> Self {
        Self { value: self.value.clone(), bits }
    }

    /// Returns the set rounded outward to other bits.
    pub fn rounded(&self, bits: u32) -> Self {
        Self { value: self.value.rounded(bits), bits }
    }

    /// Returns the sign that all members share.
    pub fn sign(&self) -> Option<Ordering> {
        self.value.sign()
    }

    /// Returns whether all members are greater than 0.
    pub fn is_positive(&self) -> bool {
        self.sign() == Some(Ordering::Greater)
    }

    /// Returns whether all members are less than 0.
    pub fn is_negative(&self) -> bool {
        self.sign() == Some(Ordering::Less)
    }

    /// Returns whether it is 0, known exactly.
    pub fn is_zero(&self) -> bool {
        self.sign() == Some(Ordering::Equal)
    }

    /// Returns whether it may be 0 and may not be.
    pub fn is_across(&self) -> bool {
        self.sign().is_none()
    }

    /// Returns whether all members are less than all of the other.
    pub fn is_below(&self, other: &Self) -> bool {
        self.value.sup() < other.value.inf()
    }

    /// Returns whether no member of one is one of the other.
    pub fn is_apart_from(&self, other: &Self) -> bool {
        self.value.intersection(&other.value).is_none()
    }

    /// Returns the members of both; `None` if there are none.
    pub fn intersection(&self, other: &Self) -> Option<Self> {
        self.value.intersection(&other.value).map(|value| self.with(value))
    }

    /// Returns the common part of two sets that hold the same number; the first where they have none.
    pub fn cut(&self, other: &Self) -> Self {
        self.intersection(other).unwrap_or_else(|| self.clone())
    }

    /// Returns the least interval that holds both.
    pub fn hull(&self, other: &Self) -> Self {
        self.with(self.value.hull(&other.value))
    }

    /// Returns a point near the middle, not outside.
    pub fn middle(&self) -> Self {
        let (lo, hi) = (self.value.inf(), self.value.sup());
        let sum = lo.plus(hi, self.bits.saturating_add(4), Round::Down); // exact: any point, cut to a member below
        self.with(Enclosure::point(sum.scaled(-1).clamp(lo.clone(), hi.clone()))) // exact: a member
    }

    /// That point.
    pub fn mid(&self) -> Dyadic {
        self.middle().value.inf().clone()
    }

    /// Returns the lower and the upper bound, as points.
    pub fn ends(&self) -> [Self; 2] {
        [self.value.inf(), self.value.sup()].map(|end| self.with(Enclosure::point(end.clone())))
    }

    /// Returns an upper bound of the distance between two members.
    pub fn wid(&self) -> Dyadic {
        self.value.wid()
    }

    /// Returns a double near the middle.
    pub fn to_f64(&self) -> f64 {
        self.value.mid_rad().0
    }

    /// Returns the square; never negative.
    pub fn square(&self) -> Self {
        self.with(self.value.powi(2, self.bits).expect("the exponent is positive"))
    }

    /// Returns the square root of the members that are not negative; `None` if there is none.
    pub fn sqrt(&self) -> Option<Self> {
        let lo = self.value.inf().max(&Dyadic::zero()).clone(); // X1: the members from 0 on
        let value = Enclosure::new(lo, self.value.sup().clone())?.sqrt(self.bits)?;
        Some(self.with(value))
    }

    /// Returns the quotient; `None` if the divisor may be 0.
    pub fn over(&self, divisor: &Self) -> Option<Self> {
        let bits = self.bits.max(divisor.bits); // X1: any number of bits encloses
        self.value.div(&divisor.value, bits).map(|value| Self::new(value, bits))
    }

    /// Half of it, exactly.
    pub fn half(&self) -> Self {
        let half = |end: &Dyadic| end.scaled(-1);
        self.with(Enclosure::new(half(self.value.inf()), half(self.value.sup())).expect("in order"))
    }

    /// Returns the sine.
    pub fn sin(&self) -> Self {
        self.with(self.value.sin(self.bits))
    }

    /// Returns the cosine.
    pub fn cos(&self) -> Self {
        self.with(self.value.cos(self.bits))
    }

    /// Both.
    pub fn sin_cos(&self) -> (Self, Self) {
        (self.sin(), self.cos())
    }

    /// Returns the members that are at most `most`; a point of `most` if there is none.
    pub fn at_most(&self, most: i64) -> Self {
        let most = Dyadic::new(most.into(), 0);
        let cut = |end: &Dyadic| end.min(&most).clone(); // X1: the members up to it
        self.with(Enclosure::new(cut(self.value.inf()), cut(self.value.sup())).expect("in order"))
    }

    /// Returns the integer part that all members share.
    pub fn floor(&self) -> Option<i64> {
        self.value.floor().and_then(|n| i64::try_from(n).ok()) // exact: shared by all members
    }
}

impl Neg for &Real {
    type Output = Real;
    fn neg(self) -> Real {
        self.with(self.value.negated())
    }
}

impl Neg for Real {
    type Output = Real;
    fn neg(self) -> Real {
        -&self
    }
}

/// An operator on values and references, and with an integer on the right.
macro_rules! operator {
    ($trait:ident, $name:ident, $enclosure:ident) => {
        impl $trait<&Real> for &Real {
            type Output = Real;
            fn $name(self, b: &Real) -> Real {
                let bits = self.bits.max(b.bits); // X1: any number of bits encloses
                Real::new(self.value.$enclosure(&b.value, bits), bits)
            }
        }
        impl $trait<Real> for &Real {
            type Output = Real;
            fn $name(self, b: Real) -> Real {
                self.$name(&b)
            }
        }
        impl $trait<&Real> for Real {
            type Output = Real;
            fn $name(self, b: &Real) -> Real {
                (&self).$name(b)
            }
        }
        impl $trait<Real> for Real {
            type Output = Real;
            fn $name(self, b: Real) -> Real {
                (&self).$name(&b)
            }
        }
        impl $trait<i64> for &Real {
            type Output = Real;
            fn $name(self, b: i64) -> Real {
                self.$name(&Real::int(b, self.bits))
            }
        }
        impl $trait<i64> for Real {
            type Output = Real;
            fn $name(self, b: i64) -> Real {
                (&self).$name(b)
            }
        }
    };
}

operator!(Add, add, add);
operator!(Sub, sub, sub);
operator!(Mul, mul, mul);
