//! Places where a flight is cut for the proof: at 3/4 of the way from each end to the nearest zero of `y'`. No cut is trusted: a bad
//! place costs time, or the proof.

use crate::check::Flight;
use impact_pair_exact::{Dyadic, Real};

/// Bits that suffice to decide signs, beyond the bits that a short flight loses.
const BITS: u32 = 96;
/// A zero of `y'` closer than this to an end of the flight, relative to its length, belongs to a departure or arrival without velocity.
const END_DISTANCE: f64 = 1e-9;
/// Accuracy of a zero, relative to the length of the flight.
const ZERO_ACCURACY: f64 = 1e-10;
/// Greatest number of parts of a flight that are examined for one cut.
const MAX_PARTS: usize = 1 << 14;
/// Length of a flight \[rad\] below which an extremum is as near the wall as the ends.
const SHORT_FLIGHT: f64 = 1e-3;
/// Length of a flight, in forcing periods of the reference harmonic, above which its extrema near a wall are not sought.
const LONG_FLIGHT_PERIODS: f64 = 2.0;

/// A flight of length `h`, to be cut.
pub(super) struct Cuts<'w> {
    flight: Flight<'w>,
    h: f64,
}

/// The end from which zeros are sought.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Order {
    First,
    Last,
}

impl<'w> Cuts<'w> {
    pub fn new(flight: &Flight<'w>, h: f64) -> Self {
        let lost = (3.0 * (-h.log2()).max(0.0)).ceil() as u32;
        Self { flight: flight.rounded(flight.bits().min(BITS.saturating_add(lost))), h }
    }

    /// The end of the departure and the end of the middle part, relative to the length; 1/2 if `y'` has no zero. A flight from rest has
    /// departed while `y''` keeps its sign.
    pub fn places(&self, is_from_rest: bool) -> [f64; 2] {
        let mut depart = self.extrema(Order::First, 1).first().map_or(0.5, |first| 0.75 * first / self.h);
        let approach = self.extrema(Order::Last, 1).first().map_or(0.5, |last| 1.0 - 0.75 * (1.0 - last / self.h));
        if is_from_rest {
            let bends = |x: &Real| self.flight.curvature(x);
            let bends = zeros(bends, |x| self.flight.shaking.jerk(x), self.within(), Order::First, 1);
            depart = bends.first().map_or(depart, |bend| depart.min(0.75 * bend / self.h));
        }
        [depart, approach.max(depart)]
    }

    /// Additional bits for extrema near a wall.
    pub fn nearness(&self) -> u32 {
        if self.h < SHORT_FLIGHT {
            return 0;
        }
        // The flight is too long to examine.
        if self.h > LONG_FLIGHT_PERIODS * std::f64::consts::TAU {
            return u32::MAX / 4;
        }
        let (half_gap, amplitude) = (self.flight.half_gap.to_f64(), self.flight.shaking.waves[0].amplitude.to_f64());
        let miss =
            |h: f64| ((half_gap - self.flight.height(&point(h, self.flight.bits())).to_f64().abs()) / amplitude).abs();
        let nearest = self.extrema(Order::First, usize::MAX).into_iter().map(miss).fold(1.0, f64::min);
        if nearest < 1e-9 { u32::MAX / 4 } else { (-2.0 * nearest.log2()).ceil() as u32 }
    }

    /// Zeros of `y'` strictly inside the flight.
    fn extrema(&self, order: Order, most: usize) -> Vec<f64> {
        zeros(|x| self.flight.slope(x), |x| self.flight.curvature(x), self.within(), order, most)
    }

    fn within(&self) -> (f64, u32) {
        (self.h, self.flight.bits())
    }
}

/// At most `most` zeros in `(0, h)` of a function with the derivative `slope`, in order. Parts without a zero are left out,
/// monotone parts have at most one zero, other parts are halved.
fn zeros(
    f: impl Fn(&Real) -> Real,
    slope: impl Fn(&Real) -> Real,
    (h, bits): (f64, u32),
    order: Order,
    most: usize,
) -> Vec<f64> {
    let narrow = ZERO_ACCURACY * h;
    let mut zeros = Vec::new();
    let mut parts = vec![(END_DISTANCE * h, (1.0 - END_DISTANCE) * h)];
    for _ in 0..MAX_PARTS {
        let Some((a, b)) = parts.pop().filter(|_| zeros.len() < most) else { break };
        let part = point(a, bits).hull(&point(b, bits));
        if !f(&part).is_across() {
            continue;
        }
        let middle = a + (b - a) / 2.0;
        if b - a < narrow {
            zeros.push(middle);
            continue;
        }
        if !slope(&part).is_across() {
            let sign = |x: f64| f(&point(x, bits)).to_f64() > 0.0;
            if sign(a) != sign(b) {
                zeros.push(bisected(sign, a, b, narrow));
            }
            continue;
        }
        match order {
            Order::First => parts.extend([(middle, b), (a, middle)]),
            Order::Last => parts.extend([(a, middle), (middle, b)]),
        }
    }
    zeros
}

fn point(h: f64, bits: u32) -> Real {
    Real::point(Dyadic::from_f64(h).unwrap_or_else(Dyadic::zero), bits)
}

/// Position of a sign change between `a` and `b`.
fn bisected(sign: impl Fn(f64) -> bool, mut a: f64, mut b: f64, narrow: f64) -> f64 {
    let first = sign(a);
    while b - a > narrow {
        let middle = a + (b - a) / 2.0;
        if sign(middle) == first { a = middle } else { b = middle }
    }
    a + (b - a) / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerances::FLOATING_POINT_ZERO;
    use approx::{abs_diff_eq, assert_abs_diff_eq};

    #[test]
    fn zeros_are_found_from_either_end() {
        use std::f64::consts::PI;
        let found = |h, order, most| zeros(Real::sin, Real::cos, (h, BITS), order, most);
        let near = |found: &[f64], places: &[f64]| {
            found.len() == places.len()
                && found.iter().zip(places).all(|(x, place)| abs_diff_eq!(x, place, epsilon = FLOATING_POINT_ZERO))
        };
        assert!(near(&found(10.0, Order::First, usize::MAX), &[PI, 2.0 * PI, 3.0 * PI]));
        assert!(near(&found(10.0, Order::First, 1), &[PI]));
        assert!(near(&found(10.0, Order::Last, 1), &[3.0 * PI]));
        // The zero at the beginning belongs to a departure without velocity.
        assert!(found(3.0, Order::First, 1).is_empty());
    }

    #[test]
    fn double_zeros_are_found() {
        let off = |x: &Real| x.clone() - &point(1.0, BITS);
        let found = zeros(|x| off(x).square(), |x| off(x) + &off(x), (3.0, BITS), Order::First, 1);
        assert_abs_diff_eq!(found[0], 1.0, epsilon = FLOATING_POINT_ZERO);
    }
}
