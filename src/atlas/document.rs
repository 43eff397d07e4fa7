//! The atlas JSON Lines: its head, and the record of a point or a cell.

use std::time::Duration;

use impact_pair_document::{ATLAS_SCHEMA, AtlasHead, AtlasRecord, Decimal, GlobalDocument, PROGRAM, SceneDocument};

use impact_pair_model::vocabulary::ComponentKind;

use super::Plane;
use crate::chaos::GlobalSettings;
use crate::exact::Exact;
use crate::scene::{Key, Scene};
use crate::sweep::{Head, Line, axes};
use crate::{Error, sweep};

/// Head of an atlas: its scene, plane and settings; a shard is given by its number and the number of shards.
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
        horseshoes: settings.horseshoes.map(|depth| depth as u32), // exact: at most 64
        shard,
    }
}

/// The record of a point, or of a cell that is not cut.
pub(super) fn of(point: u64, values: &[(Key, Exact)], global: GlobalDocument, took: Duration) -> AtlasRecord {
    let of_kind = |kind: ComponentKind| global.components.iter().filter(move |component| component.kind == kind);
    let count = |kind| of_kind(kind).count() as u64;
    let areas = of_kind(ComponentKind::Undecided).filter_map(|component| component.area.text().parse::<f64>().ok());
    let area = areas.fold(0.0, |all, area| all + area); // shown
    AtlasRecord {
        point,
        values: values.iter().map(|(_, value)| value.text()).collect(),
        n_attracting: count(ComponentKind::Attracting),
        n_rest: count(ComponentKind::RestCycle),
        n_saddle: count(ComponentKind::Saddle),
        n_undecided: count(ComponentKind::Undecided),
        undecided_area: Decimal::printed(format!("{area:.6}")),
        seconds: (took.as_secs_f64() * 1e3).round() / 1e3, // shown
        class: global.class,
        greatest_speed: global.greatest_speed,
        components: global.components,
        order: global.order,
        stable: Vec::new(),
        quarters: Vec::new(),
    }
}

/// Numbers of points, or of smallest cells, of which a property is proved. Lemmas A20, A21
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Shares {
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
        fn within(record: &AtlasRecord, cell: super::Rectangle) -> Shares {
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
}

impl Line for AtlasRecord {
    fn point(&self) -> u64 {
        self.point
    }

    fn values(&self) -> &[String] {
        &self.values
    }
}
