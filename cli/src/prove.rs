//! `impact-pair prove CERTIFICATE`: an orbit JSON as a theorem for Coq.

use std::io::Write;

use anyhow::{Context, Result, bail};
use impact_pair_certificate::{Certificate, ClaimKind};

use crate::Answer;
use crate::arguments::ProveArguments;
use crate::ending;
use crate::output::{Output, note};
use crate::progress::Progress;
use crate::scene;

pub fn prove(arguments: &ProveArguments) -> Result<Answer> {
    ending::only("v", arguments.destination.output.as_deref())?;
    let path = &arguments.certificate;
    let certificate = Certificate::parse(&scene::text(path)?).with_context(|| scene::name(path))?;
    scene::keep(path, arguments.destination.output.as_deref())?;
    let listed = certificate.events().iter().take_while(|claim| matches!(claim.kind, ClaimKind::Impact { .. })).count();
    if listed == 0 {
        bail!("{}: there is no impact to prove before the first other event", scene::name(path));
    }
    let wanted = arguments.impacts.map_or(listed, |wanted| usize::try_from(wanted).unwrap_or(usize::MAX));
    let mut out = Output::open(arguments.destination.output.as_deref())?;
    let progress = Progress::new(Some(wanted.min(listed) as u64), !arguments.destination.quiet && !out.is_terminal());
    let theorem = certificate.prove(wanted, &progress).with_context(|| scene::name(path))?;
    progress.clear();
    let (proved, stop) = (theorem.impacts, theorem.stop.as_ref());
    if proved > 0 {
        out.write_all(theorem.text.as_bytes()).context("cannot write the output")?;
        out.commit()?;
    }
    let said = if proved > 0 { format!("written: a theorem of {proved} impacts") } else { "nothing is proved".into() };
    let why = stop.map(|finding| format!("; {}", certificate.described(finding.event, &finding.message)));
    note(arguments.destination.quiet, &(said + &why.unwrap_or_default()));
    Ok(if stop.is_none() { Answer::Complete } else { Answer::Incomplete })
}
