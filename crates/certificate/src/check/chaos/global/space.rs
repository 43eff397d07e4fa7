//! Successors of the states of a box: impacts in other boxes, or a rest and its release (Lemma V20, images).

use std::cell::Cell;

use super::super::Law;
use super::super::beam::{FlightBundle, Landing, Quad, State};
use super::super::guess::Guess;
use super::super::span::Span;

/// Boxes by columns of phases in a forcing period and rows of speeds over `A W`, both powers of two in a unit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    pub columns: f64,
    pub rows: f64,
}

impl Grid {
    /// The area of a box, of phases in forcing periods times speeds.
    pub fn size(self) -> f64 {
        1.0 / (self.columns * self.rows) // exact: powers of two
    }
}

/// A possible successor of a state.
#[derive(Clone, Copy, Debug)]
pub(super) enum Next {
    /// A rest, and the release.
    Release,
    /// An impact in a box; `stays` where it is on the same wall and in the same column of the same forcing period.
    Impact { cell: [i64; 2], is_far: bool, stays: bool },
}

pub(super) type Note<'n> = &'n mut dyn FnMut(Next);

/// The map, and the greatest speed that motions have in the end.
pub(super) struct Space<'l> {
    pub law: &'l Law,
    pub guess: Guess,
    pub fastest: f64,
    /// Parts of boxes are no wider, and no higher, if these are not cut too often.
    part: State,
}

/// Sides of parts where the data are narrow; no smaller parts than intervals of `D` and `e` are wide tell more. Cuts of a box.
const PART_SIZE: State = [1.0 / 256.0, 0.04];
const MAX_CUTS: u32 = 6;
/// Flights are followed for N forcing periods; where they may land in several, for fewer.
const MAX_FLIGHT: f64 = 64.0;
const MAX_BRANCHING_FLIGHT: f64 = 2.0;
/// Times in forcing periods for which balls may be proved not to come back to the wall, the longest first.
const DEPARTURE_TIMES: [f64; 9] = [0.5, 0.25, 0.125, 0.0625, 0.03125, 0.015625, 0.0078125, 0.00390625, 0.001953125];
/// The steepest slope of an image that is used, in speeds over phases.
const MAX_SLOPE: f64 = 1e6;
/// Parts of the time until the release that a chatter may take.
const CHATTER_WINDOWS: u32 = 16;

impl<'l> Space<'l> {
    /// Up to a greatest speed that is given, or one that is found; `None` where `e` is not proved to be below 1, or the speed given is
    /// not proved to be more than motions have in the end, or no multiple of 2^-6.
    pub fn new(law: &'l Law, greatest: Option<f64>) -> Option<Self> {
        let left = Span::point(1.0) - law.restitution;
        let limit = Span::point(2.0).over(left).filter(|_| left.is_positive())?;
        // A multiple of 2^-5 that is greater.
        let own = ((limit.hi() * 32.0).floor() + 1.0) / 32.0; // V20: greater than 2/(1 - e)
        let fastest = greatest.unwrap_or(own); // V27: what is claimed is judged below
        let is_greater = fastest > limit.hi() && (fastest * 64.0).fract() == 0.0; // V20: a multiple of a row
        let width = |x: Span| x.hi() - x.lo();
        let wide = (width(law.gap) / law.gap.mid()).max(width(law.restitution)).min(1.0); // V20: any parts
        let part = [PART_SIZE[0].max(0.25 * wide), PART_SIZE[1].max(wide)]; // V20: any parts
        (is_greater && fastest < 1e3).then(|| Self { law, guess: Guess::new(law), fastest, part })
    }

    /// Returns the corners of a box.
    pub fn corners(grid: Grid, [column, row]: [i64; 2]) -> [State; 2] {
        let corner = |i: i64, j: i64| [i as f64 / grid.columns, j as f64 / grid.rows]; // exact: powers of two
        [corner(column, row), corner(column + 1, row + 1)]
    }

