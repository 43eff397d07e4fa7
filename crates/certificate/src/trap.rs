//! The JSON of a trapping region, read back.

use impact_pair_document::{Place, TRAP_SCHEMA, TrapDocument, value};
use impact_pair_model::{Error, ImpactPair, Start};

/// The claims of a trap JSON.
#[derive(Clone, Debug)]
pub struct TrapCertificate {
    pair: ImpactPair,
    start: Start,
    document: TrapDocument,
    unjudged: Vec<String>,
}

impl TrapCertificate {
    /// Reads a trap JSON.
    ///
    /// # Errors
    /// Name the key, its value and what is accepted.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let value = value(text)?;
        let whole = Place::of_schema(&value, TRAP_SCHEMA)?;
        let document: TrapDocument = whole.read()?;
        if !document.certified {
            return Err(whole.get("certified")?.refused("only a certified region claims anything: accepted is true"));
        }
        let mut unjudged = vec!["program".to_owned()];
        if document.entered_at_impact.is_none() {
            // The region holds for every start.
            unjudged.extend(["scene.excitation.phase", "scene.start"].map(str::to_owned));
        }
        unjudged.sort();
        let (pair, start) = document.scene.clone().model()?;
        Ok(Self { pair, start, document, unjudged })
    }

    pub(super) fn pair(&self) -> &ImpactPair {
        &self.pair
    }

    pub(super) fn start(&self) -> &Start {
        &self.start
    }

    pub(super) fn document(&self) -> &TrapDocument {
        &self.document
    }

    /// Number of boxes of the region.
    pub fn count(&self) -> usize {
        // exact: no run is longer than an integer of 32 bits
        let boxes = |&[_, first, last]: &[i32; 3]| usize::try_from(i64::from(last) - i64::from(first) + 1).unwrap_or(0);
        self.document.region.iter().map(boxes).sum()
    }

    /// Keys of the document whose values [`check_within`](Self::check_within) does not check.
    pub fn unjudged(&self) -> &[String] {
        &self.unjudged
    }
}
