//! The field's own interval type, [`inari::Interval`], as an arithmetic of this crate.
//!
//! It rounds outward by switching the rounding mode: as tight as doubles are, at the price of two switches an
//! operation. It is built here without its sine, which needs C: ours is the kernel's, at the ends and the extrema
//! between. An interval here is never empty: all operations on such give such, and only what holds a common number is
//! intersected.
//!
//! **Lemma I1** (waves). The sine and the cosine of `2 pi u` take their extrema over `[a, b]` at `a`, at `b` and at the
//! quarter turns between. Of these four in a row give all extrema there are. *Proof.* Between neighbouring quarter
//! turns both are monotone, and at the quarters they are -1, 0 and 1, with period 4. In the kernel's domain `4a` and
//! `4b` are exact, so quarters are told from their neighbours; K1 bounds the values at the ends, and is exact at
//! quarters. []
//!
//! **Lemma I2** (departures). `1 - cos 2 pi h`, `2 pi h - sin 2 pi h` and `sin 2 pi h` are 0 at 0 and rise up to an eighth
//! of a turn, so they lie between their values at the ends, which K2 bounds. []

use std::cmp::Ordering;

use inari::{Interval, const_interval};

use super::kernel::{self, DEPARTURE_ERROR, Departure, SIN_COS_ERROR};
use super::{Ball, Enclosing, Number, SHORT, Wave};
use crate::exact::Enclosure;

/// Where sines and cosines lie.
const RANGE: Interval = const_interval!(-1.0, 1.0);
/// What a field of a departure is multiplied by to hold the truth: `1/(1 - x) <= 1 + 2 x` (Lemma K2).
const RELATIVE: Interval = const_interval!(1.0 - 2.0 * DEPARTURE_ERROR, 1.0 + 2.0 * DEPARTURE_ERROR);

/// The interval between two doubles, exactly; all numbers where they are none.
pub(crate) fn between(inf: f64, sup: f64) -> Interval {
    Interval::try_from((inf, sup)).unwrap_or(Interval::ENTIRE) // I1: nothing is known
}

/// All numbers within `error` of `x`.
fn around(x: f64, error: f64) -> Interval {
    between(x, x) + between(-error, error)
}

/// Sine and cosine at one phase of the kernel's domain (Lemma I1).
fn wave_at(u: f64) -> (Interval, Interval) {
    let (sin, cos) = kernel::sin_cos(u);
    let is_quarter = 4.0 * u == (4.0 * u).round(); // I1: exact
    let error = if is_quarter { 0.0 } else { SIN_COS_ERROR };
    (around(sin, error).intersection(RANGE), around(cos, error).intersection(RANGE))
}

/// The least interval of doubles that holds an enclosure.
pub fn enclosing(enclosure: &Enclosure) -> Interval {
    let (inf, sup) = enclosure.to_f64_bounds();
    between(inf, sup)
}

/// The interval as an enclosure, exactly; `None` when it is empty or has no end.
pub fn enclosure(interval: Interval) -> Option<Enclosure> {
    Enclosure::from_f64_bounds(interval.inf(), interval.sup())
}

/// An interval that no ball of doubles can hold: it is empty, or has no end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the interval is empty or has no end")]
pub struct Unbounded;

/// Holds the ball; one that is not finite is all numbers.
impl From<Ball> for Interval {
    fn from(ball: Ball) -> Self {
        around(ball.mid(), ball.rad())
    }
}

/// The least ball around the interval's middle that holds it.
impl TryFrom<Interval> for Ball {
    type Error = Unbounded;

    fn try_from(interval: Interval) -> Result<Self, Unbounded> {
        if interval.is_common_interval() { Ok(interval.as_ball()) } else { Err(Unbounded) }
    }
}

impl Number for Interval {
    fn from_f64(x: f64) -> Self {
        between(x, x)
    }
    fn mul_add(self, b: Self, c: Self) -> Self {
        // The inherent one: rounded once at each end.
        self.mul_add(b, c)
    }
    fn checked_div(self, b: Self) -> Option<Self> {
        (!b.contains(0.0)).then(|| self / b)
    }
    fn turn(&self) -> Self {
        Self::TAU
    }
    fn signed(self, sign: f64) -> Self {
        if sign < 0.0 { -self } else { self }
    }
}

impl Wave for Interval {
    /// Lemma I1.
    fn wave(&self) -> (Self, Self) {
        // Lemma K1; a NaN is refused as well.
        if self.mag().partial_cmp(&kernel::LARGEST_PHASE) != Some(Ordering::Less) {
            return (RANGE, RANGE);
        }
        let first = (4.0 * self.inf()).ceil(); // I1: exact
        let quarters = [0.0, 1.0, 2.0, 3.0].map(|k| (first + k) / 4.0);
        let inside = quarters.into_iter().take_while(|&u| u < self.sup());
        let hull = |x: (Self, Self), y: (Self, Self)| (x.0.convex_hull(y.0), x.1.convex_hull(y.1));
        inside.chain([self.sup()]).map(wave_at).fold(wave_at(self.inf()), hull)
    }
    /// Lemma I2.
    fn short(&self) -> Option<Departure<Self>> {
        let (inf, sup) = (self.inf(), self.sup());
        // exact: a departure of no time
        if !(inf >= 0.0 && (sup == 0.0 || SHORT.contains(&sup))) {
            return None;
        }
        // I2: at least 0, where the kernel claims nothing
        let low = kernel::departure(if SHORT.contains(&inf) { inf } else { 0.0 });
        let high = kernel::departure(sup);
        let hull = |low: f64, high: f64| RELATIVE * between(low, low).convex_hull(between(high, high));
        Some(Departure {
            versine: hull(low.versine, high.versine),
            excess: hull(low.excess, high.excess),
            sine: hull(low.sine, high.sine),
        })
    }
}

impl Enclosing for Interval {
    fn centre(&self) -> Self {
        between(self.mid(), self.mid())
    }
    fn spread(&self) -> Self {
        *self - self.centre()
    }
    fn with_radius(&self, radius: f64) -> Self {
        around(self.mid(), radius)
    }
    fn is_interior_to(&self, outer: &Self) -> bool {
        self.interior(*outer)
    }
    fn log2_radius(&self) -> f64 {
        self.rad().log2()
    }
    fn certain_sign(&self) -> Option<Ordering> {
        let ends = [self.inf(), self.sup()].map(|end| end.partial_cmp(&0.0));
        ends[0].filter(|_| ends[0] == ends[1])
    }
    fn as_ball(&self) -> Ball {
        Ball::new(self.mid(), self.rad())
    }
    fn as_enclosure(&self) -> Option<Enclosure> {
        enclosure(*self)
    }
}
