//! Points of a grid, kept on disk as they are finished: what sweeps and atlases have in common, in the command line and in Python.

mod axes;
mod columns;
mod head;
mod journal;
mod merge;
mod record;
mod schedule;
mod survey;

pub use axes::{Grid, MOST_POINTS, axis};
pub(crate) use axes::{axes, written};
pub use columns::{Cell, Kind, doubles};
pub use head::{Head, Line};
pub use journal::{Points, beside};
pub use record::line;
pub use schedule::complete;
pub use survey::{Survey, Tally};
