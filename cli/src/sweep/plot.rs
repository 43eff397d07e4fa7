//! Sweeps as SVG: the bifurcation diagram over one key, the map of outcomes over two.
//!
//! Axes and words are drawn by plotters; the data, up to a million cells, are one path for each colour.

use std::collections::BTreeMap;
use std::error::Error as StdError;
use std::f64::consts::{PI, TAU};
use std::fmt::Write;

use anyhow::{Result, anyhow};
use impact_pair::exact::Exact;
use impact_pair::mapping::Word;
use impact_pair::pair::Wall;
use impact_pair::scene::Key;
use impact_pair::sweep::{Axis, Grid};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use serde_json::Value;

use super::arguments::Show;
use super::record::{Bounds, Head, Periodic, Record};
use super::write::Sweep;

/// What is drawn is so many times as large as what is shown: the backend rounds to whole pixels.
const SCALE: i32 = 4;
/// The picture as it is shown.
const SIZE: (u32, u32) = (960, 680);
const FONT: i32 = 15 * SCALE;
/// Height of the lines above the plot.
const CAPTION: i32 = 76 * SCALE;
/// A line of the legend.
const LINE: i32 = 22 * SCALE;
/// Width of the legend beside a map.
const BESIDE: i32 = 250 * SCALE;
/// The smallest cell of a diagram: less than a pixel of most screens.
const CELL: i32 = 3;
/// What is added around the cells of periodic orbits.
const EDGE: i32 = 2;
/// Attractors of a map that have a colour of their own.
const NAMED: usize = 5;
/// Letters of a word that a legend shows.
const LETTERS: usize = 10;

/// Of the colours that Okabe and Ito (2008) chose for all eyes.
const COLOURS: [RGBColor; NAMED] = [
    RGBColor(0x00, 0x72, 0xb2),
    RGBColor(0xe6, 0x9f, 0x00),
    RGBColor(0x00, 0x9e, 0x73),
    RGBColor(0xcc, 0x79, 0xa7),
    RGBColor(0x56, 0xb4, 0xe9),
];
const UNDECIDED: RGBColor = RGBColor(0xd5, 0x5e, 0x00);
const OTHER: RGBColor = RGBColor(0x99, 0x99, 0x99);
const SETTLED: RGBColor = RGBColor(0xf0, 0xe4, 0x42);

type Canvas<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn<T> = Result<T, Box<dyn StdError>>;

pub fn svg(sweep: &mut Sweep, show: Show) -> Result<String> {
    let grid = sweep.head.grid()?;
    let size = (SIZE.0 * SCALE as u32, SIZE.1 * SCALE as u32);
    let mut text = String::new();
    let paths = match grid.axes() {
        [x] => diagram(sweep, x, show, &mut text, size),
        _ => map(sweep, &grid, &mut text, size),
    };
    let paths = paths.map_err(|error| anyhow!("{error}"))?;
    let tag = |(width, height): (u32, u32)| format!("<svg width=\"{width}\" height=\"{height}\"");
    let text = text.replacen(&tag(size), &tag(SIZE), 1);
    Ok(text.replacen("</svg>", &format!("{paths}</svg>"), 1))
}

/// The middle of a pair of bounds.
fn middle([low, high]: &Bounds) -> Result<f64> {
    Ok(0.5 * (double(low)? + double(high)?))
}

/// About what a decimal is.
fn double(text: &str) -> Result<f64> {
    Ok(text.parse()?)
}

fn value(x: &Exact) -> f64 {
    x.enclose(64).mid_rad().0
}

/// Rectangles of one colour as one path.
#[derive(Default)]
struct Path(String);

impl Path {
    fn rectangle(&mut self, (x, y): (i32, i32), (width, height): (i32, i32)) {
        // Writing to a String cannot fail.
        let _ = write!(self.0, "M{x} {y}h{width}v{height}h-{width}z");
    }

