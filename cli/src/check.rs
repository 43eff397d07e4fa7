//! `impact-pair check CERTIFICATE`: every claim of a JSON document, proved again by an independent method.

use std::io::Write;
use std::path::PathBuf;

use anyhow::{Context, Error, Result, anyhow};
use clap::{Args, ValueEnum};
use impact_pair::json::{CheckDocument, one_a_line};
use impact_pair::{Effort, Scene};
use impact_pair_certificate::{Claims, Verdict};

use crate::Answer;
use crate::destination::{Destination, Files};
use crate::progress::Progress;
use crate::{scene, verified};

pub const EXIT_CODES: &str = "\
Exit code: 0 every claim is proved again; 1 a claim is refuted or undecided; 2 usage, bad input, I/O";

pub const HELP: &str = "\
Examples:
  impact-pair run scenes/figure-14.toml --format json | impact-pair check -
  impact-pair run scenes/chatter.toml --format jsonl --output orbit.jsonl
  impact-pair check orbit.jsonl --format json

Each flight is followed again from the exact data of the certificate's own scene, by an independent method: in the \
units of the scene, by bisection, in one integer arithmetic whose precision rises until every claimed bound is \
decided. A claim is confirmed if the value found lies within its bounds, and refuted if it lies outside. JSON Lines \
are accepted as well.

For a shadowed orbit (run --arithmetic shadow), one start within the given bounds is proved to have all the impacts, \
each in its box: link by link, on all processors.

For periodic, two-impact and cycles, each orbit is proved again: existence and uniqueness within its bounds, \
stability, symmetry, and whether a wall is touched earlier. That there are no other orbits is not checked; for \
cycles, the counts are compared with the orbits listed. For bifurcations, each fold, pitchfork and period doubling \
is proved again, the grazes are not. For windows, each orbit, both ends of its window and the orbits between are \
proved again. For tangency, each tangency is proved again, and how many common points the invariant manifolds have beside it. \
For sweep, the listed impacts are proved again, the long-term outcome is not. For global, a graph of all states is \
recomputed, and each attractor, cycle with rests and saddle is proved again in it; for atlas, so is each point or cell. \
For trap, the listed boxes are proved to be forward invariant. For chaos, each listed word is proved with the \
strip that the document has for it, and the entropies are proved to follow from the words; for chaos --over, each verdict is \
proved for its whole subinterval. For describe, the orbit and the region in it are proved again, and the fate is compared \
with theirs. Parameter manifolds are not checked. A \
separate line names the values that are not checked; with --format json each value of the document is listed among \
the claims with its verdict, or among those not checked. Ctrl-C keeps the proved part.

With --strict a claim that is not checked is not accepted: the exit code is 1 where the first line names one.

With --verified the program impact-pair-verified answers, if it is beside impact-pair or on PATH: its checker is \
extracted from a proof in Coq. It prints what a JSON of run, periodic, trap or chaos claims, and that it is verified, or why \
not: a document that claims more than the theorems cover, such as a graze, is not verified.

Exit code: 0 every claim is proved again, except those named as not checked; 1 a claim is refuted or undecided, or not \
verified; 2 usage, bad input, I/O.";

#[derive(Args, Debug)]
pub struct CheckArguments {
    /// JSON of run, sweep or atlas (or JSON Lines), describe, periodic, two-impact, cycles, bifurcations, windows, tangency, global, trap or chaos, or
    /// - for stdin
    pub certificate: PathBuf,
    /// Have the program impact-pair-verified, whose checker is extracted from its proof in Coq, check a JSON of run, periodic,
    /// trap or chaos instead
    #[arg(long, conflicts_with = "effort")]
    pub verified: bool,
    /// Accept no claim that is not checked: exit 1 where the first line names one
    #[arg(long, conflicts_with = "verified")]
    pub strict: bool,
    /// Multiply the work allowed for each claim by X, before it is left undecided
    #[arg(long, value_name = "X", default_value_t)]
    pub effort: Effort,
    /// Output format; json is schema impact-pair/check/1, with --verified impact-pair/verified/1 [default: by the extension of --output, else text]
    #[arg(long, value_enum)]
    pub format: Option<CheckFormat>,
    #[command(flatten)]
    pub destination: Destination,
}

/// Output formats of a verdict.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum CheckFormat {
    /// Human-readable: the verdict in one line, the unchecked keys in another
    #[default]
    Text,
    /// Each claim with its verdict, and the path of each value that is not checked
    Json,
}

pub fn check(arguments: &CheckArguments) -> Result<Answer> {
    let path = &arguments.certificate;
    let format = arguments.destination.format(arguments.format)?;
    if arguments.verified {
        return verified::verify(path, format == CheckFormat::Json, arguments.destination.output.as_deref());
    }
    let text = scene::text(path)?;
    let claims = Claims::parse(&text).map_err(|error| match Scene::parse(&text) {
        Ok(_) => anyhow!(
            "{0} is a scene, but accepted is a JSON document: impact-pair run {0} --format json | impact-pair check -",
            scene::name(path)
        ),
        Err(_) => Error::from(error).context(scene::name(path)),
    })?;
    let Files { mut out, quiet, .. } = arguments.destination.open(&[path], None)?;
    let progress = Progress::new(Some(claims.count() as u64), !quiet);
    let judged = claims.judge(&arguments.effort.into(), &progress).with_context(|| scene::name(path))?;
    progress.clear();
    let sha256 = Some(verified::sha256(&text));
    let document = CheckDocument { sha256, ..claims.document(&judged) };
    let written = match format {
        CheckFormat::Json => one_a_line(&document, &["claims"]),
        CheckFormat::Text => in_words(&claims, &document),
    };
    writeln!(out, "{written}").context("cannot write the output")?;
    out.commit()?;
    let is_checked = document.unchecked_claims.is_empty() || !arguments.strict;
    Ok(match judged.verdict {
        Verdict::Confirmed { .. } if is_checked => Answer::Complete,
        _ => Answer::Incomplete,
    })
}

/// The verdict, the theorem, the scene that it is about, the name of the document, and what is not checked, a line each.
fn in_words(claims: &Claims, document: &CheckDocument) -> String {
    let unjudged = claims.unjudged();
    let lines = [
        Some(document.message.clone()),
        document.theorem.as_ref().map(|theorem| format!("theorem: {theorem}")),
        scene_in_words(claims).map(|scene| format!("scene: {scene}")),
        document.sha256.as_ref().map(|hash| format!("document: SHA-256 {hash}")),
        (!unjudged.is_empty()).then(|| format!("not checked: {}", unjudged.join(", "))),
    ];
    lines.into_iter().flatten().collect::<Vec<_>>().join("\n")
}

/// The scene of a document; `None` of a list of documents.
fn scene_in_words(claims: &Claims) -> Option<String> {
    let (pair, start) = claims.scene()?.model().ok()?;
    Some(format!("{}; {}", pair.in_words(), start.in_words()))
}
