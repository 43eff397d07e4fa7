//! The closed forms (64)-(73): equispaced motions of N cycles, N odd, e < 1 (Lemma W2).
//!
//! The paper gives them on S- (66)-(68) and, with `|v|` for `-v`, on S+ (72), (73): these functions take the speed.

use std::cmp::Ordering;

use super::isolate::refine;
use super::jet::Jet;
use super::motion::{Motion, Parameters, critical};
use super::real::Real;

/// `K = N pi (1 + e)/(1 - e)`; `None` if e may be 1.
pub(super) fn slope(cycles: u32, e: &Real) -> Option<Real> {
    let one = Real::int(1, e.bits());
    ((e + 1) * (Real::pi(e.bits()) * i64::from(cycles))).over(&(one - e))
}

/// `|v| = 2 A W cos th0/(1 - e)`. **Equation** (66), (72)
pub(super) fn speed(cos: &Real, e: &Real) -> Option<Real> {
    (cos * 2).over(&(Real::int(1, e.bits()) - e))
}

/// `d = 2 A sin th0 + (1 + e) N pi |v|/(2 W)`; lengths in one unit. **Equation** (67), (71) for e = 1
pub(super) fn gap(amplitude_sin: &Real, cycles: u32, e: &Real, speed_over_frequency: &Real) -> Real {
    amplitude_sin * 2 + travel(cycles, e, speed_over_frequency)
}

/// `(1 + e) N pi |v|/(2 W)`
fn travel(cycles: u32, e: &Real, speed_over_frequency: &Real) -> Real {
    ((e + 1) * (Real::pi(e.bits()) * i64::from(cycles)) * speed_over_frequency).half()
}

/// `(A sin th0, A cos th0)` from `d`, `|v|/W`: (66) and (67) solved for them.
pub(super) fn vector(gap: &Real, cycles: u32, e: &Real, speed_over_frequency: &Real) -> (Real, Real) {
    let sin = (gap - travel(cycles, e, speed_over_frequency)).half();
    let cos = ((Real::int(1, e.bits()) - e) * speed_over_frequency).half();
    (sin, cos)
}

/// `A_N`, the length of that vector. **Equation** (68), (73); (69) for N = 1
pub(super) fn amplitude((sin, cos): &(Real, Real)) -> Real {
    (sin.square() + cos.square()).sqrt().expect("a sum of squares")
}

/// What is known exactly about `g = d/A`: how it compares with 2, and with `K`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Orders {
    /// Of `2 - g`.
    pub room: Option<Ordering>,
    /// Of `g - K`.
    pub rise: Option<Ordering>,
}

/// What is known of the solutions of (67) for `th0`.
pub(super) struct Solutions {
    pub motions: Vec<Motion>,
    /// Whether others may exist: near the fold, or at `d = 2 A`.
    pub is_doubtful: bool,
}

/// All equispaced motions for e < 1, N odd: `d/A = 2 sin th0 + K cos th0` solved for `th0`.
pub(super) fn solve(parameters: &Parameters, orders: Orders) -> Option<Solutions> {
    let Parameters { cycles, ratio, restitution, .. } = parameters;
    let slope = slope(*cycles, restitution)?;
    let square = slope.square() + 4;
    let below_fold = &square - ratio.square();
    if !below_fold.is_positive() {
        return Some(Solutions { motions: Vec::new(), is_doubtful: !below_fold.is_negative() });
    }
    let root = below_fold.sqrt()?;
    let angle = |sign: i64| {
        let sin = (ratio * 2 - &slope * &root * sign).over(&square)?;
        let cos = (ratio * &slope + &root * 2 * sign).over(&square)?;
        Some((sin, cos))
    };
    let motion = |(sin, cos): (Real, Real)| {
        let speed = speed(&cos, restitution).filter(Real::is_positive)?;
        Motion::symmetric(parameters.clone(), (sin, cos), speed)
    };
    // sin th0 = 0 is known where g = K exactly; its sign where their order is.
    let lower = match orders.rise {
        Some(Ordering::Equal) => (Real::int(0, slope.bits()), Real::int(1, slope.bits())),
        _ => angle(1)?,
    };
    let mut motions = vec![motion(lower)?];
    let is_doubtful = match orders.room {
        // cos th0 <= 0.
        Some(Ordering::Greater | Ordering::Equal) => false,
        Some(Ordering::Less) => match motion(angle(-1)?) {
            Some(upper) => {
                motions.push(upper);
                false
            }
            None => true,
        },
        None => true,
    };
    Some(Solutions { motions, is_doubtful })
}

/// `th_g(e)`, `0 < e < 1`: with `sin th0 < 0` an equispaced motion is physical if and only if `|th0| < th_g` (Lemma W3).
///
/// `None` if `e` may be 0 or is too wide.
pub(super) fn grazing_angle(e: &Real) -> Option<Real> {
    let kappa = (e + 1).over(&(Real::int(1, e.bits()) - e))?;
    let height = |b: &Real| {
        let (sin, cos) = (b.sin(), b.cos());
        let (a, sine, cosine) = critical(&(&kappa * &cos))?;
        let value = &cosine * (&a + b) - sine - &sin;
        let slope = (&kappa - 1) * cos - &kappa * sin * (a + b);
        Some(Jet { value, slope })
    };
    // Where kappa cos b <= 1 and G is smooth.
    let [_, first] = Real::int(1, e.bits()).over(&kappa)?.acos()?.ends();
    height(&first)?.value.is_positive().then_some(())?;
    let last = Real::pi(e.bits()).half();
    Some(refine(first.hull(&last), Ordering::Greater, height))
}
