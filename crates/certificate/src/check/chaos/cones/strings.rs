//! Expansion along strings of words, and the graph of strings (Lemma V14).

use std::collections::BTreeMap;

use super::super::allowance::End;
use super::super::span::Span;
use super::powers::logarithm;
use super::prove::Proved;
use super::rates::Edge;
use super::strip::{Branch, Cell, Image, Map, Strip, is_tall};

/// Most cuts of a cell, and the ratio of widths below which it is cut again.
const MAX_CUTS: u32 = 3;
const RECUT_RATIO: f64 = 0.7;
/// Most strings, cells of all of them, and words of a string.
const MAX_STRINGS: usize = 16_000;
const MAX_CELLS: usize = 3 << 21;
const MAX_LENGTH: u32 = 9;
/// Number of times that cells are halved where the claims do not follow yet, and how many cells are added by it at most.
const MAX_HALVINGS: u32 = 24;
const MAX_ADDED_CELLS: usize = 1 << 17;

/// A string, which is a word alone, or one with a word before it and some behind it: the cells of this word in which its points are, the
/// fractions of its strip between which they are, and the heights of their images.
#[derive(Clone, Debug)]
struct Part {
    images: Vec<Image>,
    across: [f64; 2],
    heights: Span,
}

type Level = BTreeMap<Vec<usize>, Part>;

/// An edge of the graph of strings, and its word.
pub(super) type Step = (Edge, usize);

/// The proved words whose strings are followed, the map, and the slope `kappa` of their cones.
pub(super) struct Strings<'s> {
    pub map: &'s Map<'s>,
    pub words: &'s [Proved],
    pub kappa: f64,
}

fn bounds(x: Span) -> [f64; 2] {
    [x.lo(), x.hi()]
}

/// The interval of all fractions of a strip, and of all heights.
fn everything() -> Span {
    Span::new(-1.0, 1.0)
}

/// No upper end and no lower end of intervals.
const ALL_ENDS: [f64; 2] = [f64::MAX, f64::MIN];

/// The least upper end and the greatest lower end of one more interval, too.
fn inner([least, most]: [f64; 2], x: Span) -> [f64; 2] {
    [least.min(x.hi()), most.max(x.lo())] // proposes: any cells may be halved
}

/// Returns whether an end of a hull of intervals may be here, given the least upper end and the greatest lower one of all.
fn is_beyond(x: Span, [least, most]: [f64; 2]) -> bool {
    x.lo() < least || x.hi() > most
}

/// Number of cells of all strings.
fn cells(level: &Level) -> usize {
    level.values().map(|part| part.images.len()).sum()
}

impl Part {
    fn of(images: Vec<Image>) -> Self {
        let all = |of: &dyn Fn(&Image) -> Span| images.iter().map(of).reduce(Span::hull);
        // exact: where nothing is left there are no images, and nothing is confirmed
        let across = all(&|image| Span::new(image.cell.across[0], image.cell.across[1])).map_or([-1.0, 1.0], bounds);
        let heights = all(&|image| image.all(1)).unwrap_or(everything()); // exact: likewise
        Self { images, across, heights }
    }
}

