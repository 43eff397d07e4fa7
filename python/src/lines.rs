//! Lines of a sweep or an atlas, read.

use anyhow::Result;
use impact_pair::sweep::Head;
use impact_pair_plot::records::Records;
use serde::de::DeserializeOwned;

use crate::errors::Fault;

/// The records of lines.
pub fn records<R: DeserializeOwned>(lines: &[u8]) -> impl Iterator<Item = Result<R, Fault>> + '_ {
    let lines = lines.split(|byte| *byte == b'\n').filter(|line| !line.is_empty());
    lines.map(|line| serde_json::from_slice(line).map_err(Fault::certificate))
}

/// The lines as what their picture is drawn from.
pub struct Lines<'l, H> {
    pub head: &'l H,
    pub lines: &'l [u8],
}

impl<H: Head> Records for Lines<'_, H> {
    type Head = H;

    fn head(&self) -> &H {
        self.head
    }

    fn each_record(&mut self, mut hand: impl FnMut(H::Record) -> Result<()>) -> Result<()> {
        let read = |record: Result<H::Record, Fault>| record.map_err(|_| anyhow::anyhow!("a line is no record"));
        records(self.lines).try_for_each(|record| hand(read(record)?))
    }
}
