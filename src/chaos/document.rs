//! The JSON of trapping regions and of chaos.

use std::f64::consts::TAU;
use std::iter;

use num_traits::ToPrimitive;

use impact_pair_document::{
    BaseDocument, Between, CHAOS_SCHEMA, ChaosDocument, ChaosWitness, ConeWordDocument, ConesWitness, Corner,
    CornersDocument, Decimal, EnteredDocument, EntropyDocument, GivenBase, HyperbolicDocument, LeftOutDocument,
    MovedDocument, NotNegative, PROGRAM, ParameterRange, PeriodDocument, RatesDocument, SceneDocument,
    SceneOrbitDocument, StripDocument, TRAP_SCHEMA, TrapDocument, UpTo, WallWordsDocument, WordDocument, bounds,
};

use super::blocks::Word as Block;
use super::hyperbolic::WordProof;
use crate::chaos::{Asymptotics, Chaos, Chord, HSet, Hyperbolic, HyperbolicSet, Moved, Strip, Trap, WallWords};
use crate::exact::{Enclosure, decimal_bounds_f64, decimal_f64};
use crate::mapping::Word;
use crate::pair::Wall;
use crate::scene::Range;
use crate::units::{self, Units};
use crate::{Error, Scene};

/// Bits that bounds are given in.
const BITS: u32 = 96;

