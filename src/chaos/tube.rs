//! Cell chains: quadrilaterals of states, and proofs of how one chain is mapped along another. Lemmas D6, D7 of `docs/proofs/chaos.md#D6`.

use std::ops::RangeInclusive;

use super::flights::{Flights, Landing, is_positive};
use super::guess::Guess;
use super::law::{Law, Side};
use super::quad::{Chord, Quad, State};
use crate::number::Ball;

/// Chain of the cells between successive chords; the tops lie to the left.
#[derive(Clone, Debug)]
pub(crate) struct BoxChain {
    chords: Vec<Chord>,
    /// About where the chords are images of the chain before: the number of a cell there, and a fraction of it.
    origins: Vec<f64>,
    normals: Vec<Normals>,
    /// Flags of the cells: all windows that hold the cell are embedded.
    embedded: Vec<bool>,
}

/// Normals of a cell's edges: of the bottom, inward; of the top, outward; of its first chord, against the cell chain.
#[derive(Clone, Copy, Debug)]
struct Normals {
    bottom: [Ball; 2],
    top: [Ball; 2],
    chord: [Ball; 2],
}

/// Part of a cell, along the cell chain, with the cell of the next cell chain near its image.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part {
    pub cell: usize,
    /// `a` in the coordinates of the cell: dyadic.
    pub from: f64,
    pub to: f64,
    pub place: usize,
}

impl Part {
    /// Whether this part begins where `other` ends, and its image is about in the same cell or in the next one. Lemma D7
    pub fn follows(&self, other: &Self) -> bool {
        let is_next = self.cell == other.cell + 1 && other.to == 1.0 && self.from == -1.0; // D7: the common chord
        let is_same = self.cell == other.cell && self.from == other.to; // D7: the common cut
        (is_next || is_same) && (self.place == other.place || self.place == other.place + 1)
    }

    /// Whether this part has no inner point in common with `other` or with what lies before `other`. Lemma D9
    fn lies_behind(&self, other: &Self) -> bool {
        self.cell > other.cell || self.cell == other.cell && self.from >= other.to
    }

    /// Whether the part leads forward within its cell. Lemma D7
    fn is_forward(&self) -> bool {
        -1.0 <= self.from && self.from < self.to && self.to <= 1.0 // D7: from one edge of the cell to the other
    }
}

/// Number of cells before and after their place in which images lie.
pub(crate) const NEIGHBOUR_CELLS: usize = 2;
/// Number of times that a part is halved at most.
const HALVINGS: u32 = 9;

