//! Pictures: orbits as in figures 12-17, sweeps, what accuracy costs, and the manifolds of figures 10 and 11, as SVG.
//!
//! All curves and points are enclosed; an enclosure wider than a pixel is drawn as a band or a box.
//!
//! ```
//! use impact_pair::Scene;
//! use impact_pair::orbit::Orbit;
//! use impact_pair::watch::Unwatched;
//! use impact_pair_answers::read_options;
//! use impact_pair_plot::orbit::{Figure, Panel};
//! use impact_pair_plot::picture::Look;
//! use serde_json::Map;
//!
//! let scene = Scene::parse(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/figure-14.toml")))?;
//! let figure = Figure {
//!     panels: vec![Panel::Displacement],
//!     cycles: 3,
//!     orbit_cycles: 0,
//!     transient: 0,
//!     zoom: None,
//!     run: read_options("run", &Map::new())?,
//!     look: Look::default(),
//! };
//! let settings = figure.settings(&scene);
//! let (svg, ending) = figure.draw(&scene, (Orbit::of(&scene, settings.clone())?, &settings), &Unwatched);
//! assert!(svg?.starts_with("<svg") && ending.to_string().starts_with("certified: "));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod atlas;
pub mod chaos;
pub mod describe;
pub mod global;
pub mod orbit;
pub mod picture;
pub mod proved;
pub mod records;
pub mod sweep;
pub mod tangency;
#[cfg(test)]
#[path = "../../../tests/tolerances/mod.rs"]
mod tolerances;
pub mod trade;
pub mod two_impact;
pub mod windows;

use anyhow::Result;
use impact_pair_answers::trade::Trade;
use impact_pair_answers::{
    AllCycles, Analysis, Answer, Audited, Bifurcations, Chaotic, Described, HomoclinicTangencies, Periodic,
    StableWindows, Trapped,
};

use picture::Look;

/// An answer that may have a picture.
pub trait Pictured: Answer {
    /// The picture as SVG; `None` where there is nothing to draw.
    ///
    /// # Errors
    /// If a value exceeds the range of what is drawn.
    fn svg(&self, _look: &Look) -> Option<Result<String>> {
        None
    }
}

impl Pictured for Periodic<'_> {}

impl Pictured for Bifurcations<'_> {}

impl Pictured for Audited<'_> {}

impl Pictured for AllCycles<'_> {}

impl Pictured for Trapped<'_> {
    fn svg(&self, look: &Look) -> Option<Result<String>> {
        self.region.as_ref().ok().map(|region| chaos::trap(self.scene, &region.trap, look))
    }
}

impl Pictured for Chaotic<'_> {
    fn svg(&self, look: &Look) -> Option<Result<String>> {
        Some(match self {
            Self::Horseshoe { scene, over, found, set, .. } => {
                chaos::chaos(scene, over.as_ref(), (found, set.as_ref()), look)
            }
            Self::Cells { scene, requested, found, .. } => proved::cells(scene, requested, found, look),
        })
    }
}

impl Pictured for StableWindows<'_> {
    fn svg(&self, look: &Look) -> Option<Result<String>> {
        Some(windows::windows(self.scene, &self.found, look))
    }
}

impl Pictured for Analysis<'_> {
    fn svg(&self, look: &Look) -> Option<Result<String>> {
        Some(global::global(self.scene, &self.found, &self.document, look))
    }
}

impl Pictured for HomoclinicTangencies<'_> {
    fn svg(&self, look: &Look) -> Option<Result<String>> {
        Some(tangency::tangency(self.scene, &self.found, look))
    }
}

impl Pictured for Described<'_> {
    fn svg(&self, look: &Look) -> Option<Result<String>> {
        Some(describe::describe(self.scene, &self.found, &self.document, look))
    }
}

impl Pictured for Trade<'_> {
    fn svg(&self, look: &Look) -> Option<Result<String>> {
        Some(trade::svg(self, look))
    }
}
