//! Exact repetition.

use serde::{Deserialize, Serialize};

/// What a motion that repeats itself exactly does in a period.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct Period {
    /// Cycles of the excitation.
    pub cycles: u64,
    /// Impacts that are listed.
    pub impacts: u64,
}
