//! The JSON of regions that the motion does not leave, and of chaos.

use impact_pair_certificate::document::{
    BaseDocument, CHAOS_SCHEMA, ChaosDocument, Decimal, EntropyDocument, PROGRAM, ParameterRange, SceneDocument,
    TRAP_SCHEMA, TrapDocument, WordDocument, bounds,
};

use crate::chaos::{Base, Chaos, Chord, Question, Trap};
use crate::exact::{Enclosure, Exact};
use crate::pair::{Wall, within};
use crate::periodic::bifurcation::Over;
use crate::{Error, Scene};

/// Bits that bounds are told in.
const BITS: u32 = 96;

/// What the bounds of a region are told in: the period \[time\] and the greatest speed of the box \[length/time\].
fn units(scene: &Scene) -> Result<[Enclosure; 2], Error> {
    let reference = scene.pair().excitation().reference();
    let (amplitude, frequency) = (reference.amplitude(), reference.frequency());
    let turn = Exact::pi() * Exact::from(2);
    let period = within("excitation.frequency", frequency, turn.checked_div(frequency))?;
    let speed = within("excitation.frequency", frequency, amplitude.checked_mul(frequency))?;
    Ok([period, speed].map(|unit| unit.enclose(BITS)))
}

/// A region of a scene.
///
/// # Errors
/// When a value is beyond what exact expressions hold.
pub fn trap(scene: &Scene, trap: &Trap) -> Result<TrapDocument, Error> {
    let [period, fastest] = units(scene)?;
    let told = |[low, high]: [f64; 2]| Enclosure::from_f64_bounds(low, high).expect("finite bounds in order");
    let (flight, speed) = (told(trap.flight()), told(trap.speed()));
    let (columns, rows) = trap.grid();
    let runs = trap.columns().into_iter();
    Ok(TrapDocument {
        schema: TRAP_SCHEMA.to_owned(),
        program: PROGRAM.to_owned(),
        scene: SceneDocument::new(scene.pair(), scene.start()),
        columns: columns as u32,
        rows: rows as u32,
        count: trap.boxes() as u64,
        flight: bounds(&flight),
        flight_time: bounds(&flight.mul(&period, BITS)),
        speed: bounds(&speed),
        speed_before: bounds(&speed.mul(&fastest, BITS)),
        entered: trap.entered(),
        boxes: runs
            .flat_map(|(column, runs)| runs.into_iter().map(move |(first, last)| [column, first, last]))
            .collect(),
    })
}

/// The bounds of a document as text.
pub fn told([low, high]: &[Decimal; 2]) -> String {
    format!("{} to {}", low.text(), high.text())
}

/// What is proved of a scene's chaos, over a range of a parameter if one is given.
pub fn chaos(scene: &Scene, over: Option<&Over>, question: &Question, chaos: &Chaos) -> ChaosDocument {
    ChaosDocument {
        schema: CHAOS_SCHEMA.to_owned(),
        program: PROGRAM.to_owned(),
        scene: SceneDocument::new(scene.pair(), scene.start()),
        over: over.map(|Over { key, low, high }| ParameterRange {
            key: key.place(),
            low: low.into(),
            high: high.into(),
        }),
        depth: chaos.depth() as u32,
        interrupted: chaos.depth() < question.depth && !chaos.bases().is_empty(),
        bases: chaos.bases().iter().map(base).collect(),
        words: chaos
            .words()
            .iter()
            .map(|word| WordDocument {
                from: word.from as u32,
                to: word.to as u32,
                walls: word.walls.iter().map(|wall| if *wall == Wall::Left { 'L' } else { 'R' }).collect(),
                half_cycles: word.half_cycles,
            })
            .collect(),
        boxes: chaos.boxes(),
        entropy: EntropyDocument { impact: chaos.entropy(), cycle: chaos.entropy_a_cycle() },
        horseshoe: chaos.horseshoe().map(|pair| pair.map(|word| word.in_mappings())),
        exponent_seen: chaos.exponent(),
    }
}

fn base(Base { left, right }: &Base) -> BaseDocument {
    BaseDocument { left: [left.bottom, left.top], right: [right.bottom, right.top] }
}

/// The bases of a document.
pub fn bases(document: &[BaseDocument]) -> Vec<Base> {
    let chord = |[bottom, top]: [[f64; 2]; 2]| Chord { bottom, top };
    document.iter().map(|base| Base { left: chord(base.left), right: chord(base.right) }).collect()
}
