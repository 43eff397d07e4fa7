//! The set of the words is uniformly hyperbolic: exponents of all its invariant measures, and its dimension. Lemmas D24-D28 of
//! `docs/proofs/hyperbolic.md#D24`.
//!
//! Floating point proposes the strips ([`propose`]); intervals prove what they are mapped to ([`strip`], [`cones`]), and bound how much strings
//! of words expand ([`strings`]) and what follows ([`root`]).

mod cones;
mod left_out;
mod propose;
mod root;
mod sides;
mod strings;
mod strip;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};

use super::blocks::Word;
use super::frame::Frame;
use super::guess::Guess;
use super::horseshoe::Chaos;
use super::law::Law;
use super::words::HSet;
use crate::Error;
use crate::number::{Ball, logarithm};
use crate::pair::ImpactPair;
use crate::threads::each;
use crate::watch::{Stage, Watch};
use cones::Proved;
pub use left_out::{LeftOut, why_left_out};
use root::{Edge, ratios, root};
use strings::{EMPTY_BOUNDS, Strings, ends, hull, spanned};
use strip::{Branch, Map, StraightStrip};

/// The greatest slope of the cones, in the coordinates of an h-set.
const KAPPA: f64 = 64.0;

/// A cone of directions at the image of a cell of a word's strip.
///
/// **Enclosure**: the expanding direction at the image of each state of the set in the cell has a slope between these. Lemmas D26, D28
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// The word, by its place among those of the horseshoe.
    pub word: usize,
    /// The image of the cell's middle, about, in the coordinates of the h-set that is covered: from -1 to 1 along it and across.
    pub place: [f64; 2],
    /// Bounds of the slopes, in these coordinates.
    pub slopes: [f64; 2],
}

/// A uniformly hyperbolic set of motions of a horseshoe: those of some of its words.
///
/// **Enclosure**: the set is uniformly hyperbolic on a compact invariant set of the impact map. For each bi-infinite sequence of words that fit
/// together there is exactly one motion. The bounds hold the set's entropy, the exponents of all its invariant measures and its Hausdorff
/// dimension. Lemmas D24-D28
#[derive(Clone, Debug, PartialEq)]
pub struct Hyperbolic {
    /// The greatest slope of the cones, in the coordinates of an h-set, from -1 to 1 along and across it.
    pub kappa: f64,
    /// Number of cells.
    pub cells: usize,
    /// Cones of all expanding directions, of the cells whose image meets the h-set.
    pub cones: Vec<Cone>,
    /// Words of the set, by their places among those of the horseshoe.
    pub words: Vec<usize>,
    /// Strips of the words, in order: left and right side, each by its places at the bottom and at the top of its h-set, from -1 to 1.
    pub strips: Vec<[[f64; 2]; 2]>,
    /// What it is proved with.
    pub(super) proof: Proof,
    /// The other words of the horseshoe, and the reasons why they are left out.
    pub left_out: Vec<(usize, LeftOut)>,
    /// Bounds of the topological entropy, per impact and per forcing period.
    pub entropy: [[f64; 2]; 2],
    /// Bounds of the greater exponent of every invariant measure, likewise.
    pub exponents: [[f64; 2]; 2],
    /// Bounds of the smaller exponent per impact.
    pub second: [f64; 2],
    /// Bounds of the Hausdorff dimension.
    pub dimension: [f64; 2],
}

/// What a hyperbolic set is proved with: for `check`, which proves it again.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Proof {
    /// The words of the set, in order.
    pub words: Vec<WordProof>,
    /// Number of words of the strings that are bounded: of all words, and of those that count for the lower bound of the dimension.
    pub letters: [usize; 2],
    /// Parts of the bounds of the dimension that are along the expanding direction.
    pub unstable: [f64; 2],
}

/// What a word of the set is proved with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct WordProof {
    pub strip: StraightStrip,
    /// Whether `xi` grows along the image.
    pub rises: bool,
    /// Whether the word counts for the lower bound of the dimension: it is alone, and other such words lead to it and back. Lemma D28
    pub counts: bool,
}

/// A hyperbolic set, or the words that are left out, with the reasons, where none is proved.
pub type HyperbolicSet = Result<Hyperbolic, Vec<(usize, LeftOut)>>;

impl Hyperbolic {
    /// Hyperbolic set of those words that are proved to expand and that lead back to each other, or the reasons why there is none.
    /// `watch` receives the number of cells.
    ///
    /// # Errors
    /// If the pair has several harmonics, or a value is beyond the range of flights.
    pub fn of(pair: &ImpactPair, chaos: &Chaos, watch: &dyn Watch) -> Result<HyperbolicSet, Error> {
        Ok(Self::proved(&Law::of(pair)?, chaos.bases(), chaos.words(), watch))
    }

