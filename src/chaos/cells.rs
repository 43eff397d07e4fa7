//! The values of a parameter in cells: those that hold a horseshoe, those with a stable periodic orbit, that of the scene's own start or
//! another one, or both. Lemma D14

mod document;
mod followed;
mod shares;
mod spread;
#[cfg(test)]
mod tests;

use std::iter;
use std::sync::atomic::{AtomicU32, Ordering};

use impact_pair_model::vocabulary::StretchVerdict;

use super::attracted::{StablePeriod, attracted};
use super::guess::Guess;
use super::horseshoe::{Horseshoe, bases};
use super::itinerary::{rotated_to_its_least, word_of_both};
use super::law::Law;
use super::quad::State;
use super::scene::{Visited, visited};
use super::seen::{AttractorOrbit, seen};
use super::stable::stable;
use super::trials::ANY;
use super::words::HSet;
use crate::exact::{Exact, ExactError};
use crate::mapping::Word;
use crate::orbit::Start;
use crate::pair::{ImpactPair, within};
use crate::scene::Range;
use crate::threads::each;
use crate::watch::{Stage, Watch};
use crate::{Effort, Error};

/// The most cells that a range is cut into.
pub const MOST_CELLS: u32 = 1_000_000;
/// Number of times that a cell is halved with the usual effort, and the most times.
const USUAL_HALVINGS: u32 = 8;
const MOST_HALVINGS: u32 = 24;

/// Settings of a search for horseshoes over a range of a parameter.
#[derive(Clone, Debug)]
pub struct RangeSettings {
    /// The parameter and its range.
    pub over: Range,
    /// Number of equally wide cells that the range is cut into.
    pub cells: u32,
    /// Number of times that a cell is halved at most, where nothing is proved of all of it.
    pub halvings: u32,
    /// The most impacts of a horseshoe's words.
    pub depth: usize,
}

impl RangeSettings {
    /// Number of halvings of a cell with this effort: one more where it doubles, as there are then twice as many parts to decide at most.
    pub fn halvings(effort: Effort) -> u32 {
        effort.doubled(USUAL_HALVINGS, (0, MOST_HALVINGS))
    }
}

/// Result that is proved for all values of the parameter in a stretch.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// The impact map of each pair holds a horseshoe; what becomes of the scene's own orbit is not proved.
    Horseshoe(Horseshoe),
    /// The orbit of the scene's own start converges to a stable periodic orbit.
    Attracted {
        /// The word of the period, from that impact on that makes it the first one in the alphabet of L and R.
        word: Word,
        /// Number of forcing periods that the orbit takes.
        cycles: u32,
        /// A horseshoe beside it, if one is proved: both may be true.
        beside: Option<Horseshoe>,
    },
    /// Each pair has a stable periodic orbit; that the scene's own orbit converges to it is not proved.
    Stable {
        /// The word of the period, of it or its mirror image from that impact on that makes it the first one in the alphabet of L and R.
        word: Word,
        /// Number of forcing periods that the orbit takes.
        cycles: u32,
        /// A horseshoe beside it, if one is proved.
        beside: Option<Horseshoe>,
    },
    /// Nothing of these is proved.
    Undecided,
}

impl Verdict {
    /// Name of the verdict in the outputs.
    pub fn kind(&self) -> StretchVerdict {
        match self {
            Self::Horseshoe(_) => StretchVerdict::Horseshoe,
            Self::Attracted { .. } => StretchVerdict::Attracted,
            Self::Stable { .. } => StretchVerdict::Stable,
            Self::Undecided => StretchVerdict::Undecided,
        }
    }

    /// The horseshoe that is proved, whatever becomes of the scene's own orbit.
    pub fn horseshoe(&self) -> Option<&Horseshoe> {
        match self {
            Self::Horseshoe(horseshoe) => Some(horseshoe),
            Self::Attracted { beside, .. } | Self::Stable { beside, .. } => beside.as_ref(),
            Self::Undecided => None,
        }
    }

    /// The word of the stable periodic orbit that is proved, and how many cycles it takes.
    pub fn period(&self) -> Option<(&Word, u32)> {
        match self {
            Self::Attracted { word, cycles, .. } | Self::Stable { word, cycles, .. } => Some((word, *cycles)),
            Self::Horseshoe(_) | Self::Undecided => None,
        }
    }