/// Stretches of consecutive proved parts, each behind the last part before it, which is `used`, and updated: no two taken parts have inner
/// points in common, whatever is proposed. Lemmas D7, D9
pub(crate) fn proved_stretches(parts: &[Part], proved: &[bool], used: &mut Option<Part>) -> Vec<RangeInclusive<usize>> {
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

/// `to - from`
pub(crate) fn edge(from: State, to: State) -> [Ball; 2] {
    [Ball::exact(to[0]) - Ball::exact(from[0]), Ball::exact(to[1]) - Ball::exact(from[1])]
}

/// The vector rotated to the left by a right angle.
pub(crate) fn left([u, w]: [Ball; 2]) -> [Ball; 2] {
    [-w, u]
}

fn dot([a, b]: [Ball; 2], [c, d]: [Ball; 2]) -> Ball {
    a * c + b * d
}

/// The side of a directed line on which a state lies, shifted by whole forcing periods: positive to the left.
pub(crate) fn side_of(from: State, to: State, state: State, turns: f64) -> Ball {
    let [u, w] = edge(from, state);
    dot(left(edge(from, to)), [u - Ball::exact(turns), w])
}

impl BoxChain {
    /// The quadrilateral between two chords as a chain of one cell.
    pub fn between(left: Chord, right: Chord) -> Self {
        Self::new(vec![left, right], vec![0.0; 2])
    }

    /// The cells between successive chords, each with its origin in the chain before.
    pub fn new(chords: Vec<Chord>, origins: Vec<f64>) -> Self {
        let normals: Vec<Normals> = chords
            .windows(2)
            .map(|pair| Normals {
                bottom: left(edge(pair[0].bottom, pair[1].bottom)),
                top: left(edge(pair[0].top, pair[1].top)),
                chord: left(edge(pair[0].bottom, pair[0].top)),
            })
            .collect();
        let cells = normals.len();
        let embedded = (0..cells)
            .map(|cell| {
                // Lemma D6: all windows that hold the cell
                let (first, last) =
                    (cell.saturating_sub(2 * NEIGHBOUR_CELLS + 1), (cell + 2 * NEIGHBOUR_CELLS + 2).min(cells)); // D6: the tube's ends
                let crosses =
                    |edge: &[Ball; 2], chord: &Chord| is_positive(dot(*edge, self::edge(chord.bottom, chord.top)));
                let Normals { bottom, top, .. } = &normals[cell];
                chords[first..=last].iter().all(|chord| crosses(bottom, chord) && crosses(top, chord))
            })
            .collect();
        Self { chords, origins, normals, embedded }
    }

    pub fn chords(&self) -> &[Chord] {
        &self.chords
    }

    /// The middle of the chain at a place, the number of a cell and a fraction of it, and about where it comes from in the chain before.
    pub fn middle(&self, place: f64) -> (State, f64) {
        let cell = (place as usize).min(self.cells() - 1); // proposes: where to look
        let part = place - cell as f64; // proposes: where to look
        let mix = |a: f64, b: f64| a + part * (b - a);
        let state = |chord: &Chord| [0, 1].map(|i| 0.5 * (chord.bottom[i] + chord.top[i]));
        let [from, to] = [cell, cell + 1].map(|chord| state(&self.chords[chord]));
        ([0, 1].map(|i| mix(from[i], to[i])), mix(self.origins[cell], self.origins[cell + 1]))
    }

    pub fn cells(&self) -> usize {
        self.normals.len()
    }

    /// The chords from one to another as a cell chain of their own.
    pub fn stretch(&self, from: usize, to: usize) -> Self {
        Self::new(self.chords[from..=to].to_vec(), self.origins[from..=to].to_vec())
    }

    /// Whether an image is proved to lie in the cells around `place`, away from tops and bottoms. Lemma D6
    fn holds(&self, landing: &Landing, place: usize) -> bool {
        let cells = self.cells();
        if place < NEIGHBOUR_CELLS || place + NEIGHBOUR_CELLS >= cells {
            return false;
        }
        let point = |state: State| state.map(Ball::exact);
        let before = |chord: usize, normal: [Ball; 2]| landing.along(normal, point(self.chords[chord].bottom));
        let (mut low, mut high) = (place, place);
        while !is_positive(-before(low, self.normals[low].chord)) {
            if low + NEIGHBOUR_CELLS == place {
                return false;
            }
            low -= 1;
        }
        loop {
            let chord = self.chords[high + 1];
            if is_positive(before(high + 1, left(edge(chord.bottom, chord.top)))) {
                break;
            }
            if high == place + NEIGHBOUR_CELLS {
                return false;
            }
            high += 1;
        }
        (low..=high).all(|cell| {
            let Normals { bottom, top, .. } = self.normals[cell];
            is_positive(landing.along(bottom, point(self.chords[cell].bottom)))
                && is_positive(-landing.along(top, point(self.chords[cell].top)))
        })
    }

    /// Whether the windows of the images of a part and of its neighbours are embedded.
    fn is_embedded(&self, place: usize) -> bool {
        let low = place.saturating_sub(NEIGHBOUR_CELLS); // D6: the tube's ends
        let high = (place + NEIGHBOUR_CELLS + 1).min(self.cells() - 1); // D6: the tube's ends
        self.embedded.get(low..=high).is_some_and(|window| window.iter().all(|&is| is))
    }

    /// Whether all states of a part are proved to fly to one wall, and to land around its place in the next cell chain.
    pub fn is_mapped(&self, law: &Law, guess: &Guess, part: &Part, side: Side, next: &Self) -> bool {
        if !part.is_forward() || !next.is_embedded(part.place) {
            return false;
        }
        let cell = Quad::between(&self.chords[part.cell], &self.chords[part.cell + 1]);
        let middle = 0.5 * (part.from + part.to); // exact: dyadic
        let all = cell.part([middle, 0.0], [0.5 * (part.to - part.from), 1.0]);
        let mut open = vec![(0, 0.0, 0.0, 1.0, 1.0)];
        while let Some((depth, a, b, r, s)) = open.pop() {
            let piece = all.part([a, b], [r, s]);
            let landed = guess.map(piece.centre).filter(|image| image.side == side).and_then(|image| {
                let arrival = if side == Side::Far { image.state[0] - 0.5 } else { image.state[0] };
                Flights::new(law, &piece).land(side, arrival)
            });
            if landed.is_some_and(|landing| next.holds(&landing, part.place)) {
                continue;
            }
            if depth == HALVINGS {
                return false;
            }
            if depth % 3 == 2 {
                open.extend([-0.5, 0.5].map(|half| (depth + 1, a, b + half * s, r, 0.5 * s)));
            } else {
                open.extend([-0.5, 0.5].map(|half| (depth + 1, a + half * r, b, 0.5 * r, s)));
            }
        }
        true
    }
}
