//! The arithmetics in which flights under several harmonics are computed: doubles, balls of doubles, balls of any precision.

use super::ticks::Ticks;
use crate::exact::Exact;
use crate::number::interval::Interval;
use crate::number::{Ball, Wave};

/// A number in which the box under several harmonics is computed.
pub(crate) trait PhaseNumber: Wave + std::fmt::Debug + Send {
    /// The phase of a harmonic as a function of whole forcing periods of the fastest.
    type Counter: Clone + std::fmt::Debug + Send + Sync;
    /// `ratio n + shift`, less whole forcing periods.
    fn phase_at(counter: &Self::Counter, turns: i64) -> Self;
    /// A double near the number, to nearest.
    fn middle(&self) -> f64;
}

/// A number in which flights under several harmonics are computed.
pub(crate) trait FlightNumber: PhaseNumber {
    /// The counter of phases `ratio n + shift`.
    fn counter(ratio: &Exact, shift: &Exact, bits: u32) -> Self::Counter;
    /// Encloses an exact number; a double takes the nearest.
    fn enclose(x: &Exact, bits: u32) -> Self;
    /// A lower and an upper bound.
    fn bounds(&self) -> (f64, f64);
    /// Bounds of the number as an interval.
    fn interval(&self) -> Interval {
        let (inf, sup) = self.bounds();
        Interval::new(inf, sup)
    }
    /// Whether the number is exactly 0.
    fn is_zero(&self) -> bool {
        self.bounds() == (0.0, 0.0)
    }
    /// The centre, exactly.
    fn centre_of(&self) -> Self;
    /// An exact number near `self + step`, both exact.
    fn later(&self, step: &Self) -> Self;
    /// An exact number near `self / divisor`, of the centres; `None` where that has no size.
    fn ratio_to(&self, divisor: &Self) -> Option<Self>;
    /// An exact number near the square root of the centre, which is not negative.
    fn root_of(&self) -> Self;
    /// Exactly `x`, as fine as `self`.
    fn like(&self, x: f64) -> Self;
    /// Pieces of one flight that are looked at, as fine as `self`.
    fn pieces(&self) -> u32 {
        1 << 20
    }
}

impl PhaseNumber for f64 {
    type Counter = Ticks;

    #[inline]
    fn phase_at(counter: &Ticks, turns: i64) -> f64 {
        counter.phase(turns)
    }
    #[inline]
    fn middle(&self) -> f64 {
        *self
    }
}

impl FlightNumber for f64 {
    fn counter(ratio: &Exact, shift: &Exact, _: u32) -> Ticks {
        Ticks::new(ratio, shift)
    }
    fn enclose(x: &Exact, _: u32) -> f64 {
        x.enclose(64).mid_rad().0
    }
    #[inline]
    fn bounds(&self) -> (f64, f64) {
        (*self, *self)
    }
    #[inline]
    fn centre_of(&self) -> f64 {
        *self
    }
    #[inline]
    fn later(&self, step: &f64) -> f64 {
        self + step
    }
    #[inline]
    fn ratio_to(&self, divisor: &f64) -> Option<f64> {
        let ratio = self / divisor;
        ratio.is_finite().then_some(ratio)
    }
    #[inline]
    fn root_of(&self) -> f64 {
        self.sqrt()
    }
    #[inline]
    fn like(&self, x: f64) -> f64 {
        x
    }
}

impl PhaseNumber for Ball {
    type Counter = Ticks;

    #[inline]
    fn phase_at(counter: &Ticks, turns: i64) -> Ball {
        Ball::new(counter.phase(turns), counter.error(turns))
    }
    #[inline]
    fn middle(&self) -> f64 {
        middle(self)
    }
}

impl FlightNumber for Ball {
    fn counter(ratio: &Exact, shift: &Exact, _: u32) -> Ticks {
        Ticks::new(ratio, shift)
    }
    fn enclose(x: &Exact, _: u32) -> Ball {
        Ball::of(x)
    }
    #[inline]
    fn bounds(&self) -> (f64, f64) {
        // B2: a point
        if self.rad() == 0.0 {
            return (self.mid(), self.mid());
        }
        ((self.mid() - self.rad()).next_down(), (self.mid() + self.rad()).next_up())
    }
    #[inline]
    fn centre_of(&self) -> Ball {
        Ball::exact(self.mid())
    }
    #[inline]
    fn later(&self, step: &Ball) -> Ball {
        Ball::exact(self.mid() + step.mid())
    }
    #[inline]
    fn ratio_to(&self, divisor: &Ball) -> Option<Ball> {
        self.mid().ratio_to(&divisor.mid()).map(Ball::exact)
    }
    #[inline]
    fn root_of(&self) -> Ball {
        Ball::exact(self.mid().sqrt())
    }
    #[inline]
    fn like(&self, x: f64) -> Ball {
        Ball::exact(x)
    }
}

/// Half way between the bounds, to nearest.
pub(super) fn middle<N: FlightNumber>(x: &N) -> f64 {
    let (low, high) = x.bounds();
    0.5 * (low + high)
}

/// An upper bound of the absolute values.
pub(super) fn magnitude<N: FlightNumber>(x: &N) -> f64 {
    let (low, high) = x.bounds();
    low.abs().max(high.abs()) // B2: the farther end; next to a NaN is infinity
}
