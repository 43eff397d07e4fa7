//! The map of outcomes over two keys.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fmt::Write;

use impact_pair::json::SweepHead;
use impact_pair::scene::{Key, Range};
use impact_pair_answers::grid::{Grid, Points};
use plotters::prelude::*;

use super::kind::{Outcomes, UNDECIDED_COLOUR};
use super::legend::{self, described};
use super::{Cells, Drawn, Plane, value};
use crate::picture::{self, Axis, Canvas, LegendSymbol, Look, SCALE, hex};

/// Radius of the ring around an attractor.
const RING_RADIUS: i32 = 6 * SCALE;
/// The name of a ring in the legend.
const RING_NAME: &str = "an attractor, where it hits the left wall";

/// Draws axes and text, and returns the data as SVG.
pub fn draw(sweep: &mut Points<SweepHead>, grid: &Grid, (root, look): (&Canvas<'_>, &Look)) -> Drawn<String> {
    let [x, y] = grid.axes() else { return Err("a map has two axes".into()) };
    let outcomes = Outcomes::of(sweep, false)?;
    let top = legend::caption(&sweep.head, (root, look))?;
    let legend = outcomes.legend().into_iter().map(|(colour, name)| (LegendSymbol::Cell(colour), name));
    let rings = outcomes.rings();
    let ring_entry = (!rings.is_empty()).then(|| (LegendSymbol::Ring, RING_NAME.to_owned()));
    let entries: Vec<_> = legend.chain(ring_entry).collect();
    let lines = picture::legend(root, top, &entries)?;
    let (_, area) = root.split_vertically(top + lines + 10 * SCALE);
    let plane = Plane::draw(&area, [scale(x), scale(y)], [&described(x.key()), &described(y.key())])?;
    let colour = |point: u64| {
        let kind = outcomes.points.get(point as usize).copied().flatten()?;
        Some(outcomes.colours[kind])
    };
    let rings: String = rings
        .into_iter()
        .map(|([phase, velocity], colour)| ring((plane.column(phase), plane.row(velocity)), colour))
        .collect();
    Ok(cells(&plane, x.points(), y.points(), colour) + &rings)
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
