//! Pictures: orbits as in figures 12-17, sweeps, what accuracy costs, and the manifolds of figures 10 and 11, as SVG.
//!
//! All of it is enclosed; where what is enclosed is wider than a pixel, it is drawn as a band or a box.

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
