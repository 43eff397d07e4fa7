//! Documents of every verb, and the claims that `check` proves of them.

use serde::de::DeserializeOwned;
use serde_json::{Deserializer, Value};

use crate::checked::Checked;
use crate::{
    AtlasCertificate, BifurcationCertificate, CellsCertificate, Certificate, ChaosCertificate, CheckResult,
    CyclesCertificate, DescriptionCertificate, Effort, Finding, GlobalCertificate, PeriodicCertificate,
    SweepCertificate, TangencyCertificate, TrapCertificate, Verdict, WindowsCertificate,
};
use impact_pair_document::{
    ATLAS_SCHEMA, AUDIT_SCHEMA, AuditDocument, BIFURCATION_SCHEMA, CHAOS_CELLS_SCHEMA, CHAOS_SCHEMA, CYCLES_SCHEMA,
    DESCRIPTION_SCHEMA, GLOBAL_SCHEMA, MANIFOLD_SCHEMA, ManifoldDocument, PERIODIC_SCHEMA, SWEEP_SCHEMA,
    TANGENCY_SCHEMA, TRADE_SCHEMA, TRAP_SCHEMA, TradeDocument, TwoImpactDocument, WINDOWS_SCHEMA, counted, read, value,
};
use impact_pair_model::Error;
use impact_pair_model::watch::{Latched, Stage, Watch};

/// The claims of a document.
#[derive(Clone, Debug)]
pub enum Claims {
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
    /// assert!(matches!(Claims::parse(text)?, Claims::Orbit(_)));
    ///
    /// let error = Claims::parse(&text.replace("\"P2\"", "\"P5\"")).unwrap_err().to_string();
    /// assert!(error.contains("mapping") && error.contains("P5"), "{error}");
    /// # Ok::<(), impact_pair_model::Error>(())
    /// ```
    pub fn parse(text: &str) -> Result<Self, Error> {
        let head = Deserializer::from_str(text).into_iter::<Value>().next().and_then(Result::ok);
        if let Some(Value::Array(_)) = &head {
            // Nothing may follow the list.
            return Self::list(&value(text)?);
        }
        let schema = head.as_ref().and_then(|head| head["schema"].as_str());
        Ok(match schema {
            Some(PERIODIC_SCHEMA)
                if head
                    .as_ref()
                    .is_some_and(|head| !matches!(head["solved_for"].as_str(), None | Some("velocity"))) =>
            {
                let why = "motions solved for the amplitude or the gap: their scene has another one";
                Self::unchecked::<TwoImpactDocument>(text, why)?
            }
            Some(PERIODIC_SCHEMA) => Self::Periodic(Box::new(PeriodicCertificate::parse(text)?)),
            Some(CYCLES_SCHEMA) => Self::Cycles(Box::new(CyclesCertificate::parse(text)?)),
            Some(BIFURCATION_SCHEMA) => Self::Bifurcations(Box::new(BifurcationCertificate::parse(text)?)),
            Some(WINDOWS_SCHEMA) => Self::Windows(Box::new(WindowsCertificate::parse(text)?)),
            Some(TANGENCY_SCHEMA) => Self::Tangencies(Box::new(TangencyCertificate::parse(text)?)),
            Some(MANIFOLD_SCHEMA) => {
                Self::unchecked::<ManifoldDocument>(text, "parameter manifolds: that their points solve (66)-(69)")?
            }
            Some(CHAOS_CELLS_SCHEMA) => Self::Cells(Box::new(CellsCertificate::parse(text)?)),
            Some(AUDIT_SCHEMA) => Self::unchecked::<AuditDocument>(
                text,
                "comparisons with another program's list: what is inside, missed or false",
            )?,
            Some(GLOBAL_SCHEMA) => Self::Global(Box::new(GlobalCertificate::parse(text)?)),
            Some(ATLAS_SCHEMA) => Self::Atlas(Box::new(AtlasCertificate::parse(text)?)),
            Some(TRADE_SCHEMA) => Self::unchecked::<TradeDocument>(text, "measurements of the cost of accuracy")?,
            Some(SWEEP_SCHEMA) => Self::Sweep(Box::new(SweepCertificate::parse(text)?)),
            Some(CHAOS_SCHEMA) => Self::Chaos(Box::new(ChaosCertificate::parse(text)?)),
            Some(TRAP_SCHEMA) => Self::Trap(Box::new(TrapCertificate::parse(text)?)),
            Some(DESCRIPTION_SCHEMA) => Self::Description(Box::new(DescriptionCertificate::parse(text)?)),
            _ => Self::Orbit(Box::new(Certificate::parse(text)?)),
        })
    }

    /// A document that is read but not checked.
    fn unchecked<T: DeserializeOwned>(text: &str, why: &'static str) -> Result<Self, Error> {
        read::<T>(text).map(|_| Self::Unchecked(why))
    }

    fn list(documents: &Value) -> Result<Self, Error> {
        let parse = |document: &Value| match document {
            Value::Object(_) => Self::parse(&document.to_string()),
            _ => Err(Error::certificate("a list must be one of documents".to_owned())),
        };
        let documents = documents.as_array().into_iter().flatten();
        Ok(Self::List(documents.map(parse).collect::<Result<_, _>>()?))
    }

