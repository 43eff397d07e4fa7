//! Results of a check, claim by claim: the verdict on each value of a document.

use std::collections::BTreeSet;

use serde_json::Value;

use crate::checked::Checked;
use crate::claims::Of;
use crate::leaves::Leaves;
use crate::marks::LINES;
use crate::{Claims, Finding, Verdict};
use impact_pair_document::{CHECK_SCHEMA, CheckDocument, JudgedClaim, VerdictName};

/// The result of a check of a document, and the number of claims confirmed without a gap.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CheckResult {
    /// The verdict on all claims together.
    pub verdict: Verdict,
    /// The claims before this number are proved again, each for all data, counted as [`Finding::event`] counts them.
    pub(super) confirmed: usize,
}

impl CheckResult {
    /// The verdict on all claims together.
    pub fn name(&self) -> VerdictName {
        match self.verdict {
            Verdict::Confirmed { .. } => VerdictName::Confirmed,
            Verdict::Refuted(_) => VerdictName::Refuted,
            Verdict::Undecided(_) | Verdict::Interrupted { .. } => VerdictName::Undecided,
        }
    }

    fn finding(&self) -> Option<&Finding> {
        match &self.verdict {
            Verdict::Refuted(finding) | Verdict::Undecided(finding) => Some(finding),
            Verdict::Confirmed { .. } | Verdict::Interrupted { .. } => None,
        }
    }
}

/// A document, alone or in a list.
struct Part<'c> {
    claims: &'c Claims,
    /// Beginning of the document's paths: its position in a list.
    prefix: String,
    /// The number of the document's first claim.
    first: usize,
}

impl Claims {
    /// Each claim of the document, with its verdict.
    pub fn document(&self, judged: &CheckResult) -> CheckDocument {
        let (mut claims, mut not_checked, mut unchecked_claims) = (Vec::new(), Vec::new(), Vec::new());
        for part in self.parts() {
            unchecked_claims.append(&mut part.judge(judged, &mut claims, &mut not_checked));
        }
        unchecked_claims.sort();
        unchecked_claims.dedup();
        if let Verdict::Interrupted { .. } = judged.verdict {
            let open = claims.iter_mut().find(|claim: &&mut JudgedClaim| claim.verdict == VerdictName::Undecided);
            if let Some(open) = open {
                open.reason = Some("interrupted".to_owned());
            }
        }
        CheckDocument {
            schema: CHECK_SCHEMA.to_owned(),
            verdict: judged.name(),
            message: self.verdict_in_words(&judged.verdict, &unchecked_claims),
            theorem: matches!(judged.verdict, Verdict::Confirmed { .. }).then(|| self.theorem()),
            sha256: None,
            claims,
            not_checked,
            unchecked_claims,
        }
    }

    /// The verdict in words, which name the claims that are not checked.
    pub fn verdict_in_words(&self, verdict: &Verdict, unchecked_claims: &[String]) -> String {
        match verdict {
            Verdict::Confirmed { bits, pieces } => {
                let confirmed = match unchecked_claims {
                    [] => "confirmed:".to_owned(),
                    claims => format!("confirmed, but not: {}; confirmed are", claims.join(", ")),
                };
                let pieces = if *pieces == 1 { String::new() } else { format!(", the data cut into {pieces} sets") };
                format!("{confirmed} {}, in {bits} bits{pieces}", self.all())
            }
            Verdict::Refuted(finding) => format!("refuted: {}", self.described(finding)),
            Verdict::Undecided(finding) => format!("undecided: {}", self.described(finding)),
            Verdict::Interrupted { events } => format!("interrupted: {} confirmed", self.first(*events)),
        }
    }

    /// Keys, or statements, that are not checked: those that the document has.
    ///
    /// ```
    /// # use impact_pair_certificate::Claims;
    /// let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/documents/count.jsonl"));
    /// assert_eq!(Claims::parse(text)?.unjudged(), ["arithmetic", "program"]);
    /// # Ok::<(), impact_pair_model::Error>(())
    /// ```
    pub fn unjudged(&self) -> Vec<String> {
        if let Of::Unchecked(why) = self.of {
            return vec![why.to_owned()];
        }
        let own = Part { claims: self, prefix: String::new(), first: 0 };
        let own = if self.marks.is_some() { own.leaves().names } else { BTreeSet::new() };
        let of =
            |(at, document): (String, &Self)| document.unjudged().into_iter().map(move |key| format!("{at}.{key}"));
        own.into_iter().chain(self.documents().into_iter().flatten().flat_map(of)).collect()
    }

    /// What is said of each value of the document, but for those of documents in it: its key without positions in lists, the lemmas that
    /// check it, and why it is not checked, or where.
    pub fn keys(&self) -> Vec<(String, &'static str, &'static str)> {
        let mut rows = Vec::new();
        self.marks.iter().for_each(|marks| marks.rows("", &mut rows));
        rows
    }

