//! One harmonic, equation (9).

use crate::error::Error;
use impact_pair_exact::{Exact, ExactError};

/// One harmonic: the displacement `A sin(W t + tau)` of the box. **Equation** (9)
#[derive(Clone, Debug)]
pub struct Harmonic {
    amplitude: Exact,
    frequency: Exact,
    phase: Exact,
}

impl Harmonic {
    /// The harmonic of amplitude `A >= 0` \[length\], angular frequency `W > 0` \[rad/time\] and phase `tau` \[rad\].
    ///
    /// # Errors
    /// If a value is out of range, or cannot be proved to be in range.
    pub fn new(amplitude: Exact, frequency: Exact, phase: Exact) -> Result<Self, Error> {
        Error::require_not_negative("excitation.amplitude", &amplitude)?;
        Error::require_positive("excitation.frequency", &frequency)?;
        Ok(Self { amplitude, frequency, phase })
    }

    /// The amplitude `A` \[length\].
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

    /// The time \[time\] near 0 at which `W t + tau` equals `phase` \[rad\].
    ///
    /// # Errors
    /// If the time exceeds the range of exact expressions.
    pub fn time_at(&self, phase: &Exact) -> Result<Exact, ExactError> {
        phase.checked_sub(&self.phase)?.checked_div(&self.frequency)
    }

    /// Whether no parameter is an interval.
    pub(crate) fn is_point(&self) -> bool {
        [&self.amplitude, &self.frequency, &self.phase].into_iter().all(Exact::is_point)
    }

    /// The harmonic with another amplitude.
    pub(super) fn with_amplitude(&self, amplitude: Exact) -> Self {
        Self { amplitude, ..self.clone() }
    }
}
