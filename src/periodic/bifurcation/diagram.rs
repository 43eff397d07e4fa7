//! The settings of a search for bifurcations, and its results.

use super::super::Precision;
use super::over::Parameter;
use super::point::{Kind, Point};
use crate::Error;
use crate::exact::Enclosure;
use crate::mapping::Word;
use crate::pair::ImpactPair;
use crate::scene::Range;
pub use impact_pair_model::vocabulary::BranchEnd;

/// The settings of a search for bifurcations.
#[derive(Clone, Debug)]
pub struct DiagramSettings {
    /// The parameter and its range.
    pub over: Range,
    /// Doublings up to which the branches that leave are followed.
    pub doublings: u32,
    /// Requested widths of the enclosures.
    pub precision: Precision,
}

/// A change of sign where no bifurcation could be proved.
#[derive(Clone, Debug)]
pub struct Unproved {
    /// The kind of bifurcation that it may be.
    pub kind: Kind,
    /// Approximate value, in the units of [`Point::parameter`], near which the sign changes.
    pub near: f64,
    /// The word that was followed.
    pub word: Word,
}

/// A branch as it was followed.
#[derive(Clone, Debug)]
pub struct Branch {
    /// The word of its orbits.
    pub word: Word,
    /// Their cycles.
    pub cycles: u32,
    /// `true` if they are their own mirror images.
    pub symmetric: bool,
    /// Approximate least and greatest value along the branch, in the units of [`Point::parameter`].
    pub range: [f64; 2],
    /// Ends of the branch.
    pub ends: [BranchEnd; 2],
    /// `true` if it is proved to be one curve all the way, each orbit of it the only one near it (Lemma Y6).
    pub is_proved: bool,
}

/// The bifurcations found along the branches of a word.
#[derive(Clone, Debug)]
pub struct Diagram {
    pub(super) parameter: Parameter,
    /// The bifurcations proved, in the order of the parameter.
    pub points: Vec<Point>,
    /// The changes of sign of which nothing could be proved.
    pub unproved: Vec<Unproved>,
    /// The branches followed.
    pub branches: Vec<Branch>,
    /// `true` if it was interrupted before all branches were followed and all points proved.
    pub interrupted: bool,
}

impl Diagram {
    /// An empty diagram over a parameter.
    pub(super) fn new(parameter: Parameter) -> Self {
        Self { parameter, points: Vec::new(), unproved: Vec::new(), branches: Vec::new(), interrupted: false }
    }

    /// The pair; the parameter's own value in this pair is not used.
    pub fn pair(&self) -> &ImpactPair {
        &self.parameter.pair
    }

    /// The parameter and its range.
    pub fn over(&self) -> &Range {
        &self.parameter.over
    }

    /// Encloses the parameter of a point in the units of the scene, and gives the pair with it.
    ///
    /// # Errors
    /// If the value exceeds the range of exact expressions.
    pub fn in_units(&self, point: &Point) -> Result<(Enclosure, ImpactPair), Error> {
        self.parameter.in_units(&point.parameter, point.bits)
    }

    /// Approximate values in the units of the scene for these values without units, the smaller one first.
    pub fn range_f64(&self, ends: [f64; 2]) -> [f64; 2] {
        self.parameter.range_f64(ends)
    }

    /// Whether each change of sign that was met is proved to be a bifurcation, to the requested width, and each branch was followed to its end.
    pub fn is_certified(&self) -> bool {
        let ends = |branch: &Branch| branch.ends.iter().all(|&end| end != BranchEnd::Lost);
        !self.interrupted
            && self.unproved.is_empty()
            && self.points.iter().all(|point| point.is_narrow && point.is_decided())
            && self.branches.iter().all(ends)
    }
}
