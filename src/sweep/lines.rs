//! JSON Lines over a grid: a head, then a record per point. What a sweep and an atlas share.

use impact_pair_document::{SWEEP_SCHEMA, SweepHead, SweepRecord};
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::Grid;
use crate::Error;
use crate::exact::Exact;

/// The first line: everything that the points depend on.
pub trait Head: Clone + PartialEq + Serialize + DeserializeOwned {
    /// The record of a point.
    type Record: Line;
    /// The points.
    type Grid;
    /// The schema of the lines.
    const SCHEMA: &'static str;
    /// The kind of the lines, in a word.
    const NAME: &'static str;

    /// Schema that the line names.
    fn schema(&self) -> &str;

    /// Number of points of the whole grid.
    fn points(&self) -> u64;

    /// Number of the shard, from 1, and number of shards.
    fn shard(&self) -> Option<[u64; 2]>;

    /// The head with this shard.
    fn with_shard(&self, shard: Option<[u64; 2]>) -> Self;

    /// The points.
    ///
    /// # Errors
    /// If the axes are no valid grid, or the grid has another number of points.
    fn grid(&self) -> Result<Self::Grid, Error>;

    /// Values of a point, one per axis.
    ///
    /// # Errors
    /// If a value is beyond the range of exact expressions.
    fn values(grid: &Self::Grid, point: u64) -> Result<Vec<Exact>, Error>;

    /// Whether a point belongs to the grid, or to the shard. Neighbours, which cost alike, belong to different shards.
    fn has(&self, point: u64) -> bool {
        point < self.points() && self.shard().is_none_or(|[number, of]| point % of == number - 1)
    }
}

/// The record of a point.
pub trait Line: Serialize + DeserializeOwned {
    /// Number of the point.
    fn point(&self) -> u64;

    /// Values of the point as written.
    fn values(&self) -> &[String];
}

impl Head for SweepHead {
    type Record = SweepRecord;
    type Grid = Grid;
    const SCHEMA: &'static str = SWEEP_SCHEMA;
    const NAME: &'static str = "sweep";

    fn schema(&self) -> &str {
        &self.schema
    }

    fn points(&self) -> u64 {
        self.points
    }

    fn shard(&self) -> Option<[u64; 2]> {
        self.shard
    }

    fn with_shard(&self, shard: Option<[u64; 2]>) -> Self {
        Self { shard, ..self.clone() }
    }

    fn grid(&self) -> Result<Grid, Error> {
        super::grid(self)
    }

    fn values(grid: &Grid, point: u64) -> Result<Vec<Exact>, Error> {
        Ok(grid.values(point)?.into_iter().map(|(_, value)| value).collect())
    }
}

impl Line for SweepRecord {
    fn point(&self) -> u64 {
        self.point
    }

    fn values(&self) -> &[String] {
        &self.values
    }
}
