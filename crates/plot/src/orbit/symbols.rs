//! Marks of events, hatching, and their entries in the legend.

use impact_pair::pair::Wall;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::frame::Panel;
use super::style::{FONT, Style};
use super::trace::{Kind, Part, Trace};
use crate::picture::{Canvas, Drawn, GREY, LETTER_WIDTH, SCALE, VERMILION, letters, words};

/// The distance of hatching lines.
const HATCH_SPACING: i32 = 12 * SCALE;
/// The height of a line of the legend.
pub const LINE_HEIGHT: i32 = 26 * SCALE;

/// Draws the symbol of a graze, a rest or a release.
pub fn symbol(root: &Canvas<'_>, kind: Kind, (x, y): (i32, i32)) -> Drawn {
    let half = 5 * SCALE;
    let corners = match kind {
        Kind::Graze => vec![(0, -half), (half, 0), (0, half), (-half, 0)],
        Kind::Rest => vec![(-half, -half), (half, -half), (half, half), (-half, half)],
        Kind::Release => vec![(-half, half), (0, -half), (half, half)],
    };
    let mut corners: Vec<_> = corners.into_iter().map(|(a, b)| (x + a, y + b)).collect();
    root.draw(&Polygon::new(corners.clone(), WHITE.filled()))?;
    corners.extend_from_within(..1);
    root.draw(&PathElement::new(corners, BLACK.stroke_width(3 * SCALE as u32 / 2)))?;
    Ok(())
}

/// Draws the symbol of the last proved state.
pub fn open(root: &Canvas<'_>, place: (i32, i32)) -> Drawn {
    root.draw(&Cross::new(place, 6 * SCALE, VERMILION.stroke_width(2 * SCALE as u32)))?;
    Ok(())
}

/// Hatches a rectangle in which nothing is proved.
pub fn hatch(root: &Canvas<'_>, (left, top): (i32, i32), (right, bottom): (i32, i32)) -> Drawn {
    let line = VERMILION.mix(0.6).stroke_width(SCALE as u32);
    // Lines x + y = c.
    for c in ((left + top)..=(right + bottom)).step_by(HATCH_SPACING as usize) {
        let (from, to) = ((c - top).min(right), (c - bottom).max(left));
        if from > to {
            root.draw(&PathElement::new([(from, c - from), (to, c - to)], line))?;
        }
    }
    root.draw(&PathElement::new([(left, top), (left, bottom)], line))?;
    Ok(())
}

/// An entry of the legend.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry {
    Motion,
    Transient,
    Jump,
    Rest,
    Mark(Kind),
    Left,
    Right,
    Box,
    Open,
}

impl Entry {
    fn words(self, style: Style) -> String {
        let words = match self {
            Self::Motion if style.is_certified => "motion, certified",
            Self::Motion => "motion, not certified",
            Self::Transient => return format!("transient: the first {} impacts", style.transient),
            Self::Jump => "impact",
            Self::Rest => "at rest on a wall, or in chatter too small to list",
            Self::Mark(Kind::Graze) => "graze",
            Self::Mark(Kind::Rest) => "rest begins",
            Self::Mark(Kind::Release) => "release",
            Self::Left => "impact on the left wall, $Σ_-$",
            Self::Right => "impact on the right wall, $Σ_+$",
            Self::Box => "the true state lies in here",
            Self::Open => "nothing is proved from here on",
        };
        words.to_owned()
    }

    fn sample(self, style: Style, root: &Canvas<'_>, (x, y): (i32, i32)) -> Drawn {
        let (left, right) = (x - 12 * SCALE, x + 12 * SCALE);
        let line = |colour: RGBAColor, width: i32| {
            let style = ShapeStyle { color: colour, filled: false, stroke_width: width as u32 };
            root.draw(&PathElement::new([(left, y), (right, y)], style))
        };
        let curve = style.curve(style.transient);
        match self {
            Self::Motion => line(curve.to_rgba(), 3 * SCALE / 2)?,
            Self::Transient => {
                line(GREY.to_rgba(), 3 * SCALE / 2)?;
                root.draw(&Circle::new((x, y), 3 * SCALE, GREY.filled()))?;
            }
            Self::Jump => {
                let ends = [(x, y - 9 * SCALE), (x, y + 9 * SCALE)];
                root.draw(&PathElement::new(ends, curve.mix(0.45).stroke_width(SCALE as u32)))?;
            }
            Self::Rest => line(curve.to_rgba(), 5 * SCALE)?,
            Self::Mark(kind) => symbol(root, kind, (x, y))?,
            Self::Left | Self::Right => {
                let wall = if self == Self::Left { Wall::Left } else { Wall::Right };
                root.draw(&Circle::new((x, y), 3 * SCALE, style.impact(wall, style.transient).filled()))?;
            }
            Self::Box => {
                let corners = [(left, y - 6 * SCALE), (right, y + 6 * SCALE)];
                root.draw(&Rectangle::new(corners, curve.mix(0.25).filled()))?;
            }
            Self::Open => {
                hatch(root, (left, y - 7 * SCALE), (x - 2 * SCALE, y + 7 * SCALE))?;
                open(root, (x + 7 * SCALE, y))?;
            }
        }
        Ok(())
    }
}

