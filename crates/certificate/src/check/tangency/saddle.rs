//! The paper's equispaced orbit as a fixed point of the reduced map, and its eigenvalues, over values of the parameter (Lemmas V17, V29).

use super::jet::{D, Jet};
use crate::check::affine::Affine;
use impact_pair_exact::Real;

/// Steps of Newton's iteration from a claimed phase.
const STEPS: u32 = 64;
/// log2 of the greatest width of a neighbourhood of a fixed point that is tried.
const MAX_WIDTH_EXPONENT: i64 = -3;

/// A family of reduced maps: whether `D = d/A` or `e` is the parameter, and the value of the other.
#[derive(Clone, Debug)]
pub(in crate::check) struct Family {
    pub is_restitution: bool,
    pub other: Real,
}

/// The data of the reduced maps for a set of values of the parameter, as jets in the parameter.
#[derive(Clone, Debug)]
pub(in crate::check) struct Law {
    /// `D`
    pub gap: Jet,
    /// `e`
    pub e: Jet,
    pub parameter: Affine,
    pub pi: Real,
}

/// The fixed point as a function of the parameter.
pub(super) struct Saddle {
    /// `theta`, the phase of its impacts.
    pub phase: Jet,
    /// The eigenvalue outside the unit circle.
    pub unstable: Jet,
    /// The eigenvalue inside the unit circle.
    pub stable: Jet,
}

impl Family {
    pub fn bits(&self) -> u32 {
        self.other.bits()
    }

    /// The data for values of the parameter; `None` unless `0 < e < 1` and `D > 0` are proved.
    pub fn law(&self, parameter: &Affine) -> Option<Law> {
        let one = Affine::fixed(Real::int(1, self.bits()));
        self.law_of(parameter, Jet::with_slope(parameter.clone(), one))
    }

    /// The data for values of the parameter, without derivatives by the parameter.
    pub fn law_without_slope(&self, parameter: &Affine) -> Option<Law> {
        self.law_of(parameter, Jet::constant_of(parameter.clone()))
    }

    fn law_of(&self, parameter: &Affine, varied: Jet) -> Option<Law> {
        let fixed = Jet::constant(self.other.clone());
        let [gap, e] = if self.is_restitution { [fixed, varied] } else { [varied, fixed] };
        Law { gap, e, parameter: parameter.clone(), pi: Real::pi(self.bits()) }.proved()
    }

    /// The data for all values of the parameter in a set.
    pub fn law_over(&self, parameter: &Real) -> Option<Law> {
        let middle = parameter.middle();
        let off = (parameter.clone() - &middle).enclosure().mag();
        self.law(&if off.is_zero() { Affine::fixed(middle) } else { Affine::varied(middle, off, 0) })
    }
}

impl Law {
    /// The data for values of the parameter and of the other datum, without derivatives.
    pub(super) fn of_both(is_restitution: bool, parameter: Affine, other: Affine) -> Option<Self> {
        let bits = parameter.centre.bits();
        let [gap, e] = if is_restitution { [&other, &parameter] } else { [&parameter, &other] };
        let [gap, e] = [gap, e].map(|x| Jet::constant_of(x.clone()));
        Self { gap, e, parameter, pi: Real::pi(bits) }.proved()
    }

    /// The data, if they are proved to satisfy `0 < e < 1` and `D > 0`.
    fn proved(self) -> Option<Self> {
        let (gap, e) = (self.gap_hull(), self.e_hull());
        (gap.is_positive() && e.is_positive() && e.is_below(&Real::int(1, self.bits()))).then_some(self)
    }

    pub fn bits(&self) -> u32 {
        self.pi.bits()
    }

    /// Encloses all `D`.
    pub fn gap_hull(&self) -> Real {
        self.gap.value(self.bits()).hull()
    }

    /// Encloses all `e`.
    pub fn e_hull(&self) -> Real {
        self.e.value(self.bits()).hull()
    }

    /// `kappa = (1 + e)/(1 - e)`
    fn kappa(&self) -> Option<Jet> {
        let one = Jet::constant(Real::int(1, self.bits()));
        one.plus(&self.e).over(&one.minus(&self.e), self.bits())
    }

    /// Encloses `pi kappa` for all `e`.
    pub fn pi_kappa(&self) -> Option<Real> {
        Some(self.pi.clone() * &self.kappa()?.value(self.bits()).hull())
    }

