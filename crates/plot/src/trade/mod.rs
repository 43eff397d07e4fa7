//! The work-precision plot: what an impact costs over the digits that are certain, as SVG.

mod axis;
mod labels;

use anyhow::Result;
use impact_pair::json::PROGRAM;
use impact_pair_answers::trade::{ErrorBounds, Measured, Trade, TradeArithmetic};
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use crate::picture::{self, BLUE, Canvas, Drawn, GREEN, Look, VERMILION, greek, words};
use axis::Digits;
use labels::{Area, Label};

const SIZE: (u32, u32) = (900, 620);
const FONT: i32 = 15;
/// Average width of a letter, in font sizes; the reader's fonts are unknown.
const LETTER_WIDTH: f64 = 0.45;
/// Factor by which an arithmetic with enclosures of width zero is placed beyond all others.
const ZERO_WIDTH_FACTOR: f64 = 1.5;

/// The kind of an arithmetic, which determines colour and symbol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Float,
    Doubles,
    Multiprecision,
}

impl Kind {
    fn of(measured: &Measured) -> Self {
        match (measured.arithmetic, measured.bits) {
            (TradeArithmetic::Float, _) => Self::Float,
            (_, f64::MANTISSA_DIGITS) => Self::Doubles,
            _ => Self::Multiprecision,
        }
    }

    fn colour(self) -> RGBColor {
        match self {
            Self::Float => VERMILION,
            Self::Doubles => BLUE,
            Self::Multiprecision => GREEN,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Float => "float: its true error, not certified",
            Self::Doubles => "certified in doubles",
            Self::Multiprecision => "certified in multiprecision",
        }
    }
}

/// A measured arithmetic as a marker of the plot.
struct Marker {
    kind: Kind,
    digits: f64,
    microseconds: f64,
    is_complete: bool,
    label: String,
}

impl Marker {
    /// `None` when there is nothing to draw: no impact, or no error known.
    fn of(measured: &Measured, trade: &Trade<'_>) -> Option<Self> {
        let kind = Kind::of(measured);
        let digits = match (kind, &trade.judgement) {
            (Kind::Float, Some(judgement)) => {
                (judgement.judged > 0).then(|| judgement.time.at_most.max(judgement.velocity.at_most).digits())
            }
            _ => measured.digits(),
        }?;
        // A short name: the legend explains the numbers.
        let name = match measured.arithmetic {
            TradeArithmetic::Auto(digits) => format!("auto {digits}"),
            other => other.to_string(),
        };
        let impacts = measured.impacts;
        let label = match trade.judgement.as_ref().filter(|_| kind == Kind::Float) {
            Some(ErrorBounds { departure: Some(departure), .. }) => {
                format!("{name} (wrong word from impact {})", departure.impact)
            }
            Some(judgement) if judgement.judged < impacts => {
                format!("{name} (compared up to impact {})", judgement.judged)
            }
            _ if measured.is_complete() => name,
            _ => format!("{name} ({impacts})"),
        };
        let microseconds = measured.microseconds(measured.times.orbit)?;
        Some(Self { kind, digits, microseconds, is_complete: measured.is_complete(), label })
    }
}

/// The plot of the measurements.
///
/// # Errors
/// Returns an error if the picture cannot be drawn.
pub fn svg(trade: &Trade<'_>, look: &Look) -> Result<String> {
    picture::svg(look.size(SIZE), 1, |root| draw(trade, (root, look)))
}

fn draw(trade: &Trade<'_>, (root, look): (&Canvas<'_>, &Look)) -> Drawn {
    let marks = marks(trade);
    let above = if look.no_header { 0 } else { CAPTION_HEIGHT };
    if !look.no_header {
        caption(trade, root)?;
    }
    legend(&marks, above, root)?;
    let (_, below) = root.split_vertically(above + LEGEND_HEIGHT);

    let digits = Digits::around(marks.iter().map(|mark| mark.digits));
    let times = axis::times(marks.iter().map(|mark| mark.microseconds));
    let mut chart = ChartBuilder::on(&below)
        .margin(10)
        .margin_right(24)
        .x_label_area_size(52)
        .y_label_area_size(72)
        .build_cartesian_2d(digits, times.log_scale())?;
    let font = ("sans-serif", FONT);
    chart
        .configure_mesh()
        .x_desc(format!(
            "certified digits $n$: $-log_{{10}}$ of the greatest guaranteed width (times in $2π/Ω$, velocities in {}); scale $log(1+n)$",
            greek(&trade.units.speed.to_string())
        ))
        .y_desc("time per impact [µs]")
        .y_labels(8)
        .y_label_formatter(&|time| format!("{time}"))
        .label_style(font)
        .axis_desc_style(font)
        .bold_line_style(BLACK.mix(0.12))
        .light_line_style(BLACK.mix(0.04))
        .draw()?;

    let area = chart.plotting_area();
    let pixel = |mark: &Marker| area.map_coordinate(&(mark.digits, mark.microseconds));
    let points: Vec<(i32, i32)> = marks.iter().map(pixel).collect();
    let (x, y) = area.get_pixel_range();
    let frame = Area {
        left: f64::from(x.start) + 2.0,
        top: f64::from(y.start) + 2.0,
        right: f64::from(x.end) - 2.0,
        bottom: f64::from(y.end) - 2.0,
    };
    names(&marks, &points, &frame, root)?;
    for (mark, &point) in marks.iter().zip(&points) {
        symbol(root, mark.kind, mark.is_complete, point)?;
    }
    Ok(())
}

