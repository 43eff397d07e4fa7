//! Balls of many bits: as many digits as requested.
//!
//! A centre is a [`Float`], which has a precision of its own; the result of an operation has the larger one of its
//! operands. Radii are [`Magnitude`]s.
//!
//! **Lemma M1.** The result `m` of an operation on [`Float`]s, rounded to nearest at `p` bits, is within
//! `2^(e - p - 1)` of the exact one, `2^(e - 1) <= |m| < 2^e`, and equal to it when the operation says so. So the
//! radii of Lemma B2 with this in place of `UNIT |m|` enclose.

mod arc;
mod arithmetic;
mod float;
mod operations;
mod sine;
mod upper;

use std::cmp::Ordering;

pub use float::Float;
use float::Round;

use super::kernel::SmallAngle;
use super::{ABOVE_TWO_PI, Ball, Enclosing, LEAST_BITS, Magnitude, Number, Wave, up};
use crate::exact::Enclosure;

/// All real numbers within [`MpBall::rad`] of [`MpBall::mid`].
///
/// **Enclosure**: the result of an operation on balls holds the result for every choice of their members.
///
/// ```
/// use impact_pair::number::{MpBall, Number};
/// let three = MpBall::from_f64_bits(3.0, 200);
/// let third = MpBall::from_f64_bits(1.0, 200).checked_div(three.clone()).unwrap();
/// let one = third.clone() * three;
/// assert!(one.contains(&MpBall::from_f64(1.0)) && third.rad().log2() <= -200.0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct MpBall {
    mid: Float,
    rad: Magnitude,
}

/// Bits between a centre and its radius beyond which the sum of both is rounded.
const MOST_SPREAD: u64 = 1 << 24;

/// Half a unit in the last place of a rounded result, 0 when it is exact (Lemma M1).
#[inline]
fn rounding((mid, is_exact): (Float, bool)) -> (Float, Magnitude) {
    let error = error_of(&mid, is_exact);
    (mid, error)
}

/// The same for a result that has taken the place of an operand.
#[inline]
fn error_of(mid: &Float, is_exact: bool) -> Magnitude {
    if is_exact { Magnitude::ZERO } else { mid.half_unit() }
}

impl MpBall {
    /// The ball of this centre and radius.
    pub fn new(mid: Float, rad: Magnitude) -> Self {
        Self { mid, rad }
    }

    /// The single number `mid`.
    pub fn exact(mid: Float) -> Self {
        Self { mid, rad: Magnitude::ZERO }
    }

    /// Encloses an enclosure, with a centre of `bits` bits.
    pub fn enclosing(x: &Enclosure, bits: u32) -> Self {
        let [low, high] = [x.inf(), x.sup()].map(|end| Float::exactly(end, 1));
        // M1: any centre; the radius is measured from it
        let mid = low.plus(&high, bits).scaled(-1);
        let [below, above] = [&low, &high].map(|end| end.distance(&mid));
        let rad = if below < above { above } else { below };
        Self { mid, rad }
    }

    /// The number that the double `x` is, exactly, with `bits` bits.
    pub fn from_f64_bits(x: f64, bits: u32) -> Self {
        Self::exact(Float::with_bits(x, bits.max(f64::MANTISSA_DIGITS))) // M1: bits enough for a double
    }

    /// The centre.
    pub fn mid(&self) -> &Float {
        &self.mid
    }

    /// The radius, an upper bound.
    pub fn rad(&self) -> Magnitude {
        self.rad
    }

    /// The bits of the centre.
    #[inline]
    pub fn bits(&self) -> u32 {
        self.mid.bits()
    }

    /// An upper bound of the absolute values inside.
    #[inline]
    pub fn mag(&self) -> Magnitude {
        self.mid.magnitude() + self.rad
    }

    /// A lower bound of the absolute values inside; `None` when 0 may be one.
    pub fn mig(&self) -> Option<Magnitude> {
        self.mid.least().less(self.rad)
    }

