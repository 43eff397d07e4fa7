//! The bifurcation JSON, schema `impact-pair/bifurcations/1`.

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
    /// [`BIFURCATION_SCHEMA`]
    pub schema: String,
    /// What proved them.
    pub program: String,
    /// Whose they are; the parameter's own value in it only names the scene.
    pub scene: SceneDocument,
    /// The word asked for.
    pub word: String,
    /// Its cycles.
    pub cycles: u32,
    /// The parameter and its range.
    pub over: ParameterRange,
    /// Never: each point is proved, that there are no others is not.
    pub exhaustive: bool,
    /// Whether all points that were found are proved.
    pub certified: bool,
    /// Whether it ended before all was followed and proved: others are left.
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    pub interrupted: bool,
    /// The bifurcations.
    pub points: Vec<BifurcationPointDocument>,
    /// The branches as they were followed, in floats.
    pub branches: Vec<BranchDocument>,
    /// What was found and is not proved.
    pub undecided: Vec<UnprovedDocument>,
}

/// A range of a parameter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ParameterRange {
    /// `excitation.amplitude`, of several terms with a number, `excitation.frequency`, `pair.gap` or `pair.restitution`.
    pub key: String,
    /// Its lower end.
    pub low: Written,
    /// Its upper end.
    pub high: Written,
}

/// A bifurcation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct BifurcationPointDocument {
    /// What happens here.
    pub kind: String,
    /// The value of the parameter.
    pub parameter: Bounds,
    /// The word of the orbit.
    pub word: String,
    /// Its cycles.
    pub cycles: u32,
    /// How often the word asked for was doubled.
    pub doublings: u32,
    /// The orbit.
    pub orbit: PeriodicOrbitDocument,
}

/// A branch: certified is no more of it than that it is one curve, if `proved`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct BranchDocument {
    /// The word of its orbits.
    pub word: String,
    /// Their cycles.
    pub cycles: u32,
    /// Whether they are their own mirror images.
    pub symmetric: bool,
    /// From where to where.
    pub parameter: [f64; 2],
    /// Why it ends.
    pub ends: [String; 2],
    /// Whether it is proved to be one curve.
    pub proved: bool,
}

/// A bifurcation that is not proved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct UnprovedDocument {
    /// What may happen.
    pub kind: String,
    /// About where.
    pub near: f64,
    /// The word of the orbit.
    pub word: String,
}
