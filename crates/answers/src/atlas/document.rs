//! The atlas JSON Lines: its head, and the record of a point or a cell.

use std::time::Duration;

use impact_pair::json::{ATLAS_SCHEMA, AtlasHead, AtlasRecord, Decimal, GlobalDocument, PROGRAM, SceneDocument};

use impact_pair::json::vocabulary::ComponentKind;

use impact_pair::Scene;
use impact_pair::chaos::GlobalSettings;
use impact_pair::exact::Exact;
use impact_pair::scene::Key;

use super::Plane;
use crate::grid::written;

/// Head of an atlas: its scene, plane and settings; a shard is given by its number and the number of shards.
pub(super) fn head(scene: &Scene, plane: &Plane, settings: &GlobalSettings, shard: Option<[u64; 2]>) -> AtlasHead {
    AtlasHead {
        schema: ATLAS_SCHEMA.to_owned(),
        program: PROGRAM.to_owned(),
        title: scene.title().map(str::to_owned),
        scene: SceneDocument::new(scene.pair(), scene.start()),
        over: plane.axes().iter().map(written).collect(),
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
