//! A trapping region, made of boxes: Lemmas D4, D5 of `docs/proofs/chaos.md#D4`.

use std::collections::{HashMap, HashSet};

use super::flights::{Flights, View, is_positive};
use super::law::{Law, Side};
use super::quad::Quad;
use super::refusal::{NoTrap, Refusal};
use crate::number::{Ball, Number};
use crate::threads;
use crate::watch::{Stage, Watch};

/// Boxes `[i, i + 1]/M x [j, j + 1]/R` of phase in forcing periods modulo 1 and speed over `A W`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    /// `M`, even, and `R`.
    pub columns: i64,
    pub rows: f64,
}

/// A box of a grid: column and row.
pub(crate) type Cell = (i32, i32);

/// Bounds of all flights from a box.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reach {
    /// Bounds of the time of flight, in forcing periods.
    pub time: [f64; 2],
    /// Flags of the walls that may be touched: the near one, the far one.
    pub sides: [bool; 2],
}

/// Flights that land in a column of phases.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arrivals {
    /// Column of the landing, counted on from the start's forcing period.
    pub column: i64,
    pub side: Side,
    /// Bounds of their speeds.
    pub speeds: [f64; 2],
}

/// Greatest time of flight that is followed, in forcing periods.
const MAX_FLIGHT: f64 = 64.0;
/// The most rows that are counted.
const MAX_ROWS: f64 = 2_147_483_647.0;
/// Number of times that a box is cut at most, to distinguish its balls from those at rest.
const MAX_CUTS: u32 = 6;

impl Grid {
    /// Box that holds a state.
    pub fn cell(&self, phase: f64, speed: f64) -> Cell {
        let column = (phase * self.columns as f64).floor().rem_euclid(self.columns as f64); // proposes: where a region begins
        (column as i32, (speed * self.rows).floor() as i32) // proposes: where a region begins
    }

    /// Boxes that states between these phases and between these speeds may be in; `None` of more than a few.
    pub fn boxes_between(&self, phases: [f64; 2], speeds: [f64; 2]) -> Option<Vec<Cell>> {
        /// Boxes along a side of the enclosure of a cycle: those of a point take one or two.
        const MOST_BOXES_ACROSS: f64 = 64.0;
        // columns and rows are powers of two, so that products are exact
        let [first, last] = phases.map(|phase| (phase * self.columns as f64).floor()); // A8: the box of a phase
        let [lowest, highest] = speeds.map(|speed| (speed * self.rows).floor()); // A8: the box of a speed
        let is_few = last - first < MOST_BOXES_ACROSS
            && highest - lowest < MOST_BOXES_ACROSS
            && first.abs() < MAX_ROWS
            && highest.abs() < MAX_ROWS;
        is_few.then(|| {
            let columns = (first as i64..=last as i64).map(|column| column.rem_euclid(self.columns) as i32); // exact: below 2^31
            let rows = lowest as i32..=highest as i32; // exact: below 2^31
            columns.flat_map(|column| rows.clone().map(move |row| (column, row))).collect()
        })
    }

    /// The rectangle of a box.
    pub fn quad(&self, (column, row): Cell) -> Quad {
        let (column, row) = (f64::from(column), f64::from(row));
        // exact: columns and rows are powers of two
        let radii = [0.5 / self.columns as f64, 0.5 / self.rows];
        let centre = [(2.0 * column + 1.0) * radii[0], (2.0 * row + 1.0) * radii[1]];
        Quad::rectangle(centre, radii, row / self.rows)
    }

    /// Notes the boxes that all images of the states of a rectangle lie in, and the walls of the flights there. Lemma D4
    pub fn image(&self, law: &Law, quad: &Quad, note: &mut dyn FnMut(Side, Cell)) -> Result<Reach, NoTrap> {
        let mut has_rows = true;
        let reach = self.landings(law, quad, &mut |Arrivals { column, side, speeds }| {
            let shift = if side == Side::Far { self.columns / 2 } else { 0 };
            let column = (column + shift).rem_euclid(self.columns) as i32; // exact: fewer than 2^31
            let [low, high] = speeds.map(|speed| (speed * self.rows).floor()); // D4: of both ends
            // D4: else a box is not counted, and no comparison with NaN holds
            if high < MAX_ROWS {
                (low as i32..=high as i32).for_each(|row| note(side, (column, row))); // exact: fewer than 2^31
            } else {
                has_rows = false;
            }
        })?;
        if has_rows { Ok(reach) } else { Err(NoTrap::Fast) }
    }

    /// Notes where all flights from a rectangle may land, column by column. Lemma D4
    pub fn landings(&self, law: &Law, quad: &Quad, note: &mut dyn FnMut(Arrivals)) -> Result<Reach, Refusal> {
        self.cut_landings(law, quad, MAX_CUTS, note)
    }

