//! The proof of one orbit in a build without multiprecision: doubles are all there is.

use super::super::chained::Chained;
use super::super::orbit::PeriodicOrbit;
use super::super::{Precision, Problem};

impl Problem {
    /// Returns the orbit that doubles prove.
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

    /// Returns whether a guess settles on a known orbit in more than doubles: none does.
    pub(in super::super) fn settles_on_known<S: Chained>(&self, _: &S, _: &[f64], _: &[PeriodicOrbit]) -> bool {
        false
    }
}