impl Strings<'_> {
    fn before(&self, word: usize) -> impl Iterator<Item = usize> {
        let from = self.words[word].branch.from;
        (0..self.words.len()).filter(move |&before| self.words[before].branch.to == from)
    }

    fn branch(&self, word: usize) -> &Branch {
        &self.words[word].branch
    }

    /// Calls `visit` with the graph of strings of `letters` words, and again with finer cells, until it returns true.
    pub fn measure(&self, letters: u32, visit: &mut dyn FnMut(&[Step]) -> bool) -> Result<(), End> {
        let inside = |word: &Proved| word.images.iter().filter(|image| !image.is_outside()).copied().collect();
        let alone = self.words.iter().enumerate().map(|(word, proved)| (vec![word], Part::of(inside(proved))));
        let mut level: Level = alone.collect();
        let mut slopes = vec![[-self.kappa, self.kappa]; self.words.len()];
        // V14: strings of any length will do
        for length in 1..=letters.min(MAX_LENGTH) {
            if length > 1 {
                if !self.are_few(&level) {
                    return Ok(());
                }
                level = if length == 2 { self.pairs(&level)? } else { self.longer(&level)? };
            }
            let Some(narrower) = self.slopes(&level, &slopes) else { return Ok(()) };
            slopes = narrower;
        }
        let most = cells(&level) + MAX_ADDED_CELLS;
        for _ in 0..MAX_HALVINGS {
            let Some(graph) = self.graph(&level, &slopes) else { return Ok(()) };
            if visit(&graph) || cells(&level) > most {
                return Ok(());
            }
            let Some(finer) = self.finer(&level, &slopes)? else { return Ok(()) };
            level = finer;
            let Some(narrower) = self.slopes(&level, &slopes) else { return Ok(()) };
            slopes = narrower;
        }
        Ok(())
    }

    /// The level with those cells halved in which the expansion of a string, or the slope of a word, may be least or greatest, and without the parts
    /// that have no points; `None` where an expansion is not known.
    fn finer(&self, level: &Level, slopes: &[[f64; 2]]) -> Result<Option<Level>, End> {
        let mut known = Vec::new();
        let mut of_words = vec![ALL_ENDS; self.words.len()];
        for (string, part) in level {
            let Some(all) = self.directions(string, part, slopes) else { return Ok(None) };
            let word = Self::word(string);
            of_words[word] = all.iter().fold(of_words[word], |ends, [_, slope]| inner(ends, *slope));
            known.push(all);
        }
        let mut next = Level::new();
        for ((string, part), all) in level.iter().zip(known) {
            let word = Self::word(string);
            let of_string = all.iter().fold(ALL_ENDS, |ends, [expansion, _]| inner(ends, *expansion));
            let mut images = Vec::new();
            for (image, [expansion, slope]) in part.images.iter().zip(all) {
                let is_end = is_beyond(expansion, of_string) || is_beyond(slope, of_words[word]);
                let halves = if is_end { self.halves(self.branch(word), image)? } else { None };
                images.extend(halves.map_or_else(|| vec![*image], Vec::from));
            }
            let (heights, ahead) = (self.heights(level, string), self.ahead(level, string));
            let narrowed = |image: &Image| {
                ahead.map_or(Some(image.cell), |(strip, across)| narrowed(image, strip, across))?.between(heights)
            };
            next.insert(string.clone(), self.cut(word, &images, &narrowed)?);
        }
        Ok(Some(next))
    }

    /// The strip that the word of a string leads to, and the fractions of it between which points of the longer string are.
    fn ahead(&self, level: &Level, string: &[usize]) -> Option<(&Strip, [f64; 2])> {
        let strip = &self.branch(*string.get(2)?).strip;
        let rest = &string[1..];
        let following = level.range(rest.to_vec()..).take_while(|(other, _)| other.starts_with(rest));
        let across = following.map(|(_, part)| Span::new(part.across[0], part.across[1])).reduce(Span::hull);
        Some((strip, bounds(across?)))
    }

    /// Holds the heights at which the points of a string come to its word.
    fn heights(&self, level: &Level, string: &[usize]) -> Span {
        let behind = |before: usize| match string {
            &[_] => vec![before],
            _ => [&[before], &string[..string.len() - 1]].concat(),
        };
        let all = self.before(string[0]).map(|before| level[&behind(before)].heights);
        // exact: where no word leads, nothing is cut
        all.reduce(Span::hull).unwrap_or(everything())
    }

    /// Holds the expansion and the slope of the image of the directions that a string is begun with, for each of its cells; `None` where one is not known.
    fn directions(&self, string: &[usize], part: &Part, slopes: &[[f64; 2]]) -> Option<Vec<[Span; 2]>> {
        let (given, rises) = (self.arriving(string, slopes)?, self.branch(Self::word(string)).rises);
        let of = |image: &Image| {
            let [one, other] = given.map(|slope| {
                let [x, y] = image.direction(slope)?;
                Some([x.signed(rises), y.over(x)?])
            });
            let (one, other) = (one?, other?);
            Some([0, 1].map(|i| one[i].hull(other[i])))
        };
        part.images.iter().map(of).collect()
    }

    /// The images of both halves of a cell, if they are known.
    fn halves(&self, branch: &Branch, image: &Image) -> Result<Option<[Image; 2]>, End> {
        let [one, other] = image.cell.halves(is_tall(&image.sides));
        let flown = |cell| Ok(self.map.image(branch, cell, &|_, _, _| true)?.ok());
        Ok(flown(one)?.zip(flown(other)?).map(|(one, other)| [one, other]))
    }

    /// Returns whether there are few enough strings with another word before them.
    fn are_few(&self, level: &Level) -> bool {
        let [mut strings, mut cells] = [0, 0];
        for (string, part) in level {
            let more = self.before(string[0]).count();
            strings += more;
            cells += more * part.images.len();
        }
        strings <= MAX_STRINGS && cells <= MAX_CELLS
    }

    /// The word of a string that its cells are of.
    fn word(string: &[usize]) -> usize {
        string[usize::from(string.len() > 1)]
    }

    /// The slopes with which a string's word is begun: those that the one before it leads to, or any.
    fn arriving(&self, string: &[usize], slopes: &[[f64; 2]]) -> Option<[f64; 2]> {
        match string {
            &[word] => self
                .before(word)
                .map(|before| Span::new(slopes[before][0], slopes[before][1]))
                .reduce(Span::hull)
                .map(bounds),
            _ => Some(slopes[string[0]]),
        }
    }

    /// The strings of two words: cells of the second one at the heights of images of the first.
    fn pairs(&self, alone: &Level) -> Result<Level, End> {
        let mut level = Level::new();
        for (string, part) in alone {
            let word = string[0];
            for before in self.before(word) {
                let heights = alone[&vec![before]].heights;
                let narrowed = |image: &Image| image.cell.between(heights);
                level.insert(vec![before, word], self.cut(word, &part.images, &narrowed)?);
            }
        }
        Ok(level)
    }

    /// The strings with another word before them.
    fn longer(&self, level: &Level) -> Result<Level, End> {
        let mut next = Level::new();
        for (string, Part { across, .. }) in level {
            let strip = &self.branch(string[1]).strip;
            for first in self.before(string[0]) {
                let longer = [&[first], &string[..]].concat();
                let own = &longer[..string.len()];
                let heights = self.heights(level, own);
                let narrowed = |image: &Image| narrowed(image, strip, *across)?.between(heights);
                let part = self.cut(string[0], &level[own].images, &narrowed)?;
                next.insert(longer, part);
            }
        }
        Ok(next)
    }

    /// The cells of a word, cut to those parts in which its points are left.
    fn cut(&self, word: usize, images: &[Image], narrowed: &dyn Fn(&Image) -> Option<Cell>) -> Result<Part, End> {
        let mut kept = Vec::new();
        'images: for image in images {
            let mut image = *image;
            for _ in 0..MAX_CUTS {
                let Some(cell) = narrowed(&image) else { continue 'images };
                if !cell.is_narrower(&image.cell) {
                    break;
                }
                match self.map.image(self.branch(word), cell, &|_, _, _| true)? {
                    Ok(better) => image = better,
                    Err(_) => break,
                }
            }
            kept.push(image);
        }
        Ok(Part::of(kept))
    }

    /// The slopes of the expanding directions that each word leads to.
    fn slopes(&self, level: &Level, known: &[[f64; 2]]) -> Option<Vec<[f64; 2]>> {
        let mut slopes = known.to_vec();
        for _ in 0..MAX_CUTS {
            let mut all: Vec<Option<Span>> = vec![None; self.words.len()];
            for (string, part) in level {
                let word = Self::word(string);
                for [_, slope] in self.directions(string, part, &slopes)? {
                    all[word] = Some(all[word].map_or(slope, |all| all.hull(slope)));
                }
            }
            slopes = all.into_iter().map(|slopes| slopes.map(bounds)).collect::<Option<_>>()?;
        }
        Some(slopes)
    }

    fn graph(&self, level: &Level, slopes: &[[f64; 2]]) -> Option<Vec<Step>> {
        let mut nodes = BTreeMap::new();
        let mut node = |string: &[usize]| {
            let next = nodes.len();
            *nodes.entry(string.to_vec()).or_insert(next)
        };
        let mut graph = Vec::new();
        for (string, part) in level {
            let word = Self::word(string);
            let branch = self.branch(word);
            let expansions = self.directions(string, part, slopes)?.into_iter().map(|[expansion, _]| expansion);
            let [least, most] = bounds(expansions.reduce(Span::hull)?);
            let weight = logarithm(least)?.hull(logarithm(most)?);
            let is_alone = string.len() == 1;
            let (from, to) = if is_alone {
                (node(&[branch.from]), node(&[branch.to]))
            } else {
                (node(&string[..string.len() - 1]), node(&string[1..]))
            };
            let length = branch.flights.len() as f64; // exact: a length
            graph.push((Edge { from, to, weight, length }, word));
        }
        Some(graph)
    }
}

