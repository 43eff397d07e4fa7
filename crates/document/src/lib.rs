//! The JSON documents of impact-pair: one struct per document, which writes and reads it.
//!
//! Bounds are decimal strings rounded outward: the true value lies in `[lower, upper]`. Fields are written in the order of
//! their declaration. Each document names its schema in its first field; `docs/schemas` holds the JSON Schemas.

mod atlas;
mod audit;
mod bifurcation;
mod chaos;
mod check;
mod cycles;
mod description;
mod global;
mod layout;
mod number;
mod once;
mod orbit;
mod outcome;
mod periodic;
mod read;
mod scene;
mod sweep;
mod tangency;
mod trade;
mod windows;

pub use atlas::*;
pub use audit::*;
pub use bifurcation::*;
pub use chaos::*;
pub use check::*;
pub use cycles::*;
pub use description::*;
pub use global::*;
pub use layout::{one_a_line, write_orbit};
pub use number::{Bounds, Decimal, Written, bounds};
pub use orbit::*;
pub use outcome::*;
pub use periodic::*;
pub use read::Place;
pub use read::{value, values};
pub use scene::{ExcitationDocument, SceneDocument, StartDocument};
pub use sweep::*;
pub use tangency::*;
pub use trade::*;
pub use windows::*;

/// Returns name and version of this program.
pub const PROGRAM: &str = concat!("impact-pair ", env!("CARGO_PKG_VERSION"));
