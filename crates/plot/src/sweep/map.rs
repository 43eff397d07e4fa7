//! The map of outcomes over two keys.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fmt::Write;

use impact_pair::json::SweepHead;
use impact_pair::mapping::Word;
use impact_pair::pair::Wall;
use impact_pair::scene::{Key, Range};
use impact_pair::sweep::Grid;
use plotters::prelude::*;

use super::kind::{Kind, OTHER_COLOUR, UNDECIDED_COLOUR, colours};
use super::legend::{self, described};
use super::{Cells, Drawn, Plane, middle, value};
use crate::picture::{self, Axis, Canvas, Look, Mark, SCALE, hex};
use crate::records::Records;

/// Radius of the ring around an attractor.
const RING_RADIUS: i32 = 6 * SCALE;

/// The outcomes of all points.
struct Outcomes {
    kinds: Vec<Kind>,
    /// The kind of each point; `None` for a missing point.
    points: Vec<Option<usize>>,
}

impl Outcomes {
    fn of(sweep: &mut impl Records<Head = SweepHead>, grid: &Grid, is_one_pair: bool) -> Drawn<Self> {
        let mut kinds: Vec<Kind> = Vec::new();
        let mut points = vec![None; usize::try_from(grid.points())?];
        sweep.each_record(|mut record| {
            // Exact periods through a rest are one kind.
            record.period = record.period.filter(|period| period.word.is_some());
            let found = kinds.iter().position(|kind| kind.is_of(&record, is_one_pair));
            let number = found.unwrap_or_else(|| {
                kinds.push(Kind { outcome: record.outcome, period: record.period.clone(), points: 0 });
                kinds.len() - 1
            });
            kinds[number].points += 1;
            points[usize::try_from(record.point)?] = Some(number);
            Ok(())
        })?;
        Ok(Self { kinds, points })
    }
}

