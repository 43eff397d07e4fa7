//! Horseshoes of a scene: [`Chaos`].

use super::asymptotics::Asymptotics;
use super::blocks::{Word, horseshoe};
use super::guess::Guess;
use super::law::Law;
use super::quad::State;
use super::scene::{ORBIT_IMPACTS, visited};
use super::seen::{AttractorOrbit, seen};
use super::strips::Strip;
use super::trials::{ANY, Rounds, THOROUGH};
use super::tried::{BOXES, FINE, MAKINGS, MOST_DEPTH, TRIAL, Tried, deepest, entropies};
use super::words::HSet;
use crate::orbit::Start;
use crate::pair::ImpactPair;
use crate::watch::{Latched, Silent, Stage, Watch};
use crate::{Effort, Error, Scene};

/// Settings of a search for horseshoes.
#[derive(Clone, Debug, Default)]
pub struct HorseshoeSettings {
    /// Maximum number of impacts of a word; `None`: as many as about a million boxes lead to, times the effort.
    pub depth: Option<usize>,
    /// A multiple of these boxes, without use if there is a depth.
    pub effort: Effort,
    /// H-sets; searched for if empty.
    pub bases: Vec<HSet>,
}

impl HorseshoeSettings {
    /// The most impacts of a word, and the number of boxes at which words become no longer.
    fn limits(&self) -> (usize, u64) {
        self.depth.map_or((MOST_DEPTH as usize, self.effort.times(BOXES)), |depth| (depth, u64::MAX)) // proposes: how deep
    }
}

/// Proved covering relations of a scene's impact map, as words: each sequence of words that fits together is the itinerary of a motion.
///
/// **Enclosure**: take any parameter of the pair, and any sequence of words of which each starts in the h-set that the word before covers. Then
/// there is a motion with exactly these impacts; a periodic sequence has a periodic motion. Motions of different sequences are different. The
/// topological entropy of the impact map on a compact invariant set without grazes is at least [`Chaos::entropy`]. Lemmas D9-D11, D34
/// **Cost**: about 10 microseconds per box; if no h-sets are given, some hundred thousand boxes to find them.
///
/// ```
/// use impact_pair::Scene;
/// use impact_pair::chaos::{HSet, Chaos, HorseshoeSettings};
/// use impact_pair::watch::Unwatched;
/// let scene = Scene::parse(r#"
///     excitation = { amplitude = 8, frequency = "pi", phase = 0 }
///     pair = { gap = 9.42497, restitution = 0.5 }
///     start = { time = 0, wall = "left", velocity = -12.56636 }
/// "#)?;
/// let bases = vec![
///     HSet::new([0.77843, 1.234518], [0.02877, 0.082], [-0.0002976, 0.002596]),
///     HSet::new([0.779603, 1.224294], [0.028826, 0.081513], [-0.0001488, 0.001298]),
///     HSet::new([0.780161, 1.219425], [0.028649, 0.083055], [-0.0001116, 0.000974]),
/// ];
/// let settings = HorseshoeSettings { depth: Some(3), bases, ..HorseshoeSettings::default() };
/// let chaos = Chaos::of(scene.pair(), scene.start(), &settings, &Unwatched)?;
/// // As many motions over n cycles as sequences of two letters.
/// assert!(chaos.entropy() >= 0.28119 && chaos.entropy_a_cycle() >= 0.69314);
/// assert_eq!(chaos.horseshoe().unwrap().map(|word| word.in_mappings()), ["P1 P2", "P1 P2 P4"]);
/// # Ok::<(), impact_pair::Error>(())
/// ```
#[derive(Debug)]
pub struct Chaos {
    bases: Vec<HSet>,
    words: Vec<Word>,
    strips: Vec<Strip>,
    depth: usize,
    boxes: u64,
    is_interrupted: bool,
    entropy: [f64; 2],
    exponent: Option<f64>,
    attractor: Vec<State>,
    tubes: Vec<Vec<State>>,
    asymptotics: Asymptotics,
}

/// The depth at which a quick proof ends, and the number of boxes at which it does.
const QUICK_LIMITS: (usize, u64) = (12, 12_000);

