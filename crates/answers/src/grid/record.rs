//! The lines of a sweep or an atlas: its head, and a record a point, as JSON; all other formats are made from these.

use std::cmp::Ordering;

use anyhow::{Result, bail};
use impact_pair::exact::Exact;
use serde::Serialize;

use super::head::{Head, Line};

/// Reads the first line of what this program has written, and the grid that it tells of.
pub fn read_head<H: Head>(line: &str) -> Result<(H, H::Grid)> {
    let head: H = match serde_json::from_str(line) {
        Ok(head) => head,
        Err(error) => bail!("line 1 is no head of schema {}: {error}", H::SCHEMA),
    };
    if head.schema() != H::SCHEMA {
        bail!("the schema is {}, but accepted is {}", head.schema(), H::SCHEMA);
    }
    if let Some([number, of]) = head.shard()
        && !(1..=of).contains(&number)
    {
        bail!("the shard is {number}/{of}, but accepted is I/N with I from 1 to N");
    }
    let grid = head.grid()?;
    Ok((head, grid))
}

/// Returns whether the parameter values of a record equal those of its point of the grid.
pub fn is_of_grid<H: Head>(record: &H::Record, grid: &H::Grid) -> bool {
    let is_one = |(text, value): (&String, &Exact)| {
        *text == value.text() || Exact::parse(text).is_ok_and(|own| own.compare(value) == Some(Ordering::Equal))
    };
    let values = H::values(grid, record.point()).unwrap_or_default();
    record.values().len() == values.len() && record.values().iter().zip(&values).all(is_one)
}

/// A head or a record.
pub fn line(document: &impl Serialize) -> String {
    serde_json::to_string(document).expect("plain data")
}

/// The points that belong to it.
pub fn own<H: Head>(head: &H) -> impl Iterator<Item = u64> + use<'_, H> {
    (0..head.points()).filter(|&point| head.has(point))
}
