//! The periodic motion that all motions of a component tend to: proposed in floating point, proved over the hull of the component. Lemma A8
//! of `docs/proofs/global.md#A8`.

use std::f64::consts::TAU;

use super::graph::Component;
use super::image::{Next, Space, ends};
use crate::chaos::flights::Flights;
use crate::chaos::guess::{Guess, Image};
use crate::chaos::law::Side;
use crate::chaos::quad::{Quad, State};
use crate::chaos::vector::{apart, applied, in_period, length, minus, times, unit};
use crate::number::{Ball, Number};

/// A cycle of the reduced map that all motions that stay in a component tend to.
#[derive(Clone, Debug)]
pub(super) struct Limit {
    /// Approximate states, phases in `[0, 1)`, and the walls that the flights from them end on.
    pub states: Vec<State>,
    pub sides: Vec<Side>,
    /// Rectangles around them, of phases and of speeds: the hull of the boxes near each.
    pub hulls: Vec<[[f64; 2]; 2]>,
    /// `true` if all motions that begin near it tend to it; else it is a saddle.
    pub attracts: bool,
}

/// The longest cycle that is looked for, in impacts of the reduced map.
pub(super) const MAX_CYCLE: usize = 24;
/// Boxes from whose centres cycles are looked for.
const SEEDS: usize = 6;
/// Impacts before an orbit is looked at.
const TRANSIENT: usize = 500;
/// Steps of Newton's iteration, when it has ended, and how near a cycle that closes is.
const STEPS: usize = 12;
const STEP_TOLERANCE: f64 = 1e-11;
const RETURN_DISTANCE: f64 = 1e-6;
/// Half of the greatest width of the image of a hull, in forcing periods: less than three quarters. Lemma A8
const MAX_HALF_WIDTH: f64 = 0.374;
/// Larger components are not tried.
const MOST_BOXES: usize = 20_000;

/// A matrix that holds derivatives.
pub(super) type Matrix = [[Ball; 2]; 2];

/// Proves the cycle that all motions of a component tend to; `None` where none is found, or nothing is proved.
pub(super) fn limit(space: &Space, component: &Component) -> Option<Limit> {
    if component.has_release || component.cells.is_empty() || component.cells.len() > MOST_BOXES {
        return None; // exact: given up, nothing is certified
    }
    let guess = Guess::new(space.law());
    let every = component.cells.len().div_ceil(SEEDS);
    let mut known: Vec<Vec<State>> = Vec::new();
    for &cell in component.cells.iter().step_by(every) {
        let seed = component.grid.quad(cell).centre;
        for cycle in proposals(&guess, seed, component.cells.len()) {
            let is_new = known.iter().all(|other| !is_one(other, &cycle));
            if is_new && cycle.iter().all(|&state| component.is_near(state)) {
                if let Some(limit) = proved(space, &guess, component, &cycle) {
                    return Some(limit);
                }
                known.push(cycle);
            }
        }
    }
    None
}

/// The cycles that floating point finds from a state: that of its orbit, and those of Newton's iteration, each of no more impacts than there are
/// boxes.
fn proposals(guess: &Guess, seed: State, boxes: usize) -> Vec<Vec<State>> {
    let longest = boxes.min(MAX_CYCLE); // proposes
    let settled = (0..TRANSIENT).try_fold(seed, |state, _| Some(in_period(guess.map(state)?.state)));
    let own = settled.and_then(|state| (1..=longest).find_map(|n| closed(guess, state, n)));
    own.into_iter().chain((1..=longest).filter_map(|n| closed(guess, seed, n))).collect()
}

