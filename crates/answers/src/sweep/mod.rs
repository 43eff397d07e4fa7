//! `sweep`: one orbit after another over a grid of parameters or initial data: bifurcation diagrams, exponents, basins.
//!
//! A [`Grid`] has exact points; at each of them [`follow`] certifies one orbit and its outcome: a [`Point`]. Points are independent, so they may
//! be computed in any order, by any number of threads.
//!
//! All points have the same units: phases, cycles and exponents are of one term of the excitation, [`Grid::reference`], also where another term
//! is the fastest.

mod attraction;
mod columns;
mod document;
mod head;
mod kinds;
mod point;
mod tally;
#[cfg(test)]
mod tests;
mod window;

use clap::Args;
use impact_pair::exact::Exact;
use impact_pair::json::{SweepHead, SweepRecord};
use impact_pair::orbit::{Arithmetic, Orbit, Settings};
use impact_pair::scene::{Key, Over};
use impact_pair::watch::Watch;
use impact_pair::{Error, Scene};

use crate::Failure;
use crate::grid::{Grid, Survey, axis};
use crate::values::{ARITHMETICS, bits, count, digits};
pub use attraction::Attraction;
pub use columns::Table;
pub(crate) use document::{exponent, limit};
pub use kinds::{Kinds, PointKind};
pub use point::{MOST_IMPACTS, Point, PointSettings, follow};

/// Options of `sweep`.
#[derive(Args, Clone, Debug)]
pub struct SweepOptions {
    /// The varied key, or two of them
    #[arg(long, value_name = "KEY=LO..HI:COUNT", value_parser = axis, required = true, allow_hyphen_values = true)]
    pub over: Vec<Over>,
    /// Number of impacts in the transient, which are certified but not written
    #[arg(long, value_name = "N", default_value_t = 500, value_parser = count(0..=MOST_IMPACTS))]
    pub transient: u64,
    /// Number of impacts after the transient
    #[arg(long, value_name = "M", default_value_t = 300, value_parser = count(1..=MOST_IMPACTS))]
    pub impacts: u64,
    /// Requested width of enclosures, at most 10^-D: of times relative to 2 pi/W, of velocities relative to A W: finer
    /// than any picture
    #[arg(long, value_name = "D", default_value_t = 6, value_parser = digits())]
    pub digits: u32,
    /// The arithmetic, as in run; shadow, the fastest for pictures of chaos, is used only at points whose exact orbits doubles do not
    /// certify
    #[arg(long, value_name = ARITHMETICS, default_value_t)]
    pub arithmetic: Arithmetic,
    /// Maximum precision of auto, in bits; enough for 100,000 chaotic impacts, and low enough that no point takes minutes to end undecided
    #[arg(long, value_name = "BITS", default_value_t = 100_000, value_parser = bits())]
    pub max_bits: u32,
    /// Write no impacts, only the result of each point
    #[arg(long)]
    pub summary: bool,
}

/// A sweep of a scene: an orbit at each point of a grid.
#[derive(Clone, Debug)]
pub struct Sweep {
    scene: Scene,
    grid: Grid,
    requested: PointSettings,
    head: SweepHead,
}

impl SweepOptions {
    /// The sweep of a scene, or the shard of it with this number, from 1, of so many.
    ///
    /// # Errors
    /// If the scene has no such key, or the axes make no grid.
    pub fn of(&self, scene: &Scene, shard: Option<[u64; 2]>) -> Result<Sweep, Failure> {
        let grid = Grid::new(Over::all(&self.over, scene.pair())?).map_err(Failure::malformed)?;
        let Self { transient, impacts, summary, digits, arithmetic, max_bits, .. } = *self;
        let reference = grid.reference(scene).map_err(Failure::over(grid.axes()))?;
        let settings = Settings { digits, arithmetic, max_bits, ..Settings::default() };
        Ok(Sweep::new(scene, grid, PointSettings { transient, impacts, summary, reference, settings }, shard))
    }
}

impl Sweep {
    /// Sweep of a scene over a grid, or a shard of it.
    pub fn new(scene: &Scene, grid: Grid, requested: PointSettings, shard: Option<[u64; 2]>) -> Self {
        let head = document::head(scene, &grid, &requested, shard);
        Self { scene: scene.clone(), grid, requested, head }
    }
}

impl Survey for Sweep {
    type Head = SweepHead;

    fn head(&self) -> &SweepHead {
        &self.head
    }

    fn check(&self) -> Result<(), Failure> {
        let is_scene = |point: u64| {
            let scene = self.grid.scene(&self.scene, &self.grid.values(point)?)?;
            Orbit::of(&scene, self.requested.settings.clone()).map(drop)
        };
        self.grid.corners().into_iter().try_for_each(is_scene).map_err(Failure::over(self.grid.axes()))
    }

    fn values(&self, point: u64) -> Result<Vec<(Key, Exact)>, Error> {
        self.grid.values(point)
    }

    fn record(&self, point: u64, values: &[(Key, Exact)], watch: &dyn Watch) -> Result<Option<SweepRecord>, Error> {
        let found = follow(&self.grid.scene(&self.scene, values)?, &self.requested, watch)?;
        Ok(found.map(|found| document::record(point, values, &found)))
    }
}
