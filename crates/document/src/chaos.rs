//! The JSON of trapping regions and of chaos, schemas `impact-pair/trap/1`, `impact-pair/chaos/1` and `impact-pair/chaos-cells/1`.

use impact_pair_model::vocabulary::{LeftOut, StretchVerdict};
use serde::{Deserialize, Deserializer, Serialize};

use super::bifurcation::ParameterRange;
use super::number::{Bounds, Decimal, NotNegative, UpTo, Written};
use super::scene::SceneDocument;

/// The schema of a trapping region.
pub const TRAP_SCHEMA: &str = "impact-pair/trap/1";
/// The schema of words and entropy.
pub const CHAOS_SCHEMA: &str = "impact-pair/chaos/1";
/// The schema of verdicts over a range of a parameter.
pub const CHAOS_CELLS_SCHEMA: &str = "impact-pair/chaos-cells/1";

/// Impacts of a word at most. Beyond [`MOST_DEPTH`] the images of h-sets are narrower than doubles resolve: an impact stretches them by
/// about 1.5.
pub type Depth = UpTo<MOST_DEPTH>;

/// The greatest depth.
pub const MOST_DEPTH: u32 = 64;

/// Words of a document at most: that a horseshoe is the shortest one takes a comparison of any two of them.
pub const MOST_WORDS: usize = 4096;

/// A trapping region: forward invariant under the impact map, with every impact mirrored to the left wall.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct TrapDocument {
    /// Schema of the document: [`TRAP_SCHEMA`].
    pub schema: String,
    /// Name and version of the program, such as `impact-pair 0.1.0`.
    pub program: String,
    /// Always true: a region that is written is proved.
    pub certified: bool,
    /// Scene that everything here is about: excitation, gap, restitution coefficient and start, as exact expressions.
    pub scene: SceneDocument,
    /// Number of boxes of the region.
    pub boxes: u64,
    /// Number, as `run --digits 9` lists it, of the impact of the scene's own orbit from which on all impacts are in the region; 0 is its start.
    /// `null` if none is proved to be.
    pub entered_at_impact: Option<u64>,
    /// Whether no motion in it sticks or has complete chatter.
    pub no_rest: bool,
    /// The longest flight \[forcing periods\], rounded up.
    pub longest_flight: Decimal,
    /// Bounds of the speed before any impact, over `A W`.
    pub speed: Bounds,
    /// Number `n` of columns per forcing period: column `i` holds the phases from `i/n` to `(i + 1)/n` of a period.
    pub columns: u32,
    /// Number `m` of rows per speed `A W`: row `j` holds the speeds from `j/m` to `(j + 1)/m` of `A W`.
    pub rows: u32,
    /// Bounds of the duration of any flight \[forcing periods\].
    pub flight: Bounds,
    /// Bounds of the duration of any flight \[time\].
    pub flight_time: Bounds,
    /// Bounds of the speed before any impact \[length/time\].
    pub speed_before: Bounds,
    /// Runs of boxes: a column, the first row and the last one.
    pub region: Vec<[i32; 3]>,
    /// What words of walls the motions in it can make, if that was asked.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub words: Option<WallWordsDocument>,
}

/// Upper bounds for the words of walls that motions in a region make from any impact in it on: a flight to the far wall (P1 or P2) or back to
/// the near one (P3 or P4).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct WallWordsDocument {
    /// Number of impacts of the words that are counted.
    pub impacts: u32,
    /// An upper bound of the number of these words: a graph of the boxes allows no others.
    pub count: Decimal,
    /// The topological entropy of the words is at most this, in nats per impact, rounded up.
    pub entropy_at_most: Decimal,
}

