//! Command-line arguments of `atlas`.

use std::path::PathBuf;

use clap::Args;
use impact_pair_answers::AtlasOptions;
use impact_pair_plot::picture::Look;

use crate::destination::Destination;
use crate::grid::{GridArguments, GridFormat};
use crate::verb::formats;

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
#[command(mut_arg("over", |over| over.required(false).required_unless_present("merge")))]
#[command(mut_arg("merge", |merge| merge.conflicts_with_all(FIXED_BY_SHARDS)))]
pub struct AtlasArguments {
    /// Scene file (TOML), or - for stdin
    #[arg(required_unless_present = "merge")]
    pub scene: Option<PathBuf>,
    #[command(flatten)]
    pub options: AtlasOptions,
    #[command(flatten)]
    pub grid: GridArguments,
    /// Output format [default: by the extension of --output, else csv, for a shard jsonl]
    #[arg(long, value_parser = formats(FORMATS))]
    pub format: Option<GridFormat>,
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
pub const FORMATS: &[(GridFormat, &str)] = &[
    (GridFormat::Csv, "One line per point or cell"),
    (
        GridFormat::Jsonl,
        "JSON Lines, schema impact-pair/atlas/1: the head, one point or tile per line, with all components",
    ),
    (GridFormat::Parquet, "Apache Parquet: the columns of csv (a build with --features parquet)"),
    (GridFormat::Svg, "The picture"),
    (GridFormat::Png, "The picture in pixels (a build with --features png)"),
    (GridFormat::Html, "The page, one file"),
];

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
