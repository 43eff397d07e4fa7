//! Proofs that all motions that stay in a set of boxes tend to a claimed cycle, or graze for ever (Lemma V20, limits).

use super::super::beam::{FlightBundle, Quad, State};
use super::super::guess::{Image, Matrix as Doubles};
use super::super::span::Span;
use super::graph::Set;
use super::space::{Next, Space};

/// A cycle of the map that is proved to exist: one period of it.
#[derive(Clone, Debug)]
pub(super) struct Cycle {
    /// Bounds of phases, in forcing periods and less whole ones, and of speeds.
    pub states: Vec<[Span; 2]>,
}

/// The image of a hull, no wider than a quarter of a forcing period, may be no wider than this. Lemma A8
const MAX_IMAGE_WIDTH: f64 = 0.749;

/// A matrix that holds derivatives.
pub(super) type Matrix = [[Span; 2]; 2];

/// Periods that norms and directions are made from.
const ITERATED_PERIODS: usize = 200;
/// Greatest distance from the state that grazes for ever, in phase \[rad\] and in speed.
const MAX_GRAZING_DISTANCE: f64 = 0.25;

impl Cycle {
    /// Returns whether all motions that stay in a set tend to it, and whether it attracts.
    pub fn is_limit_of(&self, set: &Set, space: &Space<'_>, attracts: bool) -> bool {
        let middles: Vec<State> = self.states.iter().map(|state| state.map(Span::mid)).collect();
        let images: Option<Vec<Image>> = middles.iter().map(|&state| space.guess.map(state)).collect();
        let Some(images) = images.filter(|_| !set.has_release) else { return false };
        let count = middles.len();
        let classes: Vec<usize> = set.cells.iter().map(|&cell| nearest(set, &middles, cell)).collect();
        let Some(hulls) = (0..count).map(|k| hull(set, &classes, (k, middles[k]))).collect::<Option<Vec<_>>>() else {
            return false;
        };
        let rectangle = |[low, high]: [State; 2]| Quad::rectangle(low, high);
        let holds = |(state, [low, high]): (&[Span; 2], &[State; 2])| {
            (0..2).all(|i| low[i] <= state[i].lo() && state[i].hi() <= high[i]) // V20: the cycle is in the hulls
        };
        let derivatives: Option<Vec<Matrix>> =
            (0..count).map(|k| derivative(space, &rectangle(hulls[k]), &images[k], Some(middles[k]))).collect();
        let Some(derivatives) = derivatives.filter(|_| self.states.iter().zip(&hulls).all(holds)) else { return false };
        let frames = if attracts { norms(&images) } else { directions(&images) };
        let steps: Option<Vec<Matrix>> =
            (0..count).map(|k| within(derivatives[k], frames[k], frames[(k + 1) % count])).collect();
        let Some(steps) = steps else { return false };
        let tends = if attracts { contracts(&steps) } else { has_cones(&steps) };
        tends && leads_on(set, space, &classes, count)
    }
}

/// Returns whether motions that stay in the set go from each class of boxes to the next one.
fn leads_on(set: &Set, space: &Space<'_>, classes: &[usize], count: usize) -> bool {
    set.cells.iter().zip(classes).all(|(&cell, &class)| {
        let mut is_next = true;
        space.follows(set.grid, cell, &mut |next| {
            if let Next::Impact { cell, .. } = next
                && let Ok(to) = set.cells.binary_search(&cell)
            {
                is_next &= classes[to] == (class + 1) % count;
            }
        });
        is_next
    })
}

/// The state that is the nearest to a box.
fn nearest(set: &Set, states: &[State], cell: [i64; 2]) -> usize {
    let [low, high] = Space::corners(set.grid, cell);
    let away = |&state: &State| {
        let apart = 0.5 * (low[0] + high[0]) - state[0];
        (std::f64::consts::TAU * (apart - apart.round())).hypot(0.5 * (low[1] + high[1]) - state[1]) // proposes: any class
    };
    let nearer = |&i: &usize, &j: &usize| away(&states[i]).total_cmp(&away(&states[j]));
    (0..states.len()).min_by(nearer).unwrap_or(0) // proposes: any class
}

