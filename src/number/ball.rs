//! Balls in double precision: a centre and a radius, rounded to nearest, the radius inflated.
//!
//! Sets, Jacobians and parameters are balls. The rounding mode is never touched (switching it costs more
//! than the operations), so every operation bounds its own rounding errors:
//!
//! **Lemma B1.** For a rounded-to-nearest operation with exact value `x` and result `m`,
//! `|x - m| <= UNIT |m| + TINY`, with `UNIT = 2^-53` and `TINY` the smallest normal double (for sums the
//! second term is not needed; for products and quotients it covers underflow). [`up`] multiplies by
//! `1 + 8 UNIT`, which covers the roundings of the sums of at most six non-negative terms that make a
//! radius. An overflow makes the radius infinite or NaN, and a NaN radius certifies nothing: all decisions
//! are comparisons that fail on NaN.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use super::kernel::SmallAngle;
use super::{Enclosing, Number, SHORT, Wave, kernel};
use crate::exact::{Enclosure, Exact};

/// The unit roundoff, `2^-53`.
pub(crate) const UNIT: f64 = f64::EPSILON / 2.0;
/// Covers underflow in a product or quotient (Lemma B1).
pub(crate) const TINY: f64 = f64::MIN_POSITIVE;
/// The smallest positive double: twice what a product that underflows is off (Lemma B1).
const SMALLEST: f64 = f64::from_bits(1);

/// More than `2 pi`: what the sine and the cosine of a phase in periods change by at most for each period.
pub(crate) const ABOVE_TWO_PI: f64 = 6.3;
/// `2^400`: what ratios and rates may be at most, in gaps and forcing periods, so that nothing overflows in the course of a flight.
pub(crate) const LARGEST_RATE: f64 = 2.582_249_878_086_908_6e120;
/// Bits that an exact number is enclosed in to become a ball: more than twice those of a double, so only the double rounds.
const EXACT_BITS: u32 = 120;
/// Bits of the ends of a ball.
const ENCLOSURE_BITS: u32 = 160;

/// An upper bound of a sum of at most six non-negative terms, from its rounded value (Lemma B1).
#[inline(always)]
pub(crate) fn up(radius: f64) -> f64 {
    radius * (1.0 + 8.0 * UNIT)
}

/// Returns whether `x` is greater than 0: no NaN is.
#[inline(always)]
pub(crate) fn is_positive(x: f64) -> bool {
    x > 0.0
}

/// The power of two at or below `|x|` (0 below the normal range): rounding to `x` errs by at most `UNIT` times it.
///
/// Half a unit in the last place; `UNIT * x.abs()` costs the same and is up to twice as wide.
#[inline(always)]
pub(crate) fn binade(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & f64::INFINITY.to_bits())
}

/// All real numbers within [`Ball::rad`] of [`Ball::mid`].
///
/// **Enclosure**: the result of an operation on balls holds the result for every choice of their members.
///
/// ```
/// use impact_pair::number::Ball;
/// let third = Ball::new(1.0, 0.0).checked_div(Ball::new(3.0, 0.0)).unwrap();
/// assert!(third.rad() < 1e-16 && (third.mid() - 1.0 / 3.0).abs() <= third.rad());
/// # use impact_pair::number::Number;
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    mid: f64,
    rad: f64,
}

impl Ball {
    /// The numbers at most `|rad|` from `mid`.
    #[inline(always)]
    pub fn new(mid: f64, rad: f64) -> Self {
        Self { mid, rad: rad.abs() } // exact: its size
    }

    /// The single number `mid`.
    #[inline(always)]
    pub fn exact(mid: f64) -> Self {
        Self { mid, rad: 0.0 }
    }

    /// Encloses an exact number.
    pub fn of(x: &Exact) -> Self {
        let (mid, rad) = x.enclose(EXACT_BITS).mid_rad();
        Self { mid, rad }
    }

    /// The centre.
    #[inline(always)]
    pub fn mid(self) -> f64 {
        self.mid
    }

    /// The radius, an upper bound.
    #[inline(always)]
    pub fn rad(self) -> f64 {
        self.rad
    }

    /// An upper bound of the absolute values inside.
    #[inline(always)]
    pub fn mag(self) -> f64 {
        up(self.mid.abs() + self.rad)
    }

    /// The same centre with a radius larger by `|by|`.
    #[inline(always)]
    pub fn widened(self, by: f64) -> Self {
        Self { mid: self.mid, rad: up(self.rad + by.abs()) } // B1
    }

    /// The ball as an interval; `None` when it is not finite.
    ///
    /// The ends have at most 160 bits; where centre and radius lie farther apart they are rounded outward.
    pub fn enclosure(self) -> Option<Enclosure> {
        let point = |x: f64| Enclosure::from_f64_bounds(x, x);
        let (mid, rad) = (point(self.mid)?, point(self.rad)?);
        Some(mid.sub(&rad, ENCLOSURE_BITS).hull(&mid.add(&rad, ENCLOSURE_BITS)))
    }

