//! The audit JSON, schema `impact-pair/audit/1`.
//!
//! Certified values and errors are decimal bounds, rounded outward: a listed time is at least `error.time[0]` and at most `error.time[1]`
//! away from the true one. Listed numbers are as they were written.

use impact_pair::certificate::{self, PROGRAM};
use impact_pair::exact::{Enclosure, decimal_bounds};
use serde_json::{Value, json};

use super::Audit;
use super::doubles::Parting;
use super::judge::Finding;
use super::truth::{Site, SiteKind};
use super::verdict::Verdict;

const SCHEMA: &str = "impact-pair/audit/1";
/// Bits that a time to judge up to is shown in.
const BITS: u32 = 64;

/// The whole document, an event a line.
pub fn document(audit: &Audit<'_>) -> String {
    let Audit { scene, truth, judgement, tolerance, doubles, .. } = audit;
    let count = |verdict: Verdict| judgement.count(|other| other == verdict);
    let first = judgement.first_disagreement().map(|finding| {
        json!({"impact": judgement.impact(finding, truth), "verdict": finding.verdict.name(), "row": row(finding)})
    });
    let departure =
        judgement.departure.map(|found| json!({"impact": found.impact, "row": found.row.map(|row| row + 1)}));
    let head = [
        ("schema", json!(SCHEMA)),
        ("program", json!(PROGRAM)),
        ("scene", certificate::scene(scene.pair(), scene.start())),
        ("tolerance", json!(tolerance.relative.text())),
        (
            "units",
            json!({
                "time": decimal_bounds(&tolerance.scales.period),
                "velocity": decimal_bounds(&tolerance.scales.velocity),
            }),
        ),
        ("until", json!(decimal_bounds(&Enclosure::from_rational(&audit.end, BITS)))),
        ("digits", json!(audit.settings.digits)),
        ("arithmetic", truth.computed.clone()),
        ("outcome", truth.conclusion.json()),
        ("agreed", json!(audit.is_agreed())),
        ("message", json!(audit.conclusion())),
        (
            "counts",
            json!({
                "listed": audit.rows.len(),
                "left_out": audit.left_out,
                "inside": count(Verdict::Inside),
                "outside": count(Verdict::Outside),
                "missed": count(Verdict::Missed),
                "false": judgement.count(|verdict| matches!(verdict, Verdict::False(_))),
                "chatter": count(Verdict::InChatter),
                "undecided": count(Verdict::Undecided),
            }),
        ),
        ("first_disagreement", json!(first)),
        ("another_orbit", json!(departure)),
        ("double_precision", json!({"rounded_data": doubles.data.map(parting), "float": doubles.float.map(parting)})),
    ];
    let head: Vec<String> = head.iter().map(|(key, value)| format!("\"{key}\":{value}")).collect();
    let events: Vec<String> = judgement.findings.iter().map(|finding| event(finding, audit).to_string()).collect();
    format!("{{{},\n \"events\":[\n  {}]}}\n", head.join(",\n "), events.join(",\n  "))
}

fn parting(Parting { disagrees, leaves }: Parting) -> Value {
    let first = disagrees.map(|(impact, verdict)| json!({"impact": impact, "verdict": verdict.name()}));
    json!({"first_disagreement": first, "another_orbit": leaves.map(|impact| json!({"impact": impact}))})
}

/// Counts rows from 1.
fn row(finding: &Finding) -> Option<usize> {
    finding.row.map(|row| row + 1)
}

fn event(finding: &Finding, audit: &Audit<'_>) -> Value {
    let mut event = json!({"verdict": finding.verdict.name()});
    if let Verdict::False(reason) = finding.verdict {
        event["reason"] = json!(reason.name());
    }
    if let Some(listed) = finding.row.map(|row| &audit.rows[row]) {
        event["row"] = json!(row(finding));
        event["listed"] = json!({"place": listed.place, "wall": listed.wall.name(), "time": listed.time.written});
        if let Some(velocity) = &listed.velocity {
            event["listed"]["velocity"] = json!(velocity.written);
        }
    }
    if let Some(site) = finding.site.map(|site| &audit.truth.sites[site]) {
        let certified = certified(site);
        let key = if finding.errors.is_some() || finding.verdict == Verdict::Missed { "certified" } else { "nearest" };
        event[key] = certified;
    }
    if let Some(errors) = &finding.errors {
        event["error"] = json!({"time": decimal_bounds(&errors.time)});
        if let Some(velocity) = &errors.velocity {
            event["error"]["velocity"] = json!(decimal_bounds(velocity));
        }
    }
    event
}

fn certified(site: &Site) -> Value {
    let (name, index) = match site.kind {
        SiteKind::Impact => ("impact", Some(site.index)),
        SiteKind::Start => ("start", None),
        SiteKind::Graze => ("graze", None),
    };
    let mut certified =
        json!({"event": name, "index": index, "wall": site.wall.name(), "time": decimal_bounds(&site.time)});
    if let Some(velocity) = &site.velocity {
        certified["velocity"] = json!(decimal_bounds(velocity));
    }
    certified
}
