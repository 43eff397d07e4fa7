//! The proof of one orbit in a build without multiprecision: doubles are all there is.

use super::super::chained::Chained;
use super::super::orbit::PeriodicOrbit;
use super::super::{Precision, Problem};

impl Problem {
    /// Gives back the orbit that doubles prove, if any.
    pub(super) fn prove_precisely<S: Chained>(
        &self,
        _: &S,
        _: &[f64],
        _: Precision,
        _: bool,
        best: Option<PeriodicOrbit>,
    ) -> Option<PeriodicOrbit> {
        best
    }

    /// Whether a guess settles on a known orbit in more than doubles: `false`, as this build has doubles only.
    pub(in super::super) fn settles_on_known<S: Chained>(&self, _: &S, _: &[f64], _: &[PeriodicOrbit]) -> bool {
        false
    }
}
