//! The fate of every motion, over the plane of two parameters: at the points of a grid, or for all parameters of cells.
//!
//! A [`Plane`] has exact points, or cells whose parameters are intervals between exact values. A [`record`] holds the global analysis
//! ([`crate::chaos::Global`]) of one point or tile. Points and tiles are independent, so they may be computed in any order.

mod columns;
mod document;
mod plane;
mod point;
#[cfg(test)]
mod tests;

pub use columns::{columns, csv_head, csv_rows, rows};
pub use document::{Shares, head};
pub use plane::{Plane, Rectangle};
pub use point::record;
