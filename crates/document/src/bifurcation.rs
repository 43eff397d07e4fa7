//! The bifurcation JSON, schema `impact-pair/bifurcations/1`.

use impact_pair_model::scene::Range;
use impact_pair_model::vocabulary::{Bifurcation, BranchEnd};
use serde::{Deserialize, Serialize};

use super::number::{Bounds, Written};
use super::periodic::PeriodicOrbitDocument;
use super::scene::SceneDocument;

/// The schema of the bifurcation JSON.
pub const BIFURCATION_SCHEMA: &str = "impact-pair/bifurcations/1";

/// Bifurcations of a word's orbits over a parameter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct BifurcationDocument {
    /// Schema of the document: [`BIFURCATION_SCHEMA`].
    pub schema: String,
    /// Name and version of the program, such as `impact-pair 0.1.0`.
    pub program: String,
    /// The scene; its own value of the parameter is not used.
    pub scene: SceneDocument,
    /// The requested word.
    pub word: String,
    /// Forcing periods of the orbit.
    pub cycles: u32,
    /// Parameter over which branches are followed, and its range.
    pub over: ParameterRange,
    /// Always false: each point is proved, completeness is not.
    pub exhaustive: bool,
    /// Whether all points found are proved.
    pub certified: bool,
    /// Whether the run was interrupted before all branches were followed and all points proved.
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    pub interrupted: bool,
    /// The bifurcations.
    pub points: Vec<BifurcationPointDocument>,
    /// The branches, followed in floating point.
    pub branches: Vec<BranchDocument>,
    /// Bifurcations found but undecided.
    pub undecided: Vec<UnprovedDocument>,
}

/// A range of a parameter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ParameterRange {
    /// `excitation.amplitude`, with several terms followed by a number, `excitation.frequency`, `pair.gap` or `pair.restitution`.
    pub key: String,
    /// Lower end of the range.
    pub low: Written,
    /// Upper end of the range.
    pub high: Written,
}

impl From<&Range> for ParameterRange {
    fn from(range: &Range) -> Self {
        Self { key: range.key().place(), low: range.low().into(), high: range.high().into() }
    }
}

/// A bifurcation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct BifurcationPointDocument {
    /// Kind of the bifurcation.
    pub kind: Bifurcation,
    /// The value of the parameter.
    pub parameter: Bounds,
    /// The word of the orbit.
    pub word: String,
    /// Forcing periods of the orbit.
    pub cycles: u32,
    /// Number of doublings of the requested word.
    pub doublings: u32,
    /// The orbit.
    pub orbit: PeriodicOrbitDocument,
}

/// A branch. Only that it is one curve is certified, if `proved`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct BranchDocument {
    /// The word of its orbits.
    pub word: String,
    /// Forcing periods of its orbits.
    pub cycles: u32,
    /// Whether they are their own mirror images.
    pub symmetric: bool,
    /// The range of the parameter on it.
    pub parameter: [f64; 2],
    /// The reasons why it ends.
    pub ends: [BranchEnd; 2],
    /// Whether it is proved to be one curve.
    pub proved: bool,
}

/// An undecided bifurcation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct UnprovedDocument {
    /// Its possible kind.
    pub kind: Bifurcation,
    /// Approximate value of the parameter.
    pub near: f64,
    /// The word of the orbit.
    pub word: String,
}