/// The marks of the arithmetics; marks with enclosures of width zero lie beyond all others.
fn marks(trade: &Trade<'_>) -> Vec<Marker> {
    let mut marks: Vec<Marker> = trade.rows.iter().filter_map(|measured| Marker::of(measured, trade)).collect();
    let finite = marks.iter().map(|mark| mark.digits).filter(|digits| digits.is_finite());
    let beyond = ZERO_WIDTH_FACTOR * finite.fold(10.0, f64::max);
    for mark in marks.iter_mut().filter(|mark| mark.digits.is_infinite()) {
        (mark.digits, mark.label) = (beyond, format!("{}, exact", mark.label));
    }
    marks
}

/// Writes the names of marks beside these points, with lines to distant names.
fn names(marks: &[Marker], points: &[(i32, i32)], frame: &Area, root: &Canvas<'_>) -> Drawn {
    let boxes: Vec<Label> = marks
        .iter()
        .zip(points)
        .map(|(mark, &(x, y))| Label {
            marker: (f64::from(x), f64::from(y)),
            width: LETTER_WIDTH * f64::from(FONT) * mark.label.chars().count() as f64,
            height: f64::from(FONT) + 1.0,
        })
        .collect();
    for ((mark, area), label) in marks.iter().zip(labels::place(&boxes, frame)).zip(&boxes) {
        lead(root, mark.kind, label.marker, &area)?;
        // Aligned at the nearer end, since the width is approximate.
        let (x, side) = match label.marker.0 {
            marker if marker > area.right => (area.right, HPos::Right),
            marker if marker > area.left => ((area.left + area.right) / 2.0, HPos::Center),
            _ => (area.left, HPos::Left),
        };
        let at = (x.round() as i32, ((area.top + area.bottom) / 2.0).round() as i32);
        root.draw(&Text::new(mark.label.clone(), at, words(FONT, &mark.kind.colour(), side)))?;
    }
    Ok(())
}

/// Heights of the caption and of the legend above the plot.
const CAPTION_HEIGHT: i32 = 70;
const LEGEND_HEIGHT: i32 = 52;

/// Draws title, parameters, start, and request.
fn caption(trade: &Trade<'_>, root: &Canvas<'_>) -> Drawn {
    let scene = trade.scene;
    let title = format!("What accuracy costs. {}", scene.title().unwrap_or_default());
    let parameters = greek(&format!("{}; {}", scene.pair().in_words(), scene.start().in_words()));
    let requested = format!("{} requested; {PROGRAM}; medians on one machine", greek(&trade.goal()));
    for (line, (text, size)) in [(title, FONT + 3), (parameters, FONT), (requested, FONT)].into_iter().enumerate() {
        root.draw(&Text::new(text, (16, 18 + 22 * line as i32), words(size, &BLACK, HPos::Left)))?;
    }
    Ok(())
}

/// Draws the legend: the symbols of the kinds, and the hollow symbols of orbits that end early.
fn legend(marks: &[Marker], above: i32, root: &Canvas<'_>) -> Drawn {
    let say = |text: &str, x: i32, y: i32| Text::new(text.to_owned(), (x, y), words(FONT, &BLACK, HPos::Left));
    let width = |text: &str| (LETTER_WIDTH * f64::from(FONT) * text.chars().count() as f64) as i32;
    let (mut x, y) = (24, above + 14);
    for kind in [Kind::Float, Kind::Doubles, Kind::Multiprecision] {
        if marks.iter().any(|mark| mark.kind == kind) {
            symbol(root, kind, true, (x, y))?;
            root.draw(&say(kind.name(), x + 14, y))?;
            x += width(kind.name()) + 44;
        }
    }
    let (mut x, y) = (24, above + 36);
    if !marks.iter().all(|mark| mark.is_complete) {
        let hollow = "hollow: undecided after (N) impacts;";
        symbol(root, Kind::Doubles, false, (x, y))?;
        symbol(root, Kind::Multiprecision, false, (x + 18, y))?;
        root.draw(&say(hollow, x + 32, y))?;
        x += width(hollow) + 40;
    }
    root.draw(&say("auto n: n digits requested", x - 6, y))?;
    Ok(())
}

/// Draws the marker of a kind; hollow where the orbit ends early. The crosses of `float` have no inside.
fn symbol(root: &Canvas<'_>, kind: Kind, is_complete: bool, (x, y): (i32, i32)) -> Drawn {
    let style = |colour: RGBColor| ShapeStyle { color: colour.to_rgba(), filled: false, stroke_width: 2 };
    let (line, inside) = (style(kind.colour()), if is_complete { kind.colour() } else { WHITE }.filled());
    match kind {
        Kind::Float => root.draw(&Cross::new((x, y), 5, line))?,
        Kind::Doubles => {
            root.draw(&Circle::new((x, y), 5, inside))?;
            root.draw(&Circle::new((x, y), 5, line))?;
        }
        Kind::Multiprecision => {
            let corners = [(x - 5, y - 5), (x + 5, y + 5)];
            root.draw(&Rectangle::new(corners, inside))?;
            root.draw(&Rectangle::new(corners, line))?;
        }
    }
    Ok(())
}

/// Draws the line from a marker to a distant label.
fn lead(root: &Canvas<'_>, kind: Kind, marker: (f64, f64), label: &Area) -> Drawn {
    let foot = label.nearest(marker);
    if (foot.0 - marker.0).hypot(foot.1 - marker.1) > labels::LEADER_DISTANCE {
        let pixel = |(x, y): (f64, f64)| (x.round() as i32, y.round() as i32);
        root.draw(&PathElement::new([pixel(marker), pixel(foot)], kind.colour().mix(0.5)))?;
    }
    Ok(())
}
