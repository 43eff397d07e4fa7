//! Common parts of all pictures: the canvas, colours, words, axes, and the output file.

mod arc;
mod axis;
mod caption;
mod dots;
mod file;
mod hull;
mod legend;
mod look;
mod math;
mod path;
mod plane;
mod svg;
mod theme;

use std::error::Error as StdError;

use anyhow::{Result, anyhow};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

pub use arc::Arc;
pub use axis::Axis;
pub use caption::{FONT, caption, program, wrapped};
pub use dots::Dots;
pub use file::{encoded, path};
pub use hull::hull;
pub use legend::{LegendSymbol, legend};
pub use look::Look;
pub use math::{greek, letters, typeset_text};
pub use path::{Path, Place, hermite};
pub use plane::Plane;
pub use svg::{Element, Svg};
pub use theme::Theme;

/// Pixels of the canvas for each pixel of the picture: the backend rounds to whole pixels.
pub const SCALE: i32 = 4;
/// Average width of a letter, relative to the font size; the reader's fonts are unknown.
pub const LETTER_WIDTH: f64 = 0.44;

// Colours that Okabe and Ito (2008) chose for colour-blind readers, and grey; lines, shapes and words repeat the information.
/// Blue.
pub const BLUE: RGBColor = RGBColor(0x00, 0x72, 0xb2);
/// Vermilion.
pub const VERMILION: RGBColor = RGBColor(0xd5, 0x5e, 0x00);
/// Bluish green.
pub const GREEN: RGBColor = RGBColor(0x00, 0x9e, 0x73);
/// Orange.
pub const ORANGE: RGBColor = RGBColor(0xe6, 0x9f, 0x00);
/// Reddish purple.
pub const PURPLE: RGBColor = RGBColor(0xcc, 0x79, 0xa7);
/// Sky blue.
pub const SKY: RGBColor = RGBColor(0x56, 0xb4, 0xe9);
/// Yellow.
pub const YELLOW: RGBColor = RGBColor(0xf0, 0xe4, 0x42);
/// Grey.
pub const GREY: RGBColor = RGBColor(0x99, 0x99, 0x99);

/// A canvas that becomes SVG.
pub type Canvas<'a> = DrawingArea<Svg<'a>, plotters::coord::Shift>;
/// The result of drawing.
pub type Drawn = Result<(), Box<dyn StdError>>;

/// The SVG text of a drawing by `draw` on a white canvas of `scale` pixels for each pixel of the picture; `size` is the picture's size.
///
/// # Errors
/// Returns the errors of `draw`.
pub fn svg(size: (u32, u32), scale: i32, draw: impl FnOnce(&Canvas<'_>) -> Drawn) -> Result<String> {
    let mut text = String::new();
    {
        let root = Svg::new(&mut text, size, scale as u32).into_drawing_area();
        let all = root.fill(&WHITE).map_err(Box::from).and_then(|()| draw(&root));
        all.and_then(|()| root.present().map_err(Box::from)).map_err(|error: Box<dyn StdError>| anyhow!("{error}"))?;
    }
    Ok(text)
}

/// A colour in SVG's notation.
pub fn hex(RGBColor(red, green, blue): RGBColor) -> String {
    format!("#{red:02X}{green:02X}{blue:02X}")
}

/// Text style: font size, colour, horizontal alignment, and vertical centre at the text's place.
pub fn words<'a>(size: i32, colour: &'a RGBColor, side: HPos) -> TextStyle<'a> {
    TextStyle::from(("sans-serif", size).into_font()).color(colour).pos(Pos::new(side, VPos::Center))
}
