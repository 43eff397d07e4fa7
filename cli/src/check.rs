//! `impact-pair check CERTIFICATE`: every claim of an orbit JSON, proved again by another route.

use std::io::{self, IsTerminal, Write};
use std::path::Path;

use anyhow::{Context, Result};
use impact_pair::certificate::{Certificate, ClaimKind, Finding, Verdict};

use crate::Answer;
use crate::arguments::CheckArguments;
use crate::progress::Progress;
use crate::scene;

pub fn check(arguments: &CheckArguments) -> Result<Answer> {
    let path = &arguments.certificate;
    let certificate = read(path)?;
    let visible = !arguments.quiet && io::stderr().is_terminal();
    let progress = Progress::new(Some(certificate.events().len() as u64), visible);
    let verdict = certificate.check(|event| progress.reach(event as u64)).with_context(|| scene::name(path))?;
    progress.clear();
    let (said, answer) = match &verdict {
        Verdict::Confirmed { bits, pieces } => {
            let events = certificate.events().len();
            let pieces = if *pieces == 1 { String::new() } else { format!(", the data cut into {pieces} sets") };
            (format!("confirmed: {events} events and the outcome, in {bits} bits{pieces}"), Answer::Complete)
        }
        Verdict::Refuted(finding) => (format!("refuted: {}", described(&certificate, finding)), Answer::Incomplete),
        Verdict::Undecided(finding) => (format!("undecided: {}", described(&certificate, finding)), Answer::Incomplete),
    };
    writeln!(io::stdout(), "{said}").context("cannot write to stdout")?;
    Ok(answer)
}

/// Reads an orbit JSON.
pub fn read(path: &Path) -> Result<Certificate> {
    Certificate::parse(&scene::text(path)?).with_context(|| scene::name(path))
}

/// Which claim, and what is wrong with it.
pub fn described(certificate: &Certificate, Finding { event, message }: &Finding) -> String {
    let claim = match certificate.events().get(*event).map(|claim| &claim.kind) {
        None => "outcome".to_owned(),
        Some(ClaimKind::Impact { index, .. }) => format!("events[{event}], impact {index}"),
        Some(ClaimKind::Graze) => format!("events[{event}], a graze"),
        Some(ClaimKind::Rest { .. }) => format!("events[{event}], a rest"),
        Some(ClaimKind::Release) => format!("events[{event}], a release"),
    };
    format!("{claim}: {message}")
}
