//! Domains in which the series of a manifold converges, and bounds of them there: Lemmas J2 and J3 of `docs/proofs/tangency.md#J3`.

use std::cmp::Ordering;

use super::disc::Disc;
use super::flight::{Pair, Parameter, sin_cos};
use super::saddle::{Guessed, Side};
use crate::chaos::Side as Wall;
use crate::number::{Ball, Number};
use crate::periodic::bifurcation::Jet;

/// A manifold is analytic for complex `|sigma| <= radius`, and complex `D` and `e` within these reaches of a pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct Local {
    pub radius: f64,
    pub pair: Pair<f64>,
    pub reach: Pair<f64>,
    /// Bounds, over this domain, of the distances of phase and speed from those of the fixed point.
    pub size: [f64; 2],
    /// Phase of the fixed point, and the eigenvalue: each is unique in its disc.
    pub fixed: Ball,
    pub eigenvalue: Ball,
}

type Vector = [Disc; 2];
type Matrix = [Vector; 2];

fn exact(x: f64) -> Disc {
    Disc::from_f64(x)
}

/// The disc around 0.
fn around(radius: f64) -> Disc {
    Disc::new(Ball::new(0.0, radius))
}

fn times(a: &Matrix, b: &Matrix) -> Matrix {
    [0, 1].map(|i| [0, 1].map(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j]))
}

fn applied(a: &Matrix, x: &Vector) -> Vector {
    [0, 1].map(|i| a[i][0] * x[0] + a[i][1] * x[1])
}

fn inverse([[a, b], [c, d]]: &Matrix) -> Option<Matrix> {
    let determinant = *a * *d - *b * *c;
    let over = |x: Disc| x.checked_div(determinant);
    Some([[over(*d)?, over(-*b)?], [over(-*c)?, over(*a)?]])
}

/// Matrix of the centres.
fn centres(a: &Matrix) -> Matrix {
    a.map(|row| row.map(|x| exact(x.ball().mid())))
}

/// An upper bound of a sum of sizes.
fn sum(terms: &[f64]) -> f64 {
    terms.iter().fold(Ball::exact(0.0), |sum, x| sum + Ball::exact(*x)).mag()
}

/// The larger of two numbers; NaN where one is.
fn larger([a, b]: [f64; 2]) -> f64 {
    if a > b {
        a
    } else if b >= a {
        b
    } else {
        f64::NAN
    }
}

/// An upper bound of a product of sizes.
fn product(a: f64, b: f64) -> f64 {
    (Ball::exact(a) * Ball::exact(b)).mag()
}

/// The zero of a function of one variable in a disc, for all parameters. Lemma J2
fn zero(centre: f64, f: impl Fn(Jet<Disc>) -> Option<Jet<Disc>>) -> Option<Disc> {
    const TRIES: u32 = 8;
    let there = f(Jet::variable(exact(centre)))?;
    let inverse = exact(1.0 / there.slope.ball().mid());
    let miss = (inverse * there.value).mag();
    let mut radius = 1.5 * miss;
    for _ in 0..TRIES {
        let all = exact(centre) + around(radius);
        let spread = (exact(1.0) - inverse * f(Jet::variable(all))?.slope).mag();
        if sum(&[miss, product(spread, radius)]) < radius {
            return Some(all);
        }
        radius *= 1.5;
    }
    None
}

/// The fixed point and its eigenvectors, over a disc of `D`.
struct Frame {
    pair: Pair<Disc>,
    /// A point near the fixed point, and a matrix whose columns are about its eigenvectors.
    origin: [f64; 2],
    matrix: Matrix,
    /// The fixed point and the eigenvector, in these coordinates.
    fixed: Vector,
    direction: Vector,
    /// `L`
    shrinks: Disc,
    side: Side,
    /// Discs in which there is one fixed point, and one eigenvalue.
    phase: Disc,
    eigenvalue: Disc,
}

