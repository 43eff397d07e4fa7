//! How much strings of words expand, and the graph of strings (Lemma V14).

use std::collections::BTreeMap;

use impact_pair_exact::{Dyadic, Real};

use super::super::allowance::End;
use super::super::entropy::exponential;
use super::super::span::Span;
use super::prove::Proved;
use super::rates::Edge;
use super::strip::{Cell, Image, Map, Strip};

/// Cells are cut so often, again if they are so much narrower.
const LOOKS: u32 = 3;
const NARROWER: f64 = 0.7;
/// More edges, or longer strings, are not looked at.
const MOST_EDGES: usize = 2100;
const LONGEST: usize = 12;
const BITS: u32 = 256;

/// The cells of the first word of a string, and between which fractions of its strip they are.
#[derive(Clone, Debug)]
struct Part {
    images: Vec<Image>,
    across: [f64; 2],
}

type Level = BTreeMap<Vec<usize>, Part>;

/// An edge of the graph of strings, and its word.
pub(super) type Step = (Edge, usize);

/// What is looked at of strings of words.
pub(super) struct Strings<'s> {
    pub map: &'s Map<'s>,
    pub words: &'s [Proved],
    pub kappa: f64,
}

/// Encloses the logarithm of a positive double.
pub(super) fn logarithm(x: f64) -> Option<Span> {
    let guess = x.ln();
    if !(guess.abs() < 60.0 && x > 0.0) {
        return None; // exact: nothing is confirmed
    }
    // V14: e^|guess|, and what is left
    let power = exponential(&Real::point(Dyadic::from_f64(guess.abs())?, BITS));
    let x = Real::point(Dyadic::from_f64(x)?, BITS);
    let ratio = if guess < 0.0 { x * &power } else { x.over(&power)? };
    let rest = Span::of(ratio.enclosure()) - Span::point(1.0);
    let most = rest.most();
    // V14: |ln(1 + d)| <= 2 |d| for |d| < 1/2
    (most < 0.5).then(|| Span::point(guess) + Span::new(-2.0 * most, 2.0 * most))
}

fn bounds(x: Span) -> [f64; 2] {
    [x.lo(), x.hi()]
}

