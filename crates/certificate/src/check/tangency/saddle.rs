//! The paper's equispaced orbit as a fixed point of the reduced map, and its eigenvalues, over values of `D` (Lemma V17).

use super::jet::Jet;
use crate::check::affine::Affine;
use impact_pair_exact::Real;

/// Steps of Newton's iteration from a claimed phase.
const STEPS: u32 = 64;
/// The widest neighbourhood of a fixed point that is tried, as a power of 2.
const WIDEST: i64 = -3;

/// Coefficient of restitution and what follows from it.
#[derive(Clone, Debug)]
pub(super) struct Law {
    /// `e`
    pub e: Real,
    /// `kappa = (1 + e)/(1 - e)`
    pub kappa: Real,
    pub pi: Real,
}

/// The fixed point as functions of `D`.
pub(super) struct Saddle {
    /// `theta`, the phase of its impacts.
    pub phase: Jet,
    /// The eigenvalue outside the unit circle.
    pub unstable: Jet,
    /// The eigenvalue inside it.
    pub stable: Jet,
}

impl Law {
    /// Of `0 < e < 1`.
    pub fn new(e: Real) -> Option<Self> {
        let one = Real::int(1, e.bits());
        let kappa = (one.clone() + &e).over(&(one - &e))?;
        Some(Self { pi: Real::pi(e.bits()), e, kappa })
    }

    pub fn bits(&self) -> u32 {
        self.e.bits()
    }

    /// `pi kappa cos theta + 2 sin theta`. **Equation** (67)
    pub fn gap(&self, phase: &Real) -> Real {
        let (s, c) = phase.sin_cos();
        self.pi.clone() * &self.kappa * &c + &(s * 2)
    }

    /// Its derivative.
    pub fn gap_slope(&self, phase: &Real) -> Real {
        let (s, c) = phase.sin_cos();
        c * 2 - &(self.pi.clone() * &self.kappa * &s)
    }

    /// The fixed point with the phase next to a guess, for all `gap`; `None` where none is proved.
    fn phase(&self, gap: &Real, guess: &Real) -> Option<Real> {
        let middle = gap.middle();
        let mut at = guess.middle();
        for _ in 0..STEPS {
            let step = (self.gap(&at) - &middle).over(&self.gap_slope(&at))?.middle();
            at = (at - &step).middle();
            if step.enclosure().mag().top().is_none_or(|top| top < 8 - i64::from(self.bits())) {
                break;
            }
        }
        let mut reach = Real::int(1, self.bits());
        (0..self.bits()).for_each(|_| reach = reach.half());
        // Interval Newton: it maps a neighbourhood into itself.
        while reach.enclosure().mag().top().is_none_or(|top| top < WIDEST) {
            let around = at.clone() + &Real::within(reach.enclosure().sup(), self.bits());
            let found = at.clone() - &(self.gap(&at) - gap).over(&self.gap_slope(&around))?;
            if (at.clone() - &reach).is_below(&found) && found.is_below(&(at.clone() + &reach)) {
                return Some(found);
            }
            reach = reach * 2;
        }
        None
    }

    /// Returns the fixed point with the phase next to a guess, for all `gap`; `None` where it is not proved to be a saddle.
    pub fn saddle(&self, gap: &Affine, guess: &Real) -> Option<Saddle> {
        let bits = self.bits();
        let everywhere = self.phase(&gap.hull(), guess)?;
        let centre = if gap.is_fixed() { everywhere.clone() } else { self.phase(&gap.centre, &everywhere)? };
        // The zero in the middle is the one of the neighbourhood in which there is one only, for each of the values.
        if !everywhere.enclosure().contains_enclosure(centre.enclosure()) {
            return None;
        }
        let one = Real::int(1, bits);
        let slope = one.over(&self.gap_slope(&everywhere))?;
        let value = Affine::of(centre, &[(&slope, gap)]);
        let (s, c) = Jet::constant_of(value.clone()).sin_cos(bits);
        let steep = c.times_integer(2).minus(&s.times_real(&(self.pi.clone() * &self.kappa)));
        let derivative = Jet::constant(one.clone()).over(&steep, bits)?.value(bits);
        let phase = Jet::with_slope(value, derivative);
        let (s, c) = phase.sin_cos(bits);
        let tangent = s.over(&c, bits)?;
        // The trace is 2 e + (pi/2)(1 - e^2) tan theta, the determinant e^2.
        let factor = (self.pi.clone() * &(one.clone() - &self.e.square())).half();
        let half = tangent.times_real(&factor.half()).plus(&Jet::constant(self.e.clone()));
        let square = Jet::constant(self.e.square());
        let root = half.times(&half).minus(&square).sqrt(bits)?;
        let unstable = if half.value(bits).hull().is_positive() { half.plus(&root) } else { half.minus(&root) };
        let stable = square.over(&unstable, bits)?;
        let size = |x: &Jet| Real::point(x.value(bits).hull().enclosure().mag(), bits);
        let is_saddle = one.square().is_below(&unstable.value(bits).hull().square()) && size(&stable).is_below(&one);
        (is_saddle && c.value(bits).hull().is_positive()).then_some(Saddle { phase, unstable, stable })
    }

    /// `w = 2 cos(theta)/(1 - e)`, the speed before its impacts. **Equation** (66)
    pub fn speed(&self, phase: &Real) -> Option<Real> {
        (phase.cos() * 2).over(&(Real::int(1, self.bits()) - &self.e))
    }
}
