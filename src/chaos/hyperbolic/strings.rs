//! Expansion of strings of words: bounds of its logarithm over the points that follow them. Lemma D28 of `docs/proofs/hyperbolic.md#D28`.

use std::collections::{BTreeMap, HashMap};

use super::Cone;
use super::cones::Proved;
use super::root::Edge;
use super::strip::{Branch, Cell, Image, Map, StraightStrip, beside};
use crate::chaos::flights::is_positive;
use crate::number::{Ball, Number, logarithm, up};
use crate::watch::Watch;

/// Words by their places among those that are proved.
type Letters = Vec<usize>;

/// The cells of a word in which the points of a string are, bounds of their `a`, and of the heights of their images. The string is the
/// word alone, or with one before it and some behind it.
#[derive(Clone, Debug)]
struct Cylinder {
    images: Vec<Image>,
    breadth: [f64; 2],
    heights: [f64; 2],
}

/// Edges, each with its word.
pub(crate) type Graph = Vec<(Edge, usize)>;

/// Cylinders by their strings.
type Level = BTreeMap<Letters, Cylinder>;

/// Number of times that cells are narrowed and looked at again.
const MAX_CUTS: u32 = 3;
/// Part of its size to which a cell has to be narrowed to be looked at again.
const RECUT_RATIO: f64 = 0.7;
/// The most strings, cells of all of them, and letters that are looked at.
const MOST_EDGES: usize = 8000;
const MOST_CELLS: usize = 3 << 20;
const MOST_LETTERS: usize = 9;

/// Bounds of no numbers.
pub(crate) const EMPTY_BOUNDS: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

// D28: the outer ends; an end that is no number stays none, and bounds nothing
pub(crate) fn hull([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [if c < a || c.is_nan() { c } else { a }, if d > b || d.is_nan() { d } else { b }]
}

/// Bounds, if their ends are numbers.
fn numbers(bounds: [f64; 2]) -> Option<[f64; 2]> {
    (!bounds.iter().any(|end| end.is_nan())).then_some(bounds)
}

pub(crate) fn ends(x: Ball) -> [f64; 2] {
    [(x.mid() - x.rad()).next_down(), (x.mid() + x.rad()).next_up()]
}

/// Holds all numbers between two.
pub(crate) fn spanned([low, high]: [f64; 2]) -> Ball {
    let middle = 0.5 * (low + high);
    let [below, above] = [low, high].map(|end| (Ball::exact(end) - Ball::exact(middle)).mag());
    Ball::exact(middle).widened(below.max(above)) // D28: the farther end
}

/// Bounds of the slopes of the images of the vectors `(1, slope)` at the states of cells, of which `X` has the sign of the word. Lemma D26
fn image_slopes(images: &[Image], slopes: [f64; 2], rises: bool) -> Option<[f64; 2]> {
    let mut all = EMPTY_BOUNDS;
    for image in images {
        for slope in slopes {
            let [x, y] = image.direction(slope)?;
            is_positive(signed(x, rises)).then_some(())?; // D28: not asked of a cell that is cut again before
            all = hull(all, ends(y.checked_div(x)?));
        }
    }
    numbers(all)
}

/// `X` with the sign with which `xi` grows along the word. Lemma D26
fn signed(x: Ball, rises: bool) -> Ball {
    x.signed(if rises { 1.0 } else { -1.0 })
}

/// Bounds of `ln |X|` for the vectors `(1, slope)` at the states of a cell.
fn expansion(image: &Image, slopes: [f64; 2], rises: bool) -> Option<[f64; 2]> {
    let of = |slope: f64| Some(ends(logarithm(signed(image.direction(slope)?[0], rises))?));
    numbers(hull(of(slopes[0])?, of(slopes[1])?))
}

impl Proved {
    /// Cones of the expanding directions at the images of the cells, given bounds of the slopes of those at the cells.
    pub fn cones(&self, given: [f64; 2]) -> impl Iterator<Item = Cone> {
        let of = move |image: &Image| {
            let slopes = image_slopes(&[*image], given, self.branch.rises)?;
            Some(Cone { word: self.number, place: image.middle.map(Ball::mid), slopes })
        };
        self.images.iter().filter(|image| !image.is_outside()).filter_map(of)
    }
}

/// The words, and the required properties of their strings.
pub(crate) struct Strings<'s> {
    pub map: &'s Map<'s>,
    pub words: &'s [Proved],
    pub kappa: f64,
    pub watch: &'s dyn Watch,
}

