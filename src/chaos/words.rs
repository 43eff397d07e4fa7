//! Words: returns of an h-set to the h-sets, proved along cell chains. Lemmas D8, D9 of `docs/proofs/chaos.md#D8`.

use std::sync::{Arc, Mutex};

use super::flights::is_positive;
use super::guess::Guess;
use super::law::{Law, Side};
use super::propose::{Making, Proposal};
use super::quad::{Chord, State};
use super::strips::{Strip, strips};
use super::tube::{BoxChain, NEIGHBOUR_CELLS, proved_stretches, side_of};
use crate::threads::{answers, available};
use crate::watch::{Stage, Watch};

/// Quadrilateral of states, the set of a covering relation: the curves from its left to its right edge are followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HSet {
    /// Left edge.
    pub left: Chord,
    /// Right edge.
    pub right: Chord,
}

/// A covering relation from one h-set to another.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Path {
    pub from: usize,
    pub to: usize,
    /// The wall that each flight ends on.
    pub sides: Vec<Side>,
    /// Half forcing periods from start to end.
    pub half_turns: i64,
    /// About the states of two motions of the word, from the h-set on, at whose ends its stretch is beyond the two edges.
    pub ends: [Vec<State>; 2],
}

/// Stretch of a cell chain that has been followed so far.
struct Run {
    from: usize,
    sides: Vec<Side>,
    tube: BoxChain,
    /// The stretch whose image it is along.
    before: Option<Arc<Run>>,
}

/// Number of boxes that are tried so far.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Tally {
    pub boxes: u64,
}

/// The search for words, one impact deeper at each step.
pub(crate) struct Search<'s> {
    pub law: &'s Law,
    pub guess: Guess,
    pub making: Making,
    pub bases: &'s [HSet],
    runs: Vec<Arc<Run>>,
    pub words: Vec<Path>,
    pub tally: Tally,
    /// Number of threads that follow runs. With one, where a limit of boxes ends the search depends on nothing else.
    pub threads: usize,
    /// Middles of the first cell chains, for pictures.
    pub shown: Vec<Vec<State>>,
    depth: usize,
}

/// Greatest depth of the cell chains in pictures.
const SHOWN_DEPTH: usize = 3;

impl HSet {
    /// H-set of a centre and the half vectors of its sides.
    pub fn new(centre: State, along: State, across: State) -> Self {
        let corner = |a: f64, b: f64| [0, 1].map(|i| centre[i] + a * along[i] + b * across[i]);
        let chord = |a: f64, sign: f64| Chord { bottom: corner(a, -sign), top: corner(a, sign) };
        let sign = if along[0] * across[1] - along[1] * across[0] > 0.0 { 1.0 } else { -1.0 };
        Self { left: chord(-1.0, sign), right: chord(1.0, sign) }
    }

    /// Whether the h-set is a convex quadrilateral.
    pub fn is_convex(&self) -> bool {
        let Self { left, right } = self;
        let round = [left.bottom, right.bottom, right.top, left.top];
        (0..4).all(|i| is_positive(side_of(round[i], round[(i + 1) % 4], round[(i + 2) % 4], 0.0)))
    }

    /// Stretches of a cell chain that cross the h-set `turns` forcing periods later, each as two chords. Lemma D8
    fn crossings(&self, tube: &BoxChain, turns: f64) -> Vec<(usize, usize)> {
        let Self { left, right } = self;
        let mut found = Vec::new();
        let mut last: Option<(bool, usize)> = None;
        for (k, chord) in tube.chords().iter().enumerate() {
            let ends = [chord.bottom, chord.top];
            let between = |state: &State| {
                is_positive(side_of(left.bottom, right.bottom, *state, turns))
                    && is_positive(-side_of(left.top, right.top, *state, turns))
            };
            if !ends.iter().all(between) {
                last = None;
                continue;
            }
            let before = ends.iter().all(|&state| is_positive(side_of(left.bottom, left.top, state, turns)));
            let behind = ends.iter().all(|&state| is_positive(-side_of(right.bottom, right.top, state, turns)));
            if before || behind {
                if let Some((was_before, from)) = last
                    && was_before != before
                {
                    found.push((from, k));
                }
                last = Some((before, k));
            }
        }
        found
    }

    fn phases(&self) -> [f64; 2] {
        let all = [self.left.bottom[0], self.left.top[0], self.right.bottom[0], self.right.top[0]];
        all.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], &x| [a.min(x), b.max(x)]) // proposes: where to look
    }
}

impl Run {
    /// About the states of a motion along the middles of the cell chains, from the h-set on, that comes to a chord.
    fn motion(&self, chord: usize) -> Vec<State> {
        let (mut states, mut place) = (Vec::new(), chord as f64); // proposes: where to look
        let mut run = Some(self);
        while let Some(Self { tube, before, .. }) = run {
            let (state, origin) = tube.middle(place);
            states.push(state);
            place = origin;
            run = before.as_deref();
        }
        states.reverse();
        states
    }
}

