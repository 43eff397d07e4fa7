//! Command-line arguments of `atlas`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use impact_pair::Effort;
use impact_pair::chaos::{GlobalSettings, MOST_DEPTH};
use impact_pair::scene::Over;
use impact_pair::sweep::axis;
use impact_pair_plot::picture::Look;

use crate::destination::Destination;
use crate::grid::GridArguments;
use impact_pair_answers::values::{digits, whole};

pub const EXIT_CODES: &str = "\
Exit code: 0 at every point, or for every cell, every motion is proved to end in one cycle with rests, or to tend to one \
attractor; 1 at some points it is not, or the atlas was interrupted; 2 usage, bad input, I/O";

pub const HELP: &str = "\
Examples:
  impact-pair atlas scenes/figure-14.toml --over gap=2..4:3 --over restitution=0..0.1:2
  impact-pair atlas scenes/figure-14.toml --over gap=2..4:3 --over restitution=0..0.1:2 --cells
  impact-pair atlas scenes/figure-14.toml --over gap=2..3:2 --over restitution=0..0.1:2 -o a.html

Shards become one by atlas --merge one.jsonl two.jsonl three.jsonl --output atlas.csv

Each point has a global analysis of its own, as global proves it; the start of the scene is not used. KEY is amplitude, \
frequency, phase, gap, restitution, or A/d, the amplitude in gaps; only A/d and e matter. Points are exact and evenly spaced, endpoints included; the \
second axis varies faster. With --cells the rectangle is cut into at most 8 x 8 tiles, and a cell into quarters while its \
class is not decided for all its parameters, down to COUNT cells along each axis; of a smallest cell that is not decided \
stable periodic orbits are proved, by sets that move with the parameters.

Classes, of every motion that touches a wall: one-rest-cycle, it ends in one cycle with rests; one-attractor, it tends to \
one attractor, or stays at saddles or grazes; closed, it is in the end in closed components of which nothing else is \
decided, or stays at saddles or grazes; attractors, those listed are proved, others are not excluded; undecided.

With --output FILE all finished points are kept in FILE.partial until FILE is written; after Ctrl-C or a crash \
--resume continues from there. Apart from seconds, the output is the same for any number of threads, interrupted or not, \
in shards or not.

Exit code: 0 at every point, or for every cell, every motion is proved to end in one cycle with rests, or to tend to one \
attractor; 1 at some points it is not, or the atlas was interrupted; 2 usage, bad input, I/O.";

#[derive(Args, Debug)]
#[command(mut_arg("merge", |merge| merge.conflicts_with_all(FIXED_BY_SHARDS)))]
pub struct AtlasArguments {
    /// Scene file (TOML), or - for stdin
    #[arg(required_unless_present = "merge")]
    pub scene: Option<PathBuf>,
    /// The two parameters
    #[arg(long, value_name = "KEY=LO..HI:COUNT", value_parser = axis, required_unless_present = "merge", allow_hyphen_values = true)]
    pub over: Vec<Over>,
    /// Prove each answer for all parameters of a cell
    #[arg(long)]
    pub cells: bool,
    /// Multiply the work for each point or cell by X: at 1 about 300,000 boxes are mapped for a point, 20,000 for a cell
    #[arg(long, value_name = "X", default_value_t)]
    pub effort: Effort,
    /// Look for horseshoes in undecided components of a point, and of a smallest cell, by words of at most K impacts: some seconds each
    #[arg(long, value_name = "K", value_parser = whole(1..=MOST_DEPTH))]
    pub horseshoes: Option<u32>,
    /// Requested width of periodic orbits, at most 10^-D: of phases relative to 2 pi, of velocities relative to A W
    #[arg(long, value_name = "D", default_value_t = 9, value_parser = digits())]
    pub digits: u32,
    #[command(flatten)]
    pub grid: GridArguments,
    /// Output format [default: by the extension of --output, else csv, for a shard jsonl]
    #[arg(long, value_enum)]
    pub format: Option<AtlasFormat>,
    /// Draw the plane in the colours of the classes, or write the page
    #[arg(long, value_name = "FILE.svg|FILE.png|FILE.pdf|FILE.html", value_parser = drawing)]
    pub plot: Option<PathBuf>,
    #[command(flatten)]
    pub look: Look,
    #[command(flatten)]
    pub destination: Destination,
}

/// The options that shards have fixed already.
const FIXED_BY_SHARDS: [&str; 8] = ["scene", "over", "cells", "effort", "horseshoes", "digits", "shard", "resume"];

/// Output formats of an atlas.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum AtlasFormat {
    /// One line per point or cell
    Csv,
    /// JSON Lines, schema impact-pair/atlas/1: the head, one point or tile per line, with all components
    Jsonl,
    /// Apache Parquet: the columns of csv (a build with --features parquet)
    Parquet,
    /// The picture
    Svg,
    /// The picture in pixels (a build with --features png)
    Png,
    /// The page, one file
    Html,
}

impl AtlasArguments {
    /// Returns the settings of the analysis of each point or cell: the usual ones, times the effort.
    pub fn settings(&self) -> GlobalSettings {
        let usual = if self.cells { GlobalSettings::of_cell() } else { GlobalSettings::of_point() };
        let horseshoes = self.horseshoes.map(|depth| depth as usize);
        let mut settings = GlobalSettings { horseshoes, ..usual }.with_effort(self.effort);
        settings.precision.digits = self.digits;
        settings
    }
}

/// Reads the name of a picture or a page.
fn drawing(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    if is_page(&path) {
        return Ok(path);
    }
    impact_pair_plot::picture::path(text).map_err(|error| error.replacen(".svg", ".html, .svg", 1))
}

/// Returns whether a file name ends in `.html`: the ending of an atlas page.
pub fn is_page(path: &std::path::Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("html"))
}
