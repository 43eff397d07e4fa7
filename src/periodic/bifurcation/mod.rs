//! Bifurcations over a parameter, proved: equations (39), (40) and grazes, and the cascade of doublings.
//!
//! Floating point follows each branch by pseudo-arclength (`follow`) and notes where an eigenvalue passes 1 or -1 or a wall is touched. There
//! the extended system (`system`) with the parameter among its unknowns is solved (`solve`) and its zero proved by Krawczyk's operator
//! (`claim`). At an eigenvalue -1 the branch that leaves is followed as well: a symmetric orbit's pitchfork is the doubling of half its period.
//! Several harmonics with a common period are treated alike (`family`). The windows of stable orbits are proved in `window`. Lemmas Y1-Y9 are in
//! `docs/proofs/bifurcations.md#Y1`.

mod between;
mod branch;
mod cascade;
mod claim;
mod diagram;
mod document;
mod family;
mod follow;
mod jet;
mod over;
mod point;
mod ring;
mod solve;
mod starts;
mod system;
mod trace;
mod tube;
mod window;

pub use branch::WindowSeed;
pub use cascade::survey;
pub use diagram::{Branch, BranchEnd, Diagram, DiagramSettings, Unproved};
pub(crate) use jet::Jet;
pub use over::{PARAMETERS, is_parameter, over};
pub use point::{Kind, Point};
pub use window::{NoWindow, Window, WindowEnd};