/// Words of the impact map, which h-sets they connect, and the entropy that follows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ChaosDocument {
    /// Schema of the document: [`CHAOS_SCHEMA`].
    pub schema: String,
    /// Name and version of the program, such as `impact-pair 0.1.0`.
    pub program: String,
    /// Whether a positive lower bound of the entropy is proved.
    pub certified: bool,
    /// Scene that everything here is about: excitation, gap, restitution coefficient and start, as exact expressions.
    pub scene: SceneDocument,
    /// The parameter over whose whole range everything is proved; its own value in the scene is not used.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub over: Option<ParameterRange>,
    /// The greatest number of impacts up to which all words were searched for.
    pub depth: Depth,
    /// Number of boxes mapped.
    pub boxes: u64,
    /// Lower bounds of the topological entropy; 0 where none is proved.
    pub entropy: EntropyDocument,
    /// The two blocks with the fewest impacts that can follow one another in any order in the map mirrored to one wall. A block is a
    /// sequence of walls and a number of half forcing periods; it is written as starting on the left wall, and mirrored where it starts
    /// on the right one. The time between the impacts at its ends is these half cycles plus the difference of the phases of the two h-sets.
    pub horseshoe: Option<String>,
    /// The result for the orbit of the scene's own start.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub scene_orbit: Option<SceneOrbitDocument>,
    /// Whether it was stopped before the requested depth.
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    pub interrupted: bool,
    /// The h-sets, disjoint from each other and from their own translates by whole forcing periods.
    pub bases: Vec<BaseDocument>,
    /// The words.
    #[cfg_attr(feature = "schemas", schemars(length(max = MOST_WORDS)))]
    pub words: Vec<WordDocument>,
    /// The Lyapunov exponent per impact of the floating-point orbit: non-rigorous.
    pub exponent_seen: Option<f64>,
    /// A uniformly hyperbolic set of motions that words make, if it was requested; `null` where none is proved.
    #[serde(skip_serializing_if = "Option::is_none", default, deserialize_with = "present_or_null")]
    pub hyperbolic: Option<Option<HyperbolicDocument>>,
    /// The words that are not among those of that set, and why, if it was requested.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub left_out: Vec<LeftOutDocument>,
    /// What `check` proves the words with; it claims nothing.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub witness: Option<ChaosWitness>,
}

/// Strips of the words, and what the hyperbolic set is proved with.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ChaosWitness {
    /// A strip for each word, in their order: every curve from left to right in the h-set that the word starts in crosses it.
    #[cfg_attr(feature = "schemas", schemars(length(max = MOST_WORDS)))]
    pub strips: Vec<StripDocument>,
    /// What the hyperbolic set is proved with, if there is one.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub cones: Option<ConesWitness>,
}

/// What the cones and the rates of a hyperbolic set are proved with.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ConesWitness {
    /// The words of the set, in their order.
    #[cfg_attr(feature = "schemas", schemars(length(max = MOST_WORDS)))]
    pub words: Vec<ConeWordDocument>,
    /// Expansion is bounded along strings of this many words: of all words of the set, and of those that count for the lower bound of the dimension.
    pub letters: [u32; 2],
    /// The parts of the bounds of the dimension that are along the expanding direction, about.
    pub unstable: Bounds,
}

/// A word of a hyperbolic set, with a strip between two straight sides, in the coordinates of [`StripDocument`]: each side by its place at the middle
/// height, and by how far it is from there at the top. Numbers are read as the nearest doubles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ConeWordDocument {
    /// The left side.
    pub left: [Decimal; 2],
    /// The right side.
    pub right: [Decimal; 2],
    /// Whether the image of the strip runs from left to right.
    pub rises: bool,
    /// Whether the word counts for the lower bound of the dimension: no motion of the set is on its way along the word where another word of the set
    /// begins.
    pub counts: bool,
}

/// A strip between two curves across an h-set, in the coordinates of the parallelogram that the means of its corners make, about: `xi` from -1 to 1 from left
/// to right, `eta` from bottom to top.
///
/// Each is a polynomial `xi = c0 + c1 eta + c2 eta^2 + ...`, over `eta` from `-h` to `h`, where `h` is the least number `1 + 2^-k`,
/// `k` at most 30, that is beyond all corners. Coefficients are read as the nearest doubles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct StripDocument {
    /// The coefficients of the left side, from the constant on.
    #[cfg_attr(feature = "schemas", schemars(length(min = 1, max = 32)))]
    pub left: Vec<Decimal>,
    /// Those of the right side.
    #[cfg_attr(feature = "schemas", schemars(length(min = 1, max = 32)))]
    pub right: Vec<Decimal>,
    /// How both move with the parameters, where these are intervals.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    #[cfg_attr(feature = "schemas", schemars(length(max = 32)))]
    pub moved: Vec<MovedDocument>,
}

/// What is added to both sides of a strip: a power of `D = d/A` times one of `e`, each of them from -1 to 1 from the lower to the upper end of its
/// interval, times a polynomial of `eta` for each side.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct MovedDocument {
    /// The exponents of `D` and of `e`.
    pub by: [u32; 2],
    /// The coefficients for the left side, from the constant on.
    #[cfg_attr(feature = "schemas", schemars(length(min = 1, max = 32)))]
    pub left: Vec<Decimal>,
    /// Those for the right side.
    #[cfg_attr(feature = "schemas", schemars(length(min = 1, max = 32)))]
    pub right: Vec<Decimal>,
}

