//! Documents of every verb, and the claims that `check` proves of them.

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::atlas::AtlasCertificate;
use crate::bifurcation::BifurcationCertificate;
use crate::cells::CellsCertificate;
use crate::chaos::ChaosCertificate;
use crate::checked::Checked;
use crate::cycles::CyclesCertificate;
use crate::description::DescriptionCertificate;
use crate::global::GlobalCertificate;
use crate::marks::Mark;
use crate::periodic::PeriodicCertificate;
use crate::sweep::SweepCertificate;
use crate::tangency::TangencyCertificate;
use crate::trap::TrapCertificate;
use crate::windows::WindowsCertificate;
use crate::{Certificate, CheckResult, Finding, Limits, Verdict};
use impact_pair_document::{
    ATLAS_SCHEMA, AUDIT_SCHEMA, AuditDocument, BIFURCATION_SCHEMA, CHAOS_CELLS_SCHEMA, CHAOS_SCHEMA, CYCLES_SCHEMA,
    DESCRIPTION_SCHEMA, GLOBAL_SCHEMA, MANIFOLD_SCHEMA, ManifoldDocument, PERIODIC_SCHEMA, Place, SWEEP_SCHEMA,
    SceneDocument, TANGENCY_SCHEMA, TRADE_SCHEMA, TRAP_SCHEMA, TradeDocument, TwoImpactDocument, WINDOWS_SCHEMA,
    counted, values,
};
use impact_pair_model::Error;
use impact_pair_model::watch::{Latched, Stage, Watch};

/// The claims of a document.
#[derive(Clone, Debug)]
pub struct Claims {
    /// The values of its text: one, or one for each line of JSON Lines; without the documents in it.
    pub(super) values: Vec<Value>,
    pub(super) of: Of,
    /// What is said of each value; nothing where the document is not checked.
    pub(super) marks: Option<Mark>,
}

/// The claims of a document by its verb.
#[derive(Clone, Debug)]
pub(super) enum Of {
    /// An orbit JSON: all events and the outcome are checked.
    Orbit(Box<Certificate>),
    /// A periodic JSON, or a JSON of two-impact motions: all orbits are checked, not that there are no others.
    Periodic(Box<PeriodicCertificate>),
    /// A JSON of all cycles: all orbits and the counts are checked, not that there are no others.
    Cycles(Box<CyclesCertificate>),
    /// A bifurcation JSON: folds, pitchforks and period doublings are checked, not grazes, and not that there are no others.
    Bifurcations(Box<BifurcationCertificate>),
    /// A JSON of windows: the orbits, the ends of their windows and the orbits between the ends are checked.
    Windows(Box<WindowsCertificate>),
    /// A JSON of a global analysis: its periodic motions, and that every motion ends in one of its components.
    Global(Box<GlobalCertificate>),
    /// A JSON of tangencies: all numbers are checked, and that there is one tangency in the bounds.
    Tangencies(Box<TangencyCertificate>),
    /// A sweep: the impacts of all points are checked, not the claimed fate of the motions.
    Sweep(Box<SweepCertificate>),
    /// An atlas of points: the global analysis of each point.
    Atlas(Box<AtlasCertificate>),
    /// A chaos JSON: all words are checked, and that the entropies and the horseshoe follow from them.
    Chaos(Box<ChaosCertificate>),
    /// A JSON of verdicts over a parameter: the verdict on each subinterval.
    Cells(Box<CellsCertificate>),
    /// A trap JSON: that the region is a trapping region is checked, and its other claims.
    Trap(Box<TrapCertificate>),
    /// A description: its orbit and its region are checked, and that its fate agrees with them.
    Description(Box<DescriptionCertificate>),
    /// Several documents in a list, checked one by one.
    List(Vec<Claims>),
    /// Not checked, for the given reason.
    Unchecked(&'static str),
}

impl Claims {
    /// Reads a document of any verb, by its schema; an orbit JSON where there is none.
    ///
    /// # Errors
    /// Name the key, its value and what is accepted.
    ///
    /// # Examples
    /// ```
    /// use impact_pair_certificate::Claims;
    ///
    /// let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/documents/count.jsonl"));
    /// assert_eq!(Claims::parse(text)?.all(), "6 events and the outcome");
    ///
    /// let error = Claims::parse(&text.replace("\"P2\"", "\"P5\"")).unwrap_err().to_string();
    /// assert!(error.contains("mapping") && error.contains("P5"), "{error}");
    /// # Ok::<(), impact_pair_model::Error>(())
    /// ```
    pub fn parse(text: &str) -> Result<Self, Error> {
        Self::of(values(text)?)
    }

