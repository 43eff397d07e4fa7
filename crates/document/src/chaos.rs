//! The JSON of regions and of chaos, schemas `impact-pair/trap/1`, `impact-pair/chaos/1` and `impact-pair/chaos-cells/1`.

use serde::{Deserialize, Serialize};

use super::bifurcation::ParameterRange;
use super::number::{Bounds, Decimal, Written};
use super::scene::SceneDocument;

/// The schema of a region.
pub const TRAP_SCHEMA: &str = "impact-pair/trap/1";
/// The schema of words and entropy.
pub const CHAOS_SCHEMA: &str = "impact-pair/chaos/1";
/// The schema of what is proved of each value of a parameter.
pub const CHAOS_CELLS_SCHEMA: &str = "impact-pair/chaos-cells/1";

/// A region that the impact map does not leave; every impact is mirrored to the left wall.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct TrapDocument {
    /// [`TRAP_SCHEMA`]
    pub schema: String,
    /// What proved it.
    pub program: String,
    /// A region that is told is proved.
    pub certified: bool,
    /// Whose it is.
    pub scene: SceneDocument,
    /// How many boxes it has.
    pub boxes: u64,
    /// The impact of the scene's own orbit from which on all are in the region; 0 is its start. `null` if none is proved to be.
    pub entered_at_impact: Option<u64>,
    /// No motion in it comes to rest, or has chatter that ends.
    pub no_rest: bool,
    /// The longest flight \[cycles\], rounded up.
    pub longest_flight: Decimal,
    /// The speed before any impact, over `A W`, bounds.
    pub speed: Bounds,
    /// Columns in a turn of the phase: column `i` holds the phases from `i` to `i + 1` of so many parts of a turn.
    pub columns: u32,
    /// Rows in a speed of `A W`, likewise.
    pub rows: u32,
    /// The time of any flight \[cycles\], bounds.
    pub flight: Bounds,
    /// The same \[time\].
    pub flight_time: Bounds,
    /// The speed before any impact \[length/time\], bounds.
    pub speed_before: Bounds,
    /// Runs of boxes: a column, the first row and the last one.
    pub region: Vec<[i32; 3]>,
}

/// Words of the impact map that may follow one another, and what they say of entropy.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ChaosDocument {
    /// [`CHAOS_SCHEMA`]
    pub schema: String,
    /// What proved them.
    pub program: String,
    /// Whether a bound of entropy is proved.
    pub certified: bool,
    /// Whose they are.
    pub scene: SceneDocument,
    /// The parameter over whose whole range all is proved; its own value in the scene is one of no account.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub over: Option<ParameterRange>,
    /// The most impacts of a word, as far as all were looked for.
    pub depth: u32,
    /// How many boxes were mapped.
    pub boxes: u64,
    /// Lower bounds of the topological entropy; 0 where none is proved.
    pub entropy: EntropyDocument,
    /// The two blocks with the fewest impacts that follow one another in any order in the map mirrored to one wall. A block is a
    /// sequence of walls and a number of half cycles; it is written as it starts on the left wall, and mirrored where it starts on the
    /// right one. The time between the impacts at its ends is these half cycles and what the phases of the two h-sets differ by.
    pub horseshoe: Option<String>,
    /// What is proved of the orbit of the scene's own start.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub scene_orbit: Option<SceneOrbitDocument>,
    /// Whether it was stopped before the depth that was asked for.
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    pub interrupted: bool,
    /// The bases, disjoint from each other and from their own translates by whole forcing periods.
    pub bases: Vec<BaseDocument>,
    /// The words.
    pub words: Vec<WordDocument>,
    /// The Lyapunov exponent of the floating orbit, an impact: seen, not proved.
    pub exponent_seen: Option<f64>,
}

/// What is proved of the orbit of the scene's own start: whether it is where the horseshoe is. Where nothing is proved it may be so all the same.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct SceneOrbitDocument {
    /// The stable periodic orbit that it converges to: then only its transient sees the horseshoe, a chaotic saddle to it.
    pub attracted: Option<PeriodDocument>,
    /// A region that it enters and does not leave.
    pub region: Option<EnteredDocument>,
}

