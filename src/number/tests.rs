//! Reference for the tests of enclosures: intervals of 320 bits, far narrower than the enclosures that are tested.

use std::ops::{Add, Mul, Neg, Sub};

use proptest::prelude::*;

use super::{Ball, Enclosing};
use crate::exact::Enclosure;

/// The bits of the truth's ends.
const BITS: u32 = 320;

/// A real number, known to lie in here; computed by the exact room's intervals, which share nothing with balls.
#[derive(Clone, Debug)]
pub(crate) struct Truth(pub Enclosure);

impl From<f64> for Truth {
    fn from(x: f64) -> Self {
        Self(Enclosure::from_f64_bounds(x, x).expect("a finite double"))
    }
}

impl From<&Truth> for Truth {
    fn from(x: &Truth) -> Self {
        x.clone()
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $apply:expr) => {
        impl<T: Into<Truth>> $trait<T> for Truth {
            type Output = Truth;
            fn $method(self, b: T) -> Truth {
                let apply: fn(&Enclosure, &Enclosure) -> Enclosure = $apply;
                Truth(apply(&self.0, &b.into().0))
            }
        }
        impl<T: Into<Truth>> $trait<T> for &Truth {
            type Output = Truth;
            fn $method(self, b: T) -> Truth {
                self.clone().$method(b)
            }
        }
    };
}

operator!(Add, add, |a, b| a.add(b, BITS));
operator!(Sub, sub, |a, b| a.sub(b, BITS));
operator!(Mul, mul, |a, b| a.mul(b, BITS));

impl Neg for Truth {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.negated())
    }
}

impl Truth {
    /// One period in radians.
    pub fn turn() -> Self {
        Self(Enclosure::pi(BITS)) * 2.0
    }

    /// `(sin 2 pi u, cos 2 pi u)`
    pub fn sin_cos(&self) -> (Self, Self) {
        let angle = (self * &Self::turn()).0;
        (Self(angle.sin(BITS)), Self(angle.cos(BITS)))
    }

    /// `self / b`; `None` where `b` may be 0.
    pub fn over(&self, b: &Self) -> Option<Self> {
        self.0.div(&b.0, BITS).map(Self)
    }

    /// The square root of a number that is not negative.
    pub fn sqrt(&self) -> Self {
        Self(self.0.sqrt(BITS).expect("a number that is not negative"))
    }

    /// `|x|`
    pub fn abs(&self) -> Self {
        if self.0.sup().sign().is_lt() { -self.clone() } else { self.clone() }
    }

    /// A single number inside, in the middle.
    pub fn point(&self) -> Self {
        let [lo, hi] = [self.0.inf(), self.0.sup()].map(|end| Enclosure::point(end.clone()));
        Self(Enclosure::point((Self(lo.add(&hi, BITS)) * 0.5).0.inf().clone()))
    }

    /// With all the numbers within `by`.
    pub fn widened(&self, by: &Self) -> Self {
        let by = by.abs();
        Self((self - &by).0.hull(&(self + &by).0))
    }

    /// Returns whether it is proved to be greater than `b`.
    pub fn exceeds(&self, b: impl Into<Self>) -> bool {
        self.0.inf() > b.into().0.sup()
    }

    /// Returns whether it may lie in the ball: one that is not finite holds everything.
    pub fn is_in(&self, ball: &impl Enclosing) -> bool {
        ball.as_enclosure().is_none_or(|ball| ball.intersection(&self.0).is_some())
    }
}

/// The member of the ball at `place` of its radius from the centre, from -1 to 1.
pub(crate) fn member(ball: &impl Enclosing, place: f64) -> Truth {
    let radius = |x: Enclosure| Truth(Enclosure::point(x.sup().clone()));
    let [centre, spread] = [ball.centre(), ball.spread()].map(|x| x.as_enclosure().expect("a finite ball"));
    Truth(centre) + radius(spread) * place
}

/// Places in a ball, often its ends.
pub(crate) fn places() -> impl Strategy<Value = f64> + Clone {
    prop_oneof![Just(-1.0), Just(1.0), Just(0.0), -1.0..1.0f64]
}

/// A power of ten between the exponents, which need not be whole.
pub(crate) fn powers(low: f64, high: f64) -> impl Strategy<Value = f64> + Clone {
    (low..high).prop_map(|x| 10f64.powf(x))
}

/// Doubles of every size, often 0, a whole number of eighths, or near 1.
pub(crate) fn doubles() -> impl Strategy<Value = f64> + Clone {
    let sign = prop_oneof![Just(-1.0), Just(1.0)];
    let size = prop_oneof![
        1 => Just(0.0),
        2 => (0..40u32).prop_map(|k| f64::from(k) / 8.0),
        2 => (0..20u64).prop_map(|k| f64::from_bits(1f64.to_bits() - 10 + k)),
        4 => 0.0..4.0f64,
        4 => powers(-20.0, 12.0),
        2 => powers(-323.0, 300.0),
    ];
    (sign, size).prop_map(|(sign, size)| sign * size)
}

/// Balls of every size, often points, or so wide that they hold 0.
pub(crate) fn balls() -> impl Strategy<Value = Ball> + Clone {
    let radius = prop_oneof![
        2 => Just((0.0, 0.0)),
        4 => powers(-18.0, 0.5).prop_map(|relative| (relative, 0.0)),
        1 => (0.9..1.1f64).prop_map(|relative| (relative, 0.0)),
        2 => powers(-323.0, 3.0).prop_map(|absolute| (0.0, absolute)),
    ];
    (doubles(), radius).prop_map(|(mid, (relative, absolute))| Ball::new(mid, relative * mid.abs() + absolute))
}

proptest! {
    #[test]
    fn members_of_a_ball_lie_in_it_and_none_beyond_its_ends(x in balls(), place in places(), by in powers(-9.0, 3.0)) {
        prop_assert!(member(&x, place).is_in(&x));
        // The ends of a ball are given to 160 bits.
        if x.rad() > 1e-30 * x.mid().abs() && x.mag() < 1e300 {
            prop_assert!(!member(&x, 1.0 + by).is_in(&x) && !member(&x, -1.0 - by).is_in(&x));
        }
    }
}
