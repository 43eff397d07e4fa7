//! How much strings of words expand: bounds of the logarithms over the points that follow them. Lemma D28 of `docs/proofs.md`.

use std::collections::HashMap;

use super::cones::Proved;
use super::root::Edge;
use super::strip::{Cell, Image, Map, Strip, beside};
use crate::number::{Ball, Number, logarithm, up};
use crate::watch::Watch;

/// Words by their places among those that are proved.
type Letters = Vec<usize>;

/// Where the points of a strip lie that follow a string: cells, and bounds of `a`.
#[derive(Clone, Debug)]
struct Cylinder {
    images: Vec<Image>,
    breadth: [f64; 2],
}

/// Cells are narrowed and looked at again so often.
const LOOKS: u32 = 3;
/// Again only if they are so much narrower.
const NARROWER: f64 = 0.7;
/// Strings with more edges are not used.
const MOST_EDGES: usize = 2000;
const MOST_LETTERS: usize = 12;

// D28: the outer ends
pub(crate) fn hull([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [if c < a { c } else { a }, if d > b { d } else { b }]
}

pub(crate) fn ends(x: Ball) -> [f64; 2] {
    [(x.mid() - x.rad()).next_down(), (x.mid() + x.rad()).next_up()]
}

/// Bounds of the slopes of the images of the vectors `(1, slope)` at the states of cells. Lemma D26
fn image_slopes<'i>(images: impl Iterator<Item = &'i Image>, strip: &Strip, slopes: [f64; 2]) -> Option<[f64; 2]> {
    let mut all = [f64::INFINITY, f64::NEG_INFINITY];
    for image in images {
        for slope in slopes {
            let [x, y] = image.direction(strip, slope)?;
            all = hull(all, ends(y.checked_div(x)?));
        }
    }
    Some(all)
}

/// Bounds of `ln |X|` for the vectors `(1, slope)` at the states of a cell.
fn expansion(image: &Image, strip: &Strip, slopes: [f64; 2], rises: bool) -> Option<[f64; 2]> {
    let sign = if rises { 1.0 } else { -1.0 };
    let of = |slope: f64| Some(ends(logarithm(image.direction(strip, slope)?[0].signed(sign))?));
    Some(hull(of(slopes[0])?, of(slopes[1])?))
}

/// The words, and all that is asked of their strings.
pub(crate) struct Strings<'s> {
    pub map: &'s Map<'s>,
    pub words: &'s [Proved],
    pub kappa: f64,
    pub watch: &'s dyn Watch,
}