impl Cell {
    /// The part of a cell at some heights; `None` if there is none.
    fn between(self, heights: Span) -> Option<Self> {
        let [low, high] = self.heights;
        let own = Span::new(low, high).common(heights)?;
        // V14: both hold it; NaN is all of the cell
        let heights = if own.lo() < own.hi() { bounds(own) } else { self.heights };
        Some(Self { heights, ..self })
    }

    /// Returns whether it is enough narrower than `before` to be followed again; any answer will do.
    fn is_narrower(&self, before: &Self) -> bool {
        let is_less = |[a, b]: [f64; 2], [c, d]: [f64; 2]| b - a < RECUT_RATIO * (d - c);
        is_less(self.across, before.across) || is_less(self.heights, before.heights)
    }
}

/// The part of a cell whose image may be between two lines of a strip; `None` if none may.
fn narrowed(image: &Image, strip: &Strip, [low, high]: [f64; 2]) -> Option<Cell> {
    let line = 0.5 * (low + high);
    let [place, lean] = strip.line(Span::point(line));
    let reach = (Span::point(high) - Span::point(line)).hull(Span::point(line) - Span::point(low)).around();
    let beside = |[xi, eta]: [Span; 2]| xi - lean * eta;
    let numerator =
        place + reach * strip.half(image.all(1)) - beside(image.middle) - beside(image.sides.second()).around();
    let Some(within) = numerator.over(beside(image.sides.first)) else { return Some(image.cell) };
    let within = within.common(Span::new(-1.0, 1.0))?;
    let [from, to] = image.cell.across;
    let ([middle, half], part) = (Cell::centred([from, to]), within);
    let across = (middle + half * part).common(Span::new(from, to));
    // V14: both hold it; NaN is all of the cell
    let across = across.filter(|across| across.lo() < across.hi()).map_or([from, to], bounds);
    Some(Cell { across, ..image.cell })
}
