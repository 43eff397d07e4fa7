//! The interval type of the package inari, [`inari::Interval`], as an arithmetic of this crate; in a build with the feature `inari`.
//!
//! It computes by the textbook's method and judges the rest of the crate, which does without. It rounds outward by switching the rounding mode: as tight as doubles are, at the price of two switches an
//! operation. It is built here without its sine, which needs C: ours is the kernel's, at the ends and the extrema
//! between. An interval here is never empty: all operations on such give such, and only what holds a common number is
//! intersected. Lemmas I1 and I2 of `docs/proofs/intervals.md#I1`, same labels.

use std::cmp::Ordering;

use inari::{Interval, const_interval};

use super::kernel::{self, DEPARTURE_ERROR, SIN_COS_ERROR, SmallAngle};
use super::{Ball, Enclosing, Number, SHORT, Wave};
use crate::exact::Enclosure;

/// The range of sines and cosines.
const RANGE: Interval = const_interval!(-1.0, 1.0);
/// The factor by which a field of a departure is multiplied so that it holds the truth: `1/(1 - x) <= 1 + 2 x` (Lemma K2).
const RELATIVE: Interval = const_interval!(1.0 - 2.0 * DEPARTURE_ERROR, 1.0 + 2.0 * DEPARTURE_ERROR);

/// The interval between two doubles, exactly; all numbers where they are none.
pub(crate) fn between(inf: f64, sup: f64) -> Interval {
    Interval::try_from((inf, sup)).unwrap_or(Interval::ENTIRE) // I1: nothing is known
}

/// One double.
fn point(x: f64) -> Interval {
    between(x, x)
}

/// All numbers of at most this size.
fn within(size: f64) -> Interval {
    between(-size, size)
}

/// All numbers within `error` of `x`.
fn around(x: f64, error: f64) -> Interval {
    point(x) + within(error)
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
        point(x)
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
    fn short(&self) -> Option<SmallAngle<Self>> {
        let (inf, sup) = (self.inf(), self.sup());
        // exact: a departure of no time
        if !(inf >= 0.0 && (sup == 0.0 || SHORT.contains(&sup))) {
            return None;
        }
        // I2: at least 0, where the kernel claims nothing
        let low = kernel::departure(if SHORT.contains(&inf) { inf } else { 0.0 });
        let high = kernel::departure(sup);
        let hull = |low: f64, high: f64| RELATIVE * point(low).convex_hull(point(high));
        Some(SmallAngle {
            versine: hull(low.versine, high.versine),
            excess: hull(low.excess, high.excess),
            sine: hull(low.sine, high.sine),
        })
    }
}

