//! A panel or a sheet of panels, with caption and legend.

use anyhow::Result;
use impact_pair::Scene;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::frame::{Frame, Panel};
use super::panel;
use super::style::{FONT, Style};
use super::symbols;
use super::trace::Trace;
use crate::picture::{self, Canvas, Drawn, LETTER_WIDTH, Look, SCALE, greek, typeset_text, words, wrapped};

/// Sizes of a single panel, and of a panel on a sheet, in pixels of the picture.
const SINGLE_PANEL_SIZE: (i32, i32) = (900, 560);
const SHEET_PANEL_SIZE: (i32, i32) = (560, 400);
/// The distance of the lines of the caption, and the margin around it.
const LINE_HEIGHT: i32 = 23 * SCALE;
const MARGIN: i32 = 16 * SCALE;

/// A picture of a trace.
pub struct Sheet<'s> {
    /// The scene of the orbit.
    pub scene: &'s Scene,
    /// The trace that is drawn.
    pub trace: &'s Trace,
    /// The panels, in their order on the sheet.
    pub panels: Vec<Panel>,
    /// Cycles that the time panels show.
    pub cycles: u32,
    /// Cycles that the phase planes show.
    pub orbit_cycles: u32,
    /// The range of time that is magnified in the time panels \[time\].
    pub zoom: Option<[f64; 2]>,
    /// Colours of the trace.
    pub style: Style,
    /// The certified claim, in one line.
    pub verdict: String,
    /// The look of the picture.
    pub look: &'s Look,
}

impl Sheet<'_> {
    /// The picture as SVG.
    ///
    /// # Errors
    /// Returns an error if the picture cannot be drawn.
    pub fn svg(&self) -> Result<String> {
        // The drawing shows whether boxes are wide enough to be seen and so need an entry in the legend.
        let (svg, has_boxes) = self.drawn(true)?;
        if has_boxes { Ok(svg) } else { Ok(self.drawn(false)?.0) }
    }

    /// The picture, with or without boxes in its legend, and whether its panels have boxes.
    fn drawn(&self, explains_boxes: bool) -> Result<(String, bool)> {
        let frames = self.frames();
        let columns = if frames.len() == 1 { 1 } else { 2 };
        let (width, height) = if columns == 1 { SINGLE_PANEL_SIZE } else { SHEET_PANEL_SIZE };
        let rows = frames.len().div_ceil(columns);
        let whole = SCALE * self.look.size(((width * columns as i32) as u32, 0)).0 as i32;
        let caption = if self.look.no_header { Vec::new() } else { self.caption(whole - 2 * MARGIN) };
        let head = MARGIN + LINE_HEIGHT * caption.len() as i32;
        let entries = symbols::entries(self.trace, &self.panels, self.style, explains_boxes);
        let (legend, lines) = symbols::lay_out(&entries, self.style, whole - 2 * MARGIN);
        let top = head + lines * symbols::LINE_HEIGHT + MARGIN / 2;
        let own = ((whole / SCALE) as u32, (top / SCALE + height * rows as i32) as u32);
        let mut has_boxes = false;
        let svg = picture::svg(self.look.size(own), SCALE, |root| {
            write(&caption, root)?;
            for (entry, (x, y)) in legend {
                symbols::draw(entry, self.style, root, (MARGIN + x, head + y))?;
            }
            let (_, below) = root.split_vertically(top);
            for (frame, area) in frames.iter().zip(below.split_evenly((rows, columns))) {
                let magnified = frames.iter().find(|other| other.is_magnified && other.panel == frame.panel);
                let magnified = magnified.filter(|_| !frame.is_magnified);
                has_boxes |= panel::draw(frame, magnified, self.style, (root, &area))?;
            }
            Ok(())
        })?;
        Ok((svg, has_boxes))
    }

    /// The panels in their order; a magnified time panel follows the panel that it magnifies.
    fn frames(&self) -> Vec<Frame<'_>> {
        let shown = |panel: &Panel| {
            let cycles = if panel.is_of_time() { self.cycles } else { self.orbit_cycles };
            Frame::new(*panel, self.trace, cycles)
        };
        let Some(zoom) = self.zoom else { return self.panels.iter().map(shown).collect() };
        let (time, others): (Vec<Panel>, Vec<Panel>) = self.panels.iter().partition(|panel| panel.is_of_time());
        let magnified = time.iter().map(|panel| Frame::magnified(*panel, self.trace, zoom));
        time.iter().map(shown).chain(magnified).chain(others.iter().map(shown)).collect()
    }

    /// Title, parameters, start, certification, content and program, in lines of at most `width` pixels, with their font sizes.
    fn caption(&self, width: i32) -> Vec<(String, i32)> {
        let scene = self.scene;
        let excitation = scene.pair().excitation();
        let of_what = match excitation.only() {
            Some(_) => String::new(),
            None => format!("; forcing periods and phases of W = {}", excitation.reference().frequency()),
        };
        let data = greek(&format!("{}; {}{of_what}", scene.pair().in_words(), scene.start().in_words()));
        let title = scene.title().map(|title| (title.to_owned(), FONT + 3 * SCALE));
        let others = [data, typeset_text(&self.verdict), format!("{}; {}", self.shown(), picture::program())];
        let wrap = |(text, size): (String, i32)| {
            let most = f64::from(width) / (LETTER_WIDTH * f64::from(size));
            wrapped(&text, most).into_iter().map(move |line| (line, size))
        };
        title.into_iter().chain(others.map(|text| (text, FONT))).flat_map(wrap).collect()
    }

    /// The part of the motion that the panels show, in words.
    fn shown(&self) -> String {
        let letters = |is_in: &dyn Fn(Panel) -> bool| {
            let of: Vec<Panel> = self.panels.iter().copied().filter(|panel| is_in(*panel)).collect();
            let letters: Vec<String> = of.iter().map(|panel| format!("({})", panel.caption().letter)).collect();
            let is_row = of.len() > 2 && of.windows(2).all(|pair| pair[0] as u8 + 1 == pair[1] as u8);
            if is_row { format!("{}–{}", letters[0], letters[of.len() - 1]) } else { letters.join(", ") }
        };
        let trace = self.trace;
        let cycles = |requested: u32| match f64::from(requested) {
            whole if trace.is_open || whole <= trace.known => {
                format!("{requested} cycle{}", if requested == 1 { "" } else { "s" })
            }
            _ => format!("{:.1} cycles", trace.known),
        };
        let is_of_time = |panel: Panel| panel.is_of_time();
        let is_plane = |panel: Panel| !panel.is_of_time() && !panel.is_section();
        let shown = [
            (letters(&is_of_time), cycles(self.cycles)),
            (letters(&is_plane), cycles(self.orbit_cycles)),
            (letters(&Panel::is_section), format!("{} impacts", trace.crossings.len())),
        ];
        let shown = shown.into_iter().filter(|(letters, _)| !letters.is_empty());
        let shown = shown.map(|(letters, what)| format!("{letters}: {what}")).collect::<Vec<_>>().join("; ");
        format!("shown from the start on, with its transient: {shown}")
    }
}

fn write(caption: &[(String, i32)], root: &Canvas<'_>) -> Drawn {
    for (line, (text, size)) in caption.iter().enumerate() {
        let place = (MARGIN, MARGIN + LINE_HEIGHT / 2 + LINE_HEIGHT * line as i32);
        root.draw(&Text::new(text.clone(), place, words(*size, &BLACK, HPos::Left)))?;
    }
    Ok(())
}
