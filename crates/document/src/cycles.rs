//! The JSON of all cycles of a trapping region, schema `impact-pair/cycles/1`.

use std::collections::BTreeMap;

use impact_pair_model::vocabulary::{Reason, Stability};
use serde::{Deserialize, Serialize};

use super::number::{Between, Bounds};
use super::periodic::{EigenvalueDocument, MeasuredImpact, PeriodicOrbitDocument};
use super::scene::SceneDocument;

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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct CycleDocument {
    /// Its least period under the reduced map.
    pub reduced_impacts: u32,
    /// Mappings, the first one right-most.
    pub word: String,
    /// Forcing periods of the orbit.
    pub cycles: u32,
    /// Impacts of the orbit in time order.
    pub impacts: Vec<MeasuredImpact>,
    /// Whether it is unique within these bounds.
    pub unique: bool,
    /// Whether it is admissible: no wall is touched earlier; null if undecided.
    pub physical: Option<bool>,
    /// Whether it is its own mirror image.
    pub symmetric: Option<bool>,
    /// Number of times that the impacts run through a shorter orbit: absent at 1, null if undecided.
    #[serde(skip_serializing_if = "super::periodic::is_once", default = "super::periodic::once")]
    pub times: Option<u32>,
    /// The trace of the Jacobian of the period; null where an impact is a graze.
    pub trace: Option<Bounds>,
    /// Determinant of the derivative of the orbit's map.
    pub determinant: Option<Bounds>,
    /// Eigenvalues of the derivative of the orbit's map.
    pub eigenvalues: Option<[EigenvalueDocument; 2]>,
    /// `stable`, `unstable`, `elliptic` (with `e = 1`: both eigenvalues lie on the unit circle, apart and not real) or `undecided`.
    pub stability: Stability,
}

impl CycleDocument {
    /// Returns the cycle of an orbit, with its least period under the reduced map.
    pub fn of(reduced_impacts: u32, (word, cycles): (String, u32), orbit: PeriodicOrbitDocument) -> Self {
        let PeriodicOrbitDocument { impacts, unique, physical, symmetric, times, .. } = orbit;
        let PeriodicOrbitDocument { trace, determinant, eigenvalues, stability, .. } = orbit;
        Self {
            reduced_impacts,
            word,
            cycles,
            impacts,
            unique,
            physical,
            symmetric,
            times,
            trace,
            determinant,
            eigenvalues,
            stability,
        }
    }

    /// Returns its orbit.
    pub fn orbit(&self) -> PeriodicOrbitDocument {
        let Self { impacts, unique, physical, symmetric, times, trace, determinant, eigenvalues, stability, .. } =
            self.clone();
        let of_two = PeriodicOrbitDocument::default();
        PeriodicOrbitDocument {
            impacts,
            unique,
            physical,
            symmetric,
            times,
            trace,
            determinant,
            eigenvalues,
            stability,
            ..of_two
        }
    }
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
