//! Words: returns of bases to bases, followed along those that are listed (Lemmas D7, D8, V12).

use std::collections::{HashMap, HashSet};
use std::sync::atomic::{AtomicBool, Ordering};

use super::Law;
use super::bases::Base;
use super::guess::Guess;
use super::propose::{Making, Proposal};
use super::tube::{Chord, Tube, WINDOW};
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

/// What is proved of a tube: where it may be taken for a word.
struct Followed {
    run: Run,
    crossings: Vec<Crossing>,
}

/// Two chords between which a tube crosses a base.
struct Crossing {
    word: Word,
    chords: [usize; 2],
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
    listed: &'s Counts,
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
        listed: &'s Counts,
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
            listed,
            beginnings: listed.keys().flat_map(beginnings).collect(),
            runs: bases.iter().enumerate().map(run).collect(),
            found: Counts::new(),
            parts: 0,
        }
    }

    /// Follows all that is left over one impact more.
    pub fn deepen(&mut self) -> Result<(), Stopped> {
        let followed = |range: std::ops::Range<usize>| range.map(|number| self.follow(&self.runs[number])).collect();
        let done: Vec<(Vec<Followed>, u64)> = in_blocks(0..self.runs.len(), 1, followed, |_| {})?;
        self.parts += done.iter().map(|(_, parts)| parts).sum::<u64>();
        let mut followed: Vec<Followed> = done.into_iter().flat_map(|(followed, _)| followed).collect();
        self.found.extend(take(&mut followed, self.listed));
        self.runs = followed.into_iter().flat_map(Followed::rest).collect();
        Ok(())
    }

    /// One run, one impact further, and how many parts it took.
    fn follow(&self, run: &Run) -> Result<(Vec<Followed>, u64), Stopped> {
        let (mut all, mut count) = (Vec::new(), 0);
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
                        let run = Run { from: run.from, flights: flights.clone(), tube: next.stretch(low, high) };
                        all.push(Followed { crossings: self.crossings(&run), run });
                    }
                }
                first = end.max(first + 1); // exact: the next part
            }
        }
        Ok((all, count))
    }

    /// Where a stretch crosses a base as a listed word, no two of them with cells in common.
    fn crossings(&self, Run { from, flights, tube }: &Run) -> Vec<Crossing> {
        let far = flights.iter().filter(|&&is_far| is_far).count() as i64; // exact: a length
        let mut found: Vec<Crossing> = Vec::new();
        for (to, base) in self.bases.iter().enumerate() {
            for turns in base.turns(tube) {
                let half_cycles = 2 * turns as i64 - far; // exact: a whole number
                let word = Word { from: *from, to, half_cycles, flights: flights.clone() };
                if !self.listed.contains_key(&word) {
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

/// Takes words, as often as they are listed at most, and says how often: which of more does not matter; those first that have most room
/// in their tubes. The others are followed on, as others that cross a base and are not listed: longer words may be told of them.
fn take(followed: &mut [Followed], listed: &Counts) -> Counts {
    let mut rooms: HashMap<Word, Vec<f64>> = HashMap::new();
    for Followed { run, crossings } in followed.iter() {
        for crossing in crossings {
            rooms.entry(crossing.word.clone()).or_default().push(crossing.room(&run.tube));
        }
    }
    for (word, rooms) in &mut rooms {
        rooms.sort_unstable_by(|a, b| b.total_cmp(a));
        rooms.truncate(listed[word]);
    }
    let mut found = Counts::new();
    for Followed { run, crossings } in followed {
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
    /// How far its tube goes on beyond it, about, on the side where it ends first.
    fn room(&self, tube: &Tube) -> f64 {
        let [a, b] = self.chords;
        let way = |chords: &[Chord]| -> f64 {
            let step =
                |pair: &[Chord]| [0, 1].map(|i| (pair[1].bottom[i] - pair[0].bottom[i]).abs()).iter().sum::<f64>();
            chords.windows(2).map(step).sum()
        };
        way(&tube.chords()[..=a]).min(way(&tube.chords()[b..])) // proposes: which of several
    }
}

impl Followed {
    /// The runs that are left where its crossings are taken away.
    fn rest(self) -> impl Iterator<Item = Run> {
        let Run { from, flights, tube } = self.run;
        let mut taken: Vec<[usize; 2]> = self.crossings.iter().map(|crossing| crossing.chords).collect();
        taken.sort_unstable();
        taken.push([tube.cells(); 2]);
        let mut start = 0;
        taken.into_iter().filter_map(move |[a, b]| {
            let run =
                (a > start + 4 * WINDOW).then(|| Run { from, flights: flights.clone(), tube: tube.stretch(start, a) });
            start = b;
            run
        })
    }
}
