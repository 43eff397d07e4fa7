//! Images of boxes: all that may follow their states. Lemmas A1-A5 of `docs/proofs/global.md#A1`.

use std::f64::consts::TAU;

use crate::chaos::flights::{Flights, is_positive};
use crate::chaos::law::{Law, Side};
use crate::chaos::trap::{Cell, Grid};
use crate::number::{Ball, UNIT, up};

/// An event that may follow a state of a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Next {
    /// The ball rests, and is released.
    Release,
    /// An impact at a phase of a column that was not requested.
    Elsewhere,
    /// An impact in a box; on the far wall, or on the near one; `stays`: there, in the column of phases of the impact before, in the same
    /// forcing period.
    Impact { cell: Cell, stays: bool, is_far: bool },
}

/// The reduced map with the speeds that motions have in the end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Space {
    law: Law,
    /// Bounds of `e` and of `D`.
    restitution: [f64; 2],
    gap: [f64; 2],
}

/// Speeds are followed up to a multiple of this that is greater than `2/(1 - e)`.
const SPEED_STEP: f64 = 1.0 / 64.0;
/// Restitutions nearer to 1 are refused: boxes would be too many.
const MOST_RESTITUTION: f64 = 0.99;
/// The most forcing periods of flights that are followed, and of those that may end in several; longer ones land with any of the phases
/// that slow ones have.
const MAX_FLIGHT: f64 = 64.0;
const MAX_BRANCHING_FLIGHT: f64 = 2.0;
/// The greatest phase, in forcing periods, and speed of the parts that boxes are cut into, and the most parts along each side.
const PART_WIDTH: f64 = 1.0 / 256.0;
const PART_HEIGHT: f64 = 0.04;
const MOST_PARTS: u32 = 8;
/// Times for which flights may be proved not to touch the near wall, in radians.
const DEPARTURE_TIMES: [f64; 12] =
    [3.0, 2.0, 1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125, 0.015625, 0.0078125, 0.00390625, 0.001953125];
/// Parts of the time until the contact force vanishes in which a chatter may end: each is tried.
const CHATTER_WINDOWS: [f64; 6] = [0.0625, 0.125, 0.25, 0.5, 0.75, 0.875];

/// Bounds of a ball's members.
pub(super) fn ends(x: Ball) -> [f64; 2] {
    [(x.mid() - x.rad()).next_down(), (x.mid() + x.rad()).next_up()]
}

/// Bounds of the flights from a part of a box.
struct Part {
    /// Bounds of `e w`.
    after: [f64; 2],
    phases: [f64; 2],
    /// The column of the box.
    home: i64,
    /// Flights that are not longer do not touch the near wall, in radians.
    lifted: f64,
}

impl Part {
    /// Bounds of the speeds of contacts with the near wall up to a phase. Lemma A3
    fn near(&self, phase: f64) -> [f64; 2] {
        let long = angle([self.phases[0], phase]);
        let [least, most] = self.after;
        let by = up(long * long / 6.0);
        [(least - up(by + 4.0 * UNIT * least)).max(0.0), up(most + by)] // A3: not negative
    }
}

/// An upper bound of the angle between two phases.
fn angle([low, high]: [f64; 2]) -> f64 {
    up(TAU * (high - low) * (1.0 + 4.0 * UNIT))
}

/// A time for which no flight with at least this speed from these phases touches the near wall, in radians; 0 where none is proved. Lemma A3
fn lifted(least: f64, phases: [f64; 2]) -> f64 {
    let (sin, cos) = over(phases);
    let [down, below] = [sin, cos].map(|x| (-ends(x)[0]).max(0.0)); // A3: how far below 0
    let is_lifted = |long: f64| {
        let sixth = up(long * long / 6.0);
        let falls = up(up(below * sixth) + up(0.5 * down * long));
        least > falls
            || phases[1] <= 0.25 // A3: sine and cosine are not negative
            || phases[1] <= 0.5
                && ends(sin)[0] * (0.5 - up(long * long / 24.0)) > up(up(cos.mag() * long / 6.0) * (1.0 + 4.0 * UNIT))
    };
    DEPARTURE_TIMES.into_iter().find(|&long| is_lifted(long)).unwrap_or(0.0) // A3: no such time
}

