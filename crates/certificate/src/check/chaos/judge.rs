//! Check of the listed words of a chaos JSON (Lemmas V12, V39).

use impact_pair_model::Error;
use impact_pair_model::watch::{Latched, Stage, Watch};

use super::allowance::{Allowance, End};
use super::bases::HSet;
use super::entropy::at_least;
use super::propose::Making;
use super::strip::left_open;
use super::words::{Ahead, Counts, Search, Word};
use super::{Law, STEPS_PER_PLACE, cones};
use crate::chaos::ChaosCertificate;
use crate::check::contact::Doubt;
use crate::check::{Limits, Verdict};

/// Ways to make chains of boxes; any way will do: from cells that are fine to those that leave room for intervals of
/// parameters, and to those that are finest, for slow expansion.
pub(super) const MAKINGS: [Making; 7] = [
    Making { longest: 0.003, margin: 1.08, pad: 5e-6, shortest: 1e-9, ahead: 4 },
    Making { longest: 0.005, margin: 1.08, pad: 2e-5, shortest: 1e-8, ahead: 4 },
    Making { longest: 0.01, margin: 1.08, pad: 2e-5, shortest: 1e-6, ahead: 4 },
    Making { longest: 0.01, margin: 1.3, pad: 3e-4, shortest: 1e-5, ahead: 4 },
    Making { longest: 0.001, margin: 1.08, pad: 5e-6, shortest: 1e-9, ahead: 4 },
    Making { longest: 0.0006, margin: 1.08, pad: 6e-7, shortest: 1e-9, ahead: 12 },
    Making { longest: 0.0003, margin: 1.08, pad: 3e-7, shortest: 1e-9, ahead: 12 },
];
/// Number of the coarse ones, which come first. Where each of them loses words, at most `MAX_LOST_WORDS`, these are searched for again along chains
/// of boxes whose chords are measured from each number of flights ahead of `LOOKAHEADS`, as long as fewer are lost: another direction, where the
/// one that is contracted most jumps at a graze further ahead. The fine ones come last, where many words are lost.
const COARSE_MAKINGS: usize = 4;
const MAX_LOST_WORDS: usize = 32;
const LOOKAHEADS: [usize; 3] = [2, 3, 6];
/// Bits of the arithmetic.
const DOUBLE_BITS: u32 = f64::MANTISSA_DIGITS;

impl ChaosCertificate {
    /// Proves every listed word again, and that the entropies and the horseshoe follow from the list, or says what is not true or not
    /// proved, until the watch stops it, which receives the words confirmed so far.
    ///
    /// # Errors
    /// Returns an error if the scene's values are beyond the range of exact expressions, or if it has several harmonics.
    pub fn check_within(&self, limits: &Limits, watch: &dyn Watch) -> Result<Verdict, Error> {
        let watch = Latched::new(watch);
        let law = Law::of(&self.pair)?;
        let mut confirmed = 0;
        let mut progress = |words: usize| {
            confirmed = confirmed.max(words); // exact: a count
            watch.note(Stage::Claims(confirmed));
        };
        let (bases, words) = match self.says_one_thing() {
            Ok(said) => said,
            Err(doubt) => return Ok(doubt.on(self.count())),
        };
        let allowed = limits.work.saturating_mul(STEPS_PER_PLACE); // proposes: when to give up
        let each = (allowed / WORDS_PER_WORK).saturating_mul(words.len() as u64); // proposes: when to give up
        let work = Allowance::new(allowed.saturating_add(each), &watch); // proposes: when to give up
        let open = match &self.document.witness {
            Some(witness) => left_open(&law, (&bases, &words), &witness.strips, (allowed, &watch), &mut progress),
            None if self.document.over.is_some() => self.searched(&law, (&bases, &words), &work, &mut progress),
            None => return Ok(Doubt::open("no witness").on(self.count())),
        };
        Ok(match open {
            Ok(None) => match self.hyperbolic(&law, (&bases, &words), allowed, &watch) {
                Ok(None) => Verdict::Confirmed { bits: DOUBLE_BITS, pieces: 1 },
                Ok(Some(doubt)) => doubt.on(self.count()),
                Err(_) => Verdict::Interrupted { events: confirmed },
            },
            Ok(Some(verdict)) => verdict,
            Err(_) => Verdict::Interrupted { events: confirmed },
        })
    }

