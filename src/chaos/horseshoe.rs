//! Horseshoes of a scene: [`Chaos`].

use super::asymptotics::Asymptotics;
use super::blocks::{Word, horseshoe};
use super::entropy::entropy;
use super::guess::Guess;
use super::law::Law;
use super::propose::Making;
use super::quad::State;
use super::scene::{IMPACTS, visited};
use super::seen::{Seen, seen};
use super::trials::{ANY, Effort, THOROUGH};
use super::words::{Base, Search};
use crate::Error;
use crate::Scene;
use crate::orbit::Start;
use crate::pair::ImpactPair;
use crate::watch::{Latched, Silent, Stage, Watch};

/// Greatest accepted number of impacts of a word.
pub const MOST_DEPTH: u32 = 64;
/// Number of boxes at which a search without a given depth goes no deeper.
const BOXES: u64 = 1_000_000;

/// The settings of a search for horseshoes.
#[derive(Clone, Debug)]
pub struct HorseshoeSettings {
    /// Maximum number of impacts of a word; `None`: as many as about a million boxes lead to.
    pub depth: Option<usize>,
    /// The h-sets; searched for if empty.
    pub bases: Vec<Base>,
}

/// Proved covering relations of a scene's impact map, as words: each sequence of words that fits together is that of a true motion.
///
/// **Enclosure**: for every parameter of the pair, and every sequence of words each of which starts in the h-set that the
/// one before covers, there is a motion with these impacts, no other contact between them; a periodic sequence has a periodic
/// motion. Motions of different sequences are different. The topological entropy of the impact map on a compact invariant set
/// without grazes is at least [`Chaos::entropy`]. Lemmas D6-D11
/// **Cost**: about 10 microseconds per box; if no h-sets are given, some hundred thousand boxes to find them.
///
/// ```
/// use impact_pair::Scene;
/// use impact_pair::chaos::{Base, Chaos, HorseshoeSettings};
/// use impact_pair::watch::Unwatched;
/// let scene = Scene::parse(r#"
///     excitation = { amplitude = 8, frequency = "pi", phase = 0 }
///     pair = { gap = 9.42497, restitution = 0.5 }
///     start = { time = 0, wall = "left", velocity = -12.56636 }
/// "#)?;
/// let bases = vec![
///     Base::new([0.77843, 1.234518], [0.02877, 0.082], [-0.0002976, 0.002596]),
///     Base::new([0.779603, 1.224294], [0.028826, 0.081513], [-0.0001488, 0.001298]),
///     Base::new([0.780161, 1.219425], [0.028649, 0.083055], [-0.0001116, 0.000974]),
/// ];
/// let chaos = Chaos::of(scene.pair(), scene.start(), &HorseshoeSettings { depth: Some(3), bases }, &Unwatched)?;
/// // As many motions over n cycles as sequences of two letters.
/// assert!(chaos.entropy() >= 0.28119 && chaos.entropy_a_cycle() >= 0.69314);
/// assert_eq!(chaos.horseshoe().unwrap().map(|word| word.in_mappings()), ["P1 P2", "P1 P2 P4"]);
/// # Ok::<(), impact_pair::Error>(())
/// ```
#[derive(Debug)]
pub struct Chaos {
    bases: Vec<Base>,
    words: Vec<Word>,
    depth: usize,
    boxes: u64,
    is_interrupted: bool,
    entropy: [f64; 2],
    exponent: Option<f64>,
    attractor: Vec<State>,
    tubes: Vec<Vec<State>>,
    asymptotics: Asymptotics,
}

/// Makings of chains of boxes, any of which is sound: from fine cells to those that leave space for intervals of parameters.
const MAKINGS: [Making; 4] = [
    Making { longest: 0.003, margin: 1.08, pad: 5e-6, shortest: 1e-9, ahead: 4 },
    Making { longest: 0.005, margin: 1.08, pad: 2e-5, shortest: 1e-8, ahead: 4 },
    Making { longest: 0.01, margin: 1.08, pad: 2e-5, shortest: 1e-6, ahead: 4 },
    Making { longest: 0.01, margin: 1.15, pad: 2e-5, shortest: 1e-6, ahead: 4 },
];
/// H-sets are tried with this one.
const TRIAL: Making = Making { longest: 0.006, margin: 1.08, pad: 5e-6, shortest: 1e-7, ahead: 4 };
/// The making for slow expansion, where none of these leads to any entropy so far.
const SLOW: Making = Making { longest: 0.001, margin: 1.08, pad: 5e-6, shortest: 1e-9, ahead: 4 };
/// Finer makings, where this one leads to none either: for slow expansion along thin leaves. H-sets from everywhere are tried with the last.
const FINE: [Making; 2] = [
    Making { longest: 0.0006, margin: 1.08, pad: 6e-7, shortest: 1e-9, ahead: 12 },
    Making { longest: 0.0003, margin: 1.08, pad: 3e-7, shortest: 1e-9, ahead: 12 },
];
/// The depth up to which all makings are tried, and the part of the best entropy that is enough for the first one that is followed deeper.
const SHALLOW: usize = 8;
const NEARLY: f64 = 0.95;
/// The depth at which a quick proof ends, and the number of boxes at which it does.
const QUICK: (usize, u64) = (12, 12_000);

