//! Intervals between two doubles, for boxes that are wide: cutting them asks for ends, not for centres.
//!
//! The rounding mode is never touched: each end is moved out by one unit in the last place, which is at least what
//! rounding to nearest may have taken. inari's intervals, the reference for these in the tests, switch the rounding mode: with our
//! sine a search takes 3.4 times the processor time in them (`LRLRLLRLRR` in 5 cycles of `scenes/cascade.toml`), and all that
//! `periodic --all` does for four impacts of figures 12-15 1.3 to 1.8 times.

use std::ops::{Add, Mul, Neg, Sub};

use crate::number::kernel::{self, ACOS_ERROR, SIN_COS_ERROR};
use crate::number::{Ball, up};

/// All real numbers between two finite doubles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interval {
    pub lo: f64,
    pub hi: f64,
}

/// Bounds of pi.
const PI: Interval = Interval { lo: std::f64::consts::PI, hi: std::f64::consts::PI.next_up() };

/// The interval between two rounded ends, moved out.
#[inline(always)]
fn outward(lo: f64, hi: f64) -> Interval {
    Interval { lo: lo.next_down(), hi: hi.next_up() }
}

impl Interval {
    /// Returns the interval between two doubles, exactly.
    #[inline(always)]
    pub const fn new(lo: f64, hi: f64) -> Self {
        Self { lo, hi }
    }

    /// Returns a single double.
    #[inline(always)]
    pub const fn point(x: f64) -> Self {
        Self { lo: x, hi: x }
    }

    /// Returns the members of a ball.
    pub fn of(ball: Ball) -> Self {
        outward(ball.mid() - ball.rad(), ball.mid() + ball.rad())
    }

    /// Returns a ball that holds the interval.
    pub fn ball(self) -> Ball {
        let mid = self.middle();
        Ball::new(mid, up((mid - self.lo).max(self.hi - mid))) // T9: the farther end
    }

    /// Returns a double inside, about the middle.
    #[inline(always)]
    pub fn middle(self) -> f64 {
        (0.5 * (self.lo + self.hi)).clamp(self.lo, self.hi) // T9: inside
    }

    /// `hi - lo`, to nearest: it decides nothing.
    #[inline(always)]
    pub fn wid(self) -> f64 {
        self.hi - self.lo
    }

    /// Returns the members in both; `None` when there is none.
    #[inline(always)]
    pub fn cut(self, other: Self) -> Option<Self> {
        // T9: the inner ends; a NaN cuts nothing
        let both = Self { lo: self.lo.max(other.lo), hi: self.hi.min(other.hi) };
        (both.lo <= both.hi).then_some(both)
    }

