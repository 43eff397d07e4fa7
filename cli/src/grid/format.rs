//! The formats of sweeps and atlases: the requested ones, or those of their endings.

use std::io::Write;
use std::path::Path;

use anyhow::{Result, bail};
use clap::ValueEnum;
use impact_pair_answers::grid::{Head, Points, line};

use crate::destination::Destination;
use crate::ending;
use crate::output::Output;

/// Output formats of the points of a grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum GridFormat {
    /// Rows with bounds in columns.
    Csv,
    /// JSON Lines: the head, one point per line.
    Jsonl,
    /// Apache Parquet.
    Parquet,
    /// The picture.
    Svg,
    /// The picture in pixels.
    Png,
    /// The page.
    Html,
}

/// The format of the output: the requested one, that of the ending, or the usual one.
///
/// # Errors
/// Returns an error if the ending belongs to no format or contradicts the given one, or if this build does not write the format.
pub fn format(
    given: Option<GridFormat>,
    destination: &Destination,
    is_shard: bool,
    accepted: &[(GridFormat, &str)],
) -> Result<GridFormat> {
    let usual = if is_shard { GridFormat::Jsonl } else { GridFormat::Csv };
    let accepted: Vec<GridFormat> = accepted.iter().map(|(format, _)| *format).collect();
    let file = destination.output.as_deref();
    let format = ending::format(given, ("--output", file), &accepted, usual)?;
    let option_text = option_text("--output", file.filter(|_| given.is_none()));
    if is_shard && format != GridFormat::Jsonl {
        bail!("{option_text} is not jsonl, but shards are written as jsonl, to be merged by --merge");
    }
    require_built(format, &option_text)?;
    Ok(format)
}

/// The format of the states of a sweep, which are a table beside the output.
///
/// # Errors
/// As of [`format()`].
pub fn format_of_states(file: Option<&Path>, output: GridFormat) -> Result<GridFormat> {
    let usual = if output == GridFormat::Parquet { output } else { GridFormat::Csv };
    let format = ending::format(None, ("--states", file), &[GridFormat::Csv, GridFormat::Parquet], usual)?;
    require_built(format, &option_text("--states", file))?;
    Ok(format)
}

/// Returns the option that requests a format: the option of a file, with the file's name, or `--format`.
fn option_text(option: &str, file: Option<&Path>) -> String {
    file.map_or("--format".to_owned(), |file| format!("{option} {}", file.display()))
}

/// Refuses a format that this build lacks.
fn require_built(format: GridFormat, option_text: &str) -> Result<()> {
    if format == GridFormat::Parquet && cfg!(not(feature = "parquet")) {
        bail!(
            "{option_text} is parquet, but this build lacks Parquet: use csv or jsonl, or build with --features parquet"
        );
    }
    if format == GridFormat::Png && cfg!(not(feature = "png")) {
        bail!("{option_text} is png, but this build lacks PNG: use svg, or build with --features png");
    }
    Ok(())
}

/// Writes points as a table, or as JSON Lines, of which each holds all of a point.
///
/// # Errors
/// Returns an error if a record cannot be read, or the output fails.
pub fn write<H: Head>(points: &mut Points<H>, out: &mut Output, format: GridFormat, table: H::Table) -> Result<()> {
    let head = points.head.clone();
    match format {
        GridFormat::Jsonl => {
            writeln!(out, "{}", line(&head))?;
            points.each(|text| Ok(writeln!(out, "{text}")?))
        }
        GridFormat::Csv => {
            out.write_all(head.csv_head(table).as_bytes())?;
            points.each_record(|record| Ok(out.write_all(head.csv_rows(table, &record).as_bytes())?))
        }
        #[cfg(feature = "parquet")]
        GridFormat::Parquet => super::parquet::write(points, out, table),
        _ => bail!("this format holds no table in this build"),
    }
}
