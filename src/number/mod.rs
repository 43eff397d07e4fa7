//! The arithmetics: one small trait, so that each formula of the paper is written once.
//!
//! `f64` proposes, [`Ball`] disposes, and `MpBall` where doubles do not suffice: the float twin, the enclosures and
//! the Jacobian run through the same lines of [`crate::flight`] and [`crate::mapping`] and cannot drift apart, and so do the
//! intervals of the package inari in a build with the feature `inari`. Phases are in periods everywhere (see [`kernel`]).

mod approx;
mod ball;
#[cfg(all(feature = "inari", target_feature = "fma"))]
pub mod inari;
pub(crate) mod interval;
pub mod kernel;
mod logarithm;
mod magnitude;
pub(crate) mod multiprecision;
#[cfg(test)]
pub(crate) mod tests;

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use crate::exact::Enclosure;

pub use ball::Ball;
pub(crate) use ball::{ABOVE_TWO_PI, LARGEST_RATE, TINY, UNIT, binade, is_positive, up};
use kernel::SmallAngle;
pub use logarithm::logarithm;
pub use magnitude::Magnitude;
pub use multiprecision::{Float, MpBall};

/// The least precision of an `MpBall`, in bits.
pub const LEAST_BITS: u32 = 64;

/// A number with the operations of the paper's formulas: ring operations and a fused multiply-add.
pub trait Number: Clone + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self> {
    /// The number that the double `x` is, exactly.
    fn from_f64(x: f64) -> Self;
    /// `self * b + c`; for `f64` rounded once.
    fn mul_add(self, b: Self, c: Self) -> Self;
    /// `self / b`; for balls and intervals `None` when the divisor may be 0.
    fn checked_div(self, b: Self) -> Option<Self>;
    /// `2 pi`, one period in radians, as precisely as `self` is.
    fn turn(&self) -> Self;
    /// `sign * self` for a sign of 1 or -1, exactly.
    fn signed(self, sign: f64) -> Self;
    /// `self + b`, for numbers that are dear to copy.
    #[inline(always)]
    fn plus(self, b: &Self) -> Self {
        self + b.clone()
    }
    /// `self - b`, likewise.
    #[inline(always)]
    fn minus(self, b: &Self) -> Self {
        self - b.clone()
    }
    /// `self * b`, likewise.
    #[inline(always)]
    fn times(self, b: &Self) -> Self {
        self * b.clone()
    }
    /// `self * b + c`, likewise.
    #[inline(always)]
    fn mul_add_ref(&self, b: &Self, c: Self) -> Self {
        self.clone().mul_add(b.clone(), c)
    }
    /// `c - self * b`, likewise.
    #[inline(always)]
    fn mul_sub_ref(&self, b: &Self, c: Self) -> Self {
        (-self.clone()).mul_add(b.clone(), c)
    }
}

impl Number for f64 {
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        f64::mul_add(self, b, c)
    }
    #[inline(always)]
    fn checked_div(self, b: Self) -> Option<Self> {
        (b != 0.0).then(|| self / b) // proposes: floats
    }
    #[inline(always)]
    fn turn(&self) -> Self {
        std::f64::consts::TAU
    }
    #[inline(always)]
    fn signed(self, sign: f64) -> Self {
        self * sign
    }
}

/// A number that phases can be: sine and cosine of an angle in periods.
pub trait Wave: Number {
    /// `(sin 2 pi u, cos 2 pi u)`; for balls, of every member.
    fn wave(&self) -> (Self, Self);
    /// Versine, excess and sine of a short time, where they are known without cancellation; of no other.
    fn short(&self) -> Option<SmallAngle<Self>> {
        None
    }
}

/// The times that [`kernel::departure`] takes (Lemma K2), less the rounding of its ends.
const SHORT: std::ops::RangeInclusive<f64> = 4.909093465297727e-91..=0.1249;

impl Wave for f64 {
    #[inline(always)]
    fn wave(&self) -> (Self, Self) {
        // K1: outside the domain of the kernel floats know nothing
        if self.abs() <= kernel::LARGEST_PHASE { kernel::sin_cos(*self) } else { (f64::NAN, f64::NAN) }
    }
    #[inline(always)]
    fn short(&self) -> Option<SmallAngle> {
        SHORT.contains(self).then(|| kernel::departure(*self))
    }
}

/// A ball as proofs see it, in any arithmetic.
pub trait Enclosing: Wave + nalgebra::Scalar {
    /// The centre alone.
    fn centre(&self) -> Self;
    /// The differences of the members from the centre: a ball around 0.
    fn spread(&self) -> Self;
    /// The same centre with this radius.
    fn with_radius(&self, radius: f64) -> Self;
    /// Returns whether the ball is proved to lie in the interior of `outer`.
    fn is_interior_to(&self, outer: &Self) -> bool;
    /// `log2` of the radius, to nearest: it decides nothing.
    fn log2_radius(&self) -> f64;
    /// Its sign, if that is certain.
    fn certain_sign(&self) -> Option<Ordering>;
    /// Encloses it in a double-precision ball.
    fn as_ball(&self) -> Ball;
    /// The ball as an interval; `None` when it is not finite.
    fn as_enclosure(&self) -> Option<Enclosure>;
}

/// The trigonometry of a floating-point solver, in periods.
///
/// [`Kernel`] is ours and certified; [`Std`] is the standard library's, which promises no bound: it serves
/// as the plain baseline that the benches compare with.
pub trait Trigonometry {
    /// Bound of the error of [`Trigonometry::acos`], in periods (for [`Std`] the usual one, not proved).
    const ACOS_ERROR: f64;
    /// `(sin 2 pi u, cos 2 pi u)`
    fn sin_cos(u: f64) -> (f64, f64);
    /// Versine, excess and sine of a short flight of `h` periods, `0 <= h <= 1/8`.
    fn departure(h: f64) -> SmallAngle;
    /// `acos(q) / (2 pi)` for `-1 <= q <= 1`.
    fn acos(q: f64) -> f64;
}

/// The certified kernel of [`kernel`] (Lemmas K1-K3).
#[derive(Clone, Copy, Debug)]
pub struct Kernel;

impl Trigonometry for Kernel {
    const ACOS_ERROR: f64 = kernel::ACOS_ERROR;
    #[inline(always)]
    fn sin_cos(u: f64) -> (f64, f64) {
        kernel::sin_cos(u)
    }
    #[inline(always)]
    fn departure(h: f64) -> SmallAngle {
        kernel::departure(h)
    }
    #[inline(always)]
    fn acos(q: f64) -> f64 {
        kernel::acos_coarse(q)
    }
}

/// The standard library's functions: what a plain double-precision solver uses.
#[derive(Clone, Copy, Debug)]
pub struct Std;

impl Trigonometry for Std {
    const ACOS_ERROR: f64 = 4.0 * UNIT;
    #[inline(always)]
    fn sin_cos(u: f64) -> (f64, f64) {
        (std::f64::consts::TAU * u).sin_cos()
    }
    #[inline(always)]
    fn departure(h: f64) -> SmallAngle {
        let angle = std::f64::consts::TAU * h;
        let half = (0.5 * angle).sin();
        SmallAngle { versine: 2.0 * half * half, excess: angle - angle.sin(), sine: angle.sin() }
    }
    #[inline(always)]
    fn acos(q: f64) -> f64 {
        q.acos() / std::f64::consts::TAU
    }
}