/// Proposes the cycle of `impacts` impacts near a state, by Newton's iteration.
pub(in crate::chaos) fn closed(guess: &Guess, seed: State, impacts: usize) -> Option<Vec<State>> {
    let mut state = seed;
    for _ in 0..STEPS {
        let (mut at, mut product) = (state, [[1.0, 0.0], [0.0, 1.0]]);
        let mut states = Vec::with_capacity(impacts);
        for _ in 0..impacts {
            states.push(in_period(at));
            let image = guess.map(at)?;
            product = times(image.jacobian, product);
            at = image.state;
        }
        let miss = [at[0] - state[0] - (at[0] - state[0]).round(), at[1] - state[1]]; // proposes
        let size = length(miss);
        if size < STEP_TOLERANCE {
            let shortest =
                (1..impacts).all(|n| apart(states[n], states[0]) > RETURN_DISTANCE || !impacts.is_multiple_of(n));
            return shortest.then_some(states);
        }
        let [[a, b], [c, d]] = [[product[0][0] - 1.0, product[0][1]], [product[1][0], product[1][1] - 1.0]];
        let area = a * d - b * c;
        state = [state[0] - (d * miss[0] - b * miss[1]) / area, state[1] - (a * miss[1] - c * miss[0]) / area];
        if !(state[0].is_finite() && state[1] > 0.0) || length(minus(state, seed)) > 1.0 {
            return None;
        }
    }
    None
}

impl Component {
    /// Whether a state is in one of the component's boxes, or in a box beside one.
    pub(super) fn is_near(&self, [phase, speed]: State) -> bool {
        let (column, row) = self.grid.cell(phase, speed);
        let columns = self.grid.columns as i32; // exact: fewer than 2^31
        let beside = |i: i32, j: i32| self.cells.binary_search(&((column + i).rem_euclid(columns), row + j)).is_ok();
        (-1..=1).any(|i| (-1..=1).any(|j| beside(i, j)))
    }
}

/// Whether two cycles are the same in floating point, from whichever state on.
fn is_one(one: &[State], other: &[State]) -> bool {
    one.len() == other.len() && other.iter().any(|state| apart(*state, one[0]) < RETURN_DISTANCE)
}

/// Proves that all motions that stay in a component tend to a cycle. Lemma A8
fn proved(space: &Space, guess: &Guess, component: &Component, states: &[State]) -> Option<Limit> {
    let count = states.len();
    let images: Vec<Image> = states.iter().map(|&state| guess.map(state)).collect::<Option<_>>()?;
    let classes: Vec<usize> = component.cells.iter().map(|&cell| nearest(component, states, cell)).collect();
    let hulls = hulls(component, states, &classes)?;
    let derivatives =
        (0..count).map(|i| derivative(space, &hulls[i], states[i], &images[i])).collect::<Option<Vec<_>>>()?;
    let [eigenvectors, orthogonal] = [frames(&images, first_columns(&images)?), frames(&images, orthogonal(&images)?)];
    let in_frames = |frames: Option<Vec<[[f64; 2]; 2]>>| -> Option<Vec<Matrix>> {
        let frames = frames?;
        (0..count).map(|i| within(derivatives[i], frames[i], frames[(i + 1) % count])).collect()
    };
    let steps = [in_frames(eigenvectors), in_frames(orthogonal)];
    let attracts = steps.iter().flatten().any(|steps| is_contraction(steps));
    if !attracts && !steps.iter().flatten().any(|steps| is_saddle(steps)) {
        return None; // exact: not proved
    }
    // A8: whatever stays goes from each class to the next one
    let columns = component.columns();
    for (&cell, &class) in component.cells.iter().zip(&classes) {
        let mut is_next = true;
        _ = space.images(component.grid, cell, &columns, &mut |next| {
            if let Next::Impact { cell, .. } = next
                && let Ok(to) = component.cells.binary_search(&cell)
            {
                is_next &= classes[to] == (class + 1) % count;
            }
        });
        if !is_next {
            return None; // exact: not proved
        }
    }
    let sides = images.iter().map(|image| image.side).collect();
    Some(Limit { states: states.to_vec(), sides, hulls, attracts })
}

/// The state of a cycle that is the nearest to a box.
fn nearest(component: &Component, states: &[State], cell: (i32, i32)) -> usize {
    let centre = component.grid.quad(cell).centre;
    let by_distance = |&i: &usize, &j: &usize| apart(states[i], centre).total_cmp(&apart(states[j], centre));
    (0..states.len()).min_by(by_distance).unwrap_or(0) // proposes: any class will do
}

