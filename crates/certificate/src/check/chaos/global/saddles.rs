//! Proofs that the states of a set of boxes whose motions stay in it have no area (Lemma V28).

use std::collections::{BTreeMap, HashMap};

use super::super::beam::{Quad, State};
use super::super::guess::{Image, Matrix as Doubles, applied};
use super::super::span::Span;
use super::graph::Set;
use super::limit::{Matrix, cone, derivative, within};
use super::space::{Next, Space};

/// Sets of more boxes, and of more passages, are not tried.
const MAX_BOXES: usize = 1 << 16;
const MAX_PASSAGES: usize = 1 << 15;
/// Rounds of iterations that propose.
const ROUNDS: usize = 50;
const POWER_ITERATIONS: usize = 500;
/// Half width of the narrowest cones, and the number of times that they are doubled.
const MIN_HALF_WIDTH: f64 = 0.01;
const DOUBLINGS: i32 = 10;

/// The boxes of a set, in clusters that do not touch, with phases lifted so that those of a cluster are near one another.
struct Clusters<'s> {
    set: &'s Set,
    own: Vec<usize>,
    columns: Vec<i64>,
    count: usize,
}

/// Boxes of a cluster that may lead to another one, or to itself, by one wall.
struct Passage {
    ends: [usize; 2],
    is_far: bool,
    boxes: Vec<usize>,
}

/// Returns whether the states whose motions stay in a set have no area, and are stretched apart.
pub(super) fn have_no_area(set: &Set, space: &Space<'_>) -> bool {
    if set.has_release || set.cells.is_empty() || set.cells.len() > MAX_BOXES {
        return false; // V28: not proved
    }
    let Some((clusters, passages)) = Clusters::of(set).and_then(|own| own.passages(space).map(|all| (own, all))) else {
        return false; // V28: not proved
    };
    let image = |passage: &Passage| {
        let (low, high) = clusters.corners(passage.boxes[passage.boxes.len() / 2]);
        space.guess.map([0, 1].map(|i| 0.5 * (low[i] + high[i]))).filter(|image| image.is_far == passage.is_far)
    };
    let Some(images) = passages.iter().map(image).collect::<Option<Vec<_>>>() else { return false };
    let bases = bases(clusters.count, &passages, &images);
    let derivatives = passages.iter().map(|passage| clusters.derivative(space, passage, bases[passage.ends[0]]));
    let Some(derivatives) = derivatives.collect::<Option<Vec<_>>>() else { return false };
    let heights = heights(clusters.count, &passages, &images, &bases);
    (0..DOUBLINGS).any(|k| {
        let frame = |own: usize| {
            let height = MIN_HALF_WIDTH * 2.0_f64.powi(k) * heights[own];
            inverse(bases[own].map(|[along, across]| [along, across * height]))
        };
        let mut stretched = Vec::new();
        for (passage, derivative) in passages.iter().zip(&derivatives) {
            let [from, to] = passage.ends.map(frame);
            let Some((long, wide)) = within(*derivative, from, to).map(|step| cone(&step)) else { return false };
            if !(long.is_positive() && (long - wide).lo() >= 0.0) {
                return false; // V28: not proved
            }
            stretched.push((passage.ends, long));
        }
        shrinks(clusters.count, &stretched)
    })
}

impl<'s> Clusters<'s> {
    /// `None` where one is as wide as a quarter of a forcing period.
    fn of(set: &'s Set) -> Option<Self> {
        let columns = set.grid.columns as i64; // exact: a power of two
        let place: HashMap<[i64; 2], usize> = set.cells.iter().enumerate().map(|(k, &cell)| (cell, k)).collect();
        let mut own = vec![None; set.cells.len()];
        let mut lifted: Vec<i64> = set.cells.iter().map(|cell| cell[0]).collect();
        let mut count = 0;
        for first in 0..set.cells.len() {
            if own[first].is_some() {
                continue;
            }
            own[first] = Some(count);
            let (mut found, mut next) = (vec![first], 0);
            while let Some(&k) = found.get(next) {
                next += 1;
                for i in -1..=1 {
                    for j in -1..=1 {
                        let at = lifted[k] + i;
                        let beside = place.get(&[at.rem_euclid(columns), set.cells[k][1] + j]);
                        if let Some(&beside) = beside.filter(|&&beside| own[beside].is_none()) {
                            (own[beside], lifted[beside]) = (Some(count), at);
                            found.push(beside);
                        }
                    }
                }
            }
            let least = found.iter().map(|&k| lifted[k]).min()?;
            let most = found.iter().map(|&k| lifted[k]).max()?;
            if 4 * (most + 1 - least) >= columns {
                return None; // V28: not proved
            }
            count += 1;
        }
        let own = own.into_iter().collect::<Option<_>>()?;
        Some(Self { set, own, columns: lifted, count })
    }

    fn passages(&self, space: &Space<'_>) -> Option<Vec<Passage>> {
        let mut found: BTreeMap<([usize; 2], bool), Vec<usize>> = BTreeMap::new();
        for (k, &cell) in self.set.cells.iter().enumerate() {
            space.follows(self.set.grid, cell, &mut |next| {
                if let Next::Impact { cell, is_far, .. } = next
                    && let Ok(to) = self.set.cells.binary_search(&cell)
                {
                    let boxes = found.entry(([self.own[k], self.own[to]], is_far)).or_default();
                    if boxes.last() != Some(&k) {
                        boxes.push(k);
                    }
                }
            });
            if found.len() > MAX_PASSAGES {
                return None; // V28: not proved
            }
        }
        Some(found.into_iter().map(|((ends, is_far), boxes)| Passage { ends, is_far, boxes }).collect())
    }