impl Enclosing for Interval {
    fn centre(&self) -> Self {
        point(self.mid())
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::Dyadic;
    use crate::pair::Reduced;
    use crate::periodic::Chain;
    use proptest::prelude::*;

    /// Sine and cosine of a phase, by exact numbers; enclosures of `2^-100`.
    fn truth(u: f64) -> [Enclosure; 2] {
        let angle = Enclosure::pi(200).mul(&Enclosure::point(Dyadic::from_f64(2.0 * u).unwrap()), 200);
        [angle.sin(120), angle.cos(120)]
    }

    fn holds(interval: Interval, truth: &Enclosure) -> bool {
        enclosure(interval).unwrap().intersection(truth).is_some()
    }

    /// An interval and a member: ends at quarter periods and next to them, widths from nothing to periods.
    fn members() -> impl Strategy<Value = (Interval, f64)> {
        let near = prop_oneof![Just(0.0), Just(1e-300), Just(f64::EPSILON), -1e-9..1e-9f64, -0.3..0.3f64];
        let quarter = prop_oneof![3 => -9..9i64, 1 => -(1i64 << 41)..1i64 << 41];
        let width = prop_oneof![Just(0.0), 0.0..1e-12f64, 0.0..0.3f64, Just(0.25), 0.0..3.0f64];
        (quarter, near, width, prop_oneof![Just(0.0), Just(1.0), 0.0..1.0f64]).prop_map(|(quarter, near, width, at)| {
            let inf = quarter as f64 / 4.0 + near;
            let sup = inf + width;
            (between(inf, sup), (inf + at * width).clamp(inf, sup))
        })
    }

    /// Numbers whose sums with their radii are exact, and members at both ends and in the middle.
    fn operands() -> impl Strategy<Value = (Ball, [f64; 3])> {
        let mid = prop_oneof![Just(0.0), (-60..60i32, -4096..4096i32).prop_map(|(e, m)| f64::from(m) * 2f64.powi(e))];
        (mid, prop_oneof![Just(0.0), (0..12i32).prop_map(|e| 2f64.powi(-e))]).prop_map(|(mid, part)| {
            let rad = part * mid.abs();
            (Ball::new(mid, rad), [mid - rad, mid, mid + rad])
        })
    }

    /// Returns whether `inner` lies in `outer`, but for the unit in the last place by which inari may have rounded it outward.
    fn is_in(inner: Interval, outer: Interval) -> bool {
        outer.inf() <= inner.inf().next_up() && inner.sup().next_down() <= outer.sup()
    }

    proptest! {
        /// Lemma I1.
        #[test]
        fn waves_hold_those_of_their_members((u, member) in members()) {
            let (sin, cos) = u.wave();
            let [true_sin, true_cos] = truth(member);
            prop_assert!(holds(sin, &true_sin) && holds(cos, &true_cos), "{u:?} {member}");
            prop_assert!(sin.subset(RANGE) && cos.subset(RANGE));
            if u.is_singleton() {
                prop_assert!(sin.wid() < 2.0 * f64::EPSILON && cos.wid() < 2.0 * f64::EPSILON);
            }
            // The balls' own, of slope 2 pi, is wider than the range but for the kernel's error at the other end.
            let ball = Ball::try_from(u).unwrap().sin_cos();
            let ball = (ball.0.widened(4.0 * SIN_COS_ERROR), ball.1.widened(4.0 * SIN_COS_ERROR));
            prop_assert!(sin.subset(ball.0.into()) && cos.subset(ball.1.into()), "{u:?} {ball:?}");
        }

        /// Lemma I2.
        #[test]
        fn departures_hold_those_of_their_members(
            low in prop_oneof![Just(0.0), Just(1e-200), (-300.0..-1.0f64).prop_map(|x| 10f64.powf(x))],
            high in (-80.0..-1.0f64).prop_map(|x| 10f64.powf(x)), at in 0.0..=1.0f64,
        ) {
            let (inf, sup) = (low.min(high), high);
            let SmallAngle { versine, excess, sine } = between(inf, sup).short().unwrap();
            let member = (inf + at * (sup - inf)).clamp(inf, sup);
            let [true_sine, true_cosine] = truth(member);
            let one = Enclosure::point(Dyadic::power_of_two(0));
            prop_assert!(holds(sine, &true_sine) && holds(versine, &one.sub(&true_cosine, 300)));
            let angle = Enclosure::pi(400).mul(&Enclosure::point(Dyadic::from_f64(2.0 * member).unwrap()), 400);
            prop_assert!(holds(excess, &angle.sub(&true_sine, 400)), "{member}: {excess:?}");
        }

        /// Balls against inari: its least interval lies in ours, and ours is not wider by more than its products of radii.
        #[test]
        fn balls_hold_what_inari_computes((x, members) in operands(), (y, others) in operands()) {
            let (a, b) = (between(members[0], members[2]), between(others[0], others[2]));
            let operations: [(Ball, Interval); 3] = [(x + y, a + b), (x - y, a - b), (x * y, a * b)];
            for (ball, least) in operations {
                prop_assert!(is_in(least, ball.into()), "{x:?} {y:?}: {ball:?} {least:?}");
                let tight = least.rad() + 2.0 * x.rad() * y.rad() + 1e-14 * least.mag() + 1e-300;
                prop_assert!(ball.rad() <= tight * (1.0 + 1e-14), "{x:?} {y:?}: {ball:?} {least:?}");
            }
            match (x.checked_div(y), a.checked_div(b)) {
                (Some(ball), Some(least)) => prop_assert!(is_in(least, ball.into()), "{x:?} {y:?}: {ball:?} {least:?}"),
                (ball, _) => prop_assert!(ball.is_none()),
            }
        }

        /// Lemma T1 in three arithmetics: the equations of a chain, its Jacobian and its slopes.
        #[test]
        fn chains_run_in_intervals(
            alpha in 0.1..3.0f64, e in 0.0..=1.0f64, first in -0.5..0.5f64, steps in prop::array::uniform3(0.01..0.6f64),
            width in prop_oneof![Just(0.0), Just(1e-6)],
        ) {
            let chain = Chain::new(&"RRLL".parse().unwrap(), 2).unwrap();
            let phases = [first, first + steps[0], first + steps[0] + steps[1], first + steps.iter().sum::<f64>()];
            let balls = Reduced::new(Ball::exact(alpha), Ball::exact(e));
            let intervals = Reduced { alpha: between(alpha, alpha), beta: Interval::TAU * between(alpha, alpha), restitution: between(e, e) };
            let middle = balls.centre();
            let in_balls = chain.legs(&balls, &phases.map(|phase| Ball::new(phase, width))).unwrap();
            let ours = chain.legs(&intervals, &phases.map(|phase| around(phase, width))).unwrap();
            let in_floats = chain.legs(&middle, &phases).unwrap();
            let is_near = |float: f64, ball: Ball, interval: Interval| {
                !interval.disjoint(ball.into()) && !interval.disjoint(around(float, 1e-11 * (1.0 + float.abs()) + interval.rad()))
            };
            let misses = [chain.residual(&balls, &in_balls)];
            let (found, floats) = (chain.residual(&intervals, &ours), chain.residual(&middle, &in_floats));
            prop_assert!((0..4).all(|i| is_near(floats[i], misses[0][i], found[i])), "{misses:?} {found:?}");
            let floats = chain.slopes(&middle, &in_floats).unwrap().0;
            let slopes = (chain.slopes(&balls, &in_balls), chain.slopes(&intervals, &ours));
            if let (Some(balls), Some(found)) = slopes {
                let all = floats.iter().flatten().zip(balls.0.iter().flatten()).zip(found.0.iter().flatten());
                for ((float, ball), interval) in all {
                    prop_assert!(is_near(*float, *ball, *interval), "{float:?} {ball:?} {interval:?}");
                }
            }
        }

        /// There and back nothing is lost but the last place.
        #[test]
        fn conversions_hold_what_they_convert((interval, member) in members(), (ball, members) in operands()) {
            let there = Ball::try_from(interval).unwrap();
            prop_assert!(interval.subset(there.into()) && Interval::from(there).contains(member));
            prop_assert!(members.into_iter().all(|member| Interval::from(ball).contains(member)));
            prop_assert_eq!(enclosing(&enclosure(interval).unwrap()), interval);
        }
    }

    #[test]
    fn an_unbounded_interval_is_no_ball() {
        for interval in [Interval::EMPTY, Interval::ENTIRE, between(0.0, f64::INFINITY)] {
            assert_eq!(Ball::try_from(interval), Err(Unbounded));
            assert_eq!(enclosure(interval), None);
        }
        assert!(Interval::from(Ball::new(1.0, f64::NAN)).is_entire());
        assert!(Interval::from(Ball::new(f64::INFINITY, 0.0)).is_entire());
        let huge = Enclosure::point(Dyadic::power_of_two(5000));
        assert_eq!(enclosing(&huge), between(f64::MAX, f64::INFINITY));
        assert_eq!(enclosing(&Enclosure::pi(120)), Interval::PI);
    }

    #[test]
    fn nothing_is_known_beyond_the_kernel() {
        for far in [2f64.powi(41), f64::INFINITY] {
            assert_eq!(between(-far, far.min(f64::MAX)).wave(), (RANGE, RANGE));
        }
        assert!(between(0.0, 0.2).short().is_none() && between(-1e-9, 0.1).short().is_none());
        assert!(between(0.0, 1e-200).short().is_none() && Interval::EMPTY.short().is_none());
    }

    #[test]
    fn quarters_and_signs_are_exact() {
        assert_eq!(between(0.75, 0.75).wave(), (between(-1.0, -1.0), between(0.0, 0.0)));
        assert_eq!(between(-0.25, 0.25).wave(), (RANGE, between(0.0, 1.0)));
        assert_eq!(between(0.0, 0.0).certain_sign(), Some(Ordering::Equal));
        assert_eq!(between(0.0, 1.0).certain_sign(), None);
        assert_eq!(between(1.0, 2.0).certain_sign(), Some(Ordering::Greater));
        assert_eq!(between(-2.0, -1.0).certain_sign(), Some(Ordering::Less));
        assert!(
            between(0.5, 0.6).is_interior_to(&between(0.4, 0.7))
                && !between(0.4, 0.6).is_interior_to(&between(0.4, 0.7))
        );
    }
}