impl Chaos {
    /// Proves the words of at most `depth` impacts.
    ///
    /// `watch` receives the depth and the number of boxes, and may stop it; results proved so far
    /// are kept. If no h-sets are given and the floating-point orbit is regular, there are no words.
    ///
    /// # Errors
    /// If the pair has several harmonics, h-sets overlap each other or their own translates or are not convex, or a value is beyond the
    /// range of flights.
    pub fn of(pair: &ImpactPair, start: &Start, request: &HorseshoeSettings, watch: &dyn Watch) -> Result<Self, Error> {
        let watch = &Latched::new(watch);
        let law = Law::of(pair)?;
        let guess = Guess::new(&law);
        let orbit = visited(pair, start, ORBIT_IMPACTS)?.last().and_then(|last| seen(&guess, last.middle()));
        let searching = |_: Stage<'_>| watch.proceed(Stage::Horseshoe { depth: 0, boxes: 0 });
        let (depth, _) = request.limits(); // proposes: how deep h-sets are judged
        let found = |seen: &AttractorOrbit, rounds| bases(seen, &law, depth, rounds, &searching);
        let bases = match &orbit {
            _ if !request.bases.is_empty() => request.bases.clone(),
            Some(orbit) if orbit.is_chaotic() => found(orbit, THOROUGH),
            Some(orbit) => found(&orbit.transients(&guess), ANY),
            None => Vec::new(),
        };
        if let Some(problem) = problem(&bases) {
            return Err(Error::out_of_range(None, problem.to_owned()));
        }
        let proved = Self::proved(&law, bases, request.limits(), watch);
        let horseshoe = if proved.entropy() > 0.0 { proved.bases() } else { &[] }; // exact: none is claimed where it is 0
        let asymptotics = Asymptotics::of(pair, start, horseshoe, &Silent(watch))?;
        let exponent = orbit.as_ref().map(|orbit| orbit.exponent);
        let attractor = orbit.map_or_else(Vec::new, AttractorOrbit::states);
        // The search for h-sets and what becomes of the scene's own orbit may be stopped as well.
        Ok(Self { exponent, attractor, asymptotics, is_interrupted: watch.is_stopped(), ..proved })
    }

    /// Proves the words between these h-sets, each by a strip, and bounds of the entropy.
    pub(super) fn proved(law: &Law, bases: Vec<HSet>, limits: (usize, u64), watch: &dyn Watch) -> Self {
        let middle = law.middle();
        let Tried { mut search, depth, is_stopped: is_interrupted } = deepest(&middle, &bases, limits, watch);
        let strips = search.keep_witnessed(law, watch);
        let entropy = entropies(&search);
        let (tubes, boxes) = (search.shown.clone(), search.tally.boxes);
        let words = search.words.iter().map(Word::of).collect();
        let (exponent, attractor, asymptotics) = (None, Vec::new(), Asymptotics::default());
        Self { bases, words, strips, depth, boxes, is_interrupted, entropy, exponent, attractor, tubes, asymptotics }
    }

    /// Proves the words of a scene's pair, with the scene's start.
    ///
    /// # Errors
    /// As [`Chaos::of`].
    pub fn of_scene(scene: &Scene, request: &HorseshoeSettings, watch: &dyn Watch) -> Result<Self, Error> {
        Self::of(scene.pair(), scene.start(), request, watch)
    }

    /// The h-sets, each disjoint from the others.
    pub fn bases(&self) -> &[HSet] {
        &self.bases
    }

    /// All proved words.
    pub fn words(&self) -> &[Word] {
        &self.words
    }

    /// A strip for each word, in their order, by which it can be proved again.
    pub fn strips(&self) -> &[Strip] {
        &self.strips
    }

    /// Number of impacts up to which all words were searched for.
    pub fn depth(&self) -> usize {
        self.depth
    }

    /// Number of mapped boxes.
    pub fn boxes(&self) -> u64 {
        self.boxes
    }

    /// Whether the search was stopped before the requested depth.
    pub fn is_interrupted(&self) -> bool {
        self.is_interrupted
    }

    /// Lower bound of the topological entropy per impact; 0 if none is proved.
    pub fn entropy(&self) -> f64 {
        self.entropy[0]
    }

    /// Lower bound of the topological entropy per forcing period; 0 if none is proved.
    pub fn entropy_a_cycle(&self) -> f64 {
        self.entropy[1]
    }

    /// Lyapunov exponent per impact of the floating-point orbit: non-rigorous.
    pub fn exponent(&self) -> Option<f64> {
        self.exponent
    }

    /// States of the floating-point orbit.
    pub fn attractor(&self) -> &[State] {
        &self.attractor
    }

    /// Middles of the first cell chains.
    pub fn tubes(&self) -> &[Vec<State>] {
        &self.tubes
    }

    /// The two blocks with the fewest impacts that can follow one another in any order in the reduced map. A block is a sequence of walls and a
    /// number of half forcing periods. Each block is written as starting on the left wall; where it starts on the right wall, it is mirrored.
    pub fn horseshoe(&self) -> Option<[&Word; 2]> {
        horseshoe(&self.words, self.bases.len())
    }

    /// Limit of the orbit from the scene's start, as far as proved.
    pub fn asymptotics(&self) -> &Asymptotics {
        &self.asymptotics
    }
}

