//! The chains whose first impact lies in a cell of phases, letter by letter: Lemma T10.

use std::collections::BTreeMap;
use std::ops::{Range, RangeInclusive};

use super::cell::Cell;
use super::cut::{Part, Stretch};
use crate::number::interval::Interval;
use crate::periodic::chained::Chained;

/// Flights on from a new end that are cut anew.
const AFFECTED_FLIGHTS: usize = 3;
/// Greatest width of the end of a segment, in forcing periods.
const MAX_END_WIDTH: f64 = 1.0 / 16.0;

/// Segments, each of a cell of the first impact and one of the other end, by the number of the latter.
type Segments = BTreeMap<i64, Vec<Part>>;

/// A letter that a segment grows by.
struct Letter {
    /// Impact of the letter, the new end.
    end: usize,
    /// Flights and impacts that are cut anew.
    stretch: Stretch,
    /// All impacts of the segment but the first one.
    held: Range<usize>,
}

impl<S: Chained> Cell<'_, '_, S> {
    /// Finds all orbits of the cell, in parts that are narrow in all phases but the first impact's and the middle impact's.
    ///
    /// `None` where the budget ends.
    pub fn chains(&mut self) -> Option<Vec<Part>> {
        let count = self.terms.chain.impacts();
        let middle = count / 2;
        let forth = (1..=middle).map(|end| {
            let first = end.saturating_sub(AFFECTED_FLIGHTS); // T10: any stretch
            let stretch = Stretch { flights: first..end, impacts: first.max(1)..end }; // T10: any stretch
            Letter { end, stretch, held: 1..end + 1 }
        });
        let back = (middle..count).rev().map(|end| {
            let last = count.min(end + AFFECTED_FLIGHTS); // T10: any stretch
            Letter { end, stretch: Stretch { flights: end..last, impacts: end + 1..last }, held: end..count }
        });
        let forth = self.grow(forth)?;
        if forth.is_empty() {
            return Some(Vec::new());
        }
        let back = self.grow(back)?;
        let joined = |(cell, beginnings): (&i64, &Vec<Part>)| -> Vec<Part> {
            let endings = back.get(cell).into_iter().flatten();
            endings.flat_map(|ending| beginnings.iter().filter_map(|beginning| beginning.both(ending))).collect()
        };
        Some(forth.iter().flat_map(joined).collect())
    }

    /// The segments that grow from the first impact by these letters.
    fn grow(&mut self, letters: impl Iterator<Item = Letter>) -> Option<Segments> {
        let mut segments = Segments::from([(0, vec![self.all()])]);
        for letter in letters {
            let mut longer = Segments::new();
            for part in segments.into_values().flatten() {
                self.extend(part, &letter, &mut longer)?;
            }
            segments = longer;
            for parts in segments.values_mut() {
                let united = united(std::mem::take(parts), &letter.held);
                *parts = united.into_iter().filter_map(|part| Some(self.narrow(part, &letter.stretch)?.part)).collect();
            }
        }
        Some(segments)
    }

    /// A segment with one letter more, in parts with ends that lie in one cell of the grid each; `None` where the budget ends.
    fn extend(&mut self, part: Part, letter: &Letter, longer: &mut Segments) -> Option<()> {
        let mut open = vec![part];
        while let Some(part) = open.pop() {
            if !self.look() {
                return None;
            }
            let Some(mut part) = self.terms.cut(part, &letter.stretch) else { continue };
            let end = part.phases[letter.end];
            let line = (end.mid() / MAX_END_WIDTH).round() * MAX_END_WIDTH; // T10: any line
            if end.inf() < line && line < end.sup() {
                let mut later = part.clone();
                later.phases[letter.end] = Interval::new(line, end.sup());
                part.phases[letter.end] = Interval::new(end.inf(), line);
                open.extend([later, part]);
                continue;
            }
            if let Some(narrow) = self.narrow(part, &letter.stretch) {
                for cell in cells(end) {
                    longer.entry(cell).or_default().push(narrow.part.clone());
                }
            }
        }
        Some(())
    }
}

/// The numbers of the cells of the grid that an end lies in, but for their lines. Lemma T10
fn cells(end: Interval) -> RangeInclusive<i64> {
    let first = (end.inf() / MAX_END_WIDTH).floor() as i64; // T10: exact
    let last = (end.sup() / MAX_END_WIDTH).ceil() as i64 - 1; // T10: exact
    first..=last.max(first) // T10: a point on a line
}

/// Parts that touch, as one: halves of a box hold the same orbits once what they were halved at is no end any more.
fn united(parts: Vec<Part>, held: &Range<usize>) -> Vec<Part> {
    let mut all: Vec<Part> = Vec::new();
    for mut part in parts {
        while let Some(other) = all.iter().position(|other| part.touches(other, held)) {
            part.add(&all.swap_remove(other));
        }
        all.push(part);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An end within a unit in the last place of a line is in the cells on its own side, although the double half way between its bounds
    /// may be on the line.
    #[test]
    fn r32_an_end_beside_a_line_is_in_the_cell_of_its_members() {
        for line in [MAX_END_WIDTH, 1.0, 7.0 * MAX_END_WIDTH, 1000.0] {
            let n = (line / MAX_END_WIDTH) as i64;
            let (below, above) = (line.next_down(), line.next_up());
            for (lo, hi, expected) in [
                (below, line, n - 1..=n - 1),
                (line - MAX_END_WIDTH, line, n - 1..=n - 1),
                (below, below, n - 1..=n - 1),
                (line, above, n..=n),
                (line, line, n..=n),
                (below, line + MAX_END_WIDTH, n - 1..=n),
                (below, above, n - 1..=n),
            ] {
                assert_eq!(cells(Interval::new(lo, hi)), expected, "[{lo:e}, {hi:e}]");
            }
        }
    }
}
