//! `impact-pair check CERTIFICATE`: every claim of a JSON document, proved again by another route.

use std::io::{self, Write};

use anyhow::{Context, Result};
use impact_pair::certificate::{Claims, Verdict};

use crate::Answer;
use crate::arguments::CheckArguments;
use crate::progress::{Progress, interruption};
use crate::scene;

pub fn check(arguments: &CheckArguments) -> Result<Answer> {
    let path = &arguments.certificate;
    let claims = Claims::parse(&scene::text(path)?).with_context(|| scene::name(path))?;
    let progress = Progress::new(Some(claims.count() as u64), !arguments.quiet);
    // From here on Ctrl-C keeps what is proved.
    let stop = Some(interruption());
    let verdict = claims.check_until(&arguments.effort(), stop, |event| progress.reach(event as u64));
    let verdict = verdict.with_context(|| scene::name(path))?;
    progress.clear();
    let mut said = match &verdict {
        Verdict::Confirmed { bits, pieces } => {
            let pieces = if *pieces == 1 { String::new() } else { format!(", the data cut into {pieces} sets") };
            format!("confirmed: {}, in {bits} bits{pieces}", claims.all())
        }
        Verdict::Refuted(finding) => format!("refuted: {}", claims.described(finding)),
        Verdict::Undecided(finding) => format!("undecided: {}", claims.described(finding)),
        Verdict::Interrupted { events } => format!("interrupted: {} confirmed", claims.first(*events)),
    };
    let unjudged = claims.unjudged();
    if !unjudged.is_empty() {
        said += &format!("\nnot checked: {}", unjudged.join(", "));
    }
    writeln!(io::stdout(), "{said}").context("cannot write to stdout")?;
    Ok(if let Verdict::Confirmed { .. } = verdict { Answer::Complete } else { Answer::Incomplete })
}
