//! The head and the lines of an atlas.

use anyhow::Result;
use impact_pair::Error;
use impact_pair::exact::Exact;
use impact_pair::json::{ATLAS_SCHEMA, AtlasHead, AtlasRecord};

use super::columns::{columns, rows};
use super::plane::Plane;
use crate::grid::{Cell, Head, Kind, Line, axes};

impl Head for AtlasHead {
    type Record = AtlasRecord;
    type Grid = Plane;
    type Table = ();
    const SCHEMA: &'static str = ATLAS_SCHEMA;
    const NAME: &'static str = "atlas";

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

    fn grid(&self) -> Result<Plane, Error> {
        let plane = Plane::new(axes(&self.over)?, self.cells)?;
        if plane.points() != self.points {
            let message = format!("points is {}, but the plane has {}", self.points, plane.points());
            return Err(Error::out_of_range(None, message));
        }
        Ok(plane)
    }

    fn values(plane: &Plane, point: u64) -> Result<Vec<Exact>, Error> {
        Ok(plane.values(point)?.into_iter().map(|(_, value)| value).collect())
    }

    fn columns(&self, (): ()) -> Vec<(String, Kind)> {
        columns(self)
    }

    fn rows<'r>(&self, (): (), record: &'r AtlasRecord) -> Box<dyn Iterator<Item = Vec<Cell<'r>>> + 'r> {
        Box::new(rows(self, record).into_iter())
    }
}

impl Line for AtlasRecord {
    fn point(&self) -> u64 {
        self.point
    }

    fn values(&self) -> &[String] {
        &self.values
    }
}
