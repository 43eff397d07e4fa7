//! The lines of a sweep: its head, and a record a point, as JSON; all other formats are made from these.

use anyhow::{Result, bail};
use impact_pair::json::{SWEEP_SCHEMA, SweepHead, SweepRecord};
use impact_pair::sweep;
use serde::Serialize;

/// Reads the first line of what this program has written.
pub fn read_head(line: &str) -> Result<SweepHead> {
    let head: SweepHead = match serde_json::from_str(line) {
        Ok(head) => head,
        Err(error) => bail!("line 1 is no head of schema {SWEEP_SCHEMA}: {error}"),
    };
    if head.schema != SWEEP_SCHEMA {
        bail!("the schema is {}, but accepted is {SWEEP_SCHEMA}", head.schema);
    }
    sweep::grid(&head)?;
    Ok(head)
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
