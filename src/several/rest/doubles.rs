//! Releases in a build without multiprecision.

use std::sync::Arc;

use super::super::spectrum::Spectrum;
use super::{Unproved, Zero};
use crate::exact::Enclosure;
use crate::pair::Wall;

/// Gives back `found`: without multiprecision an undecided release stays undecided.
pub(super) fn decided(
    found: Result<Zero, Unproved>,
    _: &Arc<Spectrum>,
    _: Wall,
    _: i64,
    _: f64,
) -> Result<Zero, Unproved> {
    found
}

/// Encloses the phase of a release in doubles.
pub(super) fn enclosure(zero: &Zero, _: u32) -> Option<Enclosure> {
    zero.phase().enclosure()
}
