//! Rectangles of one colour as one SVG path.

use std::fmt::Write;

use plotters::style::RGBColor;

use crate::picture::hex;

#[derive(Default)]
pub struct Cells(String);

impl Cells {
    /// Adds a rectangle, from its upper left corner.
    pub fn add(&mut self, (x, y): (i32, i32), (width, height): (i32, i32)) {
        // Writing to a String cannot fail.
        let _ = write!(self.0, "M{x} {y}h{width}v{height}h-{width}z");
    }

    pub fn element(&self, colour: RGBColor) -> String {
        format!("<path shape-rendering=\"crispEdges\" fill=\"{}\" d=\"{}\"/>\n", hex(colour), self.0)
    }
}
