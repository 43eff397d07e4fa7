//! Witness of an exhaustive search.

use serde::{Deserialize, Serialize};

/// What `check` proves with that a list is complete; it claims nothing. It has a `tree`, or says why the tree is left out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct SearchWitness {
    /// How the box of all phases of the word is halved, each box before its two halves. `-` is a box that is settled at once. Any other box is
    /// a letter and a decimal: `a` for the phase of the first impact, `b` for the second and so on, `A` after `z`, and the place at which the
    /// phase is halved, in forcing periods of the fastest harmonic. The lower half comes first.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub tree: Option<String>,
    /// Why the tree is left out.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub omitted: Option<String>,
}
