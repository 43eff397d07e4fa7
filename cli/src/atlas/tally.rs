//! How many points or cells have which class, and the part of the plane that is decided.

use std::fmt;

use anyhow::Result;
use impact_pair::atlas;
use impact_pair::json::AtlasHead;
use impact_pair::sweep::Head;
use impact_pair_plot::records::Records;

use crate::grid::Gathered;

/// The classes in the order in which they are shown.
const CLASSES: [&str; 5] = ["one-rest-cycle", "one-attractor", "attractors", "closed", "undecided"];

/// What an atlas says in a line.
pub struct Tally {
    counts: [u64; 5],
    /// Decided points or smallest cells, and all of them that are there.
    decided: [u64; 2],
    cells: bool,
}

impl Tally {
    /// Counts the records that are there.
    pub fn of(points: &mut Gathered<AtlasHead>) -> Result<Self> {
        let plane = points.head.grid()?;
        let mut tally = Self { counts: [0; 5], decided: [0; 2], cells: plane.has_cells() };
        points.each_record(|record| {
            for leaf in record.leaves() {
                if let Some(class) = CLASSES.iter().position(|class| *class == leaf.class) {
                    tally.counts[class] += 1;
                }
            }
            let [decided, of] = atlas::decided(&plane, &record);
            tally.decided = [tally.decided[0] + decided, tally.decided[1] + of];
            Ok(())
        })?;
        Ok(tally)
    }

    /// Whether all is decided.
    pub fn is_complete(&self) -> bool {
        self.decided[0] == self.decided[1]
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [decided, of] = self.decided;
        // Of whole numbers, rounded down.
        let share = decided * 10_000 / of.max(1);
        let (whole, places) = (share / 100, share % 100);
        let word = if self.is_complete() { "certified" } else { "not all decided" };
        let what = if self.cells { "cells" } else { "points" };
        let all: u64 = self.counts.iter().sum();
        write!(f, "{word}: {all} {what}")?;
        for (class, count) in CLASSES.iter().zip(self.counts).filter(|(_, count)| *count > 0) {
            write!(f, ", {count} {class}")?;
        }
        let plane = if self.cells { "of the plane" } else { "of the points" };
        write!(f, "; {whole}.{places:02} % {plane} decided")
    }
}
