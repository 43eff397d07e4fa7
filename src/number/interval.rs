//! Intervals between two doubles, for bounds that one asks the ends of: boxes of the searches, rests, several harmonics.
//!
//! Methods are named as in IEEE 1788. The rounding mode is never touched: each end is rounded to nearest and moved outward by
//! one double, which is at least what rounding may have taken. Lemmas I1 and I4 of `docs/proofs/intervals.md#I1`, same labels.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use super::kernel::{self, SIN_COS_ERROR};
use super::{Ball, up};
use crate::exact::Enclosure;

/// All real numbers between two doubles, the infinities among them.
///
/// Never empty: `inf <= sup`, no end is a NaN, `inf` is not positive and `sup` not negative infinity. What is not known to be so
/// is [`Interval::ENTIRE`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interval {
    inf: f64,
    sup: f64,
}

/// The interval between two ends that were rounded to nearest, moved outward (Lemma I4).
#[inline(always)]
fn outward(inf: f64, sup: f64) -> Interval {
    debug_assert!(inf <= sup, "no interval from {inf} to {sup}");
    Interval { inf: inf.next_down(), sup: sup.next_up() }
}

impl Interval {
    /// All real numbers.
    pub const ENTIRE: Self = Self { inf: f64::NEG_INFINITY, sup: f64::INFINITY };
    /// Exactly 0.
    pub const ZERO: Self = Self::point(0.0);
    /// Exactly 1.
    pub const ONE: Self = Self::point(1.0);
    /// Bounds of pi; the double is below it.
    pub const PI: Self = Self { inf: std::f64::consts::PI, sup: std::f64::consts::PI.next_up() };
    /// Bounds of 2 pi: twice those of pi.
    pub const TAU: Self = Self { inf: std::f64::consts::TAU, sup: std::f64::consts::TAU.next_up() };
    /// The range of sines and cosines.
    const RANGE: Self = Self { inf: -1.0, sup: 1.0 };

    /// The interval between two doubles, exactly; all numbers where they bound none.
    #[inline(always)]
    pub const fn new(inf: f64, sup: f64) -> Self {
        // I4: a NaN fails the comparisons
        if inf <= sup && inf < f64::INFINITY && sup > f64::NEG_INFINITY { Self { inf, sup } } else { Self::ENTIRE }
    }

    /// A single double; all numbers where it is not finite.
    #[inline(always)]
    pub const fn point(x: f64) -> Self {
        Self::new(x, x)
    }

    /// All numbers of at most this size.
    #[inline(always)]
    pub const fn within(size: f64) -> Self {
        Self::new(-size, size)
    }

    /// The least interval that holds an enclosure.
    pub fn enclosing(enclosure: &Enclosure) -> Self {
        let (inf, sup) = enclosure.to_f64_bounds();
        Self::new(inf, sup)
    }

    /// The lower end.
    #[inline(always)]
    pub const fn inf(self) -> f64 {
        self.inf
    }

    /// The upper end.
    #[inline(always)]
    pub const fn sup(self) -> f64 {
        self.sup
    }

    /// A finite double inside, about the middle.
    #[inline(always)]
    pub fn mid(self) -> f64 {
        let (inf, sup) = (self.inf.max(f64::MIN), self.sup.min(f64::MAX)); // I4: finite members
        (0.5 * (inf + sup)).clamp(inf, sup) // I4: inside; an overflow is an end
    }

    /// An upper bound of the width, 0 of a point.
    #[inline(always)]
    pub fn wid(self) -> f64 {
        let width = self.sup - self.inf;
        // I4: a difference of doubles is 0 only if they are the same
        if width == 0.0 { 0.0 } else { width.next_up() }
    }

    /// The greatest absolute value.
    #[inline(always)]
    pub fn mag(self) -> f64 {
        self.inf.abs().max(self.sup.abs()) // I4: the farther end
    }

    /// Returns whether both ends are finite.
    #[inline(always)]
    pub fn is_common_interval(self) -> bool {
        self.inf.is_finite() && self.sup.is_finite()
    }

    /// Returns whether `x` is a member.
    #[inline(always)]
    pub fn contains(self, x: f64) -> bool {
        self.inf <= x && x <= self.sup
    }

    /// The sign that all members have; `None` where they have not the same.
    pub fn sign(self) -> Option<Ordering> {
        let [inf, sup] = [self.inf, self.sup].map(|end| end.partial_cmp(&0.0));
        inf.filter(|_| inf == sup)
    }

    /// The members in both; `None` when there is none.
    #[inline(always)]
    pub fn intersection(self, other: Self) -> Option<Self> {
        let both = Self { inf: self.inf.max(other.inf), sup: self.sup.min(other.sup) }; // I4: the inner ends, none a NaN
        (both.inf <= both.sup).then_some(both)
    }

    /// The least interval that holds both.
    #[inline(always)]
    pub fn hull(self, other: Self) -> Self {
        Self { inf: self.inf.min(other.inf), sup: self.sup.max(other.sup) } // I4: the outer ends, none a NaN
    }

    /// The members of at least `low`; all where that is a NaN.
    #[inline(always)]
    pub fn at_least(self, low: f64) -> Option<Self> {
        let part = Self { inf: self.inf.max(low), sup: self.sup }; // I4: the inner end; a NaN cuts nothing
        (part.inf <= part.sup && part.inf < f64::INFINITY).then_some(part)
    }

