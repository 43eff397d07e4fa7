//! The atlas JSON Lines: its head, and the record of a point or a cell.

use std::time::Duration;

use impact_pair_document::{
    ATLAS_SCHEMA, AtlasHead, AtlasRecord, Decimal, GlobalDocument, PROGRAM, SceneDocument, SweepAxis,
};

use super::Plane;
use crate::chaos::GlobalSettings;
use crate::exact::Exact;
use crate::scene::{Key, Range, Scene};
use crate::sweep::{Head, Line, axis};
use crate::{Error, sweep};

/// Returns what an atlas is about; a shard is given by its number and of how many.
pub fn head(scene: &Scene, plane: &Plane, settings: &GlobalSettings, shard: Option<[u64; 2]>) -> AtlasHead {
    AtlasHead {
        schema: ATLAS_SCHEMA.to_owned(),
        program: PROGRAM.to_owned(),
        title: scene.title().map(str::to_owned),
        scene: SceneDocument::new(scene.pair(), scene.start()),
        over: plane.axes().map(sweep::written).to_vec(),
        points: plane.points(),
        cells: plane.has_cells(),
        boxes: settings.boxes,
        halvings: settings.halvings,
        most: settings.most as u64,
        work: settings.work,
        digits: settings.precision.digits,
        shard,
    }
}

/// The record of a point, or of a cell that is not cut.
pub(super) fn of(point: u64, values: &[(Key, Exact)], global: GlobalDocument, took: Duration) -> AtlasRecord {
    let of_kind = |kind: &'static str| global.components.iter().filter(move |component| component.kind == kind);
    let count = |kind| of_kind(kind).count() as u64;
    let areas = of_kind("undecided").filter_map(|component| component.area.text().parse::<f64>().ok());
    let area = areas.fold(0.0, |all, area| all + area); // shown
    AtlasRecord {
        point,
        values: values.iter().map(|(_, value)| value.text()).collect(),
        n_attracting: count("attracting"),
        n_rest: count("rest-cycle"),
        n_saddle: count("saddle"),
        n_undecided: count("undecided"),
        undecided_area: Decimal::printed(format!("{area:.6}")),
        seconds: (took.as_secs_f64() * 1e3).round() / 1e3, // shown
        class: global.class,
        greatest_speed: global.greatest_speed,
        components: global.components,
        order: global.order,
        quarters: Vec::new(),
    }
}

/// Returns how many of the points, or of the smallest cells, are decided, and of how many, as far as they are there. Lemma A20
///
/// # Errors
/// When the head is of no plane, or a record of no cell of it.
pub fn decided(plane: &Plane, record: &AtlasRecord) -> [u64; 2] {
    if !plane.has_cells() {
        return [u64::from(record.is_decided()), 1];
    }
    fn within(record: &AtlasRecord, cell: super::Rectangle) -> u64 {
        if record.is_decided() {
            return cell.smallest();
        }
        record.quarters.iter().zip(cell.quarters()).map(|(record, cell)| within(record, cell)).sum()
    }
    let tile = plane.tile(record.point);
    [within(record, tile), tile.smallest()]
}

impl Head for AtlasHead {
    type Record = AtlasRecord;
    type Grid = Plane;
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
        let axis_of = |over: &SweepAxis| axis(&format!("{}={}..{}:{}", over.key, over.from, over.to, over.count));
        let axes: Vec<Range> = self.over.iter().map(axis_of).collect::<Result<_, _>>()?;
        let plane = Plane::new(axes, self.cells)?;
        if plane.points() != self.points {
            let message = format!("points is {}, but the plane has {}", self.points, plane.points());
            return Err(Error::out_of_range(None, message));
        }
        Ok(plane)
    }

    fn values(plane: &Plane, point: u64) -> Result<Vec<Exact>, Error> {
        Ok(plane.values(point)?.into_iter().map(|(_, value)| value).collect())
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
