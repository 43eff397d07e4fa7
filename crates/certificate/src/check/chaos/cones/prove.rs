//! That the strips of words are mapped across h-sets and expand their cones (Lemma V14).

use super::super::allowance::End;
use super::super::beam::Spot;
use super::super::span::Span;
use super::sides::Sides;
use super::strip::{Branch, Cell, Frame, Image, Map, Passed, is_beyond, is_tall};

/// Most cells of a strip, and the least width of one.
const MAX_CELLS: usize = 1 << 19;
const MIN_CELL_WIDTH: f64 = 1.0 / (1 << 20) as f64; // exact: a power of two

/// Cells are cut until expansions are known up to such a part per impact of the word.
const EXPANSION_ACCURACY: f64 = 0.04;

/// A word with the images of its cells.
#[derive(Clone, Debug)]
pub(super) struct Proved {
    pub branch: Branch,
    pub images: Vec<Image>,
}

impl Map<'_> {
    /// Returns the images of cells of a strip, `None` if it is not proved to be mapped across, with cones of slopes up to `kappa`.
    pub fn prove(&self, branch: &Branch, kappa: f64) -> Result<Option<Vec<Image>>, End> {
        let [left, right] = [branch.strip.left[1], branch.strip.right[1]].map(|lean| Span::point(lean).scaled(kappa));
        if is_beyond_one(left) || is_beyond_one(right) {
            return Ok(None);
        }
        let is_good = |image: &Image| {
            crosses(branch, image) && (image.is_outside() || is_cone(branch, image, kappa) && is_known(branch, image))
        };
        self.cut(branch, vec![Cell::WHOLE], &|_, _, _| true, &is_good)
    }

    /// Returns whether no state of the strip is on its way where a word that is the end of this one begins.
    pub fn is_alone(&self, word: &Proved, all: &[Proved], heights: &[Span]) -> Result<bool, End> {
        let ends: Vec<(usize, f64, &Branch)> =
            all.iter().filter_map(|other| end_of(&word.branch, &other.branch)).collect();
        if ends.is_empty() {
            return Ok(true);
        }
        let passed = |flown: usize, centre: Spot, sides: &Sides| {
            let mut here = ends.iter().filter(|(passed, ..)| *passed == flown);
            here.all(|(_, turns, other)| {
                is_clear((&self.frames[other.from], heights[other.from]), other, centre, (sides, *turns))
            })
        };
        let cells = word.images.iter().map(|image| image.cell).collect();
        Ok(self.cut(&word.branch, cells, &passed, &|_| true)?.is_some())
    }

    fn cut(
        &self,
        branch: &Branch,
        mut open: Vec<Cell>,
        passed: Passed<'_>,
        is_good: &dyn Fn(&Image) -> bool,
    ) -> Result<Option<Vec<Image>>, End> {
        let mut done = Vec::new();
        while let Some(cell) = open.pop() {
            let is_tall = match self.image(branch, cell, passed)? {
                Ok(image) if is_good(&image) => {
                    done.push(image);
                    continue;
                }
                Ok(image) => is_tall(&image.sides),
                Err(sides) => is_tall(&sides),
            };
            let [breadth, height] = [cell.across, cell.heights].map(|[a, b]| b - a);
            // proposes: when to give up, nothing is confirmed
            if breadth < MIN_CELL_WIDTH || height < MIN_CELL_WIDTH || open.len() + done.len() > MAX_CELLS {
                return Ok(None);
            }
            open.extend(cell.halves(is_tall));
        }
        Ok(Some(done))
    }
}

/// Returns whether a member may be 1 or more, or -1 or less.
fn is_beyond_one(x: Span) -> bool {
    let one = Span::point(1.0);
    !((one - x).is_positive() && (one + x).is_positive())
}

fn crosses(branch: &Branch, image: &Image) -> bool {
    let one = Span::point(1.0);
    let beyond = |is_right: bool| {
        let side = image.sides.first[0];
        let at = image.middle[0] + if is_right { side } else { -side } + image.sides.second()[0].around();
        if is_right == branch.rises { (at - one).is_positive() } else { (at + one).is_negative() }
    };
    let [low, high] = image.cell.across;
    // exact: cuts are halves
    !is_beyond_one(image.all(1)) && (low > -1.0 || beyond(false)) && (high < 1.0 || beyond(true))
}

fn is_cone(branch: &Branch, image: &Image, kappa: f64) -> bool {
    let is_mapped = |slope: f64| {
        let Some([x, y]) = image.direction(slope) else { return false };
        let x = x.signed(branch.rises);
        let room = x.scaled(kappa);
        (x - Span::point(1.0)).is_positive() && (room - y).is_positive() && (room + y).is_positive()
    };
    is_mapped(kappa) && is_mapped(-kappa)
}

/// Returns whether the expansion is known well enough; any answer will do.
fn is_known(branch: &Branch, image: &Image) -> bool {
    let part = EXPANSION_ACCURACY * branch.flights.len() as f64; // exact: a length
    image.direction(0.0).is_some_and(|[x, _]| x.hi() - x.lo() < 2.0 * part * x.mid().abs())
}

/// Flights and forcing periods of a word before its end, if that end is `other`, a shorter word to the same h-set.
fn end_of<'b>(word: &Branch, other: &'b Branch) -> Option<(usize, f64, &'b Branch)> {
    let passed = word.flights.len().checked_sub(other.flights.len()).filter(|&passed| passed > 0)?;
    let is_end = word.to == other.to && word.flights[passed..] == other.flights;
    is_end.then_some((passed, word.turns - other.turns, other))
}

fn is_clear((frame, heights): (&Frame, Span), other: &Branch, centre: Spot, (sides, turns): (&Sides, f64)) -> bool {
    let (Some(middle), Some(a), Some(b)) =
        (frame.place(centre, turns), frame.coordinates(sides.first), frame.coordinates(sides.second()))
    else {
        return false;
    };
    let height = middle[1] + a[1].around() + b[1].around() - heights;
    let [place, lean] = other.strip.line(Span::point(0.0));
    let beside = |[xi, eta]: Spot| xi - lean * eta;
    let apart = beside(middle) - place + beside(a).around() + beside(b).around();
    height.is_positive() || height.is_negative() || is_beyond(apart, other.strip.half(Span::new(-1.0, 1.0)).around())
}

/// Holds the heights of all images in each h-set.
pub(super) fn heights(words: &[Proved], bases: usize) -> Vec<Span> {
    let of = |at: usize| {
        let images = words.iter().filter(|word| word.branch.to == at).flat_map(|word| &word.images);
        images.filter(|image| !image.is_outside()).map(|image| image.all(1)).reduce(Span::hull)
    };
    // exact: where no word leads, none is alone there
    (0..bases).map(|at| of(at).unwrap_or(Span::new(-1.0, 1.0))).collect()
}

/// Returns whether there are words, each from one h-set to another one, and they lead from each of all these to each.
pub(super) fn lead_back(words: &[[usize; 2]], bases: usize) -> bool {
    let mut leads = vec![vec![false; bases]; bases];
    words.iter().for_each(|&[from, to]| leads[from][to] = true);
    for by in 0..bases {
        for from in 0..bases {
            for to in 0..bases {
                leads[from][to] |= leads[from][by] && leads[by][to];
            }
        }
    }
    let all = words.iter().flatten();
    !words.is_empty() && all.clone().all(|&from| all.clone().all(|&to| leads[from][to]))
}
