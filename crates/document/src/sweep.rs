//! The sweep JSON Lines, schema `impact-pair/sweep/1`: a head, and one record per point.

use impact_pair_model::Wall;
use impact_pair_model::vocabulary::{NoExponent, PointOutcome, Reason};
use serde::{Deserialize, Serialize};

use super::number::Between;
use super::orbit::{ArithmeticDocument, ClaimName};
use super::scene::SceneDocument;

/// The schema of a sweep.
pub const SWEEP_SCHEMA: &str = "impact-pair/sweep/1";

/// Bounds as decimals, rounded outward; either may be infinite.
pub type ExtendedBounds = Between<String>;

/// The head of a sweep: everything that its points depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SweepHead {
    /// Schema of the document: [`SWEEP_SCHEMA`].
    pub schema: String,
    /// Name and version of the program, such as `impact-pair 0.1.0`.
    pub program: String,
    /// The title of the scene.
    pub title: Option<String>,
    /// The scene; its own values of what varies are not used.
    pub scene: SceneDocument,
    /// The axes.
    pub over: Vec<SweepAxis>,
    /// Number of points of the whole grid.
    pub points: u64,
    /// Number of impacts in the transient.
    pub transient: u64,
    /// Number of impacts after the transient.
    pub impacts: u64,
    /// Significant decimal digits requested of each bound.
    pub digits: u32,
    /// Whether the bounds are certified.
    pub certified: bool,
    /// If `shadowed`, points with the same claim belong to orbits that start near the exact start.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub claim: Option<ClaimName>,
    /// Name and version of the program, such as `impact-pair 0.1.0`.
    pub arithmetic: ArithmeticDocument,
    /// With several terms, the number, from 1, of the reference: at all points phases are `W t + tau` of this term, and cycles are
    /// its periods, also where another term is faster or this one does not move the box. It is the fastest of those that move the box where
    /// all that varies is greatest. If absent (older documents), the reference at each point is the fastest that moves the box.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub reference: Option<u64>,
    /// Whether the points have no impacts.
    pub summary: bool,
    /// Number of the shard, and number of shards.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub shard: Option<[u64; 2]>,
}

/// An axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SweepAxis {
    /// Key of the parameter that varies, such as `restitution` or `start.velocity`.
    pub key: String,
    /// First value of the parameter, as written.
    pub from: String,
    /// Last value of the parameter, as written.
    pub to: String,
    /// Number of equidistant values.
    pub count: u64,
}

/// The certified result of a point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SweepRecord {
    /// Number of the point in the grid, from 0.
    pub point: u64,
    /// The exact values, one per axis.
    pub values: Vec<String>,
    /// Outcome of the orbit.
    pub outcome: PointOutcome,
    /// Reason why the point is undecided.
    pub reason: Option<Reason>,
    /// One line in words.
    pub message: String,
    /// The start that its orbit belongs to, if not the exact one.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub claim: Option<ClaimName>,
    /// Whether everything requested is certified.
    pub complete: bool,
    /// Maximum precision of an impact, in bits.
    pub bits: u32,
    /// Number of certified impacts, including the transient.
    pub impacts: u64,
    /// The first impact wider than requested.
    pub wide_from: Option<u64>,
    /// Impacts per period of the reference, after the transient.
    pub impacts_per_cycle: Option<ExtendedBounds>,
    /// Growth rate of small disturbances over the impacts after the transient: the finite-time exponent.
    pub exponent: SweepExponent,
    /// Limit of the exponent per impact of an attracted orbit: the logarithm of the spectral radius of its period's Jacobian, per impact; where `e` may be 0, or after a rest, only an upper bound. Absent after a graze, where there is no derivative.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub exponent_limit: Option<ExtendedBounds>,
    /// What it is attracted to, or, without a state, the exact period.
    pub period: Option<SweepPeriod>,
    /// The impacts after the transient.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub states: Vec<SweepImpact>,
}

/// Bounds of the finite-time exponent, or the reason why there are none.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SweepExponent {
    /// Exponent per impact.
    pub per_impact: Option<ExtendedBounds>,
    /// Exponent per forcing period of the `reference`.
    pub per_cycle: Option<ExtendedBounds>,
    /// Reason why the exponent has no bounds.
    pub reason: Option<NoExponent>,
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
    /// Periods of the reference; null if not a whole number, as where the reference does not move the box.
    pub cycles: Option<u64>,
    /// Its duration in that case \[time\].
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub duration: Option<ExtendedBounds>,
    /// From this impact on the orbit is in a neighbourhood that the map of a period contracts.
    pub from: Option<u64>,
    /// The impact that the word starts with; null if its phase differs in each period.
    pub first: Option<SweepImpact>,
}

/// A state on a switch-plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SweepImpact<B = ExtendedBounds> {
    /// Number of the impact, from 1.
    pub index: u64,
    /// The switch-plane.
    pub wall: Wall,
    /// `W t + tau` of the reference \[rad\]
    pub phase: B,
    /// `y'` before the impact \[length/time\].
    pub velocity: B,
}

impl<B> SweepImpact<B> {
    /// Returns the state with other bounds.
    pub fn map<C>(&self, f: impl Fn(&B) -> C) -> SweepImpact<C> {
        SweepImpact { index: self.index, wall: self.wall, phase: f(&self.phase), velocity: f(&self.velocity) }
    }
}
