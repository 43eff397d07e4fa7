//! Proof that a set of boxes is closed under the map, both ways to go on at a graze included (Lemma V11, closed).

use std::collections::HashMap;

use super::Law;
use super::beam::{FlightBundle, Quad, State, View};
use super::guess::Guess;
use super::span::Span;

/// Boxes `[i, i + 1]/M x [j, j + 1]/R` of phase in forcing periods modulo 1 and speed over `A W`, by columns and rows.
pub(super) struct Region {
    /// `M`, even, and `R`: powers of two.
    columns: f64,
    rows: f64,
    /// The number of each.
    boxes: HashMap<[i64; 2], u32>,
}

/// A condition on flights, from whether they end on the far wall, and with what phases and speeds; returns whether they are allowed.
type Note<'n> = &'n mut dyn FnMut(bool, [Span; 2]) -> bool;

/// Most halvings of a box, and the number from which on its flights are followed part by part. Beside a corner of a box that is not in the
/// set 12 halvings were too few (measured on random scenes).
const MAX_HALVINGS: u32 = 20;
const COARSE_HALVINGS: u32 = 2;
/// Flights of more forcing periods are not followed.
const MAX_FLIGHT: f64 = 64.0;
/// More boxes than these are not looked for.
const MAX_BOXES: f64 = 1e4;

/// The reason why a box is not proved to be mapped into the set.
pub(super) enum Open {
    /// A ball may come to rest.
    Rest,
    /// A flight may leave.
    Leaves,
}

impl Region {
    pub fn new(columns: u32, rows: u32, boxes: impl IntoIterator<Item = [i64; 2]>) -> Self {
        let boxes = boxes.into_iter().zip(0..).collect();
        Self { columns: f64::from(columns), rows: f64::from(rows), boxes }
    }

    /// Returns whether all states between these are in boxes of the set; no speed is negative.
    pub fn holds(&self, phase: Span, speed: Span) -> bool {
        self.met(phase, speed).is_some()
    }

    /// Returns the numbers of the boxes that meet such states, if all of these are in boxes of the set; no speed is negative.
    fn met(&self, phase: Span, speed: Span) -> Option<Vec<u32>> {
        let ends = |x: Span, size: f64| {
            let [low, high] = [x.lo() * size, x.hi() * size]; // exact: a power of two
            // V11: boxes are closed, and an upper end on an edge is in the box below
            let [low, high] = [low.floor(), if high > low { high.ceil() - 1.0 } else { high.floor() }];
            (high - low < MAX_BOXES && high.abs() < f64::from(i32::MAX)).then_some(low as i64..=high as i64) // exact: whole numbers, small
        };
        let (columns, rows) = (ends(phase, self.columns)?, ends(speed, self.rows)?);
        let all = self.columns as i64; // exact: a power of two
        let number = |column: i64, row: i64| self.boxes.get(&[column.rem_euclid(all), row]).copied();
        let of_column = |column| rows.clone().filter(|&row| row >= 0).map(move |row| number(column, row));
        columns.into_iter().flat_map(of_column).collect()
    }

    /// Returns bounds of the times of all flights from a box, which is proved to be mapped into the set.
    pub fn times(&self, law: &Law, guess: &Guess, cell: [i64; 2]) -> Result<Span, Open> {
        let mut times: Option<Span> = None;
        let mut holds = |_, [phase, speed]: [Span; 2]| self.holds(phase, speed);
        self.cut(cell, 0, |ends, depth| {
            let lasting = piece(law, guess, ends, depth, &mut holds)?;
            times = Some(times.map_or(lasting, |times| times.hull(lasting)));
            Ok(())
        })?;
        times.ok_or(Open::Leaves)
    }

