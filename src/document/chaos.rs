//! The JSON of trapping regions and of chaos.

use std::f64::consts::TAU;
use std::iter;

use num_traits::ToPrimitive;

use impact_pair_document::{
    BaseDocument, CHAOS_CELLS_SCHEMA, CHAOS_SCHEMA, ChaosCellsDocument, ChaosDocument, Corner, CornersDocument,
    Decimal, EnteredDocument, EntropyDocument, GivenBase, HyperbolicDocument, LeftOutDocument, NotNegative, PROGRAM,
    ParameterRange, PeriodDocument, RatesDocument, SceneDocument, SceneOrbitDocument, StretchDocument, TRAP_SCHEMA,
    TrapDocument, UpTo, WallWordsDocument, WordDocument, bounds,
};

use super::shares::shares;
use crate::chaos::{
    Asymptotics, Cells, Chaos, Chord, HSet, Horseshoe, Hyperbolic, LeftOut, RangeSettings, Stretch, Trap, Verdict,
    WallWords,
};
use crate::exact::{Enclosure, decimal_bounds_f64, decimal_f64};
use crate::mapping::Word;
use crate::pair::Wall;
use crate::scene::Range;
use crate::units::{self, Units};
use crate::{Error, Scene};

/// Bits that bounds are given in.
const BITS: u32 = 96;

/// Returns a region of a scene.
///
/// # Errors
/// If a value exceeds the range of exact expressions.
pub fn trap(scene: &Scene, trap: &Trap) -> Result<TrapDocument, Error> {
    let reference = scene.pair().excitation().reference();
    let (period, fastest) = (units::period(reference)?, Units::amplitudes(reference)?.velocity);
    let [period, fastest] = [period, fastest].map(|unit| unit.enclose(BITS));
    let bounds_text = |[low, high]: [f64; 2]| Enclosure::from_f64_bounds(low, high).expect("finite bounds in order");
    let (flight, speed) = (bounds_text(trap.flight()), bounds_text(trap.speed()));
    let (columns, rows) = trap.grid();
    let runs = trap.columns().into_iter();
    Ok(TrapDocument {
        schema: TRAP_SCHEMA.to_owned(),
        program: PROGRAM.to_owned(),
        certified: true,
        scene: SceneDocument::new(scene.pair(), scene.start()),
        boxes: trap.boxes() as u64,
        entered_at_impact: trap.entered(),
        no_rest: true,
        longest_flight: upper(trap.flight()[1]),
        speed: bounds(&speed),
        columns: columns as u32,
        rows: rows as u32,
        flight: bounds(&flight),
        flight_time: bounds(&flight.mul(&period, BITS)),
        speed_before: bounds(&speed.mul(&fastest, BITS)),
        region: runs
            .flat_map(|(column, runs)| runs.into_iter().map(move |(first, last)| [column, first, last]))
            .collect(),
        words: None,
    })
}

/// Returns the bounds for words of walls, as the document of their region has them.
pub fn wall_words(words: &WallWords) -> WallWordsDocument {
    WallWordsDocument {
        impacts: words.impacts(),
        count: Decimal::printed(words.count().to_string()),
        entropy_at_most: raised(words.entropy()),
    }
}

/// Returns the bounds of a document as text.
pub fn bounds_text([low, high]: &[Decimal; 2]) -> String {
    format!("{} to {}", low.text(), high.text())
}

