//! The JSON of words and entropy, read back.

use super::bifurcation::parameter;
use super::marks::{self, Mark};
use impact_pair_document::{BaseDocument, CHAOS_SCHEMA, ChaosDocument, MOST_WORDS, Place};
use impact_pair_exact::Exact;
use impact_pair_model::{Error, ImpactPair};
use serde_json::Value;

/// The claims of a chaos JSON.
#[derive(Clone, Debug)]
pub(crate) struct ChaosCertificate {
    /// The impact pair, with all values of the parameter.
    pub(super) pair: ImpactPair,
    pub(super) document: ChaosDocument,
}

impl ChaosCertificate {
    /// Reads a chaos JSON.
    pub(super) fn read(values: &[Value]) -> Result<(Self, Mark), Error> {
        let whole = Place::alone_of_schema(values, CHAOS_SCHEMA)?;
        let document: ChaosDocument = whole.read()?;
        if !document.certified {
            return Err(whole.get("certified")?.refused("only a certified entropy claims anything: accepted is true"));
        }
        if document.words.len() > MOST_WORDS {
            return Err(whole.get("words")?.refused(&format!("accepted are at most {MOST_WORDS} words")));
        }
        let mut varied = None;
        let (mut pair, _) = document.scene.clone().model()?;
        if let Some(over) = &document.over {
            let key = parameter(&whole.get("over")?.get("key")?)?;
            let range = Exact::interval(&over.low.0, &over.high.0)
                .map_err(|error| Error::certificate(format!("over: {error}")).because(error))?;
            pair = pair.with(key, range)?;
            varied = Some(key);
        }
        let marks = marks::chaos(&document, varied);
        Ok((Self { pair, document }, marks))
    }

    pub(super) fn bases(&self) -> &[BaseDocument] {
        &self.document.bases
    }

    /// Number of claimed words.
    pub fn count(&self) -> usize {
        self.document.words.len()
    }
}
