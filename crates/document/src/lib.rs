//! The JSON documents of impact-pair: one struct per document, which writes and reads it.
//!
//! Bounds are decimal strings rounded outward: the true value lies in `[lower, upper]`. Fields are written in the order of
//! their declaration. Each document names its schema in its first field; `docs/schemas` holds the JSON Schemas.
//!
//! ```
//! use impact_pair_document::{OrbitDocument, value};
//!
//! let text = r#"{"schema": "impact-pair/orbit/1", "program": "impact-pair 0.1.0", "scene": {"excitation": {"amplitude": ["0"],
//!   "frequency": ["1"], "phase": ["0"]}, "gap": "2", "restitution": "0.5", "start": {"time": "0", "wall": "left", "velocity": "-2"}},
//!   "certified": true, "arithmetic": {"kind": "interval", "bits": 53}, "outcome": {"kind": "impacts-reached", "message": "1 impact",
//!   "impacts": 1}, "events": [{"event": "impact", "index": 1, "mapping": "P2", "wall": "right", "time": ["1.99", "2.01"],
//!   "velocity": ["0.99", "1.01"]}]}"#;
//! let orbit: OrbitDocument = serde_json::from_str(text)?;
//! let [low, high] = &*orbit.events[0].time;
//! assert_eq!((low.text(), high.text()), ("1.99", "2.01"));
//!
//! // A key that is there twice is refused: readers differ in which of its values they take.
//! assert!(value(&text.replacen("{", r#"{"program": "another","#, 1)).is_err());
//! # Ok::<(), serde_json::Error>(())
//! ```

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
mod strict;
mod sweep;
mod tangency;
mod trade;
mod windows;
mod witness;

pub use atlas::*;
pub use audit::*;
pub use bifurcation::*;
pub use chaos::*;
pub use check::*;
pub use cycles::*;
pub use description::*;
pub use global::*;
#[doc(inline)]
pub use impact_pair_model::vocabulary;
pub use layout::{one_a_line, write_orbit};
pub use number::{Between, Bounds, Decimal, NotNegative, UpTo, Written, bounds};
pub use orbit::*;
pub use outcome::*;
pub use periodic::*;
pub use read::Place;
pub use read::{read, value, values};
pub use scene::{ExcitationDocument, SceneDocument, StartDocument};
pub use sweep::*;
pub use tangency::*;
pub use trade::*;
pub use windows::*;
pub use witness::*;

/// Returns name and version of this program.
pub const PROGRAM: &str = concat!("impact-pair ", env!("CARGO_PKG_VERSION"));
