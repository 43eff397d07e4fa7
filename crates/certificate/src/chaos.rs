//! The JSON of words and entropy, read back.

use super::bifurcation::{own_value, parameter};
use impact_pair_document::{BaseDocument, CHAOS_SCHEMA, ChaosDocument, MOST_WORDS, Place, value};
use impact_pair_exact::Exact;
use impact_pair_model::{Error, ImpactPair};

/// The claims of a chaos JSON.
#[derive(Clone, Debug)]
pub struct ChaosCertificate {
    /// The impact pair, with all values of the parameter.
    pair: ImpactPair,
    document: ChaosDocument,
    unjudged: Vec<String>,
}

/// Keys that no lemma of `check` covers.
const UNJUDGED: [&str; 11] = [
    "boxes",
    "depth",
    "exponent_seen",
    "hyperbolic.cells",
    "interrupted",
    "left_out",
    "program",
    "scene.excitation.frequency",
    "scene.excitation.phase",
    "scene.start",
    "scene_orbit",
];

impl ChaosCertificate {
    /// Reads a chaos JSON.
    ///
    /// # Errors
    /// Name the key, its value and what is accepted.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let value = value(text)?;
        let whole = Place::of_schema(&value, CHAOS_SCHEMA)?;
        let document: ChaosDocument = whole.read()?;
        if !document.certified {
            return Err(whole.get("certified")?.refused("only a certified entropy claims anything: accepted is true"));
        }
        if document.words.len() > MOST_WORDS {
            return Err(whole.get("words")?.refused(&format!("accepted are at most {MOST_WORDS} words")));
        }
        let mut unjudged = UNJUDGED.map(str::to_owned).to_vec();
        let (mut pair, _) = document.scene.clone().model()?;
        if let Some(over) = &document.over {
            let key = parameter(&whole.get("over")?.get("key")?)?;
            let range = Exact::interval(&over.low.0, &over.high.0)
                .map_err(|error| Error::certificate(format!("over: {error}")).because(error))?;
            pair = pair.with(key, range)?;
            unjudged.push(own_value(key));
        }
        unjudged.sort();
        unjudged.dedup();
        Ok(Self { pair, document, unjudged })
    }

    pub(super) fn pair(&self) -> &ImpactPair {
        &self.pair
    }

    pub(super) fn document(&self) -> &ChaosDocument {
        &self.document
    }

    pub(super) fn bases(&self) -> &[BaseDocument] {
        &self.document.bases
    }

    /// Number of claimed words.
    pub fn count(&self) -> usize {
        self.document.words.len()
    }

    /// Keys of the document whose values [`check_within`](Self::check_within) does not check.
    pub fn unjudged(&self) -> &[String] {
        &self.unjudged
    }
}
