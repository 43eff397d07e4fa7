//! The motion of the box, equations (1) and (9): `E(t) = A sin(W t + tau)`.

use crate::error::Error;
use crate::exact::Exact;
use crate::number::Number;

/// One harmonic: the displacement `A sin(W t + tau)` of the box. **Equation** (9)
#[derive(Clone, Debug)]
pub struct Harmonic {
    amplitude: Exact,
    frequency: Exact,
    phase: Exact,
}

impl Harmonic {
    /// A harmonic of amplitude `A >= 0` \[length\], angular frequency `W > 0` \[rad/time\] and phase `tau` \[rad\].
    ///
    /// # Errors
    /// When a value is not in its range, or cannot be proved to be.
    pub fn new(amplitude: Exact, frequency: Exact, phase: Exact) -> Result<Self, Error> {
        Error::require_not_negative("excitation.amplitude", &amplitude)?;
        Error::require_positive("excitation.frequency", &frequency)?;
        Ok(Self { amplitude, frequency, phase })
    }

    /// `A` \[length\]
    pub fn amplitude(&self) -> &Exact {
        &self.amplitude
    }

    /// `W` \[rad/time\]
    pub fn frequency(&self) -> &Exact {
        &self.frequency
    }

    /// `tau` \[rad\]
    pub fn phase(&self) -> &Exact {
        &self.phase
    }
}

/// `E/d`, `E'/d` and `E''/d` at the phase of the given sine and cosine, per turn and turn squared.
///
/// **Equation** (9) and its derivatives; `alpha = A/d`.
pub fn displacement_velocity_acceleration<N: Number + Copy>(alpha: N, (sin, cos): (N, N)) -> (N, N, N) {
    let turn = alpha.turn();
    let displacement = alpha * sin;
    (displacement, turn * alpha * cos, -(turn * turn * displacement))
}
