//! Points of a grid, kept on disk as they are finished: what sweeps and atlases have in common, in the command line and in Python.

mod journal;
mod record;
mod schedule;

pub use journal::{Journal, beside, difference};
pub use record::{line, own};
pub use schedule::{Task, complete};
