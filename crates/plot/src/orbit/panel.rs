//! Draws one panel.

use std::collections::BTreeSet;

use impact_pair::pair::Wall;
use plotters::coord::ranged1d::Ranged;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::frame::Frame;
use super::symbols::{self, hatch, symbol};
use super::trace::{Part, Span};
use crate::picture::{Axis, BLUE, Canvas, Dots, Drawn, GREEN, SCALE, Shape, VERMILION, hull, simplified, words};

/// Heights of letters.
pub const FONT: i32 = 17 * SCALE;
const TICK_FONT: i32 = 15 * SCALE;

/// How a trace is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// Whether it is certified: what is not has a colour of its own.
    pub is_certified: bool,
}

impl Style {
    /// The colour of curves.
    pub fn curve(self) -> RGBColor {
        if self.is_certified { BLUE } else { VERMILION }
    }

    /// Shape and colour of an impact.
    pub fn impact(self, wall: Wall) -> (Shape, RGBColor) {
        match (wall, self.is_certified) {
            (Wall::Left, _) => (Shape::Dot, self.curve()),
            (Wall::Right, true) => (Shape::Cross, GREEN),
            (Wall::Right, false) => (Shape::Cross, VERMILION),
        }
    }
}

type Pixel = (i32, i32);

/// The pixels of a panel.
struct Plane {
    axes: [Axis; 2],
    /// Left to right, bottom to top.
    pixels: [(i32, i32); 2],
}

impl Plane {
    fn pixel(&self, [x, y]: [f64; 2]) -> Pixel {
        let clamped = |axis: usize, value: f64| {
            let (from, to) = self.pixels[axis];
            self.axes[axis].map(&value, (from, to)).clamp(from.min(to), from.max(to))
        };
        (clamped(0, x), clamped(1, y))
    }

    fn middle(&self, [x, y]: [Span; 2]) -> Pixel {
        self.pixel([x.middle, y.middle])
    }

    fn corners(&self, [x, y]: [Span; 2]) -> [Pixel; 2] {
        [self.pixel([x.low, y.high]), self.pixel([x.high, y.low])]
    }

    /// Whether a box is wider than a pixel as it is shown.
    fn is_wide(&self, place: [Span; 2]) -> bool {
        let [a, b] = self.corners(place);
        (b.0 - a.0).max(b.1 - a.1) > SCALE
    }
}

/// Draws the panel into `area` of `root`; the dots of sections are added to `dots`. Says whether any box was wide
/// enough to be drawn.
pub fn draw(
    frame: &Frame<'_>,
    style: Style,
    (root, area): (&Canvas<'_>, &Canvas<'_>),
    dots: &mut Vec<Dots>,
) -> Result<bool, Box<dyn std::error::Error>> {
    let plane = axes(frame, area)?;
    if let Some((from, to)) = frame.open() {
        let (x0, x1) = (plane.pixel([from, 0.0]).0, plane.pixel([to, 0.0]).0);
        let (bottom, top) = plane.pixels[1];
        hatch(root, (x0, top), (x1, bottom))?;
    }
    walls(frame, &plane, root)?;
    // Bands first: they cover no line.
    let mut has_boxes = false;
    for (_, places) in frame.strokes() {
        has_boxes |= band(&places, style, &plane, root)?;
    }
    for (stroke, places) in frame.strokes().filter(|(stroke, _)| stroke.part != Part::Either) {
        let pixels: Vec<Pixel> = places.iter().map(|place| plane.middle(*place)).collect();
        let pixels = simplified(&pixels);
        let line = match stroke.part {
            Part::Flight => style.curve().stroke_width(3 * SCALE as u32 / 2),
            Part::Jump | Part::Either => style.curve().mix(0.45).stroke_width(SCALE as u32),
            Part::Chatter | Part::Rest => style.curve().stroke_width(5 * SCALE as u32),
        };
        if pixels.len() > 1 {
            root.draw(&PathElement::new(pixels, line))?;
        }
    }
    for wall in [Wall::Left, Wall::Right] {
        let (shape, colour) = style.impact(wall);
        let (wide, narrow): (Vec<_>, Vec<_>) = frame
            .crossings()
            .filter(|(of, _)| *of == wall)
            .map(|(_, place)| place)
            .partition(|place| plane.is_wide(*place));
        has_boxes |= !wide.is_empty();
        for place in wide.into_iter().flat_map(|place| frame.wrapped(place)) {
            root.draw(&Rectangle::new(plane.corners(place), colour.mix(0.3).filled()))?;
            root.draw(&Rectangle::new(plane.corners(place), colour.stroke_width(SCALE as u32 / 2)))?;
        }
        // Impacts on one pixel look like one.
        let places: BTreeSet<Pixel> = narrow.into_iter().map(|place| plane.middle(place)).collect();
        let places = places.into_iter().collect();
        dots.push(Dots { shape, colour, places });
    }
    for (kind, place) in frame.marks() {
        symbol(root, kind, plane.middle(place))?;
    }
    if let Some(place) = frame.last() {
        symbols::open(root, plane.middle(place))?;
    }
    Ok(has_boxes)
}

