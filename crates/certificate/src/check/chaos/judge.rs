//! Whether the words of a chaos JSON, its entropies and its horseshoe are right (Lemma V12).

use std::sync::atomic::AtomicBool;

use impact_pair_exact::Real;
use impact_pair_model::{Error, Mapping, Wall};
use num_rational::BigRational;

use super::bases::Base;
use super::entropy::is_reached;
use super::propose::Making;
use super::span::Span;
use super::tube::side_of;
use super::words::{Ahead, Counts, Search, Stopped, Word};
use super::{BITS, Law};
use crate::chaos::ChaosCertificate;
use crate::check::contact::Doubt;
use crate::check::{Effort, Verdict};
use crate::document::{BaseDocument, WordDocument};

/// How tubes are made; any way will do: from cells that are fine to those that leave room for intervals of
/// parameters, and to those that are finest, for slow expansion.
const MAKINGS: [Making; 6] = [
    Making { longest: 0.003, margin: 1.08, pad: 5e-6, shortest: 1e-9, ahead: 4 },
    Making { longest: 0.005, margin: 1.08, pad: 2e-5, shortest: 1e-8, ahead: 4 },
    Making { longest: 0.01, margin: 1.08, pad: 2e-5, shortest: 1e-6, ahead: 4 },
    Making { longest: 0.01, margin: 1.3, pad: 3e-4, shortest: 1e-5, ahead: 4 },
    Making { longest: 0.0006, margin: 1.08, pad: 6e-7, shortest: 1e-9, ahead: 12 },
    Making { longest: 0.0003, margin: 1.08, pad: 3e-7, shortest: 1e-9, ahead: 12 },
];
/// Where each of them loses words, those that the coarse ones lose, if they are no more than so many, are looked for again along tubes
/// whose chords are told from so many flights ahead, as long as fewer are lost: another direction, where the one that is contracted most
/// jumps at a graze further ahead.
const COARSE: usize = 4;
const MOST_LOST: usize = 32;
const AHEAD: [usize; 3] = [2, 3, 6];
/// Bits of the arithmetic.
const DOUBLE: u32 = f64::MANTISSA_DIGITS;