/// The corners of the hull of a class's boxes, with phases near that of its state; `None` if it has none, or they are far apart.
fn hull(set: &Set, classes: &[usize], (class, state): (usize, State)) -> Option<[State; 2]> {
    let mut all: Option<[State; 2]> = None;
    for (&cell, _) in set.cells.iter().zip(classes).filter(|(_, own)| **own == class) {
        let [mut low, mut high] = Space::corners(set.grid, cell);
        let turns = (0.5 * (low[0] + high[0]) - state[0]).round(); // V20: any whole number of forcing periods
        (low[0], high[0]) = (low[0] - turns, high[0] - turns); // V20: whole forcing periods, exact
        let [least, most] = all.unwrap_or([low, high]); // V20: the hull of one
        // V20: the outer corners
        all = Some([[least[0].min(low[0]), least[1].min(low[1])], [most[0].max(high[0]), most[1].max(high[1])]]);
    }
    all.filter(|[low, high]| high[0] - low[0] < 0.25)
}

/// Holds the derivatives of the map in a quadrilateral whose flights all land on one wall, after about the time of a state's, if one is given, or
/// that of its middle.
pub(super) fn derivative(space: &Space<'_>, quad: &Quad, image: &Image, state: Option<State>) -> Option<Matrix> {
    let beam = FlightBundle::new(space.law, quad);
    let guess = image.time + state.map_or(0.0, |state| state[0] - quad.middle()[0]);
    let landing = beam.land(image.is_far, image.time).or_else(|| beam.land(image.is_far, guess))?;
    let [zero, one] = [0.0, 1.0].map(Span::point);
    let image = landing.along([one, zero], [zero, zero]);
    if image.hi() - image.lo() > MAX_IMAGE_WIDTH {
        return None; // V20: not proved
    }
    let [[a, c], [b, d]] = [landing.derivative([one, zero]), landing.derivative([zero, one])];
    Some([[a, b], [c, d]])
}

fn times(a: Doubles, b: Doubles) -> Doubles {
    [0, 1].map(|i| [0, 1].map(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j]))
}

fn transposed([[a, b], [c, d]]: Doubles) -> Doubles {
    [[a, c], [b, d]]
}

/// The period's derivative's greatest modulus of eigenvalues, about.
fn radius(images: &[Image]) -> f64 {
    let product = images.iter().fold([[1.0, 0.0], [0.0, 1.0]], |product, image| times(image.jacobian, product));
    let (trace, determinant) =
        (product[0][0] + product[1][1], product[0][0] * product[1][1] - product[0][1] * product[1][0]);
    let under = 0.25 * trace * trace - determinant;
    if under > 0.0 { 0.5 * trace.abs() + under.sqrt() } else { determinant.abs().sqrt() }
}

/// Inverse bases at each state in whose coordinates a period contracts: the roots of the sums of all squares of what its derivatives make of
/// a vector, weighted.
fn norms(images: &[Image]) -> Vec<Doubles> {
    let weight = (0.5 * (1.0 + radius(images).min(1.0))).powf(-2.0 / images.len() as f64); // proposes
    let (mut square, mut frames) = ([[1.0, 0.0], [0.0, 1.0]], Vec::new());
    for round in 0..ITERATED_PERIODS {
        for image in images.iter().rev() {
            let inner = times(transposed(image.jacobian), times(square, image.jacobian));
            square = [0, 1].map(|i| [0, 1].map(|j| if i == j { 1.0 } else { 0.0 } + weight * inner[i][j]));
            if round + 1 == ITERATED_PERIODS {
                // Cholesky's root, upper triangular.
                let a = square[0][0].sqrt();
                let b = square[0][1] / a;
                frames.push([[a, b], [0.0, (square[1][1] - b * b).sqrt()]]);
            }
        }
    }
    frames.reverse();
    frames
}