/// Returns the chaos document of a scene, over a range of a parameter if given.
pub fn chaos(scene: &Scene, over: Option<&Range>, chaos: &Chaos) -> ChaosDocument {
    ChaosDocument {
        schema: CHAOS_SCHEMA.to_owned(),
        program: PROGRAM.to_owned(),
        certified: chaos.entropy() > 0.0, // exact: none is proved where it is 0
        scene: SceneDocument::new(scene.pair(), scene.start()),
        over: over.map(range),
        depth: UpTo::counted(chaos.depth()),
        boxes: chaos.boxes(),
        entropy: entropy([chaos.entropy(), chaos.entropy_a_cycle()]),
        horseshoe: chaos.horseshoe().map(|pair| {
            let [a, b] = pair.map(|word| word.as_block());
            format!(
                "each block is {a} or {b}, in any order in the map mirrored to one wall: \
                 each is written as it starts on the left wall, and mirrored where it starts on the right one"
            )
        }),
        scene_orbit: scene_orbit(chaos.asymptotics()),
        interrupted: chaos.is_interrupted(),
        bases: chaos.bases().iter().map(base).collect(),
        words: chaos
            .words()
            .iter()
            .map(|word| WordDocument {
                from: word.from as u32,
                to: word.to as u32,
                impacts: word.walls.len() as u32,
                half_cycles: word.half_cycles,
                flights: flights(&word.walls),
            })
            .collect(),
        exponent_seen: chaos.exponent(),
        hyperbolic: None,
        left_out: Vec::new(),
    }
}

/// Writes into a document what its hyperbolic set is proved to be, or that none is, and why words are left out.
pub fn with_hyperbolic(document: ChaosDocument, set: &Result<Hyperbolic, Vec<(usize, LeftOut)>>) -> ChaosDocument {
    let left_out = set.as_ref().map_or_else(|all| all, |set| &set.left_out).iter();
    let left_out = left_out.map(|(word, why)| LeftOutDocument { word: *word as u32, reason: why.name().to_owned() });
    ChaosDocument { hyperbolic: Some(set.as_ref().ok().map(hyperbolic)), left_out: left_out.collect(), ..document }
}

/// Returns what a hyperbolic set is measured to be.
fn hyperbolic(set: &Hyperbolic) -> HyperbolicDocument {
    let of = |[low, high]: [f64; 2]| bounds(&Enclosure::from_f64_bounds(low, high).expect("finite bounds in order"));
    let rates = |[impact, cycle]: [[f64; 2]; 2]| RatesDocument { per_impact: of(impact), per_cycle: of(cycle) };
    HyperbolicDocument {
        kappa: Decimal::printed(decimal_f64(set.kappa)),
        cells: set.cells as u64,
        words: set.words.iter().map(|&word| word as u32).collect(),
        entropy: rates(set.entropy),
        exponents: rates(set.exponents),
        second_exponent: of(set.second),
        dimension: of(set.dimension),
    }
}

pub(super) fn range(over: &Range) -> ParameterRange {
    ParameterRange { key: over.key().place(), low: over.low().into(), high: over.high().into() }
}

/// Returns lower bounds of the entropy per impact and per forcing period.
pub(crate) fn entropy([impact, cycle]: [f64; 2]) -> EntropyDocument {
    EntropyDocument { per_impact: lower(impact), per_cycle: lower(cycle) }
}

/// Returns the results proved of the scene's own orbit, if there are any.
fn scene_orbit(asymptotics: &Asymptotics) -> Option<SceneOrbitDocument> {
    let attracted = asymptotics.attractor.as_ref().map(|attractor| period(&attractor.word, attractor.cycles));
    let region = asymptotics.region.map(|entered| EnteredDocument {
        boxes: entered.boxes as u64,
        entered_at_impact: entered.at_impact,
        holds_bases: entered.holds_bases,
    });
    (attracted.is_some() || region.is_some()).then_some(SceneOrbitDocument { attracted, region })
}

/// Returns a periodic orbit by its word.
pub(crate) fn period(word: &Word, cycles: u32) -> PeriodDocument {
    PeriodDocument { word: word.to_string(), impacts: word.mappings().len() as u32, cycles }
}

/// Returns the verdicts over a range of a parameter.
pub fn cells(scene: &Scene, requested: &RangeSettings, cells: &Cells) -> ChaosCellsDocument {
    ChaosCellsDocument {
        schema: CHAOS_CELLS_SCHEMA.to_owned(),
        program: PROGRAM.to_owned(),
        certified: cells.stretches.iter().all(|stretch| stretch.verdict != Verdict::Undecided),
        scene: SceneDocument::new(scene.pair(), scene.start()),
        over: range(&requested.over),
        cells: requested.cells,
        halvings: requested.halvings,
        depth: UpTo::counted(requested.depth),
        interrupted: cells.interrupted,
        shares: shares(&requested.over, cells),
        stretches: cells.stretches.iter().map(stretch).collect(),
    }
}