    /// Its sign, if that is certain.
    pub fn sign(&self) -> Option<Ordering> {
        // Far from 0, as mostly, the exponents tell.
        let is_far = || self.mid.top().zip(self.rad.exponent()).is_some_and(|(top, rad)| rad < top - 1);
        if self.rad.is_zero() || is_far() {
            return self.mid.sign();
        }
        self.mig().and_then(|_| self.mid.sign())
    }

    /// Returns whether all of `other` lies inside.
    pub fn contains(&self, other: &Self) -> bool {
        self.mid.distance(&other.mid) + other.rad <= self.rad
    }

    /// The same centre with a radius larger by `by`.
    pub fn widened(self, by: Magnitude) -> Self {
        Self { rad: self.rad + by, mid: self.mid }
    }

    /// The centre rounded to `bits` bits, the radius larger by the rounding.
    pub fn rounded(&self, bits: u32) -> Self {
        let (mid, error) = rounding(self.mid.clone().into_bits(bits, Round::Nearest));
        Self { mid, rad: self.rad + error }
    }

    /// Encloses it in a double-precision ball.
    pub fn to_ball(&self) -> Ball {
        let mid = self.mid.to_f64();
        let rounding = self.mid.distance(&Float::new(mid)).to_f64();
        Ball::new(mid, up(self.rad.to_f64() + rounding))
    }

    /// Encloses a double-precision ball; a ball that is not finite has no bound.
    pub fn from_ball(x: Ball) -> Self {
        let mid = if x.mid().is_finite() { x.mid() } else { 0.0 };
        let rad = if x.mid().is_finite() { x.rad() } else { f64::INFINITY };
        Self { mid: Float::new(mid), rad: Magnitude::new(rad, 0) }
    }

    /// The ball as an interval; `None` when it has no bound.
    pub fn enclosure(&self) -> Option<Enclosure> {
        self.enclosure_in(u32::MAX)
    }

    /// The same, its ends rounded outward to at most `bits` bits.
    pub(crate) fn enclosure_in(&self, bits: u32) -> Option<Enclosure> {
        let rad = float_of_magnitude(self.rad)?;
        // Enough bits for all between the top of one and the bottom of the other.
        let tops = self.mid.top().zip(rad.top());
        let spread = tops.map_or(0, |(top, bottom)| top.abs_diff(bottom)).min(MOST_SPREAD) as u32; // X1: any number of bits encloses
        let bits = bits.min(self.bits().max(spread) + 64); // X1: any number of bits encloses
        let (low, _) = self.mid.clone().sub(&rad, bits, Round::Down);
        let (high, _) = self.mid.clone().add(&rad, bits, Round::Up);
        Enclosure::new(low.dyadic()?, high.dyadic()?)
    }

    /// Encloses `(sin 2 pi u, cos 2 pi u)` for all `u` in the ball; at quarter periods they are exact.
    pub fn sin_cos(&self) -> (Self, Self) {
        if let Some(quarter) = self.quarter() {
            let at = |shift: i32| [0.0, 1.0, 0.0, -1.0][(quarter + shift).rem_euclid(4) as usize]; // exact: 0 to 3
            return (Self::from_f64(at(0)), Self::from_f64(at(1)));
        }
        let Some(found) = sine::sin_cos(&self.mid, self.bits()) else {
            let unknown = || Self { mid: Float::zero(self.bits()), rad: Magnitude::INFINITE };
            return (unknown(), unknown());
        };
        // Their slopes are at most 2 pi.
        let turned = Magnitude::new(ABOVE_TWO_PI, 0) * self.rad;
        found.map(|(mid, error)| Self { mid, rad: turned + error }).into()
    }

