//! `impact-pair trap SCENE`: a region that the motion does not leave, proved.

use std::io::{self, Write};
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use impact_pair::chaos::Trap;
use impact_pair::document;

use crate::Answer;
use crate::arguments::PeriodicFormat;
use crate::heading::heading;
use crate::output::Output;
use crate::progress::{Progress, goes_on, interruption};
use crate::scene;

pub const HELP: &str = "\
Examples:
  impact-pair trap scenes/figure-14.toml
  impact-pair trap scenes/figure-17.toml --plot region.svg --format json --output region.json

The region is made of boxes of the phase and of the speed before the impact, every impact mirrored to the left wall. It is \
grown from where a floating orbit ends until each flight from a box is proved to land in boxes; both ways to go on at a graze \
are in it. So a motion with one impact in it has all later ones there, never rests, has no chatter that ends, and keeps within the \
bounds for all time. Whether it attracts what begins elsewhere is not claimed. Of one harmonic.

Exit code: 0 a region is proved, and the scene's own orbit is in it from an impact on; 1 one of both is not proved; 2 usage, bad \
input, I/O.";

#[derive(Args, Debug)]
pub struct TrapArguments {
    /// Scene file (TOML), or - for stdin
    pub scene: PathBuf,
    /// Halve the boxes of the coarsest grid that closes so often: narrower bounds
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=6))]
    finer: u32,
    /// How the region is written; json is schema impact-pair/trap/1
    #[arg(long, value_enum, default_value_t)]
    format: PeriodicFormat,
    /// Write to FILE, which appears whole or not at all, instead of stdout
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Draw the region into FILE (.svg or .png)
    #[arg(long, value_name = "FILE", value_parser = impact_pair_plot::picture::path)]
    plot: Option<PathBuf>,
    /// No notes and no progress on stderr
    #[arg(long, short)]
    quiet: bool,
}

pub fn trap(arguments: &TrapArguments) -> Result<Answer> {
    let scene = scene::read(&arguments.scene)?;
    scene::keep_apart(&[&arguments.scene], arguments.output.as_deref(), arguments.plot.as_deref())?;
    interruption();
    let named = || scene::name(&arguments.scene);
    let progress = Progress::boxes(!arguments.quiet);
    let watch = |boxes: usize| {
        progress.boxed("", boxes as u64);
        goes_on()
    };
    let found = Trap::of(&scene, arguments.finer, &watch).with_context(named)?;
    progress.clear();
    let region = match found {
        Ok(region) => region,
        Err(why) => {
            writeln!(io::stdout(), "undecided: no region is proved; {}", why.words())
                .context("cannot write to stdout")?;
            return Ok(Answer::Incomplete);
        }
    };
    let document = document::trap(&scene, &region).with_context(named)?;
    let mut out = Output::open(arguments.output.as_deref())?;
    let write = "cannot write the output";
    match arguments.format {
        PeriodicFormat::Json => writeln!(out, "{}", serde_json::to_string(&document)?).context(write)?,
        PeriodicFormat::Table => {
            write!(out, "{}", heading(&scene)).context(write)?;
            let entered = match document.entered_at_impact {
                Some(0) => "the scene's start and all impacts after it are in it".to_owned(),
                Some(impact) => format!("of the scene's orbit impact {impact} and all later ones are in it"),
                None => {
                    "undecided whether the scene's orbit enters it: none of its first 100 impacts is proved to be in it"
                        .to_owned()
                }
            };
            writeln!(
                out,
                "\nregion of {} boxes, {} columns a cycle, {} rows a speed of A W\nflight [time]       {}\nspeed [length/time] {}\n\n\
                 certified: no motion with an impact in it leaves it, comes to rest, or has chatter that ends;\n{entered}",
                document.boxes,
                document.columns,
                document.rows,
                document::told(&document.flight_time),
                document::told(&document.speed_before),
            )
            .context(write)?;
        }
    }
    out.commit()?;
    if let Some(path) = &arguments.plot {
        Output::open(Some(path))?.draw(path, || impact_pair_plot::chaos::trap(&scene, &region))?;
    }
    Ok(if document.entered_at_impact.is_some() { Answer::Complete } else { Answer::Incomplete })
}
