//! Numbers of points or cells of each class, and the part of the plane that is decided.

use anyhow::Result;
use impact_pair::chaos::Class;
use impact_pair::json::{AtlasHead, AtlasRecord};

use super::plane::{Plane, Rectangle};
use crate::Status;
use crate::grid::{Head, Points, Tally};

/// The classes in the order in which they are shown.
const CLASSES: [Class; 5] =
    [Class::OneRestCycle, Class::OneAttractor, Class::Attractors, Class::Closed, Class::Undecided];

/// Counts of an atlas: points or cells of each class, and the share that is decided.
pub(super) struct Classes {
    counts: [u64; 5],
    /// Numbers of the points, or of the smallest cells, of which each property is proved.
    shares: Shares,
    cells: bool,
    /// True if every record of the plane is present; false for a shard, and after Ctrl-C.
    is_whole: bool,
}

impl Tally for AtlasHead {
    fn tally(points: &mut Points<Self>) -> Result<Status> {
        Classes::of(points).map(|classes| classes.status())
    }
}

impl Classes {
    /// Counts the records that are there.
    pub fn of(points: &mut Points<AtlasHead>) -> Result<Self> {
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

    /// The counts in one line.
    pub fn status(&self) -> Status {
        let Shares { all: of, decided, stable, horseshoe, either } = self.shares;
        // Of whole numbers, rounded down.
        let percent = |part: u64| {
            let share = part * 10_000 / of.max(1);
            format!("{}.{:02} %", share / 100, share % 100)
        };
        let is_complete = decided == of;
        let word = if is_complete { "certified" } else { "not all decided" };
        let [one, many] = if self.cells { ["cell", "cells"] } else { ["point", "points"] };
        let all: u64 = self.counts.iter().sum();
        let mut status = Status::new(is_complete, format!("{word}: {all} {}", if all == 1 { one } else { many }));
        for (class, count) in CLASSES.iter().zip(self.counts).filter(|(_, count)| *count > 0) {
            status = status.say(format!(", {count} {class}"));
        }
        let plane = match (self.cells, self.is_whole) {
            (true, true) => "of the plane",
            (true, false) => "of this part of the plane",
            (false, true) => "of the points",
            (false, false) => "of these points",
        };
        status = status.say(format!("; {} {plane} decided", percent(decided)));
        if either > 0 {
            let [either, stable, horseshoe] = [either, stable, horseshoe].map(percent);
            let which = format!("a stable periodic orbit ({stable}) or a horseshoe ({horseshoe})");
            status = status.say(format!("; of the rest {either} with {which}"));
        }
        status
    }
}

/// Numbers of points, or of smallest cells, of which a property is proved. Lemmas A20, A21
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Shares {
    /// Number of all points or smallest cells.
    pub all: u64,
    /// Number of those whose class is decided.
    pub decided: u64,
    /// Number of the others with a stable periodic orbit.
    pub stable: u64,
    /// Number of the others with a horseshoe.
    pub horseshoe: u64,
    /// Number of the others with either.
    pub either: u64,
}

impl Shares {
    /// Shares of a record: of a point, or of a tile and the cells that it is cut into. Lemmas A20, A21
    pub fn of(plane: &Plane, record: &AtlasRecord) -> Self {
        if !plane.has_cells() {
            return Self::of_leaf(record, 1);
        }
        fn within(record: &AtlasRecord, cell: Rectangle) -> Shares {
            if record.quarters.is_empty() {
                return Shares::of_leaf(record, cell.smallest());
            }
            let parts = record.quarters.iter().zip(cell.quarters());
            parts.map(|(record, cell)| within(record, cell)).fold(Shares::default(), Shares::with)
        }
        within(record, plane.tile(record.point))
    }

    /// Shares of a record that is not subdivided, with `all` smallest cells.
    fn of_leaf(record: &AtlasRecord, all: u64) -> Self {
        let [is_stable, is_chaotic] = [!record.stable.is_empty(), record.entropy() > 0.0];
        let if_open = |is: bool| if is && !record.is_decided() { all } else { 0 };
        Self {
            all,
            decided: if record.is_decided() { all } else { 0 },
            stable: if_open(is_stable),
            horseshoe: if_open(is_chaotic),
            either: if_open(is_stable || is_chaotic),
        }
    }

    /// Sums of two shares.
    pub fn with(self, other: Self) -> Self {
        Self {
            all: self.all + other.all,
            decided: self.decided + other.decided,
            stable: self.stable + other.stable,
            horseshoe: self.horseshoe + other.horseshoe,
            either: self.either + other.either,
        }
    }
}