/// A horseshoe in the impact map of each pair of a law.
#[derive(Clone, Debug)]
pub struct Horseshoe {
    /// Lower bounds of the topological entropy per impact, and per forcing period.
    pub entropy: [f64; 2],
    /// The h-sets that it was proved with.
    pub bases: Vec<HSet>,
    /// Its words, and a strip for each of them.
    pub words: Vec<Word>,
    /// The strips, in the order of the words.
    pub strips: Vec<Strip>,
}

/// Two are equal if the same is proved, by whatever words.
impl PartialEq for Horseshoe {
    fn eq(&self, other: &Self) -> bool {
        self.entropy == other.entropy && self.bases == other.bases
    }
}

impl Horseshoe {
    /// Proves the horseshoe of words of at most `depth` impacts between h-sets; `None` where none is proved. Lemmas D9-D11, D34
    pub(super) fn of(law: &Law, bases: Vec<HSet>, depth: usize, watch: &dyn Watch) -> Option<Self> {
        if bases.is_empty() || problem(&bases).is_some() {
            return None; // exact: not proved
        }
        // exact: none is proved where it is 0
        let chaos = Chaos::proved(law, bases, (depth, u64::MAX), watch);
        let Chaos { entropy, bases, words, strips, .. } = chaos;
        (entropy[0] > 0.0).then_some(Self { entropy, bases, words, strips })
    }

    /// Proves a horseshoe as [`of`](Self::of) does, if few boxes are enough. Lemmas D9-D11, D34
    pub(super) fn quick(law: &Law, bases: Vec<HSet>, depth: usize, watch: &dyn Watch) -> Option<Self> {
        if bases.is_empty() || problem(&bases).is_some() {
            return None; // exact: not proved
        }
        let middle = law.middle();
        let most = (depth.min(QUICK_LIMITS.0), QUICK_LIMITS.1); // proposes: how far to look
        let tried = |&making: &_| {
            let mut search = Tried::new(&middle, &bases, making).deepened(most, watch).search;
            let strips = search.keep_witnessed(law, watch);
            let words = search.words.iter().map(Word::of).collect();
            let entropy = entropies(&search);
            (entropy[0] > 0.0).then(|| Self { entropy, bases: bases.clone(), words, strips }) // exact: none is proved where it is 0
        };
        MAKINGS.iter().rev().find_map(tried)
    }
}

/// Factors by which h-sets are made wider, as intervals of the parameters move images across.
const WIDTH_FACTORS: [f64; 5] = [1.0, 1.4, 2.0, 4.0, 8.0];

/// H-sets as wide as leads to most entropy for all parameters, or to some entropy, if any does.
fn widened(law: &Law, bases: Vec<HSet>, (depth, for_most): (usize, bool), watch: &dyn Watch) -> Vec<HSet> {
    let wider = |factor: &f64| bases.iter().map(|base| base.wider(*factor)).collect::<Vec<HSet>>();
    let tried = |wider: Vec<HSet>| Horseshoe::quick(law, wider, depth, watch);
    let found = WIDTH_FACTORS.iter().map(wider).filter_map(tried).take(if for_most { WIDTH_FACTORS.len() } else { 1 });
    // proposes: any h-sets will do
    found.max_by(|a, b| a.entropy[0].total_cmp(&b.entropy[0])).map_or(bases.clone(), |found| found.bases)
}

/// H-sets for the most entropy that is found in these rounds.
pub(super) fn bases(seen: &AttractorOrbit, law: &Law, depth: usize, rounds: Rounds, watch: &dyn Watch) -> Vec<HSet> {
    let found = seen.bases(&law.middle(), ([TRIAL, FINE[1]], depth), rounds, watch);
    if law.is_point() { found } else { widened(law, found, (depth, rounds.most > 1), watch) }
}

/// Fault of h-sets, in words, or `None` if they are sound. Lemma D9
pub(super) fn problem(bases: &[HSet]) -> Option<&'static str> {
    if !bases.iter().all(HSet::is_convex) {
        return Some("the h-sets are not all convex quadrilaterals with their tops on the left from left to right");
    }
    let apart = bases.iter().enumerate().all(|(k, base)| bases[..k].iter().all(|other| base.is_apart(other)));
    if !bases.iter().all(HSet::is_apart_from_its_translates) {
        return Some(
            "an h-set overlaps its own translate by a forcing period: phases modulo 2 pi are not unique in it",
        );
    }
    let near = bases.iter().all(HSet::is_near);
    (!(apart && near))
        .then_some("the h-sets overlap, or lie beyond phases from -1 to 2, or have speeds that are not positive")
}