    /// The members of at most `high`; all where that is a NaN.
    #[inline(always)]
    pub fn at_most(self, high: f64) -> Option<Self> {
        let part = Self { inf: self.inf, sup: self.sup.min(high) }; // I4: the inner end; a NaN cuts nothing
        (part.inf <= part.sup && part.sup > f64::NEG_INFINITY).then_some(part)
    }

    /// The quotients; `None` when 0 may be a divisor, or a quotient has no finite bound.
    #[inline(always)]
    pub fn checked_div(self, divisor: Self) -> Option<Self> {
        if divisor.contains(0.0) {
            return None;
        }
        let ends = [self.inf / divisor.inf, self.inf / divisor.sup, self.sup / divisor.inf, self.sup / divisor.sup];
        let quotient = outward(least(ends), greatest(ends));
        quotient.is_common_interval().then_some(quotient)
    }

    /// `sign * self` for a sign of 1 or -1, exactly.
    #[inline(always)]
    pub fn signed(self, sign: f64) -> Self {
        if sign < 0.0 { -self } else { self }
    }

    /// A double times it.
    #[inline(always)]
    pub fn scaled(self, x: f64) -> Self {
        if !(x.is_finite() && self.is_common_interval()) {
            return self * Self::point(x);
        }
        let (a, b) = (self.inf * x, self.sup * x);
        outward(a.min(b), a.max(b)) // I4: the outer ends, none a NaN
    }

    /// The absolute values.
    pub fn abs(self) -> Self {
        if self.contains(0.0) {
            Self { inf: 0.0, sup: self.mag() }
        } else {
            self.signed(if self.sup < 0.0 { -1.0 } else { 1.0 })
        }
    }

    /// The squares.
    pub fn sqr(self) -> Self {
        let size = self.abs();
        let square = outward(size.inf * size.inf, size.sup * size.sup);
        Self { inf: square.inf.max(0.0), sup: square.sup } // I4: no square is negative
    }

    /// The square roots of the members that have one; `None` when none has.
    pub fn sqrt(self) -> Option<Self> {
        let Self { inf, sup } = self.at_least(0.0)?;
        let root = outward(inf.sqrt(), sup.sqrt());
        Some(Self { inf: root.inf.max(0.0), sup: root.sup }) // I4: no root is negative
    }

    /// `sin 2 pi u` of the members.
    pub fn sin(self) -> Self {
        self.wave(0.25, |u| kernel::sin_cos(u).0)
    }

    /// `cos 2 pi u` of the members.
    pub fn cos(self) -> Self {
        self.wave(0.0, |u| kernel::sin_cos(u).1)
    }

    /// The values of the sine or the cosine, which is greatest whole periods from `peak` and least half a period later (Lemma I1).
    #[inline(always)]
    fn wave(self, peak: f64, at: impl Fn(f64) -> f64) -> Self {
        // Lemma K1: nothing is known beyond
        if !(self.wid() < 1.0 && self.mag() <= kernel::LARGEST_PHASE) {
            return Self::RANGE;
        }
        let (a, b) = (at(self.inf), at(self.sup));
        // I1: the outer ends, and what the kernel is off
        let ends = outward(a.min(b) - SIN_COS_ERROR, a.max(b) + SIN_COS_ERROR);
        let (inf, sup) = (ends.inf.max(-1.0), ends.sup.min(1.0)); // I1: no value is beyond 1
        Self {
            inf: if self.may_hold_whole(peak + 0.5) { -1.0 } else { inf },
            sup: if self.may_hold_whole(peak) { 1.0 } else { sup },
        }
    }

    /// Returns whether a whole number plus `shift` may be a member.
    #[inline(always)]
    fn may_hold_whole(self, shift: f64) -> bool {
        (self.sup - shift).next_up().floor() >= (self.inf - shift).next_down().ceil() // I1: whole ends, outward
    }
}

/// The members of a ball, moved outward; all numbers where it has no ends.
impl From<Ball> for Interval {
    #[inline]
    fn from(ball: Ball) -> Self {
        let (inf, sup) = (ball.mid() - ball.rad(), ball.mid() + ball.rad());
        if inf.is_finite() && sup.is_finite() { Self::new(inf.next_down(), sup.next_up()) } else { Self::ENTIRE }
    }
}

/// A ball around the middle that holds the interval; its radius may be infinite.
impl From<Interval> for Ball {
    fn from(interval: Interval) -> Self {
        let mid = interval.mid();
        Self::new(mid, up((mid - interval.inf).max(interval.sup - mid))) // I4: the farther end
    }
}

/// Returns the least of the quotients or products of ends; a NaN is 0 times an infinity, or a quotient of two, and others bound it.
#[inline(always)]
fn least(x: [f64; 4]) -> f64 {
    x[0].min(x[1]).min(x[2].min(x[3])) // I4: a NaN is passed over
}

#[inline(always)]
fn greatest(x: [f64; 4]) -> f64 {
    x[0].max(x[1]).max(x[2].max(x[3])) // I4: a NaN is passed over
}

impl Add for Interval {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        outward(self.inf + b.inf, self.sup + b.sup)
    }
}

impl Neg for Interval {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { inf: -self.sup, sup: -self.inf }
    }
}

impl Sub for Interval {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        outward(self.inf - b.sup, self.sup - b.inf)
    }
}

impl Mul for Interval {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        let ends = [self.inf * b.inf, self.inf * b.sup, self.sup * b.inf, self.sup * b.sup];
        let inf = least(ends);
        // I4: all are, of 0 and the whole line
        if inf.is_nan() { Self::ENTIRE } else { outward(inf, greatest(ends)) }
    }
}

#[cfg(test)]
mod tests;