    /// The lower and the upper corner of a box.
    fn corners(&self, k: usize) -> (State, State) {
        let [low, high] = Space::corners(self.set.grid, [self.columns[k], self.set.cells[k][1]]);
        (low, high)
    }

    /// Holds the derivatives over a parallelogram along a base that holds the boxes of a passage, whose flights all land on its wall.
    fn derivative(&self, space: &Space<'_>, passage: &Passage, base: Doubles) -> Option<Matrix> {
        let coordinates = inverse(base);
        let (root, _) = self.corners(passage.boxes[0]);
        let mut hull: Option<[Span; 2]> = None;
        for &k in &passage.boxes {
            let (low, high) = self.corners(k);
            let side = |i: usize| Span::new(low[i], high[i]) - Span::point(root[i]);
            let own = coordinates.map(|[a, b]| Span::point(a) * side(0) + Span::point(b) * side(1));
            hull = Some(hull.map_or(own, |hull| [0, 1].map(|i| hull[i].hull(own[i]))));
        }
        let hull = hull?;
        // The corners: what has these coordinates.
        let [[a, b], [c, d]] = coordinates.map(|row| row.map(Span::point));
        let area = a * d - b * c;
        let corner = |s: f64, t: f64| -> Option<[Span; 2]> {
            let [s, t] = [Span::point(s), Span::point(t)];
            let moved = [(d * s - b * t).over(area)?, (a * t - c * s).over(area)?];
            Some([0, 1].map(|i| Span::point(root[i]) + moved[i]))
        };
        let [s, t] = hull;
        let corners =
            [corner(s.lo(), t.lo())?, corner(s.lo(), t.hi())?, corner(s.hi(), t.lo())?, corner(s.hi(), t.hi())?];
        let quad = Quad { corners };
        let image = space.guess.map(quad.middle()).filter(|image| image.is_far == passage.is_far)?;
        derivative(space, &quad, &image, None)
    }
}

fn inverse([[a, b], [c, d]]: Doubles) -> Doubles {
    let area = a * d - b * c;
    [[d / area, -b / area], [-c / area, a / area]]
}

fn unit([u, w]: State) -> State {
    let size = u.hypot(w);
    [u / size, w / size]
}

/// Columns of two directions for each cluster: the mean one that flights before it stretch, and the mean one that later flights shrink.
fn bases(count: usize, passages: &[Passage], images: &[Image]) -> Vec<Doubles> {
    let mut all = vec![[[0.2, 1.0], [1.0, 0.2]]; count];
    let joined = |[u, w]: State, [v, x]: State| if u * v + w * x < 0.0 { [u - v, w - x] } else { [u + v, w + x] };
    for _ in 0..ROUNDS {
        let mut sums = vec![[[0.0; 2]; 2]; count];
        for (Passage { ends: [from, to], .. }, image) in passages.iter().zip(images) {
            let [[a, b], [c, d]] = image.jacobian;
            let forth = applied(image.jacobian, all[*from][0]);
            let back = applied([[d, -b], [-c, a]], all[*to][1]);
            sums[*to][0] = joined(sums[*to][0], unit(forth));
            sums[*from][1] = joined(sums[*from][1], unit(back));
        }
        all = sums.into_iter().map(|sum| sum.map(unit)).collect();
    }
    all.into_iter().map(|[along, across]| [[along[0], across[0]], [along[1], across[1]]]).collect()
}

/// Approximate half widths that cones need to hold the images of those before them, if nothing bends.
fn heights(count: usize, passages: &[Passage], images: &[Image], bases: &[Doubles]) -> Vec<f64> {
    let mut heights = vec![1.0_f64; count];
    for _ in 0..ROUNDS {
        for (Passage { ends: [from, to], .. }, image) in passages.iter().zip(images) {
            let inverse = inverse(bases[*to]);
            let step = |i: usize| applied(inverse, applied(image.jacobian, bases[*from].map(|row| row[i])));
            let rate = 1.1 * (step(1)[1] / step(0)[0]).abs();
            heights[*to] = heights[*to].max(rate * heights[*from]); // proposes
        }
    }
    heights
}

/// Returns whether the matrix of the inverses of the passages' stretching factors makes a positive vector smaller.
fn shrinks(count: usize, stretched: &[([usize; 2], Span)]) -> bool {
    let mut sizes = vec![1.0_f64; count];
    for _ in 0..POWER_ITERATIONS {
        let mut next = sizes.clone();
        for ([from, to], long) in stretched {
            next[*from] += sizes[*to] / long.mid();
        }
        let most = next.iter().fold(0.0, |most: f64, &x| most.max(x)); // proposes
        sizes = next.into_iter().map(|x| x / most).collect();
    }
    let mut left: Vec<Span> = sizes.iter().map(|&x| Span::point(x)).collect();
    for ([from, to], long) in stretched {
        let Some(part) = Span::point(sizes[*to]).over(*long) else { return false };
        left[*from] = left[*from] - part;
    }
    sizes.iter().all(|&x| x > 0.0) && left.iter().all(|left| left.is_positive())
}
