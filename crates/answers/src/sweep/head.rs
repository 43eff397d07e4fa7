//! The head and the lines of a sweep.

use anyhow::Result;
use impact_pair::Error;
use impact_pair::exact::Exact;
use impact_pair::json::{SWEEP_SCHEMA, SweepHead, SweepRecord};

use super::columns::{Table, columns, rows};
use crate::grid::{Cell, Grid, Head, Kind, Line, axes};

impl Head for SweepHead {
    type Record = SweepRecord;
    type Grid = Grid;
    type Table = Table;
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
        let grid = Grid::new(axes(&self.over)?)?;
        if grid.points() != self.points {
            let message = format!("points is {}, but the grid has {}", self.points, grid.points());
            return Err(Error::out_of_range(None, message));
        }
        Ok(grid)
    }

    fn values(grid: &Grid, point: u64) -> Result<Vec<Exact>, Error> {
        Ok(grid.values(point)?.into_iter().map(|(_, value)| value).collect())
    }

    fn columns(&self, table: Table) -> Vec<(String, Kind)> {
        columns(self, table)
    }

    fn rows<'r>(&self, table: Table, record: &'r SweepRecord) -> Box<dyn Iterator<Item = Vec<Cell<'r>>> + 'r> {
        Box::new(rows(self, table, record))
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
