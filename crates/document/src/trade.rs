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

/// The cost of accuracy on a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct TradeDocument {
    /// Schema of the document: [`TRADE_SCHEMA`].
    pub schema: String,
    /// Name and version of the program, such as `impact-pair 0.1.0`.
    pub program: String,
    /// Scene that everything here is about: excitation, gap, restitution coefficient and start, as exact expressions.
    pub scene: SceneDocument,
    /// How far each row was followed.
    pub requested: TradeRequest,
    /// The units of widths and errors.
    pub units: TradeUnits,
    /// The row that was interrupted.
    pub interrupted: Option<String>,
    /// A row for each arithmetic.
    pub arithmetics: Vec<RowDocument>,
}

/// How far each row was followed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct TradeRequest {
    /// Number of impacts.
    pub impacts: Option<u64>,
    /// The time, as written.
    pub until: Option<String>,
    /// Maximum precision in bits.
    pub max_bits: u32,
}

/// Units in words.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct TradeUnits {
    /// Unit of times.
    pub time: String,
    /// Unit of velocities.
    pub velocity: String,
}

/// An arithmetic, measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct RowDocument {
    /// Name of the arithmetic.
    pub name: String,
    /// Its options on the command line.
    pub requested: RowOptions,
    /// The arithmetic with its precision.
    pub arithmetic: ArithmeticDocument,
    /// Whether the bounds are certified.
    pub certified: bool,
    /// Whether all requested impacts are reached.
    pub complete: bool,
    /// Number of impacts reached.
    pub impacts: u64,
    /// Outcome of the orbit.
    pub outcome: OutcomeDocument,
    /// Duration.
    pub seconds: Seconds,
    /// Duration per impact.
    pub microseconds_per_impact: Microseconds,
    /// Impacts per second, without bounds.
    pub impacts_per_second: Option<f64>,
    /// `-log10` of the greatest width, rounded down.
    pub digits: Option<f64>,
    /// Guaranteed widths.
    pub widths: Option<WidthsDocument>,
    /// The true errors, of `float`.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub truth: Option<TruthDocument>,
}

/// Options of the command line for an arithmetic.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schemas", schemars(rename = "RungAsked"))]
pub struct RowOptions {
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
    /// Impacts enclosed, in reduced units.
    pub orbit: f64,
    /// Impacts with their bounds in the units of the scene.
    pub with_bounds: Option<f64>,
    /// Number of runs.
    pub repetitions: usize,
}

/// Duration per impact.
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
    /// Widths of times.
    pub time: ExtentDocument,
    /// Widths of velocities.
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
    /// The reference arithmetic.
    pub judge: String,
    /// Number of impacts compared, on the true word.
    pub judged: u64,
    /// The largest errors.
    pub largest_error: LargestErrors,
    /// Where errors of times exceed a threshold.
    pub time_errors: Vec<CrossingDocument>,
    /// Where it departs from the true word.
    pub leaves_word: Option<WordLeft>,
}

/// The largest errors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct LargestErrors {
    /// Error of a time.
    pub time: Option<LargestError>,
    /// Error of a velocity.
    pub velocity: Option<LargestError>,
}

/// The largest error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct LargestError {
    /// Lower and upper bound.
    pub bounds: [String; 2],
    /// The impact with the greatest upper bound.
    pub impact: u64,
}

/// Where errors of times exceed a threshold.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct CrossingDocument {
    /// The threshold, in periods.
    pub threshold: String,
    /// Up to this impact it is proved that no error exceeds it.
    pub within: u64,
    /// The first impact whose error is proved to exceed it.
    pub exceeded: Option<u64>,
}

/// Where the orbit departs from the true word.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct WordLeft {
    /// The impact.
    pub impact: u64,
    /// Its true wall.
    pub truth: Wall,
    /// The wall of `float`; `null` if it ends there.
    pub float: Option<Wall>,
}
