//! JSON Lines over a grid: a head, then a record per point. What a sweep and an atlas share.

use impact_pair::Error;
use impact_pair::exact::Exact;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::columns::{Cell, Kind, csv_line, csv_names};

/// The first line: everything that the points depend on.
pub trait Head: Clone + PartialEq + Serialize + DeserializeOwned + Send + Sync + 'static {
    /// The record of a point.
    type Record: Line;
    /// The points.
    type Grid;
    /// The choice of rows.
    type Table: Copy;
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

    /// Columns of a table, in order.
    fn columns(&self, table: Self::Table) -> Vec<(String, Kind)>;

    /// Rows of a record in a table.
    fn rows<'r>(&self, table: Self::Table, record: &'r Self::Record) -> Box<dyn Iterator<Item = Vec<Cell<'r>>> + 'r>;

    /// Names of the columns of a table as a line of CSV.
    fn csv_head(&self, table: Self::Table) -> String {
        csv_names(self.columns(table))
    }

    /// Rows of a record in a table as lines of CSV.
    fn csv_rows(&self, table: Self::Table, record: &Self::Record) -> String {
        let kinds: Vec<Kind> = self.columns(table).into_iter().map(|(_, kind)| kind).collect();
        self.rows(table, record).map(|row| csv_line(&row, &kinds)).collect()
    }

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