    /// The verdict if the words are not all found by a search; `None` if they are.
    fn searched(
        &self,
        law: &Law,
        (bases, words): (&[HSet], &[Word]),
        work: &Allowance,
        progress: &mut impl FnMut(usize),
    ) -> Result<Option<Verdict>, End> {
        let Some(mut found) = self.lost(law, bases, words, work, progress)? else { return Ok(None) };
        let why = if work.is_spent() { "the work allowed is spent" } else { "it is not proved again" };
        let is_found = |word: &Word| match found.get_mut(word) {
            Some(count) if *count > 0 => {
                *count -= 1;
                true
            }
            _ => false,
        };
        let is_found: Vec<bool> = words.iter().map(is_found).collect();
        Ok(Some(shortfall((&is_found, why), words, bases.len())))
    }

    /// The doubt that is left of a hyperbolic set, if one is claimed.
    fn hyperbolic(
        &self,
        law: &Law,
        listed: (&[HSet], &[Word]),
        allowed: u64,
        watch: &dyn Watch,
    ) -> Result<Option<Doubt>, End> {
        let Some(Some(set)) = &self.document.hyperbolic else { return Ok(None) };
        let work = Allowance::new(allowed.saturating_mul(CONE_WORK_FACTOR), watch); // proposes: when to give up
        match cones::doubt(law, listed, set, &work) {
            Err(End::Spent) => Ok(Some(Doubt::open("hyperbolic: the work allowed is spent"))),
            found => found,
        }
    }

    /// `None` if all words are found, or what is along the chains of boxes along which most of them are. Where the work is spent on the way, what
    /// was found with less of it stays.
    fn lost(
        &self,
        law: &Law,
        bases: &[HSet],
        words: &[Word],
        work: &Allowance,
        progress: &mut impl FnMut(usize),
    ) -> Result<Option<Counts>, End> {
        let mut listed = Counts::new();
        words.iter().for_each(|word| *listed.entry(word.clone()).or_default() += 1);
        let mut tries = ChainSearches { law, bases, words, listed, work, progress, best: None };
        let beginning_with =
            |first: usize| -> Vec<Making> { MAKINGS[first..].iter().chain(&MAKINGS[..first]).copied().collect() };
        let (mut best, mut most) = (0, 0);
        for first in 0..COARSE_MAKINGS {
            let found = tries.once(&beginning_with(first), &Ahead::new(), 0)?;
            if found.is_all {
                return Ok(None);
            }
            if found.words > most {
                (best, most) = (first, found.words); // proposes: any tubes will do
            }
        }
        // The coarse ones from the first one on, and from the one along which most words are found; the fine ones where many are lost.
        let mut fewest = usize::MAX;
        for first in if best == 0 { vec![0] } else { vec![0, best] } {
            let coarse: Vec<Making> = (0..COARSE_MAKINGS).map(|k| MAKINGS[(first + k) % COARSE_MAKINGS]).collect();
            let found = tries.search_lost(&coarse)?;
            if found.is_all {
                return Ok(None);
            }
            fewest = fewest.min(found.lost.len()); // proposes: any tubes will do
        }
        for first in COARSE_MAKINGS..MAKINGS.len() {
            // proposes: any tubes will do
            if fewest <= MAX_LOST_WORDS.min(words.len() / 2) {
                break;
            }
            let found = tries.search_lost(&beginning_with(first))?;
            if found.is_all {
                return Ok(None);
            }
            fewest = found.lost.len();
        }
        Ok(tries.best)
    }
}

