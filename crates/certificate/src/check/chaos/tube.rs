//! Tubes, and what is proved of how a part of one is mapped along another (Lemmas D6, D7, V12).

use std::ops::RangeInclusive;

use super::Law;
use super::allowance::{Allowance, End};
use super::beam::{FlightBundle, Landing, Quad, Spot, State};
use super::guess::{Guess, MAX_PERIODS};
use super::span::Span;

/// The segment across a chain of boxes, from its right end to its left one, seen along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Chord {
    pub bottom: State,
    pub top: State,
}

/// The cells between chords that follow one another.
#[derive(Clone, Debug)]
pub(super) struct BoxChain {
    chords: Vec<Chord>,
    /// True for each cell if all windows that hold it are embedded.
    embedded: Vec<bool>,
}

/// A part of a cell, between two fractions of the way along it, and the cell of the next chain of boxes where its image is about.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub cell: usize,
    pub from: f64,
    pub to: f64,
    pub place: usize,
}

/// Images lie in the cells up to N before and after their place.
pub(super) const NEIGHBOUR_CELLS: usize = 2;
/// A set of flights that is enclosed counts as N that are looked at.
const WORK_PER_SET: usize = 4;
/// Most halvings of a part.
const MAX_HALVINGS: u32 = 12;

/// The stretches of proved parts that follow one another, each of them behind the last part of those before it, which is `used`, and
/// updated: no two of all that are taken have inner points in common, whatever is proposed (D7, D9).
pub(super) fn proved_stretches(parts: &[Part], proved: &[bool], used: &mut Option<Part>) -> Vec<RangeInclusive<usize>> {
    let mut stretches = Vec::new();
    let mut first = 0;
    while first < parts.len() {
        let follows = |k: usize| proved[k] && (k == first || parts[k].follows(&parts[k - 1]));
        let end = (first..parts.len()).find(|&k| !follows(k)).unwrap_or(parts.len()); // exact: all of them
        if end > first && used.is_none_or(|used| parts[first].lies_behind(&used)) {
            stretches.push(first..=end - 1);
            *used = Some(parts[end - 1]);
        }
        first = end.max(first + 1); // exact: the next part
    }
    stretches
}

fn spot(state: State) -> Spot {
    state.map(Span::point)
}

/// Positive where the state is to the left of the directed line, after N forcing periods.
pub(super) fn side_of(from: State, to: State, state: State, turns: f64) -> Span {
    let [a, b, x] = [spot(from), spot(to), spot(state)];
    (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0] - Span::point(turns))
}

/// The normal to the left of the way from one state to another.
fn normal(from: State, to: State) -> Spot {
    let ([u, w], [v, x]) = (spot(from), spot(to));
    [w - x, v - u]
}

impl Part {
    /// Returns whether it begins where the other ends, and its image is about in the same cell or in the next one (D7).
    pub fn follows(&self, other: &Self) -> bool {
        let is_next = self.cell == other.cell + 1 && other.to == 1.0 && self.from == 0.0; // D7: the common chord
        let is_same = self.cell == other.cell && self.from == other.to; // D7: the common cut
        (is_next || is_same) && (self.place == other.place || self.place == other.place + 1)
    }

    /// Returns whether it has no inner point in common with another part or with what lies before that (D9).
    fn lies_behind(&self, other: &Self) -> bool {
        self.cell > other.cell || self.cell == other.cell && self.from >= other.to
    }

    /// Returns whether it leads forward within its cell (D7).
    fn is_forward(&self) -> bool {
        0.0 <= self.from && self.from < self.to && self.to <= 1.0 // D7: from one edge of the cell to the other
    }
}

