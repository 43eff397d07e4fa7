//! A finished sweep in its formats, point by point: memory does not grow.

use std::io::Write;

use anyhow::Result;
use impact_pair::certificate::document::{SweepHead, SweepRecord};
use impact_pair_plot::sweep::Records;

use super::arguments::SweepFormat;
use super::columns::{Cell, Kind, columns, rows};
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

    pub fn write(&mut self, out: &mut Output, format: SweepFormat) -> Result<()> {
        match format {
            SweepFormat::Jsonl => {
                writeln!(out, "{}", line(&self.head))?;
                self.each(|text, _| Ok(writeln!(out, "{text}")?))
            }
            SweepFormat::Csv => self.csv(out),
            #[cfg(feature = "parquet")]
            SweepFormat::Parquet => super::parquet::write(self, out),
            #[cfg(not(feature = "parquet"))]
            SweepFormat::Parquet => anyhow::bail!(super::NO_PARQUET),
        }
    }

    fn csv(&mut self, out: &mut Output) -> Result<()> {
        let names = columns(&self.head).into_iter().map(|(name, kind)| match kind {
            Kind::Bounds => format!("{name}_lower,{name}_upper"),
            Kind::Whole | Kind::Text | Kind::Truth | Kind::Exact => name,
        });
        writeln!(out, "{}", names.collect::<Vec<_>>().join(","))?;
        let kinds: Vec<Kind> = columns(&self.head).into_iter().map(|(_, kind)| kind).collect();
        let has_claims = self.head.claim.is_some();
        self.each_record(|record| {
            for row in rows(&record, has_claims) {
                let cells = row.iter().zip(&kinds).map(|(cell, kind)| match cell {
                    Cell::Nothing if *kind == Kind::Bounds => ",".to_owned(),
                    Cell::Nothing => String::new(),
                    Cell::Whole(number) => number.to_string(),
                    Cell::Text(text) | Cell::Exact(text) => (*text).to_owned(),
                    Cell::Truth(truth) => truth.to_string(),
                    Cell::Bounds([low, high]) => format!("{low},{high}"),
                });
                writeln!(out, "{}", cells.collect::<Vec<_>>().join(","))?;
            }
            Ok(())
        })
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
