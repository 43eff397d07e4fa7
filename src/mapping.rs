//! The mappings P1-P4 between the switch-planes, words of them, and their Jacobian (A.7).

use crate::number::Number;
use crate::pair::rebound;
pub use impact_pair_model::{Mapping, Word};

/// The data of the Jacobian of one mapping; velocities in gap widths per forcing period, with their sign, before the impacts.
#[derive(Clone, Copy, Debug)]
pub struct Passage<N> {
    /// `h = t1 - t0` in forcing periods.
    pub time: N,
    /// `sin th0` at the impact before the flight.
    pub sin0: N,
    /// `sin th1` at the impact after the flight.
    pub sin1: N,
    /// `v0`
    pub velocity0: N,
    /// `v1`
    pub velocity1: N,
}

/// `[[dt1/dt0, dt1/dv0], [dv1/dt0, dv1/dv0]]` of a mapping, times in forcing periods, velocities in gap widths per forcing period.
///
/// **Equation** (A.7), the same for P1-P4. **Enclosure** (for balls): holds the Jacobian at every start whose
/// passage lies in `passage`. `None` when `v1` may be 0: the arrival may be a graze.
///
/// # Departs from the paper
/// Its second row has `sin(W t_i + tau)` for `sin(W t_{i+1} + tau)`, and its velocity column lacks
/// `e h/v_{i+1}`; both are misprints. The determinant is `e^2 v0/v1`.
///
/// ```
/// use impact_pair::mapping::{Passage, jacobian};
/// // No excitation: a ball with 4 gap widths per forcing period rebounds with e v0 = 2 and crosses in half a period.
/// let passage = Passage { time: 0.5, sin0: 0.0, sin1: 0.0, velocity0: -4.0, velocity1: 2.0 };
/// let [[a, b], [c, d]] = jacobian(0.0, 0.5, &passage).unwrap();
/// assert_eq!([a, b, c, d], [1.0, 0.125, 0.0, -0.5]);
/// assert_eq!(a * d - b * c, 0.5 * 0.5 * -4.0 / 2.0);
/// ```
#[inline(always)]
pub fn jacobian<N: Number>(beta: N, restitution: N, passage: &Passage<N>) -> Option<[[N; 2]; 2]> {
    let Passage { time, sin0, sin1, velocity0, velocity1 } = passage.clone();
    let amplitude = beta.turn() * beta;
    jacobian_between(restitution, time, [amplitude.clone() * sin0, amplitude * sin1], [velocity0, velocity1])
}

/// Jacobian of a mapping, from the accelerations `y''` after the impact before the flight and at the impact after the flight.
#[inline(always)]
pub(crate) fn jacobian_between<N: Number>(
    restitution: N,
    time: N,
    swings: [N; 2],
    velocities: [N; 2],
) -> Option<[[N; 2]; 2]> {
    Some(Sheared::between(restitution, time, swings, velocities)?.jacobian())
}

/// The Jacobian (A.7) in two parts: near a graze all large and uncertain entries are along `(1, slope)`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sheared<N> {
    /// `[dt1/dt0, dt1/dv0]`
    pub time: [N; 2],
    /// `y''` at the impact after the flight: the factor of `dt1` in `dv1`.
    pub slope: N,
    /// `dv1` at a fixed time.
    pub velocity: [N; 2],
}

impl<N: Number> Sheared<N> {
    /// Jacobian in two parts, from the arguments of [`jacobian_between`].
    #[inline(always)]
    pub fn between(restitution: N, time: N, [swing0, swing1]: [N; 2], [velocity0, velocity1]: [N; 2]) -> Option<Self> {
        let inverse = N::from_f64(1.0).checked_div(velocity1)?;
        let after = rebound(&restitution, velocity0);
        let time_by_time = swing0.clone().mul_add(time.clone(), after) * inverse.clone();
        let time_by_velocity = restitution.clone() * time * inverse;
        Some(Self { time: [time_by_time, time_by_velocity], slope: swing1, velocity: [-swing0, -restitution] })
    }

    /// Derivative along a curve in the first column, with a zero second column: `product` multiplies a row with the curve's direction.
    pub fn along(self, product: impl Fn([N; 2]) -> N) -> Self {
        let Self { time, slope, velocity } = self;
        let [time, velocity] = [time, velocity].map(|row| [product(row), N::from_f64(0.0)]);
        Self { time, slope, velocity }
    }

    /// The Jacobian from its two parts.
    #[inline(always)]
    pub fn jacobian(self) -> [[N; 2]; 2] {
        let Self { time, slope, velocity: [by_time, by_velocity] } = self;
        let velocity = [slope.mul_add_ref(&time[0], by_time), slope.mul_add_ref(&time[1], by_velocity)];
        [time, velocity]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Ball;
    use proptest::prelude::*;

    proptest! {
        /// det DP = e^2 v0/v1, a theorem of (A.7).
        #[test]
        fn the_determinant_is_e_squared_times_the_ratio_of_velocities(
            beta in 0.01..100.0f64, e in 0.0..=1.0f64, time in 1e-6..10.0f64,
            sin0 in -1.0..1.0f64, sin1 in -1.0..1.0f64, v0 in -10.0..10.0f64, v1 in 0.1..10.0f64,
        ) {
            let ball = Ball::exact;
            let passage = Passage { time: ball(time), sin0: ball(sin0), sin1: ball(sin1), velocity0: ball(v0), velocity1: ball(v1) };
            let [[a, b], [c, d]] = jacobian(ball(beta), ball(e), &passage).unwrap();
            let (found, expected) = (a * d - b * c, ball(e) * ball(e) * ball(v0).checked_div(ball(v1)).unwrap());
            prop_assert!((found.mid() - expected.mid()).abs() <= found.rad() + expected.rad());
        }
    }
}
