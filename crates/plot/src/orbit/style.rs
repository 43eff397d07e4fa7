//! Colours and letters of panels.

use impact_pair::pair::Wall;
use plotters::style::RGBColor;

use crate::picture::{BLUE, GREEN, GREY, SCALE, VERMILION};

/// Heights of letters.
pub const FONT: i32 = 17 * SCALE;

/// The colours of a trace.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// True if the trace is certified: a non-rigorous one has its own colour.
    pub is_certified: bool,
    /// The first N impacts are the transient, which is grey.
    pub transient: usize,
}

impl Style {
    /// Returns the colour of curves after N impacts.
    pub fn curve(self, impacts: usize) -> RGBColor {
        match (impacts < self.transient, self.is_certified) {
            (true, _) => GREY,
            (false, true) => BLUE,
            (false, false) => VERMILION,
        }
    }

    /// Returns the colour of the impact on a wall that N others precede.
    pub fn impact(self, wall: Wall, impacts: usize) -> RGBColor {
        match (self.curve(impacts), wall) {
            (BLUE, Wall::Right) => GREEN,
            (colour, _) => colour,
        }
    }
}
