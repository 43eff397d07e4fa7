//! The JSON of a check, schema `impact-pair/check/1`: each claim of a document with its verdict.

use serde::{Deserialize, Serialize};

/// The schema of a check.
pub const CHECK_SCHEMA: &str = "impact-pair/check/1";

/// What a check finds of a document. A path such as `events[0].time` leads to a value of the document; in a list of documents it
/// begins with the position in the list, `[0].events[0].time`; the lines of a sweep after its head are `points[0]`, `points[1]`, ...
///
/// Every value of the document stands in `claims`, by its own path or, in a list of plain values, by that of the list, or it stands in
/// `not_checked`, by its own path or that of a list or an object around it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct CheckDocument {
    /// [`CHECK_SCHEMA`]
    pub schema: String,
    /// On all claims together: a check that is interrupted leaves them undecided.
    pub verdict: VerdictName,
    /// One line in words.
    pub message: String,
    /// What is compared with what the check finds.
    pub claims: Vec<JudgedClaim>,
    /// What is not: it claims nothing, or no lemma of the check is about it.
    pub not_checked: Vec<String>,
}

/// A claim and what is found of it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct JudgedClaim {
    /// Where it stands.
    pub path: String,
    /// What is found; claims after the first one that is not confirmed are undecided.
    pub verdict: VerdictName,
    /// Why it is not confirmed: of the claim that decides.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub reason: Option<String>,
}

/// What a check finds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum VerdictName {
    /// Proved again.
    Confirmed,
    /// Proved to be false.
    Refuted,
    /// Neither.
    Undecided,
}

impl VerdictName {
    /// The word of the JSON.
    pub fn text(self) -> &'static str {
        match self {
            Self::Confirmed => "confirmed",
            Self::Refuted => "refuted",
            Self::Undecided => "undecided",
        }
    }
}