/// A word that is left out of a hyperbolic set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct LeftOutDocument {
    /// The word, counted from 0 in `words`.
    pub word: u32,
    /// Why: `overlap` (the h-sets overlap as parallelograms), `strip` (no strip of its own is seen in floating point), `leaning` (a curve
    /// in the cones could meet a side of its strip twice), `cells` (its strip would be cut into too many cells), `cone` (a smallest cell is not
    /// proved to map its cone into itself and to expand), `return` (no other word of the set leads to its h-set, or back), `strings` (the
    /// expansion of strings of words is not bounded), or `interrupted`.
    pub reason: LeftOut,
}

/// A key that is there, whether it is `null` or not.
fn present_or_null<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Option<HyperbolicDocument>>, D::Error> {
    Option::deserialize(deserializer).map(Some)
}

/// A uniformly hyperbolic set: for each two-sided sequence of its words that fit together it has exactly one motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct HyperbolicDocument {
    /// The greatest slope of the cones around the expanding direction, in coordinates from -1 to 1 along each h-set and across it.
    pub kappa: Decimal,
    /// Number of cells on which the cones are proved.
    pub cells: u64,
    /// Its words, counted from 0 in `words`: those that are proved to be hyperbolic, and lead back to each other.
    pub words: Vec<u32>,
    /// Bounds of the topological entropy on the set.
    pub entropy: RatesDocument,
    /// Bounds of the greater Lyapunov exponent of every invariant measure on the set.
    pub exponents: RatesDocument,
    /// Bounds of the smaller one per impact: `2 ln e` less the greater one.
    pub second_exponent: Bounds,
    /// Bounds of the Hausdorff dimension of the set, in the plane of phase and speed.
    pub dimension: Bounds,
}

/// Bounds of a rate, in nats.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct RatesDocument {
    /// Rate per impact.
    pub per_impact: Bounds,
    /// Rate per forcing period.
    pub per_cycle: Bounds,
}

/// The result for the orbit of the scene's own start: whether it visits the horseshoe. Absent keys mean undecided.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct SceneOrbitDocument {
    /// The stable periodic orbit that it converges to: then only its transient visits the horseshoe, a chaotic saddle.
    pub attracted: Option<PeriodDocument>,
    /// A trapping region that it enters.
    pub region: Option<EnteredDocument>,
}

/// A stable periodic orbit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct PeriodDocument {
    /// Its word, the right-most mapping first in time.
    pub word: String,
    /// Number of impacts of the word.
    pub impacts: u32,
    /// Number of forcing periods.
    pub cycles: u32,
}

/// A trapping region that an orbit enters, as `trap` proves it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct EnteredDocument {
    /// Number of boxes of the region.
    pub boxes: u64,
    /// Number, as `run --digits 9` lists it, of the impact from which on all impacts are in it; 0 is the start. Impacts of a chatter that are not
    /// listed have none.
    pub entered_at_impact: u64,
    /// Whether all h-sets, and so the horseshoe, are proved to lie in it.
    pub holds_bases: bool,
}

/// Verdicts for all values of a parameter in a range.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct ChaosCellsDocument {
    /// Schema of the document: [`CHAOS_CELLS_SCHEMA`].
    pub schema: String,
    /// Name and version of the program, such as `impact-pair 0.1.0`.
    pub program: String,
    /// Whether no value is undecided.
    pub certified: bool,
    /// The scene; its own value of the parameter is not used.
    pub scene: SceneDocument,
    /// The parameter and its range.
    pub over: ParameterRange,
    /// Number of cells of the range.
    pub cells: u32,
    /// Maximum number of bisections of a cell.
    pub halvings: u32,
    /// Maximum number of impacts of a word.
    pub depth: Depth,
    /// Whether it was stopped: the remaining cells are undecided.
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    pub interrupted: bool,
    /// Approximate fractions of the range with each verdict.
    pub shares: SharesDocument,
    /// The subintervals of the range, in order and without gaps; each verdict includes both endpoints.
    pub stretches: Vec<StretchDocument>,
}

/// Fractions of a range, in millionths: rounded down where something is proved, and up where nothing is. A horseshoe and a stable orbit
/// do not exclude each other: `horseshoe + attracted + stable - both + undecided` is 1 but for rounding.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct SharesDocument {
    /// Fraction with a proved horseshoe, whatever becomes of the scene's own orbit.
    pub horseshoe: f64,
    /// Fraction where the scene's own orbit converges to a stable periodic orbit.
    pub attracted: f64,
    /// Fraction with a stable periodic orbit that the scene's own orbit is not proved to converge to.
    #[serde(default)]
    pub stable: f64,
    /// Fraction with both, a horseshoe and a stable periodic orbit.
    #[serde(default)]
    pub both: f64,
    /// Undecided fraction.
    pub undecided: f64,
}

