//! Documents that are checked, and written as theorems.

use impact_pair_certificate::{Certificate, Claims, Verdict};
use pyo3::prelude::*;

use crate::errors::{Fault, effort_of};
use crate::watched::watched;

/// A claim, its verdict, and at the deciding claim the reason.
type JudgedClaim = (String, &'static str, Option<String>);

/// The verdict, its message, the theorem in words, the values not checked, the claims among them, and each claim that is checked.
type Checked = (&'static str, String, Option<String>, Vec<String>, Vec<String>, Vec<JudgedClaim>);

/// Every claim of a document, proved again.
#[pyfunction]
pub fn check(py: Python<'_>, text: String, effort: &str, progress: Option<Py<PyAny>>) -> PyResult<Checked> {
    let effort = effort_of(effort)?.into();
    watched(py, progress, move |monitor| {
        let claims = Claims::parse(&text)?;
        let judged = claims.judge(&effort, monitor)?;
        let (kind, said) = match &judged.verdict {
            Verdict::Confirmed { bits, .. } => ("confirmed", format!("{}, in {bits} bits", claims.all())),
            Verdict::Refuted(finding) => ("refuted", claims.described(finding)),
            Verdict::Undecided(finding) => ("undecided", claims.described(finding)),
            Verdict::Interrupted { events } => ("interrupted", format!("{} confirmed", claims.first(*events))),
        };
        let document = claims.document(&judged);
        let each = document.claims.into_iter().map(|claim| (claim.path, claim.verdict.text(), claim.reason));
        Ok((kind, said, document.theorem, document.not_checked, document.unchecked_claims, each.collect()))
    })
}

/// The file, the impacts it proves, why not all that were requested, whether Ctrl-C ended it, and what it leaves out.
type Proved = (String, usize, Option<String>, bool, Option<String>);

/// An orbit JSON as a theorem for Coq: the file, the impacts it proves, and the reason why not all, if so; whether Ctrl-C ended it; what the
/// document claims besides.
#[pyfunction]
pub fn prove(py: Python<'_>, text: String, impacts: Option<u64>, progress: Option<Py<PyAny>>) -> PyResult<Proved> {
    watched(py, progress, move |monitor| {
        let certificate = Certificate::parse(&text)?;
        let listed = certificate.events().iter().take_while(|claim| claim.kind.is_impact()).count();
        if listed == 0 {
            return Err(Fault::certificate("there is no impact to prove before the first other event"));
        }
        let requested = impacts.map_or(listed, |impacts| usize::try_from(impacts).unwrap_or(usize::MAX));
        let theorem = certificate.prove(requested, monitor)?;
        let stop = theorem.stop.as_ref().map(|finding| certificate.described(finding.event, &finding.message));
        Ok((theorem.text, theorem.impacts, stop, monitor.is_stopped(), theorem.left_out))
    })
}
