//! Searches for words between h-sets with several makings of their cell chains, and which of them leads furthest.

use super::blocks::{Word, horseshoe};
use super::entropy::entropy;
use super::law::Law;
use super::propose::Making;
use super::words::{HSet, Search};
use crate::watch::Watch;

pub use impact_pair_document::MOST_DEPTH;

/// Number of boxes at which a search without a given depth goes no deeper, with the usual effort.
pub(super) const BOXES: u64 = 1_000_000;

/// Makings of cell chains, any of which is sound: from fine cells to those that leave space for intervals of parameters.
pub(super) const MAKINGS: [Making; 4] = [
    Making { longest: 0.003, margin: 1.08, pad: 5e-6, shortest: 1e-9, ahead: 4 },
    Making { longest: 0.005, margin: 1.08, pad: 2e-5, shortest: 1e-8, ahead: 4 },
    Making { longest: 0.01, margin: 1.08, pad: 2e-5, shortest: 1e-6, ahead: 4 },
    Making { longest: 0.01, margin: 1.15, pad: 2e-5, shortest: 1e-6, ahead: 4 },
];
/// Making with which h-sets are tried.
pub(super) const TRIAL: Making = Making { longest: 0.006, margin: 1.08, pad: 5e-6, shortest: 1e-7, ahead: 4 };
/// The making for slow expansion, where none of these leads to any entropy so far.
const SLOW: Making = Making { longest: 0.001, margin: 1.08, pad: 5e-6, shortest: 1e-9, ahead: 4 };
/// Finer makings, where this one leads to none either: for slow expansion along thin leaves. H-sets from everywhere are tried with the last.
pub(super) const FINE: [Making; 2] = [
    Making { longest: 0.0006, margin: 1.08, pad: 6e-7, shortest: 1e-9, ahead: 12 },
    Making { longest: 0.0003, margin: 1.08, pad: 3e-7, shortest: 1e-9, ahead: 12 },
];
/// The depth up to which all makings are tried, and the part of the best entropy that is enough for the first one that is followed deeper.
const SHALLOW_DEPTH: usize = 8;
const ENOUGH_ENTROPY: f64 = 0.95;
/// A search, how deep it went, and whether it was stopped before.
pub(super) struct Tried<'s> {
    pub search: Search<'s>,
    pub depth: usize,
    pub is_stopped: bool,
}

impl<'s> Tried<'s> {
    pub fn new(law: &'s Law, bases: &'s [HSet], making: Making) -> Self {
        Self { search: Search::new(law, bases, making), depth: 0, is_stopped: false }
    }

    /// Deepens the search to a depth, or until `most` boxes are done.
    pub fn deepened(mut self, (to, most): (usize, u64), watch: &dyn Watch) -> Self {
        while !self.is_stopped && self.depth < to && self.search.tally.boxes < most {
            self.is_stopped = !self.search.deepen(watch);
            self.depth += usize::from(!self.is_stopped); // exact: a count
        }
        self
    }

    /// Lower bound of the entropy of the words, per impact.
    fn entropy(&self) -> f64 {
        by_impact(&self.search)
    }

    /// Lengths of the two blocks of the shortest horseshoe, in impacts, the longer one first; the greatest number if there is none.
    fn shortest(&self) -> [usize; 2] {
        let words: Vec<Word> = self.search.words.iter().map(Word::of).collect();
        horseshoe(&words, self.search.bases.len()).map_or([usize::MAX; 2], |[a, b]| [b, a].map(|word| word.walls.len()))
    }
}

/// The search between h-sets that leads furthest, to this depth, and no deeper from this number of boxes on.
pub(super) fn deepest<'s>(
    law: &'s Law,
    bases: &'s [HSet],
    (deepest, most): (usize, u64),
    watch: &dyn Watch,
) -> Tried<'s> {
    let deepest = if bases.is_empty() { 0 } else { deepest }; // exact: counts
    let tried = |makings: &[Making], depth: usize| -> Vec<Tried<'s>> {
        makings.iter().map(|&making| Tried::new(law, bases, making).deepened((depth, most), watch)).collect()
    };
    let shallow = deepest.min(SHALLOW_DEPTH); // exact: counts
    let first = good(tried(&MAKINGS, shallow), shallow < deepest);
    let is_slow = first.entropy() == 0.0 && !first.is_stopped && shallow < deepest; // proposes: which one to follow deeper
    let first = if is_slow { tried(&[SLOW], deepest).swap_remove(0) } else { first.deepened((deepest, most), watch) };
    let is_open = first.entropy() == 0.0 && !first.is_stopped && deepest > 0; // proposes: whether to try more
    let finer = if is_open { tried(&FINE, deepest) } else { Vec::new() };
    let finest = finer.into_iter().max_by(|a, b| a.entropy().total_cmp(&b.entropy())); // proposes: each is a proof of its own
    finest.unwrap_or(first) // exact: none was tried
}