impl Space {
    /// `None` where `e` is not proved to be below 0.99.
    pub fn new(law: Law) -> Option<Self> {
        let [low, high] = ends(law.restitution);
        let restitution = [low.max(0.0), high]; // A1: e >= 0
        (high < MOST_RESTITUTION).then_some(Self { law, restitution, gap: ends(law.gap) })
    }

    pub fn law(&self) -> &Law {
        &self.law
    }

    /// Speed that no motion exceeds in the end: a multiple of 1/64. Lemma A1
    pub fn fastest(&self) -> f64 {
        let limit = 2.0 / (1.0 - self.restitution[1]) * (1.0 + 8.0 * UNIT);
        SPEED_STEP * ((limit / SPEED_STEP).floor() + 1.0) // A1: greater than the limit
    }

    /// Notes all events that may follow the states of a box. Long flights, which land in all columns, are noted in the columns
    /// `requested`, which are in order. Returns the work: views of flights, columns of long ones, and noted events.
    pub fn images(&self, grid: Grid, (column, row): Cell, requested: &[i32], note: &mut dyn FnMut(Next)) -> u64 {
        let [columns, rows] = [grid.columns as f64, grid.rows]; // exact: powers of two
        let phases = [f64::from(column) / columns, f64::from(column + 1) / columns];
        let speeds = [f64::from(row) / rows, f64::from(row + 1) / rows];
        if self.chatters(phases, speeds[1]) {
            note(Next::Release);
            return 1;
        }
        if self.after(speeds)[0] <= 0.0 && phases[1] >= 0.5 {
            note(Next::Release); // A2: a ball that is pressed
        }
        let parts = |length: f64, most: f64| {
            let halvings = (length / most).log2().ceil().clamp(0.0, f64::from(MOST_PARTS.ilog2())); // A2: any parts
            2_i32.pow(halvings as u32) // A2: any parts
        };
        let [across, along] = [parts(1.0 / columns, PART_WIDTH), parts(1.0 / rows, PART_HEIGHT)];
        let finer = Grid { columns: grid.columns * i64::from(across), rows: rows * f64::from(along) };
        let mut work = 1;
        for i in 0..across {
            for j in 0..along {
                let part = (column * across + i, row * along + j);
                work += self.part((grid, requested), finer, part, i64::from(column), note);
            }
        }
        work
    }

    /// Bounds of the speeds with which balls of such speeds leave.
    fn after(&self, [low, high]: [f64; 2]) -> [f64; 2] {
        let [least, most] = self.restitution;
        [(least * low).next_down().max(0.0), (most * high).next_up()] // A1: speeds and e are not negative
    }

    /// Notes what may follow the states of a part of a box.
    fn part(
        &self,
        (grid, requested): (Grid, &[i32]),
        finer: Grid,
        (column, row): Cell,
        home: i64,
        note: &mut dyn FnMut(Next),
    ) -> u64 {
        let (columns, rows) = (finer.columns as f64, finer.rows); // exact: powers of two
        let phases = [f64::from(column) / columns, f64::from(column + 1) / columns];
        let after = self.after([f64::from(row) / rows, f64::from(row + 1) / rows]);
        let part = Part { after, phases, home, lifted: lifted(after[0], phases) };
        let [near, far] = self.within(&part);
        let mut work = 0;
        if let Some(speeds) = near {
            work += self.land(grid, Side::Near, home, speeds, true, note);
        }
        if let Some(speeds) = far {
            work += self.land(grid, Side::Far, home, speeds, false, note);
        }
        work + self.note_later_contacts(
            (grid, requested),
            &Flights::new(&self.law, &finer.quad((column, row))),
            &part,
            note,
        )
    }