/// Inverse bases at each state of a saddle: the expanding and the contracting direction, in steps that expand alike.
fn directions(images: &[Image]) -> Vec<Doubles> {
    let apply = |m: &Doubles, [u, w]: State| [m[0][0] * u + m[0][1] * w, m[1][0] * u + m[1][1] * w];
    let unit = |[u, w]: State| [u / u.hypot(w), w / u.hypot(w)];
    let (mut forth, mut back) = ([0.3, 1.0], [1.0, 0.2]);
    for _ in 0..ITERATED_PERIODS {
        forth = images.iter().fold(forth, |vector, image| unit(apply(&image.jacobian, vector)));
        back = images.iter().rev().fold(back, |vector, image| {
            let [[a, b], [c, d]] = image.jacobian;
            unit(apply(&[[d, -b], [-c, a]], vector))
        });
    }
    let size = |[u, w]: State| u.hypot(w);
    let grown = |vector| size(images.iter().fold(vector, |vector, image| apply(&image.jacobian, vector)));
    let rates = [forth, back].map(|vector| grown(vector).powf(-1.0 / images.len() as f64)); // proposes
    let mut frames = Vec::new();
    for image in images {
        let base = [[forth[0], back[0]], [forth[1], back[1]]];
        let area = base[0][0] * base[1][1] - base[0][1] * base[1][0];
        frames.push([[base[1][1] / area, -base[0][1] / area], [-base[1][0] / area, base[0][0] / area]]);
        forth = apply(&image.jacobian, forth).map(|x| x * rates[0]);
        back = apply(&image.jacobian, back).map(|x| x * rates[1]);
    }
    frames
}

/// A derivative from the coordinates at one state to those at the next one: `R A Q` with `y = R x` there and `x = P^-1 y` here. The inverse here
/// is formed in intervals, so that both are of one base.
pub(super) fn within(derivative: Matrix, from: Doubles, to: Doubles) -> Option<Matrix> {
    let [[a, b], [c, d]] = from.map(|row| row.map(Span::point));
    let area = a * d - b * c;
    let product =
        |x: Matrix, y: Matrix| -> Matrix { [0, 1].map(|i| [0, 1].map(|j| x[i][0] * y[0][j] + x[i][1] * y[1][j])) };
    let [p, q] = product(product(to.map(|row| row.map(Span::point)), derivative), [[d, -b], [-c, a]]);
    let over = |x: Span| x.over(area);
    Some([[over(p[0])?, over(p[1])?], [over(q[0])?, over(q[1])?]])
}

/// Returns whether the product of the squares of their norms is below 1: the greater eigenvalue of `M'M` is at most its trace less its
/// determinant over the trace.
fn contracts(steps: &[Matrix]) -> bool {
    let mut all = Span::point(1.0);
    for [[a, b], [c, d]] in steps {
        let trace = *a * *a + *b * *b + *c * *c + *d * *d;
        let determinant = *a * *d - *b * *c;
        let Some(least) = (determinant * determinant).over(trace) else { return false };
        all = all * (trace - least);
    }
    (Span::point(1.0) - all).is_positive()
}

/// Returns whether cones about the first direction are mapped into themselves and stretched, and the other direction shrinks.
fn has_cones(steps: &[Matrix]) -> bool {
    let (mut stretched, mut shrunk) = (Span::point(1.0), Span::point(1.0));
    for step in steps {
        let (long, short) = cone(step);
        if !((long - short).lo() >= 0.0 && long.is_positive()) {
            return false; // V20: not proved
        }
        (stretched, shrunk) = (stretched * long, shrunk * short);
    }
    (stretched - Span::point(1.0)).is_positive() && (Span::point(1.0) - shrunk).is_positive()
}

/// Bounds of how long the first coordinate of a vector of the cone becomes at least, and the second one at most.
pub(super) fn cone([[a, b], [c, d]]: &Matrix) -> (Span, Span) {
    let size = |x: &Span| {
        let most = Span::point(x.most());
        let least = if x.is_positive() {
            x.lo()
        } else if x.is_negative() {
            -x.hi()
        } else {
            0.0
        };
        (Span::point(least), most)
    };
    (size(a).0 - size(b).1, size(c).1 + size(d).1)
}

/// Returns whether motions that stay in a set graze for ever. Lemma A9
pub(super) fn grazes(set: &Set, space: &Space<'_>) -> bool {
    let is_near = |&cell: &[i64; 2]| {
        let [low, high] = Space::corners(set.grid, cell);
        let away = (Span::new(low[0], high[0]) - Span::point(0.25)).turned().most();
        away <= MAX_GRAZING_DISTANCE && high[1] <= MAX_GRAZING_DISTANCE
    };
    let crosses = |&cell: &[i64; 2]| {
        let mut crosses = false;
        space.follows(set.grid, cell, &mut |next| {
            if let Next::Impact { cell, is_far: true, .. } = next {
                crosses |= set.cells.binary_search(&cell).is_ok();
            }
        });
        crosses
    };
    !set.has_release && set.cells.iter().all(is_near) && !set.cells.iter().any(crosses)
}
