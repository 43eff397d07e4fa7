//! Draws one panel.

use impact_pair::pair::Wall;
use plotters::coord::ranged1d::Ranged;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::curves;
use super::frame::Frame;
use super::style::{FONT, Style};
use super::symbols::{self, hatch, symbol};
use super::trace::Span;
use crate::picture::{Axis, Canvas, Dots, Drawn, Plane, SCALE, hull, words};

const TICK_FONT: i32 = 15 * SCALE;
/// Least height and width of the frame around a magnified part.
const MIN_FRAME: i32 = 20 * SCALE;

type Pixel = (i32, i32);

fn middle(plane: &Plane, [x, y]: [Span; 2]) -> Pixel {
    plane.pixel([x.middle, y.middle])
}

fn corners(plane: &Plane, [x, y]: [Span; 2]) -> [Pixel; 2] {
    [plane.pixel([x.low, y.high]), plane.pixel([x.high, y.low])]
}

/// Whether a box is wider than a pixel of the picture.
fn is_wide(plane: &Plane, place: [Span; 2]) -> bool {
    let [a, b] = corners(plane, place);
    (b.0 - a.0).max(b.1 - a.1) > SCALE
}

/// Draws the panel into `area` of `root`, with a frame around the part that is magnified elsewhere. Returns whether any box was
/// wide enough to be drawn.
pub fn draw(
    frame: &Frame<'_>,
    magnified: Option<&Frame<'_>>,
    style: Style,
    (root, area): (&Canvas<'_>, &Canvas<'_>),
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
    for (stroke, points) in frame.strokes() {
        let places: Vec<[Span; 2]> = points.iter().map(|point| frame.place(point)).collect();
        has_boxes |= band(&places, style.curve(stroke.impacts), &plane, root)?;
    }
    curves::draw(frame, style, &plane, root)?;
    has_boxes |= impacts(frame, style, &plane, root)?;
    for (kind, place) in frame.marks() {
        symbol(root, kind, middle(&plane, place))?;
    }
    if let Some(place) = frame.last() {
        symbols::open(root, middle(&plane, place))?;
    }
    if let Some(inner) = magnified {
        window(inner, &plane, root)?;
    }
    Ok(has_boxes)
}

/// Draws the impacts on both walls, with the impacts of the transient first.
fn impacts(
    frame: &Frame<'_>,
    style: Style,
    plane: &Plane,
    root: &Canvas<'_>,
) -> Result<bool, Box<dyn std::error::Error>> {
    let mut has_boxes = false;
    for (is_transient, wall) in [(true, Wall::Left), (true, Wall::Right), (false, Wall::Left), (false, Wall::Right)] {
        let colour = style.impact(wall, if is_transient { 0 } else { style.transient });
        let (wide, narrow): (Vec<_>, Vec<_>) = frame
            .crossings()
            .filter(|(impacts, of, _)| *of == wall && (*impacts < style.transient) == is_transient)
            .map(|(_, _, place)| place)
            .partition(|place| is_wide(plane, *place));
        has_boxes |= !wide.is_empty();
        for place in wide.into_iter().flat_map(|place| frame.wrapped(place)) {
            root.draw(&Rectangle::new(corners(plane, place), colour.mix(0.3).filled()))?;
            root.draw(&Rectangle::new(corners(plane, place), colour.stroke_width(SCALE as u32 / 2)))?;
        }
        let places: Vec<Pixel> = narrow.into_iter().map(|place| middle(plane, place)).collect();
        if !places.is_empty() {
            root.draw(&Dots { colour, places }.element())?;
        }
    }
    Ok(has_boxes)
}

/// Writes the title of a panel; returns the area below it.
pub fn title<'c>(area: &Canvas<'c>, text: &str) -> Result<Canvas<'c>, Box<dyn std::error::Error>> {
    let (title, below) = area.split_vertically(28 * SCALE);
    title.draw(&Text::new(text.to_owned(), (14 * SCALE, 16 * SCALE), words(FONT, &BLACK, HPos::Left)))?;
    Ok(below)
}

/// Draws title, mesh and names of the axes.
fn axes(frame: &Frame<'_>, area: &Canvas<'_>) -> Result<Plane, Box<dyn std::error::Error>> {
    let below = title(area, &frame.heading())?;
    let axes = frame.axes();
    // A motion in a gap that doubles do not resolve is not visible on any axis.
    [frame.gap()].iter().chain(&axes).try_for_each(Axis::require_resolved)?;
    let [x, y] = axes.clone();
    // The names of walls may stand above.
    let above = if matches!(frame.walls(), Some((0, _))) { 16 * SCALE } else { 0 };
    let mut chart = ChartBuilder::on(&below)
        .margin_top(above)
        .margin_left(6 * SCALE)
        .margin_right(38 * SCALE)
        .margin_bottom(4 * SCALE)
        .x_label_area_size(48 * SCALE)
        .y_label_area_size(74 * SCALE)
        .build_cartesian_2d(x, y)?;
    let [across, up] = frame.panel.caption().quantities;
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

/// Draws the walls, as wide as their proved bounds, with their names.
fn walls(frame: &Frame<'_>, plane: &Plane, root: &Canvas<'_>) -> Drawn {
    let Some((axis, walls)) = frame.walls() else { return Ok(()) };
    for (span, name) in walls.into_iter().zip(["$-d/2$", "$d/2$"]) {
        if !plane.axes[axis].range().contains(&span.middle) {
            continue;
        }
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

/// Draws the frame around the part that another panel magnifies.
fn window(inner: &Frame<'_>, plane: &Plane, root: &Canvas<'_>) -> Drawn {
    let [x, y] = inner.axes().map(|axis| axis.range());
    let ((left, bottom), (right, top)) = (plane.pixel([x.start, y.start]), plane.pixel([x.end, y.end]));
    let wider = |low: i32, high: i32| {
        let lacking = (MIN_FRAME - (high - low)).max(0) / 2;
        (low - lacking, high + lacking)
    };
    let ((left, right), (top, bottom)) = (wider(left, right), wider(top, bottom));
    root.draw(&Rectangle::new([(left, top), (right, bottom)], BLACK.stroke_width(SCALE as u32)))?;
    Ok(())
}

/// Draws the area that the boxes of a curve sweep, where boxes are wide enough to be seen. Returns whether any are.
fn band(
    places: &[[Span; 2]],
    colour: RGBColor,
    plane: &Plane,
    root: &Canvas<'_>,
) -> Result<bool, Box<dyn std::error::Error>> {
    let mut has_boxes = false;
    for pair in places.windows(2).filter(|pair| pair.iter().any(|place| is_wide(plane, *place))) {
        let corners = pair.iter().flat_map(|place| {
            let [a, b] = corners(plane, *place);
            [a, b, (a.0, b.1), (b.0, a.1)]
        });
        // Opaque, so that bands on top of each other look like one.
        let RGBColor(r, g, b) = colour;
        let tint = |part: u8| 255 - (255 - part) / 4;
        root.draw(&Polygon::new(hull(corners.collect()), RGBColor(tint(r), tint(g), tint(b)).filled()))?;
        has_boxes = true;
    }
    Ok(has_boxes)
}
