//! Equispaced motions (64), N odd, e < 1, for given `d/A` (Lemma W2).

use std::cmp::Ordering;

use super::closed_forms::{slope, speed};
use super::motion::{Motion, Parameters};
use crate::exact::Real;

/// The exact orders of `g = d/A` and 2, and of `g` and `K`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Orders {
    /// The sign of `2 - g`.
    pub room: Option<Ordering>,
    /// The sign of `g - K`.
    pub rise: Option<Ordering>,
}

/// The solutions of (67) for `th0`.
pub(super) struct Solutions {
    pub motions: Vec<Motion>,
    /// True if others may exist: near the fold, or at `d = 2 A`.
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
