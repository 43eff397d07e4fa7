//! Proofs of bifurcations in a build without multiprecision: doubles are all there is.

use super::super::super::precondition::Preconditioner;
use super::super::between::Between;
use super::super::family::Varied;
use super::super::point::Point;
use super::Claim;

impl<S: Varied> Claim<'_, S> {
    /// Gives back the point that doubles prove, if any.
    pub(super) fn prove_precisely(
        &self,
        _: &Preconditioner,
        _: (&[f64], f64),
        _: bool,
        best: Option<Point>,
    ) -> Option<Point> {
        best
    }
}

impl Between<'_> {
    /// Refuses: doubles did not prove the orbits, and this build has no more bits.
    pub fn prove_precisely(&self) -> Result<(), &'static str> {
        Err("they are not proved in doubles")
    }
}