    /// The claims of the values of a text.
    fn of(mut values: Vec<Value>) -> Result<Self, Error> {
        if let [Value::Array(documents)] = &mut values[..] {
            let documents = std::mem::take(documents).into_iter().map(Self::of_list).collect::<Result<_, _>>()?;
            return Ok(Self { values: Vec::new(), of: Of::List(documents), marks: None });
        }
        let (all, head) = (&values[..], &values[0]);
        let is_solved = |head: &Value| head["solved_for"].as_str().is_some_and(|what| what != "velocity");
        let (of, marks) = match head["schema"].as_str() {
            Some(PERIODIC_SCHEMA) if is_solved(head) => {
                let why = "motions solved for the amplitude or the gap: their scene has another one";
                Of::unchecked::<TwoImpactDocument>(all, why)?
            }
            Some(PERIODIC_SCHEMA) if head.get("solved_for").is_some() => {
                boxed(PeriodicCertificate::read_two_impact(all)?, Of::Periodic)
            }
            Some(PERIODIC_SCHEMA) => boxed(PeriodicCertificate::read(all)?, Of::Periodic),
            Some(CYCLES_SCHEMA) => boxed(CyclesCertificate::read(all)?, Of::Cycles),
            Some(BIFURCATION_SCHEMA) => boxed(BifurcationCertificate::read(all)?, Of::Bifurcations),
            Some(WINDOWS_SCHEMA) => boxed(WindowsCertificate::read(all)?, Of::Windows),
            Some(TANGENCY_SCHEMA) => boxed(TangencyCertificate::read(all)?, Of::Tangencies),
            Some(MANIFOLD_SCHEMA) => {
                Of::unchecked::<ManifoldDocument>(all, "parameter manifolds: that their points solve (66)-(69)")?
            }
            Some(CHAOS_CELLS_SCHEMA) => boxed(CellsCertificate::read(all)?, Of::Cells),
            Some(AUDIT_SCHEMA) => Of::unchecked::<AuditDocument>(
                all,
                "comparisons with another program's list: what is inside, missed or false",
            )?,
            Some(GLOBAL_SCHEMA) => boxed(GlobalCertificate::read(all)?, Of::Global),
            Some(ATLAS_SCHEMA) => boxed(AtlasCertificate::read(all)?, Of::Atlas),
            Some(TRADE_SCHEMA) => Of::unchecked::<TradeDocument>(all, "measurements of the cost of accuracy")?,
            Some(SWEEP_SCHEMA) => boxed(SweepCertificate::read(all)?, Of::Sweep),
            Some(CHAOS_SCHEMA) => boxed(ChaosCertificate::read(all)?, Of::Chaos),
            Some(TRAP_SCHEMA) => boxed(TrapCertificate::read(all)?, Of::Trap),
            Some(DESCRIPTION_SCHEMA) => boxed(DescriptionCertificate::read(all)?, Of::Description),
            _ => boxed(Certificate::read(all)?, Of::Orbit),
        };
        if let (Of::Description(description), Value::Object(entries)) = (&of, &mut values[0]) {
            description.parts().iter().for_each(|(key, _)| drop(entries.remove(*key)));
        }
        Ok(Self { values, of, marks })
    }

    fn of_list(document: Value) -> Result<Self, Error> {
        if document.is_object() {
            return Self::of(vec![document]);
        }
        Err(Error::certificate("a list must be one of documents".to_owned()))
    }

    /// The claims of a document in another one.
    pub(super) fn part(value: &Value, (of, marks): (Of, Option<Mark>)) -> Self {
        Self { values: vec![value.clone()], of, marks }
    }

    /// The scene of a document; `None` of a list of documents.
    pub fn scene(&self) -> Option<SceneDocument> {
        SceneDocument::deserialize(self.values.first()?.get("scene")?).ok()
    }

