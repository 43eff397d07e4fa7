//! The JSON of a range of a parameter in cells.

use impact_pair_document::{
    CHAOS_CELLS_SCHEMA, ChaosCellsDocument, PROGRAM, SceneDocument, StretchDocument, StretchWitness, UpTo,
};

use super::shares::shares;
use super::{Cells, RangeSettings, Stretch, Verdict};
use crate::Scene;
use crate::chaos::document::{base, entropy, period, strip, word};
use crate::chaos::horseshoe::Horseshoe;
use crate::exact::Exact;

impl Cells {
    /// Returns the verdicts over a range of a parameter as a document.
    pub fn document(&self, scene: &Scene, requested: &RangeSettings) -> ChaosCellsDocument {
        ChaosCellsDocument {
            schema: CHAOS_CELLS_SCHEMA.to_owned(),
            program: PROGRAM.to_owned(),
            certified: self.stretches.iter().all(|stretch| stretch.verdict != Verdict::Undecided),
            scene: SceneDocument::new(scene.pair(), scene.start()),
            over: (&requested.over).into(),
            cells: requested.cells,
            halvings: requested.halvings,
            depth: UpTo::counted(requested.depth),
            interrupted: self.interrupted,
            shares: shares(&requested.over, self),
            stretches: self.stretches.iter().map(stretch).collect(),
        }
    }
}

/// The words that the horseshoe of a part of a subinterval is proved with.
fn part(high: &Exact, horseshoe: &Horseshoe) -> StretchWitness {
    StretchWitness {
        high: high.into(),
        words: horseshoe.words.iter().map(word).collect(),
        strips: horseshoe.strips.iter().map(strip).collect(),
    }
}

fn stretch(stretch: &Stretch) -> StretchDocument {
    let plain = StretchDocument {
        low: (&stretch.low).into(),
        high: (&stretch.high).into(),
        verdict: stretch.verdict.kind(),
        entropy: None,
        bases: Vec::new(),
        period: None,
        witness: stretch.parts.iter().map(|(high, horseshoe)| part(high, horseshoe)).collect(),
    };
    let proved = match stretch.verdict.horseshoe() {
        Some(Horseshoe { entropy: bounds, bases, .. }) => {
            StretchDocument { entropy: Some(entropy(*bounds)), bases: bases.iter().map(base).collect(), ..plain }
        }
        None => plain,
    };
    let period = stretch.verdict.period().map(|(word, cycles)| period(word, cycles));
    StretchDocument { period, ..proved }
}