    fn parts(&self) -> Vec<Part<'_>> {
        let mut parts = Vec::new();
        self.add_parts(&mut parts, String::new(), 0);
        parts
    }

    /// Adds the parts of a document to `parts`; `prefix` is the document's place, `first` the number of its first claim.
    fn add_parts<'c>(&'c self, parts: &mut Vec<Part<'c>>, prefix: String, first: usize) {
        let mut next = first;
        for (at, document) in self.documents().into_iter().flatten() {
            document.add_parts(parts, format!("{prefix}{at}."), next);
            next += document.count() + 1;
        }
        if !matches!(self.of, Of::List(_)) {
            parts.push(Part { claims: self, prefix, first: next });
        }
    }
}

impl<'c> Part<'c> {
    /// The values of the document, sorted by what is said of them.
    fn leaves(&self) -> Leaves<'c> {
        let mut leaves = Leaves::new(self.claims.certificate().map(Checked::items));
        let Some(marks) = &self.claims.marks else {
            let keys = self.claims.values.iter().filter_map(Value::as_object).flat_map(|value| value.keys());
            leaves.others.extend(keys.cloned());
            return leaves;
        };
        match (&self.claims.of, &self.claims.values[..]) {
            (Of::Orbit(_), [head, events @ .., end]) => {
                leaves.add("", "", head, marks);
                leaves.add_lines("events", events, marks.at("events"));
                leaves.add("", "", end, marks);
            }
            (_, [head, lines @ ..]) => {
                leaves.add("", "", head, marks);
                leaves.add_lines("points", lines, marks.at(LINES));
            }
            (_, []) => unreachable!("a document is read from a value"),
        }
        leaves
    }

    /// Adds the verdicts on the values of the document, and the paths of the values that are not checked; returns the keys among these
    /// that claim something.
    fn judge(&self, judged: &CheckResult, claims: &mut Vec<JudgedClaim>, not_checked: &mut Vec<String>) -> Vec<String> {
        let Leaves { judged: mut paths, mut others, unchecked, items, .. } = self.leaves();
        let decisive = self.decisive(judged);
        if let Some((path, _)) = &decisive {
            // If an item decides the verdict, its own values are in doubt as well.
            others.retain(|other| other != path && !is_value_of(other, path));
            if !paths.contains(path) {
                let place = paths.iter().position(|other| is_in(other, path)).unwrap_or(paths.len()); // exact: the end
                paths.insert(place, path.clone());
            }
        }
        others.sort();
        others.dedup();
        claims.extend(paths.into_iter().map(|path| self.verdict(path, judged, decisive.as_ref(), items)));
        not_checked.extend(others.into_iter().map(|path| format!("{}{path}", self.prefix)));
        let prefix = self.prefix.rsplit_once("].").map_or(self.prefix.as_str(), |(_, key)| key);
        unchecked.into_iter().map(|path| format!("{prefix}{path}")).collect()
    }

    /// Path and message of the deciding claim, if it is in this document.
    fn decisive(&self, judged: &CheckResult) -> Option<(String, String)> {
        let Finding { event, message } = judged.finding()?;
        if let Of::Description(_) = self.claims.of {
            // A contradiction to its documents begins with the key.
            let key = message.split(' ').next().filter(|_| *event == self.first)?;
            return Some((key.to_owned(), message.clone()));
        }
        let certificate = self.claims.certificate()?;
        let at = event.checked_sub(self.first).filter(|at| *at <= certificate.count())?;
        let path = if at < certificate.count() { certificate.path(at) } else { certificate.whole().to_owned() };
        Some((path, message.clone()))
    }

    fn verdict(
        &self,
        path: String,
        judged: &CheckResult,
        decisive: Option<&(String, String)>,
        items: Option<&str>,
    ) -> JudgedClaim {
        let reason = decisive.filter(|(decisive, _)| *decisive == path).map(|(_, message)| message.clone());
        // Claims about the whole document come after its items.
        let item = items.and_then(|items| position(&path, items)).unwrap_or(self.claims.count()); // exact: a position
        let is_confirmed = matches!(judged.verdict, Verdict::Confirmed { .. }) || self.first + item < judged.confirmed;
        let verdict = match (&reason, is_confirmed) {
            (Some(_), _) => judged.name(),
            (None, true) => VerdictName::Confirmed,
            (None, false) => VerdictName::Undecided,
        };
        JudgedClaim { path: format!("{}{path}", self.prefix), verdict, reason }
    }
}

/// Whether a path leads into the value at `outer`.
fn is_in(path: &str, outer: &str) -> bool {
    path.strip_prefix(outer).is_some_and(|rest| rest.starts_with(['.', '[']))
}

/// Whether a path leads to a direct member of the value at `outer`.
fn is_value_of(path: &str, outer: &str) -> bool {
    is_in(path, outer) && !path[outer.len() + 1..].contains(['.', '['])
}

/// The position of the item of a list that a path leads to, or into.
fn position(path: &str, items: &str) -> Option<usize> {
    path.strip_prefix(items)?.strip_prefix('[')?.split_once(']')?.0.parse().ok()
}