    fn element(&self, colour: RGBColor) -> String {
        let RGBColor(r, g, b) = colour;
        format!("<path shape-rendering=\"crispEdges\" fill=\"#{r:02X}{g:02X}{b:02X}\" d=\"{}\"/>\n", self.0)
    }
}

/// What is known of a point, as a diagram shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Class {
    NotAttracted,
    Attracted,
    Settled,
    Undecided,
}

impl Class {
    const ALL: [Self; 4] = [Self::Attracted, Self::NotAttracted, Self::Settled, Self::Undecided];

    fn of(record: &Record) -> Self {
        match record.outcome.as_str() {
            "attracted" => Self::Attracted,
            "undecided" => Self::Undecided,
            "not-attracted" => Self::NotAttracted,
            _ => Self::Settled,
        }
    }

    fn colour(self) -> RGBColor {
        match self {
            Self::Attracted => COLOURS[0],
            Self::NotAttracted => BLACK,
            Self::Settled => COLOURS[2],
            Self::Undecided => UNDECIDED,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Attracted => "proved to converge to a periodic orbit",
            Self::NotAttracted => "not proved to converge",
            Self::Settled => "periodic through rest, or at an end",
            Self::Undecided => "undecided (bar), impacts before",
        }
    }
}

/// Draws axes and words into `text`; the data are handed back.
fn diagram(sweep: &mut Sweep, axis: &Axis, show: Show, text: &mut String, size: (u32, u32)) -> Drawn<String> {
    let mut greatest = 0f64;
    let mut present = Vec::new();
    sweep.each_record(|record| {
        let class = Class::of(&record);
        if !present.contains(&class) {
            present.push(class);
        }
        for state in &record.states {
            greatest = greatest.max(middle(&state.velocity)?.abs());
        }
        Ok(())
    })?;
    let root = SVGBackend::with_string(text, size).into_drawing_area();
    root.fill(&WHITE)?;
    caption(&sweep.head, &root)?;
    let shown: Vec<_> = Class::ALL.into_iter().filter(|class| present.contains(class)).collect();
    for (i, class) in shown.iter().enumerate() {
        let place = ((24 + 310 * (i as i32 % 3)) * SCALE, CAPTION + LINE * (i as i32 / 3) + LINE / 2);
        key(&root, place, class.colour(), class.name())?;
    }
    let lines = shown.len().div_ceil(3) as i32;
    let (_, below) = root.split_vertically(CAPTION + LINE * lines);
    let range = match show {
        Show::Phase => 0.0..2.0,
        Show::Velocity => -1.05 * greatest.max(f64::MIN_POSITIVE)..1.05 * greatest.max(f64::MIN_POSITIVE),
    };
    let mut chart = ChartBuilder::on(&below)
        .margin(10 * SCALE)
        .margin_right(28 * SCALE)
        .x_label_area_size(48 * SCALE)
        .y_label_area_size(76 * SCALE)
        .build_cartesian_2d(value(&axis.low)..value(&axis.high), range)?;
    let y_name = match show {
        Show::Phase => "phase Ωt + τ of the impact [rad]",
        Show::Velocity => "relative velocity y′ before the impact [length/time]",
    };
    let label = |y: &f64| if show == Show::Phase { in_pi(*y) } else { signed(*y) };
    chart
        .configure_mesh()
        .disable_mesh()
        .x_desc(described(axis.key))
        .y_desc(y_name)
        .y_labels(if show == Show::Phase { 5 } else { 10 })
        .x_label_formatter(&|x| signed(*x))
        .y_label_formatter(&label)
        .label_style(("sans-serif", FONT))
        .axis_desc_style(("sans-serif", FONT))
        .set_all_tick_mark_size(5 * SCALE)
        .axis_style(BLACK.stroke_width(SCALE as u32))
        .draw()?;
    let area = chart.plotting_area();
    let (across, down) = area.get_pixel_range();
    let spacing = (across.end - across.start) / i32::try_from(axis.count - 1).unwrap_or(i32::MAX);
    let cell = (spacing / 3).clamp(CELL, 2 * SCALE);
    // Of each colour: a column's rows.
    let mut cells: BTreeMap<Class, BTreeMap<i32, Vec<i32>>> = BTreeMap::new();
    let mut bars = Path::default();
    sweep.each_record(|record| {
        let class = Class::of(&record);
        let x = value(&axis.value(record.point)?);
        for state in &record.states {
            let bounds = match show {
                Show::Phase => [double(&state.phase[0])?, double(&state.phase[1])?].map(|x| x / PI),
                Show::Velocity => [double(&state.velocity[0])?, double(&state.velocity[1])?],
            };
            // A box when it is wide enough to be seen, from its upper bound down.
            let [(column, low), (_, high)] = bounds.map(|y| area.map_coordinate(&(x, y)));
            let rows = cells.entry(class).or_default().entry(column / cell).or_default();
            let (top, bottom) = (high.clamp(down.start, down.end) / cell, low.clamp(down.start, down.end) / cell);
            rows.extend(top..=bottom);
            if rows.len() > 1 << 14 {
                rows.sort_unstable();
                rows.dedup();
            }
        }
        if class == Class::Undecided {
            let (column, _) = area.map_coordinate(&(x, 0.0));
            bars.rectangle((column - cell / 2, down.start - 8 * SCALE), (cell.max(SCALE), 8 * SCALE));
        }
        Ok(())
    })?;
    root.present()?;
    let mut paths = String::new();
    for (class, columns) in cells {
        let mut path = Path::default();
        for (column, mut rows) in columns {
            rows.sort_unstable();
            rows.dedup();
            for run in rows.chunk_by(|a, b| a + 1 == *b) {
                // Lines are made thick enough to be seen, dense clouds are not.
                let edge = if class == Class::NotAttracted && cell == CELL { 0 } else { EDGE };
                let corner = (column * cell - cell / 2 - edge, run[0] * cell - cell / 2 - edge);
                path.rectangle(corner, (cell + 2 * edge, cell * run.len() as i32 + 2 * edge));
            }
        }
        paths += &path.element(class.colour());
    }
    Ok(paths + &bars.element(UNDECIDED))
}