/// A subinterval of a range of a parameter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct StretchDocument {
    /// Lower end of the cell.
    pub low: Written,
    /// Upper end of the cell.
    pub high: Written,
    /// `horseshoe`, `attracted` (of the orbit of the scene's own start), `stable` (a stable periodic orbit exists, and the scene's own orbit is
    /// not proved to converge to it) or `undecided`; a horseshoe beside a stable orbit is given by `entropy`.
    pub verdict: StretchVerdict,
    /// For a horseshoe, lower bounds of the topological entropy.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub entropy: Option<EntropyDocument>,
    /// For a horseshoe, its h-sets, as `chaos --bases` reads them.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub bases: Vec<BaseDocument>,
    /// The stable periodic orbit; with the verdict `stable` it or its mirror image.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub period: Option<PeriodDocument>,
    /// What `check` proves the horseshoe with: the parts of the subinterval, in their order; it claims nothing.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub witness: Vec<StretchWitness>,
}

/// A part of a subinterval, from the end of the part before on: words of its horseshoe, and a strip for each of them, in their order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct StretchWitness {
    /// Upper end of the part.
    pub high: Written,
    /// The words.
    #[cfg_attr(feature = "schemas", schemars(length(max = MOST_WORDS)))]
    pub words: Vec<WordDocument>,
    /// The strips.
    #[cfg_attr(feature = "schemas", schemars(length(max = MOST_WORDS)))]
    pub strips: Vec<StripDocument>,
}

/// Lower bounds of entropy, in nats, rounded down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct EntropyDocument {
    /// Entropy per impact.
    pub per_impact: NotNegative,
    /// Entropy per forcing period.
    pub per_cycle: NotNegative,
}

/// An h-set: a quadrilateral of states, nearly a parallelogram.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schemas", schemars(rename = "BaseDocument"))]
pub struct BaseDocument<C = CornersDocument> {
    /// Approximate phase `W t + tau` of its middle \[rad\].
    pub phase: Decimal,
    /// Approximate speed of its middle over `A W`.
    pub speed: Decimal,
    /// From the middle to that of the right edge: \[rad\], and a speed over `A W`.
    pub expanding: [Decimal; 2],
    /// From the middle to that of the upper edge.
    pub contracting: [Decimal; 2],
    /// Exact corners of the h-set, in forcing periods and speeds over `A W`.
    pub corners: C,
}

/// An h-set that a user gives: without corners it is the parallelogram.
pub type GivenBase = BaseDocument<Option<CornersDocument>>;

/// The corners of an h-set: each a phase in forcing periods, within 4 of them of 0, and a speed over `A W`, above 0 and at most 1,048,576; exactly
/// these doubles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct CornersDocument {
    /// The left edge, from bottom to top.
    pub left: [Corner; 2],
    /// The right edge, likewise.
    pub right: [Corner; 2],
}

/// A corner of an h-set: a phase in forcing periods and a speed over `A W`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "[f64; 2]")]
pub struct Corner(pub [f64; 2]);

/// Forcing periods of a corner at most, before and after 0: `check` compares h-sets up to 8 forcing periods apart.
const MOST_PHASE: f64 = 4.0;
/// Speed of a corner over `A W` at most: above it doubles resolve 2^-32 at best, and the narrowest h-sets are 1e-5 wide.
const MOST_SPEED: f64 = 1_048_576.0;

impl TryFrom<[f64; 2]> for Corner {
    type Error = String;

    fn try_from([phase, speed]: [f64; 2]) -> Result<Self, String> {
        if phase.abs() < MOST_PHASE && speed > 0.0 && speed <= MOST_SPEED {
            return Ok(Self([phase, speed]));
        }
        Err(format!(
            "accepted is a phase within {MOST_PHASE} forcing periods of 0 and a speed above 0, at most {MOST_SPEED}"
        ))
    }
}

#[cfg(feature = "schemas")]
impl schemars::JsonSchema for Corner {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        <[f64; 2]>::schema_name()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        <[f64; 2]>::json_schema(generator)
    }
}

/// A word.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
pub struct WordDocument {
    /// The h-set it starts in, counted from 0.
    pub from: u32,
    /// The h-set that it covers.
    pub to: u32,
    /// Number of impacts of the word.
    pub impacts: u32,
    /// Half forcing periods from its start to its end, less the difference of the phases of the two h-sets.
    pub half_cycles: i64,
    /// Its flights in time order: `F` to the far wall, `N` back to the near one.
    pub flights: String,
}
