//! Functions of boxes of phases and times that the search needs besides the arithmetic: Lemma T9.

use crate::number::interval::Interval;
use crate::number::kernel::{self, ACOS_ERROR};

impl Interval {
    /// The part where `cos 2 pi u` is in `range`, if the interval lies in one half period; all of it otherwise.
    pub fn where_cos(self, range: Self) -> Option<Self> {
        let half = (2.0 * self.mid()).floor(); // T9: any half period; the ends are compared
        if self.inf() < 0.5 * half || self.sup() > 0.5 * (half + 1.0) {
            return Some(self);
        }
        // Lemma K3; from an even half period on the cosine falls.
        let angle = |x: f64, error: f64| kernel::acos_coarse(x.clamp(-1.0, 1.0)) + error * 2.0 * ACOS_ERROR;
        let (near, far) = (angle(range.sup(), -1.0), angle(range.inf(), 1.0));
        let is_even = half.rem_euclid(2.0) == 0.0; // exact: a whole number
        let part = if is_even {
            [0.5 * half + near, 0.5 * half + far]
        } else {
            [0.5 * (half + 1.0) - far, 0.5 * (half + 1.0) - near]
        };
        self.intersection(Self::new(part[0].next_down(), part[1].next_up()))
    }

    /// `S(h) = sin(pi h)/(pi h)`, an even function. Lemma T9
    pub fn sinc(self) -> Self {
        if self.inf() < 0.0 {
            return Self::new(0.0, self.sup().max(-self.inf())).sinc(); // T9: even
        }
        let ends = if self.sup() <= 1.0 {
            Self::new(falling_sinc(self.sup()).inf(), falling_sinc(self.inf()).sup())
        } else {
            let wave = self.scaled(0.5).sin();
            let bound = if self.inf() > 0.0 { wave.checked_div(self * Self::PI) } else { None };
            bound.unwrap_or(Self::new(-0.25, 1.0)) // T9: -1/4 < S <= 1
        };
        Self::new(ends.inf().max(-0.25), ends.sup().min(1.0)) // T9: -1/4 < S <= 1
    }

    /// `g(h) = (1 - S(h))/h`, an odd function. Lemma T9
    pub fn bend(self) -> Self {
        if self.inf() < 0.0 {
            let most = Self::new(0.0, self.sup().max(-self.inf())).bend().sup(); // T9: odd
            return Self::new(-most, most);
        }
        let square = Self::PI * Self::PI;
        let high = (square * self).scaled(1.0 / 6.0).sup().next_up();
        let cube = Self::point(self.sup()) * Self::point(self.sup()) * Self::point(self.sup());
        let first = (square * Self::point(self.inf())).inf() / 6.0;
        let second = (square * square * cube).sup() / 120.0;
        let low = (first.next_down() - second.next_up()).next_down();
        let series = Self::new(low.max(0.0), high); // T9: 0 <= g
        let direct = (Self::ONE - self.sinc()).checked_div(self);
        direct.and_then(|direct| direct.intersection(series)).unwrap_or(series) // T9: both hold it
    }
}

/// `S(h)` at one time in `[0, 1]`.
fn falling_sinc(h: f64) -> Interval {
    let x = Interval::PI * Interval::point(h);
    let square = x * x;
    let series = Interval::new((1.0 - (square.sup() / 6.0).next_up()).next_down(), 1.0);
    let direct = Interval::point(0.5 * h).sin().checked_div(x);
    direct.and_then(|direct| direct.intersection(series)).unwrap_or(series) // T9: both hold it
}

#[cfg(test)]
mod tests {
    use super::*;
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

    /// Whether a number with an error of some units in its last place may be in an interval.
    fn holds(x: Interval, y: f64) -> bool {
        let error = 1e-14 * y.abs().max(1.0);
        x.inf() <= y + error && y - error <= x.sup()
    }

    proptest! {
        #[test]
        fn phases_with_the_given_cosine_are_kept((x, a) in member(), width in 0.0..1.0f64) {
            let cos = kernel::sin_cos(a).1;
            let kept = x.where_cos(Interval::new(cos - width, cos + width)).unwrap();
            prop_assert!(kept.inf() <= a && a <= kept.sup());
        }

        #[test]
        fn sinc_and_bend_hold_their_values((x, a) in member()) {
            prop_assume!(a.abs() > 1e-4);
            let sinc = (std::f64::consts::PI * a).sin() / (std::f64::consts::PI * a);
            prop_assert!(holds(x.sinc(), sinc), "{x:?} {a}");
            let bend = (1.0 - sinc) / a;
            prop_assert!(x.bend().inf() <= bend + 1e-11 && bend - 1e-11 <= x.bend().sup(), "{x:?} {a} {:?}", x.bend());
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
        exact(x.inf()) <= *low && *high <= exact(x.sup())
    }

    #[test]
    fn the_greatest_value_is_seen() {
        assert_eq!(Interval::ZERO.sinc().sup(), 1.0);
    }
}