    /// The documents of a list or a description, each with its place; `None` for all others.
    pub(super) fn documents(&self) -> Option<Vec<(String, &Self)>> {
        match &self.of {
            Of::List(documents) => {
                Some(documents.iter().enumerate().map(|(i, document)| (format!("[{i}]"), document)).collect())
            }
            Of::Description(certificate) => {
                Some(certificate.parts().iter().map(|(key, document)| ((*key).to_owned(), document)).collect())
            }
            _ => None,
        }
    }

    /// Checks one document after another; the verdict is on the first document that is not confirmed.
    fn judge_each(documents: &[(String, &Self)], limits: &Limits, watch: &dyn Watch) -> Result<CheckResult, Error> {
        let (mut before, mut most) = (0, (0, 0));
        for (_, document) in documents {
            let after = |at: Stage<'_>| match at {
                Stage::Claims(claims) => watch.proceed(Stage::Claims(before + claims)),
                at => watch.proceed(at),
            };
            let CheckResult { verdict, confirmed } = document.judge(limits, &after)?;
            let at = |finding: Finding| Finding { event: before + finding.event, ..finding };
            let verdict = match verdict {
                Verdict::Confirmed { bits, pieces } => {
                    most = (most.0.max(bits), most.1.max(pieces));
                    // One more claim for the statements about the whole document.
                    before += document.count() + 1;
                    continue;
                }
                Verdict::Refuted(finding) => Verdict::Refuted(at(finding)),
                Verdict::Undecided(finding) => Verdict::Undecided(at(finding)),
                Verdict::Interrupted { events } => Verdict::Interrupted { events: before + events },
            };
            return Ok(CheckResult { verdict, confirmed: before + confirmed });
        }
        let verdict = match most {
            (0, _) => Verdict::Undecided(Finding { event: 0, message: "there is nothing to check".to_owned() }),
            (bits, pieces) => Verdict::Confirmed { bits, pieces },
        };
        Ok(CheckResult { verdict, confirmed: before })
    }

    /// Proves every claim again, or returns the first claim that is refuted or undecided. The watch can stop the check and receives
    /// the number of claims confirmed so far.
    ///
    /// # Errors
    /// Returns an error if the scene's values are beyond the range of exact expressions.
    pub fn check_within(&self, limits: &Limits, watch: &dyn Watch) -> Result<Verdict, Error> {
        Ok(self.judge(limits, watch)?.verdict)
    }

    /// Checks as [`check_within`](Self::check_within) does, and also returns how many claims were confirmed without a gap, for
    /// [`document`](Self::document).
    ///
    /// # Errors
    /// Returns an error if the scene's values are beyond the range of exact expressions.
    ///
    /// # Examples
    /// ```
    /// use impact_pair_certificate::{Claims, Limits, document::VerdictName};
    /// use impact_pair_model::watch::Unwatched;
    ///
    /// let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/documents/count.jsonl"));
    /// let claims = Claims::parse(text)?;
    /// let judged = claims.judge(&Limits::default(), &Unwatched)?;
    /// assert_eq!(judged.name(), VerdictName::Confirmed);
    /// // The same, value by value: schema impact-pair/check/1.
    /// let document = claims.document(&judged);
    /// assert!(document.claims.iter().any(|claim| claim.path == "events[5].time"));
    /// assert!(document.not_checked.contains(&"program".to_owned()));
    /// # Ok::<(), impact_pair_model::Error>(())
    /// ```
    pub fn judge(&self, limits: &Limits, watch: &dyn Watch) -> Result<CheckResult, Error> {
        if let Of::Description(certificate) = &self.of
            && let Some(finding) = certificate.contradiction()
        {
            return Ok(CheckResult { verdict: Verdict::Refuted(finding), confirmed: 0 });
        }
        if let Some(documents) = self.documents() {
            let judged = Self::judge_each(&documents, limits, &Latched::new(watch))?;
            return Ok(match (&self.of, &judged.verdict) {
                (Of::Description(certificate), Verdict::Confirmed { .. }) => certificate.with_fate(judged),
                _ => judged,
            });
        }
        let Some(certificate) = self.certificate() else {
            let nothing = Finding { event: 0, message: "nothing of it is checked".to_owned() };
            return Ok(CheckResult { verdict: Verdict::Undecided(nothing), confirmed: 0 });
        };
        let (mut verdict, certain) = certificate.judge(limits, watch)?;
        if let Verdict::Confirmed { .. } = verdict
            && certificate.claims_nothing()
        {
            let message = "it claims nothing that is compared".to_owned();
            verdict = Verdict::Undecided(Finding { event: self.count(), message });
        }
        let confirmed = if let Verdict::Confirmed { .. } = verdict { self.count() + 1 } else { certain };
        Ok(CheckResult { verdict, confirmed })
    }

