//! The manifolds of figures 10 and 11 as SVG.

use anyhow::Result;
use impact_pair::Scene;
use impact_pair::certificate::document::PROGRAM;
use impact_pair::exact::Enclosure;
use impact_pair::two_impact::{Axis, Manifold, Mark, Part, Stability};
use plotters::prelude::*;
use plotters::series::DashedLineSeries;
use plotters::style::text_anchor::HPos;

use crate::picture::{self, BLUE, Canvas, Drawn, GREY, SCALE, VERMILION};

/// The picture as it is shown.
const SIZE: (u32, u32) = (900, 640);
const FONT: i32 = 15 * SCALE;
/// Heights of the lines above the plot.
const CAPTION: i32 = 70 * SCALE;
const LEGEND: i32 = 62 * SCALE;
/// Amplitudes beyond so many gaps are cut off: near W = 0 they have no bound.
const HIGHEST: f64 = 0.75;

/// What is proved of a part, by colour and width.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Stable,
    Unstable,
    Unphysical,
}

impl Kind {
    fn of(part: Part) -> Self {
        match (part.is_physical, part.stability) {
            (false, _) => Self::Unphysical,
            (true, Stability::Stable) => Self::Stable,
            (true, _) => Self::Unstable,
        }
    }

    fn style(self) -> ShapeStyle {
        let (colour, width) = match self {
            Self::Stable => (BLUE, 4 * SCALE),
            Self::Unstable => (VERMILION, 2 * SCALE),
            Self::Unphysical => (GREY, SCALE),
        };
        colour.stroke_width(width as u32)
    }

    fn name(self) -> &'static str {
        match self {
            Self::Stable => "physical and stable",
            Self::Unstable => "physical, unstable",
            Self::Unphysical => "a wall is touched earlier",
        }
    }
}

/// A stretch of a curve of one kind.
struct Stretch {
    kind: Kind,
    is_solid: bool,
    points: Vec<(f64, f64)>,
}

pub fn svg(scene: &Scene, axis: Axis, curves: &[Manifold]) -> Result<String> {
    picture::svg(SIZE, SCALE, |root| draw(scene, axis, curves, root))
}

fn middle(x: &Enclosure) -> f64 {
    x.mid_rad().0
}

fn draw(scene: &Scene, axis: Axis, curves: &[Manifold], root: &Canvas<'_>) -> Drawn {
    caption(scene, axis, root)?;
    legend(root)?;
    let (_, below) = root.split_vertically(CAPTION + LEGEND);
    let all = || curves.iter().flat_map(|curve| &curve.points);
    let ends = all().map(|point| middle(&point.at)).fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
    let greatest = all().map(|point| middle(&point.amplitude)).fold(0.0, f64::max);
    let highest = greatest.min(HIGHEST * middle(&scene.pair().gap().enclose(64)));
    let font = ("sans-serif", FONT);
    let name = match axis {
        Axis::Frequency => "angular frequency Ω [rad/time]",
        Axis::Velocity(_) => "relative velocity v before the impact [length/time]",
    };
    let mut chart = ChartBuilder::on(&below)
        .margin(10 * SCALE)
        .margin_right(48 * SCALE)
        .x_label_area_size(48 * SCALE)
        .y_label_area_size(62 * SCALE)
        .build_cartesian_2d(picture::Axis::over(ends.0, ends.1), picture::Axis::over(0.0, 1.05 * highest))?;
    chart
        .configure_mesh()
        .x_desc(name)
        .y_desc("amplitude A_N of the box [length]")
        .label_style(font)
        .axis_desc_style(font)
        .bold_line_style(BLACK.mix(0.12).stroke_width(SCALE as u32))
        .max_light_lines(0)
        .set_all_tick_mark_size(5 * SCALE)
        .axis_style(BLACK.stroke_width(SCALE as u32))
        .draw()?;
    let y_range = chart.y_range();
    for curve in curves {
        for Stretch { kind, is_solid, points } in stretches(curve, y_range.end) {
            if is_solid {
                chart.draw_series(LineSeries::new(points, kind.style()))?;
            } else {
                chart.draw_series(DashedLineSeries::new(points, 9 * SCALE, 5 * SCALE, kind.style()))?;
            }
        }
    }
    let area = chart.plotting_area();
    let visible = |curve: &Manifold| -> Vec<(Option<Mark>, (i32, i32))> {
        let places = curve.points.iter().map(|point| (point.mark, (middle(&point.at), middle(&point.amplitude))));
        let inside = places.filter(|(_, place)| place.1 <= y_range.end);
        inside.map(|(mark, place)| (mark, area.map_coordinate(&place))).collect()
    };
    let shown: Vec<_> = curves.iter().map(|curve| (curve.cycles, visible(curve))).collect();
    for (mark, place) in shown.iter().flat_map(|(_, points)| points) {
        if let Some(mark) = mark {
            symbol(root, *mark, *place)?;
        }
    }
    // Names stand at the ends that have more room.
    let ends = |is_last: bool| -> Vec<(u32, (i32, i32))> {
        let end = |points: &[(Option<Mark>, (i32, i32))]| {
            let place = if is_last { points.last() } else { points.first() };
            place.map(|(_, place)| *place)
        };
        shown.iter().filter_map(|(cycles, points)| Some((*cycles, end(points)?))).collect()
    };
    let (first, last) = (ends(false), ends(true));
    let is_last = room(&last) >= room(&first);
    for (cycles, (x, y)) in if is_last { last } else { first } {
        let (place, side) =
            if is_last { ((x + 5 * SCALE, y), HPos::Left) } else { ((x + 8 * SCALE, y - 9 * SCALE), HPos::Left) };
        root.draw(&Text::new(format!("N = {cycles}"), place, words(FONT, side)))?;
    }
    Ok(())
}

