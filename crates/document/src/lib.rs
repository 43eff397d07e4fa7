//! The documents: what is handed on as JSON, a struct each, which writes it and reads it back.
//!
//! Bounds are decimal strings rounded outward: the truth lies in `[lower, upper]`. Fields are written in the order in which
//! they stand here. Each kind has a schema, named in its first field; `docs/schemas` holds them as JSON Schemas.

mod audit;
mod bifurcation;
mod chaos;
mod check;
mod cycles;
mod layout;
mod number;
mod orbit;
mod outcome;
mod periodic;
mod read;
mod scene;
mod sweep;
mod trade;

pub use audit::*;
pub use bifurcation::*;
pub use chaos::*;
pub use check::*;
pub use cycles::*;
pub use layout::{one_a_line, write_orbit};
pub use number::{Bounds, Decimal, Written, bounds};
pub use orbit::*;
pub use outcome::*;
pub use periodic::*;
pub use read::Place;
pub use read::{value, values};
pub use scene::{ExcitationDocument, SceneDocument, StartDocument};
pub use sweep::*;
pub use trade::*;

/// The program that certifies.
pub const PROGRAM: &str = concat!("impact-pair ", env!("CARGO_PKG_VERSION"));
