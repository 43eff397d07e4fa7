//! Components that motions stay in for ever only from states without area: of saddle type. Lemma A12 of `docs/proofs/global.md#A12`.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use super::cycle::{MAX_CYCLE, Matrix, landing, within};
use super::graph::Component;
use super::image::{Next, Space};
use crate::chaos::guess::{Guess, Image};
use crate::chaos::law::Side;
use crate::chaos::quad::{Quad, State};
use crate::chaos::vector::{GENERIC, applied, unit};
use crate::number::{Ball, Number, TINY, UNIT, up};

/// Larger components, and those with more groups of boxes, are not tried.
const MOST_BOXES: usize = 40_000;
const MOST_PIECES: usize = 20_000;
/// Components whose images take more work are not tried.
const MOST_WORK: u64 = 2_000_000;
/// Steps by which directions, and lengths, are iterated.
const STEPS: usize = 60;
const POWER_ITERATIONS: usize = 400;
/// Widths of the cones that are tried.
const CONE_WIDTHS: [f64; 9] = [0.0078125, 0.03125, 0.0625, 0.125, 0.25, 0.5, 1.0, 2.0, 4.0];
/// Factor by which cones are wider than needed.
const CONE_MARGIN: f64 = 1.05;

/// The boxes of a component in groups that do not touch each other.
struct Groups<'c> {
    component: &'c Component,
    /// The group of each box, and its column, less whole forcing periods so that those of a group are beside one another.
    group: Vec<usize>,
    lifted: Vec<i64>,
    count: usize,
}

/// The boxes of a group whose motions may have their next impact in a group, on one wall.
struct Piece {
    from: usize,
    to: usize,
    side: Side,
    boxes: Vec<usize>,
}

/// Directions at a group, as columns: the first is stretched.
type Frame = [[f64; 2]; 2];

/// Whether the states of a component that stay in it for ever are proved to have no area, and to be stretched apart. Lemma A12
pub(super) fn is_of_saddle_type(space: &Space, component: &Component) -> bool {
    if component.has_release || component.cells.is_empty() || component.cells.len() > MOST_BOXES {
        return false; // exact: given up, nothing is certified
    }
    let Some(groups) = Groups::of(component) else { return false };
    let Some(pieces) = groups.pieces(space) else { return false };
    if pieces.len() == groups.count && groups.count <= MAX_CYCLE {
        return false; // exact: given up, one periodic motion is proved as such from smaller boxes
    }
    let guess = Guess::new(space.law());
    let Some(images) = pieces.iter().map(|piece| groups.image(&guess, piece)).collect::<Option<Vec<_>>>() else {
        return false; // exact: given up, nothing is certified
    };
    let frames = frames(groups.count, &pieces, &images);
    let derivative = |piece: &Piece| groups.derivative(space, &guess, piece, frames[piece.from]);
    let Some(derivatives) = pieces.iter().map(derivative).collect::<Option<Vec<_>>>() else {
        return false; // exact: not proved
    };
    let widths = widths(groups.count, &pieces, &images, &frames);
    let is_proved = |width: &f64| {
        let frame = |k: usize| frames[k].map(|[along, across]| [along, across * width * widths[k]]);
        let stretched = pieces.iter().zip(&derivatives).map(|(piece, derivative)| {
            let step = within(*derivative, frame(piece.from), frame(piece.to))?;
            Some((piece, stretching(&step)?))
        });
        stretched.collect::<Option<Vec<_>>>().is_some_and(|stretched| vanishes(groups.count, &stretched))
    };
    CONE_WIDTHS.iter().any(is_proved)
}

impl<'c> Groups<'c> {
    /// `None` where one extends over a quarter of a forcing period.
    fn of(component: &'c Component) -> Option<Self> {
        const UNASSIGNED: usize = usize::MAX;
        let columns = component.grid.columns;
        let (mut group, mut lifted) = (vec![UNASSIGNED; component.cells.len()], vec![0; component.cells.len()]);
        let mut count = 0;
        for first in 0..component.cells.len() {
            if group[first] != UNASSIGNED {
                continue;
            }
            let root = i64::from(component.cells[first].0);
            (group[first], lifted[first]) = (count, root);
            let (mut open, mut ends) = (vec![first], [root, root]);
            while let Some(k) = open.pop() {
                let row = component.cells[k].1;
                for (i, j) in (-1..=1).flat_map(|i| (-1..=1).map(move |j| (i, j))) {
                    let at = lifted[k] + i;
                    let cell = (at.rem_euclid(columns) as i32, row + j); // exact: fewer than 2^31
                    if let Ok(beside) = component.cells.binary_search(&cell)
                        && group[beside] == UNASSIGNED
                    {
                        (group[beside], lifted[beside]) = (count, at);
                        ends = [ends[0].min(at), ends[1].max(at)]; // exact: whole numbers
                        open.push(beside);
                    }
                }
            }
            if ends[1] - ends[0] + 1 >= columns / 4 {
                return None; // exact: not proved
            }
            count += 1;
        }
        Some(Self { component, group, lifted, count })
    }

