//! The points of a finished sweep, one after another: memory does not grow.

use anyhow::Result;
use impact_pair::json::{SweepHead, SweepRecord};
use impact_pair_plot::sweep::Records;

use super::journal::Journal;
use super::record::{own, read_record};

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
}

impl Records for Sweep {
    fn head(&self) -> &SweepHead {
        &self.head
    }

    fn each_record(&mut self, mut hand: impl FnMut(SweepRecord) -> Result<()>) -> Result<()> {
        self.each(|text, _| hand(read_record(text)?))
    }
}
