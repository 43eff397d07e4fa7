//! Balls with MPFR centres: as many digits as requested.
//!
//! A centre has a precision of its own; the result of an operation has the larger one of its operands. Radii are
//! [`Magnitude`]s.
//!
//! **Lemma M1.** MPFR rounds every function used here correctly: the result `m` of a rounding to nearest at `p` bits
//! is within `2^(e - p - 1)` of the exact one, `2^(e - 1) <= |m| < 2^e`, and equal to it when MPFR says so. So the
//! radii of Lemma B2 with this in place of `UNIT |m|` enclose.

mod arithmetic;
mod sine;

use std::cmp::Ordering;

use gmp_mpfr_sys::mpfr::{VERSION_MAJOR, VERSION_MINOR, VERSION_PATCHLEVEL};
use num_bigint::{BigInt, Sign};
use rug::float::Round;
use rug::integer::Order;
use rug::{Assign, Float, Integer};

use super::kernel::SmallAngle;
use super::{ABOVE_TWO_PI, Ball, Enclosing, LEAST_BITS, Magnitude, Number, Wave, up};
use crate::exact::{Dyadic, Enclosure};

/// All real numbers within [`MpBall::rad`] of [`MpBall::mid`].
///
/// **Enclosure**: the result of an operation on balls holds the result for every choice of their members.
///
/// ```
/// use impact_pair::number::{MpBall, Number};
/// use rug::Float;
/// let three = MpBall::exact(Float::with_val(200, 3));
/// let third = MpBall::exact(Float::with_val(200, 1)).checked_div(three.clone()).unwrap();
/// let one = third.clone() * three;
/// assert!(one.contains(&MpBall::from_f64(1.0)) && third.rad().log2() <= -200.0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct MpBall {
    mid: Float,
    rad: Magnitude,
}

/// The version of MPFR that this build has, such as `4.2.2`.
pub fn mpfr_version() -> String {
    format!("{VERSION_MAJOR}.{VERSION_MINOR}.{VERSION_PATCHLEVEL}")
}

/// Bits between a centre and its radius beyond which the sum of both is rounded.
const MOST_SPREAD: u32 = 1 << 24;

/// `2^(e - p - 1)` for a rounded result, 0 when it is exact (Lemma M1).
#[inline]
fn rounding((mid, ordering): (Float, Ordering)) -> (Float, Magnitude) {
    let error = error_of(&mid, ordering);
    (mid, error)
}

/// The same for a result that has taken the place of an operand.
#[inline]
fn error_of(mid: &Float, ordering: Ordering) -> Magnitude {
    match ordering {
        Ordering::Equal => Magnitude::ZERO,
        _ => half_unit(mid),
    }
}

/// Half a unit in the last place; no bound for 0, which no inexact result is but by underflow.
#[inline]
fn half_unit(x: &Float) -> Magnitude {
    match x.get_exp() {
        Some(exponent) => Magnitude::power_of_two(i64::from(exponent) - i64::from(x.prec()) - 1),
        None => Magnitude::INFINITE,
    }
}

/// A power of two that `|x|` does not reach.
#[inline]
fn above(x: &Float) -> Magnitude {
    match x.get_exp() {
        Some(exponent) => Magnitude::power_of_two(i64::from(exponent)),
        None if x.is_zero() => Magnitude::ZERO,
        None => Magnitude::INFINITE,
    }
}

/// `|x|` rounded up.
#[inline]
pub(crate) fn magnitude(x: &Float) -> Magnitude {
    let (fraction, exponent) = x.to_f64_exp_round(Round::AwayZero);
    Magnitude::new(fraction.abs(), i64::from(exponent))
}

