//! A word's strip is mapped across the next h-set, and expands the cones: Lemmas D25, D26 of `docs/proofs/hyperbolic.md#D25`.

use super::left_out::{LeftOut, MOST_CELLS};
use super::sides::Sides;
use super::strip::{Branch, Cell, Image, Map, Passed, beside};
use crate::chaos::flights::is_positive;
use crate::chaos::frame::{Frame, least};
use crate::number::{Ball, Number, up};
use crate::watch::Watch;

/// A cell is no smaller than this beside its strip.
const MIN_CELL: f64 = 1.0 / (1 << 20) as f64; // exact: a power of two

/// Expansions are known up to such a part per impact of the word.
const EXPANSION_ACCURACY: f64 = 0.04;

/// A word with the images of the cells of its strip.
#[derive(Clone, Debug)]
pub(crate) struct Proved {
    pub number: usize,
    pub branch: Branch,
    pub images: Vec<Image>,
}

impl Map<'_> {
    /// Images of cells that cover a word's strip. Proved: the strip is mapped across the next h-set; each cell that meets the h-set maps
    /// the cone of slopes up to `kappa` into itself, and expands. Else the reason why not. Lemmas D25, D26
    pub fn prove(&self, branch: &Branch, kappa: f64, watch: &dyn Watch) -> Result<Vec<Image>, LeftOut> {
        if !is_flat(branch, kappa) {
            return Err(LeftOut::Leaning);
        }
        let is_good = |image: &Image| {
            crosses(branch, image) && (image.is_outside() || is_cone(branch, image, kappa) && is_known(branch, image))
        };
        self.cut(branch, vec![Cell::WHOLE], (&|_, _, _| true, &is_good), watch)
    }

    /// Whether no state of a word's strip is proved to be, on the way, in the strip of a shorter word whose flights are the last ones of
    /// this word. Only heights that an image of a word has there count. Lemma D25
    pub fn is_alone(&self, word: &Proved, all: &[Proved], heights: &[Ball], watch: &dyn Watch) -> bool {
        let branch = &word.branch;
        let shortcuts: Vec<Shortcut<'_>> = all.iter().filter_map(|other| Shortcut::of(branch, &other.branch)).collect();
        let passed = |impacts: usize, centre: [Ball; 2], sides: &Sides| {
            let mut there = shortcuts.iter().filter(|shortcut| shortcut.passed == impacts);
            there.all(|shortcut| {
                shortcut.is_clear(&self.frames[shortcut.branch.from], heights[shortcut.branch.from], (centre, sides))
            })
        };
        let cells = word.images.iter().map(|image| image.cell).collect();
        shortcuts.is_empty() || self.cut(branch, cells, (&passed, &|_| true), watch).is_ok()
    }

    /// Images of cells, cut until each cell passes and is good, or the reason why one never is.
    fn cut(
        &self,
        branch: &Branch,
        mut open: Vec<Cell>,
        (passed, is_good): Condition<'_>,
        watch: &dyn Watch,
    ) -> Result<Vec<Image>, LeftOut> {
        let mut done = Vec::new();
        while let Some(cell) = open.pop() {
            let axis = match self.image(branch, cell, passed) {
                Ok(image) if is_good(&image) => {
                    done.push(image);
                    continue;
                }
                Ok(image) => image.axis(),
                Err(lost) => lost.axis(),
            };
            // proposes: when to give up, nothing is certified
            if !watch.goes_on() {
                return Err(LeftOut::Interrupted);
            } else if open.len() + done.len() > MOST_CELLS {
                return Err(LeftOut::Cells);
            } else if cell.radii.iter().any(|&radius| radius < MIN_CELL) {
                return Err(LeftOut::Cone);
            }
            open.extend(cell.halves(axis));
        }
        Ok(done)
    }
}

/// Conditions on the states on the way, and on the images.
type Condition<'w> = (Passed<'w>, &'w dyn Fn(&Image) -> bool);

/// Whether a curve with slopes up to `kappa` meets each side of the strip once. Lemma D26
pub(crate) fn is_flat(branch: &Branch, kappa: f64) -> bool {
    [branch.strip.left, branch.strip.right].iter().all(|[_, slope]| up(kappa * slope.abs()) < 1.0)
}

/// Whether the whole image is between bottom and top of the h-set, and the images of the strip's sides are beyond its edges. Lemma D25
fn crosses(branch: &Branch, image: &Image) -> bool {
    let one = Ball::exact(1.0);
    let height = image.spread(1);
    let is_between = is_positive(one - height) && is_positive(one + height);
    let Cell { at: [a, _], radii: [r, _] } = image.cell;
    let sign = if branch.rises { 1.0 } else { -1.0 };
    let beyond = |end: f64| {
        // The side is the end of the cell, at all its heights.
        let at = image.middle[0] + Ball::exact(end) * image.sides.first[0];
        let edge = (at.widened(image.sides.second()[0].mag())).signed(end * sign);
        is_positive(edge - one)
    };
    // exact: dyadic
    is_between && [-1.0, 1.0].iter().all(|&end| (a + end * r) * end < 1.0 || beyond(end))
}

/// Whether a cell whose image meets the h-set maps the cone of slopes up to `kappa` into itself, and expands. Lemma D26
fn is_cone(branch: &Branch, image: &Image, kappa: f64) -> bool {
    let sign = if branch.rises { 1.0 } else { -1.0 };
    [-kappa, kappa].iter().all(|&slope| {
        image.direction(slope).is_some_and(|[x, y]| {
            let x = x.signed(sign);
            is_positive(x - Ball::exact(1.0)) && is_positive(Ball::exact(kappa) * x - Ball::exact(y.mag()))
        })
    })
}

/// Whether the expansion is known well enough to be worth bounding; any answer is sound.
fn is_known(branch: &Branch, image: &Image) -> bool {
    let part = EXPANSION_ACCURACY * branch.sides.len() as f64; // exact: a length
    image.direction(0.0).is_some_and(|[x, _]| x.rad() < part * x.mid().abs()) // proposes
}

/// A strip that a word's images must not meet on the way, as its flights are the last ones of the word: the flights before it, and the
/// whole forcing periods after which it is there.
struct Shortcut<'b> {
    passed: usize,
    turns: f64,
    branch: &'b Branch,
}

impl<'b> Shortcut<'b> {
    fn of(word: &Branch, branch: &'b Branch) -> Option<Self> {
        let passed = word.sides.len().checked_sub(branch.sides.len()).filter(|&passed| passed > 0)?;
        let is_end = word.to == branch.to && word.sides[passed..] == branch.sides;
        is_end.then_some(Self { passed, turns: word.turns - branch.turns, branch })
    }

    /// Whether no sum of `centre` and parts of both sides is in the strip at the heights of images. Lemma D25
    fn is_clear(&self, frame: &Frame, heights: Ball, (centre, sides): ([Ball; 2], &Sides)) -> bool {
        let (Some(middle), [Some(breadth), Some(height)]) =
            (frame.place(centre, self.turns), sides.both().map(|side| frame.coordinates(side)))
        else {
            return false;
        };
        let [place, slope] = self.branch.strip.line(Ball::exact(0.0));
        let above = middle[1].widened(up(breadth[1].mag() + height[1].mag()));
        let reach = up(beside(breadth, slope).mag() + beside(height, slope).mag());
        let beside = (beside(middle, slope) - place).widened(reach);
        let half = self.branch.strip.breadth(Ball::new(0.0, 1.0)).mag();
        least(above - heights) > 0.0 || least(beside) > half // D25: no height of an image, or beside its breadth
    }
}
