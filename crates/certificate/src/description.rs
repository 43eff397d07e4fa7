//! The JSON of a description, read back: the orbit and the region inside are documents of their own.

use super::marks::{self, Mark};
use serde_json::Value;

use crate::trap::TrapCertificate;
use crate::{Certificate, CheckResult, Claims, Finding, Of, Verdict, boxed};
use impact_pair_document::{
    ClaimName, DESCRIPTION_SCHEMA, DescriptionDocument, FateName, ORBIT_SCHEMA, Place, TRAP_SCHEMA,
};
use impact_pair_model::{Error, Period, Word};

/// The claims of a description.
#[derive(Clone, Debug)]
pub(crate) struct DescriptionCertificate {
    document: DescriptionDocument,
    /// The documents inside that are proved again, each with its key.
    parts: Vec<(&'static str, Claims)>,
}

/// Keys of the documents in a description.
const PROOF: &str = "proof";
const REGION: &str = "region";

impl DescriptionCertificate {
    /// Reads a description.
    pub(super) fn read(values: &[Value]) -> Result<(Self, Mark), Error> {
        let whole = Place::alone_of_schema(values, DESCRIPTION_SCHEMA)?;
        let document: DescriptionDocument = whole.read()?;
        document.scene.clone().model()?;
        if document.proof.as_ref().is_some_and(|orbit| orbit.claim != ClaimName::ExactStart) {
            let claim = whole.get(PROOF)?.get("claim")?;
            return Err(claim.refused("only an orbit from its exact start proves a fate: accepted is \"exact start\""));
        }
        let mut parts = Vec::new();
        if let Some(orbit) = &document.proof {
            let place = whole.get(PROOF)?;
            place.require_schema(ORBIT_SCHEMA)?;
            let orbit = Certificate::whole(&place, (**orbit).clone())?;
            parts.push((PROOF, Claims::part(&values[0][PROOF], boxed(orbit, Of::Orbit))));
        }
        if let Some(region) = &document.region {
            let place = whole.get(REGION)?;
            place.require_schema(TRAP_SCHEMA)?;
            let region = TrapCertificate::of(region.clone(), &place)?;
            parts.push((REGION, Claims::part(&values[0][REGION], boxed(region, Of::Trap))));
        }
        let own = Self { document, parts };
        let marks = marks::description(&own.document, own.is_fate_judged());
        Ok((own, marks))
    }

    /// The documents inside the description, each with its key.
    pub(super) fn parts(&self) -> &[(&'static str, Claims)] {
        &self.parts
    }

    /// Whether a document inside proves the fate.
    pub(super) fn is_fate_judged(&self) -> bool {
        match self.document.fate.kind {
            FateName::Undecided => false,
            FateName::StaysInRegion => self.document.region.is_some(),
            FateName::Attracted | FateName::Periodic | FateName::RestsForever | FateName::NeverImpacts => {
                self.document.proof.is_some()
            }
        }
    }

    /// The result for a description whose documents are confirmed: a fate that no document inside proves is undecided; the fate `undecided`
    /// claims nothing.
    pub(super) fn with_fate(&self, documents: CheckResult) -> CheckResult {
        if self.is_fate_judged() || self.document.fate.kind == FateName::Undecided {
            return documents;
        }
        let message = format!("fate is {}, but no document in it proves that", self.document.fate.kind);
        CheckResult { verdict: Verdict::Undecided(Finding { event: self.after_all(), message }), ..documents }
    }

    /// The number of the statement about the whole description, after the claims of the documents inside.
    fn after_all(&self) -> usize {
        self.parts.iter().map(|(_, part)| part.count() + 1).sum()
    }

    /// A contradiction between the description and the documents inside.
    pub(super) fn contradiction(&self) -> Option<Finding> {
        let message = self.differing().or_else(|| self.fate_differing())?;
        Some(Finding { event: self.after_all(), message })
    }

    /// A document inside has another scene, or a flag contradicts the fate.
    fn differing(&self) -> Option<String> {
        let DescriptionDocument { scene, proof, region, fate, certified, .. } = &self.document;
        let scenes =
            [(PROOF, proof.as_ref().map(|orbit| &orbit.scene)), (REGION, region.as_ref().map(|region| &region.scene))];
        if let Some((key, _)) = scenes.iter().find(|(_, other)| other.is_some_and(|other| other != scene)) {
            return Some(format!("scene is not that of {key}"));
        }
        if *certified == (fate.kind == FateName::Undecided) {
            return Some(format!("certified is {certified}, but the fate is {}", fate.kind));
        }
        match fate.words() {
            Some(words) if words == fate.message => None,
            Some(words) => Some(format!("fate.message is not what the fields say: {words}")),
            None => Some(format!("fate lacks a field of {}", fate.kind)),
        }
    }

    /// The fate differs from the document that proves it.
    fn fate_differing(&self) -> Option<String> {
        if !self.is_fate_judged() {
            return None;
        }
        let DescriptionDocument { proof, region, fate, .. } = &self.document;
        let differs = |key: &str| Some(format!("fate.{key} is not that of the document that proves it"));
        if proof.as_ref().is_some_and(|orbit| orbit.outcome.impacts != Some(fate.impacts)) {
            return differs("impacts");
        }
        if fate.kind == FateName::StaysInRegion {
            // The words of the fate claim that no motion in the region sticks.
            if region.as_ref().is_some_and(|region| !region.no_rest) {
                return differs("message");
            }
            let entered = region.as_ref().and_then(|region| region.entered_at_impact);
            let others = fate.period.is_some() || fate.word.is_some() || fate.wall.is_some() || fate.orbit.is_some();
            return if entered.is_none() || entered != fate.from || others { differs("from") } else { None };
        }
        let outcome = &proof.as_ref()?.outcome;
        let impacts = outcome.word.as_ref().and_then(|word| word.parse::<Word>().ok());
        let impacts = impacts.map(|word| word.mappings().len() as u64); // exact: a length
        let of_word = impacts.zip(outcome.cycles).map(|(impacts, cycles)| Period { impacts, cycles: cycles.into() });
        let same = [
            ("kind", FateName::of_outcome(outcome.kind) == Some(fate.kind)),
            ("from", outcome.from == fate.from),
            ("word", outcome.word == fate.word),
            ("wall", outcome.wall == fate.wall),
            ("period", outcome.period.or(of_word) == fate.period),
            ("orbit", outcome.orbit == fate.orbit),
        ];
        same.iter().find(|(_, is_same)| !is_same).and_then(|(key, _)| differs(key))
    }
}