    fn proved(law: &Law, bases: &[HSet], words: &[Word], watch: &dyn Watch) -> HyperbolicSet {
        let frames: Vec<Frame> = bases.iter().map(Frame::of).collect();
        let mut left_out: BTreeMap<usize, LeftOut> =
            (0..words.len()).map(|number| (number, LeftOut::Overlap)).collect();
        if !are_apart(&frames) {
            return Err(left_out.into_iter().collect());
        }
        left_out.values_mut().for_each(|why| *why = LeftOut::Strip);
        let guess = Guess::new(law);
        let map = Map { law, guess: &guess, frames: &frames };
        let cells = AtomicU64::new(0);
        let watch = |_: Stage<'_>| watch.proceed(Stage::Cones(cells.fetch_add(1, Ordering::Relaxed)));
        let mut strips: Vec<(usize, Branch)> = Vec::new();
        for (number, branch) in propose::branches(&guess, &frames, words) {
            if fits(&branch, &strips) {
                strips.push((number, branch));
            }
        }
        let all = expanding(&map, &strips, &watch, &mut left_out);
        let all = recurrent(all, frames.len());
        all.iter().for_each(|word| _ = left_out.insert(word.number, LeftOut::Strings));
        let measured = Measured::of(&map, &all, &watch).zip(logarithm(law.restitution));
        let Some((measured, log)) = measured else { return Err(left_out.into_iter().collect()) };
        left_out.retain(|_, why| *why != LeftOut::Strings);
        let heights = heights(&all, frames.len());
        let alone: Vec<bool> = each(&all, &|word: &Proved| map.is_alone(word, &all, &heights, &watch));
        let own = all.iter().zip(&alone).filter(|(_, alone)| **alone).map(|(word, _)| word.clone()).collect();
        let own = recurrent(own, frames.len());
        // D28: where words may be seen in two ways, the sum bounds it from above only
        let inner = if own.len() == all.len() {
            Some(measured.strings)
        } else {
            Measured::of(&map, &own, &watch).map(|own| own.strings)
        };
        let word = |word: &Proved| WordProof {
            strip: word.branch.strip,
            rises: word.branch.rises,
            counts: own.iter().any(|own| own.number == word.number),
        };
        let proof = Proof {
            words: all.iter().map(word).collect(),
            letters: [measured.strings.letters, inner.map_or(1, |inner| inner.letters)],
            unstable: [inner.map_or(0.0, |inner| inner.dimensions[0][0]), measured.strings.dimensions[0][1]],
        };
        let twice = Ball::exact(2.0) * log;
        let [low, high] = measured.exponents[0].map(|x| ends(twice - Ball::exact(x)));
        Ok(Self {
            kappa: KAPPA,
            cells: all.iter().map(|word| word.images.len()).sum(),
            cones: all.iter().flat_map(|word| word.cones(measured.slopes_at(word.branch.from, &all))).collect(),
            words: all.iter().map(|word| word.number).collect(),
            strips: all.iter().map(|word| word.branch.strip.ends()).collect(),
            proof,
            left_out: left_out.into_iter().collect(),
            entropy: measured.entropy,
            exponents: measured.exponents,
            second: [high[0], low[1]],
            dimension: [inner.map_or(0.0, |inner| inner.dimension()[0]), measured.strings.dimension()[1]],
        })
    }
}

/// Strings of words, by the number of their words, and bounds of the dimension along the expanding direction, and along the contracting one.
/// Lemma D28
#[derive(Clone, Copy, Debug)]
struct StringBounds {
    letters: usize,
    dimensions: [[f64; 2]; 2],
}

impl StringBounds {
    /// Bounds of the sum of both dimensions.
    fn dimension(&self) -> [f64; 2] {
        let [[low, high], [least, most]] = self.dimensions;
        [(low + least).next_down(), (high + most).next_up()]
    }
}

/// The words whose strips are proved to expand; of the others it is noted why they do not.
fn expanding(
    map: &Map<'_>,
    strips: &[(usize, Branch)],
    watch: &dyn Watch,
    left_out: &mut BTreeMap<usize, LeftOut>,
) -> Vec<Proved> {
    let prove = |(_, branch): &(usize, Branch)| map.prove(branch, KAPPA, watch);
    let mut all = Vec::new();
    for ((number, branch), found) in strips.iter().zip(each(strips, &prove)) {
        let why = match found {
            Ok(images) => {
                all.push(Proved { number: *number, branch: branch.clone(), images });
                LeftOut::Return
            }
            Err(why) => why,
        };
        left_out.insert(*number, why);
    }
    all
}

