//! One solution of (57)-(60): two impacts in N cycles, and whether a wall is touched earlier.

use std::cmp::Ordering;

use super::angle::{angle, critical};
use super::closed_forms::drift;
use crate::exact::Real;

/// The parameters of a motion without units.
#[derive(Clone, Debug)]
pub(super) struct Parameters {
    /// N
    pub cycles: u32,
    /// `g = d/A`
    pub ratio: Real,
    /// `e`
    pub restitution: Real,
    /// True if `e` is exactly 0: the ball leaves at rest.
    pub is_dead: bool,
}

impl Parameters {
    pub fn bits(&self) -> u32 {
        self.restitution.bits()
    }

    /// `N pi`
    pub fn half_period(&self) -> Real {
        Real::pi(self.bits()) * i64::from(self.cycles)
    }
}

/// A motion of two impacts in N cycles, measured from its impact on the left wall. Lengths in `A`, phases in radians,
/// velocities in `A W` (Lemma W1).
#[derive(Clone, Debug)]
pub(super) struct Motion {
    pub parameters: Parameters,
    /// Sine and cosine of `th0`.
    pub left: (Real, Real),
    /// Sine and cosine of `th1`.
    pub right: (Real, Real),
    /// `th0`, up to whole forcing periods.
    pub theta0: Real,
    /// `p = th1 - th0`
    pub spacing: Real,
    /// `V`, the speed before each impact (61).
    pub speed: Real,
    /// True if it is its own mirror image: then it is equispaced with N odd.
    pub is_symmetric: bool,
}

impl Motion {
    /// Motion that is equispaced (64) for N odd, with this sine and cosine of `th0`.
    pub fn symmetric(parameters: Parameters, (sin, cos): (Real, Real), speed: Real) -> Option<Self> {
        let (theta0, spacing) = (angle(&sin, &cos)?, parameters.half_period());
        let right = (-&sin, -&cos);
        Some(Self { parameters, left: (sin, cos), right, theta0, spacing, speed, is_symmetric: true })
    }

    /// Motion with these phases, which is not its own mirror image.
    pub fn unsymmetric(parameters: Parameters, theta0: Real, spacing: Real, speed: Real) -> Self {
        let theta1 = &theta0 + &spacing;
        let (left, right) = ((theta0.sin(), theta0.cos()), (theta1.sin(), theta1.cos()));
        Self { parameters, left, right, theta0, spacing, speed, is_symmetric: false }
    }

    /// `th1`, up to whole forcing periods.
    pub fn theta1(&self) -> Real {
        &self.theta0 + &self.spacing
    }

    /// `q`, from the right wall back to the left one.
    pub fn back(&self) -> Real {
        self.parameters.half_period() * 2 - &self.spacing
    }

    /// Mirror image, begun at its own impact on the left wall (Lemma R2).
    pub fn mirrored(&self) -> Self {
        let turned = |(sin, cos): &(Real, Real)| (-sin, -cos);
        Self {
            left: turned(&self.right),
            right: turned(&self.left),
            theta0: self.theta1() + Real::pi(self.parameters.bits()),
            spacing: self.back(),
            ..self.clone()
        }
    }

    /// Whether the motion is admissible: `false` if an earlier contact is proved; `None` if undecided.
    pub fn is_physical(&self) -> Option<bool> {
        if self.is_symmetric && !self.is_elastic() {
            return self.is_physical_equispaced();
        }
        let there = self.flight().is_first();
        let back = self.mirrored().flight().is_first();
        match (there, back) {
            (Some(false), _) | (_, Some(false)) => Some(false),
            (Some(true), Some(true)) => Some(true),
            _ => None,
        }
    }

    fn is_elastic(&self) -> bool {
        (&self.parameters.restitution - 1).sign() == Some(Ordering::Equal)
    }

    /// Lemma W3, for `e < 1`.
    fn is_physical_equispaced(&self) -> Option<bool> {
        if matches!(self.left.0.sign(), Some(Ordering::Greater | Ordering::Equal)) {
            return Some(true);
        }
        let drift = self.flight().drift;
        if !matches!((&drift - 1).sign(), None | Some(Ordering::Less)) {
            return Some(true);
        }
        match near_height(&self.theta0, &self.left.0, &drift)?.sign()? {
            Ordering::Greater => Some(true),
            // A point 0 only: a graze.
            Ordering::Equal => None,
            // Also where the sine's sign is not certain: a wall that is passed is passed.
            Ordering::Less => self.left.0.is_negative().then_some(false),
        }
    }

    /// The flight from the left wall to the right one.
    fn flight(&self) -> Flight<'_> {
        let Parameters { ratio, restitution, is_dead, .. } = &self.parameters;
        let (sin, cos) = &self.left;
        let drift = drift(restitution, &self.speed, cos);
        Flight { theta: &self.theta0, sin, drift, length: &self.spacing, ratio, is_dead: *is_dead }
    }
}

/// `G = c (a + b) - sin a - sin b` at `th0 = -b`, `cos a = c`, where `c > 1` counts as 1: there it is positive (Lemma W3).
fn near_height(theta0: &Real, sin0: &Real, drift: &Real) -> Option<Real> {
    let (a, sine, cosine) = critical(drift)?;
    Some(cosine * (a - theta0) - sine + sin0)
}

/// A flight from the left wall to the right one, in the units of [`Motion`].
struct Flight<'m> {
    theta: &'m Real,
    sin: &'m Real,
    /// `c`
    drift: Real,
    length: &'m Real,
    ratio: &'m Real,
    is_dead: bool,
}

impl Flight<'_> {
    /// Whether the flight touches no wall before its end (Lemma W3, the extrema): extrema of height exactly 0 or `g` are undecided.
    fn is_first(&self) -> Option<bool> {
        if self.is_dead {
            // It leaves at rest: where the sine is negative it sticks to the wall.
            match self.sin.sign()? {
                Ordering::Less => return Some(false),
                Ordering::Equal => return None,
                Ordering::Greater => {}
            }
        }
        let above_one = &self.drift - 1;
        if above_one.is_positive() {
            return Some(true);
        }
        let (a, sine, cosine) = critical(&self.drift)?;
        let turn = Real::pi(self.theta.bits()) * 2;
        // Both ends lie on rising pieces, around half a forcing period.
        // exact: shared by all members
        let [first, last] = [self.theta.clone(), self.theta + self.length].map(|end| end.over(&turn)?.floor());
        let (first, last) = (first?, last?);
        let mut answer = Some(true);
        for j in first + 1..=last {
            let level = &cosine * (&turn * j - self.theta) + self.sin;
            let swing = &cosine * &a - &sine;
            let least = &level + &swing;
            let room = self.ratio - (level - swing);
            if least.is_negative() || room.is_negative() {
                // There are extrema only if the drift is below 1.
                return above_one.is_negative().then_some(false);
            }
            if !(least.is_positive() && room.is_positive()) {
                answer = None;
            }
        }
        answer
    }
}