impl Chaos {
    /// Returns the words of at most N impacts.
    ///
    /// `watch` receives the depth and the number of boxes, and may stop it; results proved so far
    /// are kept. If no h-sets are given and the floating-point orbit is regular, there are no words.
    ///
    /// # Errors
    /// If the pair has several harmonics, h-sets overlap each other or their own translates or are not convex, or a value is beyond the
    /// range of flights.
    pub fn of(
        pair: &ImpactPair,
        start: &Start,
        question: &HorseshoeSettings,
        watch: &dyn Watch,
    ) -> Result<Self, Error> {
        let watch = &Latched::new(watch);
        let law = Law::of(pair)?;
        let guess = Guess::new(&law);
        let orbit = visited(pair, start, IMPACTS)?.last().and_then(|last| seen(&guess, last.middle()));
        let searching = |_: Stage<'_>| watch.proceed(Stage::Horseshoe { depth: 0, boxes: 0 });
        let depth = question.depth.unwrap_or(MOST_DEPTH as usize); // proposes: how deep h-sets are judged
        let found = |seen: &Seen, effort| bases(seen, &law, depth, effort, &searching);
        let bases = match &orbit {
            _ if !question.bases.is_empty() => question.bases.clone(),
            Some(orbit) if orbit.is_chaotic() => found(orbit, THOROUGH),
            Some(orbit) => found(&orbit.transients(&guess), ANY),
            None => Vec::new(),
        };
        if let Some(problem) = problem(&bases) {
            return Err(Error::out_of_range(None, problem.to_owned()));
        }
        let proved = Self::proved(&law, bases, question.depth, watch);
        let horseshoe = if proved.entropy() > 0.0 { proved.bases() } else { &[] }; // exact: none is claimed where it is 0
        let asymptotics = Asymptotics::of(pair, start, horseshoe, &Silent(watch))?;
        let exponent = orbit.as_ref().map(|orbit| orbit.exponent);
        let attractor = orbit.map_or_else(Vec::new, Seen::states);
        // The search for h-sets and what becomes of the scene's own orbit may be stopped as well.
        Ok(Self { exponent, attractor, asymptotics, is_interrupted: watch.is_stopped(), ..proved })
    }