/// How far apart names at these places are, at least: from 1 on they do not cover each other.
fn room(places: &[(u32, (i32, i32))]) -> f64 {
    let distance = |a: (i32, i32), b: (i32, i32)| {
        let part = |a: i32, b: i32, size: i32| f64::from((a - b).abs()) / f64::from(size);
        part(a.0, b.0, 3 * FONT).max(part(a.1, b.1, FONT))
    };
    let pairs =
        places.iter().enumerate().flat_map(|(i, (_, a))| places[..i].iter().map(move |(_, b)| distance(*a, *b)));
    pairs.fold(f64::INFINITY, f64::min)
}

/// The stretches of a curve, up to an amplitude.
fn stretches(curve: &Manifold, highest: f64) -> Vec<Stretch> {
    let mut all: Vec<Stretch> = Vec::new();
    let mut is_open = false;
    for pair in curve.points.windows(2) {
        let ends = [&pair[0], &pair[1]].map(|point| (middle(&point.at), middle(&point.amplitude)));
        let Some(part) = pair[0].after.filter(|_| ends.iter().all(|end| end.1 <= highest)) else {
            is_open = false;
            continue;
        };
        let (kind, is_solid) = (Kind::of(part), part.is_solid);
        match all.last_mut().filter(|last| is_open && last.kind == kind && last.is_solid == is_solid) {
            Some(last) => last.points.push(ends[1]),
            None => all.push(Stretch { kind, is_solid, points: ends.to_vec() }),
        }
        is_open = true;
    }
    all
}

/// Title, parameters and program.
fn caption(scene: &Scene, axis: Axis, root: &Canvas<'_>) -> Drawn {
    let (pair, start) = (scene.pair(), scene.start());
    let given = match axis {
        Axis::Frequency => format!("v = {}", start.velocity()),
        Axis::Velocity(_) => format!("Ω = {}", pair.excitation().reference().frequency()),
    };
    let title = scene.title().unwrap_or("Equispaced motions with two impacts in N cycles").to_owned();
    let parameters = format!("d = {}, e = {}, {given}", pair.gap(), pair.restitution()).replace('-', "−");
    let program = format!("A_N of equation (68), every part proved; {PROGRAM}");
    for (line, (text, size)) in [(title, FONT + 3 * SCALE), (parameters, FONT), (program, FONT)].into_iter().enumerate()
    {
        root.draw(&Text::new(text, (16 * SCALE, (18 + 22 * line as i32) * SCALE), words(size, HPos::Left)))?;
    }
    Ok(())
}

/// What lines and symbols say.
fn legend(root: &Canvas<'_>) -> Drawn {
    let upper = CAPTION + 16 * SCALE;
    for (kind, x) in [(Kind::Stable, 24), (Kind::Unstable, 240), (Kind::Unphysical, 446)] {
        root.draw(&PathElement::new([(x * SCALE, upper), ((x + 34) * SCALE, upper)], kind.style()))?;
        root.draw(&Text::new(kind.name(), ((x + 42) * SCALE, upper), words(FONT, HPos::Left)))?;
    }
    root.draw(&Text::new("solid: sin θ₀ > 0, dashed: < 0", (676 * SCALE, upper), words(FONT, HPos::Left)))?;
    let lower = upper + 26 * SCALE;
    for (mark, text, x) in
        [(Mark::Fold, "fold", 36), (Mark::Pitchfork, "pitchfork", 130), (Mark::Graze, "graze of the near wall", 262)]
    {
        symbol(root, mark, (x * SCALE, lower))?;
        root.draw(&Text::new(text, ((x + 14) * SCALE, lower), words(FONT, HPos::Left)))?;
    }
    Ok(())
}

/// The symbol of a mark; where `sin th0 = 0` the line itself changes.
fn symbol(root: &Canvas<'_>, mark: Mark, (x, y): (i32, i32)) -> Drawn {
    let (line, half) = (BLACK.stroke_width(SCALE as u32), 9 * SCALE / 2);
    match mark {
        Mark::Level => {}
        // Hollow, since what is between them may be short.
        Mark::Fold => root.draw(&Circle::new((x, y), 5 * SCALE, line))?,
        Mark::Pitchfork => {
            let corners = [(-half, -half), (half, -half), (half, half), (-half, half), (-half, -half)];
            root.draw(&PathElement::new(corners.map(|(a, b)| (x + a, y + b)), line))?;
        }
        Mark::Graze => root.draw(&Cross::new((x, y), 5 * SCALE, line))?,
    }
    Ok(())
}

fn words<'a>(size: i32, side: HPos) -> TextStyle<'a> {
    picture::words(size, &BLACK, side)
}
