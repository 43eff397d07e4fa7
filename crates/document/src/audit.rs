//! The audit JSON, schema `impact-pair/audit/1`.
//!
//! Certified values and errors are decimal bounds, rounded outward: a listed time is at least `error.time[0]` and at most `error.time[1]`
//! away from the true one. Listed numbers are as they were written.

use impact_pair_model::Wall;
use serde::{Deserialize, Serialize};

use super::number::{Bounds, Written};
use super::orbit::ArithmeticDocument;
use super::outcome::OutcomeDocument;
use super::scene::SceneDocument;

/// The schema of the audit JSON.
pub const AUDIT_SCHEMA: &str = "impact-pair/audit/1";

/// A list of impacts, judged.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct AuditDocument {
    /// [`AUDIT_SCHEMA`]
    pub schema: String,
    /// What judged.
    pub program: String,
    /// Whose impacts they should be.
    pub scene: SceneDocument,
    /// In periods, and in `A W`.
    pub tolerance: Written,
    /// The units of the tolerance.
    pub units: Units,
    /// The time judged up to \[time\].
    pub until: Bounds,
    /// The digits asked for.
    pub digits: u32,
    /// What computed the certified orbit.
    pub arithmetic: ArithmeticDocument,
    /// How the certified orbit ended.
    pub outcome: OutcomeDocument,
    /// Whether list and truth agree.
    pub agreed: bool,
    /// The same in words.
    pub message: String,
    /// How many of each verdict.
    pub counts: Counts,
    /// The columns of the list that are not read.
    #[serde(default)]
    pub unused_columns: Vec<String>,
    /// The first row or impact that differs.
    pub first_disagreement: Option<Disagreement>,
    /// From where on the list follows another orbit.
    pub another_orbit: Option<Departure>,
    /// How plain doubles do.
    pub double_precision: DoublePrecision,
    /// Every row, and every impact that is on none.
    pub events: Vec<AuditEvent>,
}

/// Bounds of units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct Units {
    /// A period \[time\].
    pub time: Bounds,
    /// `A W` \[length/time\].
    pub velocity: Bounds,
}

/// How many of each verdict.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct Counts {
    /// Rows judged.
    pub listed: usize,
    /// Rows that are no impacts.
    pub left_out: usize,
    /// Certified, and no farther from it than the tolerance.
    pub inside: usize,
    /// Certified, and proved to be farther.
    pub outside: usize,
    /// Certified, on no row.
    pub missed: usize,
    /// On a row, and not certified.
    #[serde(rename = "false")]
    pub false_: usize,
    /// Among the infinitely many of a chatter.
    pub chatter: usize,
    /// After the end of what is certified.
    pub undecided: usize,
    /// After the impact beyond which the orbit was not followed: the list lacks more impacts than it has rows.
    #[serde(skip_serializing_if = "is_zero", default)]
    pub not_reached: usize,
}

fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// Where list and truth differ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct Disagreement {
    /// The certified impact.
    pub impact: u64,
    /// What is said of it.
    pub verdict: String,
    /// The row, from 1.
    pub row: Option<usize>,
}

/// From where on a list follows another orbit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct Departure {
    /// The certified impact.
    pub impact: u64,
    /// The row, from 1.
    pub row: Option<usize>,
}

/// Plain doubles on the same scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct DoublePrecision {
    /// The exact motion of data that are rounded to doubles.
    pub rounded_data: Option<Parting>,
    /// The motion in doubles.
    pub float: Option<Parting>,
}

/// Where a motion parts from the true one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct Parting {
    /// The first impact that is outside the tolerance.
    pub first_disagreement: Option<ImpactVerdict>,
    /// From where on it is another orbit.
    pub another_orbit: Option<ImpactNumber>,
}

/// What is said of an impact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ImpactVerdict {
    /// Its number.
    pub impact: u64,
    /// What is said of it.
    pub verdict: String,
}

/// An impact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ImpactNumber {
    /// Its number.
    pub impact: u64,
}

/// A row of the list, or an impact that is on none.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct AuditEvent {
    /// What is said of it.
    pub verdict: String,
    /// Why it is false.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub reason: Option<String>,
    /// The row, from 1.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub row: Option<usize>,
    /// What the row says.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub listed: Option<ListedRow>,
    /// The certified contact that it is.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub certified: Option<CertifiedContact>,
    /// The certified contact that is nearest to it.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub nearest: Option<CertifiedContact>,
    /// How far it is away.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub error: Option<ListedError>,
}

/// A row of the list, as it is written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ListedRow {
    /// Where it stands in the list.
    pub place: String,
    /// Its wall.
    pub wall: Wall,
    /// Its time.
    pub time: String,
    /// Its velocity, if it says one.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub velocity: Option<String>,
}

/// A certified contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct CertifiedContact {
    /// `impact`, `start` or `graze`.
    pub event: String,
    /// The number of an impact.
    pub index: Option<u64>,
    /// The wall.
    pub wall: Wall,
    /// When \[time\].
    pub time: Bounds,
    /// `y'` before it \[length/time\].
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub velocity: Option<Bounds>,
}

/// How far a row is from the truth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ListedError {
    /// In time \[time\].
    pub time: Bounds,
    /// In velocity \[length/time\].
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub velocity: Option<Bounds>,
}