    /// The claims of one document; `None` for several documents, and for a document that is not checked.
    pub(super) fn certificate(&self) -> Option<&dyn Checked> {
        Some(match &self.of {
            Of::Orbit(certificate) => &**certificate,
            Of::Periodic(certificate) => &**certificate,
            Of::Cycles(certificate) => &**certificate,
            Of::Bifurcations(certificate) => &**certificate,
            Of::Windows(certificate) => &**certificate,
            Of::Global(certificate) => &**certificate,
            Of::Tangencies(certificate) => &**certificate,
            Of::Sweep(certificate) => &**certificate,
            Of::Atlas(certificate) => &**certificate,
            Of::Chaos(certificate) => &**certificate,
            Of::Cells(certificate) => &**certificate,
            Of::Trap(certificate) => &**certificate,
            Of::Description(_) | Of::List(_) | Of::Unchecked(_) => return None,
        })
    }

    /// Number of claims in order: events, orbits.
    pub fn count(&self) -> usize {
        // Each of several documents counts one more for the statements about the whole document.
        let of_each = || self.documents().into_iter().flatten().map(|(_, document)| document.count() + 1).sum();
        self.certificate().map_or_else(of_each, |certificate| certificate.count())
    }

    /// The first `count` claims, in words.
    pub fn first(&self, count: usize) -> String {
        if let Some(certificate) = self.certificate() {
            return certificate.first(count);
        }
        let mut left = count;
        let documents = self.documents().unwrap_or_default();
        let whole = documents.iter().take_while(|(_, document)| {
            let size = document.count() + 1;
            let is_whole = left >= size;
            left = left.saturating_sub(size);
            is_whole
        });
        counted(whole.count(), "document")
    }

    /// All claims, in words.
    pub fn all(&self) -> String {
        if let Some(certificate) = self.certificate() {
            return certificate.all();
        }
        let documents = self.documents().unwrap_or_default();
        let each = documents.iter().map(|(_, document)| document.all()).collect::<Vec<_>>().join(", ");
        match &self.of {
            Of::Description(certificate) if certificate.is_fate_judged() => format!("the fate: {each}"),
            Of::Description(_) => format!("{each}, not the fate"),
            Of::List(documents) => format!("{}: {each}", counted(documents.len(), "document")),
            _ => "nothing".to_owned(),
        }
    }

    /// The claim of a finding, and the reason why it is not confirmed, in words.
    pub fn described(&self, Finding { event, message }: &Finding) -> String {
        match self.certificate() {
            Some(certificate) => certificate.described(*event, message),
            None => {
                let mut left = *event;
                for (at, document) in self.documents().unwrap_or_default() {
                    if left <= document.count() {
                        let finding = Finding { event: left, message: message.clone() };
                        return format!("{at}: {}", document.described(&finding));
                    }
                    left -= document.count() + 1;
                }
                message.clone()
            }
        }
    }
}

impl Of {
    /// A document that is read but not checked.
    fn unchecked<T: DeserializeOwned>(values: &[Value], why: &'static str) -> Result<(Self, Option<Mark>), Error> {
        Place::alone(values)?.read::<T>().map(|_| (Self::Unchecked(why), None))
    }
}

/// The claims of a verb, with what is said of each value.
pub(super) fn boxed<C>((claims, marks): (C, Mark), of: impl Fn(Box<C>) -> Of) -> (Of, Option<Mark>) {
    (of(Box::new(claims)), Some(marks))
}