    /// Returns the words and bounds of the entropy that these h-sets lead to.
    pub(super) fn proved(law: &Law, bases: Vec<Base>, depth: Option<usize>, watch: &dyn Watch) -> Self {
        let (deepest, most) = depth.map_or((MOST_DEPTH as usize, BOXES), |depth| (depth, u64::MAX)); // proposes: how deep
        let deepest = if bases.is_empty() { 0 } else { deepest }; // exact: counts
        let tried = |makings: &[Making], depth: usize| -> Vec<Tried<'_>> {
            makings.iter().map(|&making| Tried::new(law, &bases, making).deepened((depth, most), watch)).collect()
        };
        let shallow = deepest.min(SHALLOW); // exact: counts
        let first = good(tried(&MAKINGS, shallow), shallow < deepest);
        let is_slow = first.entropy() == 0.0 && !first.is_stopped && shallow < deepest; // proposes: which one to follow deeper
        let first =
            if is_slow { tried(&[SLOW], deepest).swap_remove(0) } else { first.deepened((deepest, most), watch) };
        let is_open = first.entropy() == 0.0 && !first.is_stopped && deepest > 0; // proposes: whether to try more
        let finer = if is_open { tried(&FINE, deepest) } else { Vec::new() };
        let finest = finer.into_iter().max_by(|a, b| a.entropy().total_cmp(&b.entropy())); // proposes: each is a proof of its own
        let Tried { search, depth, is_stopped: is_interrupted } = finest.unwrap_or(first); // exact: none was tried
        let entropy = entropies(&search);
        let (tubes, boxes) = (search.shown.clone(), search.tally.boxes);
        let words = search.words.iter().map(Word::of).collect();
        let (exponent, attractor, asymptotics) = (None, Vec::new(), Asymptotics::default());
        Self { bases, words, depth, boxes, is_interrupted, entropy, exponent, attractor, tubes, asymptotics }
    }

    /// Returns the same of a scene.
    ///
    /// # Errors
    /// As [`Chaos::of`].
    pub fn of_scene(scene: &Scene, question: &HorseshoeSettings, watch: &dyn Watch) -> Result<Self, Error> {
        Self::of(scene.pair(), scene.start(), question, watch)
    }

    /// Returns the h-sets, each disjoint from the others.
    pub fn bases(&self) -> &[Base] {
        &self.bases
    }

    /// Returns all words that are proved.
    pub fn words(&self) -> &[Word] {
        &self.words
    }

    /// Returns the number of impacts up to which all words were searched for.
    pub fn depth(&self) -> usize {
        self.depth
    }

    /// Returns the number of boxes mapped.
    pub fn boxes(&self) -> u64 {
        self.boxes
    }

    /// Returns whether it was stopped before the depth that was requested.
    pub fn is_interrupted(&self) -> bool {
        self.is_interrupted
    }

    /// Returns a lower bound of the topological entropy per impact; 0 if none is proved.
    pub fn entropy(&self) -> f64 {
        self.entropy[0]
    }

    /// Returns a lower bound of the topological entropy per forcing period; 0 if none is proved.
    pub fn entropy_a_cycle(&self) -> f64 {
        self.entropy[1]
    }

    /// Returns the Lyapunov exponent per impact of the floating-point orbit: non-rigorous.
    pub fn exponent(&self) -> Option<f64> {
        self.exponent
    }

    /// Returns the floating-point orbit.
    pub fn attractor(&self) -> &[State] {
        &self.attractor
    }

    /// Returns the middles of the first chains of boxes.
    pub fn tubes(&self) -> &[Vec<State>] {
        &self.tubes
    }

    /// Returns the two blocks with the fewest impacts that can follow one another in any order in the reduced map. A block is a sequence
    /// of walls and a number of half forcing periods, written as starting on the left wall, and mirrored where it starts on the right one.
    pub fn horseshoe(&self) -> Option<[&Word; 2]> {
        horseshoe(&self.words, self.bases.len())
    }

    /// Returns the result for the scene's own orbit: whether it visits the horseshoe.
    pub fn asymptotics(&self) -> &Asymptotics {
        &self.asymptotics
    }
}

/// A horseshoe in the impact map of each pair of a law.
#[derive(Clone, Debug, PartialEq)]
pub struct Horseshoe {
    /// Lower bounds of the topological entropy per impact, and per forcing period.
    pub entropy: [f64; 2],
    /// The h-sets that it was proved with.
    pub bases: Vec<Base>,
}

impl Horseshoe {
    /// Returns the horseshoe of words of at most N impacts between h-sets; `None` where none is proved. Lemmas D9-D11
    pub(super) fn of(law: &Law, bases: Vec<Base>, depth: usize, watch: &dyn Watch) -> Option<Self> {
        if bases.is_empty() || problem(&bases).is_some() {
            return None; // exact: not proved
        }
        let chaos = Chaos::proved(law, bases, Some(depth), watch);
        // exact: none is proved where it is 0
        (chaos.entropy() > 0.0).then_some(Self { entropy: chaos.entropy, bases: chaos.bases })
    }

    /// Returns the same if few boxes lead to one. Lemmas D9-D11
    pub(super) fn quick(law: &Law, bases: Vec<Base>, depth: usize, watch: &dyn Watch) -> Option<Self> {
        if bases.is_empty() || problem(&bases).is_some() {
            return None; // exact: not proved
        }
        let most = (depth.min(QUICK.0), QUICK.1); // proposes: how far to look
        let tried = |&making: &Making| {
            let tried = Tried::new(law, &bases, making).deepened(most, watch);
            let found = entropies(&tried.search);
            (found[0] > 0.0).then_some(found) // exact: none is proved where it is 0
        };
        let entropy = MAKINGS.iter().rev().find_map(tried)?;
        Some(Self { entropy, bases })
    }
}

/// H-sets for the most entropy that is found with this effort.
pub(super) fn bases(seen: &Seen, law: &Law, depth: usize, effort: Effort, watch: &dyn Watch) -> Vec<Base> {
    seen.bases(law, ([TRIAL, FINE[1]], depth), effort, watch)
}