/// A word by its position, and why it is not found.
type Unfound = (usize, &'static str);

impl ChaosCertificate {
    /// Proves every listed word again, and that the entropies and the horseshoe follow from the list, or says what is not true or not
    /// proved, until `stop` is set, if there is one. `progress` is told the words confirmed so far.
    ///
    /// # Errors
    /// When the scene's values are beyond what exact expressions hold, and under several harmonics.
    pub fn check_until(
        &self,
        effort: &Effort,
        stop: Option<&'static AtomicBool>,
        mut progress: impl FnMut(usize),
    ) -> Result<Verdict, Error> {
        let law = Law::of(self.pair())?;
        let mut confirmed = 0;
        let mut progress = |words: usize| {
            confirmed = confirmed.max(words); // exact: a count
            progress(confirmed);
        };
        let (bases, words) = match self.says_one_thing() {
            Ok(said) => said,
            Err(doubt) => return Ok(doubt.on(self.count())),
        };
        Ok(match self.lost(&law, &bases, &words, (effort.work, stop), &mut progress) {
            Ok(None) => Verdict::Confirmed { bits: DOUBLE, pieces: 1 },
            Ok(Some((word, why))) => Doubt::Open(why.to_owned()).on(word),
            Err(Stopped) => Verdict::Interrupted { events: confirmed },
        })
    }

    /// The bases and the words, if what is said of them follows from them.
    fn says_one_thing(&self) -> Result<(Vec<Base>, Vec<Word>), Doubt> {
        let document = self.document();
        let wrong = |message: &str| Err(Doubt::False(message.to_owned()));
        let corners = self.bases().iter().filter_map(|base| base.corners.as_ref());
        let bases: Vec<Base> = corners.map(Base::of).collect();
        if !bases.iter().all(Base::is_sound) {
            return wrong("a base is no convex quadrilateral of states with its tops to the left");
        }
        if (0..bases.len()).any(|k| bases[..k].iter().any(|other| !bases[k].is_apart(other))) {
            return wrong("the bases are not proved to be disjoint");
        }
        if !self.bases().iter().zip(&bases).all(|(told, base)| is_about(told, base)) {
            return wrong("a base is told to have its middle elsewhere");
        }
        let mut words = Vec::new();
        for (k, told) in document.words.iter().enumerate() {
            let word = Word::of(told, bases.len()).filter(|_| told.impacts <= document.depth);
            words.push(word.ok_or_else(|| {
                Doubt::False(format!("words[{k}] contradicts its own flights, the depth or the number of bases"))
            })?);
        }
        let impacts = |word: &Word| word.flights.len() as i64; // exact: a length
        let entropy = &document.entropy;
        let told = [entropy.per_impact.value(), entropy.per_cycle.value()];
        // Half cycles are weighed, two of which make a cycle.
        let halved = &told[1] / BigRational::from_integer(2.into());
        let weighed = |weight: &dyn Fn(&Word) -> i64| -> Vec<_> {
            words.iter().map(|word| (word.from, word.to, weight(word))).collect()
        };
        if told.iter().all(|entropy| *entropy <= BigRational::from_integer(0.into())) {
            return wrong("it says that an entropy is certified, but tells none");
        }
        for (what, weights, h) in
            [("per_impact", weighed(&impacts), &told[0]), ("per_cycle", weighed(&|word| word.half_cycles), &halved)]
        {
            if !is_reached(&weights, bases.len(), h) {
                return Err(Doubt::Open(format!("entropy.{what} does not follow from the words")));
            }
        }
        says_the_shortest(document.horseshoe.as_deref(), &words, bases.len())?;
        Ok((bases, words))
    }

    /// The first listed word that is not found, and why, where most of them are.
    fn lost(
        &self,
        law: &Law,
        bases: &[Base],
        words: &[Word],
        (work, stop): (u64, Option<&'static AtomicBool>),
        progress: &mut impl FnMut(usize),
    ) -> Result<Option<Unfound>, Stopped> {
        let mut listed = Counts::new();
        words.iter().for_each(|word| *listed.entry(word.clone()).or_default() += 1);
        let mut doubted = (0, "");
        let mut tried = |makings: &[Making], ahead: &Ahead, most: usize| {
            let mut search = Search::new(law, bases, &listed, (makings, ahead), stop);
            let (lost, why) = follow_all(&mut search, words, (work, most), progress)?;
            if !why.is_empty() {
                let proved = first_missing(words, search.found);
                if doubted.1.is_empty() || proved > doubted.0 {
                    doubted = (proved, why);
                }
            }
            Ok((lost, why.is_empty()))
        };
        for first in 0..MAKINGS.len() {
            let makings: Vec<Making> = MAKINGS[first..].iter().chain(&MAKINGS[..first]).copied().collect();
            if tried(&makings, &Ahead::new(), 0)?.1 {
                return Ok(None);
            }
        }
        let mut ahead = Ahead::new();
        let (mut lost, _) = tried(&MAKINGS[..COARSE], &ahead, MOST_LOST)?;
        for other in AHEAD {
            if lost.is_empty() || lost.len() > MOST_LOST {
                break;
            }
            ahead.extend(lost.iter().flat_map(|word| word.beginnings()).map(|beginning| (beginning, other)));
            let (next, is_all) = tried(&MAKINGS[..COARSE], &ahead, MOST_LOST)?;
            if is_all {
                return Ok(None);
            }
            if next.len() >= lost.len() {
                break;
            }
            lost = next;
        }
        Ok(Some(doubted))
    }
}

/// Follows the words to the end, or until more than `most` are lost: those that are, and what is to be said if not all are found.
fn follow_all<'w>(
    search: &mut Search<'_>,
    words: &'w [Word],
    (work, most): (u64, usize),
    progress: &mut impl FnMut(usize),
) -> Result<(Vec<&'w Word>, &'static str), Stopped> {
    let deepest = words.iter().map(|word| word.flights.len()).max().unwrap_or(0); // exact: none where there are no words
    let mut lost: Vec<&Word> = Vec::new();
    for depth in 1..=deepest {
        if search.parts > PARTS * work {
            return Ok((lost, "the work allowed is spent"));
        }
        search.deepen()?;
        lost.extend(words.iter().filter(|word| word.flights.len() == depth && search.is_missing(word)));
        if lost.len() > most {
            break;
        }
        if lost.is_empty() {
            progress(words.iter().filter(|word| word.flights.len() <= depth).count());
        }
    }
    let why = if lost.is_empty() { "" } else { "it is not proved again" };
    Ok((lost, why))
}

/// The first word that is listed more often than it is found.
fn first_missing(words: &[Word], mut found: Counts) -> usize {
    let is_missing = |word: &Word| match found.get_mut(word) {
        Some(count) if *count > 0 => {
            *count -= 1;
            false
        }
        _ => true,
    };
    words.iter().position(is_missing).unwrap_or(0) // exact: there is one
}

/// So many parts of tubes are as much work as one place of a flight in many bits.
const PARTS: u64 = 1 << 8;

impl Word {
    /// `None` if it contradicts itself.
    fn of(told: &WordDocument, bases: usize) -> Option<Self> {
        let flight = |name: char| match name {
            'F' => Some(true),
            'N' => Some(false),
            _ => None,
        };
        let flights: Vec<bool> = told.flights.chars().map(flight).collect::<Option<_>>()?;
        let [from, to, impacts] = [told.from, told.to, told.impacts].map(|n| n as usize); // exact: of 32 bits
        let fits = from < bases && to < bases && impacts == flights.len() && impacts > 0;
        fits.then_some(Self { from, to, half_cycles: told.half_cycles, flights })
    }

    /// In mappings from the left wall, the first one right-most.
    fn in_mappings(&self) -> String {
        let mut from = Wall::Left;
        let mut names = Vec::new();
        for &is_far in &self.flights {
            let to = if is_far { from.other() } else { from };
            names.push(Mapping::between(from, to).to_string());
            from = to;
        }
        names.reverse();
        names.join(" ")
    }
}

/// Whether a base's middle is told to be in it.
fn is_about(told: &BaseDocument, base: &Base) -> bool {
    let phase = Real::rational(&told.phase.value(), BITS).over(&(Real::pi(BITS) * 2)).expect("pi is not 0");
    let ends = [&phase, &Real::rational(&told.speed.value(), BITS)].map(|x| Span::of(x.enclosure()));
    let [left, right] = [base.left, base.right];
    let round = [left.bottom, right.bottom, right.top, left.top];
    let corners = [ends.map(Span::lo), ends.map(Span::hi)];
    (0..4).all(|i| corners.iter().all(|&state| side_of(round[i], round[(i + 1) % 4], state, 0.0).is_positive()))
}

/// Whether from bases of which some are left a word of each of two blocks leads to one of these.
fn is_free(words: &[Word], bases: usize, blocks: [&[bool]; 2]) -> bool {
    let mut alive = vec![true; bases];
    loop {
        let leads = |base: usize, block: &[bool]| {
            words.iter().any(|word| word.from == base && alive[word.to] && word.flights == block)
        };
        let next: Vec<bool> =
            (0..bases).map(|base| alive[base] && blocks.iter().all(|block| leads(base, block))).collect();
        if next == alive {
            return alive.contains(&true);
        }
        alive = next;
    }
}

/// Whether the two blocks told are free, and none of fewer impacts are: the longer one counts first.
fn says_the_shortest(told: Option<&str>, words: &[Word], bases: usize) -> Result<(), Doubt> {
    let mut names: Vec<&Word> = Vec::new();
    for word in words {
        if names.iter().all(|other| other.flights != word.flights) {
            names.push(word);
        }
    }
    names.sort_by_key(|word| word.flights.len());
    // By the longer one, the second.
    let mut shortest: Option<(usize, usize)> = None;
    let mut is_told_one = told.is_none();
    for (k, b) in names.iter().enumerate() {
        for a in &names[..k] {
            let size = (b.flights.len(), a.flights.len());
            if shortest.is_some_and(|shortest| size > shortest) || !is_free(words, bases, [&a.flights, &b.flights]) {
                continue;
            }
            if shortest.is_none_or(|shortest| size < shortest) {
                (shortest, is_told_one) = (Some(size), false);
            }
            let [a, b] = [a, b].map(|word| word.in_mappings());
            is_told_one |= told == Some(&format!("each block is {a} or {b}, in any order"));
        }
    }
    if is_told_one || told.is_none() && shortest.is_none() {
        Ok(())
    } else {
        Err(Doubt::False("the horseshoe is not one of two shortest blocks in any order".into()))
    }
}