/// Whether the parallelograms hold states of positive speed only, and have none in common, modulo whole forcing periods. Lemma D25
fn are_apart(frames: &[Frame]) -> bool {
    let apart = |k: usize| frames[..k].iter().all(|other| frames[k].is_apart(other));
    let is_sound = |frame: &Frame| frame.is_proper() && frame.is_near() && frame.is_apart_from_its_translates();
    (0..frames.len()).all(|k| is_sound(&frames[k]) && apart(k))
}

/// Whether a strip is in its h-set, apart from the strips that are there, and its flights take some time. Lemma D25
fn fits(branch: &Branch, strips: &[(usize, Branch)]) -> bool {
    let mut others = strips.iter().map(|(_, other)| other).filter(|other| other.from == branch.from);
    branch.half_turns > 0 && branch.strip.is_inside() && others.all(|other| branch.strip.is_apart(&other.strip))
}

/// The words between h-sets that lead back to each other: of several such parts one with most words. Lemma D27
fn recurrent(words: Vec<Proved>, bases: usize) -> Vec<Proved> {
    let mut leads = vec![vec![false; bases]; bases];
    words.iter().for_each(|word| leads[word.branch.from][word.branch.to] = true);
    for by in 0..bases {
        for from in 0..bases {
            for to in 0..bases {
                leads[from][to] |= leads[from][by] && leads[by][to];
            }
        }
    }
    let is_in = |at: usize, word: &Proved| {
        [word.branch.from, word.branch.to].iter().all(|&other| leads[at][other] && leads[other][at])
    };
    let best = (0..bases).max_by_key(|&at| words.iter().filter(|word| is_in(at, word)).count());
    words.into_iter().filter(|word| best.is_some_and(|at| is_in(at, word))).collect()
}

/// Holds the heights of all images in each h-set. Lemma D25
fn heights(words: &[Proved], bases: usize) -> Vec<Ball> {
    let images = |at: usize| words.iter().filter(move |word| word.branch.to == at).flat_map(|word| &word.images);
    let of = |at: usize| {
        let inside = images(at).filter(|image| !image.is_outside()).map(|image| ends(image.spread(1)));
        spanned(inside.fold(EMPTY_BOUNDS, hull))
    };
    (0..bases).map(of).collect()
}

/// The bounds that follow from the strings of words.
struct Measured {
    entropy: [[f64; 2]; 2],
    exponents: [[f64; 2]; 2],
    strings: StringBounds,
    /// Bounds of the slopes of the expanding directions where each word leads to.
    slopes: Vec<[f64; 2]>,
}

impl Measured {
    /// Bounds of the slopes of the expanding directions in an h-set. Lemma D26
    fn slopes_at(&self, base: usize, words: &[Proved]) -> [f64; 2] {
        let into = words.iter().zip(&self.slopes).filter(|(word, _)| word.branch.to == base);
        into.map(|(_, slopes)| *slopes).fold(EMPTY_BOUNDS, hull)
    }

    /// `None` where there are no words, or their strings expand too little to be bounded.
    fn of(map: &Map<'_>, words: &[Proved], watch: &dyn Watch) -> Option<Self> {
        if words.is_empty() {
            return None; // exact: nothing is certified
        }
        let half_cycles = |word: usize| words[word].branch.half_turns as f64; // exact: a small integer
        let (graph, slopes, letters) = Strings { map, words, kappa: KAPPA, watch }.graph()?;
        let by_impacts: Vec<Edge> = graph.iter().map(|(edge, _)| *edge).collect();
        // exact: halves
        let by_cycles: Vec<Edge> =
            graph.iter().map(|(edge, word)| Edge { length: 0.5 * half_cycles(*word), ..*edge }).collect();
        let twice = Ball::exact(2.0) * logarithm(map.law.restitution)?;
        // Lemma D28: what contracts takes up what is left of the area
        let contracting = |edge: &Edge| {
            let area = twice * Ball::exact(edge.length);
            let [least, most] = edge.weight.map(|x| ends(Ball::exact(x) - area));
            Edge { weight: [least[0], most[1]], ..*edge }
        };
        let stable: Vec<Edge> = by_impacts.iter().map(contracting).collect();
        let dimensions = [root(&by_impacts)?, root(&stable)?];
        let between = |length: &dyn Fn(usize) -> f64| -> Vec<Edge> {
            let edge = |word: usize| {
                let Branch { from, to, .. } = words[word].branch;
                Edge { from, to, weight: [length(word); 2], length: length(word) }
            };
            (0..words.len()).map(edge).collect()
        };
        let impacts = root(&between(&|word| words[word].branch.sides.len() as f64))?; // exact: a length
        let halves = root(&between(&half_cycles))?;
        Some(Self {
            // exact: doubled
            entropy: [impacts, halves.map(|x| 2.0 * x)],
            exponents: [ratios(&by_impacts), ratios(&by_cycles)],
            strings: StringBounds { letters, dimensions },
            slopes,
        })
    }
}