impl Strings<'_> {
    /// Part of a cell that holds all states mapped to the points of a strip with `a` between bounds; `None` if there are none.
    fn narrowed(&self, image: &Image, strip: &StraightStrip, breadth: [f64; 2]) -> Option<Cell> {
        let Image { cell, middle, sides, .. } = image;
        // About the line in the middle between both bounds.
        let line = 0.5 * (breadth[0] + breadth[1]);
        let [place, slope] = strip.line(Ball::exact(line));
        let half = strip.breadth(image.spread(1)) * (Ball::exact(breadth[1]) - Ball::exact(breadth[0]));
        let [along, across] = sides.both().map(|side| beside(side, slope));
        // The line is off by its rounding: all of the difference is more than half of it.
        let reach = up(0.5 * half.mag() + f64::EPSILON * strip.breadth(image.spread(1)).mag());
        let numerator = (place - beside(*middle, slope)).widened(up(reach + across.mag()));
        numerator.checked_div(along).map_or(Some(*cell), |within| cell.part(0, within))
    }

    /// Points of a word's cells, each cell narrowed by `narrowed`; cells without points are left out.
    fn cut(&self, word: usize, images: &[Image], narrowed: &dyn Fn(&Image) -> Option<Cell>) -> Cylinder {
        let mut kept = Vec::new();
        for image in images {
            let mut image = *image;
            let is_left = (0..MAX_CUTS).all(|_| {
                let Some(cell) = narrowed(&image) else { return false };
                if (0..2).any(|axis| cell.radii[axis] < RECUT_RATIO * image.cell.radii[axis])
                    && let Ok(better) = self.map.image(&self.words[word].branch, cell, &|_, _, _| true)
                {
                    image = better;
                }
                true
            });
            if is_left {
                kept.push(image);
            }
        }
        Cylinder::of(kept)
    }

    /// The bounds of the logarithm of the expansion of a word after another one.
    fn bounds(&self, slopes: [f64; 2], word: usize, images: &[Image]) -> Option<[f64; 2]> {
        let rises = self.words[word].branch.rises;
        if images.is_empty() {
            return None; // exact: nothing is certified
        }
        images.iter().try_fold(EMPTY_BOUNDS, |all, image| Some(hull(all, expansion(image, slopes, rises)?)))
    }

    /// Graph of strings: an edge for each word alone, or with a word before it and some after it. An edge weighs the logarithm of its
    /// word's expansion; its length is the word's impacts. Also the slopes of the expanding directions where each word leads to, and the
    /// number of words of a string.
    pub fn graph(&self) -> Option<(Graph, Vec<[f64; 2]>, usize)> {
        let inside = |word: &Proved| word.images.iter().filter(|image| !image.is_outside()).copied().collect();
        let alone = self.words.iter().enumerate().map(|(word, proved)| (vec![word], Cylinder::of(inside(proved))));
        let mut level: Level = alone.collect();
        let mut slopes = self.slopes(&level, &vec![[-self.kappa, self.kappa]; self.words.len()])?;
        let mut graph = self.edges(&level, &slopes)?;
        let mut letters = 1;
        while letters < MOST_LETTERS && self.watch.goes_on() && self.is_worth_it(&level) {
            level = if letters == 1 { self.pairs(&level) } else { self.longer(&level) };
            slopes = self.slopes(&level, &slopes)?;
            graph = self.edges(&level, &slopes)?;
            letters += 1;
        }
        Some((graph, slopes, letters))
    }

    /// Whether strings with another word before them are few enough; any answer is sound.
    fn is_worth_it(&self, level: &Level) -> bool {
        let [mut strings, mut cells] = [0, 0];
        for (string, cylinder) in level {
            let more = self.before(string[0]).count();
            strings += more;
            cells += more * cylinder.images.len();
        }
        strings <= MOST_EDGES && cells <= MOST_CELLS
    }

    /// The word of a string that its cells are of.
    fn word(string: &[usize]) -> usize {
        string[usize::from(string.len() > 1)]
    }

    /// Bounds of the slopes with which a string's word is begun: those that the one before it leads to, or any. Lemma D26
    fn arriving(&self, string: &[usize], slopes: &[[f64; 2]]) -> [f64; 2] {
        match string {
            &[word] => self.before(word).map(|before| slopes[before]).fold(EMPTY_BOUNDS, hull),
            _ => slopes[string[0]],
        }
    }

    /// The strings of two words: the cells of the second one at the heights of images of the first. Lemma D28
    fn pairs(&self, alone: &Level) -> Level {
        let mut level = Level::new();
        for (string, cylinder) in alone {
            let word = string[0];
            for before in self.before(word) {
                let heights = alone[&vec![before]].heights;
                level
                    .insert(vec![before, word], self.cut(word, &cylinder.images, &|image| image.cell.between(heights)));
            }
        }
        level
    }

    /// The strings with one more word before them. Lemma D28
    fn longer(&self, level: &Level) -> Level {
        let mut next = Level::new();
        for (string, Cylinder { breadth, .. }) in level {
            let strip = &self.words[string[1]].branch.strip;
            for first in self.before(string[0]) {
                let longer: Letters = std::iter::once(first).chain(string.iter().copied()).collect();
                let own = &longer[..string.len()];
                let behind = |before: usize| -> Letters {
                    std::iter::once(before).chain(own[..own.len() - 1].iter().copied()).collect()
                };
                let heights = self.before(first).map(|before| level[&behind(before)].heights).fold(EMPTY_BOUNDS, hull);
                let narrowed = |image: &Image| self.narrowed(image, strip, *breadth)?.between(heights);
                let cylinder = self.cut(string[0], &level[own].images, &narrowed);
                next.insert(longer, cylinder);
            }
        }
        next
    }

    /// The slopes of the images, narrowed by those that words arrive with. Lemma D26
    fn slopes(&self, level: &Level, known: &[[f64; 2]]) -> Option<Vec<[f64; 2]>> {
        let mut slopes = known.to_vec();
        for _ in 0..MAX_CUTS {
            let mut all = vec![EMPTY_BOUNDS; self.words.len()];
            for (string, cylinder) in level {
                let word = Self::word(string);
                let rises = self.words[word].branch.rises;
                all[word] = hull(all[word], image_slopes(&cylinder.images, self.arriving(string, &slopes), rises)?);
            }
            slopes = all;
        }
        Some(slopes)
    }

    fn before(&self, word: usize) -> impl Iterator<Item = usize> {
        let from = self.words[word].branch.from;
        (0..self.words.len()).filter(move |&before| self.words[before].branch.to == from)
    }

    fn edges(&self, level: &Level, slopes: &[[f64; 2]]) -> Option<Graph> {
        let mut nodes = HashMap::new();
        let mut node = |letters: &[usize]| {
            let next = nodes.len();
            *nodes.entry(letters.to_vec()).or_insert(next)
        };
        let edge = |(string, cylinder): (&Letters, &Cylinder)| {
            let word = Self::word(string);
            let Branch { from, to, ref sides, .. } = self.words[word].branch;
            let is_alone = string.len() == 1;
            let (from, to) = if is_alone {
                (node(&[from]), node(&[to]))
            } else {
                (node(&string[..string.len() - 1]), node(&string[1..]))
            };
            let length = sides.len() as f64; // exact: a length
            let weight = self.bounds(self.arriving(string, slopes), word, &cylinder.images)?;
            Some((Edge { from, to, weight, length }, word))
        };
        level.iter().map(edge).collect()
    }
}

