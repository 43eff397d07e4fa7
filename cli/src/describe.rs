//! `impact-pair describe SCENE`: what becomes of a motion, in one answer.

use std::fmt::{self, Write};
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::{Args, ValueEnum};
use impact_pair::Scene;
use impact_pair::chaos::MOST_DEPTH;
use impact_pair::describe::{Request, describe as described, lines};
use impact_pair::json::DescriptionDocument;
use impact_pair::orbit::MAX_BITS;

use crate::Answer;
use crate::destination::{Drawing, OpenOutput};
use crate::progress::Progress;
use crate::scene;
use impact_pair_answers::heading;
use impact_pair_answers::values::{bits, count, whole};

pub const EXIT_CODES: &str = "\
Exit code: 0 the fate of the motion is certified; 1 it is undecided, or the run was interrupted; 2 usage, bad input, I/O";

pub const HELP: &str = "\
Examples:
  impact-pair describe scenes/figure-12.toml
  impact-pair describe scenes/chatter.toml --plot chatter.svg --format json --output chatter.json
  impact-pair describe scenes/figure-15.toml --impacts 500

The fate of the motion is one of: attracted (it converges to a stable periodic orbit), periodic (it repeats exactly), \
rests-forever, never-impacts, stays-in-region (a trapping region holds all its impacts from one on), undecided. The \
questions are examined in the order of their cost, and only as far as the fate requires: the certified orbit with its \
outcome, for up to --impacts impacts and in double precision for ten times as many; where that leaves the fate \
undecided, a trapping region; where the motion stays in the region, a horseshoe in it and a lower bound of the \
topological entropy. So no region and no horseshoe are looked for where the motion is attracted, periodic or at rest: \
trap and chaos find those. Region and horseshoe need one harmonic.

The exponent in the limit is the logarithm of the spectral radius of the attracting orbit's Jacobian, per impact, \
only an upper bound where e may be 0; the finite-time exponent is that of the certified impacts. That a motion is \
chaotic is never claimed. Each undecided question is listed with a command that continues. [run] of the scene is not used.

Exit code: 0 the fate is certified; 1 it is undecided, or the run was interrupted (the output still has the \
certified part); 2 usage, bad input, I/O.";

#[derive(Args, Debug)]
#[command(mut_arg("plot", |plot| plot.help("Draw time series, phase plane, impacts with region and h-sets, and itinerary on one page")))]
pub struct DescribeArguments {
    /// Scene file (TOML), or - for stdin
    scene: PathBuf,
    /// Maximum number of impacts that are certified to decide the fate, in double precision ten times as many
    #[arg(long, value_name = "N", default_value_t = Request::default().impacts, value_parser = count(1..=100_000_000))]
    impacts: u64,
    /// Maximum number of impacts of a word of the horseshoe
    #[arg(long, value_name = "K", default_value_t = Request::default().depth as u32, value_parser = whole(1..=MOST_DEPTH))]
    depth: u32,
    /// Maximum precision of the orbit, in bits
    #[arg(long, value_name = "BITS", default_value_t = MAX_BITS, value_parser = bits())]
    max_bits: u32,
    /// Output format; json is schema impact-pair/description/1 [default: by the extension of --output, else text]
    #[arg(long, value_enum)]
    format: Option<DescribeFormat>,
    #[command(flatten)]
    drawing: Drawing,
}

/// Output formats of a description.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum DescribeFormat {
    /// Human-readable: one line for each question
    #[default]
    Text,
    /// One document of the schema named above
    Json,
}

pub fn describe(arguments: &DescribeArguments) -> Result<Answer> {
    let format = arguments.drawing.format(arguments.format)?;
    let OpenOutput { scene, files, path } = arguments.drawing.begin(&arguments.scene)?;
    let named = || scene::name(path);
    let DescribeArguments { impacts, max_bits, .. } = *arguments;
    let request = Request { impacts, depth: arguments.depth as usize, max_bits };
    let progress = Progress::stages(!files.quiet);
    let found = described(&scene, &request, &progress).with_context(named)?;
    progress.clear();
    let document = found.document(&scene, &path.display().to_string()).with_context(named)?;
    let text = match format {
        DescribeFormat::Json => serde_json::to_string(&document)? + "\n",
        DescribeFormat::Text => text(&scene, &document)?,
    };
    let open = (!document.certified || document.interrupted).then(|| conclusion(&document));
    let is_table = format == DescribeFormat::Text;
    files.draw((&text, open, is_table), || {
        Some(impact_pair_plot::describe::describe(&scene, &found, &document, &arguments.drawing.look))
    })
}

/// The description for people.
fn text(scene: &Scene, document: &DescriptionDocument) -> Result<String, fmt::Error> {
    let mut out = heading(scene);
    writeln!(out)?;
    let mut last = "";
    for (label, text) in lines(document) {
        writeln!(out, "{:12}  {text}", if label == last { "" } else { label })?;
        last = label;
    }
    if document.interrupted {
        writeln!(out, "interrupted")?;
    }
    Ok(out)
}

/// Returns the note on stderr about an incomplete output.
fn conclusion(document: &DescriptionDocument) -> String {
    let stopped = if document.interrupted { "interrupted; " } else { "" };
    let said = if document.certified { "certified: " } else { "" };
    format!("{stopped}{said}{}", document.fate.message)
}
