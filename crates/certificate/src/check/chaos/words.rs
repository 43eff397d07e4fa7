//! Words: returns of h-sets to h-sets, followed along those that are listed (Lemmas D7, D8, V12).

use std::collections::{HashMap, HashSet};

use super::Law;
use super::allowance::{Allowance, End};
use super::bases::HSet;
use super::guess::Guess;
use super::propose::{Making, Proposal};
use super::tube::{BoxChain, Chord, NEIGHBOUR_CELLS, proved_stretches};
use crate::check::blocks::in_blocks;

/// A covering relation from one h-set to another.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(in crate::check) struct Word {
    pub from: usize,
    pub to: usize,
    pub half_cycles: i64,
    /// Its flights in order: whether each is to the far wall.
    pub flights: Vec<bool>,
}

impl Word {
    /// Returns its h-set with none of its flights, the first one, the first two, and so on.
    pub fn beginnings(&self) -> impl Iterator<Item = Beginning> {
        (0..=self.flights.len()).map(|count| (self.from, self.flights[..count].to_vec()))
    }
}

/// A stretch of a chain of boxes that has been followed so far.
struct Run {
    from: usize,
    flights: Vec<bool>,
    tube: BoxChain,
}

/// A stretch of a chain of boxes, and the places where it is proved to cover h-sets as words.
struct Stretch {
    run: Run,
    crossings: Vec<Crossing>,
}

/// The stretches of the chains of boxes along which a run is mapped.
struct Followed {
    stretches: Vec<Stretch>,
}

impl Followed {
    /// Number of its crossings of h-sets as words of a kind.
    fn count(&self, is_such: impl Fn(&Word) -> bool) -> usize {
        let crossings = self.stretches.iter().flat_map(|stretch| &stretch.crossings);
        crossings.filter(|crossing| is_such(&crossing.word)).count()
    }
}

/// Two chords between which a chain of boxes covers an h-set.
struct Crossing {
    word: Word,
    chords: [usize; 2],
}

/// An h-set, and flights from it.
type Beginning = (usize, Vec<bool>);

/// Number of flights ahead that chains of boxes are measured from, for the beginnings where it differs from `Making::ahead`.
pub(super) type Ahead = HashMap<Beginning, usize>;

/// Number of times that each word is listed, or found.
pub(super) type Counts = HashMap<Word, usize>;

/// The search for the listed words, or for all words, one impact deeper at each step.
pub(super) struct Search<'s> {
    law: &'s Law,
    bases: &'s [HSet],
    /// Ways to make chains of boxes: the first one, then the others where that one loses words.
    makings: &'s [Making],
    guess: Guess,
    work: &'s Allowance<'s>,
    /// Number of times that each word is listed; `None` where all are searched for.
    listed: Option<&'s Counts>,
    /// The beginnings of all listed words, by their h-set.
    beginnings: HashSet<Beginning>,
    ahead: &'s Ahead,
    runs: Vec<Run>,
    pub found: Counts,
}

impl<'s> Search<'s> {
    pub fn new(
        law: &'s Law,
        bases: &'s [HSet],
        listed: Option<&'s Counts>,
        (makings, ahead): (&'s [Making], &'s Ahead),
        work: &'s Allowance<'s>,
    ) -> Self {
        let run = |(from, base): (usize, &HSet)| Run {
            from,
            flights: Vec::new(),
            tube: BoxChain::new(vec![base.left, base.right]),
        };
        Self {
            law,
            bases,
            makings,
            guess: Guess::new(law),
            work,
            listed,
            ahead,
            beginnings: listed.into_iter().flat_map(Counts::keys).flat_map(Word::beginnings).collect(),
            runs: bases.iter().enumerate().map(run).collect(),
            found: Counts::new(),
        }
    }

