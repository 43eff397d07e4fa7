//! `impact-pair trap SCENE`: a trapping region, proved.

use std::fmt::{self, Write};
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use impact_pair::Scene;
use impact_pair::chaos::Trap;
use impact_pair::document;
use impact_pair::json::TrapDocument;
use impact_pair_plot::picture::Theme;

use crate::Answer;
use crate::destination::{Begun, Destination};
use crate::heading::heading;
use crate::output::note;
use crate::periodic::PeriodicFormat;
use crate::progress::Progress;
use crate::scene;

pub const HELP: &str = "\
Examples:
  impact-pair trap scenes/figure-14.toml
  impact-pair trap scenes/figure-17.toml --plot region.svg --format json --output region.json

The trapping region (forward invariant) is a set of boxes in phase and speed before the impact, with every impact \
mirrored to the left wall. It grows from the end of a floating-point orbit until each flight from a box is proved to \
land in boxes; at a graze both continuations are included. A motion with one impact in the region has all later \
impacts there, never sticks, has no complete chatter, and keeps within the bounds for all time. Whether the region \
attracts motions from outside is not claimed. One harmonic only.

Exit code: 0 a region is proved, and the scene's own orbit is in it from some impact on; 1 either is undecided; 2 \
usage, bad input, I/O.";

#[derive(Args, Debug)]
pub struct TrapArguments {
    /// Scene file (TOML), or - for stdin
    pub scene: PathBuf,
    /// Bisect the boxes of the coarsest forward-invariant grid N times, for narrower bounds
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=6))]
    finer: u32,
    /// Output format; json is schema impact-pair/trap/1
    /// [default: as the ending of --output says, else table]
    #[arg(long, value_enum)]
    format: Option<PeriodicFormat>,
    /// Draw the region, and a floating-point orbit in it
    #[arg(long, value_name = "FILE.svg|FILE.png|FILE.pdf", value_parser = impact_pair_plot::picture::path)]
    plot: Option<PathBuf>,
    /// Colours of the picture
    #[arg(long, value_enum, default_value_t, value_name = "light|dark", requires = "plot")]
    theme: Theme,
    #[command(flatten)]
    pub destination: Destination,
}

pub fn trap(arguments: &TrapArguments) -> Result<Answer> {
    let format = arguments.destination.format(arguments.format)?;
    let plot = arguments.plot.as_deref().map(|path| (path, arguments.theme));
    let Begun { scene, files, path } = arguments.destination.begin(&arguments.scene, plot)?;
    let named = || scene::name(path);
    let progress = Progress::stages(!files.quiet);
    let found = Trap::of(&scene, arguments.finer, &progress).with_context(named)?;
    progress.clear();
    let is_table = format == PeriodicFormat::Table;
    let region = match found {
        Ok(region) => region,
        Err(why) => {
            let why = format!("undecided: no region is proved; {}", why.words());
            if is_table {
                return files.answer(&format!("{why}\n"), Some(why), is_table);
            }
            note(files.quiet, &why);
            return Ok(Answer::Incomplete);
        }
    };
    let document = document::trap(&scene, &region).with_context(named)?;
    let text = match format {
        PeriodicFormat::Json => serde_json::to_string(&document)? + "\n",
        PeriodicFormat::Table => table(&scene, &document)?,
    };
    let open = document.entered_at_impact.is_none().then(|| entered(&document));
    files.draw((&text, open, is_table), || impact_pair_plot::chaos::trap(&scene, &region))
}

fn table(scene: &Scene, document: &TrapDocument) -> Result<String, fmt::Error> {
    let mut out = heading(scene);
    writeln!(
        out,
        "\nregion of {} boxes, {} columns per forcing period, {} rows per speed A W\nflight [time]       {}\nspeed [length/time] {}\n\n\
         certified: a trapping region, without sticking and without complete chatter;\n{}",
        document.boxes,
        document.columns,
        document.rows,
        document::bounds_text(&document.flight_time),
        document::bounds_text(&document.speed_before),
        entered(document),
    )?;
    Ok(out)
}

/// Whether the scene's own orbit is in the region.
fn entered(document: &TrapDocument) -> String {
    match document.entered_at_impact {
        Some(0) => "the scene's start and all impacts after it are in it".to_owned(),
        Some(impact) => format!("the scene's orbit is in it from impact {impact} on"),
        None => "undecided whether the scene's orbit enters it: none of its first 100 impacts is proved to lie in it"
            .to_owned(),
    }
}
