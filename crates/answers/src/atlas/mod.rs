//! `atlas`: the fate of every motion, over the plane of two parameters: at the points of a grid, or for all parameters of cells.
//!
//! A [`Plane`] has exact points, or cells whose parameters are intervals between exact values. The record of a point or tile holds its global
//! analysis, [`impact_pair::chaos::Global`].

mod columns;
mod document;
mod head;
mod plane;
mod point;
mod tally;
#[cfg(test)]
mod tests;

use clap::Args;
use impact_pair::chaos::{Global, GlobalSettings, MOST_DEPTH};
use impact_pair::exact::Exact;
use impact_pair::json::{AtlasHead, AtlasRecord};
use impact_pair::scene::{Key, Over};
use impact_pair::watch::Watch;
use impact_pair::{Effort, Error, Scene};

use crate::Failure;
use crate::grid::{Survey, axis};
use crate::values::{digits, whole};
pub use plane::{Plane, Rectangle};

/// Options of `atlas`.
#[derive(Args, Clone, Debug)]
pub struct AtlasOptions {
    /// The two parameters
    #[arg(long, value_name = "KEY=LO..HI:COUNT", value_parser = axis, required = true, allow_hyphen_values = true)]
    pub over: Vec<Over>,
    /// Prove each answer for all parameters of a cell
    #[arg(long)]
    pub cells: bool,
    /// Multiply the work for each point or cell by X: at 1 about 300,000 boxes are mapped for a point, 20,000 for a cell
    #[arg(long, value_name = "X", default_value_t)]
    pub effort: Effort,
    /// Look for horseshoes in undecided components of a point, and of a smallest cell, by words of at most K impacts: some seconds each
    #[arg(long, value_name = "K", value_parser = whole(1..=MOST_DEPTH))]
    pub horseshoes: Option<u32>,
    /// Requested width of periodic orbits, at most 10^-D: of phases relative to 2 pi, of velocities relative to A W
    #[arg(long, value_name = "D", default_value_t = 9, value_parser = digits())]
    pub digits: u32,
}

/// An atlas of a scene: a global analysis at each point, or for each tile, of a plane.
#[derive(Clone, Debug)]
pub struct Atlas {
    scene: Scene,
    plane: Plane,
    settings: GlobalSettings,
    head: AtlasHead,
}

impl AtlasOptions {
    /// The atlas of a scene, or the shard of it with this number, from 1, of so many.
    ///
    /// # Errors
    /// If the scene has no such key, or the axes make no plane.
    pub fn of(&self, scene: &Scene, shard: Option<[u64; 2]>) -> Result<Atlas, Failure> {
        let plane = Plane::new(Over::all(&self.over, scene.pair())?, self.cells).map_err(Failure::malformed)?;
        let usual = if self.cells { GlobalSettings::of_cell() } else { GlobalSettings::of_point() };
        let horseshoes = self.horseshoes.map(|depth| depth as usize);
        let mut settings = GlobalSettings { horseshoes, ..usual }.with_effort(self.effort);
        settings.precision.digits = self.digits;
        Ok(Atlas::new(scene, plane, settings, shard))
    }
}

impl Atlas {
    /// Atlas of a scene over a plane, or a shard of it.
    pub fn new(scene: &Scene, plane: Plane, settings: GlobalSettings, shard: Option<[u64; 2]>) -> Self {
        let head = document::head(scene, &plane, &settings, shard);
        Self { scene: scene.clone(), plane, settings, head }
    }
}

impl Survey for Atlas {
    type Head = AtlasHead;

    fn head(&self) -> &AtlasHead {
        &self.head
    }

    fn check(&self) -> Result<(), Failure> {
        let corners = || self.plane.corners(&self.scene)?.iter().try_for_each(|corner| Global::accepts(corner.pair()));
        corners().map_err(Failure::over(self.plane.axes()))
    }

    fn values(&self, point: u64) -> Result<Vec<(Key, Exact)>, Error> {
        self.plane.values(point)
    }

    fn record(&self, point: u64, values: &[(Key, Exact)], watch: &dyn Watch) -> Result<Option<AtlasRecord>, Error> {
        if self.plane.has_cells() {
            return self.of_cell(point, &self.plane.tile(point), watch);
        }
        self.analysed(&self.settings, point, values, watch)
    }
}
