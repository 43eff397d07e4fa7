//! Trials of h-sets with few boxes: the entropy that they lead to.
//!
//! Labels: proposes throughout.

use std::ops::ControlFlow;

use super::bundles::Bundle;
use super::entropy::entropy;
use super::law::Law;
use super::propose::Making;
use super::words::{HSet, Search};
use crate::threads::each;
use crate::watch::{Stage, Watch};

/// The rounds of trials by which h-sets are found.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rounds {
    /// Trials: the number of h-sets, and of boxes for each; those that lead to most entropy stay.
    trials: &'static [(usize, u64)],
    /// The last trial if none led to any.
    last: (usize, u64),
    /// Greatest number of h-sets: more than one where the most entropy is looked for.
    pub most: usize,
    /// `true` if the search tries bundles of leaves first.
    pub bundled: bool,
    /// `true` if the search tries h-sets from everywhere where saddles lead to none.
    pub everywhere: bool,
}

/// The rounds for the most entropy, and for any.
pub(super) const THOROUGH: Rounds = Rounds {
    trials: &[(64, 2_500), (12, 10_000), (4, 40_000)],
    last: (12, 150_000),
    most: 3,
    bundled: true,
    everywhere: true,
};
pub(super) const ANY: Rounds =
    Rounds { trials: &[(32, 2_000), (4, 8_000)], last: (2, 20_000), most: 1, bundled: false, everywhere: false };
/// The rounds for h-sets that lead far.
pub(super) const BUNDLED: Rounds = Rounds { bundled: true, ..ANY };
/// The rounds for h-sets from everywhere.
pub(super) const SLOW: Rounds =
    Rounds { trials: &[(64, 6_000), (12, 40_000)], last: (4, 200_000), most: 2, bundled: false, everywhere: false };
/// Words of more impacts are not tried.
pub(super) const DEPTH: usize = 60;
/// Trials of bundles: their number, and the boxes for each h-set.
const BUNDLES: [(usize, u64); 2] = [(32, 10_000), (8, 60_000)];
/// Least factor by which one more h-set has to raise the entropy.
const MIN_ENTROPY_FACTOR: f64 = 1.01;

/// The settings of trials of h-sets.
#[derive(Clone, Copy)]
pub(super) struct Trials<'t> {
    pub law: &'t Law,
    pub making: Making,
    pub depth: usize,
    pub rounds: Rounds,
    pub watch: &'t dyn Watch,
}

impl Trials<'_> {
    /// Entropy that h-sets lead to with at most `boxes` boxes, per impact.
    fn entropy_of(&self, bases: &[HSet], boxes: u64) -> f64 {
        let mut search = Search::new(self.law, bases, self.making);
        search.threads = 1;
        let within = |at: Stage<'_>| match at {
            Stage::Horseshoe { boxes: done, .. } if done >= boxes => ControlFlow::Break(()),
            _ => self.watch.proceed(Stage::Working),
        };
        for _ in 0..self.depth.min(DEPTH) {
            if !search.deepen(&within) {
                break;
            }
        }
        entropy(&search.words, bases.len(), |word| word.sides.len() as i64)
    }

    /// H-sets with the most entropy among these bundles, and among bundles with other gaps as long as those are better; `None` if no bundle
    /// leads to any.
    pub fn best_bundle(&self, bundles: &[Bundle], parted: &dyn Fn(&Bundle) -> Vec<Bundle>) -> Option<Vec<HSet>> {
        let tried = |bundles: &[Bundle], boxes: u64| {
            let judged =
                |bundle: &Bundle| (self.entropy_of(&bundle.bases, boxes * bundle.bases.len() as u64), bundle.clone());
            let mut tried = each(bundles, &judged);
            tried.sort_by(|a, b| b.0.total_cmp(&a.0));
            tried
        };
        let mut best = bundles.to_vec();
        let mut worth = 0.0;
        for (count, boxes) in BUNDLES {
            best.truncate(count);
            let better = tried(&best, boxes);
            worth = better.first()?.0;
            best = better.into_iter().map(|(_, bundle)| bundle).collect();
        }
        let mut best = best.swap_remove(0);
        while self.watch.goes_on() {
            let next = tried(&parted(&best), BUNDLES[1].1).into_iter().next();
            let Some(better) = next.filter(|next| next.0 > worth) else { break };
            (worth, best) = better;
        }
        (worth > 0.0).then_some(best.bases)
    }

    /// H-set that leads, together with `found`, to the most entropy.
    fn one_more(&self, found: &[HSet], candidates: &[HSet]) -> Option<(f64, HSet)> {
        let free = candidates.iter().filter(|base| found.iter().all(|other| base.is_apart(other)));
        let mut tried: Vec<(f64, HSet)> = free.map(|&base| (0.0, base)).collect();
        let mut trial = |(count, boxes): (usize, u64)| {
            tried.truncate(count);
            let judged = |(_, base): &(f64, HSet)| {
                let bases: Vec<HSet> = found.iter().copied().chain([*base]).collect();
                (self.entropy_of(&bases, boxes * bases.len() as u64), *base)
            };
            tried = each(&tried, &judged);
            tried.sort_by(|a, b| b.0.total_cmp(&a.0));
            tried.first().copied()
        };
        let mut best = None;
        for &round in self.rounds.trials {
            best = trial(round);
        }
        if found.is_empty() && best.is_some_and(|best| best.0 == 0.0) {
            best = trial(self.rounds.last);
        }
        best
    }

    /// The h-sets among these that lead to the most entropy.
    pub fn best(&self, candidates: &[HSet]) -> Vec<HSet> {
        let mut best: (f64, Vec<HSet>) = (0.0, Vec::new());
        while best.1.len() < self.rounds.most && self.watch.goes_on() {
            let found = self.one_more(&best.1, candidates);
            let Some((entropy, base)) = found.filter(|found| found.0 > best.0 * MIN_ENTROPY_FACTOR) else { break };
            best.0 = entropy;
            best.1.push(base);
        }
        best.1
    }
}
