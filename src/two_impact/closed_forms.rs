//! The closed forms (61)-(73), and the angle of grazing, as functions.
//!
//! Lengths are in any one unit, velocities in that a unit of time, phases in radians; speeds are those before the impacts, which both
//! have (61). The paper gives the forms on S-, where `v = -|v|`, and again on S+, where `v = |v|`; these take the speed.
//!
//! ```
//! use impact_pair::exact::Exact;
//! use impact_pair::exact::Real;
//! use impact_pair::two_impact::closed_forms::{amplitude, vector};
//! let number = |text: &str| Real::of(&Exact::parse(text).unwrap(), 100);
//! // Figure 12: d = 3 pi, e = 1/2, |v|/W = 4 give A sin th0 = 0, A cos th0 = 1.
//! let found = amplitude(&vector(&number("3*pi"), 1, &number("1/2"), &number("4")));
//! assert!((found - number("1")).to_f64().abs() < 1e-29);
//! ```

use std::cmp::Ordering;

use super::angle::{acos, critical};
use super::isolate::refine;
use super::jet::Jet;
use crate::exact::Real;

/// `|v|/(A W) = (cos th0 - cos th1)/(1 - e)`, from a left impact to a right one; `None` if e may be 1. **Equation** (62)
///
/// # Departs from the paper
/// The paper's left side is `v_i`.
pub fn speed_between(theta0: &Real, theta1: &Real, e: &Real) -> Option<Real> {
    (theta0.cos() - theta1.cos()).over(&(Real::int(1, e.bits()) - e))
}

/// `c p + c' (2 N pi - p)`, `p = th1 - th0`, with the drifts `c = e V + cos th0`, `c' = -e V + cos th1` over `A W` and `V = |v|/(A W)`: 0 for
/// a motion. **Equation** (63); (70) for e = 1
pub fn closure(theta0: &Real, theta1: &Real, cycles: u32, e: &Real, speed: &Real) -> Real {
    let there = theta1 - theta0;
    let back = Real::pi(e.bits()) * (2 * i64::from(cycles)) - &there;
    drift(e, speed, &theta0.cos()) * there + drift(e, &-speed, &theta1.cos()) * back
}

/// `e V + cos th`, the drift over `A W` of a ball that leaves the left wall after an impact of `V = |v|/(A W)`, (15); on the right wall
/// `V` is negative.
pub(super) fn drift(e: &Real, speed: &Real, cos: &Real) -> Real {
    e * speed + cos
}

/// `K = N pi (1 + e)/(1 - e)`; `None` if e may be 1.
pub fn slope(cycles: u32, e: &Real) -> Option<Real> {
    let one = Real::int(1, e.bits());
    ((e + 1) * (Real::pi(e.bits()) * i64::from(cycles))).over(&(one - e))
}

/// `|v| = 2 A W cos th0/(1 - e)`. **Equation** (66), (72)
pub fn speed(cos: &Real, e: &Real) -> Option<Real> {
    (cos * 2).over(&(Real::int(1, e.bits()) - e))
}

/// `d = 2 A sin th0 + (1 + e) N pi |v|/(2 W)`; lengths in one unit. **Equation** (67), (71) for e = 1
pub fn gap(amplitude_sin: &Real, cycles: u32, e: &Real, speed_over_frequency: &Real) -> Real {
    amplitude_sin * 2 + travel(cycles, e, speed_over_frequency)
}

/// `(1 + e) N pi |v|/(2 W)`
fn travel(cycles: u32, e: &Real, speed_over_frequency: &Real) -> Real {
    ((e + 1) * (Real::pi(e.bits()) * i64::from(cycles)) * speed_over_frequency).half()
}

/// `(A sin th0, A cos th0)` from `d`, `|v|/W`: (66) and (67) solved for them.
pub fn vector(gap: &Real, cycles: u32, e: &Real, speed_over_frequency: &Real) -> (Real, Real) {
    let sin = (gap - travel(cycles, e, speed_over_frequency)).half();
    let cos = ((Real::int(1, e.bits()) - e) * speed_over_frequency).half();
    (sin, cos)
}

/// `A_N`, the length of that vector. **Equation** (68), (73); (69) for N = 1
pub fn amplitude((sin, cos): &(Real, Real)) -> Real {
    (sin.square() + cos.square()).sqrt().expect("a sum of squares")
}

/// `th_g(e)`, `0 < e < 1`: with `sin th0 < 0` an equispaced motion is admissible if and only if `|th0| < th_g` (Lemma W3).
///
/// `None` if `e` may be 0 or is too wide.
pub fn grazing_angle(e: &Real) -> Option<Real> {
    let kappa = (e + 1).over(&(Real::int(1, e.bits()) - e))?;
    let height = |b: &Real| {
        let (sin, cos) = (b.sin(), b.cos());
        let (a, sine, cosine) = critical(&(&kappa * &cos))?;
        let value = &cosine * (&a + b) - sine - &sin;
        let slope = (&kappa - 1) * cos - &kappa * sin * (a + b);
        Some(Jet { value, slope })
    };
    // The interval on which kappa cos b <= 1 and G is smooth.
    let [_, first] = acos(&Real::int(1, e.bits()).over(&kappa)?)?.ends();
    height(&first)?.value.is_positive().then_some(())?;
    let last = Real::pi(e.bits()).half();
    Some(refine(first.hull(&last), Ordering::Greater, height))
}
