//! `impact-pair run SCENE`: the certified impacts of a scene.

use std::io::{self, IsTerminal, Write};
use std::ops::ControlFlow;
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use impact_pair::orbit::{Conclusion, Ending, Event, Orbit};
use impact_pair_answers::{Format, Listing, RunOptions};

use crate::Answer;
use crate::destination::{Destination, Files, OpenOutput};
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
    let mut orbit = Orbit::of(&scene, settings.clone()).map_err(|error| scene::of_orbit(error, &settings, path))?;
    let visible = !quiet && io::stderr().is_terminal() && !out.is_terminal();
    let said_already = format == Format::Table && out.is_stdout();
    let progress = Progress::new(settings.impacts, visible);
    let mut listing = Listing::new(format, &scene, &settings, out);
    let write = "cannot write the output";
    listing.begin(&orbit).context(write)?;
    let mut last = None;
    let written = orbit.follow(&progress, |orbit, step| {
        let Some(event) = Event::of(orbit, &step) else { return ControlFlow::Continue(()) };
        if let Err(error) = listing.event(&event) {
            return ControlFlow::Break(error);
        }
        last = Some(event);
        ControlFlow::Continue(())
    });
    if let ControlFlow::Break(error) = written {
        return Err(error).context(write);
    }
    progress.clear();
    let conclusion = Conclusion::of(&orbit, last.as_ref());
    let ending = Ending::of(&orbit, conclusion, &settings);
    listing.end(&ending).context(write)?.commit()?;

    if !ending.is_complete() && !quiet && !said_already {
        // Nobody may be listening.
        let _ = writeln!(io::stderr(), "{ending}");
    }
    Ok(if ending.is_complete() { Answer::Complete } else { Answer::Incomplete })
}
