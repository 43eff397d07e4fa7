//! A finished sweep in its formats, point by point: memory does not grow.

use std::io::Write;

use anyhow::Result;
use impact_pair::json::{SweepHead, SweepRecord};
use impact_pair::sweep::{Table, csv_head, csv_rows};
use impact_pair_plot::sweep::Records;

use super::arguments::SweepFormat;
use super::journal::Journal;
use super::record::{line, own, read_record};
use crate::output::Output;

/// A sweep whose points lie in one journal, or in those of its shards.
pub struct Sweep {
    pub head: SweepHead,
    pub journals: Vec<Journal>,
}

impl Sweep {
    /// Hands on the points that are there, in order.
    pub fn each(&mut self, mut hand: impl FnMut(&str, u64) -> Result<()>) -> Result<()> {
        for point in own(&self.head) {
            if let Some(journal) = self.journals.iter_mut().find(|journal| journal.holds(point)) {
                hand(&journal.line(point)?, point)?;
            }
        }
        Ok(())
    }

    /// Writes a table, or as JSON Lines, of which each holds a point with its states, all of it.
    pub fn write(&mut self, out: &mut Output, format: SweepFormat, table: Table) -> Result<()> {
        match format {
            SweepFormat::Jsonl => {
                writeln!(out, "{}", line(&self.head))?;
                self.each(|text, _| Ok(writeln!(out, "{text}")?))
            }
            SweepFormat::Csv => self.csv(out, table),
            #[cfg(feature = "parquet")]
            SweepFormat::Parquet => super::parquet::write(self, out, table),
            #[cfg(not(feature = "parquet"))]
            SweepFormat::Parquet => anyhow::bail!("this build has no Parquet"),
        }
    }

    fn csv(&mut self, out: &mut Output, table: Table) -> Result<()> {
        out.write_all(csv_head(&self.head, table).as_bytes())?;
        let head = self.head.clone();
        self.each_record(|record| Ok(out.write_all(csv_rows(&head, table, &record).as_bytes())?))
    }
}

impl Records for Sweep {
    fn head(&self) -> &SweepHead {
        &self.head
    }

    fn each_record(&mut self, mut hand: impl FnMut(SweepRecord) -> Result<()>) -> Result<()> {
        self.each(|text, _| hand(read_record(text)?))
    }
}