/// `|x|` rounded down.
fn least(x: &Float) -> Magnitude {
    let (fraction, exponent) = x.to_f64_exp_round(Round::Zero);
    Magnitude::new(fraction.abs(), i64::from(exponent))
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
        let (low, high) = (float_of(x.inf()), float_of(x.sup()));
        // M1: any centre; the radius is measured from it
        let middle: Float = Float::with_val(low.prec().max(high.prec()) + 1, &low + &high) / 2u32;
        let mid = Float::with_val(bits, &middle);
        // Differences of two numbers, rounded away from 0.
        let distance = |end: &Float| magnitude(&Float::with_val_round(64, end - &mid, Round::AwayZero).0);
        let (below, above) = (distance(&low), distance(&high));
        let rad = if below < above { above } else { below };
        Self { mid, rad }
    }

    /// The number that the double `x` is, exactly, with N bits.
    pub fn from_f64_bits(x: f64, bits: u32) -> Self {
        Self::exact(Float::with_val(bits.max(f64::MANTISSA_DIGITS), x)) // M1: bits enough for a double
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
        self.mid.prec()
    }

    /// An upper bound of the absolute values inside.
    #[inline]
    pub fn mag(&self) -> Magnitude {
        magnitude(&self.mid) + self.rad
    }

    /// A lower bound of the absolute values inside; `None` when 0 may be one.
    pub fn mig(&self) -> Option<Magnitude> {
        least(&self.mid).less(self.rad)
    }

    /// Its sign, if that is certain.
    pub fn sign(&self) -> Option<Ordering> {
        // Far from 0, as mostly, the exponents tell.
        let is_far = || self.mid.get_exp().zip(self.rad.exponent()).is_some_and(|(top, rad)| rad < i64::from(top) - 1);
        if self.rad.is_zero() || is_far() {
            return self.mid.cmp0();
        }
        self.mig().and_then(|_| self.mid.cmp0())
    }

    /// Returns whether all of `other` lies inside.
    pub fn contains(&self, other: &Self) -> bool {
        let bits = self.bits().max(other.bits()) + 2; // M1: any number of bits
        let (distance, _) = Float::with_val_round(bits, &self.mid - &other.mid, Round::AwayZero);
        magnitude(&distance) + other.rad <= self.rad
    }

    /// The same centre with a radius larger by `by`.
    pub fn widened(self, by: Magnitude) -> Self {
        Self { rad: self.rad + by, mid: self.mid }
    }

    /// The centre rounded to `bits` bits, the radius larger by the rounding.
    pub fn rounded(&self, bits: u32) -> Self {
        let (mid, error) = rounding(Float::with_val_round(bits, &self.mid, Round::Nearest));
        Self { mid, rad: self.rad + error }
    }

    /// Encloses it in a double-precision ball.
    pub fn to_ball(&self) -> Ball {
        let mid = self.mid.to_f64();
        let (distance, _) = Float::with_val_round(53, &self.mid - mid, Round::AwayZero);
        let rounding = magnitude(&distance).to_f64();
        Ball::new(mid, up(self.rad.to_f64() + rounding))
    }

    /// Encloses a double-precision ball; a ball that is not finite has no bound.
    pub fn from_ball(x: Ball) -> Self {
        let mid = if x.mid().is_finite() { x.mid() } else { 0.0 };
        let rad = if x.mid().is_finite() { x.rad() } else { f64::INFINITY };
        Self { mid: Float::with_val(f64::MANTISSA_DIGITS, mid), rad: Magnitude::new(rad, 0) }
    }

    /// The ball as an interval; `None` when it has no bound.
    pub fn enclosure(&self) -> Option<Enclosure> {
        self.enclosure_in(u32::MAX)
    }

    /// The same, its ends rounded outward to N bits at most.
    pub(crate) fn enclosure_in(&self, bits: u32) -> Option<Enclosure> {
        let rad = float_of_magnitude(self.rad)?;
        // Enough bits for all between the top of one and the bottom of the other.
        let exponents = self.mid.get_exp().zip(rad.get_exp());
        let spread = exponents.map_or(0, |(top, bottom)| top.abs_diff(bottom));
        let bits = bits.min(self.bits().max(spread.min(MOST_SPREAD)) + 64); // X1: any number of bits encloses
        let end = |(end, _): (Float, Ordering)| dyadic_of(&end);
        let low = end(Float::with_val_round(bits, &self.mid - &rad, Round::Down));
        Enclosure::new(low, end(Float::with_val_round(bits, &self.mid + &rad, Round::Up)))
    }

    /// Encloses `(sin 2 pi u, cos 2 pi u)` for all `u` in the ball; at quarter periods they are exact.
    pub fn sin_cos(&self) -> (Self, Self) {
        if let Some(quarter) = self.quarter() {
            let at = |shift: i32| [0.0, 1.0, 0.0, -1.0][(quarter + shift).rem_euclid(4) as usize]; // exact: 0 to 3
            return (Self::from_f64(at(0)), Self::from_f64(at(1)));
        }
        if let Some(found) = sine::sin_cos(&self.mid, self.bits()) {
            // Their slopes are at most 2 pi.
            let turned = Magnitude::new(ABOVE_TWO_PI, 0) * self.rad;
            return found.map(|(mid, error)| Self { mid, rad: turned + error }).into();
        }
        let angle = self.turn().times(self);
        let bits = self.bits();
        let (mut sin, mut cos) = (Float::new(bits), Float::new(bits));
        (&mut sin, &mut cos).assign(angle.mid.sin_cos_ref());
        // Both are 1 at most: half a unit in the last place is at most 2^-p. Their slopes are at most 1.
        let rad = angle.rad + Magnitude::power_of_two(-i64::from(bits));
        (Self { mid: sin, rad }, Self { mid: cos, rad })
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

    /// Encloses `acos(q) / (2 pi)` for all `q` in the ball that lie in `[-1, 1]`.
    pub fn acos(&self) -> Self {
        let bits = self.bits();
        let Some(rad) = float_of_magnitude(self.rad) else {
            return Self { mid: Float::new(bits), rad: Magnitude::INFINITE };
        };
        // acos falls: each end bounds the other side.
        let end = |x: Float, round: Round| {
            let inside = x.clamp(&-1, &1); // M1: cut with [-1, 1]
            Float::with_val_round(bits, inside.acos_ref(), round).0
        };
        let low = end(Float::with_val_round(bits, &self.mid + &rad, Round::Up).0, Round::Down);
        let high = end(Float::with_val_round(bits, &self.mid - &rad, Round::Down).0, Round::Up);
        let mid = Float::with_val(bits, &low + &high) / 2u32;
        let distance = |end: &Float| magnitude(&Float::with_val_round(64, end - &mid, Round::AwayZero).0);
        let rad = distance(&low) + distance(&high);
        let angle = Self { mid, rad };
        let turn = angle.turn();
        angle.checked_div(turn).expect("a forcing period is not 0")
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

    /// The same in N bits that a few times `error` is added to the radii.
    pub(crate) fn departure_within(&self, error: Magnitude) -> Option<SmallAngle<Self>> {
        if self.mag() > Magnitude::power_of_two(-6) {
            return None;
        }
        // A number of that size is worth N bits.
        let worth = |size: Magnitude| {
            let bits = (size.log2() - error.log2()).max(0.0) + 3.0; // M1: any number of bits
            (bits as u32).clamp(LEAST_BITS, self.bits().max(LEAST_BITS)) // M1: any number of bits
        };
        let bits = worth(Magnitude::new(ABOVE_TWO_PI, 0) * self.mag());
        let turn = Self { mid: Float::new(bits), rad: Magnitude::ZERO }.turn();
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
        Self::new(Float::new(self.bits()), self.rad)
    }
    fn with_radius(&self, radius: f64) -> Self {
        Self::new(self.mid.clone(), Magnitude::new(radius, 0))
    }
    fn is_interior_to(&self, outer: &Self) -> bool {
        let bits = self.bits().max(outer.bits()); // M1: any number of bits
        let (distance, _) = Float::with_val_round(bits, &self.mid - &outer.mid, Round::AwayZero);
        magnitude(&distance) + self.rad < outer.rad
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
    let Some(exponent) = x.exponent() else { return Some(Float::new(f64::MANTISSA_DIGITS)) };
    let shift = i32::try_from(exponent).ok().filter(|_| x.is_finite())?;
    Some(Float::with_val(f64::MANTISSA_DIGITS, x.in_units_of(exponent)) << shift)
}

/// A dyadic number as a float, exactly.
fn float_of(x: &Dyadic) -> Float {
    let (sign, digits) = x.mantissa().to_u64_digits();
    let magnitude = Integer::from_digits(&digits, Order::Lsf);
    let mantissa = if sign == Sign::Minus { -magnitude } else { magnitude };
    let shift = i32::try_from(x.exponent()).expect("exponents of exact numbers are far smaller");
    Float::with_val(mantissa.significant_bits().max(1), mantissa) << shift // exact: 0 takes a bit
}

/// A float as a dyadic number, exactly.
fn dyadic_of(x: &Float) -> Dyadic {
    let Some((mantissa, exponent)) = x.to_integer_exp() else { return Dyadic::zero() };
    let sign = if mantissa.cmp0() == Ordering::Less { Sign::Minus } else { Sign::Plus };
    let digits = mantissa.to_digits::<u64>(Order::Lsf);
    let halves = digits.into_iter().flat_map(|digit| [digit as u32, (digit >> 32) as u32]); // exact: the halves
    Dyadic::new(BigInt::new(sign, halves.collect()), i64::from(exponent))
}

#[cfg(test)]
mod tests;