/// Title, mesh and names of the axes.
fn axes(frame: &Frame<'_>, area: &Canvas<'_>) -> Result<Plane, Box<dyn std::error::Error>> {
    let (title, below) = area.split_vertically(28 * SCALE);
    let text = format!("({})  {}", frame.panel.letter(), frame.panel.title());
    title.draw(&Text::new(text, (14 * SCALE, 16 * SCALE), words(FONT, &BLACK, HPos::Left)))?;
    let axes = frame.axes();
    let [x, y] = axes.clone();
    // The names of walls may stand above.
    let above = if matches!(frame.walls(), Some((0, _))) { 16 * SCALE } else { 0 };
    let mut chart = ChartBuilder::on(&below)
        .margin_top(above)
        .margin_left(6 * SCALE)
        .margin_right(34 * SCALE)
        .margin_bottom(4 * SCALE)
        .x_label_area_size(48 * SCALE)
        .y_label_area_size(74 * SCALE)
        .build_cartesian_2d(x, y)?;
    let [across, up] = frame.panel.quantities();
    chart
        .configure_mesh()
        .x_desc(across)
        .y_desc(up)
        .label_style(("sans-serif", TICK_FONT))
        .axis_desc_style(("sans-serif", TICK_FONT))
        .bold_line_style(BLACK.mix(0.10).stroke_width(SCALE as u32))
        .max_light_lines(0)
        .set_all_tick_mark_size(5 * SCALE)
        .axis_style(BLACK.stroke_width(SCALE as u32))
        .draw()?;
    let (across, down) = chart.plotting_area().get_pixel_range();
    Ok(Plane { axes, pixels: [(across.start, across.end - 1), (down.end - 1, down.start)] })
}

/// The walls, as wide as they are known to be, with their names.
fn walls(frame: &Frame<'_>, plane: &Plane, root: &Canvas<'_>) -> Drawn {
    let Some((axis, walls)) = frame.walls() else { return Ok(()) };
    for (span, name) in walls.into_iter().zip(["−d/2", "d/2"]) {
        let line = BLACK.stroke_width(2 * SCALE as u32);
        let at = |value: f64| match axis {
            0 => [(plane.pixel([value, 0.0]).0, plane.pixels[1].0), (plane.pixel([value, 0.0]).0, plane.pixels[1].1)],
            _ => [(plane.pixels[0].0, plane.pixel([0.0, value]).1), (plane.pixels[0].1, plane.pixel([0.0, value]).1)],
        };
        let ([low, _], [_, high]) = (at(span.low), at(span.high));
        if (high.0 - low.0).min((high.1 - low.1).abs()) > SCALE {
            root.draw(&Rectangle::new([low, high], BLACK.mix(0.2).filled()))?;
        }
        let [from, to] = at(span.middle);
        root.draw(&PathElement::new([from, to], line))?;
        let (place, side) = match axis {
            0 => ((to.0, to.1 - 9 * SCALE), HPos::Center),
            _ => ((to.0 + 4 * SCALE, to.1), HPos::Left),
        };
        root.draw(&Text::new(name, place, words(TICK_FONT, &BLACK, side)))?;
    }
    Ok(())
}

/// What the boxes of a curve sweep, where they are wide enough to be seen.
fn band(
    places: &[[Span; 2]],
    style: Style,
    plane: &Plane,
    root: &Canvas<'_>,
) -> Result<bool, Box<dyn std::error::Error>> {
    let mut is_wide = false;
    for pair in places.windows(2).filter(|pair| pair.iter().any(|place| plane.is_wide(*place))) {
        let corners = pair.iter().flat_map(|place| {
            let [a, b] = plane.corners(*place);
            [a, b, (a.0, b.1), (b.0, a.1)]
        });
        // Opaque, so that bands on top of each other look like one.
        let RGBColor(r, g, b) = style.curve();
        let tint = |part: u8| 255 - (255 - part) / 4;
        root.draw(&Polygon::new(hull(corners.collect()), RGBColor(tint(r), tint(g), tint(b)).filled()))?;
        is_wide = true;
    }
    Ok(is_wide)
}
