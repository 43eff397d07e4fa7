//! The JSON of verdicts over the cells of a parameter, read back.

use super::bifurcation::{own_value, parameter};
use super::leaves::is_there;
use impact_pair_document::{CHAOS_CELLS_SCHEMA, ChaosCellsDocument, Place, value};
use impact_pair_exact::Exact;
use impact_pair_model::scene::Key;
use impact_pair_model::vocabulary::StretchVerdict;
use impact_pair_model::{Error, ImpactPair, Start};

/// The claims of a JSON of verdicts over the cells of a parameter.
#[derive(Clone, Debug)]
pub struct CellsCertificate {
    pair: ImpactPair,
    start: Start,
    /// The parameter that varies.
    key: Key,
    document: ChaosCellsDocument,
    unjudged: Vec<String>,
}

/// Keys that no lemma of `check` covers.
const UNJUDGED: [&str; 5] = ["cells", "depth", "halvings", "interrupted", "program"];

/// Keys on which only the verdict `attracted` depends: the scene's own motion converges to an orbit.
const SCENE_MOTION_KEYS: [&str; 3] = ["scene.excitation.frequency", "scene.excitation.phase", "scene.start"];

impl CellsCertificate {
    /// Reads a JSON of cells.
    ///
    /// # Errors
    /// Name the key, its value and what is accepted.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let value = value(text)?;
        let whole = Place::of_schema(&value, CHAOS_CELLS_SCHEMA)?;
        let document: ChaosCellsDocument = whole.read()?;
        let key = parameter(&whole.get("over")?.get("key")?)?;
        let (pair, start) = document.scene.clone().model()?;
        let there = UNJUDGED.iter().filter(|key| is_there(&value, key));
        let mut unjudged: Vec<String> = there.map(|key| (*key).to_owned()).collect();
        let is_attracted = document.stretches.iter().any(|stretch| stretch.verdict == StretchVerdict::Attracted);
        unjudged.extend(SCENE_MOTION_KEYS.iter().filter(|_| !is_attracted).map(|key| (*key).to_owned()));
        unjudged.push(own_value(key));
        unjudged.sort();
        unjudged.dedup();
        Ok(Self { pair, start, key, document, unjudged })
    }

    /// The pair with all values of the parameter between `low` and `high`.
    pub(super) fn pair(&self, [low, high]: [&Exact; 2]) -> Result<ImpactPair, Error> {
        let all = Exact::interval(low, high)
            .map_err(|error| Error::certificate(format!("stretches: {error}")).because(error))?;
        self.pair.with(self.key, all)
    }

    pub(super) fn start(&self) -> &Start {
        &self.start
    }

    pub(super) fn document(&self) -> &ChaosCellsDocument {
        &self.document
    }

    /// Number of subintervals.
    pub fn count(&self) -> usize {
        self.document.stretches.len()
    }

    /// Number of subintervals with a claim.
    pub fn claimed(&self) -> usize {
        self.document.stretches.iter().filter(|stretch| stretch.verdict != StretchVerdict::Undecided).count()
    }

    /// Keys of the document whose values [`check_within`](Self::check_within) does not check.
    pub fn unjudged(&self) -> &[String] {
        &self.unjudged
    }
}
