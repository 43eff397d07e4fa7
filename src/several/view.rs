//! Double-precision bounds of a state, and a time for which it is proved to stay off the walls.

use super::flight::Kinematics;
use super::harmonics::Rates;
use super::phased::FlightNumber;
use crate::number::{TINY, UNIT, up};
use crate::pair::Wall;

/// Newton steps to the root of a cubic: a guess of three digits is enough, and four steps give it.
const STEPS: u32 = 4;

/// Bounds of a state, measured from one wall: the distance from it and its two derivatives.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    pub room: (f64, f64),
    pub rate: (f64, f64),
    pub bend: (f64, f64),
}

impl<N: FlightNumber> Kinematics<N> {
    /// The distance from a wall, in the arithmetic of the flight.
    pub fn room(&self, wall: Wall) -> &N {
        match wall {
            Wall::Left => &self.left,
            Wall::Right => &self.right,
        }
    }

    /// The state as seen from a wall.
    #[inline]
    pub fn side(&self, wall: Wall) -> Side {
        let inward = |(low, high): (f64, f64)| match wall {
            Wall::Left => (low, high),
            Wall::Right => (-high, -low),
        };
        let (rate, bend) = (inward(self.velocity.bounds()), inward(self.acceleration.bounds()));
        Side { room: self.room(wall).bounds(), rate, bend }
    }
}

/// `r + v s + a s^2/2 - S s^3/6` from below, for the lower bounds of a side: Lemma H2 of `docs/proofs/harmonics.md#H2`.
#[derive(Clone, Copy, Debug)]
struct Cubic {
    room: f64,
    rate: f64,
    bend: f64,
    third: f64,
}

impl Cubic {
    /// Value of the cubic, to nearest.
    #[inline]
    fn value(&self, s: f64) -> f64 {
        ((-self.third * s * (1.0 / 6.0) + 0.5 * self.bend) * s + self.rate) * s + self.room
    }

    /// Slope of the cubic, to nearest.
    #[inline]
    fn slope(&self, s: f64) -> f64 {
        (-0.5 * self.third * s + self.bend) * s + self.rate
    }

    /// A lower bound of the cubic's value.
    #[inline]
    fn least(&self, s: f64) -> f64 {
        let size = self.room.abs() + s * (self.rate.abs() + s * (self.bend.abs() + s * self.third));
        self.value(s) - 16.0 * UNIT * size
    }

    /// Argument of the minimum, about; `None` without a minimum.
    #[inline]
    fn valley(&self) -> Option<f64> {
        if !(self.rate < 0.0 && self.bend > 0.0) {
            return None;
        }
        let discriminant = self.bend.mul_add(self.bend, 2.0 * self.third * self.rate);
        (discriminant >= 0.0).then(|| -2.0 * self.rate / (self.bend + discriminant.sqrt()))
    }

    /// Whether the cubic is positive on all of `[0, s]` (Lemma H2).
    fn is_positive(&self, s: f64) -> bool {
        if !(self.room > 0.0 && self.least(s) > 0.0) {
            return false;
        }
        // With `bend <= 0` or `rate >= 0` the least value is at an end.
        if self.rate >= 0.0 || self.bend <= 0.0 {
            return true;
        }
        // Convex up to here and concave beyond: the slope is greatest here.
        let inflection = up(self.bend / self.third);
        if self.falls_to(inflection) || (s <= inflection && self.falls_to(s)) {
            return true;
        }
        // A tangent bounds the convex part.
        let Some(valley) = self.valley() else { return false };
        let valley = valley.min(inflection); // H2: any point of the convex part
        let slope = self.slope(valley).abs() + self.slack(valley);
        self.least(valley) - up(slope * inflection) > 0.0
    }

    /// Whether the cubic falls at `s`, and so at all times before if it is convex there.
    fn falls_to(&self, s: f64) -> bool {
        self.slope(s) + self.slack(s) < 0.0
    }

    /// Bounds the rounding errors of the slope.
    fn slack(&self, s: f64) -> f64 {
        16.0 * UNIT * (self.rate.abs() + s * (self.bend.abs() + s * self.third))
    }

    /// Time up to which the cubic stays positive, about, and at most `most`.
    fn reach(&self, most: f64) -> f64 {
        if let Some(valley) = self.valley()
            && valley < most
            && self.value(valley) <= 0.0
        {
            // From the left of the first root of a convex fall Newton stays left.
            let mut s = 0.0;
            for _ in 0..STEPS {
                s -= self.value(s) / self.slope(s);
            }
            return s.min(valley); // proposes: is_free decides
        }
        let mut s = most;
        for _ in 0..STEPS {
            let (value, slope) = (self.value(s), self.slope(s));
            if value > 0.0 || slope >= 0.0 {
                break;
            }
            s -= value / slope;
        }
        // Newton may fall short across an inflection; then the ball goes toward the wall.
        0.98 * if s > 0.0 { s } else { -self.room / self.rate }
    }
}

impl Side {
    fn cubic(&self, rates: &Rates) -> Cubic {
        Cubic { room: self.room.0, rate: self.rate.0, bend: self.bend.0, third: rates.third }
    }

    /// Whether the wall is not touched for `time` forcing periods (Lemma H2).
    #[inline]
    pub fn is_free(&self, rates: &Rates, time: f64) -> bool {
        self.cubic(rates).is_positive(time)
    }

