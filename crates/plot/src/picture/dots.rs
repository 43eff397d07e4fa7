//! Thousands of points as a few SVG paths, translucent, so that density shows as darkness.

use std::collections::BTreeSet;
use std::fmt::Write;

use plotters::style::RGBColor;

use super::{Element, SCALE, hex};

/// Points of one colour, in pixels of the canvas.
#[derive(Clone, Debug)]
pub struct Dots {
    /// Colour of the points.
    pub colour: RGBColor,
    /// Places of the points on the canvas \[pixels\].
    pub places: Vec<(i32, i32)>,
}

/// Diameter of a dot where dots are many and where dots are few.
const DOT_DIAMETER: i32 = 2 * SCALE;
const LARGE_DOT_DIAMETER: i32 = 9 * SCALE / 2;
const LARGE_DOTS_UP_TO: usize = 100;
/// Number of paths among which dots are dealt, and the opacity of a path: dots within a path do not darken each other.
const LAYERS: usize = 6;
const OPACITY: f64 = 0.55;
/// Number of dots from which on places are rounded to half a pixel of the picture, lest the file be too large.
const ROUNDED_FROM: usize = 20_000;

impl Dots {
    /// Whether there are enough different places to show density.
    fn are_many(&self) -> bool {
        self.places.iter().collect::<BTreeSet<_>>().len() > LARGE_DOTS_UP_TO
    }

    /// The dots as an element.
    pub fn element(&self) -> Element {
        let many = self.are_many();
        let (layers, width, opacity) =
            if many { (LAYERS, DOT_DIAMETER, OPACITY) } else { (1, LARGE_DOT_DIAMETER, 1.0) };
        let grain = if self.places.len() > ROUNDED_FROM { SCALE / 2 } else { 1 };
        let mut group = format!(
            "<g fill=\"none\" stroke=\"{}\" stroke-width=\"{width}\" stroke-linecap=\"round\" stroke-opacity=\"{opacity}\">",
            hex(self.colour)
        );
        for layer in 0..layers {
            let dealt = self.places.iter().skip(layer).step_by(layers);
            let places: BTreeSet<(i32, i32)> = dealt.map(|(x, y)| (x / grain * grain, y / grain * grain)).collect();
            if !places.is_empty() {
                // Writing to a String cannot fail.
                let _ = write!(group, "<path d=\"{}\"/>", data(places));
            }
        }
        group.push_str("</g>");
        Element(group)
    }
}

/// The data of a path of dots: lines of length zero, each relative to the dot before.
fn data(places: BTreeSet<(i32, i32)>) -> String {
    let (mut data, mut at) = (String::new(), (0, 0));
    for (x, y) in places {
        let down = y - at.1;
        // Writing to a String cannot fail.
        let _ = write!(data, "m{}{}{down}h0", x - at.0, if down < 0 { "" } else { " " });
        at = (x, y);
    }
    data
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_dots_are_one_opaque_path() {
        let dots = Dots { colour: RGBColor(0, 1, 255), places: vec![(30, 4), (1, 2), (1, 2)] };
        let Element(svg) = dots.element();
        assert!(svg.contains("stroke=\"#0001FF\" stroke-width=\"18\""), "{svg}");
        assert!(svg.ends_with("stroke-opacity=\"1\"><path d=\"m1 2h0m29 2h0\"/></g>"), "{svg}");
    }

    #[test]
    fn many_dots_are_darker_where_they_lie_on_each_other() {
        let spread = (0..300).map(|i| (10 * i, 7 * i));
        let heap = (0..300).map(|_| (5, 5));
        let Element(svg) =
            Dots { colour: RGBColor(0, 0, 0), places: spread.zip(heap).flat_map(|(a, b)| [a, b]).collect() }.element();
        assert_eq!(svg.matches("<path").count(), LAYERS);
        // In all layers to which the coinciding dots are dealt.
        let paths = svg.split("<path").skip(1);
        assert_eq!(paths.filter(|path| path.contains("m5 5h0") || path.contains("m5 5")).count(), LAYERS / 2);
    }
}
