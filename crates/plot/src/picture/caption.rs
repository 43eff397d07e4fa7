//! The header of a picture: its title, and lines that describe its content.

use impact_pair::json::PROGRAM;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::{Canvas, LETTER_WIDTH, Look, SCALE, letters, words};

/// Font size.
pub const FONT: i32 = 15 * SCALE;
const TITLE_HEIGHT: i32 = FONT + 3 * SCALE;
/// Distance of the text from the left edge, and from the upper edge.
const MARGIN: i32 = 16 * SCALE;
const TOP_MARGIN: i32 = 7 * SCALE;
const LINE_HEIGHT: i32 = 22 * SCALE;

/// Draws a title and lines below it, wrapped to the width of the picture, unless the picture has no header; returns their
/// height.
///
/// # Errors
/// Returns an error if the text cannot be drawn.
pub fn caption(
    root: &Canvas<'_>,
    look: &Look,
    title: &str,
    lines: &[String],
) -> Result<i32, Box<dyn std::error::Error>> {
    if look.no_header {
        return Ok(TOP_MARGIN);
    }
    let width = f64::from(root.dim_in_pixel().0 as i32 - 2 * MARGIN);
    let sized = [(title, TITLE_HEIGHT)].into_iter().chain(lines.iter().map(|line| (line.as_str(), FONT)));
    let wrap = |(text, size): (&str, i32)| {
        wrapped(text, width / (LETTER_WIDTH * f64::from(size))).into_iter().map(move |line| (line, size))
    };
    let mut top = TOP_MARGIN;
    for (text, size) in sized.flat_map(wrap) {
        root.draw(&Text::new(text, (MARGIN, top + LINE_HEIGHT / 2), words(size, &BLACK, HPos::Left)))?;
        top += LINE_HEIGHT;
    }
    Ok(top)
}

/// The program's name and version, joined by a space that does not break.
pub fn program() -> String {
    PROGRAM.replace(' ', "\u{a0}")
}

/// Wraps words into lines of at most `most` letters, as far as a word fits; mathematics continues in the next line.
pub fn wrapped(text: &str, most: f64) -> Vec<String> {
    let width = |text: &str| letters(&text.replace('$', ""));
    let mut lines: Vec<String> = Vec::new();
    let mut is_math = false;
    for word in text.split(' ').filter(|word| !word.is_empty()) {
        match lines.last_mut().filter(|line| width(line) + 1.0 + width(word) <= most) {
            Some(line) => *line = format!("{line} {word}"),
            None => {
                if let Some(line) = lines.last_mut().filter(|_| is_math) {
                    line.push('$');
                }
                lines.push(format!("{}{word}", if is_math { "$" } else { "" }));
            }
        }
        is_math ^= word.matches('$').count() % 2 == 1;
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_break_between_words() {
        assert_eq!(wrapped("A = 8, Ω = π, d = 9", 8.0), ["A = 8, Ω", "= π, d =", "9"]);
        assert_eq!(wrapped("$A = 8, d = 9$; more", 6.0), ["$A = 8,$", "$d = 9$;", "more"]);
        assert_eq!(wrapped("incomprehensible", 5.0), ["incomprehensible"]);
    }
}
