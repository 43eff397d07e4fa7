//! The lines that explain the marks of a picture.

use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::{Canvas, FONT, LETTER_WIDTH, SCALE, letters, words};

/// Height of a line of a legend.
const LINE_HEIGHT: i32 = 22 * SCALE;

/// The symbol of an entry of a legend.
#[derive(Clone, Copy, Debug)]
pub enum LegendSymbol {
    /// A filled area.
    Cell(RGBColor),
    /// A ring.
    Ring,
    /// Small dots.
    Dot(RGBColor),
    /// A line of this width.
    Line(RGBColor, i32),
    /// The outline of an area.
    Outline(RGBColor),
}

/// Half the width of a mark.
const HALF_MARK: i32 = 5 * SCALE;

/// Draws the entries of a legend below `top`, in as many lines as needed; returns its height.
///
/// # Errors
/// Returns an error if the legend cannot be drawn.
pub fn legend(
    root: &Canvas<'_>,
    top: i32,
    entries: &[(LegendSymbol, String)],
) -> Result<i32, Box<dyn std::error::Error>> {
    let (left, right) = (24 * SCALE, root.dim_in_pixel().0 as i32 - 16 * SCALE);
    let (mut x, mut line) = (left, 0);
    for (mark, name) in entries {
        let width = 3 * HALF_MARK + (LETTER_WIDTH * f64::from(FONT) * letters(name)) as i32;
        if x > left && x + width > right {
            (x, line) = (left, line + 1);
        }
        let y = top + LINE_HEIGHT * line + LINE_HEIGHT / 2;
        mark.draw(root, (x + HALF_MARK, y))?;
        root.draw(&Text::new(name.clone(), (x + 3 * HALF_MARK, y), words(FONT, &BLACK, HPos::Left)))?;
        x += width + 24 * SCALE;
    }
    Ok(if entries.is_empty() { 0 } else { LINE_HEIGHT * (line + 1) })
}

impl LegendSymbol {
    fn draw(self, root: &Canvas<'_>, (x, y): (i32, i32)) -> Result<(), Box<dyn std::error::Error>> {
        let thin = |colour: RGBColor| colour.stroke_width(3 * SCALE as u32 / 2);
        match self {
            Self::Cell(colour) => root.draw(&Rectangle::new(
                [(x - HALF_MARK, y - HALF_MARK), (x + HALF_MARK, y + HALF_MARK)],
                colour.filled(),
            ))?,
            Self::Ring => root.draw(&Circle::new((x, y), HALF_MARK, BLACK.stroke_width(SCALE as u32)))?,
            Self::Dot(colour) => {
                for (right, down) in [(-4, 2), (0, -3), (4, 1)] {
                    root.draw(&Circle::new((x + right * SCALE, y + down * SCALE), SCALE, colour.filled()))?;
                }
            }
            Self::Line(colour, width) => {
                let ends = [(x - 2 * HALF_MARK, y), (x + HALF_MARK, y)];
                root.draw(&PathElement::new(ends, colour.stroke_width(width as u32)))?;
            }
            Self::Outline(colour) => {
                let (a, b) = (HALF_MARK, 4 * SCALE);
                let round = [(-a, b), (a - b, b), (a, -b), (b - a, -b), (-a, b)];
                root.draw(&PathElement::new(round.map(|(right, down)| (x + right, y + down)), thin(colour)))?;
            }
        }
        Ok(())
    }
}
