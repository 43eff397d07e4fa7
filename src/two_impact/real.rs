//! Numbers known to lie between two bounds, with operators, so that formulas read as on paper.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use crate::exact::{Dyadic, Enclosure, Exact, Round};

/// An enclosure and the bits that further operations round it to.
///
/// **Enclosure**: the result of an operation holds the result for every choice of members. Integers may stand on the right of
/// an operator.
///
/// ```
/// use impact_pair::exact::Exact;
/// use impact_pair::two_impact::Real;
/// let x = Real::of(&Exact::parse("1/3").unwrap(), 80);
/// assert!((x.sin().square() + x.cos().square() - 1).to_f64().abs() < 1e-23);
/// ```
#[derive(Clone, Debug)]
pub struct Real {
    value: Enclosure,
    bits: u32,
}

/// What the exact value is computed with beyond the bits asked for.
const GUARD: u32 = 8;
/// The steps of [`Real::angle`] at most: each one triples the digits.
const ANGLE_STEPS: usize = 16;

impl Real {
    /// All numbers of an enclosure.
    pub fn new(value: Enclosure, bits: u32) -> Self {
        Self { value, bits }
    }

    /// Encloses an exact number.
    pub fn of(x: &Exact, bits: u32) -> Self {
        Self::new(x.enclose(bits + GUARD), bits)
    }

    /// Exactly the integer.
    pub fn int(n: i64, bits: u32) -> Self {
        Self::new(Enclosure::point(Dyadic::new(n.into(), 0)), bits)
    }

    /// Encloses pi.
    pub fn pi(bits: u32) -> Self {
        Self::new(Enclosure::pi(bits), bits)
    }

    /// Its bounds.
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

    /// The sign that all members share.
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

    /// Whether no member of one is one of the other.
    pub fn is_apart_from(&self, other: &Self) -> bool {
        self.value.intersection(&other.value).is_none()
    }

    /// The members of both; `None` if there are none.
    pub fn intersection(&self, other: &Self) -> Option<Self> {
        self.value.intersection(&other.value).map(|value| self.with(value))
    }

    /// The least interval that holds both.
    pub fn hull(&self, other: &Self) -> Self {
        self.with(self.value.hull(&other.value))
    }

    /// A point near the middle, not outside.
    pub fn middle(&self) -> Self {
        let (lo, hi) = (self.value.lo(), self.value.hi());
        let sum = lo.plus(hi, self.bits.saturating_add(4), Round::Down);
        self.with(Enclosure::point(sum.scaled(-1).clamp(lo.clone(), hi.clone())))
    }

    /// The lower and the upper bound, as points.
    pub fn ends(&self) -> [Self; 2] {
        [self.value.lo(), self.value.hi()].map(|end| self.with(Enclosure::point(end.clone())))
    }

    /// An upper bound of the distance between two members.
    pub fn width(&self) -> Dyadic {
        self.value.width()
    }

    /// A double near the middle.
    pub fn to_f64(&self) -> f64 {
        self.value.mid_rad().0
    }

    /// The square; never negative.
    pub fn square(&self) -> Self {
        self.with(self.value.powi(2, self.bits).expect("the exponent is positive"))
    }

    /// The square root of the members that are not negative; `None` if there is none.
    pub fn sqrt(&self) -> Option<Self> {
        let lo = self.value.lo().max(&Dyadic::zero()).clone();
        let value = Enclosure::new(lo, self.value.hi().clone())?.sqrt(self.bits)?;
        Some(self.with(value))
    }

    /// The quotient; `None` if the divisor may be 0.
    pub fn over(&self, divisor: &Self) -> Option<Self> {
        let bits = self.bits.max(divisor.bits);
        self.value.div(&divisor.value, bits).map(|value| Self::new(value, bits))
    }

    /// Half of it, exactly.
    pub fn half(&self) -> Self {
        let half = |end: &Dyadic| end.scaled(-1);
        self.with(Enclosure::new(half(self.value.lo()), half(self.value.hi())).expect("in order"))
    }

