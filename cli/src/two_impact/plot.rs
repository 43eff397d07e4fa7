//! The manifolds of figures 10 and 11 as SVG.

use std::error::Error as StdError;

use anyhow::{Result, anyhow};
use impact_pair::Scene;
use impact_pair::certificate::PROGRAM;
use impact_pair::exact::Enclosure;
use impact_pair::two_impact::{Axis, Manifold, Mark, Part, Stability};
use plotters::prelude::*;
use plotters::series::DashedLineSeries;
use plotters::style::text_anchor::{HPos, Pos, VPos};

const SIZE: (u32, u32) = (900, 640);
const FONT: i32 = 15;
/// Heights of the lines above the plot.
const CAPTION: u32 = 70;
const LEGEND: u32 = 62;
/// Amplitudes beyond so many gaps are cut off: near W = 0 they have no bound.
const HIGHEST: f64 = 0.75;

/// What is proved of a part, by colour and width: of the colours that Okabe and Ito (2008) chose for all eyes.
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
            Self::Stable => (RGBColor(0x00, 0x72, 0xb2), 4),
            Self::Unstable => (RGBColor(0xd5, 0x5e, 0x00), 2),
            Self::Unphysical => (RGBColor(0x99, 0x99, 0x99), 1),
        };
        colour.stroke_width(width)
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
    let mut text = String::new();
    draw(scene, axis, curves, &mut text).map_err(|error| anyhow!("{error}"))?;
    Ok(text)
}

fn middle(x: &Enclosure) -> f64 {
    x.mid_rad().0
}

fn draw(scene: &Scene, axis: Axis, curves: &[Manifold], text: &mut String) -> Result<(), Box<dyn StdError>> {
    let root = SVGBackend::with_string(text, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    caption(scene, axis, &root)?;
    legend(&root)?;
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
        .margin(10)
        .margin_right(48)
        .x_label_area_size(48)
        .y_label_area_size(62)
        .build_cartesian_2d(ends.0..ends.1, 0.0..1.05 * highest)?;
    chart
        .configure_mesh()
        .x_desc(name)
        .y_desc("amplitude A_N of the box [length]")
        .x_label_formatter(&|x| signed(*x))
        .label_style(font)
        .axis_desc_style(font)
        .bold_line_style(BLACK.mix(0.12))
        .light_line_style(BLACK.mix(0.04))
        .draw()?;
    for curve in curves {
        for Stretch { kind, is_solid, points } in stretches(curve, 1.05 * highest) {
            if is_solid {
                chart.draw_series(LineSeries::new(points, kind.style()))?;
            } else {
                chart.draw_series(DashedLineSeries::new(points, 9, 5, kind.style()))?;
            }
        }
    }
    let area = chart.plotting_area();
    let visible = |y: f64| y <= 1.05 * highest;
    for curve in curves {
        for point in &curve.points {
            let place = (middle(&point.at), middle(&point.amplitude));
            if let Some(mark) = point.mark.filter(|_| visible(place.1)) {
                symbol(&root, mark, area.map_coordinate(&place))?;
            }
        }
        let last = curve.points.last().map(|point| (middle(&point.at), middle(&point.amplitude)));
        if let Some(place) = last.filter(|place| visible(place.1)) {
            let (x, y) = area.map_coordinate(&place);
            root.draw(&Text::new(format!("N = {}", curve.cycles), (x + 5, y), words(FONT, HPos::Left)))?;
        }
    }
    root.present()?;
    Ok(())
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

type Canvas<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;

fn signed(x: f64) -> String {
    format!("{x}").replace('-', "−")
}

/// Title, parameters and program.
fn caption(scene: &Scene, axis: Axis, root: &Canvas<'_>) -> Result<(), Box<dyn StdError>> {
    let (pair, start) = (scene.pair(), scene.start());
    let given = match axis {
        Axis::Frequency => format!("v = {}", start.velocity()),
        Axis::Velocity(_) => format!("Ω = {}", pair.excitation().frequency()),
    };
    let title = scene.title().unwrap_or("Equispaced motions with two impacts in N cycles").to_owned();
    let parameters = format!("d = {}, e = {}, {given}", pair.gap(), pair.restitution()).replace('-', "−");
    let program = format!("A_N of equation (68), every part proved; {PROGRAM}");
    for (line, (text, size)) in [(title, FONT + 3), (parameters, FONT), (program, FONT)].into_iter().enumerate() {
        root.draw(&Text::new(text, (16, 18 + 22 * line as i32), words(size, HPos::Left)))?;
    }
    Ok(())
}

/// What lines and symbols say.
fn legend(root: &Canvas<'_>) -> Result<(), Box<dyn StdError>> {
    let upper = CAPTION as i32 + 16;
    for (kind, x) in [(Kind::Stable, 24), (Kind::Unstable, 240), (Kind::Unphysical, 446)] {
        root.draw(&PathElement::new([(x, upper), (x + 34, upper)], kind.style()))?;
        root.draw(&Text::new(kind.name(), (x + 42, upper), words(FONT, HPos::Left)))?;
    }
    root.draw(&Text::new("solid: sin θ₀ > 0, dashed: < 0", (676, upper), words(FONT, HPos::Left)))?;
    let lower = upper + 26;
    for (mark, text, x) in
        [(Mark::Fold, "fold", 36), (Mark::Pitchfork, "pitchfork", 130), (Mark::Graze, "graze of the near wall", 262)]
    {
        symbol(root, mark, (x, lower))?;
        root.draw(&Text::new(text, (x + 14, lower), words(FONT, HPos::Left)))?;
    }
    Ok(())
}

/// The symbol of a mark; where `sin th0 = 0` the line itself changes.
fn symbol(root: &Canvas<'_>, mark: Mark, (x, y): (i32, i32)) -> Result<(), Box<dyn StdError>> {
    let line = BLACK.stroke_width(2);
    match mark {
        Mark::Level => {}
        Mark::Fold => {
            root.draw(&Circle::new((x, y), 5, WHITE.filled()))?;
            root.draw(&Circle::new((x, y), 5, line))?;
        }
        Mark::Pitchfork => {
            root.draw(&Rectangle::new([(x - 4, y - 4), (x + 5, y + 5)], WHITE.filled()))?;
            root.draw(&Rectangle::new([(x - 4, y - 4), (x + 5, y + 5)], line))?;
        }
        Mark::Graze => root.draw(&Cross::new((x, y), 5, line))?,
    }
    Ok(())
}

fn words<'a>(size: i32, side: HPos) -> TextStyle<'a> {
    TextStyle::from(("sans-serif", size).into_font()).color(&BLACK).pos(Pos::new(side, VPos::Center))
}
