//! `impact-pair check CERTIFICATE`: every claim of a JSON document, proved again by another route.

use std::io::{self, IsTerminal, Write};

use anyhow::{Context, Result};
use impact_pair::certificate::{Claims, Verdict};

use crate::Answer;
use crate::arguments::CheckArguments;
use crate::progress::{Progress, interruption};
use crate::scene;

pub fn check(arguments: &CheckArguments) -> Result<Answer> {
    let path = &arguments.certificate;
    let claims = Claims::parse(&scene::text(path)?).with_context(|| scene::name(path))?;
    let visible = !arguments.quiet && io::stderr().is_terminal();
    let progress = Progress::new(Some(claims.count() as u64), visible);
    // From here on Ctrl-C keeps what is proved.
    let stop = Some(interruption());
    let verdict = claims.check_until(&arguments.effort(), stop, |event| progress.reach(event as u64));
    let verdict = verdict.with_context(|| scene::name(path))?;
    progress.clear();
    let (said, answer) = match &verdict {
        Verdict::Confirmed { bits, pieces } => {
            let pieces = if *pieces == 1 { String::new() } else { format!(", the data cut into {pieces} sets") };
            (format!("confirmed: {}, in {bits} bits{pieces}", claims.all()), Answer::Complete)
        }
        Verdict::Refuted(finding) => (format!("refuted: {}", claims.described(finding)), Answer::Incomplete),
        Verdict::Undecided(finding) => (format!("undecided: {}", claims.described(finding)), Answer::Incomplete),
        Verdict::Interrupted { events } => {
            (format!("interrupted: {} confirmed", claims.first(*events)), Answer::Incomplete)
        }
    };
    let mut out = io::stdout();
    writeln!(out, "{said}").context("cannot write to stdout")?;
    let unjudged = claims.unjudged();
    if !unjudged.is_empty() {
        writeln!(out, "not checked: {}", unjudged.join(", ")).context("cannot write to stdout")?;
    }
    Ok(answer)
}
