//! The values of an orbit from one manifold to the other, as boxes around a centre.

use crate::check::affine::Affine;
use crate::check::legs::{not_nothing, size};
use impact_pair_exact::Real;

/// Bits of the arithmetic.
pub(super) const BITS: u32 = 112;
/// Indices of an orbit's values: both manifold parameters, the parameter of the tangency and the other datum, then phases and speeds.
pub(super) const UNSTABLE: usize = 0;
pub(super) const STABLE: usize = 1;
pub(super) const PARAMETER: usize = 2;
pub(super) const OTHER: usize = 3;
pub(super) const STATES: usize = 4;
/// Indices of the parameters as coordinates of a flight: after phase and speed.
pub(super) const PARAMETER_COORDINATE: usize = 2;
pub(super) const OTHER_COORDINATE: usize = 3;

/// Phase and speed.
pub(super) type Vector = [Real; 2];

/// All vectors of values within the radii around a centre.
#[derive(Clone, Debug)]
pub(super) struct Area {
    pub centre: Vec<Real>,
    pub radii: Vec<Real>,
}

impl Area {
    /// The smallest area that holds the given bounds.
    pub fn of(bounds: &[Real]) -> Self {
        let centre: Vec<Real> = bounds.iter().map(Real::middle).collect();
        let radii = bounds.iter().zip(&centre).map(|(x, middle)| size(&(x.clone() - middle))).collect();
        Self { centre, radii }
    }

    /// The area of a single point.
    pub fn point(centre: Vec<Real>) -> Self {
        let radii = vec![Real::zero(BITS); centre.len()];
        Self { centre, radii }
    }

    /// Bounds of value `i`.
    pub fn hull(&self, i: usize) -> Real {
        self.centre[i].clone() + &Real::within(self.radii[i].enclosure().sup(), BITS)
    }

    /// Bounds of all values.
    pub fn hulls(&self) -> Vec<Real> {
        (0..self.centre.len()).map(|i| self.hull(i)).collect()
    }

    /// Value `i` as the coordinate `j` of a flight, varying over its radius.
    pub fn varied(&self, i: usize, j: usize) -> Affine {
        Affine::varied(self.centre[i].clone(), not_nothing(self.radii[i].clone()).enclosure().sup().clone(), j)
    }
}
