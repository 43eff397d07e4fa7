//! The JSON of verdicts over the cells of a parameter, read back.

use super::bifurcation::parameter;
use super::marks::{self, Mark};
use impact_pair_document::{CHAOS_CELLS_SCHEMA, ChaosCellsDocument, Place};
use impact_pair_exact::Exact;
use impact_pair_model::scene::Key;
use impact_pair_model::vocabulary::StretchVerdict;
use impact_pair_model::{Error, ImpactPair, Start};
use serde_json::Value;

/// The claims of a JSON of verdicts over the cells of a parameter.
#[derive(Clone, Debug)]
pub(crate) struct CellsCertificate {
    pair: ImpactPair,
    pub(super) start: Start,
    /// The parameter that varies.
    key: Key,
    pub(super) document: ChaosCellsDocument,
}

impl CellsCertificate {
    /// Reads a JSON of cells.
    pub(super) fn read(values: &[Value]) -> Result<(Self, Mark), Error> {
        let whole = Place::alone_of_schema(values, CHAOS_CELLS_SCHEMA)?;
        let document: ChaosCellsDocument = whole.read()?;
        let key = parameter(&whole.get("over")?.get("key")?)?;
        let (pair, start) = document.scene.clone().model()?;
        let marks = marks::cells(&document, key);
        Ok((Self { pair, start, key, document }, marks))
    }

    /// The pair with all values of the parameter between `low` and `high`.
    pub(super) fn pair(&self, [low, high]: [&Exact; 2]) -> Result<ImpactPair, Error> {
        let all = Exact::interval(low, high)
            .map_err(|error| Error::certificate(format!("stretches: {error}")).because(error))?;
        self.pair.with(self.key, all)
    }

    /// Number of subintervals.
    pub fn count(&self) -> usize {
        self.document.stretches.len()
    }

    /// Number of subintervals with a claim.
    pub fn claimed(&self) -> usize {
        self.document.stretches.iter().filter(|stretch| stretch.verdict != StretchVerdict::Undecided).count()
    }
}
