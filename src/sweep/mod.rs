//! One orbit after another over a grid of parameters or initial data: bifurcation diagrams, exponents, basins.
//!
//! A [`Grid`] has exact points; at each of them [`follow`] certifies one orbit and says what is proved of its future:
//! a [`Point`]. Points do not know of each other, so they may be computed in any order, by any number of threads.

mod document;
mod grid;
mod point;

pub use document::{head, record};
pub use grid::{Axis, Grid, MOST_POINTS};
pub use point::{Asked, Attraction, Point, State, follow};