    /// All pieces, from each group to each group; `None` where they are too much work.
    fn pieces(&self, space: &Space) -> Option<Vec<Piece>> {
        let Component { grid, cells, .. } = self.component;
        let columns = self.component.columns();
        let mut found: BTreeMap<(usize, usize, bool), Vec<usize>> = BTreeMap::new();
        let mut work = 0;
        for (from, &cell) in cells.iter().enumerate() {
            work += space.images(*grid, cell, &columns, &mut |next| {
                if let Next::Impact { cell, is_far, .. } = next
                    && let Ok(to) = cells.binary_search(&cell)
                {
                    let boxes = found.entry((self.group[from], self.group[to], is_far)).or_default();
                    if boxes.last() != Some(&from) {
                        boxes.push(from);
                    }
                }
            });
            if found.len() > MOST_PIECES || work > MOST_WORK {
                return None; // exact: given up, nothing is certified
            }
        }
        let piece = |((from, to, is_far), boxes)| {
            let side = if is_far { Side::Far } else { Side::Near };
            Piece { from, to, side, boxes }
        };
        Some(found.into_iter().map(piece).collect())
    }

    /// The corners of a box.
    fn corners(&self, k: usize) -> [State; 4] {
        let (columns, rows) = (self.component.grid.columns as f64, self.component.grid.rows); // exact: powers of two
        let row = self.component.cells[k].1;
        let corner = |i: i64, j: i32| [(self.lifted[k] + i) as f64 / columns, f64::from(row + j) / rows]; // exact: powers of two
        [corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)]
    }

    /// Image of the middle of a piece; `None` where the image is not on the wall of the piece.
    fn image(&self, guess: &Guess, piece: &Piece) -> Option<Image> {
        let middle = self.corners(piece.boxes[piece.boxes.len() / 2]);
        let centre = [0.5 * (middle[0][0] + middle[3][0]), 0.5 * (middle[0][1] + middle[3][1])];
        guess.map(centre).filter(|image| image.side == piece.side)
    }

    /// Holds the derivatives of the map over a parallelogram that holds a piece, all of whose flights land on one wall.
    fn derivative(&self, space: &Space, guess: &Guess, piece: &Piece, frame: Frame) -> Option<Matrix> {
        let quad = self.parallelogram(piece, frame)?;
        let image = guess.map(quad.centre).filter(|image| image.side == piece.side)?;
        landing(space, &quad, image.side, image.state[0] - image.side.shift())
    }

    /// A parallelogram along two directions that holds all boxes of a piece. Lemma A12
    fn parallelogram(&self, piece: &Piece, [[a, b], [c, d]]: Frame) -> Option<Quad> {
        let [along, across] = [[a, c], [b, d]];
        let area = Ball::exact(a) * Ball::exact(d) - Ball::exact(b) * Ball::exact(c);
        let places = |from: State, corner: State| -> Option<[Ball; 2]> {
            let [u, w] = [0, 1].map(|i| Ball::exact(corner[i]) - Ball::exact(from[i]));
            let turned = |[x, y]: State| u * Ball::exact(y) - w * Ball::exact(x);
            Some([turned(across).checked_div(area)?, (-turned(along)).checked_div(area)?])
        };
        let corners = || piece.boxes.iter().flat_map(|&k| self.corners(k));
        let root = corners().next()?;
        let mut ends = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        for corner in corners() {
            let at = places(root, corner)?;
            for i in 0..2 {
                ends[i] = [ends[i][0].min(at[i].mid()), ends[i][1].max(at[i].mid())]; // proposes: the centre
            }
        }
        let [s, t] = ends.map(|[low, high]| 0.5 * (low + high));
        let centre = [0, 1].map(|i| root[i] + s * along[i] + t * across[i]);
        let mut radii = [0.0_f64; 2];
        for corner in corners() {
            let at = places(centre, corner)?;
            radii = [0, 1].map(|i| radii[i].max(at[i].mag())); // A12: the farthest corner
        }
        let sides = [along.map(|x| radii[0] * x), across.map(|x| radii[1] * x)];
        let slack = [0, 1].map(|i| up(8.0 * UNIT * (sides[0][i].abs() + sides[1][i].abs()) + TINY));
        let rows = piece.boxes.iter().map(|&k| self.component.cells[k].1);
        let floor = f64::from(rows.min()?) / self.component.grid.rows; // exact: a power of two
        Some(Quad { centre, sides, twist: [0.0; 2], slack, floor })
    }
}

/// Directions at each group: the first is what the flights before have stretched, the second what those that follow shrink.
fn frames(count: usize, pieces: &[Piece], images: &[Image]) -> Vec<Frame> {
    let (mut along, mut across) = (vec![[0.3 / TAU, 1.0]; count], vec![GENERIC; count]);
    for _ in 0..STEPS {
        let (mut forth, mut back) = (vec![[0.0; 2]; count], vec![[0.0; 2]; count]);
        for (Piece { from, to, .. }, image) in pieces.iter().zip(images) {
            let [[a, b], [c, d]] = image.jacobian;
            add(&mut forth[*to], unit(applied(image.jacobian, along[*from])));
            add(&mut back[*from], unit(applied([[d, -b], [-c, a]], across[*to])));
        }
        (along, across) = (forth.into_iter().map(unit).collect(), back.into_iter().map(unit).collect());
    }
    along.iter().zip(&across).map(|([a, c], [b, d])| [[*a, *b], [*c, *d]]).collect()
}

