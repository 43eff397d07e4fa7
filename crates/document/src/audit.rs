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

/// An audit: a list of impacts compared with the certified orbit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct AuditDocument {
    /// Schema of the document: [`AUDIT_SCHEMA`].
    pub schema: String,
    /// Name and version of the program, such as `impact-pair 0.1.0`.
    pub program: String,
    /// The scene of the impacts.
    pub scene: SceneDocument,
    /// Tolerance of times in periods `2 pi/W`, and of velocities in `A W`.
    pub tolerance: Written,
    /// The units of the tolerance.
    pub units: Units,
    /// The time up to which the list is compared \[time\].
    pub until: Bounds,
    /// Requested digits.
    pub digits: u32,
    /// The arithmetic of the certified orbit.
    pub arithmetic: ArithmeticDocument,
    /// Outcome of the certified orbit.
    pub outcome: OutcomeDocument,
    /// Whether the list agrees with the certified orbit.
    pub agreed: bool,
    /// The verdict in words.
    pub message: String,
    /// Number of rows and impacts with each verdict.
    pub counts: Counts,
    /// The columns of the list that are not read.
    #[serde(default)]
    pub unused_columns: Vec<String>,
    /// The first row or impact that differs.
    pub first_disagreement: Option<Disagreement>,
    /// Where the list diverges from the true orbit.
    pub another_orbit: Option<Divergence>,
    /// The same comparison for plain doubles.
    pub double_precision: DoublePrecision,
    /// Every row, and every impact without a row.
    pub events: Vec<AuditEvent>,
}

/// Bounds of the units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct Units {
    /// A period \[time\].
    pub time: Bounds,
    /// `A W` \[length/time\].
    pub velocity: Bounds,
}

/// Number of rows and impacts with each verdict.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct Counts {
    /// Rows compared.
    pub listed: usize,
    /// Rows that are not impacts.
    pub left_out: usize,
    /// Certified, within the tolerance.
    pub inside: usize,
    /// Certified, and proved to be outside the tolerance.
    pub outside: usize,
    /// Certified, but not listed.
    pub missed: usize,
    /// Listed, and proved not to happen.
    #[serde(rename = "false")]
    pub false_: usize,
    /// Among the infinitely many impacts of a chatter.
    pub chatter: usize,
    /// After the end of the certified orbit.
    pub undecided: usize,
    /// After the impact beyond which the orbit was not followed: the list lacks more impacts than it has rows.
    #[serde(skip_serializing_if = "is_zero", default)]
    pub not_reached: usize,
}

fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// Where the list and the certified orbit differ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct Disagreement {
    /// The certified impact.
    pub impact: u64,
    /// Verdict on the row, one of those that `audit` prints.
    pub verdict: String,
    /// Number of the row in the list, from 1; `null` where the list has none.
    pub row: Option<usize>,
}

/// Where a list diverges from the true orbit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct Divergence {
    /// The certified impact.
    pub impact: u64,
    /// Number of the row in the list, from 1; `null` where the list has none.
    pub row: Option<usize>,
}

/// Plain doubles on the same scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct DoublePrecision {
    /// The exact motion from data rounded to doubles.
    pub rounded_data: Option<Parting>,
    /// The motion in doubles.
    pub float: Option<Parting>,
}

/// Where a motion differs from the true one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct Parting {
    /// The first impact that is outside the tolerance.
    pub first_disagreement: Option<ImpactVerdict>,
    /// Where it diverges from the true orbit.
    pub another_orbit: Option<ImpactNumber>,
}

/// An impact with its verdict.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ImpactVerdict {
    /// Number of the certified impact, from 1.
    pub impact: u64,
    /// Verdict on the row, one of those that `audit` prints.
    pub verdict: String,
}

/// An impact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ImpactNumber {
    /// Number of the certified impact, from 1.
    pub impact: u64,
}

/// A row of the list, or an impact without a row.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct AuditEvent {
    /// Verdict on the row, one of those that `audit` prints.
    pub verdict: String,
    /// The reason why it is false.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub reason: Option<String>,
    /// Number of the row in the list, from 1; `null` where the list has none.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub row: Option<usize>,
    /// The row as listed.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub listed: Option<ListedRow>,
    /// The matching certified contact.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub certified: Option<CertifiedContact>,
    /// The nearest certified contact.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub nearest: Option<CertifiedContact>,
    /// Bounds of its errors.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub error: Option<ListedError>,
}

/// A row of the list, as written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ListedRow<N = String> {
    /// Its position in the list.
    pub place: String,
    /// Its wall.
    pub wall: Wall,
    /// Time of the listed impact \[time\].
    pub time: N,
    /// Its velocity, if listed.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub velocity: Option<N>,
}

impl<N> ListedRow<N> {
    /// Returns the row with other numbers.
    pub fn map<M>(&self, f: impl Fn(&N) -> M) -> ListedRow<M> {
        let velocity = self.velocity.as_ref().map(&f);
        ListedRow { place: self.place.clone(), wall: self.wall, time: f(&self.time), velocity }
    }
}

/// A certified contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct CertifiedContact {
    /// `impact`, `start` or `graze`.
    pub event: String,
    /// The number of an impact.
    pub index: Option<u64>,
    /// Wall that is touched.
    pub wall: Wall,
    /// Time of the contact \[time\].
    pub time: Bounds,
    /// `y'` before it \[length/time\].
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub velocity: Option<Bounds>,
}

/// Bounds of the errors of a row.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ListedError {
    /// Error in time \[time\].
    pub time: Bounds,
    /// Error in velocity \[length/time\].
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub velocity: Option<Bounds>,
}