/// Draws axes and text, and returns the data as SVG.
pub fn draw(
    sweep: &mut impl Records<Head = SweepHead>,
    grid: &Grid,
    (root, look): (&Canvas<'_>, &Look),
) -> Drawn<String> {
    let [x, y] = grid.axes() else { return Err("a map has two axes".into()) };
    let is_one_pair = [x, y].iter().all(|axis| axis.key() >= Key::StartTime);
    let outcomes = Outcomes::of(sweep, grid, is_one_pair)?;
    let colours = colours(&outcomes.kinds);
    let top = legend::caption(sweep.head(), (root, look))?;
    let is_plane_of_starts = [x.key(), y.key()] == [Key::StartPhase, Key::StartVelocity];
    let starts_left = sweep.head().scene.start.wall == Some(Wall::Left);
    let mut entries = entries(&outcomes.kinds, &colours, is_one_pair);
    let attractors: Vec<_> =
        if is_plane_of_starts && starts_left { attractors(&outcomes.kinds, &colours) } else { Vec::new() };
    if !attractors.is_empty() {
        entries.push((Mark::Ring, "an attractor, where it hits the left wall".to_owned()));
    }
    let lines = picture::legend(root, top, &entries)?;
    let (_, area) = root.split_vertically(top + lines + 10 * SCALE);
    let plane = Plane::draw(&area, [scale(x), scale(y)], [&described(x.key()), &described(y.key())])?;
    let colour = |point: u64| {
        let kind = outcomes.points.get(point as usize).copied().flatten()?;
        Some(colours[kind])
    };
    let rings: String = attractors
        .into_iter()
        .map(|(phase, velocity, colour)| ring((plane.column(phase), plane.row(velocity)), colour))
        .collect();
    Ok(cells(&plane, x.points(), y.points(), colour) + &rings)
}

/// The known first impacts of attractors on the left wall (phase, velocity), and their colours.
fn attractors(kinds: &[Kind], colours: &[RGBColor]) -> Vec<(f64, f64, RGBColor)> {
    let place = |(kind, colour): (&Kind, &RGBColor)| {
        let period = kind.period.as_ref()?;
        let word: Word = period.word.as_deref()?.parse().ok()?;
        let first = period.first.as_ref().filter(|_| word.mappings()[0].walls().0 == Wall::Left)?;
        Some((middle(&first.phase).ok()?, middle(&first.velocity).ok()?, *colour))
    };
    kinds.iter().zip(colours).filter_map(place).collect()
}

/// A ring visible on every colour, filled with the colour of its basin.
fn ring((x, y): (i32, i32), colour: RGBColor) -> String {
    let (white, black) = (RING_RADIUS + SCALE, SCALE);
    format!(
        "<circle cx=\"{x}\" cy=\"{y}\" r=\"{white}\" fill=\"#FFFFFF\"/><circle cx=\"{x}\" cy=\"{y}\" r=\"{RING_RADIUS}\" fill=\"{}\" stroke=\"#000000\" stroke-width=\"{black}\"/>\n",
        hex(colour)
    )
}

/// An axis with room for half a cell at both ends.
fn scale(axis: &Range) -> Axis {
    let (low, high) = (value(axis.low()), value(axis.high()));
    let half = 0.5 * (high - low) / (axis.points() - 1) as f64;
    let is_turn = matches!(axis.key(), Key::Phase(_) | Key::StartPhase) && (low, high) == (0.0, TAU);
    if is_turn { Axis::turn(half) } else { Axis::over(low - half, high + half) }
}

/// A cell for each point; the second key varies faster, and upwards.
fn cells(plane: &Plane, columns: u64, rows: u64, colour: impl Fn(u64) -> Option<RGBColor>) -> String {
    let [(left, right), (top, bottom)] = plane.pixels;
    let part =
        |length: i32, place: u64, count: u64| (i128::from(length) * i128::from(place) / i128::from(count)) as i32;
    let mut paths: BTreeMap<String, (RGBColor, Cells)> = BTreeMap::new();
    let mut strokes = String::new();
    for x in 0..columns {
        let (west, east) = (left + part(right - left, x, columns), left + part(right - left, x + 1, columns));
        let column: Vec<(u64, Option<RGBColor>)> = (0..rows).map(|y| (y, colour(x * rows + y))).collect();
        for run in column.chunk_by(|a, b| a.1 == b.1) {
            let Some(colour) = run[0].1 else { continue };
            let south = bottom - part(bottom - top, run[0].0, rows);
            let north = bottom - part(bottom - top, run[run.len() - 1].0 + 1, rows);
            let (_, cells) = paths.entry(hex(colour)).or_insert_with(|| (colour, Cells::default()));
            cells.add((west, north), (east - west, south - north));
            if colour == UNDECIDED_COLOUR {
                // Writing to a String cannot fail.
                let _ = write!(strokes, "M{west} {south}L{east} {north}");
            }
        }
    }
    let mut drawn: String = paths.values().map(|(colour, cells)| cells.element(*colour)).collect();
    // Undecided cells differ not by colour alone.
    let _ = writeln!(drawn, "<path stroke=\"#FFFFFF\" stroke-width=\"{}\" d=\"{strokes}\"/>", SCALE / 2);
    drawn
}

/// The legend, the most frequent outcome first.
fn entries(kinds: &[Kind], colours: &[RGBColor], is_one_pair: bool) -> Vec<(Mark, String)> {
    let mut order: Vec<usize> = (0..kinds.len()).filter(|&i| colours[i] != OTHER_COLOUR).collect();
    order.sort_by_key(|&i| std::cmp::Reverse(kinds[i].points));
    let mut entries: Vec<(Mark, String)> =
        order.into_iter().map(|i| (Mark::Cell(colours[i]), kinds[i].name(is_one_pair))).collect();
    let others = colours.iter().filter(|colour| **colour == OTHER_COLOUR).count();
    if others > 0 {
        entries.push((Mark::Cell(OTHER_COLOUR), format!("{others} other periodic orbits")));
    }
    entries
}