/// Hull of the boxes of each class, with phases near its state's; `None` where a class has no boxes, or all phases.
fn hulls(component: &Component, states: &[State], classes: &[usize]) -> Option<Vec<[[f64; 2]; 2]>> {
    let (columns, rows) = (component.grid.columns, component.grid.rows);
    let hull = |class: usize| {
        let middle = (states[class][0] * columns as f64).floor() as i64; // A8: phases are counted from any column
        let own = component.cells.iter().zip(classes).filter(|(_, own)| **own == class);
        let places = own.map(|(&(column, row), _)| {
            let ahead = (i64::from(column) - middle + columns / 2).rem_euclid(columns) - columns / 2;
            (middle + ahead, i64::from(row))
        });
        let [least, most] =
            places.fold([(i64::MAX, i64::MAX), (i64::MIN, i64::MIN)], |[least, most], (column, row)| {
                [(least.0.min(column), least.1.min(row)), (most.0.max(column), most.1.max(row))] // A8: the hull
            });
        let is_local = least.0 <= most.0 && most.0 - least.0 < columns / 4;
        let at = |place: i64, per: f64| place as f64 / per; // exact: powers of two
        let phases = [at(least.0, columns as f64), at(most.0.saturating_add(1), columns as f64)]; // exact: powers of two
        is_local.then(|| [phases, [at(least.1, rows), at(most.1 + 1, rows)]])
    };
    (0..states.len()).map(hull).collect()
}

/// The derivatives of the map in a hull, all of whose flights land on one wall.
fn derivative(space: &Space, [phases, speeds]: &[[f64; 2]; 2], state: State, image: &Image) -> Option<Matrix> {
    let middle = |[low, high]: [f64; 2]| 0.5 * (low + high); // exact: multiples of a power of two
    let radius = |[low, high]: [f64; 2]| 0.5 * (high - low); // exact: multiples of a power of two
    let quad = Quad::rectangle([middle(*phases), middle(*speeds)], [radius(*phases), radius(*speeds)], speeds[0]);
    let turned = (middle(*phases) - state[0]).round(); // proposes: where it lands
    landing(space, &quad, image.side, image.state[0] - image.side.shift() + turned)
}

/// Encloses the derivatives of the map in a quadrilateral all of whose flights land on one wall, within three quarters of a forcing period about
/// the given phase. Lemma A8
pub(super) fn landing(space: &Space, quad: &Quad, side: Side, about: f64) -> Option<Matrix> {
    let landing = Flights::new(space.law(), quad).land(side, about)?;
    let [zero, one] = [0.0, 1.0].map(Ball::exact);
    if landing.along([one, zero], [zero, zero]).rad() > MAX_HALF_WIDTH {
        return None; // exact: not proved
    }
    let [[a, c], [b, d]] = [landing.derivative([one, zero]), landing.derivative([zero, one])];
    Some([[a, b], [c, d]])
}

/// Two directions at the first state of a cycle, and the factors by which a period stretches them, about.
type Columns = ([State; 2], [f64; 2]);

/// Eigenvectors, or the real and the imaginary part of one.
fn first_columns(images: &[Image]) -> Option<Columns> {
    let [[a, b], [c, d]] = period(images);
    let (half, determinant) = (0.5 * (a + d), a * d - b * c);
    let under = half * half - determinant;
    let vector = |x: f64| if b.abs() > c.abs() { [b, x - a] } else { [x - d, c] };
    let (columns, factors) = if under > 0.0 {
        let root = half + under.sqrt().copysign(half);
        let other = determinant / root;
        ([unit(vector(root)), unit(vector(other))], [root.abs(), other.abs()])
    } else {
        let (imaginary, radius) = ((-under).sqrt(), determinant.abs().sqrt());
        let second = if b.abs() > c.abs() { [0.0, imaginary] } else { [imaginary, 0.0] };
        let size = length(vector(half)).max(length(second)); // proposes
        ([vector(half), second].map(|column| column.map(|x| x / size)), [radius, radius])
    };
    Some((columns, factors))
}

