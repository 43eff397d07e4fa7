//! `impact-pair check CERTIFICATE`: every claim of a JSON document, proved again by an independent method.

use std::io::Write;

use anyhow::{Context, Error, Result, anyhow};
use impact_pair::Scene;
use impact_pair::json::one_a_line;
use impact_pair_certificate::{Claims, Verdict};

use crate::Answer;
use crate::arguments::{CheckArguments, CheckFormat};
use crate::output::Output;
use crate::progress::{Progress, catch_interruption};
use crate::{scene, verified};

pub fn check(arguments: &CheckArguments) -> Result<Answer> {
    let (path, output) = (&arguments.certificate, arguments.destination.output.as_deref());
    if arguments.verified {
        return verified::verify(path, output);
    }
    let format = arguments.destination.format(arguments.format)?;
    let text = scene::text(path)?;
    let claims = Claims::parse(&text).map_err(|error| match Scene::parse(&text) {
        Ok(_) => anyhow!(
            "{0} is a scene, but accepted is a JSON document: impact-pair run {0} --format json | impact-pair check -",
            scene::name(path)
        ),
        Err(_) => Error::from(error).context(scene::name(path)),
    })?;
    scene::keep(path, output)?;
    let mut out = Output::open(output)?;
    let progress = Progress::new(Some(claims.count() as u64), !arguments.destination.quiet);
    // From here on Ctrl-C keeps what is proved.
    catch_interruption();
    let judged = claims.judge(&arguments.effort(), &progress).with_context(|| scene::name(path))?;
    progress.clear();
    let said = match format {
        CheckFormat::Json => one_a_line(&claims.document(&text, &judged), &["claims"]),
        CheckFormat::Text => {
            let unjudged = claims.unjudged();
            let named =
                if unjudged.is_empty() { String::new() } else { format!("\nnot checked: {}", unjudged.join(", ")) };
            claims.said(&judged.verdict) + &named
        }
    };
    writeln!(out, "{said}").context("cannot write the output")?;
    out.commit()?;
    Ok(if let Verdict::Confirmed { .. } = judged.verdict { Answer::Complete } else { Answer::Incomplete })
}