/// An outcome of a map: an attractor, or another one.
struct Kind {
    outcome: String,
    period: Option<Periodic>,
    points: u64,
}

impl Kind {
    /// Whether a point has it; attractors of one pair are told apart by where they are, of several pairs by their words.
    fn is_of(&self, record: &Record, is_one_pair: bool) -> bool {
        let alike = |a: &Periodic, b: &Periodic| {
            let near = match (&a.first, &b.first) {
                (Some(a), Some(b)) => overlap(&a.phase, &b.phase, TAU) && overlap(&a.velocity, &b.velocity, 0.0),
                _ => true,
            };
            (a.impacts, a.cycles, &a.word) == (b.impacts, b.cycles, &b.word) && (near || !is_one_pair)
        };
        let same_period = match (&self.period, &record.period) {
            (Some(a), Some(b)) => alike(a, b),
            (None, None) => true,
            _ => false,
        };
        self.outcome == record.outcome && same_period
    }

    fn name(&self, is_one_pair: bool) -> String {
        let word = |period: &Periodic| period.word.as_deref().and_then(|word| word.parse::<Word>().ok());
        let Some((period, word)) = self.period.as_ref().and_then(|period| Some((period, word(period)?))) else {
            let periodic = self.outcome == "periodic";
            return if periodic { "exactly periodic through rest".to_owned() } else { self.outcome.clone() };
        };
        let plural = if period.cycles == 1 { "" } else { "s" };
        let letter = |wall| if wall == Wall::Left { 'L' } else { 'R' };
        let mut walls: String = word.mappings().iter().take(LETTERS).map(|mapping| letter(mapping.walls().0)).collect();
        if word.mappings().len() > LETTERS {
            let _ = write!(walls, "… ({} impacts)", word.mappings().len());
        }
        let place = period.first.as_ref().filter(|_| is_one_pair).and_then(|first| middle(&first.phase).ok());
        let place = place.map_or_else(String::new, |phase| format!(", L at {phase:.2} rad"));
        format!("{walls} in {} cycle{plural}{place}", period.cycles)
    }
}

