//! Whether a set of boxes is closed under the map, both ways to go on at a graze included (Lemma V11, closed).

use std::collections::HashSet;

use super::Law;
use super::beam::{Beam, Quad, State, View};
use super::guess::Guess;
use super::span::Span;

/// Boxes `[i, i + 1]/M x [j, j + 1]/R` of phase in forcing periods modulo 1 and speed over `A W`, by columns and rows.
pub(super) struct Region {
    /// `M`, even, and `R`: powers of two.
    columns: f64,
    rows: f64,
    boxes: HashSet<[i64; 2]>,
}

/// A box is halved so often, and gone through part by part from the other number on.
const HALVINGS: u32 = 12;
const COARSE: u32 = 2;
/// Flights of more forcing periods are not followed.
const LONGEST: f64 = 64.0;
/// More boxes than these are not looked for.
const MOST: f64 = 1e4;

/// Why a box is not proved to be mapped into the set.
pub(super) enum Open {
    /// A ball may come to rest.
    Rest,
    /// A flight may leave.
    Leaves,
}

impl Region {
    pub fn new(columns: u32, rows: u32, boxes: HashSet<[i64; 2]>) -> Self {
        Self { columns: f64::from(columns), rows: f64::from(rows), boxes }
    }

    /// Returns whether all states between these are in boxes of the set; no speed is negative.
    pub fn holds(&self, phase: Span, speed: Span) -> bool {
        let ends = |x: Span, size: f64| {
            let [low, high] = [x.lo() * size, x.hi() * size].map(f64::floor); // V11: the boxes of both ends, `size` a power of two
            (high - low < MOST && high.abs() < f64::from(i32::MAX)).then_some(low as i64..=high as i64) // exact: whole numbers, small
        };
        let (Some(columns), Some(rows)) = (ends(phase, self.columns), ends(speed, self.rows)) else { return false };
        let all = self.columns as i64; // exact: a power of two
        columns.into_iter().all(|column| {
            rows.clone().filter(|&row| row >= 0).all(|row| self.boxes.contains(&[column.rem_euclid(all), row]))
        })
    }

    /// Returns bounds of the times of all flights from a box, which is proved to be mapped into the set.
    pub fn times(&self, law: &Law, guess: &Guess, [column, row]: [i64; 2]) -> Result<Span, Open> {
        let corner = |i: i64, j: i64| [i as f64 / self.columns, j as f64 / self.rows]; // exact: a power of two
        let mut open = vec![([corner(column, row), corner(column + 1, row + 1)], 0)];
        let mut times: Option<Span> = None;
        while let Some((ends, depth)) = open.pop() {
            match self.piece(law, guess, ends, depth) {
                Ok(lasting) => times = Some(times.map_or(lasting, |times| times.hull(lasting))),
                Err(why) if depth == HALVINGS => return Err(why),
                Err(_) => open.extend(halves(ends, depth % 2 == 0).map(|half| (half, depth + 1))),
            }
        }
        times.ok_or(Open::Leaves)
    }

    /// The same of a rectangle.
    fn piece(&self, law: &Law, guess: &Guess, [low, high]: [State; 2], depth: u32) -> Result<Span, Open> {
        let quad = Quad::rectangle(low, high);
        let beam = Beam::new(law, &quad);
        let from = beam.depart().ok_or(Open::Rest)?;
        let [zero, one] = [0.0, 1.0].map(Span::point);
        let landing = guess.map(quad.middle()).and_then(|image| beam.land(image.is_far, image.time));
        if let Some(landing) = landing {
            let along = |n| landing.along(n, [zero, zero]);
            if self.holds(along([one, zero]), along([zero, one])) {
                return Ok(landing.times);
            }
        }
        if depth < COARSE {
            return Err(Open::Leaves);
        }
        self.march(&beam, from, high[0] - low[0]).ok_or(Open::Leaves)
    }

    /// Goes through the flights part by part, each no shorter than `least`, until all are beyond a wall.
    fn march(&self, beam: &Beam, mut from: f64, least: f64) -> Option<Span> {
        let mut step = least;
        let mut times: Option<Span> = None;
        while from < LONGEST {
            let to = from + step;
            let view = beam.over(from, to);
            if beam.is_inside(view.height) {
                from = to;
                step *= 2.0;
                continue;
            }
            if [false, true].into_iter().any(|is_far| (view.height - beam.level(is_far)).signed(is_far).is_positive()) {
                return times;
            }
            if step > least {
                step = (0.5 * step).max(least); // proposes: any part
                continue;
            }
            let part = Span::new(from, to);
            for is_far in [false, true] {
                let Some(speed) = beam.arrivals(is_far, part, &view) else { continue };
                let phase = beam.phase + part + Span::point(if is_far { 0.5 } else { 0.0 });
                if !self.holds(phase, speed) {
                    return None;
                }
                times = Some(times.map_or(part, |times| times.hull(part)));
            }
            from = to;
        }
        None
    }
}

/// Both halves of a rectangle, by phase or by speed: exact, as its sides are powers of two.
fn halves([low, high]: [State; 2], is_by_phase: bool) -> [[State; 2]; 2] {
    let middle = |i: usize| 0.5 * (low[i] + high[i]);
    if is_by_phase {
        [[low, [middle(0), high[1]]], [[middle(0), low[1]], high]]
    } else {
        [[low, [high[0], middle(1)]], [[low[0], middle(1)], high]]
    }
}

impl Beam {
    /// The speeds of all arrivals at a wall in a part of the flights; `None` if there are none.
    fn arrivals(&self, is_far: bool, times: Span, view: &View) -> Option<Span> {
        let miss = view.height - self.level(is_far);
        if miss.is_positive() || miss.is_negative() {
            return None;
        }
        let rate = view.rate.signed(is_far);
        let speed = match self.rate_at(self.level(is_far), times) {
            Some(told) => rate.common(told.signed(is_far))?,
            None => rate,
        };
        speed.common(Span::new(0.0, f64::MAX)) // V11: who comes from inside
    }
}
