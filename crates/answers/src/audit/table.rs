//! The audit for people: the first events that disagree, and a summary.

use std::collections::BTreeSet;

use impact_pair::audit::{Audit, Finding, Parting, Reason, Site, SiteKind, Verdict};
use impact_pair::exact::{Enclosure, decimal_digits};
use impact_pair::json::counted;
use impact_pair::scales::Unit;

use crate::{Status, heading};

/// Events that disagree and are shown; of a chaotic list thousands may follow.
const MAX_ROWS: usize = 10;

/// The table with every event, or with the first ones that disagree.
pub fn table(audit: &Audit<'_>, name: &str, all: bool, status: &Status) -> String {
    let mut lines = vec![heading(audit.scene).trim_end().to_owned()];
    lines.push(format!("list: {name}, {}", listed(audit)));
    lines.push(format!(
        "tolerance: {} of 2 pi/W in time, of {} in velocity\n",
        audit.tolerance(),
        audit.scales().speed
    ));
    let shown = shown(audit, all);
    if !shown.is_empty() {
        let [row, impact, time] = ["row", "impact", "listed time"];
        lines.push(format!("{row:>10}  {impact:>6}  wall   {time:22}  time off  velocity off  verdict"));
        lines.extend(shown.iter().map(|finding| finding.map_or("     ...".into(), |finding| line(finding, audit))));
        let count = audit.count(Verdict::disagrees);
        if count > shown.iter().flatten().filter(|finding| finding.verdict.disagrees()).count() {
            lines.push(format!("     ... {count} disagree in total (--all or --format json lists them)"));
        }
        lines.push(String::new());
    }
    lines.extend(summary(audit));
    lines.push(format!("\n{status}"));
    lines.join("\n") + "\n"
}

fn listed(audit: &Audit<'_>) -> String {
    let velocities = audit.rows.iter().filter(|row| row.velocity.is_some()).count();
    let with = match velocities {
        0 => "no velocities".to_owned(),
        all if all == audit.rows.len() => "with velocities".to_owned(),
        some => format!("{some} with velocities"),
    };
    let left_out = match audit.left_out {
        0 => String::new(),
        n => format!("; {n} later ones ignored"),
    };
    format!("{}, {with}{left_out}", counted(audit.rows.len(), "row"))
}

/// Returns the findings that the table lists: all, or the first ones that disagree or are undecided and the one at which the list
/// diverges from the orbit, each with the event before it. `None` stands for omitted findings.
fn shown<'a>(audit: &'a Audit<'_>, all: bool) -> Vec<Option<&'a Finding>> {
    let findings = audit.findings();
    if all {
        return findings.iter().map(Some).collect();
    }
    let is_of_interest = |finding: &Finding| {
        finding.verdict.disagrees() || matches!(finding.verdict, Verdict::Undecided | Verdict::NotReached)
    };
    let first = (0..findings.len()).filter(|&at| is_of_interest(&findings[at])).take(MAX_ROWS);
    let shown_findings: BTreeSet<usize> = first.chain(audit.departure().map(|departure| departure.finding)).collect();
    let with_those_before: BTreeSet<usize> = shown_findings.iter().flat_map(|&at| [at.saturating_sub(1), at]).collect();
    let mut shown = Vec::new();
    let mut next = with_those_before.first().copied().unwrap_or(0);
    for at in with_those_before {
        if at > next {
            shown.push(None);
        }
        shown.push(Some(&findings[at]));
        next = at + 1;
    }
    shown
}

fn line(finding: &Finding, audit: &Audit<'_>) -> String {
    let listed = audit.row(finding);
    let site = audit.site(finding);
    let place = listed.map_or("-", |listed| &listed.place);
    let wall = listed.map(|listed| listed.wall).or(site.map(|site| site.wall)).map_or("", |wall| wall.name());
    let is_contact = finding.errors.is_some() || finding.verdict == Verdict::Missed;
    let impact = site.filter(|_| is_contact).map_or("-".into(), label);
    let time: String = listed.map_or("-", |listed| &listed.time.written).chars().take(22).collect();
    let errors = finding.errors.as_ref();
    let off = errors.map_or("-".into(), |errors| about(&errors.time));
    let velocity = errors.and_then(|errors| errors.velocity.as_ref()).map_or("-".into(), about);
    let verdict_text = verdict_text(finding.verdict, site);
    format!("{place:>10}  {impact:>6}  {wall:5}  {time:22}  {off:8}  {velocity:12}  {verdict_text}")
}