/// Whether two pairs of bounds may mean one number, or numbers that are `period` apart; by doubles, as labels are.
fn overlap(a: &Bounds, b: &Bounds, period: f64) -> bool {
    let ends = |bounds: &Bounds| Some((double(&bounds[0]).ok()?, double(&bounds[1]).ok()?));
    let Some(((a0, a1), (b0, b1))) = ends(a).zip(ends(b)) else { return false };
    // What reading and shifting may round off.
    let slack = 4.0 * f64::EPSILON * (a1.abs() + b1.abs() + period);
    [-period, 0.0, period].iter().any(|shift| a0 + shift <= b1 + slack && b0 <= a1 + shift + slack)
}

/// Draws axes and words into `text`; the data are handed back.
fn map(sweep: &mut Sweep, grid: &Grid, text: &mut String, size: (u32, u32)) -> Drawn<String> {
    let [x_axis, y_axis] = grid.axes() else { return Err("a map has two axes".into()) };
    let is_one_pair = [x_axis, y_axis].iter().all(|axis| axis.key >= Key::StartTime);
    let mut kinds: Vec<Kind> = Vec::new();
    // The kind of each point; none where it is missing.
    let mut points = vec![usize::MAX; usize::try_from(grid.points())?];
    sweep.each_record(|mut record| {
        // What is exactly periodic through a rest is one kind.
        record.period = record.period.filter(|period| period.word.is_some());
        let found = kinds.iter().position(|kind| kind.is_of(&record, is_one_pair));
        let number = found.unwrap_or_else(|| {
            kinds.push(Kind { outcome: record.outcome.clone(), period: record.period.clone(), points: 0 });
            kinds.len() - 1
        });
        kinds[number].points += 1;
        points[usize::try_from(record.point)?] = number;
        Ok(())
    })?;
    let colours = colours(&kinds);
    let root = SVGBackend::with_string(text, size).into_drawing_area();
    root.fill(&WHITE)?;
    caption(&sweep.head, &root)?;
    let (_, below) = root.split_vertically(CAPTION);
    let (left, _) = below.split_horizontally(size.0 as i32 - BESIDE);
    let half = |axis: &Axis| 0.5 * (value(&axis.high) - value(&axis.low)) / (axis.count - 1) as f64;
    let range = |axis: &Axis| value(&axis.low) - half(axis)..value(&axis.high) + half(axis);
    let mut chart = ChartBuilder::on(&left)
        .margin(10 * SCALE)
        .margin_right(16 * SCALE)
        .x_label_area_size(48 * SCALE)
        .y_label_area_size(76 * SCALE)
        .build_cartesian_2d(range(x_axis), range(y_axis))?;
    chart
        .configure_mesh()
        .disable_mesh()
        .x_desc(described(x_axis.key))
        .y_desc(described(y_axis.key))
        .x_label_formatter(&|x| signed(*x))
        .y_label_formatter(&|y| signed(*y))
        .label_style(("sans-serif", FONT))
        .axis_desc_style(("sans-serif", FONT))
        .set_all_tick_mark_size(5 * SCALE)
        .axis_style(BLACK.stroke_width(SCALE as u32))
        .draw()?;
    let (across, down) = chart.plotting_area().get_pixel_range();
    map_legend(&root, size.0 as i32 - BESIDE, &kinds, &colours, is_one_pair)?;
    root.present()?;
    let edge = |range: &std::ops::Range<i32>, place: u64, count: u64| {
        let part = i128::from(range.end - range.start) * i128::from(place) / i128::from(count);
        range.start + part as i32
    };
    let mut paths: BTreeMap<(u8, u8, u8), Path> = BTreeMap::new();
    let mut crosses = String::new();
    let colour_of = |x: u64, y: u64| points.get((x * y_axis.count + y) as usize).and_then(|kind| colours.get(*kind));
    for x in 0..x_axis.count {
        let (west, east) = (edge(&across, x, x_axis.count), edge(&across, x + 1, x_axis.count));
        let column: Vec<u64> = (0..y_axis.count).collect();
        for run in column.chunk_by(|a, b| colour_of(x, *a) == colour_of(x, *b)) {
            // Rows count upwards.
            let bottom = down.end - (edge(&down, run[0], y_axis.count) - down.start);
            let top = down.end - (edge(&down, run[run.len() - 1] + 1, y_axis.count) - down.start);
            if let Some(RGBColor(r, g, b)) = colour_of(x, run[0]) {
                paths.entry((*r, *g, *b)).or_default().rectangle((west, top), (east - west, bottom - top));
                if *colour_of(x, run[0]).unwrap_or(&BLACK) == UNDECIDED {
                    let _ = write!(crosses, "M{west} {bottom}L{east} {top}");
                }
            }
        }
    }
    let mut drawn: String = paths.iter().map(|(&(r, g, b), path)| path.element(RGBColor(r, g, b))).collect();
    // Not by colour alone.
    let _ = writeln!(drawn, "<path stroke=\"#FFFFFF\" stroke-width=\"{}\" d=\"{crosses}\"/>", SCALE / 2);
    Ok(drawn)
}

