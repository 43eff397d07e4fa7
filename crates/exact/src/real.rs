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
    /// The numbers of an enclosure; operations round to `bits` bits.
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

    /// The interval of all members.
    pub fn enclosure(&self) -> &Enclosure {
        &self.value
    }

    /// The bits that operations round to.
    pub fn bits(&self) -> u32 {
        self.bits
    }

    fn with(&self, value: Enclosure) -> Self {
        Self::new(value, self.bits)
    }

    /// The same set; further operations round to `bits` bits.
    pub fn at(&self, bits: u32) -> Self {
        Self { value: self.value.clone(), bits }
    }

    /// The set rounded outward to `bits` bits.
    pub fn rounded(&self, bits: u32) -> Self {
        Self { value: self.value.rounded(bits), bits }
    }

    /// The sign that all members share; `None` if their signs differ.
    pub fn sign(&self) -> Option<Ordering> {
        self.value.sign()
    }

    /// Whether all members are greater than 0.
    pub fn is_positive(&self) -> bool {
        self.sign() == Some(Ordering::Greater)
    }

    /// Whether all members are less than 0.
    pub fn is_negative(&self) -> bool {
        self.sign() == Some(Ordering::Less)
    }

    /// Whether 0 is the only member.
    pub fn is_zero(&self) -> bool {
        self.sign() == Some(Ordering::Equal)
    }

    /// Whether members of different signs, or 0 and another number, are in the set.
    pub fn is_across(&self) -> bool {
        self.sign().is_none()
    }

    /// Whether every member of `self` is less than every member of `other`.
    pub fn is_below(&self, other: &Self) -> bool {
        self.value.sup() < other.value.inf()
    }

    /// Whether the two sets have no member in common.
    pub fn is_apart_from(&self, other: &Self) -> bool {
        self.value.intersection(&other.value).is_none()
    }

    /// The common members of both sets; `None` if there are none.
    pub fn intersection(&self, other: &Self) -> Option<Self> {
        self.value.intersection(&other.value).map(|value| self.with(value))
    }

    /// The common part of two enclosures of the same number; `self` where they have none.
    pub fn cut(&self, other: &Self) -> Self {
        self.intersection(other).unwrap_or_else(|| self.clone())
    }

    /// The least interval that holds both sets.
    pub fn hull(&self, other: &Self) -> Self {
        self.with(self.value.hull(&other.value))
    }

    /// A point near the middle, and a member.
    pub fn middle(&self) -> Self {
        let (lo, hi) = (self.value.inf(), self.value.sup());
        let sum = lo.plus(hi, self.bits.saturating_add(4), Round::Down); // exact: any point, cut to a member below
        self.with(Enclosure::point(sum.scaled(-1).clamp(lo.clone(), hi.clone()))) // exact: a member
    }

    /// The point [`middle`](Self::middle) as a dyadic.
    pub fn mid(&self) -> Dyadic {
        self.middle().value.inf().clone()
    }

    /// The lower and the upper bound, as points.
    pub fn ends(&self) -> [Self; 2] {
        [self.value.inf(), self.value.sup()].map(|end| self.with(Enclosure::point(end.clone())))
    }

    /// Upper bound of the distance between two members.
    pub fn wid(&self) -> Dyadic {
        self.value.wid()
    }

    /// A double near the middle.
    pub fn to_f64(&self) -> f64 {
        self.value.mid_rad().0
    }

    /// Encloses the squares of the members; no bound is negative.
    pub fn square(&self) -> Self {
        self.with(self.value.powi(2, self.bits).expect("the exponent is positive"))
    }

    /// Encloses the square roots of the members that are not negative; `None` if all are negative.
    pub fn sqrt(&self) -> Option<Self> {
        let lo = self.value.inf().max(&Dyadic::zero()).clone(); // X1: the members from 0 on
        let value = Enclosure::new(lo, self.value.sup().clone())?.sqrt(self.bits)?;
        Some(self.with(value))
    }

    /// Encloses the quotient; `None` if the divisor may be 0.
    pub fn over(&self, divisor: &Self) -> Option<Self> {
        let bits = self.bits.max(divisor.bits); // X1: any number of bits encloses
        self.value.div(&divisor.value, bits).map(|value| Self::new(value, bits))
    }

    /// Half of each member, exactly.
    pub fn half(&self) -> Self {
        let half = |end: &Dyadic| end.scaled(-1);
        self.with(Enclosure::new(half(self.value.inf()), half(self.value.sup())).expect("in order"))
    }

    /// Encloses the sine.
    pub fn sin(&self) -> Self {
        self.with(self.value.sin(self.bits))
    }

    /// Encloses the cosine.
    pub fn cos(&self) -> Self {
        self.with(self.value.cos(self.bits))
    }

    /// Encloses the sine and the cosine.
    pub fn sin_cos(&self) -> (Self, Self) {
        let [sin, cos] = self.value.sin_cos(self.bits);
        (self.with(sin), self.with(cos))
    }

    /// The members that are at most `most`; the point `most` if there is none.
    pub fn at_most(&self, most: i64) -> Self {
        let most = Dyadic::new(most.into(), 0);
        let cut = |end: &Dyadic| end.min(&most).clone(); // X1: the members up to it
        self.with(Enclosure::new(cut(self.value.inf()), cut(self.value.sup())).expect("in order"))
    }

    /// The integer part that all members share; `None` if their integer parts differ.
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

/// Implements an operator for values and references, and with an integer on the right.
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