/// Adds a direction, or its opposite.
fn add(sum: &mut State, [u, w]: State) {
    let same = TAU * sum[0] * (TAU * u) + sum[1] * w >= 0.0; // proposes
    let sign = if same { 1.0 } else { -1.0 };
    *sum = [sum[0] + sign * u, sum[1] + sign * w];
}

/// Widths of cones that are mapped into one another, but for what bends them: each at least what those before it become.
fn widths(count: usize, pieces: &[Piece], images: &[Image], frames: &[Frame]) -> Vec<f64> {
    let rate = |(Piece { from, to, .. }, image): (&Piece, &Image)| {
        let [[a, b], [c, d]] = frames[*to];
        let area = a * d - b * c;
        let [along, across] = [0, 1].map(|i| applied(image.jacobian, [frames[*from][0][i], frames[*from][1][i]]));
        CONE_MARGIN * ((a * across[1] - c * across[0]) / area).abs() / ((d * along[0] - b * along[1]) / area).abs()
    };
    let rates: Vec<f64> = pieces.iter().zip(images).map(rate).collect();
    let mut widths = vec![1.0_f64; count];
    for _ in 0..STEPS {
        for (Piece { from, to, .. }, rate) in pieces.iter().zip(&rates) {
            widths[*to] = widths[*to].max(rate * widths[*from]); // proposes
        }
    }
    widths
}

/// A lower bound of how far the first coordinate of a vector of the cone is stretched; `None` where the cone is not mapped into itself. Lemma A12
fn stretching([[a, b], [c, d]]: &Matrix) -> Option<f64> {
    let long = ((a.mid().abs() - a.rad()).next_down() - b.mag()).next_down();
    let wide = (c.mag() + d.mag()).next_up();
    (long > 0.0 && wide <= long).then_some(long)
}

/// Whether the lengths of the sets that stay for n impacts tend to 0 as n grows: the matrix of the inverse stretching factors has a spectral
/// radius below 1. Lemma A12
fn vanishes(count: usize, stretched: &[(&Piece, f64)]) -> bool {
    let mut lengths = vec![1.0; count];
    let sums = |lengths: &[f64]| {
        let mut sums = vec![0.0; count];
        for (Piece { from, to, .. }, long) in stretched {
            sums[*from] = (sums[*from] + (lengths[*to] / long).next_up()).next_up();
        }
        sums
    };
    for _ in 0..POWER_ITERATIONS {
        let next = sums(&lengths);
        let most = lengths.iter().zip(&next).fold(0.0, |most: f64, (x, y)| most.max(x + y)); // proposes
        lengths = lengths.iter().zip(&next).map(|(x, y)| (x + y) / most).collect();
    }
    lengths.iter().zip(sums(&lengths)).all(|(own, sum)| *own > 0.0 && sum < *own)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn passage(from: usize, to: usize) -> Piece {
        Piece { from, to, side: Side::Far, boxes: Vec::new() }
    }

    /// Of two groups that lead to one another and to themselves the matrix has the spectral radius 2 over what all are stretched by; of a
    /// golden mean shift that is (1 + sqrt 5)/2 over it.
    #[test]
    fn a12_what_stays_vanishes_where_groups_are_few_and_stretched_far() {
        let [all, golden] = [vec![(0, 0), (0, 1), (1, 0), (1, 1)], vec![(0, 0), (0, 1), (1, 0)]]
            .map(|ends| ends.into_iter().map(|(from, to)| passage(from, to)).collect::<Vec<_>>());
        let is_proved =
            |pieces: &[Piece], long: f64| vanishes(2, &pieces.iter().map(|piece| (piece, long)).collect::<Vec<_>>());
        assert!(is_proved(&all, 2.01) && !is_proved(&all, 2.0) && !is_proved(&all, 1.99));
        assert!(is_proved(&golden, 1.62) && !is_proved(&golden, 1.61));
    }

    /// `s' = a s + b t`, `t' = c s + d t` with `|t| <= |s|`: the corners of the cone decide.
    #[test]
    fn a12_cones_are_mapped_into_cones() {
        let of = |rows: [[f64; 2]; 2]| stretching(&rows.map(|row| row.map(Ball::exact)));
        assert!(of([[3.0, 0.5], [1.0, 1.0]]).is_some_and(|long| long <= 2.5 && long > 2.499));
        assert!(of([[-3.0, 0.5], [1.0, -1.0]]).is_some());
        assert_eq!([of([[3.0, 0.5], [2.0, 1.0]]), of([[1.0, 1.5], [0.0, 0.0]])], [None, None]);
    }
}