/// A search, how deep it went, and whether it was stopped before.
struct Tried<'s> {
    search: Search<'s>,
    depth: usize,
    is_stopped: bool,
}

impl<'s> Tried<'s> {
    fn new(law: &'s Law, bases: &'s [Base], making: Making) -> Self {
        Self { search: Search::new(law, bases, making), depth: 0, is_stopped: false }
    }

    /// The same to a depth, no deeper than a number of boxes leads to.
    fn deepened(mut self, (to, most): (usize, u64), watch: &dyn Watch) -> Self {
        while !self.is_stopped && self.depth < to && self.search.tally.boxes < most {
            self.is_stopped = !self.search.deepen(watch);
            self.depth += usize::from(!self.is_stopped); // exact: a count
        }
        self
    }

    /// Returns a lower bound of the entropy of its words, per impact.
    fn entropy(&self) -> f64 {
        by_impact(&self.search)
    }

    /// Returns the lengths of the two blocks of the shortest horseshoe, in impacts, the longer one first; the greatest number if there is none.
    fn shortest(&self) -> [usize; 2] {
        let words: Vec<Word> = self.search.words.iter().map(Word::of).collect();
        horseshoe(&words, self.search.bases.len()).map_or([usize::MAX; 2], |[a, b]| [b, a].map(|word| word.walls.len()))
    }
}

/// Returns, of those that lead to the most entropy, the one with the shortest horseshoe; if it is to be followed deeper, the first one
/// that leads to nearly as much: the finest cells lead furthest.
fn good(tried: Vec<Tried<'_>>, deeper: bool) -> Tried<'_> {
    let best = tried.iter().fold(0.0, |best: f64, one| best.max(one.entropy())); // proposes: each is a proof of its own
    let enough = if deeper { NEARLY * best } else { best };
    let mut good = tried.into_iter().filter(|one| one.entropy() >= enough);
    let chosen = if deeper { good.next() } else { good.min_by_key(Tried::shortest) };
    chosen.expect("the best")
}

/// Returns lower bounds of the entropy of the words, per impact and per forcing period.
fn entropies(search: &Search<'_>) -> [f64; 2] {
    [by_impact(search), 2.0 * entropy(&search.words, search.bases.len(), |path| path.half_turns)]
}

fn by_impact(search: &Search<'_>) -> f64 {
    entropy(&search.words, search.bases.len(), |path| path.sides.len() as i64) // exact: a length
}

/// Returns the fault of h-sets, in words, or `None` if they are sound. Lemma D9
pub(super) fn problem(bases: &[Base]) -> Option<&'static str> {
    if !bases.iter().all(Base::is_convex) {
        return Some("the h-sets are not all convex quadrilaterals with their tops on the left from left to right");
    }
    let apart = bases.iter().enumerate().all(|(k, base)| bases[..k].iter().all(|other| base.is_apart(other)));
    if !bases.iter().all(Base::is_apart_from_its_translates) {
        return Some(
            "an h-set overlaps its own translate by a forcing period: phases modulo 2 pi are not unique in it",
        );
    }
    let near = bases.iter().all(Base::is_near);
    (!(apart && near))
        .then_some("the h-sets overlap, or lie beyond phases from -1 to 2, or have speeds that are not positive")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chaos::quad::Chord;
    use crate::number::{Ball, Number};
    use crate::watch::Unwatched;

    /// `D = 1/10`, `e = 4/5`.
    fn figure_16() -> Law {
        let quotient = |a: f64, b: f64| Ball::exact(a).checked_div(Ball::exact(b)).expect("not 0");
        Law { gap: quotient(1.0, 10.0), restitution: quotient(4.0, 5.0) }
    }

    /// Two h-sets that the search finds for figure 16.
    fn bases() -> [Base; 2] {
        let base =
            |[a, b, c, d]: [State; 4]| Base { left: Chord { bottom: a, top: b }, right: Chord { bottom: c, top: d } };
        [
            [[0.852141, 0.163451], [0.851903, 0.163962], [0.876103, 0.165998], [0.875865, 0.166509]],
            [[0.850561, 0.166845], [0.849622, 0.168861], [0.874860, 0.168667], [0.873921, 0.170684]],
        ]
        .map(base)
    }

    /// The stretch of the h-set where it begins is 8e-4 of it long, beside a graze at the fourth impact: it was in the cells that each impact
    /// costs at the ends of a chain of boxes.
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
    fn a_search_ends_at_the_depth_that_so_many_boxes_lead_to() {
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