    fn cut_landings(
        &self,
        law: &Law,
        quad: &Quad,
        cuts: u32,
        note: &mut dyn FnMut(Arrivals),
    ) -> Result<Reach, Refusal> {
        let flights = Flights::new(law, quad);
        match flights.depart() {
            Some(from) => self.scan_columns(law, &flights, from, note),
            None if cuts == 0 => Err(Refusal::Rest),
            None => {
                let ([u, w], [r, s]) = (quad.centre, [0.5 * quad.sides[0][0], 0.5 * quad.sides[1][1]]);
                let mut all: Option<Reach> = None;
                for (phase, speed) in [(u - r, w - s), (u - r, w + s), (u + r, w - s), (u + r, w + s)] {
                    // exact: cut in halves
                    let part = Quad::rectangle([phase, speed], [r, s], speed - s);
                    let reach = self.cut_landings(law, &part, cuts - 1, note)?;
                    all = Some(all.map_or(reach, |all| all.with(&reach)));
                }
                all.ok_or(Refusal::Rest)
            }
        }
    }

    /// Goes along the phases of arrival, column by column where a wall may be touched, until it certainly has been.
    fn scan_columns(
        &self,
        law: &Law,
        flights: &Flights,
        from: f64,
        note: &mut dyn FnMut(Arrivals),
    ) -> Result<Reach, Refusal> {
        let columns = self.columns as f64; // exact: a power of two
        let mut reach = Reach { time: [f64::INFINITY, 0.0], sides: [false; 2] };
        let mut column = (from * columns).floor() as i64; // D4: the column that it is in
        let mut step: i64 = 1;
        let end = column + (MAX_FLIGHT * columns) as i64; // exact: a power of two
        while column < end {
            let low = from.max(column as f64 / columns); // D4: nothing is touched before
            let high = (column + step) as f64 / columns; // exact: a power of two
            let view = flights.over(low, high);
            let above = law.gap - view.height;
            if is_positive(view.height) && is_positive(above) {
                column += step;
                step *= 2;
                continue;
            }
            if is_positive(-view.height) || is_positive(-above) {
                return Ok(reach);
            }
            if step > 1 {
                step /= 2;
                continue;
            }
            for (k, side) in [Side::Near, Side::Far].into_iter().enumerate() {
                if let Some(speeds) = flights.arrivals(side, low, high, &view) {
                    note(Arrivals { column, side, speeds });
                    reach.sides[k] = true;
                    let time = flights.times(low, high);
                    reach.time = [reach.time[0].min(time[0]), reach.time[1].max(time[1])]; // D4: the outer ends
                }
            }
            column += 1;
        }
        Err(Refusal::Long)
    }
}

impl Reach {
    fn with(self, other: &Self) -> Self {
        let time = [self.time[0].min(other.time[0]), self.time[1].max(other.time[1])]; // D4: the outer ends
        Self { time, sides: [self.sides[0] || other.sides[0], self.sides[1] || other.sides[1]] }
    }
}

/// A region closed under the impact map.
#[derive(Debug)]
pub(crate) struct Region {
    pub grid: Grid,
    pub cells: HashMap<Cell, Reach>,
}

/// Number of boxes beyond which a region is given up.
const MAX_BOXES: usize = 4_000_000;

impl Region {
    /// Grows a box to the least closed region of boxes of this grid.
    ///
    /// `Err` with the reason where it does not close.
    pub fn grow(law: &Law, grid: Grid, seed: Cell, watch: &dyn Watch) -> Result<Self, NoTrap> {
        let mut cells: HashMap<Cell, Reach> = HashMap::new();
        let mut known: HashSet<Cell> = HashSet::from([seed]);
        let mut frontier = vec![seed];
        while !frontier.is_empty() {
            if watch.proceed(Stage::Region(known.len())).is_break() {
                return Err(NoTrap::Interrupted);
            }
            if known.len() > MAX_BOXES {
                return Err(NoTrap::Boxes);
            }
            let results = threads::each(&threads::shares(&frontier), &|(_, part)| {
                let mut found = HashSet::new();
                let mut note = |_, cell| _ = found.insert(cell);
                let reaches: Result<Vec<_>, NoTrap> =
                    part.iter().map(|&cell| Ok((cell, grid.image(law, &grid.quad(cell), &mut note)?))).collect();
                reaches.map(|reaches| (reaches, found))
            });
            frontier.clear();
            for result in results {
                let (reaches, found) = result?;
                cells.extend(reaches);
                frontier.extend(found.into_iter().filter(|&cell| known.insert(cell)));
            }
        }
        Ok(Self { grid, cells })
    }
}

impl Flights {
    /// The speeds of all arrivals between two phases at which a wall may be touched; `None` if none is. Lemma D4
    pub(super) fn arrivals(&self, side: Side, low: f64, high: f64, view: &View) -> Option<[f64; 2]> {
        let far = side == Side::Far;
        let miss = if far { view.height - self.gap() } else { view.height };
        if is_positive(miss) || is_positive(-miss) {
            return None;
        }
        let sign = if far { 1.0 } else { -1.0 };
        let rate = view.rate.signed(sign);
        let mut bounds = [(rate.mid() - rate.rad()).next_down(), (rate.mid() + rate.rad()).next_up()];
        if let Some(velocity) = self.velocity_by_phases(if far { self.gap() } else { Ball::exact(0.0) }, low, high) {
            let velocity = velocity.signed(sign);
            // D4: both hold the speeds
            bounds[0] = bounds[0].max((velocity.mid() - velocity.rad()).next_down());
            bounds[1] = bounds[1].min((velocity.mid() + velocity.rad()).next_up()); // D4: both hold them
        }
        bounds[0] = bounds[0].max(0.0); // D4: who comes from inside
        (bounds[0] <= bounds[1]).then_some(bounds)
    }
}