/// A distance to two digits.
fn about(distance: &Enclosure) -> String {
    Unit::ONE.above(distance.sup()).rounded()
}

fn label(site: &Site) -> String {
    match site.kind {
        SiteKind::Impact => site.index.to_string(),
        SiteKind::Start => "start".into(),
        SiteKind::Graze => "graze".into(),
    }
}

fn verdict_text(verdict: Verdict, site: Option<&Site>) -> String {
    let named = || match site {
        Some(site) if site.kind == SiteKind::Impact => format!("impact {}", site.index),
        Some(site) => format!("the {}", label(site)),
        None => "no impact".into(),
    };
    let wall = site.map_or("its", |site| site.wall.name());
    match (verdict, site) {
        (Verdict::Missed, Some(site)) => format!("missed: certified at t = {}", decimal_digits(&site.time)),
        (Verdict::InChatter, _) => "in the chatter".into(),
        (Verdict::NotReached, _) => "not reached".into(),
        (Verdict::False(Reason::Twice), _) => format!("false: another row is {}", named()),
        (Verdict::False(Reason::Order), _) => format!("false: out of order, nearest is {}", named()),
        (Verdict::False(Reason::Wall), _) => format!("false: nearest is {}, on the {wall} wall", named()),
        (Verdict::False(Reason::Rest), _) => format!("false: the ball rests on the {wall} wall"),
        (Verdict::False(Reason::None), _) => "false: no impact is near".into(),
        (Verdict::Inside | Verdict::Outside | Verdict::Undecided | Verdict::Missed, _) => verdict.name().into(),
    }
}

fn summary(audit: &Audit<'_>) -> Vec<String> {
    let count = |verdict: Verdict| audit.count(|other| other == verdict);
    let invented = audit.count(|verdict| matches!(verdict, Verdict::False(_)));
    let mut counts: Vec<String> = [
        (count(Verdict::Inside), "inside"),
        (count(Verdict::Outside), "outside"),
        (invented, "false"),
        (count(Verdict::InChatter), "in the chatter"),
        (count(Verdict::Undecided), "undecided"),
        (count(Verdict::NotReached), "not reached"),
        (count(Verdict::Missed), "missed"),
    ]
    .into_iter()
    .filter(|&(count, _)| count > 0)
    .map(|(count, name)| format!("{count} {name}"))
    .collect();
    if counts.is_empty() {
        counts.push("nothing listed, nothing missed".into());
    }
    let mut lines = vec![counts.join(", ")];
    if let Some(first) = audit.first_disagreement() {
        let place = audit.row(first).map_or(String::new(), |row| format!(" ({})", row.place));
        let near = if let Verdict::False(_) = first.verdict { "near " } else { "" };
        let at = match audit.impact(first) {
            0 => "before impact 1".into(),
            impact => format!("{near}impact {impact}"),
        };
        lines.push(format!("first disagreement: {at}{place}, {}", first.verdict.name()));
    }
    if let Some(departure) = audit.departure() {
        let place = departure.row.map_or(String::new(), |row| format!(" ({})", audit.rows[row].place));
        lines.push(format!("diverges from the true orbit at impact {}{place}", departure.impact));
    }
    for (name, parting) in
        [("exact from rounded data", &audit.doubles.data), ("--arithmetic float", &audit.doubles.float)]
    {
        if let Some(parting) = parting {
            lines.push(format!("double precision, {name}: {}", divergence_of(parting, audit.is_open())));
        }
    }
    if let Some(index) = audit.first_wide() {
        lines.push(format!(
            "impact {index} is the first one whose certified bounds are wider than {}",
            counted(audit.digits(), "digit")
        ));
    }
    lines
}

/// Returns where an orbit in doubles differs from the truth.
fn divergence_of(Parting { disagrees, leaves }: &Parting, is_open: bool) -> String {
    let leaves = leaves.map_or(String::new(), |impact| format!(", diverges at impact {impact}"));
    match disagrees {
        Some((0, verdict)) => format!("{} before impact 1{leaves}", verdict.name()),
        Some((impact, verdict)) => format!("impact {impact} is {}{leaves}", verdict.name()),
        None if is_open => "agrees as far as that is certified".into(),
        None => "agrees".into(),
    }
}
