//! A finished sweep in its formats, point by point.

use std::io::Write;

use anyhow::Result;
use impact_pair::json::SweepHead;
#[cfg(feature = "parquet")]
use impact_pair::sweep::rows as sweep_rows;
use impact_pair::sweep::{Table, csv_head, csv_rows};
use impact_pair_plot::records::Records;

use super::arguments::SweepFormat;
use crate::grid::Gathered;
use crate::output::Output;
use impact_pair_answers::grid::line;

/// Writes a table, or as JSON Lines, of which each holds a point with its states, all of it.
pub fn write(sweep: &mut Gathered<SweepHead>, out: &mut Output, format: SweepFormat, table: Table) -> Result<()> {
    match format {
        SweepFormat::Jsonl => {
            writeln!(out, "{}", line(&sweep.head))?;
            sweep.each(|text| Ok(writeln!(out, "{text}")?))
        }
        SweepFormat::Csv => csv(sweep, out, table),
        #[cfg(feature = "parquet")]
        SweepFormat::Parquet => {
            let head = sweep.head.clone();
            let columns = impact_pair::sweep::columns(&head, table);
            crate::grid::parquet::write(sweep, out, &columns, |record| sweep_rows(&head, table, record).collect())
        }
        #[cfg(not(feature = "parquet"))]
        SweepFormat::Parquet => anyhow::bail!("this build has no Parquet"),
    }
}

fn csv(sweep: &mut Gathered<SweepHead>, out: &mut Output, table: Table) -> Result<()> {
    out.write_all(csv_head(&sweep.head, table).as_bytes())?;
    let head = sweep.head.clone();
    sweep.each_record(|record| Ok(out.write_all(csv_rows(&head, table, &record).as_bytes())?))
}
