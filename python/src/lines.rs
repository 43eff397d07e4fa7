//! Lines of a sweep, read.

use anyhow::Result;
use impact_pair::json::{SweepHead, SweepRecord};
use impact_pair_plot::sweep::Records;

use crate::errors::Fault;

/// The records of lines.
pub fn records(lines: &[u8]) -> impl Iterator<Item = Result<SweepRecord, Fault>> + '_ {
    let lines = lines.split(|byte| *byte == b'\n').filter(|line| !line.is_empty());
    lines.map(|line| serde_json::from_slice(line).map_err(Fault::certificate))
}

/// The lines of a sweep as what its picture is drawn from.
pub struct Lines<'l> {
    pub head: &'l SweepHead,
    pub lines: &'l [u8],
}

impl Records for Lines<'_> {
    fn head(&self) -> &SweepHead {
        self.head
    }

    fn each_record(&mut self, mut hand: impl FnMut(SweepRecord) -> Result<()>) -> Result<()> {
        let read = |record: Result<SweepRecord, Fault>| record.map_err(|_| anyhow::anyhow!("a line is no record"));
        records(self.lines).try_for_each(|record| hand(read(record)?))
    }
}
