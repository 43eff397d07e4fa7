//! The excitation, as chains of impacts see it: one harmonic, equation (9), or several, equation (1).
//!
//! The equations of a chain ([`crate::periodic::legs`]) are the same for both; here stand the terms in which they differ.

use crate::flight::velocity_after;
use crate::number::kernel::SmallAngle;
use crate::number::{Number, Wave};
use crate::pair::Reduced;

/// The motion of the box and the restitution, in gap widths and forcing periods.
pub trait Shaking<N: Number> {
    /// The state of the box at one time.
    type Moment: Clone;

    /// `e`
    fn restitution(&self) -> &N;
    /// State of the box at the phase `rest` after `turns` whole forcing periods.
    fn moment(&self, turns: f64, rest: &N) -> Self::Moment;
    /// `D + E_1 - E_0`: the ball's displacement in space, for a displacement `displacement` in the box. **Equation** (11)
    fn travel(&self, from: &Self::Moment, to: &Self::Moment, displacement: f64) -> N;
    /// `y' = c - E'` of a ball with this drift. **Equation** (12)
    fn relative(&self, drift: &N, at: &Self::Moment) -> N;
    /// `y'' = -E''` **Equation** (10)
    fn acceleration(&self, at: &Self::Moment) -> N;
    /// A short flight back to its wall; `None` where [`Wave::short`] knows no departure.
    fn hop(&self, time: &N, from: &Self::Moment) -> Option<Hop<N>>;
}

/// The period after which an excitation repeats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Repetition {
    /// The common period of all harmonics, in periods of the fastest: 1 of one harmonic.
    pub turns: u32,
    /// True if each harmonic is its own opposite half that period later: then the mirrored motion is also a motion. `None` if this holds for some
    /// parameters at most: where an amplitude may be 0, and the other harmonics alone may be odd.
    pub is_odd: Option<bool>,
}

impl Repetition {
    /// The repetition of one harmonic.
    pub const ONE_PERIOD: Self = Self { turns: 1, is_odd: Some(true) };
}

/// The velocities of a short flight back to its wall.
#[derive(Clone, Debug)]
pub struct Hop<N> {
    /// The absolute velocity.
    pub drift: N,
    /// `y'` right after the impact at the start.
    pub after: N,
    /// `y'` just before the impact at the end.
    pub before: N,
}

impl<N: Wave> Shaking<N> for Reduced<N> {
    /// Sine and cosine of the phase.
    type Moment = (N, N);

    #[inline(always)]
    fn restitution(&self) -> &N {
        &self.restitution
    }
    #[inline(always)]
    fn moment(&self, _: f64, rest: &N) -> (N, N) {
        rest.wave()
    }
    #[inline(always)]
    fn travel(&self, (sin0, _): &(N, N), (sin1, _): &(N, N), displacement: f64) -> N {
        self.alpha.clone().mul_add(sin1.clone() - sin0.clone(), N::from_f64(displacement))
    }
    #[inline(always)]
    fn relative(&self, drift: &N, (_, cos): &(N, N)) -> N {
        (-self.beta.clone()).mul_add(cos.clone(), drift.clone())
    }
    #[inline(always)]
    fn acceleration(&self, (sin, _): &(N, N)) -> N {
        self.beta.turn() * self.beta.clone() * sin.clone()
    }
    #[inline(always)]
    fn hop(&self, time: &N, (sin, cos): &(N, N)) -> Option<Hop<N>> {
        let SmallAngle { versine, excess, sine } = time.short()?;
        let wave = cos.clone().mul_add(excess, sin.clone() * versine.clone());
        let after = -(self.alpha.clone() * wave).checked_div(time.clone())?;
        let drift = self.beta.clone().mul_add(cos.clone(), after.clone());
        let before = velocity_after(self.beta.clone(), after.clone(), (sin.clone(), cos.clone()), versine, sine);
        Some(Hop { drift, after, before })
    }
}