/// An eigenvector and a short vector across it, for eigenvalues that are about equal.
fn orthogonal(images: &[Image]) -> Option<Columns> {
    let [[a, b], [c, d]] = period(images);
    let (half, determinant) = (0.5 * (a + d), a * d - b * c);
    let root = half + (half * half - determinant).max(0.0).sqrt().copysign(half); // proposes
    let vector = if b.abs() > c.abs() { [b, root - a] } else { [root - d, c] };
    let [u, w] = if length(vector) > 0.0 { unit(vector) } else { [1.0 / TAU, 0.0] };
    let radius = determinant.abs().sqrt();
    let across = [-w / TAU, u * TAU];
    // So short that what a period shears it by is less than what is left of 1.
    let sheared = length(applied([[a, b], [c, d]], across));
    let short = (0.25 * (1.0 - radius) / sheared).min(1.0); // proposes
    Some(([[u, w], across.map(|x| x * short)], [radius, radius]))
}

/// The derivative of a period.
fn period(images: &[Image]) -> [[f64; 2]; 2] {
    images.iter().fold([[1.0, 0.0], [0.0, 1.0]], |product, image| times(image.jacobian, product))
}

/// Bases at each state of a cycle: two directions and their images, shortened alike at each impact, as columns.
fn frames(images: &[Image], (mut columns, factors): Columns) -> Option<Vec<[[f64; 2]; 2]>> {
    let per_impact = factors.map(|factor| factor.powf(1.0 / images.len() as f64)); // proposes
    let mut frames = Vec::with_capacity(images.len());
    for image in images {
        frames.push([[columns[0][0], columns[1][0]], [columns[0][1], columns[1][1]]]);
        columns = [0, 1].map(|k| applied(image.jacobian, columns[k]).map(|x| x / per_impact[k]));
    }
    frames.iter().flatten().flatten().all(|x| x.is_finite()).then_some(frames)
}

/// A derivative in the coordinates of two frames.
pub(super) fn within(derivative: Matrix, from: [[f64; 2]; 2], to: [[f64; 2]; 2]) -> Option<Matrix> {
    let from = from.map(|row| row.map(Ball::exact));
    let [[a, b], [c, d]] = to.map(|row| row.map(Ball::exact));
    let area = a * d - b * c;
    let inverse = [[d, -b], [-c, a]];
    let product =
        |x: Matrix, y: Matrix| -> Matrix { [0, 1].map(|i| [0, 1].map(|j| x[i][0] * y[0][j] + x[i][1] * y[1][j])) };
    let [[p, q], [r, s]] = product(inverse, product(derivative, from));
    let over = |x: Ball| x.checked_div(area);
    Some([[over(p)?, over(q)?], [over(r)?, over(s)?]])
}

/// Whether the product of bounds of the spectral norms is less than 1. Lemma A8
fn is_contraction(steps: &[Matrix]) -> bool {
    let norm = |[[a, b], [c, d]]: &Matrix| {
        let squares = *a * *a + *b * *b + *c * *c + *d * *d;
        let determinant = *a * *d - *b * *c;
        let apart = ends(squares * squares - determinant * determinant * Ball::exact(4.0))[1].max(0.0); // A8: it is not negative
        let root = (apart.sqrt()).next_up();
        ((0.5 * (ends(squares)[1] + root).next_up()).sqrt()).next_up()
    };
    steps.iter().fold(1.0, |product: f64, step| (product * norm(step)).next_up()) < 1.0
}

/// Whether cones about the first direction are mapped into themselves and stretched, and the second direction is contracted. Lemma A8
fn is_saddle(steps: &[Matrix]) -> bool {
    let (mut stretched, mut shrunk) = (1.0_f64, 1.0_f64);
    for [[a, b], [c, d]] in steps {
        let long = ((a.mid().abs() - a.rad()).next_down() - b.mag()).next_down();
        let short = (c.mag() + d.mag()).next_up();
        if !(long > 0.0 && short <= long) {
            return false; // A8: not proved
        }
        stretched = (stretched * long).next_down();
        shrunk = (shrunk * short).next_up();
    }
    stretched > 1.0 && shrunk < 1.0
}