    /// Returns the least interval that holds both.
    #[inline(always)]
    pub fn hull(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) } // T9: the outer ends, of finite intervals
    }

    /// Returns the members of at least `low`.
    #[inline(always)]
    pub fn from(self, low: f64) -> Option<Self> {
        self.cut(Self::new(low, f64::INFINITY))
    }

    /// Returns the members of at most `high`.
    #[inline(always)]
    pub fn up_to(self, high: f64) -> Option<Self> {
        self.cut(Self::new(f64::NEG_INFINITY, high))
    }

    /// Returns whether both ends are finite: all operations but [`Interval::over`] may overflow.
    #[inline(always)]
    pub fn is_finite(self) -> bool {
        self.lo.is_finite() && self.hi.is_finite()
    }

    /// Returns whether 0 is a member.
    #[inline(always)]
    pub fn holds_zero(self) -> bool {
        self.lo <= 0.0 && self.hi >= 0.0
    }

    /// Returns the quotients; `None` when 0 may be a divisor.
    #[inline(always)]
    pub fn over(self, divisor: Self) -> Option<Self> {
        if divisor.holds_zero() {
            return None;
        }
        let ends = [self.lo / divisor.lo, self.lo / divisor.hi, self.hi / divisor.lo, self.hi / divisor.hi];
        let quotient = outward(least(ends), greatest(ends));
        quotient.is_finite().then_some(quotient)
    }

    /// `sign * self` for a sign of 1 or -1.
    #[inline(always)]
    pub fn signed(self, sign: f64) -> Self {
        if sign < 0.0 { -self } else { self }
    }

    /// Returns a double times it.
    #[inline(always)]
    pub fn times(self, x: f64) -> Self {
        let (a, b) = (self.lo * x, self.hi * x);
        outward(a.min(b), a.max(b)) // T9: the outer ends
    }

    /// `cos 2 pi u` over the interval.
    pub fn cos(self) -> Self {
        if self.wid() >= 1.0 {
            return Self::new(-1.0, 1.0);
        }
        let ends = [kernel::sin_cos(self.lo).1, kernel::sin_cos(self.hi).1];
        let error = 2.0 * SIN_COS_ERROR;
        // K1: no cosine is beyond 1
        let (mut lo, mut hi) = ((ends[0].min(ends[1]) - error).max(-1.0), (ends[0].max(ends[1]) + error).min(1.0));
        if self.holds_whole(0.0) {
            hi = 1.0;
        }
        if self.holds_whole(0.5) {
            lo = -1.0;
        }
        Self { lo, hi }
    }

    /// `sin 2 pi u` over the interval.
    pub fn sin(self) -> Self {
        (self - Self::point(0.25)).cos()
    }

    /// Whether a whole number plus `shift` may be a member.
    #[inline(always)]
    fn holds_whole(self, shift: f64) -> bool {
        (self.hi - shift).next_up().floor() >= (self.lo - shift).next_down().ceil() // T9: whole ends, outward
    }

    /// Returns the part where `cos 2 pi u` is in `range`, if the interval lies in one half period; all of it otherwise.
    pub fn where_cos(self, range: Self) -> Option<Self> {
        let half = (2.0 * self.middle()).floor(); // T9: any half turn; the ends are compared
        if self.lo < 0.5 * half || self.hi > 0.5 * (half + 1.0) {
            return Some(self);
        }
        // Lemma K3; from an even half turn on the cosine falls.
        let angle = |x: f64, error: f64| kernel::acos_coarse(x.clamp(-1.0, 1.0)) + error * 2.0 * ACOS_ERROR;
        let (near, far) = (angle(range.hi, -1.0), angle(range.lo, 1.0));
        let is_even = half.rem_euclid(2.0) == 0.0; // exact: a whole number
        let part = if is_even {
            outward(0.5 * half + near, 0.5 * half + far)
        } else {
            outward(0.5 * (half + 1.0) - far, 0.5 * (half + 1.0) - near)
        };
        self.cut(part)
    }

    /// `S(h) = sin(pi h)/(pi h)`, an even function. Lemma T9
    pub fn sinc(self) -> Self {
        if self.lo < 0.0 {
            return Self::new(0.0, self.hi.max(-self.lo)).sinc(); // T9: even
        }
        let ends = if self.hi <= 1.0 {
            Self::new(falling_sinc(self.hi).lo, falling_sinc(self.lo).hi)
        } else {
            let wave = self.times(0.5).sin();
            let bound = if self.lo > 0.0 { wave.over(self * PI) } else { None };
            bound.unwrap_or(Self::new(-0.25, 1.0)) // T9: -1/4 < S <= 1
        };
        Self { lo: ends.lo.max(-0.25), hi: ends.hi.min(1.0) } // T9: -1/4 < S <= 1
    }

    /// `g(h) = (1 - S(h))/h`, an odd function. Lemma T9
    pub fn bend(self) -> Self {
        if self.lo < 0.0 {
            let most = Self::new(0.0, self.hi.max(-self.lo)).bend().hi; // T9: odd
            return Self::new(-most, most);
        }
        let square = PI * PI;
        let high = (square * self).times(1.0 / 6.0).hi.next_up();
        let cube = Self::point(self.hi) * Self::point(self.hi) * Self::point(self.hi);
        let first = (square * Self::point(self.lo)).lo / 6.0;
        let second = (square * square * cube).hi / 120.0;
        let low = (first.next_down() - second.next_up()).next_down();
        let series = Self::new(low.max(0.0), high); // T9: 0 <= g
        let direct = (Self::point(1.0) - self.sinc()).over(self);
        direct.and_then(|direct| direct.cut(series)).unwrap_or(series) // T9: both hold it
    }
}

