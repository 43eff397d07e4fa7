//! The points of a finished sweep or atlas, one after another: memory does not grow.

use std::path::PathBuf;

use anyhow::{Result, bail};
use impact_pair::sweep::Head;
use impact_pair_answers::grid::{Journal, difference, own};
use impact_pair_plot::records::Records;

/// Points that lie in one journal, or in those of shards.
pub struct Gathered<H: Head> {
    pub head: H,
    pub journals: Vec<Journal<H>>,
}

impl<H: Head> Gathered<H> {
    /// Puts shards together.
    ///
    /// # Errors
    /// Returns an error if they are not all shards of one sweep or atlas, each of them finished.
    pub fn merged(paths: &[PathBuf]) -> Result<Self> {
        let journals: Vec<Journal<H>> = paths.iter().map(|path| Journal::read(path)).collect::<Result<_>>()?;
        let name = |i: usize| paths[i].display();
        let head = journals[0].head.with_shard(None);
        let mut seen = Vec::new();
        for (i, journal) in journals.iter().enumerate() {
            let shard = journal.head.shard();
            let Some([number, of]) = shard else { bail!("{} is a whole {}, not a shard", name(i), H::NAME) };
            if journal.head.with_shard(None) != head {
                let difference = difference(&journal.head, &head.with_shard(shard));
                bail!("{} and {} are of more than one {}: {difference}", name(i), name(0), H::NAME);
            }
            let parts = journals[0].head.shard().map_or(0, |[_, of]| of);
            if of != parts {
                bail!("{} is one of {of} shards, but {} is one of {parts}", name(i), name(0));
            }
            if seen.contains(&number) {
                bail!("{} is shard {number}/{of}, which is given twice", name(i));
            }
            if let Some(point) = journal.missing().first() {
                bail!("{} lacks point {point}: the shard is not finished", name(i));
            }
            seen.push(number);
        }
        let of = journals[0].head.shard().map_or(0, |[_, of]| of);
        if let Some(number) = (1..=of).find(|number| !seen.contains(number)) {
            bail!("shard {number}/{of} is missing");
        }
        Ok(Self { head, journals })
    }

    /// Hands on the points that are there, in order.
    pub fn each(&mut self, mut hand: impl FnMut(&str) -> Result<()>) -> Result<()> {
        for point in own(&self.head) {
            if let Some(journal) = self.journals.iter_mut().find(|journal| journal.holds(point)) {
                hand(&journal.line(point)?)?;
            }
        }
        Ok(())
    }
}

impl<H: Head> Records for Gathered<H> {
    type Head = H;

    fn head(&self) -> &H {
        &self.head
    }

    fn each_record(&mut self, mut hand: impl FnMut(H::Record) -> Result<()>) -> Result<()> {
        self.each(|text| hand(serde_json::from_str(text)?))
    }
}
