//! One point or one tile: the global analysis, for all parameters of a cell or of those that it is cut into.

use std::time::Instant;

use impact_pair_document::AtlasRecord;

use super::document;
use super::plane::{Plane, Rectangle};
use crate::Error;
use crate::chaos::{Global, GlobalSettings, period, stable_orbits};
use crate::exact::Exact;
use crate::scene::{Key, Scene};
use crate::watch::Watch;

/// Global analysis at a point, or for all parameters of a tile and of the cells that it is cut into while undecided. `None` if the watch stops
/// the analysis.
///
/// # Errors
/// As of [`Global::of`].
pub fn record(
    scene: &Scene,
    plane: &Plane,
    settings: &GlobalSettings,
    point: u64,
    watch: &dyn Watch,
) -> Result<Option<AtlasRecord>, Error> {
    if plane.has_cells() {
        return of_cell(scene, plane, settings, (point, &plane.tile(point)), watch);
    }
    analysed(scene, settings, point, &plane.values(point)?, watch)
}

/// Record of a cell, and of the cells that it is cut into while undecided. Lemmas A20, A21
fn of_cell(
    scene: &Scene,
    plane: &Plane,
    settings: &GlobalSettings,
    (tile, cell): (u64, &Rectangle),
    watch: &dyn Watch,
) -> Result<Option<AtlasRecord>, Error> {
    let (values, quarters) = (plane.intervals(cell)?, cell.quarters());
    // Horseshoes and stable orbits are looked for where a cell is not cut any more.
    let horseshoes = settings.horseshoes.filter(|_| quarters.is_empty());
    let own = GlobalSettings { horseshoes, ..*settings };
    let Some(mut found) = analysed(scene, &own, tile, &values, watch)? else { return Ok(None) };
    if found.is_decided() {
        return Ok(Some(found));
    }
    if quarters.is_empty() {
        let orbits = stable_orbits(scene.with(&values)?.pair(), watch)?;
        found.stable = orbits.iter().map(|(word, cycles)| period(word, *cycles)).collect();
        return Ok(watch.goes_on().then_some(found));
    }
    for quarter in quarters {
        let Some(part) = of_cell(scene, plane, settings, (tile, &quarter), watch)? else { return Ok(None) };
        found.quarters.push(part);
    }
    Ok(Some(found))
}

/// The global analysis with these values.
fn analysed(
    scene: &Scene,
    settings: &GlobalSettings,
    point: u64,
    values: &[(Key, Exact)],
    watch: &dyn Watch,
) -> Result<Option<AtlasRecord>, Error> {
    let begun = Instant::now();
    let scene = scene.with(values)?;
    let found = Global::of(scene.pair(), settings, watch)?;
    if found.interrupted {
        return Ok(None);
    }
    let global = found.document(&scene, settings)?;
    Ok(Some(document::of(point, values, global, begun.elapsed())))
}