    /// Returns the number of quarter periods, if it is exactly an integer, and small.
    fn quarter(&self) -> Option<i32> {
        if !self.rad.is_zero() {
            return None;
        }
        let quarters = 4.0 * self.mid.to_f64();
        let is_one = quarters.abs() <= 8.0 && quarters.fract() == 0.0 && self.mid == quarters / 4.0; // exact: a power of two
        is_one.then_some(quarters as i32) // exact: at most 8 in size
    }

    /// Encloses versine, excess and sine of `2 pi h` for a short `h` by Taylor's formula; `None` unless `|h| <= 1/64`.
    ///
    /// **Lemma M2.** For `|x| <= 1/8` each term of the alternating series of versine and excess is less than
    /// the one before, so what is left out of each sum is smaller than the first term that is left out of one.
    pub fn short_departure(&self) -> Option<SmallAngle<Self>> {
        // Relative to the excess, the smallest of them.
        let size = Magnitude::new(ABOVE_TWO_PI, 0) * self.mag();
        self.departure_within(size * size * size * Magnitude::power_of_two(-i64::from(self.bits()) - 3))
    }

    /// [`short_departure`](Self::short_departure) in so few bits that a few times `error` is added to the radii.
    pub(crate) fn departure_within(&self, error: Magnitude) -> Option<SmallAngle<Self>> {
        if self.mag() > Magnitude::power_of_two(-6) {
            return None;
        }
        // Bits that a number of this size needs.
        let worth = |size: Magnitude| {
            let bits = (size.log2() - error.log2()).max(0.0) + 3.0; // M1: any number of bits
            (bits as u32).clamp(LEAST_BITS, self.bits().max(LEAST_BITS)) // M1: any number of bits
        };
        let bits = worth(Magnitude::new(ABOVE_TWO_PI, 0) * self.mag());
        let turn = Self::exact(Float::zero(bits)).turn();
        let x = turn.product(self, bits);
        let size = x.mag();
        let (mut versine, mut excess) = (Self::from_f64(0.0), Self::from_f64(0.0));
        // x^n / n! and a bound of it
        let (mut term, mut left) = (x.clone(), size);
        for n in 2u32.. {
            left = (left * size).over(Magnitude::new(f64::from(n), 0));
            if left <= error {
                break;
            }
            term = term.product(&x, worth(left)).divided(n);
            let sum = if n.is_multiple_of(2) { &mut versine } else { &mut excess };
            if matches!(n % 4, 2 | 3) { *sum += &term } else { *sum -= &term }
        }
        let (versine, excess) = (versine.widened(left), excess.widened(left));
        Some(SmallAngle { versine, sine: x.minus(&excess), excess })
    }
}

impl Wave for MpBall {
    fn wave(&self) -> (Self, Self) {
        self.sin_cos()
    }
    fn short(&self) -> Option<SmallAngle<Self>> {
        self.short_departure()
    }
}

impl Enclosing for MpBall {
    fn centre(&self) -> Self {
        Self::exact(self.mid.clone())
    }
    fn spread(&self) -> Self {
        Self::new(Float::zero(self.bits()), self.rad)
    }
    fn with_radius(&self, radius: f64) -> Self {
        Self::new(self.mid.clone(), Magnitude::new(radius, 0))
    }
    fn is_interior_to(&self, outer: &Self) -> bool {
        self.mid.distance(&outer.mid) + self.rad < outer.rad
    }
    fn log2_radius(&self) -> f64 {
        self.rad.log2()
    }
    fn certain_sign(&self) -> Option<Ordering> {
        self.sign()
    }
    fn as_ball(&self) -> Ball {
        self.to_ball()
    }
    fn as_enclosure(&self) -> Option<Enclosure> {
        self.enclosure()
    }
}

/// A finite magnitude as a float, exactly.
fn float_of_magnitude(x: Magnitude) -> Option<Float> {
    let Some(exponent) = x.exponent() else { return Some(Float::new(0.0)) };
    x.is_finite().then(|| Float::new(x.in_units_of(exponent)).scaled(exponent))
}

#[cfg(test)]
mod tests;
