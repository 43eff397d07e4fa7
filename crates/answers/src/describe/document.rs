//! A description as a document.

use impact_pair::json::{
    DESCRIPTION_SCHEMA, DescribedExponent, DescriptionDocument, FateDocument, FateName, HorseshoeDocument,
    OutcomeDocument, PROGRAM, SceneDocument,
};

use super::Description;
use crate::sweep::{exponent, limit};
use impact_pair::chaos::{Trap, Word as Block, entropy};
use impact_pair::mapping::Word;
use impact_pair::orbit::Period;
use impact_pair::{Error, Scene};

/// Events up to which the orbit is part of the document.
const MOST_EVENTS: usize = 4096;

impl Description {
    /// The document of the scene; commands name the scene by `name`, the path of its file.
    ///
    /// # Errors
    /// If a value exceeds the range of exact expressions.
    pub fn document(&self, scene: &Scene, name: &str) -> Result<DescriptionDocument, Error> {
        let fate = self.fate();
        let is_proof = self.orbit.decides().is_some() && self.orbit.document.events.len() <= MOST_EVENTS;
        let horseshoe = self.horseshoe();
        Ok(DescriptionDocument {
            schema: DESCRIPTION_SCHEMA.to_owned(),
            program: PROGRAM.to_owned(),
            certified: fate.kind != FateName::Undecided,
            scene: SceneDocument::new(scene.pair(), scene.start()),
            undecided: self.undecided(fate.kind, name),
            fate,
            exponent: DescribedExponent {
                limit: self.orbit.limit.map(limit),
                finite_time: exponent(self.orbit.exponent).per_impact,
            },
            region: self.region().map(|trap| trap.document(scene)).transpose()?,
            entropy: horseshoe.map(|chaos| entropy([chaos.entropy(), chaos.entropy_a_cycle()])),
            horseshoe: horseshoe.map(|chaos| HorseshoeDocument {
                words: chaos.horseshoe().map(|words| words.map(Block::as_block)),
                depth: chaos.depth() as u32,
                in_region: chaos.asymptotics().region.is_some_and(|region| region.holds_bases),
            }),
            not_examined: self.not_examined(),
            interrupted: self.is_interrupted,
            proof: is_proof.then(|| Box::new(self.orbit.document.clone())),
        })
    }

    /// The fate: that of the orbit's outcome, else that of the region.
    fn fate(&self) -> FateDocument {
        let plain = FateDocument {
            kind: FateName::Undecided,
            message: String::new(),
            impacts: self.orbit.impacts(),
            from: None,
            period: None,
            word: None,
            wall: None,
            orbit: None,
        };
        let entered = self.region().and_then(Trap::entered);
        let fate = match (self.orbit.decides(), entered) {
            (Some(kind), _) => of_outcome(kind, &self.orbit.document.outcome, plain),
            (None, Some(from)) => FateDocument { kind: FateName::StaysInRegion, from: Some(from), ..plain },
            (None, None) => plain,
        };
        fate.with_message()
    }
}

/// The fate that an outcome proves.
fn of_outcome(kind: FateName, outcome: &OutcomeDocument, plain: FateDocument) -> FateDocument {
    let OutcomeDocument { word, cycles, from, wall, orbit, period, .. } = outcome.clone();
    let impacts = |word: &String| word.parse::<Word>().map_or(0, |word| word.mappings().len() as u64);
    let of_word =
        word.as_ref().zip(cycles).map(|(word, cycles)| Period { impacts: impacts(word), cycles: cycles.into() });
    FateDocument { kind, from, word, wall, orbit, period: period.or(of_word), ..plain }
}
