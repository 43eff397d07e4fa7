//! Command-line arguments of `audit`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use impact_pair::audit::{AuditSettings, Column, Columns};
use impact_pair::exact::Exact;
use impact_pair::orbit::MAX_BITS;

use crate::destination::Destination;

pub const EXIT_CODES: &str = "\
Exit code: 0 all agree; 1 something disagrees or is undecided; 2 usage, bad input, I/O";

pub const HELP: &str = "\
Examples:
  impact-pair audit scenes/figure-14.toml events.csv
  impact-pair audit scenes/figure-14.toml sol.txt --wall-column 3 --no-velocity --tolerance 1e-6
  impact-pair run scenes/figure-14.toml --arithmetic float --format json |
    impact-pair audit scenes/figure-14.toml - --format json --output audit.json

The list: text with commas, semicolons, tabs or blanks between columns, with a header, with a header in a comment (# \
or %) that has a word for each column, or without one: then time, wall and velocity are columns 1, 2 and 3. Or JSON: an array of objects, an object \
of arrays, JSON Lines, or the orbit JSON. Walls are left and right, L and R, -1 and +1, or positions near -d/2 and \
+d/2. Velocities are y' just before the impact, with their sign. Numbers are read exactly. Columns that are not read \
are named in the last line and in the JSON (unused_columns). The certified orbit goes as far as the list; [run] \
is not used.

Verdicts on a row, or on a certified impact without a row:
  inside          certified; time and velocity are within the tolerance of the bounds
  outside         certified; time or velocity is proved to be farther away than that
  missed          certified before the end of the list, but not listed
  false           proved not to happen
  in the chatter  on its wall, no faster, and after the last impact of a chatter that is farther
                  than the tolerance from its end: infinitely many impacts lie there, and none of
                  them has to be listed
  undecided       after the last impact that could be certified
  not reached     later than that; the list lacks more impacts than it has rows, and the orbit is
                  not followed further
The start and grazes may be listed or not; of a graze, wall and time are compared.

A row may be an impact if it lies on the same wall, and is nearest to it among all impacts or within the tolerance. \
The start or a graze takes no row that is nearer to an impact. \
As many rows as possible are matched, in the order of the list; of several rows for one impact the nearest in time \
is taken. The list diverges from the orbit at the first missed or false impact from which on, counted to any later \
one, fewer than half are inside, if both kinds occur after it.

Double precision is compared in the same way. Exact from rounded data: the certified orbit of the scene with each \
number rounded to the nearest double; once it is outside, any simulator that reads the scene in doubles is right \
only by chance, however accurate. --arithmetic float: impact-pair's own orbit in plain doubles; it has no \
consequence for other programs.

Exit code: 0 all agree (all rows are inside or in the chatter, none is missed); 1 something disagrees or is \
undecided; 2 usage, bad input, I/O.";

#[derive(Args, Debug)]
pub struct AuditArguments {
    /// Scene file (TOML), or - for stdin
    pub scene: PathBuf,
    /// The list to compare (CSV, TSV, other text, or JSON), or - for stdin
    pub events: PathBuf,
    /// Accepted difference of a time, in periods 2 pi/W, and of a velocity, in A W; from 0 to 1
    #[arg(long, value_name = "X", default_value = "1e-9", value_parser = tolerance, allow_hyphen_values = true)]
    tolerance: Exact,
    /// Compare up to this time: the list must contain every certified impact before T, later rows are ignored. Impacts within the tolerance
    /// of T may be missing where a later row is ignored [default: the last time listed]
    #[arg(long, value_name = "T", value_parser = impact_pair_answers::values::point, allow_hyphen_values = true)]
    until: Option<Exact>,
    /// The column of times, by its name or its number from 1 [default: time or t, or the first one]
    #[arg(long, value_name = "NAME|N")]
    time_column: Option<String>,
    /// The column of walls [default: wall or side, or the second one]
    #[arg(long, value_name = "NAME|N")]
    wall_column: Option<String>,
    /// The column of velocities [default: v_minus, v_before, velocity, v, vel and
    /// the like, or the third one of a list without a header]
    #[arg(long, value_name = "NAME|N")]
    velocity_column: Option<String>,
    /// Compare times and walls only
    #[arg(long, conflicts_with = "velocity_column")]
    no_velocity: bool,
    /// Digits of the certified orbit, relative as --tolerance [default: three more than the tolerance has]
    #[arg(long, value_name = "D", value_parser = impact_pair_answers::values::digits())]
    digits: Option<u32>,
    /// Maximum precision of the certified orbit, in bits
    #[arg(long, default_value_t = MAX_BITS, value_name = "BITS", value_parser = impact_pair_answers::values::bits())]
    max_bits: u32,
    /// Output format [default: by the extension of --output, else table]
    #[arg(long, value_enum)]
    pub format: Option<AuditFormat>,
    /// List every event in the table, not only the first ones that disagree
    #[arg(long)]
    pub all: bool,
    #[command(flatten)]
    pub destination: Destination,
}

/// Output formats of an audit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum AuditFormat {
    /// Human-readable: the first disagreements, and a summary
    #[default]
    Table,
    /// One document with every event, schema impact-pair/audit/1
    Json,
}

impl AuditArguments {
    /// Returns the columns in which the list has its times, walls and velocities.
    pub fn columns(&self) -> Columns {
        Columns {
            time: Column::time(self.time_column.clone()),
            wall: Column::wall(self.wall_column.clone()),
            velocity: (!self.no_velocity).then(|| Column::velocity(self.velocity_column.clone())),
        }
    }

    /// Returns the settings of the audit.
    pub fn audit_settings(&self) -> AuditSettings {
        let (tolerance, until) = (self.tolerance.clone(), self.until.clone());
        AuditSettings { tolerance, until, digits: self.digits, max_bits: self.max_bits }
    }
}

/// Reads a tolerance.
fn tolerance(text: &str) -> Result<Exact, String> {
    let tolerance = impact_pair_answers::values::point(text)?;
    let (low, high) = tolerance.enclose(64).to_f64_bounds();
    if low >= 0.0 && high <= 1.0 { Ok(tolerance) } else { Err("accepted is a number from 0 to 1".into()) }
}
