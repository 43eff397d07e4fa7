//! One orbit after another over a grid of parameters or initial data: bifurcation diagrams, exponents, basins.
//!
//! A [`Grid`] has exact points; at each of them [`follow`] certifies one orbit and its outcome: a [`Point`]. Points are independent, so they may
//! be computed in any order, by any number of threads.
//!
//! All points have the same units: phases, cycles and exponents are of one term of the excitation, [`Grid::reference`], also where another term
//! is the fastest.

mod attraction;
mod columns;
mod document;
mod grid;
mod kinds;
mod lines;
mod point;
mod unit;
mod window;

pub use attraction::Attraction;
pub use columns::{Cell, Kind, Table, columns, csv_head, csv_line, csv_names, csv_rows, doubles, rows};
pub(crate) use document::axes;
pub(crate) use document::written;
pub use document::{exponent, limit};
pub use document::{grid, head, record};
pub use grid::{Grid, MOST_POINTS, axis};
pub use kinds::{Kinds, PointKind};
pub use lines::{Head, Line};
pub use point::{MOST_IMPACTS, Point, PointSettings, follow};
pub use unit::Lasting;
