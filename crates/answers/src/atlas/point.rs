//! One point or one tile: the global analysis, for all parameters of a cell or of those that it is cut into.

use std::time::Instant;

use impact_pair::Error;
use impact_pair::chaos::{Global, GlobalSettings, period, stable_orbits};
use impact_pair::exact::Exact;
use impact_pair::json::AtlasRecord;
use impact_pair::scene::Key;
use impact_pair::watch::Watch;

use super::plane::Rectangle;
use super::{Atlas, document};

impl Atlas {
    /// Record of a cell, and of the cells that it is cut into while undecided. Lemmas A20, A21
    pub(super) fn of_cell(&self, tile: u64, cell: &Rectangle, watch: &dyn Watch) -> Result<Option<AtlasRecord>, Error> {
        let (values, quarters) = (self.plane.intervals(cell)?, cell.quarters());
        // Horseshoes and stable orbits are looked for where a cell is not cut any more.
        let horseshoes = self.settings.horseshoes.filter(|_| quarters.is_empty());
        let settings = GlobalSettings { horseshoes, ..self.settings };
        let Some(mut found) = self.analysed(&settings, tile, &values, watch)? else { return Ok(None) };
        if found.is_decided() {
            return Ok(Some(found));
        }
        if quarters.is_empty() {
            let orbits = stable_orbits(self.scene.with(&values)?.pair(), watch)?;
            found.stable = orbits.iter().map(|(word, cycles)| period(word, *cycles)).collect();
            return Ok(watch.goes_on().then_some(found));
        }
        for quarter in quarters {
            let Some(part) = self.of_cell(tile, &quarter, watch)? else { return Ok(None) };
            found.quarters.push(part);
        }
        Ok(Some(found))
    }

    /// Record of a point with these values, which is not cut.
    pub(super) fn analysed(
        &self,
        settings: &GlobalSettings,
        point: u64,
        values: &[(Key, Exact)],
        watch: &dyn Watch,
    ) -> Result<Option<AtlasRecord>, Error> {
        let begun = Instant::now();
        let scene = self.scene.with(values)?;
        let found = Global::of(scene.pair(), settings, watch)?;
        if found.interrupted {
            return Ok(None);
        }
        let global = found.document(&scene, settings)?;
        Ok(Some(document::of(point, values, global, begun.elapsed())))
    }
}
