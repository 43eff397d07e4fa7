//! Thousands of points as one SVG path: an element for each of them would be ten times as long.

use std::fmt::Write;

use plotters::style::RGBColor;

use super::SCALE;

/// What stands at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    Dot,
    Cross,
}

/// Points of one shape and colour, in pixels of the canvas.
#[derive(Clone, Debug)]
pub struct Dots {
    pub shape: Shape,
    pub colour: RGBColor,
    pub places: Vec<(i32, i32)>,
}

/// Diameter of a dot, and arm of a cross.
const DOT: i32 = 9 * SCALE / 4;
const ARM: i32 = 7 * SCALE / 4;

impl Dots {
    /// Puts them on top of a picture.
    pub fn append_to(&self, svg: &mut String) {
        if self.places.is_empty() {
            return;
        }
        let end = svg.rfind("</svg>").unwrap_or(svg.len());
        let rest = svg.split_off(end);
        let RGBColor(r, g, b) = self.colour;
        let (width, cap) = match self.shape {
            Shape::Dot => (DOT, "round"),
            Shape::Cross => (SCALE / 2, "butt"),
        };
        // Writing to a string does not fail.
        let _ = write!(
            svg,
            "<path fill=\"none\" stroke=\"#{r:02X}{g:02X}{b:02X}\" stroke-width=\"{width}\" stroke-linecap=\"{cap}\" d=\""
        );
        for &(x, y) in &self.places {
            let _ = match self.shape {
                Shape::Dot => write!(svg, "M{x} {y}h0"),
                Shape::Cross => {
                    let (left, top, size) = (x - ARM, y - ARM, 2 * ARM);
                    write!(svg, "M{left} {y}h{size}M{x} {top}v{size}")
                }
            };
        }
        svg.push_str("\"/>\n");
        svg.push_str(&rest);
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
        assert!(svg.contains("stroke=\"#0001FF\" stroke-width=\"9\" stroke-linecap=\"round\" d=\"M1 2h0M30 4h0\"/>"));
        assert!(svg.contains("d=\"M93 200h14M100 193v14\"/>\n</svg>\n"), "{svg}");
        assert_eq!(svg.matches("<path").count(), 2);
    }
}
