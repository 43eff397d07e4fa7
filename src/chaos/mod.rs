//! Chaos, proved: trapping regions with all cycles in them, and horseshoes with a lower bound of their topological entropy.
//!
//! Floating point approximates in `bases`, `bundles`, `everywhere`, `guess`, `index`, `leaves`, `propose` and `trials`; intervals verify
//! in `flights`, `tube`, `words`, `strips`, `hyperbolic`, `trap`, `box_map`, `boxes`, `language`, `cycles` and `attracted`.
//! The impact map is *reduced* here: every impact is mirrored to the left wall (Lemma R2), a state is a phase in forcing periods and
//! the speed before the impact over `A W`, and only `D = d/A` and `e` are left. Lemmas D1-D15, D20-D23 and D33
//! of `docs/proofs/chaos.md#D1`, D24-D28 and D30-D32 of `docs/proofs/hyperbolic.md#D24`.

mod asymptotics;
mod attracted;
mod bases;
mod blocks;
mod box_map;
mod boxes;
mod bundles;
mod cells;
mod cycles;
mod document;
mod entropy;
mod everywhere;
mod flights;
mod frame;
mod global;
mod guess;
mod horseshoe;
mod hyperbolic;
mod index;
mod itinerary;
mod language;
mod law;
mod leaves;
mod propose;
mod quad;
mod refusal;
mod region;
mod scene;
mod seen;
mod stable;
mod strips;
#[cfg(test)]
mod tests;
mod trap;
mod trials;
mod tried;
mod tube;
mod vector;
mod windows;
mod words;

pub use asymptotics::{Asymptotics, Entered};
pub use blocks::Word;
pub use box_map::{BoxImage, BoxMap, Rectangle, Unmapped};
pub use cells::{Cells, MOST_CELLS, RangeSettings, Stretch, Verdict, seen_impacts};
pub use cycles::{Cycle, Cycles, MOST_IMPACTS};
pub use document::{entropy, period};
pub(crate) use flights::Flights;
pub use global::{
    Basin, BasinOutcome, Class, Global, GlobalSettings, Kind, LimitCycle, OpenReason, Patch, Recurrence, RestCycle,
};
pub(crate) use guess::{Guess, Image};
pub use horseshoe::{Chaos, Horseshoe, HorseshoeSettings};
pub use hyperbolic::{Cone, Hyperbolic, HyperbolicSet, LeftOut, why_left_out};
pub use language::{BoxGraph, MOST_COUNTED, Unclosed, WallWords};
pub(crate) use law::{Law, Side};
pub(crate) use quad::Quad;
pub use quad::{Chord, State};
pub use refusal::NoTrap;
pub use region::Trap;
pub use stable::stable_orbits;
pub use strips::{Moved, Strip};
pub use tried::MOST_DEPTH;
pub use windows::{
    FoundWindow, MOST_WINDOW_IMPACTS, UnprovedWindow, WINDOW_PARAMETERS, WindowSettings, Windows, is_window_range,
};
pub use words::HSet;