    /// Whether this verdict's word and cycles are those of `other`, several times over. Lemma D15: at a common value the two
    /// verdicts are about one orbit
    fn is_round_of(&self, other: &Self) -> bool {
        let (Self::Attracted { word: round, cycles: all, beside }, Self::Attracted { word, cycles, beside: own }) =
            (self, other)
        else {
            return false;
        };
        let mut parts = round.mappings().chunks(word.mappings().len());
        let times = parts.len();
        times > 1
            && parts.all(|part| part == word.mappings())
            && usize::try_from(*all / cycles) == Ok(times)
            && all.is_multiple_of(*cycles)
            && beside == own
    }
}

/// Neighbouring values of a parameter with the same proved verdict, endpoints included.
#[derive(Clone, Debug)]
pub struct Stretch {
    /// The least value.
    pub low: Exact,
    /// The greatest value.
    pub high: Exact,
    /// The verdict, for all of these values.
    pub verdict: Verdict,
    /// Number of times that the widest cell in it was halved.
    halved: u32,
    /// Its parts, each with its upper end and the horseshoe that is proved there: all of the same entropy, of the same h-sets.
    parts: Vec<(Exact, Horseshoe)>,
}

impl Stretch {
    fn new([low, high]: [Exact; 2], verdict: Verdict, halved: u32) -> Self {
        Self { low, high, verdict: Verdict::Undecided, halved, parts: Vec::new() }.with(verdict)
    }

    /// The same values with what is proved of all of them at once.
    fn with(self, verdict: Verdict) -> Self {
        let parts = verdict.horseshoe().map(|horseshoe| (self.high.clone(), horseshoe.clone()));
        Self { verdict, parts: parts.into_iter().collect(), ..self }
    }

    /// Both, one after the other, with the verdict of one of them.
    fn joined(self, next: Self, verdict: Verdict) -> Self {
        let halved = self.widest(&next);
        let parts = self.parts.into_iter().chain(next.parts).collect();
        Self { low: self.low, high: next.high, verdict, halved, parts }
    }

    /// Number of times that the widest cell in either was halved.
    fn widest(&self, other: &Self) -> u32 {
        self.halved.min(other.halved) // exact: a count
    }
}

/// The values of a parameter, by what is proved: without gaps, in their order.
///
/// **Enclosure**: each verdict holds for every value in its stretch, endpoints included. Lemmas D11, D12, D14, D15, D34
/// **Cost**: some seconds of a processor for a cell with a horseshoe, or where one is looked for beside a stable orbit; milliseconds
/// to prove that orbit, as often as the cell is halved.
#[derive(Clone, Debug)]
pub struct Cells {
    /// The stretches, each with its verdict.
    pub stretches: Vec<Stretch>,
    /// `true` if it was stopped; what was not looked at is undecided.
    pub interrupted: bool,
}

/// Number of halvings of a cell up to which a horseshoe is looked for beside a stable orbit.
const SEARCHED_HALVINGS: u32 = 4;

/// A search at work.
struct Work<'w> {
    pair: &'w ImpactPair,
    start: &'w Start,
    requested: &'w RangeSettings,
    watch: &'w dyn Watch,
}

impl Cells {
    /// Proves a verdict for each value of the parameter.
    ///
    /// `watch` receives the number of cells done, and may stop it; results proved so far are kept. First each cell is examined separately,
    /// then what is undecided is tried by the h-sets of horseshoes beside it, in a fixed order, so threads decide nothing.
    ///
    /// # Errors
    /// With several harmonics, where an end is no valid value of the parameter, and when a value is beyond the range of
    /// flights.
    pub fn of(pair: &ImpactPair, start: &Start, requested: &RangeSettings, watch: &dyn Watch) -> Result<Self, Error> {
        let (key, low, high) = (requested.over.key(), requested.over.low(), requested.over.high());
        Law::of(&pair.with(key, within(NAME, low, Exact::interval(low, high))?)?)?;
        let done = AtomicU32::new(0);
        let at = |_: Stage<'_>| watch.proceed(Stage::Parameter(done.load(Ordering::Relaxed)));
        let work = Work { pair, start, requested, watch: &at };
        let cells: Vec<u32> = (0..requested.cells).collect();
        let found = each(&cells, &|cell| {
            let stretches = work.cell(*cell);
            done.fetch_add(1, Ordering::Relaxed);
            stretches
        });
        let mut stretches: Vec<Stretch> = Vec::new();
        for cell in found {
            cell?.into_iter().for_each(|stretch| join(&mut stretches, stretch));
        }
        let stretches = work.spread(stretches)?;
        Ok(Self { stretches, interrupted: watch.proceed(Stage::Parameter(requested.cells)).is_break() })
    }
}

