//! The lines of a sweep: its head, and a record a point, as JSON; all other formats are made from these.

use std::cmp::Ordering;

use anyhow::{Result, bail};
use impact_pair::exact::Exact;
use impact_pair::json::{SWEEP_SCHEMA, SweepHead, SweepRecord};
use impact_pair::sweep::{self, Grid};
use serde::Serialize;

/// Reads the first line of what this program has written, and the grid that it tells of.
pub fn read_head(line: &str) -> Result<(SweepHead, Grid)> {
    let head: SweepHead = match serde_json::from_str(line) {
        Ok(head) => head,
        Err(error) => bail!("line 1 is no head of schema {SWEEP_SCHEMA}: {error}"),
    };
    if head.schema != SWEEP_SCHEMA {
        bail!("the schema is {}, but accepted is {SWEEP_SCHEMA}", head.schema);
    }
    if let Some([number, of]) = head.shard
        && !(1..=of).contains(&number)
    {
        bail!("the shard is {number}/{of}, but accepted is I/N with I from 1 to N");
    }
    let grid = sweep::grid(&head)?;
    Ok((head, grid))
}

/// Whether the values of a record are those of its point.
pub fn is_of_grid(record: &SweepRecord, grid: &Grid) -> bool {
    let is_one = |(text, value): (&String, &Exact)| {
        *text == value.text() || Exact::parse(text).is_ok_and(|own| own.compare(value) == Some(Ordering::Equal))
    };
    let values = grid.values(record.point).unwrap_or_default();
    record.values.len() == values.len() && record.values.iter().zip(values.iter().map(|(_, value)| value)).all(is_one)
}

pub fn read_record(line: &str) -> Result<SweepRecord, serde_json::Error> {
    serde_json::from_str(line)
}

/// A head or a record.
pub fn line(document: &impl Serialize) -> String {
    serde_json::to_string(document).expect("plain data")
}

/// Whether a point belongs to it: of several shards, neighbours, which cost alike, go to different ones.
pub fn is_own(head: &SweepHead, point: u64) -> bool {
    point < head.points && head.shard.is_none_or(|[number, of]| point % of == number - 1)
}

/// The points that belong to it.
pub fn own(head: &SweepHead) -> impl Iterator<Item = u64> {
    (0..head.points).filter(|&point| is_own(head, point))
}
