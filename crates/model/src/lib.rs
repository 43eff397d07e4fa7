//! The horizontal impact pair in exact numbers: the input of every computation.
//!
//! The pair of figure 1 with its excitation (1), (9), the start, the mappings P1-P4 (24)-(27) and words of mappings, the
//! settings of an orbit, and the scene file that specifies them all. Parameters are exact reals or intervals of values; nothing is
//! rounded. The library that computes and the crate that checks certificates share only this crate.

mod effort;
mod error;
mod event;
mod excerpt;
mod excitation;
pub mod mapping;
mod pair;
mod period;
pub mod scene;
mod settings;
mod start;
pub mod vocabulary;
pub mod watch;

pub use effort::Effort;
pub use error::{Error, ErrorKind, within};
pub use event::{EventKind, Miss};
pub use excerpt::Excerpt;
pub use excitation::{Excitation, Harmonic};
pub use mapping::{Mapping, Word};
pub use pair::{ImpactPair, Wall};
pub use period::Period;
pub use scene::Scene;
pub use settings::{Arithmetic, BITS, INARI, MAX_BITS, Settings, require_digits};
pub use start::{Place, Start};
