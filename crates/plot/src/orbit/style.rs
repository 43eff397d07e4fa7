//! Colours and letters of panels.

use impact_pair::pair::Wall;
use plotters::style::RGBColor;

use crate::picture::{BLUE, GREEN, GREY, SCALE, VERMILION};

/// Font size.
pub const FONT: i32 = 17 * SCALE;

/// The colours of a trace.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// True if the trace is certified: a non-rigorous trace has its own colour.
    pub is_certified: bool,
    /// Number of impacts of the transient, which is grey.
    pub transient: usize,
}

impl Style {
    /// The colour of curves after `impacts` impacts.
    pub fn curve(self, impacts: usize) -> RGBColor {
        match (impacts < self.transient, self.is_certified) {
            (true, _) => GREY,
            (false, true) => BLUE,
            (false, false) => VERMILION,
        }
    }

    /// The colour of the impact on a wall after `impacts` other impacts.
    pub fn impact(self, wall: Wall, impacts: usize) -> RGBColor {
        match (self.curve(impacts), wall) {
            (BLUE, Wall::Right) => GREEN,
            (colour, _) => colour,
        }
    }
}