/// A colour for each kind: the attractors with the most points have their own.
fn colours(kinds: &[Kind]) -> Vec<RGBColor> {
    let mut attractors: Vec<usize> = (0..kinds.len()).filter(|&i| kinds[i].period.is_some()).collect();
    attractors.sort_by_key(|&i| std::cmp::Reverse(kinds[i].points));
    let colour = |i: usize| match (kinds[i].outcome.as_str(), attractors.iter().position(|&j| j == i)) {
        (_, Some(rank)) => COLOURS.get(rank).copied().unwrap_or(OTHER),
        ("undecided", _) => UNDECIDED,
        ("not-attracted", _) => BLACK,
        _ => SETTLED,
    };
    (0..kinds.len()).map(colour).collect()
}

fn map_legend(root: &Canvas<'_>, left: i32, kinds: &[Kind], colours: &[RGBColor], is_one_pair: bool) -> Drawn<()> {
    let mut order: Vec<usize> = (0..kinds.len()).collect();
    order.sort_by_key(|&i| std::cmp::Reverse(kinds[i].points));
    let mut entries: Vec<(RGBColor, String)> = Vec::new();
    let others = colours.iter().filter(|colour| **colour == OTHER).count();
    for i in order.into_iter().filter(|&i| colours[i] != OTHER) {
        entries.push((colours[i], kinds[i].name(is_one_pair)));
    }
    if others > 0 {
        entries.push((OTHER, format!("{others} other periodic orbits")));
    }
    for (line, (colour, name)) in entries.into_iter().enumerate() {
        key(root, (left, CAPTION + (line as i32 + 1) * LINE), colour, &name)?;
    }
    Ok(())
}

/// An entry of a legend.
fn key(root: &Canvas<'_>, (x, y): (i32, i32), colour: RGBColor, name: &str) -> Drawn<()> {
    let half = 5 * SCALE;
    root.draw(&Rectangle::new([(x, y - half), (x + 2 * half, y + half)], colour.filled()))?;
    root.draw(&Text::new(name.to_owned(), (x + 3 * half, y), words(FONT)))?;
    Ok(())
}