/// Of the searches with the most entropy, the one with the shortest horseshoe. If the search is to go deeper: the first one, with the finest
/// cells, that has nearly the most entropy.
fn good(tried: Vec<Tried<'_>>, deeper: bool) -> Tried<'_> {
    let best = tried.iter().fold(0.0, |best: f64, one| best.max(one.entropy())); // proposes: each is a proof of its own
    let enough = if deeper { ENOUGH_ENTROPY * best } else { best };
    let mut good = tried.into_iter().filter(|one| one.entropy() >= enough);
    let chosen = if deeper { good.next() } else { good.min_by_key(Tried::shortest) };
    chosen.expect("the best")
}

/// Lower bounds of the entropy of the words, per impact and per forcing period.
pub(super) fn entropies(search: &Search<'_>) -> [f64; 2] {
    [by_impact(search), 2.0 * entropy(&search.words, search.bases.len(), |path| path.half_turns)]
}

fn by_impact(search: &Search<'_>) -> f64 {
    entropy(&search.words, search.bases.len(), |path| path.sides.len() as i64) // exact: a length
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chaos::quad::{Chord, State};
    use crate::number::{Ball, Number};
    use crate::watch::Unwatched;

    /// `D = 1/10`, `e = 4/5`.
    fn figure_16() -> Law {
        let quotient = |a: f64, b: f64| Ball::exact(a).checked_div(Ball::exact(b)).expect("not 0");
        Law { gap: quotient(1.0, 10.0), restitution: quotient(4.0, 5.0) }
    }

    /// Two h-sets that the search finds for figure 16.
    fn bases() -> [HSet; 2] {
        let base =
            |[a, b, c, d]: [State; 4]| HSet { left: Chord { bottom: a, top: b }, right: Chord { bottom: c, top: d } };
        [
            [[0.852141, 0.163451], [0.851903, 0.163962], [0.876103, 0.165998], [0.875865, 0.166509]],
            [[0.850561, 0.166845], [0.849622, 0.168861], [0.874860, 0.168667], [0.873921, 0.170684]],
        ]
        .map(base)
    }

    /// The stretch of the h-set where it begins is 8e-4 of it long, beside a graze at the fourth impact: it was in the cells that each impact
    /// costs at the ends of a cell chain.
    #[test]
    fn r37_a_word_that_begins_near_a_graze() {
        let (law, bases) = (figure_16(), bases());
        let search = Tried::new(&law, &bases, MAKINGS[0]).deepened((15, u64::MAX), &Unwatched).search;
        let flights = |path: &crate::chaos::words::Path| -> String {
            path.sides.iter().map(|side| if side.shift() > 0.0 { 'F' } else { 'N' }).collect()
        };
        let found =
            search.words.iter().filter(|path| (path.from, path.to) == (0, 1) && flights(path) == "NFNNNNFNNNNFNNN");
        assert_eq!(found.count(), 1);
    }

    #[test]
    fn a_search_ends_at_the_depth_that_its_boxes_allow() {
        let (law, bases) = (figure_16(), bases());
        let to = |most: u64| Tried::new(&law, &bases, MAKINGS[0]).deepened((64, most), &Unwatched);
        let tried = to(2000);
        assert!(tried.search.tally.boxes >= 2000 && !tried.is_stopped);
        // One impact less takes fewer.
        let before = Tried::new(&law, &bases, MAKINGS[0]).deepened((tried.depth - 1, u64::MAX), &Unwatched);
        assert!(before.search.tally.boxes < 2000);
        assert_eq!(to(0).depth, 0);
    }
}
