//! A periodic orbit in the units of the scene: as shown in tables and the periodic JSON, for any word.

use impact_pair_document::MeasuredImpact;

use super::stability::{Eigenvalue, Stability};
use crate::exact::Enclosure;
use crate::pair::Wall;

/// A periodic orbit in the units of the scene, with all that is proved of it.
///
/// **Enclosure**: for every choice of the parameters, exactly one orbit lies within the bounds, and all enclosures are of it.
#[derive(Clone, Debug)]
pub struct MeasuredOrbit {
    /// Forcing periods of the fastest harmonic after which the excitation repeats: 1 with one harmonic.
    pub period: u32,
    /// The impacts, in time order.
    pub impacts: Vec<MeasuredImpact<Enclosure>>,
    /// `true` if no other orbit of its word in as many cycles lies within the bounds.
    pub unique: bool,
    /// `Some(true)`: no wall is touched between the impacts; `Some(false)`: one is; `None`: undecided.
    pub physical: Option<bool>,
    /// `Some(true)`: it is its own mirror image; `Some(false)`: it is not; `None`: undecided.
    pub symmetric: Option<bool>,
    /// Number of times that it runs through a shorter orbit: 1 when it does not; `None`: undecided (Lemma T6).
    pub times: Option<u32>,
    /// The trace of the Jacobian (A.7) over a period.
    pub trace: Enclosure,
    /// Determinant of this Jacobian, `e^(2k)` after `k` impacts.
    pub determinant: Enclosure,
    /// Eigenvalues of this Jacobian (38).
    pub eigenvalues: [Eigenvalue; 2],
    /// Stability.
    pub stability: Stability,
}

impl MeasuredOrbit {
    /// The orbit listed from the first impact on this wall; unchanged if there is none.
    pub fn listed_from(&self, wall: Wall) -> Self {
        let first = self.impacts.iter().position(|impact| impact.wall == wall);
        let mut listed = self.clone();
        listed.impacts.rotate_left(first.unwrap_or(0)); // shown
        listed
    }
}
