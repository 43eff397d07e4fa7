//! A trapping region of the scene's motion: [`Trap`].

use std::collections::BTreeMap;

use super::flights::is_positive;
use super::guess::Guess;
use super::law::Law;
use super::quad::State;
use super::refusal::NoTrap;
use super::scene::{ORBIT_IMPACTS, Visited, visited};
use super::trap::{Cell, Grid, Region};
use super::tube::side_of;
use super::words::HSet;
use crate::number::Ball;
use crate::orbit::Start;
use crate::pair::ImpactPair;
use crate::watch::Watch;
use crate::{Effort, Error, Scene};

/// A region of the reduced state space that the impact map maps into itself, proved: boxes of a grid.
///
/// **Enclosure**: a motion with one impact in the region has all its later impacts there, without end. None comes to rest, none has infinitely
/// many impacts in a finite time. [`Trap::flight`] bounds all times of flight, in forcing periods, and [`Trap::speed`] all speeds before
/// impacts, over `A W`. At a graze both continuations are in the region. Lemmas D4, D5
/// **Cost**: about 2 microseconds a box.
///
/// ```
/// use impact_pair::chaos::Trap;
/// use impact_pair::watch::Unwatched;
/// use impact_pair::{Effort, Scene};
/// let scene = Scene::parse(r#"
///     excitation = { amplitude = 8, frequency = "pi", phase = 0 }
///     pair = { gap = 9.42497, restitution = 0.5 }
///     start = { time = 0, wall = "left", velocity = -12.56636 }
/// "#)?;
/// let trap = Trap::of(&scene, Effort::default(), &Unwatched)?.expect("a region");
/// assert!(trap.flight()[0] > 0.05 && trap.flight()[1] < 0.7 && trap.speed()[1] < 2.0);
/// assert!(trap.entered().is_some_and(|impact| impact <= 2));
/// # Ok::<(), impact_pair::Error>(())
/// ```
#[derive(Debug)]
pub struct Trap {
    region: Region,
    flight: [f64; 2],
    entered: Option<u64>,
    coarser: Option<NoTrap>,
}

/// Columns and rows of the coarsest grid, and the number of times that it is doubled at most.
const COARSEST_GRID: (i64, f64) = (256, 32.0);
const DOUBLINGS: u32 = 7;
/// Number of times that the coarsest grid which closes is doubled at most, for narrower bounds.
const MOST_HALVED: u32 = 6;
/// Impacts in floating point before the region is grown from the ball's state.
const TRANSIENT: usize = 2000;

impl Trap {
    /// Proves a region around the attractor of the scene's orbit, in the coarsest grid that closes.
    ///
    /// An effort of 2, 4, .., 64 halves its boxes once, twice, .., 6 times: of a thin attractor there are about twice as many each time. Below
    /// 1 nothing is less, as there is no coarser grid.
    ///
    /// `watch` receives the number of boxes, and may stop it.
    ///
    /// # Errors
    /// With several harmonics, and when a value is beyond the range of double-precision flights.
    pub fn of(scene: &Scene, effort: Effort, watch: &dyn Watch) -> Result<Result<Self, NoTrap>, Error> {
        Self::of_pair(scene.pair(), scene.start(), effort, watch)
    }

    /// Proves a region of a pair, for all its parameters at once.
    ///
    /// # Errors
    /// As [`Trap::of`].
    pub fn of_pair(
        pair: &ImpactPair,
        start: &Start,
        effort: Effort,
        watch: &dyn Watch,
    ) -> Result<Result<Self, NoTrap>, Error> {
        let finer = effort.doubled(0, (0, MOST_HALVED));
        let law = Law::of(pair)?;
        // D5: nothing is claimed
        if law.restitution.mag() >= 1.0 {
            return Ok(Err(NoTrap::Elastic));
        }
        let visited = visited(pair, start, ORBIT_IMPACTS)?;
        let Some(last) = visited.last() else { return Ok(Err(NoTrap::NoImpact)) };
        let guess = Guess::new(&law);
        // proposes: any box may be grown from
        let seed = (0..TRANSIENT).try_fold(last.middle(), |state, _| Some(guess.map(state)?.state));
        let seed = seed.unwrap_or(last.middle()); // proposes: any box may be grown from
        let mut why = NoTrap::Boxes;
        for doubled in 0..=DOUBLINGS {
            let region = grown(&law, doubled, seed, watch);
            let (region, coarser) = match region {
                Ok(region) if finer == 0 => (region, None),
                // D5: either is closed
                Ok(region) => match grown(&law, doubled + finer, seed, watch) {
                    Ok(finer) => (finer, None),
                    Err(why) => (region, Some(why)),
                },
                Err(reason) => {
                    why = reason;
                    if matches!(why, NoTrap::Interrupted | NoTrap::Boxes) {
                        break;
                    }
                    continue;
                }
            };
            let trap = Self { coarser, ..Self::around(region, &visited) };
            // Lemma D5: flights that last prove that nothing rests
            if trap.flight[0] > 0.0 {
                return Ok(Ok(trap));
            }
            why = NoTrap::Rest;
        }
        Ok(Err(why))
    }

    fn around(region: Region, visited: &[Visited]) -> Self {
        let times = region.cells.values().map(|reach| reach.time);
        let flight = times.fold([f64::INFINITY, 0.0], |[a, b], [c, d]| [a.min(c), b.max(d)]); // D5: the outer ends
        let entered =
            visited.iter().find(|state| region.holds(state.phase, state.speed) == Some(true)).map(|state| state.index);
        Self { region, flight, entered, coarser: None }
    }

