//! Results as documents of [`crate::json`], and as text.

mod bifurcation;
mod chaos;
mod conclusion;
mod cycles;
mod ending;
mod event;
mod global;
mod orbit;
mod periodic;
mod shares;
mod tangency;
mod two_impact;
mod windows;

pub use bifurcation::bifurcations;
pub use chaos::{bases, bounds_text, cells, chaos, trap, wall_words, with_hyperbolic};
pub(crate) use chaos::{entropy, period};
pub use conclusion::{Conclusion, counted};
pub use cycles::cycles;
pub use ending::Ending;
pub use event::{Bounds, Event, Events};
pub use global::global;
pub use impact_pair_model::EventKind;
pub use orbit::{arithmetic, arithmetic_at_first, follow, head, is_certified, orbit};
pub use tangency::{at_least, tangency};
pub use two_impact::{manifolds, two_impact, word};
pub use windows::windows;

#[cfg(test)]
mod tests;
