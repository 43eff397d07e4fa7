//! Words: returns of bases to bases, followed along those that are listed (Lemmas D7, D8, V12).

use std::collections::{HashMap, HashSet};
use std::sync::atomic::{AtomicBool, Ordering};

use super::Law;
use super::bases::Base;
use super::guess::Guess;
use super::propose::{Making, Proposal};
use super::tube::{Tube, WINDOW};
use crate::check::blocks::in_blocks;

/// A way from one base across another.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(in crate::check) struct Word {
    pub from: usize,
    pub to: usize,
    pub half_cycles: i64,
    /// Its flights in order: whether each is to the far wall.
    pub flights: Vec<bool>,
}

/// A stretch of a tube that has been followed so far.
struct Run {
    from: usize,
    flights: Vec<bool>,
    tube: Tube,
}

/// How often each word is listed, or found.
pub(super) type Counts = HashMap<Word, usize>;

/// The search for the listed words, one impact deeper at each step.
pub(super) struct Search<'s> {
    law: &'s Law,
    bases: &'s [Base],
    making: Making,
    guess: Guess,
    stop: Option<&'static AtomicBool>,
    /// The beginnings of all listed words, by their base.
    beginnings: HashSet<(usize, Vec<bool>)>,
    runs: Vec<Run>,
    pub found: Counts,
    /// Parts that were proved, or tried.
    pub parts: u64,
}

/// It is stopped by its user.
pub(super) struct Stopped;

impl<'s> Search<'s> {
    pub fn new(
        law: &'s Law,
        bases: &'s [Base],
        listed: &Counts,
        making: Making,
        stop: Option<&'static AtomicBool>,
    ) -> Self {
        let run = |(from, base): (usize, &Base)| Run {
            from,
            flights: Vec::new(),
            tube: Tube::new(vec![base.left, base.right]),
        };
        let beginnings = |word: &Word| {
            let (from, flights) = (word.from, word.flights.clone());
            (1..=flights.len()).map(move |count| (from, flights[..count].to_vec()))
        };
        Self {
            law,
            bases,
            making,
            guess: Guess::new(law),
            stop,
            beginnings: listed.keys().flat_map(beginnings).collect(),
            runs: bases.iter().enumerate().map(run).collect(),
            found: Counts::new(),
            parts: 0,
        }
    }

    /// Follows all that is left over one impact more.
    pub fn deepen(&mut self) -> Result<(), Stopped> {
        let followed = |range: std::ops::Range<usize>| range.map(|number| self.follow(&self.runs[number])).collect();
        let done = in_blocks(0..self.runs.len(), 1, followed, |_| {})?;
        self.runs.clear();
        for (runs, words, parts) in done {
            self.runs.extend(runs);
            words.into_iter().for_each(|word| *self.found.entry(word).or_default() += 1);
            self.parts += parts;
        }
        Ok(())
    }

    /// One run, one impact further: what is left, what crosses a base, and how many parts it took.
    fn follow(&self, run: &Run) -> Result<(Vec<Run>, Vec<Word>, u64), Stopped> {
        let (mut runs, mut words, mut count) = (Vec::new(), Vec::new(), 0);
        for Proposal { parts, is_far, next } in self.making.images(&self.guess, &run.tube) {
            let flights = [&run.flights[..], &[is_far]].concat();
            if !self.beginnings.contains(&(run.from, flights.clone())) {
                continue;
            }
            let mut proved = Vec::with_capacity(parts.len());
            for part in &parts {
                if self.stop.is_some_and(|stop| stop.load(Ordering::Relaxed)) {
                    return Err(Stopped);
                }
                proved.push(run.tube.is_mapped(self.law, &self.guess, part, is_far, &next));
            }
            count += parts.len() as u64; // exact: a length
            let mut first = 0;
            while first < parts.len() {
                let follows = |k: usize| proved[k] && (k == first || parts[k].follows(&parts[k - 1]));
                let end = (first..parts.len()).find(|&k| !follows(k)).unwrap_or(parts.len()); // exact: all of them
                if end > first {
                    // D7: the ends of the stretch land before the one and behind the other, none if it is shorter
                    let [low, high] =
                        [parts[first].place + WINDOW + 2, parts[end - 1].place.saturating_sub(WINDOW + 1)]; // D7: none
                    if low < high {
                        self.collect(run.from, &flights, &next.stretch(low, high), &mut runs, &mut words);
                    }
                }
                first = end.max(first + 1); // exact: the next part
            }
        }
        Ok((runs, words, count))
    }

    /// What of a stretch crosses a base, and what is left of it.
    fn collect(&self, from: usize, flights: &[bool], tube: &Tube, runs: &mut Vec<Run>, words: &mut Vec<Word>) {
        let far = flights.iter().filter(|&&is_far| is_far).count() as i64; // exact: a length
        let mut taken: Vec<[usize; 2]> = Vec::new();
        for (to, base) in self.bases.iter().enumerate() {
            for turns in base.turns(tube) {
                for [a, b] in base.crossings(tube, turns) {
                    if taken.iter().all(|&[c, d]| b <= c || d <= a) {
                        taken.push([a, b]);
                        let half_cycles = 2 * turns as i64 - far; // exact: a whole number
                        words.push(Word { from, to, half_cycles, flights: flights.to_vec() });
                    }
                }
            }
        }
        taken.sort_unstable();
        let mut start = 0;
        for [a, b] in taken.into_iter().chain([[tube.cells(); 2]]) {
            if a > start + 4 * WINDOW {
                runs.push(Run { from, flights: flights.to_vec(), tube: tube.stretch(start, a) });
            }
            start = b;
        }
    }
}
