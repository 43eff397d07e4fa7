//! The JSON of windows of stable periodic orbits, schema `impact-pair/windows/1`.

use impact_pair_model::vocabulary::Bifurcation;
use serde::{Deserialize, Serialize};

use super::bifurcation::ParameterRange;
use super::number::{Bounds, Written};
use super::periodic::PeriodicOrbitDocument;
use super::scene::SceneDocument;

/// The schema of windows.
pub const WINDOWS_SCHEMA: &str = "impact-pair/windows/1";

/// Stable periodic orbits found over a parameter near a scene, and their windows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct WindowsDocument {
    /// Schema of the document: [`WINDOWS_SCHEMA`].
    pub schema: String,
    /// Name and version of the program, such as `impact-pair 0.1.0`.
    pub program: String,
    /// Whether there are windows, and each orbit, both its ends and the orbits between are proved; nothing is claimed of `undecided`.
    pub certified: bool,
    /// The scene; the windows are sorted by their distance from its own value of the parameter.
    pub scene: SceneDocument,
    /// The parameter and its range.
    pub over: ParameterRange,
    /// Always false: other stable orbits are not excluded.
    pub exhaustive: bool,
    /// Number of impacts of floating-point orbits that were searched.
    pub searched_impacts: u64,
    /// Whether the run was interrupted before the search or the proofs were done.
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    pub interrupted: bool,
    /// The windows, the nearest to the scene's own value first.
    pub windows: Vec<WindowDocument>,
    /// Stable orbits of floating point of which nothing is proved.
    pub undecided: Vec<OpenWindowDocument>,
}

/// A stable periodic orbit at an exact value of the parameter, and its window: the values from a fold to a loss of stability.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct WindowDocument {
    /// The parameter: `pair.gap`, `excitation.amplitude` or `pair.restitution`.
    pub key: String,
    /// The value of the parameter at which the orbit is proved.
    pub at: Written,
    /// Bounds of the lower end; `null` where it is not proved.
    pub from: Option<Bounds>,
    /// Bounds of the upper end; `null` where it is not proved.
    pub to: Option<Bounds>,
    /// What happens at the lower end and at the upper one: `fold`, `period-doubling`, `pitchfork`; `null` where it is not proved.
    pub ends: [Option<Bifurcation>; 2],
    /// Whether it is proved that for every value between the bounds of both ends there is a stable, admissible orbit of the word, and that one
    /// curve of such orbits leads from one end through `orbit` to the other.
    pub stable_between: bool,
    /// Where that is not proved: the reason.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub reason: Option<String>,
    /// Its least period, proved, under the reduced map, which mirrors every impact to the left wall.
    pub reduced_impacts: u32,
    /// The flights of a period of the reduced map in time order: `F` to the far wall, `N` back to the near one.
    pub flights: String,
    /// Mappings, the first one right-most.
    pub word: String,
    /// Forcing periods of the orbit.
    pub cycles: u32,
    /// The periodic orbit at this value.
    pub orbit: PeriodicOrbitDocument,
}

/// A stable orbit of floating point that is not proved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct OpenWindowDocument {
    /// Approximate value of the parameter.
    pub near: f64,
    /// Its period under the reduced map.
    pub reduced_impacts: u32,
    /// The flights of a period of the reduced map in time order.
    pub flights: String,
    /// Why nothing is proved of it.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub reason: Option<String>,
}
