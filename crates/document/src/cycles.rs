//! The JSON of all cycles of a region, schema `impact-pair/cycles/1`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::periodic::{PeriodicImpactDocument, PeriodicOrbitDocument};
use super::scene::SceneDocument;

/// The schema of cycles.
pub const CYCLES_SCHEMA: &str = "impact-pair/cycles/1";

/// All periodic motions of a region with so many impacts; every impact is mirrored to the left wall: the reduced map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct CyclesDocument {
    /// [`CYCLES_SCHEMA`]
    pub schema: String,
    /// What proved them.
    pub program: String,
    /// Whether all that was asked is proved.
    pub certified: bool,
    /// Whether there are no others in the region.
    pub exhaustive: bool,
    /// Whose they are.
    pub scene: SceneDocument,
    /// Why there is no region, if none is proved.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub reason: Option<String>,
    /// How many boxes the region has.
    pub boxes: u64,
    /// The least and the greatest number of impacts asked for.
    pub impacts: [u32; 2],
    /// By the number of impacts: how many states of the region come again after so many; only where that is proved.
    pub fixed_points: BTreeMap<u32, u64>,
    /// Whether it is proved that none of the cycles asked for attracts.
    pub no_attractor: bool,
    /// The cycles, each once.
    pub orbits: Vec<CycleDocument>,
    /// Where there may be others.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub undecided: Vec<OpenCycleDocument>,
}

/// A cycle of the reduced map: a periodic motion, and its mirror image.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct CycleDocument {
    /// The least number of impacts after which it is what it was, or its mirror image.
    pub reduced_impacts: u32,
    /// Mappings, the first one right-most.
    pub word: String,
    /// The cycles of the word.
    pub cycles: u32,
    /// The motion.
    #[serde(flatten)]
    pub orbit: PeriodicOrbitDocument,
}

/// Boxes that may hold a cycle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct OpenCycleDocument {
    /// Its impacts in the reduced map.
    pub reduced_impacts: u32,
    /// Bounds of its first impacts.
    pub impacts: Vec<PeriodicImpactDocument>,
    /// Why it is undecided.
    pub reason: String,
}