    /// Follows all that is left over one impact more; where the work is spent nothing of that impact is kept.
    pub fn deepen(&mut self) -> Result<(), End> {
        let first = |range: std::ops::Range<usize>| {
            range.map(|number| self.follow(&self.runs[number], &self.first(&self.runs[number]))).collect()
        };
        let mut done: Vec<Followed> = in_blocks(0..self.runs.len(), 1, first, |_| {})?;
        // Other tubes of the runs from which words are missing: of each run those that have most of them.
        let missing = self.missing(&done);
        let again = |range: std::ops::Range<usize>| {
            range.map(|number| self.follow_again(&self.runs[number], &done[number], &missing)).collect()
        };
        let better: Vec<Option<Followed>> = in_blocks(0..self.runs.len(), 1, again, |_| {})?;
        for (followed, better) in done.iter_mut().zip(better) {
            if let Some(better) = better {
                *followed = better;
            }
        }
        let mut next: Vec<Stretch> = done.into_iter().flat_map(|followed| followed.stretches).collect();
        self.found.extend(take(&mut next, self.listed));
        self.runs = next.into_iter().flat_map(Stretch::rest).collect();
        Ok(())
    }

    /// The way in which chains of boxes of a run are made at first.
    fn first(&self, run: &Run) -> Making {
        let ahead = self.ahead.get(&(run.from, run.flights.clone()));
        Making { ahead: ahead.copied().unwrap_or(self.makings[0].ahead), ..self.makings[0] } // proposes: any tubes will do
    }

    /// Returns whether a word is found less often than it is listed.
    pub fn is_missing(&self, word: &Word) -> bool {
        let listed = self.listed.and_then(|listed| listed.get(word).copied()).unwrap_or(0); // exact: none is
        self.found.get(word).copied().unwrap_or(0) < listed // exact: none is found
    }

    /// The listed words of this depth that are found less often than they are listed.
    fn missing(&self, done: &[Followed]) -> HashSet<&Word> {
        let depth = self.runs.first().map_or(0, |run| run.flights.len() + 1); // exact: a count
        let is_missing = |word: &&Word| {
            let found: usize = done.iter().map(|followed| followed.count(|other| other == *word)).sum();
            word.flights.len() == depth && self.listed.is_some_and(|listed| found < listed[*word])
        };
        self.listed.into_iter().flat_map(Counts::keys).filter(is_missing).collect()
    }

    /// One run, one impact further, along the first chains of boxes that are made.
    fn follow(&self, run: &Run, making: &Making) -> Result<Followed, End> {
        let (mut stretches, mut used) = (Vec::new(), None);
        for Proposal { parts, is_far, next } in making.images(&self.guess, &run.tube, self.work)? {
            let flights = [&run.flights[..], &[is_far]].concat();
            if self.listed.is_some() && !self.beginnings.contains(&(run.from, flights.clone())) {
                continue;
            }
            let mut proved = Vec::with_capacity(parts.len());
            for part in &parts {
                proved.push(run.tube.is_mapped((self.law, &self.guess, self.work), part, is_far, &next)?);
            }
            for stretch in proved_stretches(&parts, &proved, &mut used) {
                // D7: the ends of the stretch land before the one and behind the other, none if it is shorter
                let [low, high] = [
                    parts[*stretch.start()].place + NEIGHBOUR_CELLS + 2,
                    parts[*stretch.end()].place.saturating_sub(NEIGHBOUR_CELLS + 1),
                ]; // D7: none
                if low < high {
                    let run = Run { from: run.from, flights: flights.clone(), tube: next.stretch(low, high) };
                    stretches.push(Stretch { crossings: self.crossings(&run), run });
                }
            }
        }
        Ok(Followed { stretches })
    }

    /// The same along other chains of boxes, if these cross h-sets as more of the missing words, and as no fewer listed ones.
    fn follow_again(&self, run: &Run, before: &Followed, missing: &HashSet<&Word>) -> Result<Option<Followed>, End> {
        if !missing.iter().any(|word| word.from == run.from && word.flights.starts_with(&run.flights)) {
            return Ok(None);
        }
        let score = |followed: &Followed| (followed.count(|word| missing.contains(word)), followed.count(|_| true));
        let mut best = None;
        for making in &self.makings[usize::from(self.ahead.is_empty())..] {
            let other = self.follow(run, making)?;
            let (most, all) = score(best.as_ref().unwrap_or(before)); // proposes: any tubes will do
            if score(&other).0 > most && score(&other).1 >= all {
                best = Some(other);
            }
        }
        Ok(best)
    }