/// The name of the value in messages.
const NAME: &str = "the parameter";

/// Adds a stretch behind the others, to the last one where the same is proved of both. Lemma D14: they have the end in common
fn join(stretches: &mut Vec<Stretch>, stretch: Stretch) {
    match stretches.pop() {
        Some(last) if last.verdict == stretch.verdict => {
            let verdict = stretch.verdict.clone();
            stretches.push(last.joined(stretch, verdict));
        }
        Some(last) if last.verdict.is_round_of(&stretch.verdict) => {
            let verdict = stretch.verdict.clone();
            join(stretches, last.joined(stretch, verdict));
        }
        Some(last) if stretch.verdict.is_round_of(&last.verdict) => {
            let verdict = last.verdict.clone();
            stretches.push(last.joined(stretch, verdict));
        }
        last => stretches.extend(last.into_iter().chain([stretch])),
    }
}

impl Work<'_> {
    /// An edge between cells.
    fn edge(&self, index: u32) -> Result<Exact, ExactError> {
        self.requested.over.value(index.into(), self.requested.cells.into())
    }

    fn cell(&self, index: u32) -> Result<Vec<Stretch>, Error> {
        let edge = |index| within(NAME, self.requested.over.low(), self.edge(index));
        let (mut stretches, mut known) = (Vec::new(), Vec::new());
        self.decide([edge(index)?, edge(index + 1)?], 0, &mut known, &mut stretches)?;
        let wide = |stretch: &Stretch| stretch.halved <= SEARCHED_HALVINGS;
        for stretch in stretches.iter_mut().filter(|stretch| wide(stretch)) {
            self.look_beside(stretch, &mut known)?;
        }
        Ok(stretches)
    }

    /// Looks for a horseshoe where a stable orbit is proved: one does not exclude the other.
    fn look_beside(&self, stretch: &mut Stretch, known: &mut Vec<HSet>) -> Result<(), Error> {
        let Stretch { low, high, verdict, parts, .. } = stretch;
        let (Verdict::Attracted { beside, .. } | Verdict::Stable { beside, .. }) = verdict else { return Ok(()) };
        let middle = middle(low, high)?;
        let pair = self.pair.with(self.requested.over.key(), within(NAME, low, Exact::interval(low, high))?)?;
        if self.watch.goes_on() {
            *beside = self.horseshoe(&pair, [&middle, low, high], known, true)?;
            *parts = beside.iter().map(|horseshoe| (high.clone(), horseshoe.clone())).collect();
        }
        Ok(())
    }

    /// Decides a cell, or its halves; `known` are the h-sets of the last proved horseshoe.
    fn decide(
        &self,
        [low, high]: [Exact; 2],
        halved: u32,
        known: &mut Vec<HSet>,
        found: &mut Vec<Stretch>,
    ) -> Result<(), Error> {
        let all = within(NAME, &low, Exact::interval(&low, &high))?;
        let pair = self.pair.with(self.requested.over.key(), all)?;
        let middle = middle(&low, &high)?;
        let mut verdict = Verdict::Undecided;
        if self.watch.goes_on() {
            verdict = self.periodic(&pair, halved >= self.requested.halvings)?;
            if verdict == Verdict::Undecided && halved == 0 {
                let found = self.horseshoe(&pair, [&middle, &low, &high], known, false)?;
                verdict = found.map_or(Verdict::Undecided, Verdict::Horseshoe); // exact: none is proved
            }
            if verdict == Verdict::Undecided && halved < self.requested.halvings {
                self.decide([low, middle.clone()], halved + 1, known, found)?;
                return self.decide([middle, high], halved + 1, known, found);
            }
        }
        join(found, Stretch::new([low, high], verdict, halved));
        Ok(())
    }

    /// Verdict on a stable periodic orbit that the scene's own orbit converges to. For cells that are not halved any more, also
    /// on one where only the floating-point orbit settles.
    fn periodic(&self, pair: &ImpactPair, is_last: bool) -> Result<Verdict, Error> {
        let Some(first) = visited(pair, self.start, 1)?.into_iter().find(|state| state.index > 0) else {
            return Ok(Verdict::Undecided);
        };
        let law = Law::of(pair)?;
        if let Some(StablePeriod { word, cycles, .. }) = attracted(&law, &first, self.watch) {
            return Ok(Verdict::Attracted { word: rotated_to_its_least(&word), cycles, beside: None });
        }
        Ok(match is_last.then(|| stable(&law, first.middle(), self.watch)).flatten() {
            Some(StablePeriod { word, cycles, .. }) => {
                Verdict::Stable { word: word_of_both(&word), cycles, beside: None }
            }
            None => Verdict::Undecided,
        })
    }

    /// H-sets that are known, or else those that a floating-point orbit in the cell leads to, are tried for all of the cell; where it is
    /// regular, with `transients` those that are seen before orbits come near it.
    fn horseshoe(
        &self,
        pair: &ImpactPair,
        values: [&Exact; 3],
        known: &mut Vec<HSet>,
        transients: bool,
    ) -> Result<Option<Horseshoe>, Error> {
        if !self.watch.goes_on() {
            return Ok(None);
        }
        let law = Law::of(pair)?;
        let Some((_, orbit)) = self.looked_at(values, transients)? else { return Ok(None) };
        let found = || bases(&orbit, &law, self.requested.depth, ANY, self.watch);
        for again in [true, false] {
            let bases = if again { known.clone() } else { found() };
            if let Some(horseshoe) = Horseshoe::of(&law, bases, self.requested.depth, self.watch) {
                known.clone_from(&horseshoe.bases);
                return Ok(Some(horseshoe));
            }
        }
        Ok(None)
    }

    /// The first of some values whose floating-point orbit is chaotic, and that orbit; or, with `transients`, regular, and what is seen before
    /// orbits come near it.
    fn looked_at(&self, values: [&Exact; 3], transients: bool) -> Result<Option<(Exact, AttractorOrbit)>, Error> {
        for value in values {
            let one = self.pair.with(self.requested.over.key(), value.clone())?;
            let guess = Guess::new(&Law::of(&one)?);
            let orbit = visited(&one, self.start, 1)?.last().and_then(|last| seen(&guess, last.middle()));
            let looked_at = match orbit {
                Some(orbit) if transients && !orbit.is_chaotic() => Some(orbit.transients(&guess)),
                orbit => orbit.filter(AttractorOrbit::is_chaotic),
            };
            if let Some(orbit) = looked_at {
                return Ok(Some((value.clone(), orbit)));
            }
        }
        Ok(None)
    }
}

/// The value in the middle of a range.
fn middle(low: &Exact, high: &Exact) -> Result<Exact, Error> {
    within(NAME, low, low.checked_add(high).and_then(|sum| sum.checked_div(&Exact::from(2))))
}

/// Impacts of a floating-point orbit after a transient, for pictures, without proof. None where the orbit ends.
///
/// # Errors
/// With several harmonics, and when a value is beyond the range of flights.
pub fn seen_impacts(pair: &ImpactPair, start: &Start, [transient, impacts]: [usize; 2]) -> Result<Vec<State>, Error> {
    let guess = Guess::new(&Law::of(pair)?);
    let Some(first) = visited(pair, start, 1)?.last().map(Visited::middle) else { return Ok(Vec::new()) };
    // proposes: shown
    let next = |state: &State| guess.map(*state).map(|image| [image.state[0].rem_euclid(1.0), image.state[1]]);
    Ok(iter::successors(Some(first), next).skip(transient).take(impacts).collect())
}
