//! The JSON of a trapping region, read back.

use super::marks::{self, Mark};
use impact_pair_document::{Place, TRAP_SCHEMA, TrapDocument};
use impact_pair_model::{Error, ImpactPair, Start};
use serde_json::Value;

/// The claims of a trap JSON.
#[derive(Clone, Debug)]
pub(crate) struct TrapCertificate {
    pub(super) pair: ImpactPair,
    pub(super) start: Start,
    pub(super) document: TrapDocument,
}

impl TrapCertificate {
    /// Reads a trap JSON.
    pub(super) fn read(values: &[Value]) -> Result<(Self, Mark), Error> {
        let whole = Place::alone_of_schema(values, TRAP_SCHEMA)?;
        Self::of(whole.read()?, &whole)
    }

    /// The claims of a region; `place` is its place in the file.
    pub(super) fn of(document: TrapDocument, place: &Place<'_>) -> Result<(Self, Mark), Error> {
        if !document.certified {
            return Err(place.get("certified")?.refused("only a certified region claims anything: accepted is true"));
        }
        let marks = marks::trap(&document);
        let (pair, start) = document.scene.clone().model()?;
        Ok((Self { pair, start, document }, marks))
    }

    /// Number of boxes of the region.
    pub fn count(&self) -> usize {
        // exact: no run is longer than an integer of 32 bits
        let boxes = |&[_, first, last]: &[i32; 3]| usize::try_from(i64::from(last) - i64::from(first) + 1).unwrap_or(0);
        self.document.region.iter().map(boxes).sum()
    }
}