    /// The crossings of h-sets by a stretch as listed words, no two of them with cells in common.
    fn crossings(&self, Run { from, flights, tube }: &Run) -> Vec<Crossing> {
        let far = flights.iter().filter(|&&is_far| is_far).count() as i64; // exact: a length
        let mut found: Vec<Crossing> = Vec::new();
        for (to, base) in self.bases.iter().enumerate() {
            for turns in base.turns(tube) {
                let half_cycles = 2 * turns as i64 - far; // exact: a whole number
                let word = Word { from: *from, to, half_cycles, flights: flights.clone() };
                if self.listed.is_some_and(|listed| !listed.contains_key(&word)) {
                    continue;
                }
                for [a, b] in base.crossings(tube, turns) {
                    if found.iter().all(|other| b <= other.chords[0] || other.chords[1] <= a) {
                        found.push(Crossing { word: word.clone(), chords: [a, b] });
                    }
                }
            }
        }
        found
    }
}

/// Takes words, as often as they are listed at most, if any are, and says how often: which of more does not matter; those first that have most room
/// in their chains of boxes. The others are followed on, as others that cross an h-set and are not listed: longer words may be relative to them.
fn take(stretches: &mut [Stretch], listed: Option<&Counts>) -> Counts {
    let mut rooms: HashMap<Word, Vec<f64>> = HashMap::new();
    for Stretch { run, crossings } in stretches.iter() {
        for crossing in crossings {
            rooms.entry(crossing.word.clone()).or_default().push(crossing.room(&run.tube));
        }
    }
    for (word, rooms) in &mut rooms {
        rooms.sort_unstable_by(|a, b| b.total_cmp(a));
        rooms.truncate(listed.map_or(usize::MAX, |listed| listed[word])); // exact: all of them
    }
    let mut found = Counts::new();
    for Stretch { run, crossings } in stretches {
        crossings.retain(|crossing| {
            let rooms = rooms.get_mut(&crossing.word).expect("it has been counted");
            let place = rooms.iter().position(|&room| room == crossing.room(&run.tube));
            place.map(|place| rooms.swap_remove(place)).is_some()
        });
        crossings.iter().for_each(|crossing| *found.entry(crossing.word.clone()).or_default() += 1);
    }
    found
}

impl Crossing {
    /// Approximate length of the chain of boxes beyond the crossing, on the side where the chain ends first.
    fn room(&self, tube: &BoxChain) -> f64 {
        let [a, b] = self.chords;
        let chords_length = |chords: &[Chord]| -> f64 {
            let step =
                |pair: &[Chord]| [0, 1].map(|i| (pair[1].bottom[i] - pair[0].bottom[i]).abs()).iter().sum::<f64>();
            chords.windows(2).map(step).sum()
        };
        chords_length(&tube.chords()[..=a]).min(chords_length(&tube.chords()[b..])) // proposes: which of several
    }
}

impl Stretch {
    /// The runs that are left where its crossings are taken away.
    fn rest(self) -> impl Iterator<Item = Run> {
        let Run { from, flights, tube } = self.run;
        let mut taken: Vec<[usize; 2]> = self.crossings.iter().map(|crossing| crossing.chords).collect();
        taken.sort_unstable();
        taken.push([tube.cells(); 2]);
        let mut start = 0;
        taken.into_iter().filter_map(move |[a, b]| {
            let run = (a > start + 4 * NEIGHBOUR_CELLS).then(|| Run {
                from,
                flights: flights.clone(),
                tube: tube.stretch(start, a),
            });
            start = b;
            run
        })
    }
}