fn stretch(stretch: &Stretch) -> StretchDocument {
    let plain = StretchDocument {
        low: (&stretch.low).into(),
        high: (&stretch.high).into(),
        verdict: stretch.verdict.name().to_owned(),
        entropy: None,
        bases: Vec::new(),
        period: None,
    };
    let proved = match stretch.verdict.horseshoe() {
        Some(Horseshoe { entropy: bounds, bases }) => {
            StretchDocument { entropy: Some(entropy(*bounds)), bases: bases.iter().map(base).collect(), ..plain }
        }
        None => plain,
    };
    let period = stretch.verdict.period().map(|(word, cycles)| period(word, cycles));
    StretchDocument { period, ..proved }
}

/// A bound in three digits rounded down, or up: bounds are rounded outward by a two-hundredth of what is between them at most.
fn lower(x: f64) -> NotNegative {
    let [lower, _] = decimal_bounds_f64(x, x + 1e-5);
    NotNegative::printed(if x > 0.0 { lower } else { "0".to_owned() })
}

/// An upper bound of an entropy, as [`lower`] rounds lower ones.
fn raised(x: f64) -> Decimal {
    let [_, upper] = decimal_bounds_f64(x - 1e-5, x);
    Decimal::printed(if x > 0.0 { upper } else { "0".to_owned() })
}

fn upper(x: f64) -> Decimal {
    let [_, upper] = decimal_bounds_f64(0.5 * x, x);
    Decimal::printed(upper)
}

/// The flights to these walls, from the left one: far or near.
fn flights(walls: &[Wall]) -> String {
    let before = iter::once(&Wall::Left).chain(walls);
    before.zip(walls).map(|(from, to)| if from == to { 'N' } else { 'F' }).collect()
}

pub(super) fn base(base: &HSet) -> BaseDocument {
    let HSet { left, right } = base;
    let middle = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [0.5 * (a + c), 0.5 * (b + d)];
    let (low, high) = (middle(left.bottom, right.bottom), middle(left.top, right.top));
    let centre = middle(low, high);
    let from_centre = |[x, y]: [f64; 2]| [x - centre[0], y - centre[1]];
    let written = |[phase, speed]: [f64; 2]| [TAU * phase, speed].map(|x| Decimal::printed(decimal_f64(x)));
    let [phase, speed] = written(centre);
    BaseDocument {
        phase,
        speed,
        expanding: written(from_centre(middle(right.bottom, right.top))),
        contracting: written(from_centre(high)),
        corners: CornersDocument {
            left: [left.bottom, left.top].map(Corner),
            right: [right.bottom, right.top].map(Corner),
        },
    }
}

/// The h-sets that a user gives.
pub fn bases(document: &[GivenBase]) -> Vec<HSet> {
    document.iter().map(of_document).collect()
}

fn of_document(base: &GivenBase) -> HSet {
    let chord = |[bottom, top]: [[f64; 2]; 2]| Chord { bottom, top };
    if let Some(CornersDocument { left, right }) = base.corners {
        let [left, right] = [left, right].map(|edge| chord(edge.map(|corner| corner.0)));
        return HSet { left, right };
    }
    let double = |x: &Decimal| x.value().to_f64().unwrap_or(f64::NAN);
    let read = |[phase, speed]: [&Decimal; 2]| [double(phase) / TAU, double(speed)];
    let centre = read([&base.phase, &base.speed]);
    let [u, s] = [&base.expanding, &base.contracting].map(|[phase, speed]| read([phase, speed]));
    let corner = |a: f64, b: f64| [centre[0] + a * u[0] + b * s[0], centre[1] + a * u[1] + b * s[1]];
    HSet { left: chord([corner(-1.0, -1.0), corner(-1.0, 1.0)]), right: chord([corner(1.0, -1.0), corner(1.0, 1.0)]) }
}
