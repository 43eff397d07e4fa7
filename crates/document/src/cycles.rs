//! The JSON of all cycles of a trapping region, schema `impact-pair/cycles/1`.

use std::collections::BTreeMap;

use impact_pair_model::vocabulary::Reason;
use serde::{Deserialize, Deserializer, Serialize};

use super::number::Between;
use super::periodic::{MeasuredImpact, PeriodicOrbitDocument};
use super::scene::SceneDocument;
use super::strict::flattened;

/// The schema of cycles.
pub const CYCLES_SCHEMA: &str = "impact-pair/cycles/1";

/// All periodic orbits of period n of the reduced impact map in a trapping region; the reduced map mirrors every impact to the left wall.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct CyclesDocument {
    /// Schema of the document: [`CYCLES_SCHEMA`].
    pub schema: String,
    /// Name and version of the program, such as `impact-pair 0.1.0`.
    pub program: String,
    /// Whether everything requested is proved.
    pub certified: bool,
    /// Whether the list is complete in the region.
    pub exhaustive: bool,
    /// Scene that everything here is about: excitation, gap, restitution coefficient and start, as exact expressions.
    pub scene: SceneDocument,
    /// The reason why no region is proved, if so.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub reason: Option<String>,
    /// Number of boxes of the region.
    pub boxes: u64,
    /// The least and the greatest requested number of impacts.
    pub impacts: Between<u32>,
    /// By the number n of impacts: the number of fixed points of the n-th iterate in the region; only where that is proved.
    pub fixed_points: BTreeMap<u32, u64>,
    /// Whether it is proved that none of the requested cycles attracts.
    pub no_attractor: bool,
    /// The cycles, each once.
    pub orbits: Vec<CycleDocument>,
    /// Where others are not excluded.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub undecided: Vec<OpenCycleDocument>,
}

/// A cycle of the reduced map: a periodic orbit, and its mirror image.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct CycleDocument {
    /// Its least period under the reduced map.
    pub reduced_impacts: u32,
    /// Mappings, the first one right-most.
    pub word: String,
    /// Forcing periods of the orbit.
    pub cycles: u32,
    /// The periodic orbit.
    #[serde(flatten)]
    pub orbit: PeriodicOrbitDocument,
}

impl<'de> Deserialize<'de> for CycleDocument {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (Period { reduced_impacts, word, cycles }, orbit) =
            flattened(deserializer, &["reduced_impacts", "word", "cycles"])?;
        Ok(Self { reduced_impacts, word, cycles, orbit })
    }
}

/// The keys of a cycle that are not those of its orbit.
#[derive(Deserialize)]
struct Period {
    reduced_impacts: u32,
    word: String,
    cycles: u32,
}

/// Boxes that may contain a cycle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct OpenCycleDocument {
    /// Its impacts in the reduced map.
    pub reduced_impacts: u32,
    /// Bounds of its first impacts.
    pub impacts: Vec<MeasuredImpact>,
    /// Reason why the cycle is not proved.
    pub reason: Reason,
}