impl<'s> Search<'s> {
    pub fn new(law: &'s Law, bases: &'s [HSet], making: Making) -> Self {
        let run = |(from, base): (usize, &HSet)| {
            let tube = BoxChain::between(base.left, base.right);
            Arc::new(Run { from, sides: Vec::new(), tube, before: None })
        };
        let runs = bases.iter().enumerate().map(run).collect();
        let (words, tally, shown) = (Vec::new(), Tally::default(), Vec::new());
        let threads = available();
        Self { law, guess: Guess::new(law), making, bases, runs, words, tally, threads, shown, depth: 0 }
    }

    /// Follows all remaining runs over one impact more; false when stopped.
    pub fn deepen(&mut self, watch: &dyn Watch) -> bool {
        let depth = self.depth + 1; // exact: a count
        let tally = Mutex::new(self.tally);
        let done = answers(self.threads, self.runs.len(), &|number| {
            let boxes = || tally.lock().expect("no thread has panicked").boxes;
            let watch = |_: Stage<'_>| watch.proceed(Stage::Horseshoe { depth, boxes: boxes() });
            let (next, words, more) = self.follow(&self.runs[number], &watch);
            let mut tally = tally.lock().expect("no thread has panicked");
            tally.boxes += more.boxes;
            Some((next, words))
        });
        self.tally = tally.into_inner().expect("no thread has panicked");
        self.runs.clear();
        for (runs, words) in done {
            self.runs.extend(runs);
            self.words.extend(words);
        }
        self.depth = depth;
        if self.depth <= SHOWN_DEPTH {
            let middle = |chord: &Chord| [0, 1].map(|i| 0.5 * (chord.bottom[i] + chord.top[i]));
            let middles = self.runs.iter().map(|run| run.tube.chords().iter().map(middle).collect());
            self.shown.extend(middles);
        }
        watch.proceed(Stage::Horseshoe { depth, boxes: self.tally.boxes }).is_continue()
    }

    /// Keeps the words that are proved by strips as well, and returns these, in the same order. Lemma D34
    pub fn keep_witnessed(&mut self, law: &Law, watch: &dyn Watch) -> Vec<Strip> {
        let found = strips(law, self.bases, &self.words, watch);
        let kept = std::mem::take(&mut self.words).into_iter().zip(found);
        let (words, strips) = kept.filter_map(|(path, strip)| Some((path, strip?))).unzip();
        self.words = words;
        strips
    }

    /// Follows one run over one impact: the words that cover an h-set, and the remaining runs.
    fn follow(&self, run: &Arc<Run>, watch: &dyn Watch) -> (Vec<Arc<Run>>, Vec<Path>, Tally) {
        let (mut runs, mut words, mut tally) = (Vec::new(), Vec::new(), Tally::default());
        let mut used = None;
        for proposal in self.making.images(&self.guess, &run.tube) {
            if !watch.goes_on() {
                break;
            }
            let Proposal { parts, side, next } = &proposal;
            let proved: Vec<bool> =
                parts.iter().map(|part| run.tube.is_mapped(self.law, &self.guess, part, *side, next)).collect();
            tally.boxes += proved.len() as u64; // exact: a length
            let mut sides = run.sides.clone();
            sides.push(*side);
            for stretch in proved_stretches(parts, &proved, &mut used) {
                let (low, high) = (parts[*stretch.start()].place, parts[*stretch.end()].place);
                // Lemma D7: the ends of the stretch land before `low` and behind `high`.
                let (low, high) = (low + NEIGHBOUR_CELLS + 2, high.saturating_sub(NEIGHBOUR_CELLS + 1)); // D7: none if it is shorter
                if low < high {
                    let (sides, tube) = (sides.clone(), next.stretch(low, high));
                    let next = Run { from: run.from, sides, tube, before: Some(Arc::clone(run)) };
                    self.collect(&next, &mut runs, &mut words);
                }
            }
        }
        (runs, words, tally)
    }

    fn collect(&self, run: &Run, runs: &mut Vec<Arc<Run>>, words: &mut Vec<Path>) {
        let Run { from, sides, tube, before } = run;
        let phases = tube.chords().iter().map(|chord| chord.bottom[0]);
        let [low, high] = phases.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]); // proposes: where to look
        let mut taken: Vec<(usize, usize)> = Vec::new();
        for (to, base) in self.bases.iter().enumerate() {
            let [least, most] = base.phases();
            let mut turns = (low - most).ceil(); // proposes: where to look
            while turns <= high - least {
                for (a, b) in base.crossings(tube, turns) {
                    if taken.iter().all(|&(c, d)| b <= c || d <= a) {
                        taken.push((a, b));
                        let far = sides.iter().filter(|&&side| side == Side::Far).count() as i64; // exact: a length
                        let half_turns = 2 * turns as i64 - far; // exact: a whole number
                        let ends = [a, b].map(|chord| run.motion(chord));
                        words.push(Path { from: *from, to, sides: sides.clone(), half_turns, ends });
                    }
                }
                turns += 1.0;
            }
        }
        taken.sort_unstable();
        let mut start = 0;
        for (a, b) in taken.into_iter().chain([(tube.cells(), tube.cells())]) {
            if a > start + 4 * NEIGHBOUR_CELLS {
                let (sides, before) = (sides.clone(), before.clone());
                runs.push(Arc::new(Run { from: *from, sides, tube: tube.stretch(start, a), before }));
            }
            start = b;
        }
    }
}