    /// The boxes.
    pub(super) fn region(&self) -> &Region {
        &self.region
    }

    /// Reason why no region of the finer grid of the effort is proved; `None` where this region is of that grid.
    pub fn coarser(&self) -> Option<NoTrap> {
        self.coarser
    }

    /// Number of boxes.
    pub fn boxes(&self) -> usize {
        self.region.cells.len()
    }

    /// Columns of the grid in a forcing period, and rows of the grid in a speed of `A W`.
    pub fn grid(&self) -> (i64, f64) {
        (self.region.grid.columns, self.region.grid.rows)
    }

    /// Bounds of the times of all flights, in forcing periods.
    pub fn flight(&self) -> [f64; 2] {
        self.flight
    }

    /// Bounds of the speeds before all impacts, over `A W`.
    pub fn speed(&self) -> [f64; 2] {
        let rows = self.region.cells.keys().map(|&(_, row)| f64::from(row));
        let [low, high] = rows.fold([f64::INFINITY, 0.0], |[a, b], row| [a.min(row), b.max(row + 1.0)]); // D5: the outer ends
        [low / self.region.grid.rows, high / self.region.grid.rows] // exact: a power of two
    }

    /// Impact of the scene's own orbit from which on all impacts are in the region, 0 for the start; `None` if none of the first hundred impacts
    /// is proved to be.
    pub fn entered(&self) -> Option<u64> {
        self.entered
    }

    /// Whether all states of an h-set are proved to be in the region. Lemma D13
    pub fn holds(&self, base: &HSet) -> bool {
        let Grid { columns, rows } = self.region.grid;
        let round = [base.left.bottom, base.right.bottom, base.right.top, base.left.top];
        let ends = |i: usize| {
            let all = round.map(|state| state[i]);
            all.into_iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]) // D13: the outer ends
        };
        let cells = |[low, high]: [f64; 2], per: f64| (low * per).floor() as i64..=(high * per).floor() as i64; // D13: of both ends, exact: per is a power of two
        let (across, up) = (cells(ends(0), columns as f64), cells(ends(1), rows)); // exact: a power of two
        let is_outside = |column: i64, row: i64| {
            let corner = |i: i64, j: i64| [(column + i) as f64 / columns as f64, (row + j) as f64 / rows]; // exact: powers of two
            let corners = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            (0..4).any(|k| {
                let beyond = |&state: &State| is_positive(-side_of(round[k], round[(k + 1) % 4], state, 0.0));
                corners.iter().all(beyond)
            })
        };
        let holds = |column: i64, row: i64| {
            let row = i32::try_from(row).ok();
            let cell = row.map(|row| -> Cell { (column.rem_euclid(columns) as i32, row) }); // exact: fewer than 2^31
            cell.is_some_and(|cell| self.region.cells.contains_key(&cell))
        };
        across.into_iter().all(|column| up.clone().all(|row| holds(column, row) || is_outside(column, row)))
    }

    /// Boxes as runs of rows by column, each run by its first and its last row.
    pub fn columns(&self) -> BTreeMap<i32, Vec<(i32, i32)>> {
        let mut rows: BTreeMap<i32, Vec<i32>> = BTreeMap::new();
        for &(column, row) in self.region.cells.keys() {
            rows.entry(column).or_default().push(row);
        }
        let runs = |mut rows: Vec<i32>| {
            rows.sort_unstable();
            let mut runs: Vec<(i32, i32)> = Vec::new();
            for row in rows {
                match runs.last_mut() {
                    Some((_, last)) if *last + 1 == row => *last = row,
                    _ => runs.push((row, row)),
                }
            }
            runs
        };
        rows.into_iter().map(|(column, rows)| (column, runs(rows))).collect()
    }
}

fn grown(law: &Law, doubled: u32, seed: [f64; 2], watch: &dyn Watch) -> Result<Region, NoTrap> {
    let more = 1_i64 << doubled;
    let grid = Grid { columns: COARSEST_GRID.0 * more, rows: COARSEST_GRID.1 * more as f64 }; // exact: a power of two
    let cell = grid.cell(seed[0], seed[1]);
    Region::grow(law, grid, cell, watch)
}

impl Region {
    /// `Some(true)` if all states with such a phase and speed are proved to be in the region, `Some(false)` if none of them is; else `None`.
    pub(super) fn holds(&self, phase: Ball, speed: Ball) -> Option<bool> {
        let Grid { columns, rows } = self.grid;
        let cells = |x: Ball, per: f64| {
            // D5: the boxes of both ends, outward; where there are too many nothing is certified
            let ends = [(x.mid() - x.rad()).next_down() * per, (x.mid() + x.rad()).next_up() * per];
            let [low, high] = ends.map(f64::floor); // D5: the box of an end
            (high - low < 1e3 && high.abs() < 1e15).then_some(low as i64..=high as i64) // exact: small whole numbers
        };
        let (Some(across), Some(up)) = (cells(phase, columns as f64), cells(speed, rows)) else { return None }; // exact: a power of two
        // Speeds are not negative.
        let up = up.filter(|&row| row >= 0).collect::<Vec<_>>();
        let all = across.flat_map(|column| up.iter().map(move |&row| (column.rem_euclid(columns), row)));
        let mut are_in = all.into_iter().map(|(column, row)| {
            i32::try_from(row).is_ok_and(|row| self.cells.contains_key(&(column as i32, row))) // exact: fewer than 2^31
        });
        let first = are_in.next()?;
        are_in.all(|is_in| is_in == first).then_some(first)
    }
}
