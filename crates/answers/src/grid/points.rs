//! The points of a finished sweep or atlas, one after another: memory does not grow.

use std::ops::Range;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};

use super::head::Head;
use super::journal::{Journal, difference};
use super::record::own;
use crate::Status;

/// The summary of a sweep or an atlas.
pub trait Tally: Head {
    /// How much is proved at the points that are there, and what.
    ///
    /// # Errors
    /// If a record cannot be read.
    fn tally(points: &mut Points<Self>) -> Result<Status>;
}

/// Finished points, which lie in one journal or in those of shards.
pub struct Points<H: Head> {
    /// All that the points depend on.
    pub head: H,
    journals: Vec<Journal<H>>,
}

impl<H: Head> Points<H> {
    /// Points in a new journal beside an output, or to `resume` in that of an earlier sweep or atlas into the same output.
    ///
    /// # Errors
    /// If there is a journal that is not to be resumed, or as of [`Points::kept`].
    pub fn open(head: H, output: Option<&Path>, resume: bool) -> Result<Self> {
        Ok(Self { journals: vec![Journal::open(head.clone(), output, resume)?], head })
    }

    /// Points in a file, a new one where there is none; without a path in one that is gone with the program.
    ///
    /// # Errors
    /// If the file cannot be written, is damaged, or belongs to another sweep or atlas.
    pub fn kept(head: H, path: Option<PathBuf>) -> Result<Self> {
        Ok(Self { journals: vec![Journal::kept(head.clone(), path)?], head })
    }

    /// The journal that points are added to: of shards the first.
    pub(super) fn journal(&mut self) -> &mut Journal<H> {
        &mut self.journals[0]
    }

    /// Number of points.
    pub fn count(&self) -> u64 {
        self.journals.iter().map(Journal::points).sum()
    }

    /// The points of the grid, or of the shard, that are not there.
    pub fn missing(&self) -> Vec<u64> {
        own(&self.head).filter(|point| !self.journals.iter().any(|journal| journal.holds(*point))).collect()
    }

    /// Adds the records of points that were computed elsewhere, a line each; from now on a crash does not lose them.
    ///
    /// # Errors
    /// If a line is no record of a point that is missing, or cannot be written.
    pub fn add_lines(&mut self, lines: &str) -> Result<()> {
        self.journal().add_lines(lines)
    }

    /// The path at which the points remain after the program ends; `None` if there is none.
    pub fn path(&self) -> Option<&Path> {
        self.journals[0].path()
    }

    /// Puts shards together.
    ///
    /// # Errors
    /// If they are not all shards of one sweep or atlas, each of them finished.
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

    /// Hands on the lines of the points that are there, in order.
    ///
    /// # Errors
    /// Those of `hand`, and if a line cannot be read.
    pub fn each(&mut self, hand: impl FnMut(&str) -> Result<()>) -> Result<()> {
        self.each_of(0..self.head.points(), hand)
    }

    /// Hands on the lines of those of some points that are there, in order.
    ///
    /// # Errors
    /// As of [`Points::each`].
    pub fn each_of(&mut self, points: Range<u64>, mut hand: impl FnMut(&str) -> Result<()>) -> Result<()> {
        for point in points {
            if let Some(journal) = self.journals.iter_mut().find(|journal| journal.holds(point)) {
                hand(&journal.line(point)?)?;
            }
        }
        Ok(())
    }

    /// Hands on the records of the points that are there, in order.
    ///
    /// # Errors
    /// Those of `hand`, and if a record cannot be read.
    pub fn each_record(&mut self, mut hand: impl FnMut(H::Record) -> Result<()>) -> Result<()> {
        self.each(|text| hand(serde_json::from_str(text)?))
    }

    /// Removes the journals: the output is there.
    ///
    /// # Errors
    /// If a file cannot be removed.
    pub fn finish(self) -> Result<()> {
        self.journals.into_iter().try_for_each(Journal::finish)
    }
}
