//! The bifurcation diagram: the impacts of each point over one key.

use std::collections::BTreeMap;

use impact_pair::json::vocabulary::PointOutcome;
use plotters::prelude::*;

use super::Show;
use super::legend::{self, described};
use super::{Cells, Drawn, Plane, double, middle, value};
use crate::picture::{self, Axis, BLUE, Canvas, GREEN, LegendSymbol, Look, SCALE, VERMILION};
use impact_pair::json::{SweepHead, SweepImpact, SweepRecord};
use impact_pair::scene::Range;
use impact_pair_answers::grid::Points;

/// The smallest cell: less than a pixel of most screens.
const MIN_CELL: i32 = 3;
/// The largest cell, for few points.
const MAX_CELL: i32 = 2 * SCALE;
/// Width added around the cells of periodic orbits, in pixels of the canvas.
const EDGE_WIDTH: i32 = 2;
/// Height of the bar over an undecided point.
const BAR_HEIGHT: i32 = 8 * SCALE;

/// The kind of outcome of a point in a diagram; later ones are drawn on top.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum PointClass {
    UndecidedLimit,
    Attracted,
    Settled,
    Undecided,
}

impl PointClass {
    fn of(record: &SweepRecord) -> Self {
        match record.outcome {
            PointOutcome::Attracted => Self::Attracted,
            PointOutcome::Undecided => Self::Undecided,
            PointOutcome::UndecidedLimit => Self::UndecidedLimit,
            PointOutcome::Periodic | PointOutcome::RestsForever | PointOutcome::NeverImpacts => Self::Settled,
        }
    }

    fn colour(self) -> RGBColor {
        match self {
            Self::Attracted => BLUE,
            Self::UndecidedLimit => BLACK,
            Self::Settled => GREEN,
            Self::Undecided => VERMILION,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Attracted => "proved to converge to a periodic orbit",
            Self::UndecidedLimit => "undecided convergence",
            Self::Settled => "periodic through rest, or at an end",
            Self::Undecided => "undecided (bar), impacts before",
        }
    }
}

/// The impacts of points of one class: for each column of cells the rows.
type Columns = BTreeMap<i32, Vec<i32>>;

/// Draws axes and text, and returns the data as SVG.
pub fn draw(
    sweep: &mut Points<SweepHead>,
    axis: &Range,
    (show, within): (Show, Option<[f64; 2]>),
    (root, look): (&Canvas<'_>, &Look),
) -> Drawn<String> {
    let (present, greatest) = survey(sweep)?;
    let top = legend::caption(&sweep.head, (root, look))?;
    let entries: Vec<(LegendSymbol, String)> =
        present.iter().map(|class| (LegendSymbol::Cell(class.colour()), class.name().to_owned())).collect();
    let lines = picture::legend(root, top, &entries)?;
    let (_, below) = root.split_vertically(top + lines);
    let across = Axis::between(value(axis.low()), value(axis.high()));
    let (up, name) = match show {
        Show::Phase => (Axis::angle(), "phase $Ωt + τ$ of the impact [rad]"),
        Show::Velocity => {
            (Axis::over(-1.05 * greatest, 1.05 * greatest), "relative velocity $y′$ before the impact [length/time]")
        }
    };
    let up = within.map_or(up, |[low, high]| Axis::over(low, high));
    let plane = Plane::draw(&below, [across, up], [&described(axis.key()), name])?;
    let (left, right) = plane.pixels[0];
    let spacing = (right - left) / i32::try_from(axis.points() - 1).unwrap_or(i32::MAX);
    // Each point has its own column beside its neighbours' columns, or shares the narrowest visible column.
    let (grain, width) = if spacing < MIN_CELL { (MIN_CELL, MIN_CELL) } else { (1, (spacing + 1).min(MAX_CELL)) };
    let mut columns: BTreeMap<PointClass, Columns> = BTreeMap::new();
    let mut bars = Cells::default();
    sweep.each_record(|record| {
        let class = PointClass::of(&record);
        let column = plane.column(value(&axis.value(record.point, axis.points() - 1)?));
        for state in &record.states {
            // A box if it is wide enough to be seen, from its upper bound down.
            let bounds = bounds(state, show)?;
            if !plane.shows(bounds) {
                continue;
            }
            let [bottom, top] = bounds.map(|y| plane.row(y) / MIN_CELL);
            let rows = columns.entry(class).or_default().entry(column / grain).or_default();
            rows.extend(top..=bottom);
            if rows.len() > 1 << 14 {
                rows.sort_unstable();
                rows.dedup();
            }
        }
        if class == PointClass::Undecided {
            bars.add((column - width / 2, plane.pixels[1].0 - BAR_HEIGHT), (width.max(SCALE), BAR_HEIGHT));
        }
        Ok(())
    })?;
    let data: String = columns.into_iter().map(|(class, columns)| path(class, columns, (grain, width))).collect();
    Ok(data + &bars.element(VERMILION))
}

/// The classes that occur, and the greatest speed.
fn survey(sweep: &mut Points<SweepHead>) -> Drawn<(Vec<PointClass>, f64)> {
    let (mut present, mut greatest) = (Vec::new(), f64::MIN_POSITIVE);
    sweep.each_record(|record| {
        present.push(PointClass::of(&record));
        present.sort_unstable();
        present.dedup();
        for state in &record.states {
            greatest = middle(&state.velocity)?.abs().max(greatest);
        }
        Ok(())
    })?;
    Ok((present, greatest))
}

/// The bounds of the phase or the velocity of an impact, whichever is shown.
fn bounds(state: &SweepImpact, show: Show) -> anyhow::Result<[f64; 2]> {
    let bounds = match show {
        Show::Phase => &state.phase,
        Show::Velocity => &state.velocity,
    };
    Ok([double(&bounds[0])?, double(&bounds[1])?])
}

/// The cells of a class; adjacent cells of a column are joined.
fn path(class: PointClass, columns: Columns, (grain, width): (i32, i32)) -> String {
    // Lines are drawn thick enough to be seen, dense clouds are not.
    let edge = if class == PointClass::UndecidedLimit && width < MAX_CELL { 0 } else { EDGE_WIDTH };
    let mut cells = Cells::default();
    for (column, mut rows) in columns {
        rows.sort_unstable();
        rows.dedup();
        for run in rows.chunk_by(|a, b| a + 1 == *b) {
            let corner = (column * grain - width / 2 - edge, run[0] * MIN_CELL - MIN_CELL / 2 - edge);
            cells.add(corner, (width + 2 * edge, MIN_CELL * run.len() as i32 + 2 * edge));
        }
    }
    cells.element(class.colour())
}