impl Cylinder {
    fn of(images: Vec<Image>) -> Self {
        let breadth = |image: &Image| {
            let [a, r] = [image.cell.at[0], image.cell.radii[0]].map(Ball::exact);
            hull(ends(a - r), ends(a + r))
        };
        Self {
            breadth: images.iter().map(breadth).fold(EMPTY_BOUNDS, hull),
            heights: images.iter().map(|image| ends(image.spread(1))).fold(EMPTY_BOUNDS, hull),
            images,
        }
    }
}

impl Cell {
    /// States of the cell at some heights; `None` if there are none. Lemma D28
    fn between(self, heights: [f64; 2]) -> Option<Self> {
        let within = (spanned(heights) - Ball::exact(self.at[1])).checked_div(Ball::exact(self.radii[1]));
        within.map_or(Some(self), |within| self.part(1, within))
    }

    /// States at a given range of radii from the middle along an axis; `None` if there are none. Lemma D28
    fn part(mut self, axis: usize, within: Ball) -> Option<Self> {
        let [low, high] = ends(within);
        let (low, high) = (low.max(-1.0), high.min(1.0)); // D28: what is in both
        if low > high {
            return None;
        }
        let is_part = high - low < 2.0; // D28: not if it is NaN
        if is_part {
            let (at, radius) = (self.at[axis], self.radii[axis]);
            self.at[axis] = at + radius * 0.5 * (low + high);
            let reach = Ball::exact(0.5 * (high - low)) * Ball::exact(radius);
            // D28: the middle is off by its rounding
            self.radii[axis] = up(reach.mag() + 4.0 * f64::EPSILON * (at.abs() + radius));
        }
        Some(self)
    }
}
