//! One panel or a sheet of them, with caption and legend.

use anyhow::Result;
use impact_pair::Scene;
use impact_pair::certificate::document::PROGRAM;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::arguments::{Panel, PlotArguments};
use super::frame::Frame;
use super::panel::{self, FONT, Style};
use super::symbols;
use super::trace::Trace;
use crate::heading;
use crate::picture::{self, Canvas, Dots, Drawn, LETTER, SCALE, greek, words};

/// The sizes of a panel that stands alone, and of one on a sheet, as they are shown.
const ALONE: (i32, i32) = (900, 560);
const TOGETHER: (i32, i32) = (560, 400);
/// The distance of the lines of the caption, and the margin around it.
const LINE: i32 = 23 * SCALE;
const MARGIN: i32 = 16 * SCALE;

/// A picture of a trace.
pub struct Sheet<'s> {
    pub scene: &'s Scene,
    pub trace: &'s Trace,
    pub arguments: &'s PlotArguments,
    pub style: Style,
    /// What is certified, in one line.
    pub verdict: String,
}

impl Sheet<'_> {
    pub fn svg(&self) -> Result<String> {
        // Whether there are boxes wide enough to be seen, and the legend has to explain them, the drawing tells.
        let (svg, has_boxes) = self.drawn(true)?;
        if has_boxes { Ok(svg) } else { Ok(self.drawn(false)?.0) }
    }

    /// The picture, with or without boxes in its legend, and whether there are any in its panels.
    fn drawn(&self, explains_boxes: bool) -> Result<(String, bool)> {
        let panels = self.arguments.panels();
        let columns = if panels.len() == 1 { 1 } else { 2 };
        let (width, height) = if columns == 1 { ALONE } else { TOGETHER };
        let rows = panels.len().div_ceil(columns);
        let whole = SCALE * width * columns as i32;
        let caption = self.caption(whole - 2 * MARGIN);
        let head = MARGIN + LINE * caption.len() as i32;
        let entries = symbols::entries(self.trace, &panels, explains_boxes);
        let (legend, lines) = symbols::lay_out(&entries, self.style, whole - 2 * MARGIN);
        let top = head + lines * symbols::LINE + MARGIN / 2;
        let size = (whole / SCALE, top / SCALE + height * rows as i32);
        let (mut dots, mut has_boxes) = (Vec::new(), false);
        let mut svg = picture::svg((size.0 as u32, size.1 as u32), SCALE, |root| {
            write(&caption, root)?;
            for (entry, (x, y)) in legend {
                symbols::draw(entry, self.style, root, (MARGIN + x, head + y))?;
            }
            let (_, below) = root.split_vertically(top);
            for (&panel, area) in panels.iter().zip(below.split_evenly((rows, columns))) {
                let frame = Frame::new(panel, self.trace, self.cycles(panel));
                has_boxes |= panel::draw(&frame, self.style, (root, &area), &mut dots)?;
            }
            Ok(())
        })?;
        dots.iter().for_each(|dots: &Dots| dots.append_to(&mut svg));
        Ok((svg, has_boxes))
    }

    fn cycles(&self, panel: Panel) -> u32 {
        if panel.is_of_time() { self.arguments.cycles } else { self.arguments.orbit_cycles }
    }

    /// Title, parameters, start, what is certified, and the program; each in lines of this width.
    fn caption(&self, width: i32) -> Vec<String> {
        let scene = self.scene;
        let excitation = scene.pair().excitation();
        let of_what = match excitation.only() {
            Some(_) => String::new(),
            None => format!("; cycles and phases of W = {}", excitation.reference().frequency()),
        };
        let data = greek(&format!("{}; {}{of_what}", heading::parameters(scene), heading::start(scene)));
        let said = format!("{}; {PROGRAM}", self.verdict);
        let title = scene.title().map(str::to_owned);
        let letters = (f64::from(width) / (LETTER * f64::from(FONT))) as usize;
        title.into_iter().chain([data, said]).flat_map(|text| wrapped(&text, letters)).collect()
    }
}

fn write(caption: &[String], root: &Canvas<'_>) -> Drawn {
    for (line, text) in caption.iter().enumerate() {
        let place = (MARGIN, MARGIN + LINE / 2 + LINE * line as i32);
        root.draw(&Text::new(text.clone(), place, words(FONT, &BLACK, HPos::Left)))?;
    }
    Ok(())
}

/// The words in lines of at most so many letters, as far as a word fits.
fn wrapped(text: &str, letters: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut().filter(|line| line.chars().count() + 1 + word.chars().count() <= letters) {
            Some(line) => *line = format!("{line} {word}"),
            None => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_break_between_words() {
        assert_eq!(wrapped("A = 8, Ω = π, d = 9", 8), ["A = 8, Ω", "= π, d =", "9"]);
        assert_eq!(wrapped("incomprehensible", 5), ["incomprehensible"]);
    }
}
