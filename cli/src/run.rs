//! `impact-pair run SCENE`: the certified impacts of a scene.

use std::io::{self, IsTerminal};
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use impact_pair::orbit::Orbit;
use impact_pair_answers::{Format, Listing, RunOptions, Verb};

use crate::Answer;
use crate::destination::{Destination, Files, OpenOutput};
use crate::output::note;
use crate::progress::Progress;
use crate::verb::formats;
use crate::{ending, scene};

pub const HELP: &str = "\
Examples:
  impact-pair run scenes/figure-14.toml
  impact-pair run scenes/figure-14.toml --until 20*pi --digits 40 --format csv --output impacts.csv
  impact-pair run scenes/chatter.toml --arithmetic interval --format jsonl

Scene: a TOML file with [excitation] amplitude, frequency, phase; [pair] gap, restitution; [start] time, velocity \
and wall or position; optionally title and [run] impacts, until, digits. Numbers are exact decimals; strings are \
expressions such as \"3*pi\" or intervals such as \"[9.42, 9.43]\".

After the last impact run tries to prove that the motion converges to a stable periodic orbit: one with at most 128 impacts, near the \
last impacts listed, whose attraction is proved in double precision. Where the last line does not mention it, that is undecided: the \
motion may converge to a longer orbit, later, or more slowly than doubles resolve (chaos --over finds more).

Table: 1.0000305639(24,68) means that the true value lies in [1.000030563924, 1.000030563968]. The digits before the \
parenthesis are certain; the parenthesis holds the remaining digits of the lower and the upper bound, rounded \
outward. Where no digits are certain, 2.00000(-1,+3) means [1.99999, 2.00003]. Runs with --arithmetic float are not \
rigorous and print plain decimals.

Exit code: 0 everything requested is certified (a completed float run is non-rigorous and exits 0 too); 1 \
some of it is not: the orbit is undecided from some impact on, was interrupted, or is wider than --digits (the \
output still has the certified part); 2 usage, bad input, I/O.";

#[derive(Args, Debug)]
pub struct RunArguments {
    /// Scene file (TOML), or - for stdin
    scene: PathBuf,
    #[command(flatten)]
    options: RunOptions,
    /// Output format [default: by the extension of --output, else table]
    #[arg(long, value_parser = formats(RunOptions::FORMATS))]
    format: Option<Format>,
    #[command(flatten)]
    destination: Destination,
}

pub fn run(arguments: &RunArguments) -> Result<Answer> {
    let accepted: Vec<Format> = RunOptions::FORMATS.iter().map(|(format, _)| *format).collect();
    let output = ("--output", arguments.destination.output.as_deref());
    let format = ending::format(arguments.format, output, &accepted, Format::Table)?;
    let OpenOutput { scene, files: Files { out, quiet, .. }, path } =
        arguments.destination.begin(&arguments.scene, None)?;
    let settings = arguments.options.settings(&scene);
    let orbit = Orbit::of(&scene, settings.clone()).map_err(|error| scene::of_orbit(error, &settings, path))?;
    let is_visible = !quiet && io::stderr().is_terminal() && !out.is_terminal();
    let is_said = format == Format::Table && out.is_stdout();
    let progress = Progress::new(settings.impacts, is_visible);
    let written = Listing::new(format, &scene, &settings, out).follow(orbit, &progress);
    progress.clear();
    let (out, status) = written.context("cannot write the output")?;
    out.commit()?;
    if status.is_complete() {
        return Ok(Answer::Complete);
    }
    note(quiet || is_said, &status.to_string());
    Ok(Answer::Incomplete)
}