impl Strings<'_> {
    /// What of a cell may be mapped to the points of a strip with `a` between bounds: narrowed as far as its own image says.
    fn narrowed(&self, image: &Image, strip: &Strip, breadth: [f64; 2]) -> Option<Cell> {
        let Image { cell, middle, sides } = image;
        // About the line in the middle between both bounds.
        let line = 0.5 * (breadth[0] + breadth[1]);
        let [place, slope] = strip.line(line);
        let half = strip.breadth(image.spread(1)) * (Ball::exact(breadth[1]) - Ball::exact(breadth[0]));
        let [along, across] = sides.map(|side| beside(side, slope));
        // The line is off by its rounding: all of the difference is more than half of it.
        let reach = up(0.5 * half.mag() + f64::EPSILON * strip.breadth(image.spread(1)).mag());
        let wanted = (place - beside(*middle, slope)).widened(up(reach + across.mag()));
        let Some(within) = wanted.checked_div(along) else { return Some(*cell) };
        let [low, high] = ends(within);
        // D28: what is in both
        let (low, high) = (low.max(-1.0), high.min(1.0)); // D28: what is in both
        if low > high {
            return None;
        }
        let is_part = high - low < 2.0; // D28: not if it is NaN
        if !is_part {
            return Some(*cell); // exact: all of it
        }
        let radius = cell.radii[0];
        let at = cell.at[0] + radius * 0.5 * (low + high);
        let reach = Ball::exact(0.5 * (high - low)) * Ball::exact(radius);
        // D28: `at` is off by its rounding
        let reach = up(reach.mag() + 4.0 * f64::EPSILON * (cell.at[0].abs() + radius));
        Some(Cell { at: [at, cell.at[1]], radii: [reach, cell.radii[1]] })
    }

    /// The points of the word's cells that go on in a strip between bounds of `a`.
    fn cylinder(&self, word: usize, images: &[Image], next: usize, breadth: [f64; 2]) -> Cylinder {
        let (own, strip) = (&self.words[word].branch, &self.words[next].branch.strip);
        let mut cylinder = Cylinder { images: Vec::new(), breadth: [f64::INFINITY, f64::NEG_INFINITY] };
        for image in images {
            let mut image = *image;
            let is_left = (0..LOOKS).all(|_| {
                let Some(cell) = self.narrowed(&image, strip, breadth) else { return false };
                if cell.radii[0] < NARROWER * image.cell.radii[0]
                    && let Ok(better) = self.map.image(own, cell, &|_, _, _| true)
                {
                    image = better;
                }
                true
            });
            if is_left {
                let [a, r] = [image.cell.at[0], image.cell.radii[0]].map(Ball::exact);
                cylinder.breadth = hull(hull(cylinder.breadth, ends(a - r)), ends(a + r));
                cylinder.images.push(image);
            }
        }
        cylinder
    }

    /// The bounds of the logarithm of the expansion of a string's first word after a word before it.
    fn bounds(&self, slopes: [f64; 2], word: usize, images: &[Image]) -> Option<[f64; 2]> {
        let branch = &self.words[word].branch;
        if images.is_empty() {
            return None; // exact: nothing is certified
        }
        images.iter().try_fold([f64::INFINITY, f64::NEG_INFINITY], |all, image| {
            Some(hull(all, expansion(image, &branch.strip, slopes, branch.rises)?))
        })
    }

    /// Returns the graph of strings: an edge for each word with a word before it and some after it, weighing the logarithm of what it
    /// expands by, its length being its impacts; with the word of each edge.
    pub fn graph(&self) -> Option<Vec<(Edge, usize)>> {
        let whole = |word: usize| {
            let images: Vec<Image> =
                self.words[word].images.iter().filter(|image| !image.is_outside()).copied().collect();
            Cylinder { images, breadth: [-1.0, 1.0] }
        };
        let mut level: HashMap<Letters, Cylinder> =
            (0..self.words.len()).map(|word| (vec![word], whole(word))).collect();
        let mut best = None;
        let mut slopes = vec![[-self.kappa, self.kappa]; self.words.len()];
        for letters in 1..=MOST_LETTERS {
            let count: usize = level.keys().map(|string| self.before(string[0]).count()).sum();
            if count > MOST_EDGES || !self.watch.goes_on() {
                break;
            }
            slopes = self.slopes(&level, &slopes)?;
            best = Some(self.edges(&level, &slopes, letters)?);
            let mut next = HashMap::new();
            for (string, cylinder) in &level {
                for word in self.before(string[0]) {
                    let longer: Letters = std::iter::once(word).chain(string.iter().copied()).collect();
                    let own = &level[&longer[..letters]];
                    next.insert(longer, self.cylinder(word, &own.images, string[0], cylinder.breadth));
                }
            }
            level = next;
        }
        best
    }

    /// The slopes of the images, narrowed by those that words arrive with. Lemma D26
    fn slopes(&self, level: &HashMap<Letters, Cylinder>, known: &[[f64; 2]]) -> Option<Vec<[f64; 2]>> {
        let mut slopes = known.to_vec();
        for _ in 0..LOOKS {
            let images = |word: usize| {
                let own = level.iter().filter(move |(string, _)| string[0] == word);
                own.flat_map(|(_, cylinder)| &cylinder.images)
            };
            let arriving = |word: usize| {
                self.before(word).map(|before| slopes[before]).fold([f64::INFINITY, f64::NEG_INFINITY], hull)
            };
            let all = (0..self.words.len())
                .map(|word| image_slopes(images(word), &self.words[word].branch.strip, arriving(word)));
            slopes = all.collect::<Option<_>>()?;
        }
        Some(slopes)
    }

    fn before(&self, word: usize) -> impl Iterator<Item = usize> {
        let from = self.words[word].branch.from;
        (0..self.words.len()).filter(move |&before| self.words[before].branch.to == from)
    }

    fn edges(
        &self,
        level: &HashMap<Letters, Cylinder>,
        slopes: &[[f64; 2]],
        letters: usize,
    ) -> Option<Vec<(Edge, usize)>> {
        let (mut nodes, mut edges) = (HashMap::new(), Vec::new());
        let mut node = |letters: &[usize]| {
            let next = nodes.len();
            *nodes.entry(letters.to_vec()).or_insert(next)
        };
        let mut strings: Vec<(&Letters, &Cylinder)> = level.iter().collect();
        strings.sort_unstable_by(|a, b| a.0.cmp(b.0));
        for (string, cylinder) in strings {
            let word = string[0];
            for before in self.before(word) {
                let all: Letters = std::iter::once(before).chain(string.iter().copied()).collect();
                let (from, to) = (node(&all[..letters]), node(&all[1..]));
                let length = self.words[word].branch.sides.len() as f64; // exact: a length
                edges.push((
                    Edge { from, to, weight: self.bounds(slopes[before], word, &cylinder.images)?, length },
                    word,
                ));
            }
        }
        Some(edges)
    }
}
