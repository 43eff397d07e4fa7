//! Pictures: orbits as in figures 12-17, sweeps, what accuracy costs, and the manifolds of figures 10 and 11, as SVG.
//!
//! All curves and points are enclosed; an enclosure wider than a pixel is drawn as a band or a box.
//!
//! ```
//! use impact_pair::Scene;
//! use impact_pair::orbit::Orbit;
//! use impact_pair::watch::Unwatched;
//! use impact_pair_answers::{Options, read_options};
//! use impact_pair_plot::orbit::{Figure, Panel};
//! use impact_pair_plot::picture::Look;
//!
//! let scene = Scene::parse(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/figure-14.toml")))?;
//! let figure = Figure {
//!     panels: vec![Panel::Displacement],
//!     cycles: 3,
//!     orbit_cycles: 0,
//!     transient: 0,
//!     zoom: None,
//!     run: read_options("run", &Options::default())?,
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
pub mod sweep;
pub mod tangency;
#[cfg(test)]
#[path = "../../../tests/tolerances/mod.rs"]
mod tolerances;
pub mod trade;
pub mod two_impact;
pub mod windows;

use anyhow::Result;
use impact_pair_answers::Picture;

use picture::Look;

/// Draws the picture of an answer as SVG.
///
/// # Errors
/// If a value exceeds the range of what is drawn.
pub fn svg(picture: Picture<'_>, look: &Look) -> Result<String> {
    match picture {
        Picture::Trap(scene, region) => chaos::trap(scene, region, look),
        Picture::Chaos(scene, over, found, set) => chaos::chaos(scene, over, (found, set), look),
        Picture::ChaosCells(scene, requested, found) => proved::cells(scene, requested, found, look),
        Picture::Windows(scene, found) => windows::windows(scene, found, look),
        Picture::Global(scene, found, document) => global::global(scene, found, document, look),
        Picture::Tangency(scene, found) => tangency::tangency(scene, found, look),
        Picture::Description(scene, found, document) => describe::describe(scene, found, document, look),
        Picture::Trade(trade) => trade::svg(trade, look),
        Picture::Manifolds(scene, axis, curves) => two_impact::svg(scene, axis, curves, None, look),
    }
}