/// `S(h)` at one time in `[0, 1]`.
fn falling_sinc(h: f64) -> Interval {
    let x = PI * Interval::point(h);
    let square = x * x;
    let series = Interval::new((1.0 - (square.hi / 6.0).next_up()).next_down(), 1.0);
    let direct = Interval::point(0.5 * h).sin().over(x);
    direct.and_then(|direct| direct.cut(series)).unwrap_or(series) // T9: both hold it
}

#[inline(always)]
fn least(x: [f64; 4]) -> f64 {
    x[0].min(x[1]).min(x[2].min(x[3])) // T9: a NaN is 0 times infinity, next to a 0
}

#[inline(always)]
fn greatest(x: [f64; 4]) -> f64 {
    x[0].max(x[1]).max(x[2].max(x[3])) // T9
}

impl Add for Interval {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        outward(self.lo + b.lo, self.hi + b.hi)
    }
}

impl Neg for Interval {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }
}

impl Sub for Interval {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        outward(self.lo - b.hi, self.hi - b.lo)
    }
}

impl Mul for Interval {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        let ends = [self.lo * b.lo, self.lo * b.hi, self.hi * b.lo, self.hi * b.hi];
        outward(least(ends), greatest(ends))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Wave;
    use num_bigint::BigInt;
    use num_rational::BigRational;
    use proptest::prelude::*;

    /// Ends, some of them equal, and a member between them.
    fn member() -> impl Strategy<Value = (Interval, f64)> {
        let width = prop_oneof![Just(0.0), 1e-12..1e-3f64, 0.0..2.0f64];
        (-3.0..3.0f64, width, 0.0..=1.0f64).prop_map(|(lo, width, at)| {
            let hi = lo + width;
            (Interval::new(lo, hi), (lo + at * width).clamp(lo, hi))
        })
    }

    /// Whether a number computed with an error of some units is possible.
    fn holds(x: Interval, y: f64) -> bool {
        let error = 1e-14 * y.abs().max(1.0);
        x.lo <= y + error && y - error <= x.hi
    }

    fn inari(x: Interval) -> inari::Interval {
        inari::Interval::try_from((x.lo, x.hi)).unwrap()
    }

    /// Whether it holds the least interval of doubles that holds the results, and little more.
    fn is_around(ours: Interval, least: inari::Interval, more: f64) -> bool {
        let unit = least.inf().next_down() - more <= ours.lo && ours.hi <= least.sup().next_up() + more;
        least.subset(inari(ours)) && unit
    }

    proptest! {
        /// By inari, which rounds outward at once: one unit in the last place is lost at each end, and in the sine a few.
        #[test]
        fn operations_are_inaris_but_for_a_unit((x, _) in member(), (y, b) in member()) {
            let (p, q) = (inari(x), inari(y));
            prop_assert!(is_around(x + y, p + q, 0.0) && is_around(x - y, p - q, 0.0) && is_around(x * y, p * q, 0.0));
            prop_assert!(is_around(x.times(b), p * inari(Interval::point(b)), 0.0));
            prop_assert!(x.over(y).is_none_or(|quotient| is_around(quotient, p / q, 0.0)));
            prop_assert!(y.over(y).is_some() != y.holds_zero());
            let cuts = [(x.cut(y), p.intersection(q)), (x.from(b), p.intersection(inari(Interval::new(b, f64::INFINITY))))];
            prop_assert!(cuts.iter().all(|(ours, least)| ours.map_or(inari::Interval::EMPTY, inari) == *least));
            prop_assert!(inari(x.hull(y)) == p.convex_hull(q) && x.holds_zero() == p.contains(0.0));
            let (sin, cos) = p.wave();
            prop_assert!(is_around(x.sin(), sin, 2e-14) && is_around(x.cos(), cos, 2e-14), "{x:?}");
            prop_assert!(p.subset(x.ball().into()) && p.subset(inari(Interval::of(x.ball()))));
        }

        #[test]
        fn what_has_this_cosine_is_kept((x, a) in member(), width in 0.0..1.0f64) {
            let cos = kernel::sin_cos(a).1;
            let kept = x.where_cos(Interval::new(cos - width, cos + width)).unwrap();
            prop_assert!(kept.lo <= a && a <= kept.hi);
        }

        #[test]
        fn sinc_and_bend_hold_their_values((x, a) in member()) {
            prop_assume!(a.abs() > 1e-4);
            let sinc = (std::f64::consts::PI * a).sin() / (std::f64::consts::PI * a);
            prop_assert!(holds(x.sinc(), sinc), "{x:?} {a}");
            let bend = (1.0 - sinc) / a;
            prop_assert!(x.bend().lo <= bend + 1e-11 && bend - 1e-11 <= x.bend().hi, "{x:?} {a} {:?}", x.bend());
        }

        /// In exact fractions, by their series: the last term that is left out decides the side.
        #[test]
        fn r32_sinc_and_bend_hold_the_values_at_short_times((x, a) in short()) {
            let [sinc, bend] = by_series(a);
            prop_assert!(is_within(&sinc, x.sinc()), "S({a:e}) of {x:?}: {:?}", x.sinc());
            prop_assert!(is_within(&bend, x.bend()), "g({a:e}) of {x:?}: {:?}", x.bend());
        }
    }

