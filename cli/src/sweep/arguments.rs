//! Command-line arguments of `sweep`.

use std::path::PathBuf;

use clap::Args;
use impact_pair_answers::SweepOptions;
use impact_pair_plot::picture::Look;
use impact_pair_plot::sweep::Show;

use crate::destination::Destination;
use crate::grid::{GridArguments, GridFormat};
use crate::verb::formats;

pub const EXIT_CODES: &str = "\
Exit code: 0 everything requested is certified at every point; 1 at some points it is not, or the sweep was \
interrupted; 2 usage, bad input, I/O";

pub const HELP: &str = "\
Examples:
  impact-pair sweep scenes/figure-14.toml --over amplitude=1..10:40 --plot diagram.svg
  impact-pair sweep scenes/cascade.toml --over start.time=0..2:9 --over start.velocity=-6..0:9
  impact-pair sweep scenes/figure-14.toml --over amplitude=1..10:40 --shard 1/3 --output one.jsonl

Shards become one by sweep --merge one.jsonl two.jsonl three.jsonl --output diagram.csv

KEY is amplitude (A), frequency (W), phase (tau), gap (d), restitution (e), A/d (the amplitude in gaps), start.time, \
start.phase (W t + tau), start.position or start.velocity. With several terms, amplitude.K, frequency.K or phase.K is \
that of term K of the scene's lists, counted from 1. Phases and forcing periods refer to the same term at all points, the head's reference: the fastest \
of those that move the box where all varied keys are greatest. Points are exact and evenly spaced, endpoints \
included; of two axes the second one varies faster.

Outcome of a point: attracted, proved to converge to a stable periodic orbit; periodic, proved to repeat exactly \
from a release on; rests-forever; never-impacts; undecided-limit, all impacts are certified but the future \
is undecided (it may be chaotic or slow); undecided, with the reason and everything certified before. Exponent: \
the logarithm of the spectral norm of the derivative over the impacts after the transient, in forcing periods and \
gap widths per period, per impact and per forcing period; -inf after sticking. It is a finite-time exponent, and may be \
positive for an orbit that is attracted; exponent_limit, of points that are attracted, is its limit: the logarithm \
of the spectral radius of the period's Jacobian, per impact, only an upper bound where e may be 0.

With --output FILE all finished points are kept in FILE.partial until FILE is written; after Ctrl-C or a crash \
--resume continues from there. The output has the same bytes for any number of threads, interrupted or not, in \
shards or not.

Exit code: 0 everything requested is certified at every point; 1 at some points it is not, or the sweep was \
interrupted; 2 usage, bad input, I/O.";

#[derive(Args, Debug)]
#[command(mut_arg("over", |over| over.required(false).required_unless_present("merge")))]
#[command(mut_arg("merge", |merge| merge.conflicts_with_all(FIXED_BY_SHARDS)))]
pub struct SweepArguments {
    /// Scene file (TOML), or - for stdin
    #[arg(required_unless_present = "merge")]
    pub scene: Option<PathBuf>,
    #[command(flatten)]
    pub options: SweepOptions,
    /// Write the impacts into a separate table, csv or parquet by the extension of FILE; the output then has one row
    /// per point, and the column point joins the two
    #[arg(long, value_name = "FILE")]
    pub states: Option<PathBuf>,
    #[command(flatten)]
    pub grid: GridArguments,
    /// Output format [default: by the extension of --output, else csv, for a shard jsonl]
    #[arg(long, value_parser = formats(FORMATS))]
    pub format: Option<GridFormat>,
    /// Draw the bifurcation diagram, or for two keys the map of outcomes; without --output and --format no table is written then
    #[arg(long, value_name = "FILE.svg|FILE.png|FILE.pdf", value_parser = impact_pair_plot::picture::path)]
    pub plot: Option<PathBuf>,
    #[command(flatten)]
    pub look: Look,
    /// Quantity on the vertical axis of the diagram
    #[arg(long, value_enum, default_value_t, requires = "plot")]
    pub show: Show,
    /// Range of the vertical axis of the diagram
    #[arg(long, value_name = "LO..HI", value_parser = impact_pair_answers::values::window, requires = "plot", allow_hyphen_values = true)]
    pub within: Option<[f64; 2]>,
    #[command(flatten)]
    pub destination: Destination,
}

/// The options that shards have fixed already.
const FIXED_BY_SHARDS: [&str; 10] =
    ["scene", "over", "transient", "impacts", "digits", "arithmetic", "max_bits", "summary", "shard", "resume"];

/// Output formats of the points of a sweep.
pub const FORMATS: &[(GridFormat, &str)] = &[
    (GridFormat::Csv, "One line per impact and one per point, bounds in columns"),
    (GridFormat::Jsonl, "JSON Lines, schema impact-pair/sweep/1: the head, one point per line"),
    (
        GridFormat::Parquet,
        "Apache Parquet: the columns of csv, bounds as doubles rounded outward (a build with --features parquet)",
    ),
];