impl Frame {
    fn new(pair: Pair<Disc>, guess: &Guessed, side: Side) -> Option<Self> {
        let Pair { gap, restitution: e } = pair;
        let one = exact(1.0);
        let half = gap.turn() * exact(0.5);
        let kappa = (half * (one + e)).checked_div(one - e)?;
        let constant = Jet::constant;
        let theta = zero(guess.theta, |theta| {
            let (sin, cos) = sin_cos(&theta)?;
            Some(constant(kappa) * cos + Jet::from_f64(2.0) * sin - constant(gap))
        })?;
        let (sin, cos) = sin_cos(&theta)?;
        let speed = (exact(2.0) * cos).checked_div(one - e)?;
        let trace = exact(2.0) * e + (one - e) * (one + e) * half * exact(0.5) * sin.checked_div(cos)?;
        let lambda = |guess: f64| zero(guess, |x| Some(x * (x - constant(trace)) + constant(e * e)));
        let slope = |lambda: Disc| (-(sin * (one + lambda))).checked_div(lambda - e);
        let [unstable, stable] = [lambda(guess.lambda[0])?, lambda(guess.lambda[1])?];
        let [across, along] = [slope(unstable)?, slope(stable)?];
        let middle = |x: Disc| exact(x.ball().mid());
        let matrix = [[one, one], [middle(across), middle(along)]];
        let inverse = inverse(&matrix)?;
        let (direction, shrinks, eigenvalue) = match side {
            Side::Unstable => (across, one.checked_div(unstable)?, unstable),
            Side::Stable => (along, stable, stable),
        };
        let origin = [theta.ball().mid(), speed.ball().mid()];
        let fixed = applied(&inverse, &[theta - exact(origin[0]), speed - exact(origin[1])]);
        let direction = applied(&inverse, &[one, direction]);
        Some(Self { pair, origin, matrix, fixed, direction, shrinks, side, phase: theta, eigenvalue })
    }

    /// `g` and its derivatives in the coordinates of the states before and after a flight, over polydiscs.
    fn flights(&self, before: [f64; 2], after: [f64; 2]) -> Option<(Vector, Matrix, Matrix)> {
        let gap = Jet::constant(self.pair.gap);
        let pair = Pair { gap, restitution: Jet::constant(self.pair.restitution) };
        let state = |radii: [f64; 2], turns: f64| {
            let moved = applied(&self.matrix, &radii.map(around));
            let turned = self.pair.gap.turn() * exact(turns);
            [exact(self.origin[0]) + turned + moved[0], exact(self.origin[1]) + moved[1]]
        };
        let (x, y) = (state(before, 0.0), state(after, 1.0));
        let column = |k: usize| [self.matrix[0][k], self.matrix[1][k]];
        let zero = [exact(0.0); 2];
        let jets = |at: Vector, by: Vector| [0, 1].map(|i| Jet { value: at[i], slope: by[i] });
        let along = |by: Vector, to: Vector| pair.miss(&jets(x, by), &jets(y, to), Wall::Far);
        let columns = |a: [Jet<Disc>; 2], b: [Jet<Disc>; 2]| [0, 1].map(|i| [a[i].slope, b[i].slope]);
        let first = along(column(0), zero)?;
        let by_start = columns(first, along(column(1), zero)?);
        let by_end = columns(along(zero, column(0))?, along(zero, column(1))?);
        Some((first.map(|x| x.value), by_start, by_end))
    }

    /// Encloses `Q^-1 DF^(+-1) Q` over the polydisc of this radius. Lemma J2
    fn derivative(&self, radius: f64) -> Option<Matrix> {
        const TRIES: u32 = 6;
        let known = |found: (Vector, Matrix, Matrix)| match self.side {
            Side::Unstable => found,
            Side::Stable => (found.0, found.2, found.1),
        };
        let over = |own: f64, other: [f64; 2]| {
            let flights = match self.side {
                Side::Unstable => self.flights([own; 2], other),
                Side::Stable => self.flights(other, [own; 2]),
            };
            flights.map(known)
        };
        let (miss, by_known, by_unknown) = over(0.0, [0.0; 2])?;
        let preconditioner = centres(&inverse(&centres(&by_unknown))?);
        let miss = applied(&preconditioner, &miss).map(Disc::mag);
        let guess = times(&preconditioner, &by_known);
        let mut radii = [0, 1].map(|i| 1.1 * (miss[i] + radius * (guess[i][0].mag() + guess[i][1].mag())));
        for _ in 0..TRIES {
            let (_, by_known, by_unknown) = over(radius, radii)?;
            let [known, unknown] = [by_known, by_unknown].map(|slopes| times(&preconditioner, &slopes));
            let needs = [0, 1].map(|i| {
                let rest = [0, 1].map(|j| exact(if i == j { 1.0 } else { 0.0 }) - unknown[i][j]);
                let by = |row: Vector, radii: [f64; 2]| [0, 1].map(|j| product(row[j].mag(), radii[j]));
                let ([a, b], [c, d]) = (by(known[i], [radius; 2]), by(rest, radii));
                sum(&[miss[i], a, b, c, d])
            });
            if needs[0] < radii[0] && needs[1] < radii[1] {
                let slopes = times(&inverse(&unknown)?, &known);
                return Some(slopes.map(|row| row.map(|x| -x)));
            }
            radii = needs.map(|need| 1.1 * need);
        }
        None
    }

