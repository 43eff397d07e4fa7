//! Numbers of points or cells of each class, and the part of the plane that is decided.

use std::fmt;

use anyhow::Result;
use impact_pair::atlas::Shares;
use impact_pair::chaos::Class;
use impact_pair::json::AtlasHead;
use impact_pair::sweep::Head;
use impact_pair_plot::records::Records;

use crate::grid::{Gathered, Tally};

/// The classes in the order in which they are shown.
const CLASSES: [Class; 5] =
    [Class::OneRestCycle, Class::OneAttractor, Class::Attractors, Class::Closed, Class::Undecided];

/// Counts of an atlas, printed as one line: points or cells of each class, and the share that is decided.
pub struct Classes {
    counts: [u64; 5],
    /// Numbers of the points, or of the smallest cells, of which each property is proved.
    shares: Shares,
    cells: bool,
    /// True if every record of the plane is present; false for a shard, and after Ctrl-C.
    is_whole: bool,
}

impl Classes {
    /// Counts the records that are there.
    pub fn of(points: &mut Gathered<AtlasHead>) -> Result<Self> {
        let plane = points.head.grid()?;
        let mut tally = Self { counts: [0; 5], shares: Shares::default(), cells: plane.has_cells(), is_whole: true };
        let mut records = 0;
        points.each_record(|record| {
            records += 1;
            for leaf in record.leaves() {
                if let Some(class) = CLASSES.iter().position(|class| *class == leaf.class) {
                    tally.counts[class] += 1;
                }
            }
            tally.shares = tally.shares.with(Shares::of(&plane, &record));
            Ok(())
        })?;
        tally.is_whole = records == points.head.points();
        Ok(tally)
    }
}

impl Tally for Classes {
    fn is_complete(&self) -> bool {
        self.shares.decided == self.shares.all
    }
}

impl fmt::Display for Classes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Shares { all: of, decided, stable, horseshoe, either } = self.shares;
        // Of whole numbers, rounded down.
        let percent = |part: u64| {
            let share = part * 10_000 / of.max(1);
            format!("{}.{:02} %", share / 100, share % 100)
        };
        let word = if self.is_complete() { "certified" } else { "not all decided" };
        let [one, many] = if self.cells { ["cell", "cells"] } else { ["point", "points"] };
        let all: u64 = self.counts.iter().sum();
        write!(f, "{word}: {all} {}", if all == 1 { one } else { many })?;
        for (class, count) in CLASSES.iter().zip(self.counts).filter(|(_, count)| *count > 0) {
            write!(f, ", {count} {class}")?;
        }
        let plane = match (self.cells, self.is_whole) {
            (true, true) => "of the plane",
            (true, false) => "of this part of the plane",
            (false, true) => "of the points",
            (false, false) => "of these points",
        };
        write!(f, "; {} {plane} decided", percent(decided))?;
        if either > 0 {
            let [either, stable, horseshoe] = [either, stable, horseshoe].map(percent);
            write!(f, "; of the rest {either} with a stable periodic orbit ({stable}) or a horseshoe ({horseshoe})")?;
        }
        Ok(())
    }
}