    /// The documents of a list or a description, each with its place; `None` for all others.
    pub(super) fn documents(&self) -> Option<Vec<(String, &Self)>> {
        match self {
            Self::List(documents) => {
                Some(documents.iter().enumerate().map(|(i, document)| (format!("[{i}]"), document)).collect())
            }
            Self::Description(certificate) => {
                Some(certificate.parts().iter().map(|(key, document)| ((*key).to_owned(), document)).collect())
            }
            _ => None,
        }
    }

    /// Checks one document after another; the verdict is on the first document that is not confirmed.
    fn judge_each(documents: &[(String, &Self)], effort: &Effort, watch: &dyn Watch) -> Result<CheckResult, Error> {
        let (mut before, mut most) = (0, (0, 0));
        for (_, document) in documents {
            let after = |at: Stage<'_>| match at {
                Stage::Claims(claims) => watch.proceed(Stage::Claims(before + claims)),
                at => watch.proceed(at),
            };
            let CheckResult { verdict, confirmed } = document.judge(effort, &after)?;
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
    pub fn check_within(&self, effort: &Effort, watch: &dyn Watch) -> Result<Verdict, Error> {
        Ok(self.judge(effort, watch)?.verdict)
    }

    /// Checks as [`check_within`](Self::check_within) does, and also returns how many claims were confirmed without a gap, for
    /// [`document`](Self::document).
    ///
    /// # Errors
    /// Returns an error if the scene's values are beyond the range of exact expressions.
    ///
    /// # Examples
    /// ```
    /// use impact_pair_certificate::{Claims, Effort, document::VerdictName};
    /// use impact_pair_model::watch::Unwatched;
    ///
    /// let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/documents/count.jsonl"));
    /// let claims = Claims::parse(text)?;
    /// let judged = claims.judge(&Effort::default(), &Unwatched)?;
    /// assert_eq!(judged.name(), VerdictName::Confirmed);
    /// // The same, value by value: schema impact-pair/check/1.
    /// let document = claims.document(text, &judged);
    /// assert!(document.claims.iter().any(|claim| claim.path == "events[5].time"));
    /// assert!(document.not_checked.contains(&"program".to_owned()));
    /// # Ok::<(), impact_pair_model::Error>(())
    /// ```
    pub fn judge(&self, effort: &Effort, watch: &dyn Watch) -> Result<CheckResult, Error> {
        if let Self::Description(certificate) = self
            && let Some(finding) = certificate.contradiction()
        {
            return Ok(CheckResult { verdict: Verdict::Refuted(finding), confirmed: 0 });
        }
        if let Some(documents) = self.documents() {
            let judged = Self::judge_each(&documents, effort, &Latched::new(watch))?;
            return Ok(match (self, &judged.verdict) {
                (Self::Description(certificate), Verdict::Confirmed { .. }) => certificate.with_fate(judged),
                _ => judged,
            });
        }
        let Some(certificate) = self.certificate() else {
            let nothing = Finding { event: 0, message: "nothing of it is checked".to_owned() };
            return Ok(CheckResult { verdict: Verdict::Undecided(nothing), confirmed: 0 });
        };
        let (mut verdict, certain) = certificate.judge(effort, watch)?;
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
        Some(match self {
            Self::Orbit(certificate) => &**certificate,
            Self::Periodic(certificate) => &**certificate,
            Self::Cycles(certificate) => &**certificate,
            Self::Bifurcations(certificate) => &**certificate,
            Self::Windows(certificate) => &**certificate,
            Self::Global(certificate) => &**certificate,
            Self::Tangencies(certificate) => &**certificate,
            Self::Sweep(certificate) => &**certificate,
            Self::Atlas(certificate) => &**certificate,
            Self::Chaos(certificate) => &**certificate,
            Self::Cells(certificate) => &**certificate,
            Self::Trap(certificate) => &**certificate,
            Self::Description(_) | Self::List(_) | Self::Unchecked(_) => return None,
        })
    }

    /// Number of claims in order: events, orbits.
    pub fn count(&self) -> usize {
        // Each of several documents counts one more for the statements about the whole document.
        let of_each = || self.documents().into_iter().flatten().map(|(_, document)| document.count() + 1).sum();
        self.certificate().map_or_else(of_each, |certificate| certificate.count())
    }

    /// Keys, or statements, that are not checked.
    ///
    /// ```
    /// # use impact_pair_certificate::Claims;
    /// let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/documents/count.jsonl"));
    /// assert_eq!(Claims::parse(text)?.unjudged(), ["arithmetic", "program"]);
    /// # Ok::<(), impact_pair_model::Error>(())
    /// ```
    pub fn unjudged(&self) -> Vec<String> {
        if let Self::Unchecked(why) = self {
            return vec![(*why).to_owned()];
        }
        if let Some(certificate) = self.certificate() {
            return certificate.unjudged().to_vec();
        }
        let of =
            |(at, document): (String, &Self)| document.unjudged().into_iter().map(move |key| format!("{at}.{key}"));
        let own = if let Self::Description(certificate) = self { certificate.own_unjudged() } else { &[] };
        own.iter().cloned().chain(self.documents().into_iter().flatten().flat_map(of)).collect()
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
        match self {
            Self::Description(certificate) if certificate.is_fate_judged() => format!("the fate: {each}"),
            Self::Description(_) => format!("{each}, not the fate"),
            Self::List(documents) => format!("{}: {each}", counted(documents.len(), "document")),
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