    /// Encloses `(sin 2 pi u, cos 2 pi u)` for all `u` in the ball.
    pub fn sin_cos(self) -> (Self, Self) {
        // Lemma K1; a NaN is refused as well.
        if self.mid.abs().partial_cmp(&kernel::LARGEST_PHASE) != Some(Ordering::Less) {
            return (Self::new(0.0, 1.0), Self::new(0.0, 1.0));
        }
        let (s, c) = kernel::sin_cos(self.mid);
        // Lemma K1, and the slope of both is at most 2 pi.
        let rad = up(kernel::SIN_COS_ERROR + ABOVE_TWO_PI * self.rad);
        (Self::new(s, rad), Self::new(c, rad))
    }
}

impl Add for Ball {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        let mid = self.mid + b.mid;
        Self { mid, rad: up(self.rad + b.rad + UNIT * mid.abs()) }
    }
}

impl Neg for Ball {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { mid: -self.mid, rad: self.rad }
    }
}

impl Sub for Ball {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        self + -b
    }
}

impl Mul for Ball {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        let mid = self.mid * b.mid;
        let spread = self.rad.mul_add(b.mid.abs() + b.rad, self.mid.abs() * b.rad);
        Self { mid, rad: up(spread + UNIT * mid.abs() + TINY) }
    }
}

impl Number for Ball {
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Self::exact(x)
    }
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }
    /// Lemma B2: with the centres `A`, `B` and their rounded quotient `m`, `|a/b - A/B| <= (r_a + |A/B| r_b)/|b|` and
    /// `|A/B - m| <= UNIT |m| + TINY`.
    #[inline(always)]
    fn checked_div(self, b: Self) -> Option<Self> {
        // One rounding, covered by the factor below.
        let least = (b.mid.abs() - b.rad) * (1.0 - 4.0 * UNIT);
        // A NaN is refused as well.
        if least.partial_cmp(&TINY) != Some(std::cmp::Ordering::Greater) {
            return None;
        }
        let mid = self.mid / b.mid;
        // Lemma B2: the divisor's radius is multiplied by the true quotient of centres; SMALLEST covers underflow of that.
        let spread = (b.rad.mul_add(mid.abs() + TINY, self.rad) + SMALLEST) / least;
        Some(Self { mid, rad: up(up(spread) + UNIT * mid.abs() + TINY) })
    }
    #[inline(always)]
    fn turn(&self) -> Self {
        // 2 pi is within 2^-52 of its nearest double (TAU_LO of the kernel is 2.4e-16).
        Self { mid: std::f64::consts::TAU, rad: 2.5e-16 }
    }
    #[inline(always)]
    fn signed(self, sign: f64) -> Self {
        Self { mid: self.mid * sign, rad: self.rad }
    }
}

impl Wave for Ball {
    #[inline(always)]
    fn wave(&self) -> (Self, Self) {
        self.sin_cos()
    }
    /// Lemma K2, and slopes of `2 pi sin`, `2 pi (1 - cos)` and `2 pi cos` over the ball.
    fn short(&self) -> Option<SmallAngle<Self>> {
        let longest = self.mag();
        if !(SHORT.contains(&self.mid) && longest <= 0.125) {
            return None;
        }
        let SmallAngle { versine, excess, sine } = kernel::departure(self.mid);
        // sin x <= x, 1 - cos x <= x^2/2; the spread is 0 for a point.
        let angle = ABOVE_TWO_PI * longest;
        let ball =
            |x: f64, slope: f64| Self::new(x, up(x * kernel::DEPARTURE_ERROR * 2.0 + ABOVE_TWO_PI * slope * self.rad));
        Some(SmallAngle { versine: ball(versine, angle), excess: ball(excess, angle * angle), sine: ball(sine, 1.0) })
    }
}

impl Enclosing for Ball {
    #[inline(always)]
    fn centre(&self) -> Self {
        Self::exact(self.mid)
    }
    #[inline(always)]
    fn spread(&self) -> Self {
        Self::new(0.0, self.rad)
    }
    #[inline(always)]
    fn with_radius(&self, radius: f64) -> Self {
        Self::new(self.mid, radius)
    }
    #[inline(always)]
    fn is_interior_to(&self, outer: &Self) -> bool {
        up((self.mid - outer.mid).abs() + self.rad) < outer.rad
    }
    #[inline(always)]
    fn log2_radius(&self) -> f64 {
        self.rad.log2()
    }
    #[inline(always)]
    fn certain_sign(&self) -> Option<Ordering> {
        // Two doubles compare exactly; a NaN does not at all.
        if self.mid.abs() > self.rad || self.rad == 0.0 { self.mid.partial_cmp(&0.0) } else { None } // B2: a point
    }
    #[inline(always)]
    fn as_ball(&self) -> Ball {
        *self
    }
    fn as_enclosure(&self) -> Option<Enclosure> {
        self.enclosure()
    }
}

#[cfg(test)]
mod tests;
