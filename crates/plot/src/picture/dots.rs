//! Thousands of points as one SVG path: an element for each of them would be ten times as long.

use std::fmt::Write;

use plotters::style::RGBColor;

use super::{SCALE, hex, on_top};

/// What stands at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A disc.
    Dot,
    /// A cross.
    Cross,
}

/// Points of one shape and colour, in pixels of the canvas.
#[derive(Clone, Debug)]
pub struct Dots {
    /// Their shape.
    pub shape: Shape,
    /// Their colour.
    pub colour: RGBColor,
    /// Where they are.
    pub places: Vec<(i32, i32)>,
}

/// Diameter of a dot, arm of a cross, and how thick that is; twice as much where points are so few.
const DOT: i32 = 9 * SCALE / 4;
const ARM: i32 = 7 * SCALE / 4;
const LINE: i32 = SCALE / 2;
const FEW: usize = 100;

impl Dots {
    fn enlarged(&self) -> i32 {
        if self.places.len() > FEW { 1 } else { 2 }
    }

    /// Puts them on top of a picture.
    pub fn append_to(&self, svg: &mut String) {
        if self.places.is_empty() {
            return;
        }
        let (width, cap) = match self.shape {
            Shape::Dot => (DOT * self.enlarged(), "round"),
            Shape::Cross => (LINE * self.enlarged(), "butt"),
        };
        let colour = hex(self.colour);
        let mut path =
            format!("<path fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linecap=\"{cap}\" d=\"");
        let arm = ARM * self.enlarged();
        for &(x, y) in &self.places {
            // Writing to a string does not fail.
            let _ = match self.shape {
                Shape::Dot => write!(path, "M{x} {y}h0"),
                Shape::Cross => {
                    let (left, top, size) = (x - arm, y - arm, 2 * arm);
                    write!(path, "M{left} {y}h{size}M{x} {top}v{size}")
                }
            };
        }
        path.push_str("\"/>\n");
        on_top(svg, &path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_holds_all_points_and_the_picture_ends_as_before() {
        let mut svg = "<svg>\n</svg>\n".to_owned();
        Dots { shape: Shape::Dot, colour: RGBColor(0, 1, 255), places: vec![(1, 2), (30, 4)] }.append_to(&mut svg);
        Dots { shape: Shape::Cross, colour: RGBColor(0, 0, 0), places: vec![(100, 200)] }.append_to(&mut svg);
        Dots { shape: Shape::Cross, colour: RGBColor(0, 0, 0), places: Vec::new() }.append_to(&mut svg);
        assert!(svg.contains("stroke=\"#0001FF\" stroke-width=\"18\" stroke-linecap=\"round\" d=\"M1 2h0M30 4h0\"/>"));
        assert!(svg.contains("d=\"M86 200h28M100 186v28\"/>\n</svg>\n"), "{svg}");
        assert_eq!(svg.matches("<path").count(), 2);
    }
}