/// Title, parameters, and how it was computed.
fn caption(head: &Head, root: &Canvas<'_>) -> Drawn<()> {
    let title = head.title.clone().unwrap_or_else(|| "Sweep".to_owned());
    let arithmetic = head.arithmetic["kind"].as_str().unwrap_or_default();
    let certified = if head.certified {
        format!("certified ({arithmetic}, {} digits)", head.digits)
    } else {
        "floats, not certified".into()
    };
    let made = format!(
        "{} points, impacts {} to {} of each, {certified}; {}",
        head.points,
        head.transient + 1,
        head.transient + head.impacts,
        head.program
    );
    let lines = [(title, FONT + 3 * SCALE), (parameters(head), FONT), (made, FONT)];
    for (line, (text, size)) in lines.into_iter().enumerate() {
        root.draw(&Text::new(text, (16 * SCALE, (18 + 22 * line as i32) * SCALE), words(size)))?;
    }
    Ok(())
}

/// The parameters and the start that do not vary.
fn parameters(head: &Head) -> String {
    let varies = |keys: &[Key]| head.over.iter().any(|over| keys.iter().any(|key| key.name() == over.key));
    let text = |value: &Value| match value {
        Value::Array(terms) => terms.iter().filter_map(Value::as_str).collect::<Vec<_>>().join(", "),
        other => other.as_str().unwrap_or_default().to_owned(),
    };
    let (scene, start) = (&head.scene, &head.scene["start"]);
    let time = [Key::StartTime, Key::StartPhase];
    let entries = [
        ("A", &scene["excitation"]["amplitude"], &[Key::Amplitude][..]),
        ("Ω", &scene["excitation"]["frequency"], &[Key::Frequency]),
        ("τ", &scene["excitation"]["phase"], &[Key::Phase]),
        ("d", &scene["gap"], &[Key::Gap]),
        ("e", &scene["restitution"], &[Key::Restitution]),
        ("t₀", &start["time"], &time),
        ("y₀", &start["position"], &[Key::StartPosition]),
        ("v₀", &start["velocity"], &[Key::StartVelocity]),
    ];
    let shown = entries.into_iter().filter(|(_, value, keys)| !value.is_null() && !varies(keys));
    let mut words: Vec<String> = shown.map(|(symbol, value, _)| format!("{symbol} = {}", text(value))).collect();
    if let Some(wall) = start["wall"].as_str() {
        words.push(format!("from the {wall} wall"));
    }
    words.join(", ").replace("pi", "π").replace('*', "").replace('-', "−")
}

/// Name, symbol and unit of a key.
fn described(key: Key) -> String {
    let name = match key {
        Key::Amplitude => "amplitude of the box",
        Key::Frequency => "angular frequency",
        Key::Phase => "phase of the excitation",
        Key::Gap => "gap",
        Key::Restitution => "coefficient of restitution",
        Key::StartTime => "time of the start",
        Key::StartPhase => "phase at the start",
        Key::StartPosition => "relative displacement at the start",
        Key::StartVelocity => "relative velocity at the start",
    };
    match key.symbol() {
        (symbol, "") => format!("{name} {symbol}"),
        (symbol, unit) => format!("{name} {symbol} [{unit}]"),
    }
}

fn signed(x: f64) -> String {
    // Ticks are computed in doubles: what they are off by is not shown.
    let text = format!("{x:.6}");
    text.trim_end_matches('0').trim_end_matches('.').replace('-', "−")
}

/// A tick at `x` times pi.
fn in_pi(x: f64) -> String {
    match signed(x).as_str() {
        "0" => "0".to_owned(),
        "1" => "π".to_owned(),
        other => format!("{other}π"),
    }
}

fn words<'a>(size: i32) -> TextStyle<'a> {
    TextStyle::from(("sans-serif", size).into_font()).color(&BLACK).pos(Pos::new(HPos::Left, VPos::Center))
}