    /// The law at the middle of the parameter's values.
    fn middle(&self) -> Self {
        let fixed = |x: &Jet| Jet::constant(x.value(self.bits()).centre);
        let parameter = Affine::fixed(self.parameter.centre.clone());
        Self { gap: fixed(&self.gap), e: fixed(&self.e), parameter, pi: self.pi.clone() }
    }

    /// The fixed point with the phase next to a guess, for all values; `None` if none is proved. **Equation** (67)
    fn phase(&self, guess: &Real) -> Option<Real> {
        let (pi_kappa, gap) = (self.pi_kappa()?, self.gap_hull());
        let miss = |phase: &Real| {
            let (s, c) = phase.sin_cos();
            pi_kappa.clone() * &c + &(s * 2) - &gap
        };
        let slope = |phase: &Real| {
            let (s, c) = phase.sin_cos();
            c * 2 - &(pi_kappa.clone() * &s)
        };
        let mut at = guess.middle();
        for _ in 0..STEPS {
            let step = miss(&at).middle().over(&slope(&at).middle())?.middle();
            at = (at - &step).middle();
            if step.enclosure().mag().top().is_none_or(|top| top < 8 - i64::from(self.bits())) {
                break;
            }
        }
        let mut reach = Real::int(1, self.bits());
        (0..self.bits()).for_each(|_| reach = reach.half());
        // Interval Newton maps a neighbourhood into itself.
        while reach.enclosure().mag().top().is_none_or(|top| top < MAX_WIDTH_EXPONENT) {
            let around = at.clone() + &Real::within(reach.enclosure().sup(), self.bits());
            let found = at.clone() - &miss(&at).over(&slope(&around))?;
            if (at.clone() - &reach).is_below(&found) && found.is_below(&(at.clone() + &reach)) {
                return Some(found);
            }
            reach = reach * 2;
        }
        None
    }

    /// The derivative of the phase of the fixed point by the parameter, at phases.
    fn phase_slope(&self, phase: Affine) -> Option<Affine> {
        let bits = self.bits();
        let pi_kappa = self.kappa()?.times_real(&self.pi);
        let (s, c) = Jet::constant_of(phase).sin_cos(bits);
        let miss = pi_kappa.times(&c).plus(&s.times_integer(2)).minus(&self.gap);
        let steep = c.times_integer(2).minus(&pi_kappa.times(&s));
        let [miss, steep] = [miss.at(D, bits), steep.value(bits)].map(Jet::constant_of);
        Some(miss.times_integer(-1).over(&steep, bits)?.value(bits))
    }

    /// The fixed point with the phase next to a guess, for all values; `None` if it is not proved to be a saddle.
    pub(super) fn saddle(&self, guess: &Real) -> Option<Saddle> {
        let bits = self.bits();
        let everywhere = self.phase(guess)?;
        let centre = if self.parameter.is_fixed() { everywhere.clone() } else { self.middle().phase(&everywhere)? };
        // The zero at the middle is the zero in the neighbourhood, which has exactly one zero for each value.
        if !everywhere.enclosure().contains_enclosure(centre.enclosure()) {
            return None;
        }
        let one = Real::int(1, bits);
        let slope = self.phase_slope(Affine::fixed(everywhere))?.hull();
        let value = Affine::of(centre, &[(&slope, &self.parameter)]);
        let phase = Jet::with_slope(value.clone(), self.phase_slope(value)?);
        let (s, c) = phase.sin_cos(bits);
        let tangent = s.over(&c, bits)?;
        // The trace is 2 e + (pi/2)(1 - e^2) tan theta, the determinant e^2.
        let square = self.e.times(&self.e);
        let quarter = self.pi.half().half();
        let half = Jet::constant(one.clone()).minus(&square).times_real(&quarter).times(&tangent).plus(&self.e);
        let root = half.times(&half).minus(&square).sqrt(bits)?;
        let unstable = if half.value(bits).hull().is_positive() { half.plus(&root) } else { half.minus(&root) };
        let stable = square.over(&unstable, bits)?;
        let size = |x: &Jet| Real::point(x.value(bits).hull().enclosure().mag(), bits);
        let is_saddle = one.square().is_below(&unstable.value(bits).hull().square()) && size(&stable).is_below(&one);
        (is_saddle && c.value(bits).hull().is_positive()).then_some(Saddle { phase, unstable, stable })
    }

    /// `w = 2 cos(theta)/(1 - e)`, the speed before the saddle's impacts. **Equation** (66)
    pub fn speed(&self, phase: &Real) -> Option<Real> {
        (phase.cos() * 2).over(&(Real::int(1, self.bits()) - &self.e_hull()))
    }
}
