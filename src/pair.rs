//! The impact pair of figure 1: excitation, gap, restitution, and what is left of them without units.

use crate::error::Error;
use crate::exact::{Exact, ExactError};
use crate::excitation::{Excitation, Harmonic};
use crate::number::{Ball, LARGEST_RATE, Number};

/// A wall of the box.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Wall {
    /// `y = -d/2`: switch-plane Sigma-, arrivals with `v <= 0`.
    Left,
    /// `y = +d/2`: switch-plane Sigma+, arrivals with `v >= 0`.
    Right,
}

impl Wall {
    /// The opposite wall.
    pub fn other(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }

    /// `left` or `right`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
        }
    }

    /// `1` for the left wall, `-1` for the right one: the direction away from the wall.
    #[inline(always)]
    pub fn sign(self) -> f64 {
        match self {
            Self::Left => 1.0,
            Self::Right => -1.0,
        }
    }

    /// A component told from this wall: positive where it points away from it.
    #[inline(always)]
    pub fn inward<N: Number>(self, x: N) -> N {
        x.signed(self.sign())
    }

    /// The pair with the sign that mirrors flights from the right wall onto those from the left.
    #[inline(always)]
    pub fn mirror<N: Number>(self, (sin, cos): (N, N)) -> (N, N) {
        (self.inward(sin), self.inward(cos))
    }

    /// What mirroring adds to the phase, in turns.
    #[inline(always)]
    pub fn mirror_phase(self) -> f64 {
        match self {
            Self::Left => 0.0,
            Self::Right => 0.5,
        }
    }
}

/// All that the motion depends on once time is in turns and length in gaps.
#[derive(Clone, Copy, Debug)]
pub struct Reduced<N> {
    /// `A/d`
    pub alpha: N,
    /// `2 pi A/d`, the box's greatest speed in gaps a turn.
    pub beta: N,
    /// `e`
    pub restitution: N,
}

impl<N> Reduced<N> {
    /// The same parameters in another arithmetic.
    pub fn map<M>(&self, f: impl Fn(&N) -> M) -> Reduced<M> {
        Reduced { alpha: f(&self.alpha), beta: f(&self.beta), restitution: f(&self.restitution) }
    }
}

/// The impact law `v+ = -e v-`. **Equation** (15)
#[inline(always)]
pub fn rebound<N: Number>(restitution: &N, velocity_before: N) -> N {
    -(restitution.clone() * velocity_before)
}

/// The impact law over a ball; nothing is exactly nothing, so that a dead impact leaves at rest.
#[inline(always)]
pub(crate) fn rebound_of(restitution: Ball, before: Ball) -> Ball {
    let zero = Ball::exact(0.0);
    if restitution == zero || before == zero { zero } else { rebound(&restitution, before) }
}

impl<N: Number> Reduced<N> {
    /// The velocity after an impact. **Equation** (15)
    #[inline(always)]
    pub fn rebound(&self, velocity_before: N) -> N {
        rebound(&self.restitution, velocity_before)
    }
}

impl Reduced<Ball> {
    /// The same over a ball: see [`rebound_of`].
    #[inline(always)]
    pub(crate) fn rebound_of(&self, before: Ball) -> Ball {
        rebound_of(self.restitution, before)
    }

    /// The centres of the parameters, for the floating twin.
    #[inline(always)]
    pub fn centre(&self) -> Reduced<f64> {
        Reduced { alpha: self.alpha.mid(), beta: self.beta.mid(), restitution: self.restitution.mid() }
    }
}

/// A ball between two walls of a shaken box: **equations** (1), (14), (15).
///
/// ```
/// use impact_pair::{Harmonic, ImpactPair};
/// let harmonic = Harmonic::new("8".parse()?, "pi".parse()?, "0".parse()?)?;
/// let pair = ImpactPair::new(harmonic, "9.42497".parse()?, "0.5".parse()?)?;
/// assert!((pair.reduced()?.alpha.mid() - 8.0 / 9.42497).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct ImpactPair {
    excitation: Excitation,
    gap: Exact,
    restitution: Exact,
}

/// What stands behind `A/d`.
const RATIO: &str = "excitation.amplitude / pair.gap";

impl ImpactPair {
    /// A pair of this excitation, gap `d > 0` \[length\] and restitution `0 <= e <= 1`.
    ///
    /// # Errors
    /// When a value is not in its range, or cannot be proved to be.
    pub fn new(excitation: impl Into<Excitation>, gap: Exact, restitution: Exact) -> Result<Self, Error> {
        Error::require_positive("pair.gap", &gap)?;
        Error::require_range("pair.restitution", &restitution, 0, 1)?;
        Ok(Self { excitation: excitation.into(), gap, restitution })
    }

    /// The excitation (1).
    pub fn excitation(&self) -> &Excitation {
        &self.excitation
    }

    /// The excitation (9) of a pair that is shaken by one harmonic.
    ///
    /// # Errors
    /// When there are several: `what` is known of one only.
    pub fn harmonic(&self, what: &str) -> Result<&Harmonic, Error> {
        self.excitation.only().ok_or_else(|| Error::several(self.excitation.harmonics().len(), what))
    }

    /// The gap `d` \[length\].
    pub fn gap(&self) -> &Exact {
        &self.gap
    }

    /// The coefficient of restitution `e`.
    pub fn restitution(&self) -> &Exact {
        &self.restitution
    }

    /// Whether no parameter is an interval of values.
    pub fn is_point(&self) -> bool {
        self.excitation.is_point() && self.gap.is_point() && self.restitution.is_point()
    }

    /// Encloses the parameters without units in double precision.
    ///
    /// # Errors
    /// When `A/d` is beyond `2^400`, or there are several harmonics.
    pub fn reduced(&self) -> Result<Reduced<Ball>, Error> {
        let Reduced { alpha, beta, restitution } = self.exact()?;
        let (alpha, beta) = (ball(RATIO, &alpha)?, ball(RATIO, &beta)?);
        Ok(Reduced { alpha, beta, restitution: ball("pair.restitution", &restitution)? })
    }

    /// The parameters without units, exactly.
    ///
    /// # Errors
    /// When `A/d` is beyond what exact expressions hold, or there are several harmonics.
    pub fn exact(&self) -> Result<Reduced<Exact>, Error> {
        let amplitude = self.harmonic("the pair without units")?.amplitude();
        let alpha = within(RATIO, amplitude, amplitude.checked_div(&self.gap))?;
        let beta = within(RATIO, amplitude, alpha.checked_mul(&(Exact::pi() * Exact::from(2))))?;
        Ok(Reduced { alpha, beta, restitution: self.restitution.clone() })
    }
}

/// A value computed from `of`, which stands at `key`.
///
/// # Errors
/// When it is beyond what exact expressions hold.
pub(crate) fn within<T>(key: &'static str, of: &Exact, value: Result<T, ExactError>) -> Result<T, Error> {
    value.map_err(|reason| Error::range(key, of, &reason.to_string()))
}

/// A ball around an exact value without units.
///
/// # Errors
/// When the value is too large for the arithmetic of a flight.
pub(crate) fn ball(key: &'static str, value: &Exact) -> Result<Ball, Error> {
    let ball = Ball::of(value);
    if ball.mid().abs() + ball.rad() <= LARGEST_RATE { Ok(ball) } else { Err(Error::too_large(key, value)) }
}