/// A stable periodic orbit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct PeriodDocument {
    /// Its word, the right-most mapping first in time.
    pub word: String,
    /// How many impacts it has.
    pub impacts: u32,
    /// How many cycles it takes.
    pub cycles: u32,
}

/// A region that an orbit enters and does not leave, as `trap` proves it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct EnteredDocument {
    /// How many boxes it has.
    pub boxes: u64,
    /// The impact from which on all are in it; 0 is the start.
    pub entered_at_impact: u64,
    /// Whether all bases are proved to lie in it, and so the horseshoe.
    pub holds_bases: bool,
}

/// Of each value of a parameter what is proved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ChaosCellsDocument {
    /// [`CHAOS_CELLS_SCHEMA`]
    pub schema: String,
    /// What proved it.
    pub program: String,
    /// Whether no value is undecided.
    pub certified: bool,
    /// Whose it is; the parameter's own value in it only names the scene.
    pub scene: SceneDocument,
    /// The parameter and its range.
    pub over: ParameterRange,
    /// Cells that the range is cut into.
    pub cells: u32,
    /// How often a cell is halved at most.
    pub halvings: u32,
    /// The most impacts of a horseshoe's words.
    pub depth: u32,
    /// Whether it was stopped: what was not looked at is undecided.
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    pub interrupted: bool,
    /// How much of the range is proved, about, in parts of it.
    pub shares: SharesDocument,
    /// The stretches of the range, without gaps and in their order; each verdict holds for both ends, too.
    pub stretches: Vec<StretchDocument>,
}

/// Parts of a range, about. A horseshoe and an orbit that is attracted do not exclude each other: `horseshoe + attracted - both + undecided` is 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct SharesDocument {
    /// With a horseshoe that is proved, whatever becomes of the scene's own orbit.
    pub horseshoe: f64,
    /// Where the scene's own orbit converges to a stable periodic orbit.
    pub attracted: f64,
    /// Of both.
    #[serde(default)]
    pub both: f64,
    /// Of which nothing is proved.
    pub undecided: f64,
}

/// A stretch of a parameter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct StretchDocument {
    /// Its lower end.
    pub low: Written,
    /// Its upper end.
    pub high: Written,
    /// `horseshoe`, `attracted` (of the orbit of the scene's own start; a horseshoe beside it is told by `entropy`) or `undecided`.
    pub verdict: String,
    /// Of a horseshoe, lower bounds of the topological entropy.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub entropy: Option<EntropyDocument>,
    /// Of a horseshoe, its bases: `chaos --bases` takes them.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub bases: Vec<BaseDocument>,
    /// The stable periodic orbit that attracts.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub period: Option<PeriodDocument>,
}

/// Lower bounds of entropy, in nats, rounded down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct EntropyDocument {
    /// An impact.
    pub per_impact: Decimal,
    /// A cycle.
    pub per_cycle: Decimal,
}

/// A base: a quadrilateral of states, about a parallelogram.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct BaseDocument {
    /// Its middle, about: `W t + tau` \[rad\].
    pub phase: Decimal,
    /// The speed there over `A W`, about.
    pub speed: Decimal,
    /// From the middle to that of the right edge: \[rad\], and a speed over `A W`.
    pub expanding: [Decimal; 2],
    /// From the middle to that of the upper edge.
    pub contracting: [Decimal; 2],
    /// What it is exactly; without it it is the parallelogram.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub corners: Option<CornersDocument>,
}

/// The corners of a base: each a phase in turns and a speed over `A W`, exactly these doubles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct CornersDocument {
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
    /// How many impacts it has.
    pub impacts: u32,
    /// Half cycles from its start to its end, less what the phases of the two bases differ by.
    pub half_cycles: i64,
    /// Its flights in order of time: `F` to the far wall, `N` back to the near one.
    pub flights: String,
}