    /// Bounds of phase and speed for `|sigma| <= radius`. Lemma J3
    fn size(&self, radius: f64) -> Option<[f64; 2]> {
        const TRIES: u32 = 6;
        let shrinks = self.shrinks.mag();
        let square = product(shrinks, shrinks);
        let needs = |rest: f64| {
            let need = |i: usize| {
                let along = product(self.direction[i].mag(), product(shrinks, radius));
                sum(&[self.fixed[i].mag(), along, product(rest, square)])
            };
            [need(0), need(1)]
        };
        let mut rest = 0.25 * radius;
        for _ in 0..TRIES {
            let slopes = self.derivative(larger(needs(rest)))?;
            let norms = slopes.map(|row| sum(&[row[0].mag(), row[1].mag()]));
            let contracts = product(larger(norms), square);
            // A NaN is refused as well.
            if contracts.partial_cmp(&1.0) != Some(Ordering::Less) {
                return None;
            }
            let moved = applied(&slopes, &self.direction);
            let misses = [0, 1].map(|i| (moved[i] * self.shrinks - self.direction[i]).mag());
            let least = product(radius, larger(misses));
            let least = Ball::exact(least).checked_div(Ball::exact(1.0) - Ball::exact(contracts))?.mag();
            if least <= rest {
                let far = [0, 1].map(|i| sum(&[product(self.direction[i].mag(), radius), rest]));
                return Some([0, 1].map(|i| {
                    sum(&[product(self.matrix[i][0].mag(), far[0]), product(self.matrix[i][1].mag(), far[1])])
                }));
            }
            rest = 1.2 * least;
        }
        None
    }
}

impl Local {
    /// Proves that a manifold is analytic, for the largest radius that succeeds; `None` where none does. Lemma J3
    pub fn prove(pair: Pair<f64>, reach: Pair<f64>, guess: &Guessed, side: Side) -> Option<Self> {
        const MAX_RADIUS: f64 = 0.5;
        const TRIES: i32 = 16;
        let disc = |centre: f64, radius: f64| Disc::new(Ball::new(centre, radius));
        let discs = Pair { gap: disc(pair.gap, reach.gap), restitution: disc(pair.restitution, reach.restitution) };
        let frame = Frame::new(discs, guess, side)?;
        (0..TRIES).find_map(|k| {
            let radius = MAX_RADIUS * 0.75f64.powi(k); // proposes
            let size = frame.size(radius)?;
            let (fixed, eigenvalue) = (frame.phase.ball(), frame.eigenvalue.ball());
            Some(Self { radius, pair, reach, size, fixed, eigenvalue })
        })
    }

    /// Whether all members of a pair are within half the reaches, and this phase and eigenvalue of a fixed point are in the discs.
    pub fn covers(&self, pair: &Pair<Ball>, phase: Ball, eigenvalue: Ball) -> bool {
        let is_within = |x: Ball, disc: Ball| (x - Ball::exact(disc.mid())).mag() <= disc.rad();
        let is_near =
            |by: Parameter| (*pair.value(by) - Ball::exact(*self.pair.value(by))).mag() <= 0.5 * self.reach.value(by);
        is_near(Parameter::Gap)
            && is_near(Parameter::Restitution)
            && is_within(phase, self.fixed)
            && is_within(eigenvalue, self.eigenvalue)
    }
}
