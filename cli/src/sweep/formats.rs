//! The formats of a sweep's files: the requested ones, or those of their endings.

use std::path::Path;

use anyhow::{Result, bail};
use clap::ValueEnum;

use super::arguments::{SweepArguments, SweepFormat};
use crate::ending;

/// The formats of the output and of the states.
#[derive(Clone, Copy)]
pub struct Formats {
    pub output: SweepFormat,
    pub states: SweepFormat,
}

impl Formats {
    /// The requested ones, those of the endings, or the default ones.
    ///
    /// # Errors
    /// Returns an error if an ending belongs to no format or contradicts the given one, or if this build does not write the format.
    pub fn of(arguments: &SweepArguments) -> Result<Self> {
        let is_shard = arguments.grid.shard.is_some();
        let usual = if is_shard { SweepFormat::Jsonl } else { SweepFormat::Csv };
        let file = arguments.destination.output.as_deref();
        let output = ending::format(arguments.format, ("--output", file), SweepFormat::value_variants(), usual)?;
        if is_shard && output != SweepFormat::Jsonl {
            let option_text = option_text("--output", file.filter(|_| arguments.format.is_none()));
            bail!("{option_text} is not jsonl, but shards are written as jsonl, to be merged by --merge");
        }
        keep_parquet(output, option_text("--output", file.filter(|_| arguments.format.is_none())))?;
        let tables = [SweepFormat::Csv, SweepFormat::Parquet];
        let usual = if output == SweepFormat::Parquet { output } else { SweepFormat::Csv };
        let file = arguments.states.as_deref();
        let states = ending::format(None, ("--states", file), &tables, usual)?;
        keep_parquet(states, option_text("--states", file))?;
        Ok(Self { output, states })
    }

    /// Refuses to write states where there are none, or no table of them.
    ///
    /// # Errors
    /// Returns an error if the sweep is a shard, a summary, or written as JSON Lines, whose lines hold the states.
    pub fn keep_states(self, arguments: &SweepArguments, is_summary: bool) -> Result<()> {
        if arguments.states.is_none() {
            return Ok(());
        }
        if arguments.grid.shard.is_some() {
            bail!("--states writes a table, but a shard is written as jsonl: ask --merge for the states");
        }
        if self.output == SweepFormat::Jsonl {
            bail!("--states writes a table, but a line of jsonl holds a point with its states: use csv or parquet");
        }
        if is_summary {
            bail!("--states writes the impacts, but a sweep with --summary has none");
        }
        Ok(())
    }
}

/// Returns the option that requests a format: the option of a file, with the file's name, or `--format`.
fn option_text(option: &str, file: Option<&Path>) -> String {
    file.map_or("--format".to_owned(), |file| format!("{option} {}", file.display()))
}

/// Refuses Parquet in a build that has none.
fn keep_parquet(format: SweepFormat, option_text: String) -> Result<()> {
    if format == SweepFormat::Parquet && cfg!(not(feature = "parquet")) {
        bail!(
            "{option_text} is parquet, but this build lacks Parquet: use csv or jsonl, or build with --features parquet"
        );
    }
    Ok(())
}