/// Searches for the listed words along chains of boxes that are made in several ways.
struct ChainSearches<'t, P> {
    law: &'t Law,
    bases: &'t [HSet],
    words: &'t [Word],
    listed: Counts,
    work: &'t Allowance<'t>,
    progress: &'t mut P,
    /// The words found by the search that found most.
    best: Option<Counts>,
}

/// The result of one search: the number of words found, those lost as far as it went, and whether none is lost and it went to the end.
struct Found<'t> {
    words: usize,
    lost: Vec<&'t Word>,
    is_all: bool,
}

impl<'t, P: FnMut(usize)> ChainSearches<'t, P> {
    /// One search, until more than `most` words are lost.
    fn once(&mut self, makings: &[Making], ahead: &Ahead, most: usize) -> Result<Found<'t>, End> {
        let mut search = Search::new(self.law, self.bases, Some(&self.listed), (makings, ahead), self.work);
        let (lost, is_all) = match follow_all(&mut search, self.words, most, self.progress) {
            Ok(lost) => (lost.clone(), lost.is_empty()),
            Err(End::Spent) => (Vec::new(), false),
            Err(End::Stopped) => return Err(End::Stopped),
        };
        let found = search.found;
        let words = found.values().sum::<usize>();
        if self.best.as_ref().is_none_or(|best| words > best.values().sum()) {
            self.best = Some(found);
        }
        Ok(Found { words, lost, is_all })
    }

    /// A search, and others that look elsewhere for the words that it lost, as long as fewer are.
    fn search_lost(&mut self, makings: &[Making]) -> Result<Found<'t>, End> {
        let mut ahead = Ahead::new();
        let mut found = self.once(makings, &ahead, MAX_LOST_WORDS)?;
        for other in LOOKAHEADS {
            if found.lost.is_empty() || found.lost.len() > MAX_LOST_WORDS {
                break;
            }
            ahead.extend(found.lost.iter().flat_map(|word| word.beginnings()).map(|beginning| (beginning, other)));
            let next = self.once(makings, &ahead, MAX_LOST_WORDS)?;
            if !next.is_all && next.lost.len() >= found.lost.len() {
                break;
            }
            found = next;
        }
        Ok(found)
    }
}

/// Follows the words to the end, or until more than `most` are lost: those that are.
fn follow_all<'w>(
    search: &mut Search<'_>,
    words: &'w [Word],
    most: usize,
    progress: &mut impl FnMut(usize),
) -> Result<Vec<&'w Word>, End> {
    let deepest = words.iter().map(|word| word.flights.len()).max().unwrap_or(0); // exact: none where there are no words
    let mut lost: Vec<&Word> = Vec::new();
    for depth in 1..=deepest {
        search.deepen()?;
        lost.extend(words.iter().filter(|word| word.flights.len() == depth && search.is_missing(word)));
        if lost.len() > most {
            break;
        }
        if lost.is_empty() {
            progress(words.iter().filter(|word| word.flights.len() <= depth).count());
        }
    }
    Ok(lost)
}

/// The verdict at the first word that is not found, with the entropy of those that are: a part of a list proves what follows from that
/// part.
pub(super) fn shortfall((is_found, why): (&[bool], &str), words: &[Word], bases: usize) -> Verdict {
    let first = is_found.iter().position(|is_found| !is_found).expect("a word is missing");
    let kept: Vec<_> =
        words.iter().zip(is_found).filter(|(_, is_found)| **is_found).map(|(word, _)| word.by_impacts()).collect();
    let left = match at_least(&kept, bases) {
        Some(entropy) => format!(
            "; the {} of {} words that are proved have an entropy of at least {entropy} per impact",
            kept.len(),
            words.len()
        ),
        None => String::new(),
    };
    Doubt::Open(format!("{why}{left}")).on(first)
}

/// N words allow as much work again as there is for any number of them.
const WORDS_PER_WORK: u64 = 1 << 6;
/// Cones are N times as much work.
const CONE_WORK_FACTOR: u64 = 1 << 4;