    /// Bounds of the speeds of contacts at the phases of a part, of either wall; `None` where there is none. Lemma A3
    fn within(&self, part: &Part) -> [Option<[f64; 2]>; 2] {
        let Part { after: [least, most], phases, .. } = *part;
        let long = angle(phases);
        let near = (part.lifted < long).then(|| part.near(phases[1]));
        let is_far = self.gap[0] <= up(long * up(most + up(0.5 * long + up(long * long / 6.0))));
        let far = is_far.then(|| [(least - up(long + 4.0 * UNIT * least)).max(0.0), up(most + long)]); // A3: not negative
        [near, far]
    }

    /// Notes the contacts at later phases. Lemmas D4, A4
    fn note_later_contacts(
        &self,
        (grid, requested): (Grid, &[i32]),
        flights: &Flights,
        part: &Part,
        note: &mut dyn FnMut(Next),
    ) -> u64 {
        let columns = grid.columns as f64; // exact: a power of two
        let from = part.phases[1];
        let first = (from * columns).floor() as i64; // D4: the column that it is in
        let longest = self.longest_flight(flights);
        let end = first + (longest * columns) as i64; // exact: a power of two
        let (mut column, mut step, mut work) = (first, 1, 0);
        while column < end {
            work += 1;
            let low = from.max(column as f64 / columns); // D4: phases after all starts
            let high = (column + step) as f64 / columns; // exact: a power of two
            let view = flights.over(low, high);
            let above = self.law.gap - view.height;
            if is_positive(view.height) && is_positive(above) {
                column += step;
                step *= 2;
                continue;
            }
            if is_positive(-view.height) || is_positive(-above) {
                return work;
            }
            if step > 1 {
                step /= 2;
                continue;
            }
            let late = (low - from >= 1.0).then(|| self.drifts(flights, low - from));
            let since = angle([part.phases[0], high]);
            for side in [Side::Near, Side::Far] {
                if side == Side::Near && since <= part.lifted {
                    continue;
                }
                if late.is_some_and(|drifts| !may_land_late(side, drifts, [low, high])) {
                    continue;
                }
                if let Some(mut speeds) = flights.arrivals(side, low, high, &view) {
                    if side == Side::Near && since < 1.0 {
                        let [least, most] = part.near(high);
                        speeds = [speeds[0].max(least), speeds[1].min(most)]; // A3: both hold them
                    }
                    work += self.land(grid, side, column, speeds, side == Side::Near && column == part.home, note);
                }
            }
            column += 1;
        }
        work + self.slow((grid, requested), self.drifts(flights, longest - 1.0), note)
    }

    /// Number of forcing periods for which flights are followed: few where flights may end in several forcing periods.
    fn longest_flight(&self, flights: &Flights) -> f64 {
        let [low, high] = ends(flights.drifts());
        let [least, most] = [high.abs(), low.abs()].map(|drift| self.gap[1] / drift); // proposes: any number of them
        let is_spread = low * high <= 0.0 || (most - least).abs() > TAU; // proposes: any number of them
        if is_spread { MAX_BRANCHING_FLIGHT } else { MAX_FLIGHT }
    }

    /// Bounds of the drifts of flights that have touched no wall for `periods` forcing periods. Lemma A4
    fn drifts(&self, flights: &Flights, periods: f64) -> [f64; 2] {
        let [low, high] = ends(flights.drifts());
        let angle = TAU * periods * (1.0 - 8.0 * UNIT);
        [low.max(-up(2.0 / angle)), high.min(up(up(self.gap[1] + 2.0) / angle))] // A4: the heights are between the walls
    }