impl Trap {
    /// Returns the document of this region of a scene.
    ///
    /// # Errors
    /// If a value exceeds the range of exact expressions.
    pub fn document(&self, scene: &Scene) -> Result<TrapDocument, Error> {
        let reference = scene.pair().excitation().reference();
        let (period, fastest) = (units::period(reference)?, Units::amplitudes(reference)?.velocity);
        let [period, fastest] = [period, fastest].map(|unit| unit.enclose(BITS));
        let enclosed = |[low, high]: [f64; 2]| Enclosure::from_f64_bounds(low, high).expect("finite bounds in order");
        let (flight, speed) = (enclosed(self.flight()), enclosed(self.speed()));
        let (columns, rows) = self.grid();
        let runs = self.columns().into_iter();
        Ok(TrapDocument {
            schema: TRAP_SCHEMA.to_owned(),
            program: PROGRAM.to_owned(),
            certified: true,
            scene: SceneDocument::new(scene.pair(), scene.start()),
            boxes: self.boxes() as u64,
            entered_at_impact: self.entered(),
            no_rest: true,
            longest_flight: upper(self.flight()[1]),
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
}

impl From<&WallWords> for WallWordsDocument {
    fn from(words: &WallWords) -> Self {
        Self {
            impacts: words.impacts(),
            count: Decimal::printed(words.count().to_string()),
            entropy_at_most: raised(words.entropy()),
        }
    }
}

impl Chaos {
    /// Returns the document of the horseshoe of a scene, over a range of a parameter if given, and of what its hyperbolic set is proved to be,
    /// or that none is, where that was asked.
    pub fn document(&self, scene: &Scene, over: Option<&Range>, set: Option<&HyperbolicSet>) -> ChaosDocument {
        let left_out = set.map(|set| set.as_ref().map_or_else(|all| all, |set| &set.left_out)).into_iter().flatten();
        let left_out = left_out.map(|(word, why)| LeftOutDocument { word: *word as u32, reason: *why });
        ChaosDocument {
            schema: CHAOS_SCHEMA.to_owned(),
            program: PROGRAM.to_owned(),
            certified: self.entropy() > 0.0, // exact: none is proved where it is 0
            scene: SceneDocument::new(scene.pair(), scene.start()),
            over: over.map(ParameterRange::from),
            depth: UpTo::counted(self.depth()),
            boxes: self.boxes(),
            entropy: entropy([self.entropy(), self.entropy_a_cycle()]),
            horseshoe: self.horseshoe().map(|pair| {
                let [a, b] = pair.map(|word| word.as_block());
                format!(
                    "each block is {a} or {b}, in any order in the map mirrored to one wall: \
                 each is written as it starts on the left wall, and mirrored where it starts on the right one"
                )
            }),
            scene_orbit: scene_orbit(self.asymptotics()),
            interrupted: self.is_interrupted(),
            bases: self.bases().iter().map(base).collect(),
            words: self.words().iter().map(word).collect(),
            exponent_seen: self.exponent(),
            hyperbolic: set.map(|set| set.as_ref().ok().map(hyperbolic)),
            left_out: left_out.collect(),
            witness: Some(ChaosWitness {
                strips: self.strips().iter().map(strip).collect(),
                cones: set.and_then(|set| set.as_ref().ok()).map(cones),
            }),
        }
    }
}

pub(super) fn word(word: &Block) -> WordDocument {
    WordDocument {
        from: word.from as u32,
        to: word.to as u32,
        impacts: word.walls.len() as u32,
        half_cycles: word.half_cycles,
        flights: flights(&word.walls),
    }
}

/// Returns what a hyperbolic set is proved with.
fn cones(set: &Hyperbolic) -> ConesWitness {
    let number = |x: f64| Decimal::printed(decimal_f64(x));
    let word = |word: &WordProof| ConeWordDocument {
        left: word.strip.left.map(number),
        right: word.strip.right.map(number),
        rises: word.rises,
        counts: word.counts,
    };
    let written = hyperbolic(set).dimension;
    // Both parts of the dimension share what its bounds are rounded by.
    let unstable = [0, 1].map(|end| {
        let rounded = written[end].value().to_f64().unwrap_or(f64::NAN) - set.dimension[end];
        number(set.proof.unstable[end] + 0.5 * rounded)
    });
    ConesWitness {
        words: set.proof.words.iter().map(word).collect(),
        letters: set.proof.letters.map(|letters| letters as u32), // exact: a few
        unstable: Between::computed(unstable),
    }
}

/// Returns the sides of a strip, and how they move.
pub(super) fn strip(strip: &Strip) -> StripDocument {
    let side = |parts: &[f64]| parts.iter().map(|part| Decimal::printed(part.to_string())).collect();
    let moved = |Moved { by, left, right }: &Moved| MovedDocument {
        by: by.map(|power| power as u32),
        left: side(left),
        right: side(right),
    };
    StripDocument { left: side(&strip.left), right: side(&strip.right), moved: strip.moved.iter().map(moved).collect() }
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

/// Returns lower bounds of the entropy per impact and per forcing period.
pub fn entropy([impact, cycle]: [f64; 2]) -> EntropyDocument {
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
pub fn period(word: &Word, cycles: u32) -> PeriodDocument {
    PeriodDocument { word: word.to_string(), impacts: word.mappings().len() as u32, cycles }
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

/// The h-set that a user gives.
impl From<&GivenBase> for HSet {
    fn from(base: &GivenBase) -> Self {
        let chord = |[bottom, top]: [[f64; 2]; 2]| Chord { bottom, top };
        if let Some(CornersDocument { left, right }) = base.corners {
            let [left, right] = [left, right].map(|edge| chord(edge.map(|corner| corner.0)));
            return Self { left, right };
        }
        let double = |x: &Decimal| x.value().to_f64().unwrap_or(f64::NAN);
        let read = |[phase, speed]: [&Decimal; 2]| [double(phase) / TAU, double(speed)];
        let centre = read([&base.phase, &base.speed]);
        let [u, s] = [&base.expanding, &base.contracting].map(|[phase, speed]| read([phase, speed]));
        let corner = |a: f64, b: f64| [centre[0] + a * u[0] + b * s[0], centre[1] + a * u[1] + b * s[1]];
        Self {
            left: chord([corner(-1.0, -1.0), corner(-1.0, 1.0)]),
            right: chord([corner(1.0, -1.0), corner(1.0, 1.0)]),
        }
    }
}
