//! `impact-pair prove CERTIFICATE`: an orbit JSON as a theorem for Coq.

use std::io::Write;
use std::path::PathBuf;

use anyhow::{Context, Result, bail};
use clap::Args;
use impact_pair_certificate::Certificate;

use crate::Answer;
use crate::destination::Destination;
use crate::ending;
use crate::output::{Output, note};
use crate::progress::{Progress, catch_interruption};
use crate::scene;
use impact_pair_answers::values::count;

pub const EXIT_CODES: &str = "\
Exit code: 0 the file proves all the impacts requested; 1 fewer of them; 2 usage, bad input, I/O";

pub const HELP: &str = "\
Examples:
  impact-pair run scenes/figure-14.toml --format json | impact-pair prove - --output Figure14.v
  impact-pair run scenes/figure-12.toml --format json | impact-pair prove - --impacts 10

The theorem: for every start and all parameters that the scene allows there is exactly one sequence of impacts, each the \
first contact after the one before, on the listed walls, at times and velocities within the printed bounds. It covers \
the impacts up to the first graze, rest or release, their number, and that no other comes up to the time `until`, not \
the rest of the outcome: what is not stated is named. Coq checks it on top of the library of validation/coq; no part of \
impact-pair is trusted for that.

Exit code: 0 the file proves all the impacts requested (or those up to the first other event); 1 fewer of them; 2 usage, bad \
input, I/O.";

#[derive(Args, Debug)]
pub struct ProveArguments {
    /// Orbit JSON or JSON Lines, as written by run --format json or jsonl, or - for stdin
    pub certificate: PathBuf,
    /// Prove the first N impacts [default: all]
    #[arg(long, value_name = "N", value_parser = count(1..=u64::MAX))]
    pub impacts: Option<u64>,
    #[command(flatten)]
    pub destination: Destination,
}

pub fn prove(arguments: &ProveArguments) -> Result<Answer> {
    ending::only("v", arguments.destination.output.as_deref())?;
    let path = &arguments.certificate;
    let certificate = Certificate::parse(&scene::text(path)?).with_context(|| scene::name(path))?;
    scene::keep(path, arguments.destination.output.as_deref())?;
    let listed = certificate.events().iter().take_while(|claim| claim.kind.is_impact()).count();
    if listed == 0 {
        bail!("{}: there is no impact to prove before the first other event", scene::name(path));
    }
    let is_short = listed == certificate.events().len() && arguments.impacts.is_some_and(|count| count > listed as u64);
    let count = arguments.impacts.map_or(listed, |count| usize::try_from(count).unwrap_or(usize::MAX));
    let mut out = Output::open(arguments.destination.output.as_deref())?;
    let progress = Progress::new(Some(count.min(listed) as u64), !arguments.destination.quiet && !out.is_terminal());
    catch_interruption();
    let theorem = certificate.prove(count, &progress).with_context(|| scene::name(path))?;
    progress.clear();
    let (proved, stop) = (theorem.impacts, theorem.stop.as_ref());
    if proved > 0 {
        out.write_all(theorem.text.as_bytes()).context("cannot write the output")?;
        out.commit()?;
    }
    let said = if proved > 0 { format!("written: a theorem of {proved} impacts") } else { "nothing is proved".into() };
    let why = stop.map(|finding| format!("; {}", certificate.described(finding.event, &finding.message)));
    let why = why.or_else(|| is_short.then(|| format!("; the list has {listed}")));
    let besides = theorem.left_out.as_ref().filter(|_| proved > 0).map(|what| format!("; not stated: {what}"));
    note(arguments.destination.quiet, &(said + &why.unwrap_or_default() + &besides.unwrap_or_default()));
    Ok(if stop.is_none() && !is_short { Answer::Complete } else { Answer::Incomplete })
}