    /// The sine.
    pub fn sin(&self) -> Self {
        self.with(self.value.sin(self.bits))
    }

    /// The cosine.
    pub fn cos(&self) -> Self {
        self.with(self.value.cos(self.bits))
    }

    /// The members that are at most `most`; a point of `most` if there is none.
    pub fn at_most(&self, most: i64) -> Self {
        let most = Dyadic::new(most.into(), 0);
        let cut = |end: &Dyadic| end.min(&most).clone();
        self.with(Enclosure::new(cut(self.value.lo()), cut(self.value.hi())).expect("in order"))
    }

    /// The integer part that all members share.
    pub fn floor(&self) -> Option<i64> {
        self.value.floor().and_then(|n| i64::try_from(n).ok())
    }

    /// The phase of `(cos, sin)`, between -pi and pi or a little beyond; `None` if the sets are too wide for one.
    ///
    /// For members that are the sine and cosine of one angle. (Lemma W9)
    pub fn angle(sin: &Self, cos: &Self) -> Option<Self> {
        let guess = Dyadic::from_f64(sin.to_f64().atan2(cos.to_f64()))?;
        let mut at = sin.with(Enclosure::point(guess));
        let mut best: Option<Self> = None;
        for _ in 0..ANGLE_STEPS {
            let (s, c) = (at.sin(), at.cos());
            let y = sin * &c - cos * &s;
            let is_near = y.value.mag() <= Dyadic::power_of_two(-1) && (cos * &c + sin * &s).is_positive();
            if !is_near {
                return best;
            }
            let size = y.with(Enclosure::point(y.value.mag()));
            let error = &size.square() * &size;
            let here = &at + &y + (-&error).hull(&error);
            let next = best.as_ref().map_or(Some(here.clone()), |best| best.intersection(&here)).expect("both hold it");
            let is_better = best.is_none_or(|best| next.width().scaled(1) < best.width());
            at = next.middle();
            best = Some(next);
            if !is_better {
                break;
            }
        }
        best
    }

    /// The angle between 0 and pi with this cosine, for the members in `[-1, 1]`; `None` if there is none.
    pub fn acos(&self) -> Option<Self> {
        let one = Self::int(1, self.bits);
        let value = self.intersection(&(-&one).hull(&one))?;
        // acos falls.
        let [low, high] = value.ends().map(|cos| Self::angle(&(&one - &cos.square()).sqrt()?, &cos));
        Some(high?.hull(&low?))
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
                let bits = self.bits.max(b.bits);
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point(x: f64, bits: u32) -> Real {
        Real::new(Enclosure::from_f64_bounds(x, x).unwrap(), bits)
    }

    proptest! {
        #[test]
        fn angles_are_found_again(t in -3.1..3.1f64, bits in 60u32..400) {
            let t = point(t, bits);
            let angle = Real::angle(&t.sin(), &t.cos()).unwrap();
            prop_assert!(!angle.is_apart_from(&t));
            prop_assert!(angle.width() < Dyadic::power_of_two(8 - i64::from(bits)));
            let arc = t.cos().acos().unwrap();
            prop_assert!(!arc.is_apart_from(&t) || !arc.is_apart_from(&-&t));
        }

        #[test]
        fn wide_sets_keep_their_members(t in 0.0..3.1f64, width in 0.0..0.04f64) {
            let set = point(t, 64).hull(&point(t + width, 64));
            let arc = set.cos().acos().unwrap();
            prop_assert!([t, t + width].iter().all(|&t| !arc.is_apart_from(&point(t, 64)) || t > 3.1));
            let angle = Real::angle(&set.sin(), &set.cos()).unwrap();
            prop_assert!(!angle.is_apart_from(&point(t, 64)) && !angle.is_apart_from(&point(t + width, 64)));
        }
    }
}
