//! The impact pair of figure 1, and its dimensionless parameters.

use crate::Error;
use crate::exact::Exact;
use crate::number::{Ball, LARGEST_RATE, Number};
use crate::units::{in_gaps, turn};
pub(crate) use impact_pair_model::within;
pub use impact_pair_model::{ImpactPair, Wall};

/// Components measured from a wall.
pub trait Inward {
    /// A component measured from this wall: positive where it points away from the wall.
    fn inward<N: Number>(self, x: N) -> N;
    /// The pair with the sign that mirrors flights from the right wall onto those from the left.
    fn mirror<N: Number>(self, sin_cos: (N, N)) -> (N, N);
}

impl Inward for Wall {
    #[inline(always)]
    fn inward<N: Number>(self, x: N) -> N {
        x.signed(self.sign())
    }

    #[inline(always)]
    fn mirror<N: Number>(self, (sin, cos): (N, N)) -> (N, N) {
        (self.inward(sin), self.inward(cos))
    }
}

/// Quotient that errors name.
const RATIO: &str = "excitation.amplitude / pair.gap";

/// The dimensionless parameters of the motion: time in forcing periods, length in gaps.
#[derive(Clone, Copy, Debug)]
pub struct Reduced<N> {
    /// `A/d`
    pub alpha: N,
    /// `2 pi A/d`, the box's greatest speed in gap widths per forcing period.
    pub beta: N,
    /// `e`
    pub restitution: N,
}

impl Reduced<Exact> {
    /// Exact dimensionless parameters of a pair.
    ///
    /// # Errors
    /// If `A/d` exceeds the range of exact expressions, or there are several harmonics.
    ///
    /// ```
    /// use impact_pair::pair::Reduced;
    /// use impact_pair::{Harmonic, ImpactPair};
    /// let harmonic = Harmonic::new("8".parse()?, "pi".parse()?, "0".parse()?)?;
    /// let pair = ImpactPair::new(harmonic, "9.42497".parse()?, "0.5".parse()?)?;
    /// assert!((Reduced::exact(&pair)?.enclosed()?.alpha.mid() - 8.0 / 9.42497).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn exact(pair: &ImpactPair) -> Result<Self, Error> {
        let amplitude = pair.harmonic("the pair without units")?.amplitude();
        let alpha = in_gaps(RATIO, amplitude, pair)?;
        let beta = within(RATIO, amplitude, alpha.checked_mul(&turn()))?;
        Ok(Self { alpha, beta, restitution: pair.restitution().clone() })
    }

    /// Encloses the parameters in double precision.
    ///
    /// # Errors
    /// If `A/d` is beyond `2^400`.
    pub fn enclosed(&self) -> Result<Reduced<Ball>, Error> {
        let (alpha, beta) = (ball(RATIO, &self.alpha)?, ball(RATIO, &self.beta)?);
        Ok(Reduced { alpha, beta, restitution: ball("pair.restitution", &self.restitution)? })
    }
}

impl<N> Reduced<N> {
    /// The parameters in another arithmetic.
    pub fn map<M>(&self, f: impl Fn(&N) -> M) -> Reduced<M> {
        Reduced { alpha: f(&self.alpha), beta: f(&self.beta), restitution: f(&self.restitution) }
    }
}

/// Newton's impact law `v+ = -e v-`. **Equation** (15)
#[inline(always)]
pub fn rebound<N: Number>(restitution: &N, velocity_before: N) -> N {
    -(restitution.clone() * velocity_before)
}

/// Newton's impact law over a ball; an exact 0 stays exactly 0, so that a perfectly plastic impact leaves the ball at rest.
#[inline(always)]
pub(crate) fn rebound_of(restitution: Ball, before: Ball) -> Ball {
    let zero = Ball::exact(0.0);
    if restitution == zero || before == zero { zero } else { rebound(&restitution, before) }
}

impl<N: Number> Reduced<N> {
    /// Parameters with these `A/d` and `e`.
    pub fn new(alpha: N, restitution: N) -> Self {
        Self { beta: alpha.turn() * alpha.clone(), alpha, restitution }
    }

    /// Velocity after an impact. **Equation** (15)
    #[inline(always)]
    pub fn rebound(&self, velocity_before: N) -> N {
        rebound(&self.restitution, velocity_before)
    }
}

impl Reduced<Ball> {
    /// Velocity after an impact, over a ball: see [`rebound_of`].
    #[inline(always)]
    pub(crate) fn rebound_of(&self, before: Ball) -> Ball {
        rebound_of(self.restitution, before)
    }

    /// A power of two near the velocities after this one: the unit of velocities in sets.
    pub(crate) fn scale(&self, velocity: Ball) -> f64 {
        let speed = self.beta.mag().max(velocity.mag()).clamp(1.0 / LARGEST_RATE, LARGEST_RATE); // S2: any power of two
        2f64.powi(speed.log2().round() as i32) // S2: any power of two
    }

    /// Centres of the parameters, for flights in floating point.
    #[inline(always)]
    pub fn centre(&self) -> Reduced<f64> {
        Reduced { alpha: self.alpha.mid(), beta: self.beta.mid(), restitution: self.restitution.mid() }
    }
}

/// A ball around an exact value without units.
///
/// # Errors
/// If the value is too large for the arithmetic of a flight.
pub(crate) fn ball(key: &'static str, value: &Exact) -> Result<Ball, Error> {
    let ball = Ball::of(value);
    if ball.mid().abs() + ball.rad() <= LARGEST_RATE { Ok(ball) } else { Err(too_large(key, value)) }
}

/// Error about a value that is too large for the arithmetic of a flight.
pub(crate) fn too_large(key: &str, value: &Exact) -> Error {
    Error::range(key, value, "double-precision flights accept at most 2^400 in units of gap widths and forcing periods")
}