/// The entries that these panels of a trace need in the legend; boxes only if any are wide enough.
pub fn entries(trace: &Trace, panels: &[Panel], style: Style, has_boxes: bool) -> Vec<Entry> {
    let mut entries = Vec::new();
    let has_curves = panels.iter().any(|panel| !panel.is_section());
    if has_curves {
        entries.push(Entry::Motion);
        let has = |parts: &[Part]| trace.strokes.iter().any(|stroke| parts.contains(&stroke.part));
        let of_parts = [(Entry::Jump, &[Part::Jump][..]), (Entry::Rest, &[Part::Rest, Part::Chatter])];
        entries.extend(of_parts.into_iter().filter(|(_, parts)| has(parts)).map(|(entry, _)| entry));
        let kinds = [Kind::Graze, Kind::Rest, Kind::Release].into_iter();
        let marked = kinds.filter(|kind| trace.marks.iter().any(|mark| mark.kind == *kind));
        entries.extend(marked.map(Entry::Mark));
    }
    entries.extend((style.transient > 0).then_some(Entry::Transient));
    let has_impacts = |but: Panel| panels.iter().any(|panel| panel.is_section() && *panel != but);
    entries.extend(has_impacts(Panel::SectionRight).then_some(Entry::Left));
    entries.extend(has_impacts(Panel::SectionLeft).then_some(Entry::Right));
    entries.extend(has_boxes.then_some(Entry::Box));
    entries.extend((trace.is_open && has_curves).then_some(Entry::Open));
    entries
}

/// An entry and its place.
type Placed = (Entry, (i32, i32));

/// The places of the entries in lines of `width`, in pixels from the upper left corner, and the number of lines.
pub fn lay_out(entries: &[Entry], style: Style, width: i32) -> (Vec<Placed>, i32) {
    let (mut x, mut y) = (0, 0);
    let mut places = Vec::new();
    for &entry in entries {
        let needed = 40 * SCALE + (LETTER_WIDTH * f64::from(FONT) * letters(&entry.words(style))) as i32;
        if x > 0 && x + needed > width {
            (x, y) = (0, y + LINE_HEIGHT);
        }
        places.push((entry, (x, y)));
        x += needed + 16 * SCALE;
    }
    (places, if entries.is_empty() { 0 } else { y / LINE_HEIGHT + 1 })
}

/// Draws an entry at its place below and right of a corner.
pub fn draw(entry: Entry, style: Style, root: &Canvas<'_>, (x, y): (i32, i32)) -> Drawn {
    let middle = y + LINE_HEIGHT / 2;
    entry.sample(style, root, (x + 14 * SCALE, middle))?;
    root.draw(&Text::new(entry.words(style), (x + 34 * SCALE, middle), words(FONT, &BLACK, HPos::Left)))?;
    Ok(())
}

/// Draws the legend of the panels of a trace below `top`, with `margin` on both sides; returns its height.
pub fn explain(
    (trace, panels, style): (&Trace, &[Panel], Style),
    (root, top, margin): (&Canvas<'_>, i32, i32),
) -> Result<i32, Box<dyn std::error::Error>> {
    let width = root.dim_in_pixel().0 as i32 - 2 * margin;
    let (places, lines) = lay_out(&entries(trace, panels, style, false), style, width);
    for (entry, (x, y)) in places {
        draw(entry, style, root, (margin + x, top + y))?;
    }
    Ok(lines * LINE_HEIGHT)
}