    /// Notes the contacts of flights that have lasted long, at any phase that these have, in the columns that are requested. Lemma A4
    fn slow(&self, (grid, requested): (Grid, &[i32]), drifts: [f64; 2], note: &mut dyn FnMut(Next)) -> u64 {
        if drifts[0] > drifts[1] {
            return 0; // A4: there is none
        }
        let is_all = requested.len() as i64 == grid.columns; // exact: a length
        if !is_all {
            note(Next::Elsewhere);
        }
        let columns = grid.columns as f64; // exact: a power of two
        let mut work = requested.len() as u64; // exact: a length
        for side in [Side::Near, Side::Far] {
            let shift = if side == Side::Far { grid.columns / 2 } else { 0 };
            for &column in requested {
                let column = (i64::from(column) + shift).rem_euclid(grid.columns);
                let phases = [column as f64 / columns, (column + 1) as f64 / columns]; // exact: a power of two
                let cos = ends(over(phases).1);
                if may_land_late(side, drifts, phases) {
                    let speeds = match side {
                        Side::Near => [cos[0] - drifts[1], cos[1] - drifts[0]],
                        Side::Far => [drifts[0] - cos[1], drifts[1] - cos[0]],
                    };
                    let [low, high] = [speeds[0].next_down().max(0.0), speeds[1].next_up()]; // D4: who comes from inside
                    if low <= high {
                        work += self.land(grid, side, column, [low, high], false, note);
                    }
                }
            }
        }
        work
    }

    /// Notes the boxes of contacts in a column with such speeds, and returns their number.
    fn land(
        &self,
        grid: Grid,
        side: Side,
        column: i64,
        speeds: [f64; 2],
        stays: bool,
        note: &mut dyn FnMut(Next),
    ) -> u64 {
        let shift = if side == Side::Far { grid.columns / 2 } else { 0 };
        let column = (column + shift).rem_euclid(grid.columns) as i32; // exact: fewer than 2^31
        let last = (self.fastest() * grid.rows) as i32 - 1; // exact: a whole number
        let [low, high] = speeds.map(|speed| (speed * grid.rows).floor() as i32); // D4: of both ends
        let high = high.min(last); // A1: none is faster
        (low..=high).for_each(|row| note(Next::Impact { cell: (column, row), stays, is_far: side == Side::Far }));
        (low..=high).count() as u64 // exact: a length
    }

    /// Whether all chatters that begin at these phases with at most this speed are complete: Z1 for all of these states. Lemma A5
    pub fn chatters(&self, [from, to]: [f64; 2], speed: f64) -> bool {
        if !(from > 0.5 && to < 1.0) {
            return false; // A5: only where the ball is pressed
        }
        let fast = up(self.restitution[1] * speed);
        CHATTER_WINDOWS.iter().any(|part| {
            let end = to + part * (1.0 - to);
            let force = [from, end].map(|phase| ends(-Ball::exact(phase).sin_cos().0));
            let least = force[0][0].min(force[1][0]); // A5: the sine has one minimum there
            let most = if from <= 0.75 && end >= 0.75 { 1.0 } else { force[0][1].max(force[1][1]) }; // A5: and is monotone else
            if least <= 0.0 {
                return false; // A5: not proved
            }
            let ratio = up(self.restitution[1] * up((most / least).sqrt() * (1.0 + 4.0 * UNIT)));
            let time = up(2.0 * fast) / (least * (1.0 - ratio) * (1.0 - 8.0 * UNIT));
            ratio < 1.0
                && up(fast * fast) < 2.0 * least * self.gap[0] * (1.0 - 8.0 * UNIT)
                && up(time) <= TAU * (end - to) * (1.0 - 8.0 * UNIT)
        })
    }
}

/// Sine and cosine over phases.
fn over([low, high]: [f64; 2]) -> (Ball, Ball) {
    let middle = 0.5 * (low + high);
    Ball::new(middle, up((middle - low).max(high - middle))).sin_cos() // D1: the farther end
}

/// Whether a flight of more than a forcing period, with such a drift, may end at such phases. Lemma A4
fn may_land_late(side: Side, [low, high]: [f64; 2], phases: [f64; 2]) -> bool {
    let sin = ends(over(phases).0);
    let fall = |drift: f64| up(TAU * drift * (1.0 + 4.0 * UNIT));
    match side {
        Side::Near => low <= 0.0 && sin[1] >= (1.0 - fall(-low)).next_down(),
        Side::Far => high >= 0.0 && sin[0] <= (fall(high) - 1.0).next_up(),
    }
}
