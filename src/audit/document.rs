//! The audit JSON: the documents of an audit and of its parts.

use impact_pair_document::{
    AUDIT_SCHEMA, AuditDocument, AuditEvent, CertifiedContact, Counts, Disagreement, Divergence, DoublePrecision,
    ImpactNumber, ImpactVerdict, ListedError, PROGRAM, Parting, SceneDocument, Units, bounds,
};

use super::Audit;
use super::doubles;
use super::finding::Finding;
use super::truth::{Site, SiteKind};
use super::verdict::Verdict;
use crate::exact::Enclosure;

/// Bits in which the end of the comparison is shown.
const BITS: u32 = 64;

impl Audit<'_> {
    /// The audit JSON.
    pub fn document(&self) -> AuditDocument {
        let Self { scene, truth, judgement, tolerance, doubles, .. } = self;
        let count = |verdict: Verdict| self.count(|other| other == verdict);
        let scales = &tolerance.scales;
        let disagreement = |finding: &Finding| Disagreement {
            impact: self.impact(finding),
            verdict: finding.verdict.name().to_owned(),
            row: row(finding.row),
        };
        AuditDocument {
            schema: AUDIT_SCHEMA.to_owned(),
            program: PROGRAM.to_owned(),
            scene: SceneDocument::new(scene.pair(), scene.start()),
            tolerance: (&tolerance.relative).into(),
            units: Units { time: bounds(&scales.period), velocity: bounds(&scales.velocity) },
            until: bounds(&Enclosure::from_rational(&self.end, BITS)),
            digits: self.settings.digits,
            arithmetic: truth.computed.clone(),
            outcome: truth.conclusion.document(),
            agreed: self.is_agreed(),
            message: self.conclusion(),
            counts: Counts {
                listed: self.rows.len(),
                left_out: self.left_out,
                inside: count(Verdict::Inside),
                outside: count(Verdict::Outside),
                missed: count(Verdict::Missed),
                false_: self.count(|verdict| matches!(verdict, Verdict::False(_))),
                chatter: count(Verdict::InChatter),
                undecided: count(Verdict::Undecided),
                not_reached: count(Verdict::NotReached),
            },
            unused_columns: self.unused.clone(),
            first_disagreement: self.first_disagreement().map(disagreement),
            another_orbit: judgement.departure.map(|found| Divergence { impact: found.impact, row: row(found.row) }),
            double_precision: DoublePrecision {
                rounded_data: doubles.data.map(parting),
                float: doubles.float.map(parting),
            },
            events: judgement.findings.iter().map(|finding| event(finding, self)).collect(),
        }
    }
}

fn parting(parting: doubles::Parting) -> Parting {
    let verdict = |(impact, verdict): (u64, Verdict)| ImpactVerdict { impact, verdict: verdict.name().to_owned() };
    Parting {
        first_disagreement: parting.disagrees.map(verdict),
        another_orbit: parting.leaves.map(|impact| ImpactNumber { impact }),
    }
}

/// Counts rows from 1.
fn row(row: Option<usize>) -> Option<usize> {
    row.map(|row| row + 1)
}

fn event(finding: &Finding, audit: &Audit<'_>) -> AuditEvent {
    let reason = match finding.verdict {
        Verdict::False(reason) => Some(reason.name().to_owned()),
        _ => None,
    };
    let listed = audit.row(finding).map(|listed| listed.map(|number| number.written.clone()));
    let contact = audit.site(finding).map(contact);
    let is_it = finding.errors.is_some() || finding.verdict == Verdict::Missed;
    let (certified, nearest) = if is_it { (contact, None) } else { (None, contact) };
    let error = finding
        .errors
        .as_ref()
        .map(|errors| ListedError { time: bounds(&errors.time), velocity: errors.velocity.as_ref().map(bounds) });
    let verdict = finding.verdict.name().to_owned();
    AuditEvent { verdict, reason, row: row(finding.row), listed, certified, nearest, error }
}

fn contact(site: &Site) -> CertifiedContact {
    let (name, index) = match site.kind {
        SiteKind::Impact => ("impact", Some(site.index)),
        SiteKind::Start => ("start", None),
        SiteKind::Graze => ("graze", None),
    };
    CertifiedContact {
        event: name.to_owned(),
        index,
        wall: site.wall,
        time: bounds(&site.time),
        velocity: site.velocity.as_ref().map(bounds),
    }
}