    /// Time up to which [`is_free`](Self::is_free) may be provable, at most `most`.
    #[inline]
    pub fn reach(&self, rates: &Rates, most: f64) -> f64 {
        self.cubic(rates).reach(most)
    }

    /// Whether the ball goes toward the wall for `time` forcing periods: `z'`, measured inward, is at most `v + a s + S s^2/2`.
    #[inline]
    pub fn approaches(&self, rates: &Rates, time: f64) -> bool {
        // Convex in `s`: greatest at an end.
        let end = (0.5 * rates.third * time + self.bend.1) * time + self.rate.1;
        let size = self.rate.1.abs() + time * (self.bend.1.abs() + time * rates.third);
        self.rate.1 < 0.0 && end + 16.0 * UNIT * size < 0.0
    }

    /// A lower bound of the bend, measured inward, less than `time` forcing periods away.
    #[inline]
    pub fn least_bend(&self, rates: &Rates, time: f64) -> f64 {
        (self.bend.0 - up(rates.third * time)).next_down()
    }

    /// Whether the wall is not touched while the motion bends away from it by at least `bend`: the ball comes nearer to it by at most
    /// `z'^2/(2 bend)`, and twice as much room is asked for (Lemma H4).
    #[inline]
    pub fn stays_clear(&self, bend: f64) -> bool {
        let rate = self.rate.0.abs().max(self.rate.1.abs()); // B2: the farther end
        // Lemma B1: the square may underflow.
        self.room.0 - up(up(rate * rate + TINY) / bend) > 0.0
    }

    /// About when the wall is reached if the bend stays as it is.
    #[inline]
    pub fn arrival(&self) -> Option<f64> {
        let middle = |(low, high): (f64, f64)| 0.5 * (low + high);
        let (room, rate, bend) = (middle(self.room), middle(self.rate), middle(self.bend));
        let discriminant = rate.mul_add(rate, -2.0 * bend * room);
        (discriminant >= 0.0 && room > 0.0).then(|| 2.0 * room / (discriminant.sqrt() - rate)).filter(|s| *s > 0.0)
    }

    /// About when the approach ends if the bend stays as it is.
    #[inline]
    pub fn turning(&self) -> Option<f64> {
        let middle = |(low, high): (f64, f64)| 0.5 * (low + high);
        let (rate, bend) = (middle(self.rate), middle(self.bend));
        (rate < 0.0 && bend > 0.0).then(|| -rate / bend)
    }
}

#[cfg(test)]
mod tests {
    use num_rational::BigRational;
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// Lemma H4, in exact fractions: the lowest place of a parabola, from the end of the bounds that is nearest to the wall.
        #[test]
        fn a_side_that_stays_clear_has_room_at_its_lowest_place(
            rate in prop_oneof![Just(0.0), (-160.0..1.0f64).prop_map(|x| 10f64.powf(x))], bend in (-2.0..2.0f64).prop_map(|x| 10f64.powf(x)),
            part in prop_oneof![Just(0.5), 0.4..2.5f64], width in prop_oneof![Just(0.0), 0.0..3.0f64], is_left: bool,
        ) {
            let least = part * rate * rate / bend;
            let rate = if is_left { (-rate, 0.5 * rate) } else { (-0.5 * rate, rate) };
            let side = Side { room: (least, least * (1.0 + width)), rate, bend: (bend, bend) };
            let exact = |x: f64| BigRational::from_float(x).unwrap();
            let fall = |rate: f64| exact(rate) * exact(rate) / (exact(bend) * exact(2.0));
            let [low, high] = [rate.0, rate.1].map(|rate| exact(least) - fall(rate));
            prop_assert!(!side.stays_clear(bend) || low > exact(0.0) && high > exact(0.0), "{side:?}");
            // And where there is twice the room that it takes, it is proved.
            prop_assert!(side.stays_clear(bend) || part < 1.01 || least < 1e-290, "{side:?}");
        }

        /// Lemma H2, at many points of many cubics, biased to those that come near 0 in between.
        #[test]
        fn a_proved_positive_value_is_positive(
            place in 0.05..1.0f64, depth in -1e-3..1e-2f64, bend in -30.0..60.0f64, third in 1.0..200.0f64, end in 0.01..1.5f64,
        ) {
            // A valley near `place`, so deep, where the bend allows one.
            let rate = -bend * place + 0.5 * third * place * place;
            let room = depth - (rate + (0.5 * bend - third * place / 6.0) * place) * place;
            let cubic = Cubic { room, rate, bend, third };
            let exact = |s: f64| room + (rate + (0.5 * bend - third * s / 6.0) * s) * s;
            let least = (0..=2000).map(|i| exact(end * f64::from(i) / 2000.0)).fold(f64::INFINITY, f64::min);
            prop_assert!(!cubic.is_positive(end) || least > -1e-13, "{cubic:?} to {end}: {least}");
            // And what is clearly positive is proved, so that pieces are as long as they can be.
            prop_assert!(cubic.is_positive(end) || least < 1e-9, "{cubic:?} to {end}: {least}");
            let reach = cubic.reach(end);
            prop_assert!(reach <= end && (room <= 1e-3 || reach > 0.0), "{cubic:?}: {reach}");
        }
    }
}
