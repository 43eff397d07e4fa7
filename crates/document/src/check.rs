//! The JSON of a check, schema `impact-pair/check/1`: each claim of a document with its verdict.

use serde::{Deserialize, Serialize};

/// The schema of a check.
pub const CHECK_SCHEMA: &str = "impact-pair/check/1";

/// The result of a check of a document. A path such as `events[0].time` leads to a value of the document; in a list of documents it
/// begins with the position in the list, `[0].events[0].time`; the lines of a sweep after its head are `points[0]`, `points[1]`, ...
///
/// Every value of the document stands in `claims`, by its own path or, in a list of plain values, by that of the list, or it stands in
/// `not_checked`, by its own path or that of a list or an object around it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct CheckDocument {
    /// Schema of the document: [`CHECK_SCHEMA`].
    pub schema: String,
    /// Verdict on all claims together: undecided if the check is interrupted.
    pub verdict: VerdictName,
    /// The verdict in one line.
    pub message: String,
    /// The theorem in words, where all claims that are checked are confirmed; a line for each document of a list.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub theorem: Option<String>,
    /// SHA-256 of the text that was checked, in hexadecimal: what `sha256sum` says of its file.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub sha256: Option<String>,
    /// The values that the check compares with its own.
    pub claims: Vec<JudgedClaim>,
    /// The values that are not compared: they claim nothing, or no lemma of the check covers them.
    pub not_checked: Vec<String>,
    /// The keys among these that claim something, without positions in lists: `check --strict` accepts none.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub unchecked_claims: Vec<String>,
}

/// The schema of an answer of the verified checker.
pub const VERIFIED_SCHEMA: &str = "impact-pair/verified/1";

/// The answer of the program `impact-pair-verified`, whose checker is extracted from its proof in Coq.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct VerifiedDocument {
    /// Schema of the document: [`VERIFIED_SCHEMA`].
    pub schema: String,
    /// Whether the theorem holds of the document.
    pub verified: bool,
    /// The theorem in words, if one covers what the document claims.
    pub claim: Option<String>,
    /// The scene that it is about, likewise.
    pub scene: Option<String>,
    /// SHA-256 of the text that was verified, in hexadecimal: what `sha256sum` says of its file.
    pub sha256: String,
    /// Why the document is not verified.
    pub reason: Option<String>,
}

/// A claim and its verdict.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct JudgedClaim {
    /// Path of the claim.
    pub path: String,
    /// Its verdict; claims after the first one that is not confirmed are undecided.
    pub verdict: VerdictName,
    /// The reason why it is not confirmed, at the deciding claim.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub reason: Option<String>,
}

/// Verdict of a check.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum VerdictName {
    /// Proved again.
    Confirmed,
    /// Proved to be false.
    Refuted,
    /// Neither proved nor refuted.
    Undecided,
}

impl VerdictName {
    /// Returns the word of the JSON.
    pub fn text(self) -> &'static str {
        match self {
            Self::Confirmed => "confirmed",
            Self::Refuted => "refuted",
            Self::Undecided => "undecided",
        }
    }
}