    /// Intervals of times below 1e-4, down to 0 and to what is no normal double any more, and a member; times may be negative.
    fn short() -> impl Strategy<Value = (Interval, f64)> {
        let time = || {
            let tiny = (0..64u64).prop_map(f64::from_bits);
            let power = (-324.0..-4.0f64).prop_map(|n| 10f64.powf(n));
            prop_oneof![1 => Just(0.0), 1 => Just(1e-300), 1 => tiny, 4 => power, 8 => 1e-9..1e-4f64]
        };
        let sign = || prop_oneof![Just(1.0), Just(-1.0)];
        (time(), time(), any::<bool>(), sign(), sign()).prop_map(|(a, b, is_point, s, t)| {
            let (a, b) = (s * a, if is_point { s * a } else { t * b });
            (Interval::new(a.min(b), a.max(b)), a)
        })
    }

    /// A lower and an upper bound.
    type Bounds = [BigRational; 2];

    /// Bounds of `S(h)` and of `g(h)` at a time below 1e-4: with `x = (pi h)^2`, `1 - x/6 <= S <= 1 - x/6 + x^2/120` and
    /// `pi^2 h/6 - pi^4 h^3/120 <= g <= pi^2 h/6` for `h >= 0`, the latter odd.
    fn by_series(h: f64) -> [Bounds; 2] {
        // 30 digits of pi
        let digits = |text: &str| BigRational::new(text.parse().unwrap(), BigInt::from(10).pow(29));
        let pi = ["314159265358979323846264338327", "314159265358979323846264338328"].map(digits);
        let part = |n: i64| BigRational::new(1.into(), n.into());
        let size = BigRational::from_float(h.abs()).unwrap();
        let square = pi.map(|pi| &pi * &pi);
        let [low, high] = square.each_ref().map(|square| square * &size * part(6));
        let cube = &square[1] * &square[1] * &size * &size * &size * part(120);
        let one = || BigRational::from_integer(1.into());
        let sinc = [one() - &high * &size, one() - &low * &size + &cube * &size];
        let bend = [low - cube, high];
        [sinc, if h < 0.0 { [-bend[1].clone(), -bend[0].clone()] } else { bend }]
    }

    /// Whether bounds lie between two doubles.
    fn is_within([low, high]: &Bounds, x: Interval) -> bool {
        let exact = |x: f64| BigRational::from_float(x).unwrap();
        exact(x.lo) <= *low && *high <= exact(x.hi)
    }

    #[test]
    fn extrema_inside_are_seen() {
        assert_eq!(Interval::new(0.4, 0.6).cos().lo, -1.0);
        assert_eq!(Interval::new(-0.1, 0.1).cos().hi, 1.0);
        assert!(Interval::new(0.1, 0.4).cos().hi < 1.0 && Interval::new(0.0, 0.0).sinc().hi == 1.0);
    }
}