impl BoxChain {
    pub fn new(chords: Vec<Chord>) -> Self {
        let cells = chords.len().saturating_sub(1); // exact: a tube has two chords at least
        // All windows that hold a cell, and the next one with a window more (D6, D7).
        let reach = 2 * NEIGHBOUR_CELLS + 1;
        let embedded = (0..cells)
            .map(|cell| {
                let (bottom, top) = (
                    normal(chords[cell].bottom, chords[cell + 1].bottom),
                    normal(chords[cell].top, chords[cell + 1].top),
                );
                let (first, last) = (cell.saturating_sub(reach), (cell + reach + 1).min(cells)); // D6: the tube's ends
                chords[first..=last].iter().all(|chord| {
                    let across = [0, 1].map(|i| Span::point(chord.top[i]) - Span::point(chord.bottom[i]));
                    [bottom, top].iter().all(|n| (n[0] * across[0] + n[1] * across[1]).is_positive())
                })
            })
            .collect();
        Self { chords, embedded }
    }

    pub fn chords(&self) -> &[Chord] {
        &self.chords
    }

    pub fn cells(&self) -> usize {
        self.embedded.len()
    }

    /// Returns the chords from one to another as a chain of boxes of its own.
    pub fn stretch(&self, from: usize, to: usize) -> Self {
        Self::new(self.chords[from..=to].to_vec())
    }

    /// Returns the states of a cell.
    pub fn cell(&self, cell: usize) -> Quad {
        let (left, right) = (&self.chords[cell], &self.chords[cell + 1]);
        Quad { corners: [left.bottom, left.top, right.bottom, right.top].map(spot) }
    }

    /// Returns whether the images of a set are proved to lie in the cells around `place`, away from tops and bottoms (D6).
    fn holds(&self, landing: &Landing, place: usize) -> bool {
        let beside = |from: State, to: State| landing.along(normal(from, to), spot(from));
        let is_behind = |chord: &Chord| beside(chord.bottom, chord.top).is_negative();
        let is_before = |chord: &Chord| beside(chord.bottom, chord.top).is_positive();
        let Some(low) = (place - NEIGHBOUR_CELLS..=place).rev().find(|&low| is_behind(&self.chords[low])) else {
            return false;
        };
        let Some(high) = (place..=place + NEIGHBOUR_CELLS).find(|&high| is_before(&self.chords[high + 1])) else {
            return false;
        };
        (low..=high).all(|cell| {
            let (left, right) = (&self.chords[cell], &self.chords[cell + 1]);
            beside(left.bottom, right.bottom).is_positive() && beside(left.top, right.top).is_negative()
        })
    }

    /// Returns whether all states of a part of this chain of boxes are proved to fly to one wall, and to land around its place in the next one.
    pub fn is_mapped(
        &self,
        (law, guess, work): (&Law, &Guess, &Allowance),
        part: &Part,
        is_far: bool,
        next: &Self,
    ) -> Result<bool, End> {
        let place = part.place;
        if !part.is_forward() || place < NEIGHBOUR_CELLS || place + NEIGHBOUR_CELLS >= next.cells() {
            return Ok(false);
        }
        let last = (place + NEIGHBOUR_CELLS + 1).min(next.cells() - 1); // D7: the tube's end
        if !next.embedded[place - NEIGHBOUR_CELLS..=last].iter().all(|&is| is) {
            return Ok(false);
        }
        let mut open = vec![(self.cell(part.cell).part(part.from, part.to), 0)];
        while let Some((quad, depth)) = open.pop() {
            let image = guess.map(quad.middle());
            work.spend(WORK_PER_SET, image.map_or(MAX_PERIODS, |image| image.time))?;
            let landed = image
                .filter(|image| image.is_far == is_far)
                .and_then(|image| FlightBundle::new(law, &quad).land(is_far, image.time));
            if landed.is_some_and(|landing| next.holds(&landing, place)) {
                continue;
            }
            if depth == MAX_HALVINGS {
                return Ok(false);
            }
            open.extend(quad.halves(depth % 3 != 2).map(|half| (half, depth + 1)));
        }
        Ok(true)
    }
}
