//! The sweep JSON Lines, schema `impact-pair/sweep/1`: a head, and a record a point.

use impact_pair_model::Wall;
use serde::{Deserialize, Serialize};

use super::orbit::{ArithmeticDocument, ClaimName};
use super::scene::SceneDocument;

/// The schema of a sweep.
pub const SWEEP_SCHEMA: &str = "impact-pair/sweep/1";

/// Bounds as decimals, rounded outward; either may be infinite.
pub type ExtendedBounds = [String; 2];

/// What a sweep is about: all that its points depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SweepHead {
    /// [`SWEEP_SCHEMA`]
    pub schema: String,
    /// What computes it.
    pub program: String,
    /// The title of the scene.
    pub title: Option<String>,
    /// Of what varies the scene's own value.
    pub scene: SceneDocument,
    /// The axes.
    pub over: Vec<SweepAxis>,
    /// The points of the whole grid.
    pub points: u64,
    /// Impacts that are passed over first.
    pub transient: u64,
    /// Impacts after them.
    pub impacts: u64,
    /// Digits asked for.
    pub digits: u32,
    /// Whether anything is claimed.
    pub certified: bool,
    /// Where it says `shadowed`, the points that say so, too, are of orbits that start near the exact start.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub claim: Option<ClaimName>,
    /// What computes it.
    pub arithmetic: ArithmeticDocument,
    /// Under several terms the number, from 1, of the reference: at all points phases are `W t + tau` of this term, and cycles are its
    /// periods, also where another one is faster or this one does not move the box. It is the fastest of those that move the box where
    /// all that varies is greatest. Older documents do not say: there it is at each point the fastest that moves the box.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub reference: Option<u64>,
    /// The points have no impacts.
    pub summary: bool,
    /// The number of the shard, and of how many.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub shard: Option<[u64; 2]>,
}

/// An axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SweepAxis {
    /// What varies.
    pub key: String,
    /// Its first value.
    pub from: String,
    /// Its last value.
    pub to: String,
    /// How many values.
    pub count: u64,
}

/// What is certified at a point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SweepRecord {
    /// Its number in the grid.
    pub point: u64,
    /// The exact values, an axis each.
    pub values: Vec<String>,
    /// A word for how the orbit ended.
    pub outcome: String,
    /// Why it is undecided.
    pub reason: Option<String>,
    /// One line in words.
    pub message: String,
    /// Of which start its orbit is, where that is not the exact one.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub claim: Option<ClaimName>,
    /// All that was asked is certified.
    pub complete: bool,
    /// The most bits that an impact took.
    pub bits: u32,
    /// Certified, those of the transient among them.
    pub impacts: u64,
    /// The first one wider than asked for.
    pub wide_from: Option<u64>,
    /// Impacts a cycle of the reference after the transient.
    pub impacts_per_cycle: Option<ExtendedBounds>,
    /// How a small disturbance grows over the impacts after the transient: the finite-time exponent.
    pub exponent: SweepExponent,
    /// What the exponent per impact tends to, of an orbit that is attracted: the logarithm of the spectral radius of its period's Jacobian,
    /// per impact.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub exponent_limit: Option<ExtendedBounds>,
    /// What it is attracted to, or, without a state, the exact period.
    pub period: Option<SweepPeriod>,
    /// The impacts after the transient.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub states: Vec<SweepImpact>,
}

/// Bounds of the finite-time exponent, or why there are none.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SweepExponent {
    /// Per impact.
    pub per_impact: Option<ExtendedBounds>,
    /// Per cycle of the reference.
    pub per_cycle: Option<ExtendedBounds>,
    /// Why there are none.
    pub reason: Option<String>,
}

/// A period.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SweepPeriod {
    /// The word of an orbit that the motion converges to.
    pub word: Option<String>,
    /// Its impacts.
    pub impacts: u64,
    /// Its cycles; null where they are no whole number, as where the reference does not move the box.
    pub cycles: Option<u64>,
    /// Then how long it takes \[time\].
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub duration: Option<ExtendedBounds>,
    /// From this impact on the orbit is in a neighbourhood that the period contracts.
    pub from: Option<u64>,
    /// The impact that the word starts with; null where its phase is another one in each period.
    pub first: Option<SweepImpact>,
}

/// A state on a switch-plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SweepImpact {
    /// Counts the impacts from 1.
    pub index: u64,
    /// The switch-plane.
    pub wall: Wall,
    /// `W t + tau` of the reference \[rad\]
    pub phase: ExtendedBounds,
    /// `y'` before the impact \[length/time\].
    pub velocity: ExtendedBounds,
}