    /// Returns the boxes that flights from a box may lead to, on the near wall and on the far one, the box halved `halvings` times at least;
    /// `None` where it is not proved to be mapped into the set. Lemma V16
    pub fn reached(&self, law: &Law, guess: &Guess, cell: [i64; 2], halvings: u32) -> Option<[Vec<u32>; 2]> {
        let mut all = [Vec::new(), Vec::new()];
        let cut = self.cut(cell, halvings, |ends, depth| {
            let mut own = Vec::new();
            let mut note = |is_far: bool, [phase, speed]: [Span; 2]| {
                let met = self.met(phase, speed);
                met.map(|met| own.extend(met.into_iter().map(|to| (is_far, to)))).is_some()
            };
            piece(law, guess, ends, depth, &mut note)?;
            own.into_iter().for_each(|(is_far, to)| all[usize::from(is_far)].push(to));
            Ok(())
        });
        all.iter_mut().for_each(|to| {
            to.sort_unstable();
            to.dedup();
        });
        cut.ok().map(|()| all)
    }

    /// Goes through the parts of a box, halved `halvings` times, and more often where a part is refused.
    fn cut(
        &self,
        [column, row]: [i64; 2],
        halvings: u32,
        mut look: impl FnMut([State; 2], u32) -> Result<(), Open>,
    ) -> Result<(), Open> {
        let corner = |i: i64, j: i64| [i as f64 / self.columns, j as f64 / self.rows]; // exact: a power of two
        let mut open = vec![([corner(column, row), corner(column + 1, row + 1)], 0)];
        while let Some((ends, depth)) = open.pop() {
            let is_cut = depth < halvings
                || match look(ends, depth) {
                    Ok(()) => false,
                    Err(why) if depth >= MAX_HALVINGS => return Err(why),
                    Err(_) => true,
                };
            if is_cut {
                open.extend(halves(ends, depth % 2 == 0).map(|half| (half, depth + 1)));
            }
        }
        Ok(())
    }
}

/// Returns bounds of the times of all flights from a rectangle, each of which is noted, and allowed.
fn piece(law: &Law, guess: &Guess, [low, high]: [State; 2], depth: u32, note: Note<'_>) -> Result<Span, Open> {
    let quad = Quad::rectangle(low, high);
    let beam = FlightBundle::new(law, &quad);
    let from = beam.depart().ok_or(Open::Rest)?;
    let [zero, one] = [0.0, 1.0].map(Span::point);
    let image = guess.map(quad.middle());
    if let Some((is_far, landing)) = image.and_then(|image| Some((image.is_far, beam.land(image.is_far, image.time)?)))
    {
        let along = |n| landing.along(n, [zero, zero]);
        if note(is_far, [along([one, zero]), along([zero, one])]) {
            return Ok(landing.times);
        }
    }
    if depth < COARSE_HALVINGS {
        return Err(Open::Leaves);
    }
    scan_parts(&beam, from, high[0] - low[0], note).ok_or(Open::Leaves)
}

/// Goes through the flights part by part, each no shorter than `least`, until all are beyond a wall.
fn scan_parts(beam: &FlightBundle, mut from: f64, least: f64, note: Note<'_>) -> Option<Span> {
    let mut step = least;
    let mut times: Option<Span> = None;
    while from < MAX_FLIGHT {
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
            // V11: sums of few bits are exact, so that rounding takes no phase beyond the edge of a box
            let phase = beam.phase.plus(part).plus(Span::point(if is_far { 0.5 } else { 0.0 }));
            if !note(is_far, [phase, speed]) {
                return None;
            }
            times = Some(times.map_or(part, |times| times.hull(part)));
        }
        from = to;
    }
    None
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

impl FlightBundle {
    /// The speeds of all arrivals at a wall in a part of the flights; `None` if there are none.
    pub(super) fn arrivals(&self, is_far: bool, times: Span, view: &View) -> Option<Span> {
        let miss = view.height - self.level(is_far);
        if miss.is_positive() || miss.is_negative() {
            return None;
        }
        let rate = view.rate.signed(is_far);
        let speed = match self.rate_at(self.level(is_far), times) {
            Some(known) => rate.common(known.signed(is_far))?,
            None => rate,
        };
        speed.common(Span::new(0.0, f64::MAX)) // V11: who comes from inside
    }
}