impl Strings<'_> {
    fn before(&self, word: usize) -> impl Iterator<Item = usize> {
        let from = self.words[word].branch.from;
        (0..self.words.len()).filter(move |&before| self.words[before].branch.to == from)
    }

    /// Calls `visit` with the graph of strings of one word, of two, and so on, until it returns true or they are too many.
    pub fn each(&self, visit: &mut dyn FnMut(&[Step]) -> bool) -> Result<(), End> {
        let whole = |word: &Proved| Part {
            images: word.images.iter().filter(|image| !image.is_outside()).copied().collect(),
            across: [-1.0, 1.0],
        };
        let mut level: Level = self.words.iter().enumerate().map(|(k, word)| (vec![k], whole(word))).collect();
        let mut slopes = vec![[-self.kappa, self.kappa]; self.words.len()];
        for letters in 1..=LONGEST {
            let Some(narrower) = self.slopes(&level, &slopes) else { return Ok(()) };
            slopes = narrower;
            let Some(graph) = self.graph(&level, &slopes, letters) else { return Ok(()) };
            let count: usize = level.keys().map(|string| self.before(string[0]).count()).sum();
            if visit(&graph) || count * 2 > MOST_EDGES {
                return Ok(());
            }
            let mut next = Level::new();
            for (string, part) in &level {
                for word in self.before(string[0]) {
                    let longer = [&[word], &string[..]].concat();
                    let own = &level[&longer[..letters]].images;
                    next.insert(longer, self.part((word, own), string[0], part.across)?);
                }
            }
            level = next;
        }
        Ok(())
    }

    /// The slopes of the expanding directions that each word leads to.
    fn slopes(&self, level: &Level, known: &[[f64; 2]]) -> Option<Vec<[f64; 2]>> {
        let mut slopes = known.to_vec();
        for _ in 0..LOOKS {
            let mut all: Vec<Option<Span>> = vec![None; self.words.len()];
            for (string, part) in level {
                let given = self.given(string[0], &slopes)?;
                for image in &part.images {
                    for slope in given {
                        let [x, y] = image.direction(&self.words[string[0]].branch.strip, slope)?;
                        let slope = y.over(x)?;
                        let all = &mut all[string[0]];
                        *all = Some(all.map_or(slope, |all| all.hull(slope)));
                    }
                }
            }
            slopes = all.into_iter().map(|slopes| slopes.map(bounds)).collect::<Option<_>>()?;
        }
        Some(slopes)
    }

    /// The slopes that a word is given by those before it.
    fn given(&self, word: usize, slopes: &[[f64; 2]]) -> Option<[f64; 2]> {
        self.before(word).map(|before| Span::new(slopes[before][0], slopes[before][1])).reduce(Span::hull).map(bounds)
    }

    fn graph(&self, level: &Level, slopes: &[[f64; 2]], letters: usize) -> Option<Vec<Step>> {
        let mut nodes = BTreeMap::new();
        let mut node = |string: &[usize]| {
            let next = nodes.len();
            *nodes.entry(string.to_vec()).or_insert(next)
        };
        let mut graph = Vec::new();
        for (string, part) in level {
            let branch = &self.words[string[0]].branch;
            for before in self.before(string[0]) {
                let all = [&[before], &string[..]].concat();
                let mut expansion: Option<Span> = None;
                for image in &part.images {
                    for slope in slopes[before] {
                        let x = image.direction(&branch.strip, slope)?[0].signed(branch.rises);
                        expansion = Some(expansion.map_or(x, |all| all.hull(x)));
                    }
                }
                let [least, most] = bounds(expansion?);
                let weight = logarithm(least)?.hull(logarithm(most)?);
                let (from, to) = (node(&all[..letters]), node(&all[1..]));
                let length = branch.flights.len() as f64; // exact: a length
                graph.push((Edge { from, to, weight, length }, string[0]));
            }
        }
        Some(graph)
    }

    /// What of a word's cells may lead to fractions of the next strip.
    fn part(&self, (word, images): (usize, &[Image]), next: usize, across: [f64; 2]) -> Result<Part, End> {
        let (branch, strip) = (&self.words[word].branch, &self.words[next].branch.strip);
        let (mut kept, mut all): (Vec<Image>, Option<Span>) = (Vec::new(), None);
        'images: for image in images {
            let mut image = *image;
            for _ in 0..LOOKS {
                let Some(cell) = narrowed(&image, strip, across) else { continue 'images };
                let [width, before] = [cell.across, image.cell.across].map(|[a, b]| b - a);
                let is_narrower = width < NARROWER * before;
                if !is_narrower {
                    break;
                }
                match self.map.image(branch, cell, &|_, _, _| true)? {
                    Ok(better) => image = better,
                    Err(_) => break,
                }
            }
            let [a, b] = image.cell.across;
            let own = Span::new(a, b);
            all = Some(all.map_or(own, |all| all.hull(own)));
            kept.push(image);
        }
        // exact: where nothing is left there are no images, and nothing is confirmed
        let across = all.map_or([-1.0, 1.0], bounds);
        Ok(Part { images: kept, across })
    }
}

/// The part of a cell whose image may be between two lines of a strip; `None` if none may.
fn narrowed(image: &Image, strip: &Strip, [low, high]: [f64; 2]) -> Option<Cell> {
    let line = 0.5 * (low + high);
    let [place, lean] = strip.line(Span::point(line));
    let reach = (Span::point(high) - Span::point(line)).hull(Span::point(line) - Span::point(low)).around();
    let beside = |[xi, eta]: [Span; 2]| xi - lean * eta;
    let wanted = place + reach * strip.half(image.all(1)) - beside(image.middle) - beside(image.sides[1]).around();
    let Some(within) = wanted.over(beside(image.sides[0])) else { return Some(image.cell) };
    let within = within.common(Span::new(-1.0, 1.0))?;
    let [from, to] = image.cell.across;
    let ([middle, half], part) = (Cell::centred([from, to]), within);
    let across = (middle + half * part).common(Span::new(from, to));
    // V14: both hold it; NaN is all of the cell
    let across = across.filter(|across| across.lo() < across.hi()).map_or([from, to], bounds);
    Some(Cell { across, ..image.cell })
}