    /// Notes what may follow the states of a box; the number of steps that it took, of flights and of boxes that were noted.
    pub fn follows(&self, grid: Grid, cell: [i64; 2], note: Note<'_>) -> u64 {
        let steps = Cell::new(1);
        let step = || steps.set(steps.get() + 1);
        let note: Note<'_> = &mut |next| {
            step();
            note(next);
        };
        let [low, high] = Self::corners(grid, cell);
        if self.chatters(low, high) {
            note(Next::Release);
            return steps.get();
        }
        if (self.law.restitution.lo() <= 0.0 || low[1] <= 0.0) && high[0] >= 0.5 {
            note(Next::Release); // V20: it may lie pressed on the wall
        }
        let mut open = vec![([low, high], 0)];
        while let Some(([low, high], cuts)) = open.pop() {
            let too_large = [0, 1].map(|i| (high[i] - low[i]) / self.part[i]);
            let widest = usize::from(too_large[1] > too_large[0]);
            if cuts >= MAX_CUTS || too_large[widest] <= 1.0 {
                self.piece(grid, [low, high], (cell[0], &step), note);
                continue;
            }
            let middle = 0.5 * (low[widest] + high[widest]); // exact: a side is a power of two
            let (mut upper, mut lower) = (high, low);
            (upper[widest], lower[widest]) = (middle, middle);
            open.extend([([low, upper], cuts + 1), ([lower, high], cuts + 1)]);
        }
        steps.get()
    }

    fn piece(&self, grid: Grid, [low, high]: [State; 2], (home, step_made): (i64, &dyn Fn()), note: Note<'_>) {
        step_made();
        let quad = Quad::rectangle(low, high);
        let beam = FlightBundle::new(self.law, &quad);
        let image = self.guess.map(quad.middle());
        if let Some((is_far, landing)) =
            image.and_then(|image| Some((image.is_far, beam.land(image.is_far, image.time)?)))
        {
            self.landed(grid, home, (is_far, &landing), [high[0] - low[0], high[1] - low[1]], note);
            return;
        }
        let mut land = |is_far: bool, phase: Span, speed: Span| self.land(grid, home, (is_far, [phase, speed]), note);
        let away = DEPARTURE_TIMES.into_iter().find(|&time| high[0] + time <= 0.5 || beam.leaves(time)).unwrap_or(0.0); // V20: no such time
        let [least, longest] = [high[0] - low[0], self.longest_flight(&beam)];
        let (mut from, mut step) = (0.0, least);
        while from < longest {
            step_made();
            let to = from + step;
            let view = beam.over(from, to);
            if from > 0.0 && beam.is_inside(view.height) {
                from = to;
                step *= 2.0;
                continue;
            }
            if [false, true].into_iter().any(|is_far| (view.height - beam.level(is_far)).signed(is_far).is_positive()) {
                return;
            }
            if step > least {
                step = (0.5 * step).max(least); // proposes: any part
                continue;
            }
            let times = Span::new(from, to);
            let phase = beam.phase + times;
            let drifts = (from >= 1.0).then(|| self.drifts(&beam, from));
            for is_far in [false, true] {
                if !is_far && to <= away || drifts.is_some_and(|drifts| !ends_late(is_far, drifts, phase)) {
                    continue;
                }
                let Some(speed) = beam.arrivals(is_far, times, &view) else { continue };
                let bounded = if is_far { Some(speed) } else { speed.common(self.bounced(&beam, to)) };
                let Some(speed) = bounded else { continue };
                land(is_far, phase + Span::point(if is_far { 0.5 } else { 0.0 }), speed);
            }
            from = to;
        }
        self.slow(grid, self.drifts(&beam, longest), note);
    }

    /// Notes the boxes that first contacts on one wall are in, column by column: along the longer of the images of a box's sides.
    fn landed(&self, grid: Grid, home: i64, (is_far, landing): (bool, &Landing), sides: State, note: Note<'_>) {
        let [zero, one] = [0.0, 1.0].map(Span::point);
        let along = |n| landing.along(n, [zero, zero]);
        let (phase, speed) = (along([one, zero]), along([zero, one]));
        let images =
            [[sides[0], 0.0], [0.0, sides[1]]].map(|side| landing.derivative(side.map(Span::point)).map(Span::mid));
        let long = if images[0][0].abs() > images[1][0].abs() { images[0] } else { images[1] };
        let slope = if long[0] == 0.0 { 0.0 } else { (long[1] / long[0]).clamp(-MAX_SLOPE, MAX_SLOPE) }; // V20: any slope
        let beside = along([Span::point(-slope), one]);
        let places = [phase.lo(), phase.hi()].map(|x| (x * grid.columns).floor() as i64); // V11: the columns of both ends
        for column in places[0]..=places[1] {
            let own = Span::new(column as f64 / grid.columns, (column + 1) as f64 / grid.columns); // exact: a power of two
            let sheared = own.common(phase).and_then(|own| speed.common(beside + Span::point(slope) * own));
            if let Some(sheared) = sheared {
                let speed = if sheared.lo().is_nan() { speed } else { sheared }; // V20: of what is not known nothing is used
                self.land_in(grid, home, (is_far, column, speed), note);
            }
        }
    }

    /// The speeds of contacts with the same wall up to a time: within `x^2/6` of `e w`. Lemma V20
    fn bounced(&self, beam: &FlightBundle, time: f64) -> Span {
        let angle = Span::point(time).turned();
        let by = (angle * angle).scaled(0.17).around();
        (beam.after() + by).common(Span::new(0.0, f64::MAX)).unwrap_or(Span::new(0.0, f64::MAX)) // V11: who comes from inside
    }

    /// Number of forcing periods for which flights are followed.
    fn longest_flight(&self, beam: &FlightBundle) -> f64 {
        let drifts = beam.drifts();
        let times = self.law.gap.over(drifts);
        if times.is_none_or(|times| times.hi() - times.lo() > 6.0) { MAX_BRANCHING_FLIGHT } else { MAX_FLIGHT }
    }

    /// The drifts of flights that have touched no wall for N forcing periods. Lemma V20
    fn drifts(&self, beam: &FlightBundle, periods: f64) -> Span {
        let angle = Span::point(periods).turned();
        let bounds = Span::new(-2.0, (self.law.gap + Span::point(2.0)).hi()).over(angle);
        bounds.and_then(|bounds| beam.drifts().common(bounds)).unwrap_or(Span::point(0.0)) // V20: none has another one
    }

    /// Notes the contacts of flights that have lasted long, at all phases that these have.
    fn slow(&self, grid: Grid, drifts: Span, note: Note<'_>) {
        let columns = grid.columns as i64; // exact: a power of two
        for column in 0..columns {
            let phase = Span::new(column as f64 / grid.columns, (column + 1) as f64 / grid.columns); // exact: a power of two
            let cos = phase.sin_cos().1;
            for is_far in [false, true] {
                let speed = (drifts - cos).signed(is_far).common(Span::new(0.0, f64::MAX)); // V11: who comes from inside
                if let Some(speed) = speed.filter(|_| ends_late(is_far, drifts, phase)) {
                    let shift = Span::point(if is_far { 1.5 } else { 1.0 });
                    self.land(grid, -1, (is_far, [phase + shift, speed]), note);
                }
            }
        }
    }

    /// Notes the boxes that hold such phases and speeds.
    pub fn met(&self, grid: Grid, state: [Span; 2], note: &mut dyn FnMut([i64; 2])) {
        self.land(grid, -1, (true, state), &mut |next| {
            if let Next::Impact { cell, .. } = next {
                note(cell);
            }
        });
    }

    /// Notes the boxes that hold contacts with such phases and speeds, from a box in the column `home`.
    fn land(&self, grid: Grid, home: i64, (is_far, [phase, speed]): (bool, [Span; 2]), note: Note<'_>) {
        let [first, last] = [phase.lo(), phase.hi()].map(|x| (x * grid.columns).floor() as i64); // V11: the columns of both ends
        let columns = grid.columns as i64; // exact: a power of two
        let last = last.min(first.max(home) + columns); // V20: all columns
        for column in first..=last {
            self.land_in(grid, home, (is_far, column, speed), note);
        }
    }

    /// Notes the boxes of a column that hold contacts with such speeds.
    fn land_in(&self, grid: Grid, home: i64, (is_far, column, speed): (bool, i64, Span), note: Note<'_>) {
        if !is_far && column < home {
            return; // V20: no impact comes before the flight
        }
        let [low, high] = [speed.lo(), speed.hi()].map(|x| (x * grid.rows).floor() as i64); // V11: the boxes of both ends
        let top = (self.fastest * grid.rows) as i64 - 1; // exact: a whole number
        let columns = grid.columns as i64; // exact: a power of two
        let stays = !is_far && column == home;
        let rows = low.max(0)..=high.min(top); // V20: none is faster
        for row in rows {
            note(Next::Impact { cell: [column.rem_euclid(columns), row], is_far, stays });
        }
    }

    /// Returns whether all states of a rectangle come to rest on their wall by chatter before it is released. Lemma V20 (chatter)
    pub fn chatters(&self, low: State, high: State) -> bool {
        if !(low[0] > 0.5 && high[0] < 1.0) {
            return false; // V20: only where the ball is pressed
        }
        let fast = self.law.restitution * Span::point(high[1]);
        let force = |phase: f64| -Span::point(phase).sin_cos().0;
        (1..CHATTER_WINDOWS).any(|k| {
            let end = high[0] + (1.0 - high[0]) * f64::from(k) / f64::from(CHATTER_WINDOWS);
            let (first, last) = (force(low[0]), force(end));
            let least = first.lo().min(last.lo()); // V20: the force has one maximum there
            let most = if low[0] <= 0.75 && end >= 0.75 { 1.0 } else { first.hi().max(last.hi()) }; // V20: it is monotone else
            if least <= 0.0 {
                return false; // V20: not proved
            }
            let [least, most] = [least, most].map(Span::point);
            let square = |x: Span| x * x;
            let Some(ratio) = (square(self.law.restitution) * most).over(least) else { return false };
            // With r^2 = e^2 a_hi/a_lo: r <= (1 + r^2)/2.
            let slack = (Span::point(1.0) - ratio).scaled(0.5);
            let available = (Span::point(end) - Span::point(high[0])).turned();
            let is_low = (least * self.law.gap.scaled(2.0) - square(fast)).is_positive();
            slack.is_positive() && is_low && (available * least * slack - fast.scaled(2.0)).lo() >= 0.0
        })
    }
}

/// Returns whether a flight of more than a forcing period may end at such phases. Lemma V20 (slow)
fn ends_late(is_far: bool, drifts: Span, phase: Span) -> bool {
    let sin = phase.sin_cos().0;
    let fall = drifts.turned();
    if is_far {
        drifts.hi() >= 0.0 && (sin + Span::point(1.0) - fall).lo() <= 0.0
    } else {
        drifts.lo() <= 0.0 && (sin - Span::point(1.0) - fall).hi() >= 0.0
    }
}
