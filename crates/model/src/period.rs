//! Exact repetition.

use serde::{Deserialize, Serialize};

/// The period of a motion that repeats itself exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct Period {
    /// Forcing periods.
    pub cycles: u64,
    /// Impacts per period; between two releases those that are listed, as many wherever the list has the period again.
    pub impacts: u64,
}
