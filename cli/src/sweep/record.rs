//! The lines of a sweep: its head, and a record a point, as JSON; all other formats are made from these.

use anyhow::{Result, bail};
use impact_pair::certificate::document::{SWEEP_SCHEMA, SweepAxis, SweepHead, SweepRecord};
use impact_pair::sweep::{Axis, Grid};
use serde::Serialize;

use super::arguments::Shard;

/// Reads the first line of what this program has written.
pub fn read_head(line: &str) -> Result<SweepHead> {
    let head: SweepHead = match serde_json::from_str(line) {
        Ok(head) => head,
        Err(error) => bail!("line 1 is no head of schema {SWEEP_SCHEMA}: {error}"),
    };
    if head.schema != SWEEP_SCHEMA {
        bail!("the schema is {}, but accepted is {SWEEP_SCHEMA}", head.schema);
    }
    grid(&head)?;
    Ok(head)
}

pub fn read_record(line: &str) -> Result<SweepRecord, serde_json::Error> {
    serde_json::from_str(line)
}

/// A head or a record.
pub fn line(document: &impl Serialize) -> String {
    serde_json::to_string(document).expect("plain data")
}

/// The grid, anew.
pub fn grid(head: &SweepHead) -> Result<Grid> {
    let axis = |over: &SweepAxis| format!("{}={}..{}:{}", over.key, over.from, over.to, over.count).parse::<Axis>();
    let grid = Grid::new(head.over.iter().map(axis).collect::<Result<_, _>>()?)?;
    if grid.points() != head.points {
        bail!("points is {}, but the grid has {}", head.points, grid.points());
    }
    Ok(grid)
}

/// The points that belong to it.
pub fn own(head: &SweepHead) -> impl Iterator<Item = u64> + use<> {
    let shard = head.shard.map(|[number, of]| Shard { number, of });
    (0..head.points).filter(move |&point| shard.is_none_or(|shard| shard.holds(point)))
}
