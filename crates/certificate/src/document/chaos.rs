//! The JSON of regions and of chaos, schemas `impact-pair/trap/1` and `impact-pair/chaos/1`.

use serde::{Deserialize, Serialize};

use super::bifurcation::ParameterRange;
use super::number::Bounds;
use super::scene::SceneDocument;

/// The schema of a region.
pub const TRAP_SCHEMA: &str = "impact-pair/trap/1";
/// The schema of words and entropy.
pub const CHAOS_SCHEMA: &str = "impact-pair/chaos/1";

/// A region that the impact map does not leave; every impact is mirrored to the left wall.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct TrapDocument {
    /// [`TRAP_SCHEMA`]
    pub schema: String,
    /// What proved it.
    pub program: String,
    /// Whose it is.
    pub scene: SceneDocument,
    /// Columns in a turn of the phase: column `i` holds the phases from `i` to `i + 1` of so many parts of a turn.
    pub columns: u32,
    /// Rows in a speed of `A W`, likewise.
    pub rows: u32,
    /// How many boxes there are.
    pub count: u64,
    /// The time of any flight \[cycles\], bounds.
    pub flight: Bounds,
    /// The same \[time\].
    pub flight_time: Bounds,
    /// The speed before any impact, over `A W`, bounds.
    pub speed: Bounds,
    /// The same \[length/time\].
    pub speed_before: Bounds,
    /// The impact of the scene's own orbit from which on all are in the region; 0 is its start. `null` if none is proved to be.
    pub entered: Option<u64>,
    /// Runs of boxes: a column, the first row and the last one.
    pub boxes: Vec<[i32; 3]>,
}

/// Words of the impact map that may follow one another, and what they say of entropy.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ChaosDocument {
    /// [`CHAOS_SCHEMA`]
    pub schema: String,
    /// What proved them.
    pub program: String,
    /// Whose they are.
    pub scene: SceneDocument,
    /// The parameter over whose whole range all is proved; its own value in the scene is one of no account.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub over: Option<ParameterRange>,
    /// The most impacts of a word, as far as all were looked for.
    pub depth: u32,
    /// Whether it was stopped before the depth that was asked for.
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    pub interrupted: bool,
    /// The bases, disjoint.
    pub bases: Vec<BaseDocument>,
    /// The words.
    pub words: Vec<WordDocument>,
    /// How many boxes were mapped.
    pub boxes: u64,
    /// Lower bounds of the topological entropy; 0 where none is proved.
    pub entropy: EntropyDocument,
    /// Two words that may follow one another in any order, in mappings, the first one right-most.
    pub horseshoe: Option<[String; 2]>,
    /// The Lyapunov exponent of the floating orbit, an impact: seen, not proved.
    pub exponent_seen: Option<f64>,
}

/// Lower bounds of entropy.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct EntropyDocument {
    /// An impact.
    pub impact: f64,
    /// A cycle.
    pub cycle: f64,
}

/// A base: its corners, each a phase in turns and a speed over `A W`, exactly these doubles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct BaseDocument {
    /// The left edge, from below to above.
    pub left: [[f64; 2]; 2],
    /// The right edge, likewise.
    pub right: [[f64; 2]; 2],
}

/// A word.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct WordDocument {
    /// The base it starts in, counted from 0.
    pub from: u32,
    /// The base it crosses.
    pub to: u32,
    /// The impacts' walls, `L` and `R`, for a start on the left wall.
    pub walls: String,
    /// How many half cycles it takes.
    pub half_cycles: i64,
}
