//! The trade JSON, schema `impact-pair/trade/1`.
//!
//! Widths and errors are decimal strings, since they may be below the range of doubles: a width is an upper bound, an
//! error lies between two bounds. Times are those of one machine on one day.

use impact_pair_model::Wall;
use serde::{Deserialize, Serialize};

use super::orbit::ArithmeticDocument;
use super::outcome::OutcomeDocument;
use super::scene::SceneDocument;

/// The schema of the trade JSON.
pub const TRADE_SCHEMA: &str = "impact-pair/trade/1";

/// What accuracy costs on a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct TradeDocument {
    /// [`TRADE_SCHEMA`]
    pub schema: String,
    /// What measured.
    pub program: String,
    /// The scene.
    pub scene: SceneDocument,
    /// How far each rung was to go.
    pub asked: TradeAsked,
    /// What widths and errors are measured in.
    pub units: TradeUnits,
    /// The rung that was interrupted.
    pub interrupted: Option<String>,
    /// An arithmetic each.
    pub rungs: Vec<RungDocument>,
}

/// How far each rung was to go.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct TradeAsked {
    /// So many impacts.
    pub impacts: Option<u64>,
    /// Up to this time, as it was written.
    pub until: Option<String>,
    /// Bits at most.
    pub max_bits: u32,
}

/// Units in words.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct TradeUnits {
    /// Of times.
    pub time: String,
    /// Of velocities.
    pub velocity: String,
}

/// An arithmetic, measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct RungDocument {
    /// Its name.
    pub name: String,
    /// The same as the command line says it.
    pub asked: RungAsked,
    /// What computed it.
    pub arithmetic: ArithmeticDocument,
    /// Whether anything is claimed.
    pub certified: bool,
    /// Whether all impacts asked for are there.
    pub complete: bool,
    /// Impacts reached.
    pub impacts: u64,
    /// How it ended.
    pub outcome: OutcomeDocument,
    /// How long it takes.
    pub seconds: Seconds,
    /// The same for an impact.
    pub microseconds_per_impact: Microseconds,
    /// Its inverse, without bounds.
    pub impacts_per_second: Option<f64>,
    /// `-log10` of the greatest width, rounded down.
    pub digits: Option<f64>,
    /// Guaranteed widths.
    pub widths: Option<WidthsDocument>,
    /// The true errors, of `float`.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub truth: Option<TruthDocument>,
}

/// What the command line calls an arithmetic.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct RungAsked {
    /// `--arithmetic`
    pub arithmetic: String,
    /// `--digits`
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub digits: Option<u32>,
}

/// Medians of several runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct Seconds {
    /// Impacts enclosed, in turns and gaps.
    pub orbit: f64,
    /// These, and their bounds in the units of the scene.
    pub with_bounds: Option<f64>,
    /// How many runs.
    pub repetitions: usize,
}

/// What an impact takes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct Microseconds {
    /// Enclosed.
    pub orbit: Option<f64>,
    /// With bounds.
    pub with_bounds: Option<f64>,
}

/// Guaranteed widths of all impacts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct WidthsDocument {
    /// Of times.
    pub time: ExtentDocument,
    /// Of velocities.
    pub velocity: ExtentDocument,
}

/// Widths, rounded up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ExtentDocument {
    /// The widest.
    pub greatest: String,
    /// The last impact's.
    pub last: String,
}

/// The true errors of `float`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct TruthDocument {
    /// What judged.
    pub judge: String,
    /// Impacts on the true word that were compared.
    pub judged: u64,
    /// The largest errors.
    pub largest_error: LargestErrors,
    /// Where times are off by more than a threshold.
    pub time_errors: Vec<CrossingDocument>,
    /// Where it leaves the true word.
    pub leaves_word: Option<WordLeft>,
}

/// The largest errors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct LargestErrors {
    /// Of a time.
    pub time: Option<LargestError>,
    /// Of a velocity.
    pub velocity: Option<LargestError>,
}

/// The largest error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct LargestError {
    /// It lies between them.
    pub bounds: [String; 2],
    /// The impact with the greatest upper bound.
    pub impact: u64,
}

/// Where times are off by more than a threshold.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct CrossingDocument {
    /// In periods.
    pub threshold: String,
    /// Up to this impact none is, which is proved.
    pub within: u64,
    /// The first one that is proved to be.
    pub exceeded: Option<u64>,
}

/// Where the true word is left.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct WordLeft {
    /// The impact.
    pub impact: u64,
    /// Its true wall.
    pub truth: Wall,
    /// The wall of `float`; `null` if there it ends.
    pub float: Option<Wall>,
}
