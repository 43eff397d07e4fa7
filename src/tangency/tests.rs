//! The manifolds against the map in floating point, and what lies to either side of the first tangency beside figure 14.

use approx::assert_abs_diff_eq;
use nalgebra::DMatrix;

use super::FlightWord;
use super::chain::{Chain, FIRST, Sparse};
use super::flight::Pair;
use super::local::Local;
use super::manifold::Manifold;
use super::prove::{InDoubles, in_doubles, settled};
use super::saddle::{Guessed, Side};
use super::search::{Floats, Fold};
use crate::chaos;
use crate::number::{Ball, Enclosing};
use crate::periodic::krawczyk::{Effort, Equations, Proved, prove};
use crate::periodic::precondition::{Jacobian, Preconditioner};
use crate::tolerances::SERIES_OF_MANIFOLDS;

const GAP: f64 = 9.42497 / 8.0;
const WORD: &str = "FFFFFFFNFFFFFNFFNFFNFFFF";

fn saddle() -> Guessed {
    Guessed::all(GAP, 0.5)[0]
}

/// The tangency, in doubles.
fn tangency() -> InDoubles {
    let word: FlightWord = WORD.parse().unwrap();
    let folds = Floats::new(GAP, 0.5, saddle()).unwrap().folds(GAP, &word.0);
    in_doubles(&settled(&folds[0], 0.5).unwrap(), Ball::exact(0.5)).unwrap()
}

/// The map takes the point of `sigma` to that of `lambda sigma`.
#[test]
fn manifolds_are_invariant_under_the_map() {
    let floats = Floats::new(GAP, 0.5, saddle()).unwrap();
    for (side, lambda) in [(Side::Unstable, saddle().lambda[0]), (Side::Stable, saddle().lambda[1])] {
        for sigma in [1e-3, -2e-3, 0.01] {
            let fold = |sigma: f64| floats.point(side, sigma)[0];
            let image = floats.image(fold(sigma), &[chaos::Side::Far]).unwrap();
            let expected = fold(lambda * sigma);
            assert_abs_diff_eq!(image[0] - std::f64::consts::TAU, expected[0], epsilon = SERIES_OF_MANIFOLDS);
            assert_abs_diff_eq!(image[1], expected[1], epsilon = SERIES_OF_MANIFOLDS);
        }
    }
}

/// A short series with its tails holds a long one, with its derivatives.
#[test]
fn tails_hold_what_is_left_out() {
    for side in [Side::Unstable, Side::Stable] {
        let local = Local::prove(GAP, 1e-4, Ball::exact(0.5), &saddle(), side).unwrap();
        let of = |order: usize, gap: Ball, sigma: f64| {
            let manifold = Manifold { side, guess: saddle(), order, local: Some(local) };
            manifold.at(&Pair { gap, restitution: Ball::exact(0.5) }, &Ball::exact(sigma)).unwrap()
        };
        for part in [0.02, -0.1, 0.25] {
            let [short, long] = [3, 40].map(|order| of(order, Ball::exact(GAP), part * local.radius));
            for i in 0..2 {
                let pairs = [
                    (short.at[i].value, long.at[i].value),
                    (short.at[i].slope, long.at[i].slope),
                    (short.along[i].value, long.along[i].value),
                    (short.along[i].slope, long.along[i].slope),
                    (short.bend[i], long.bend[i]),
                ];
                for (a, b) in pairs {
                    assert!((a.mid() - b.mid()).abs() <= a.rad() + b.rad() && b.rad() < a.rad(), "{a:?} {b:?}");
                }
            }
        }
        // Beyond half the reach nothing is claimed.
        let manifold = Manifold { side, guess: saddle(), order: 9, local: Some(local) };
        let far = Pair { gap: Ball::exact(GAP + 6e-5), restitution: Ball::exact(0.5) };
        assert!(manifold.at(&far, &Ball::exact(0.001)).is_none());
    }
}

/// The common points of both manifolds at one `D`: the equations of a chain without tangents.
struct Crossing<'c> {
    chain: &'c Chain<Ball>,
    gap: Ball,
}

impl Crossing<'_> {
    /// As the chain has it.
    fn all(&self, x: &[Ball]) -> Vec<Ball> {
        let zero = Ball::exact(0.0);
        let mut all = vec![x[0], x[1], self.gap, zero];
        all.extend(x[2..].chunks(2).flat_map(|state| [state[0], state[1], zero, zero]));
        all
    }
}

impl Equations<Ball> for Crossing<'_> {
    type Jacobian = DMatrix<Ball>;

    fn values(&self, x: &[Ball]) -> Option<Vec<Ball>> {
        Some(self.chain.values(&self.all(x))?.chunks(4).flat_map(|row| [row[0], row[1]]).collect())
    }

    fn jacobian(&self, x: &[Ball]) -> Option<Self::Jacobian> {
        let state = |j: usize| (j - FIRST) / 4 * 2 + (j - FIRST) % 4;
        let column = |j: usize| match j {
            0 | 1 => Some(j),
            2 | 3 => None,
            _ => ((j - FIRST) % 4 < 2).then(|| 2 + state(j)),
        };
        let row = |i: usize| (i % 4 < 2).then_some(i / 4 * 2 + i % 4);
        Some(part(&self.chain.jacobian(&self.all(x))?, x.len(), (&row, &column)))
    }
}

/// The states and tangents along the flights from one `sigma_u`, and the `D` at which they come to the stable manifold: a chain without its last
/// equation.
struct Curve<'c> {
    chain: &'c Chain<Ball>,
    sigma: Ball,
}

impl Curve<'_> {
    fn all(&self, x: &[Ball]) -> Vec<Ball> {
        [&[self.sigma], x].concat()
    }
}

impl Equations<Ball> for Curve<'_> {
    type Jacobian = DMatrix<Ball>;

    fn values(&self, x: &[Ball]) -> Option<Vec<Ball>> {
        let mut values = self.chain.values(&self.all(x))?;
        values.pop();
        Some(values)
    }

    fn jacobian(&self, x: &[Ball]) -> Option<Self::Jacobian> {
        let row = |i: usize| (i < x.len()).then_some(i);
        Some(part(&self.chain.jacobian(&self.all(x))?, x.len(), (&row, &|j: usize| j.checked_sub(1))))
    }
}

/// A new place of a row or a column; `None` where it is left out.
type Place<'p> = &'p dyn Fn(usize) -> Option<usize>;

/// A part of a matrix.
fn part(matrix: &Sparse<Ball>, size: usize, (row, column): (Place<'_>, Place<'_>)) -> DMatrix<Ball> {
    let mut found = DMatrix::from_element(size, size, Ball::exact(0.0));
    for (i, j, value) in matrix.entries() {
        if let Some((i, j)) = row(i).zip(column(j)) {
            found[(i, j)] = found[(i, j)] + *value;
        }
    }
    found
}

fn points(x: &[f64]) -> Vec<Ball> {
    x.iter().map(|x| Ball::exact(*x)).collect()
}

/// The zero of the equations near a guess, if it is proved.
fn proved(
    equations: &impl Equations<Ball, Jacobian = DMatrix<Ball>>,
    guess: &[f64],
    effort: Effort,
) -> Option<Proved<Ball>> {
    let inverse = Preconditioner::new(&equations.jacobian(&points(guess))?.map(|x| x.mid()))?;
    prove(equations, &inverse, &points(guess), effort)
}

/// The common points that are proved at one `D` along the word, from two guesses.
fn crossings(found: &InDoubles, gap: f64, apart: f64) -> Vec<Vec<Ball>> {
    let near = |sign: f64| -> Option<Vec<Ball>> {
        let guess = Guessed::all(gap, 0.5)[0];
        let sigma = [found.x[0] + sign * apart, found.x[1]];
        let fold = Fold { gap, guess, flights: found.chain.flights.clone(), sigma, distance: 0.0 };
        let along = Floats::new(gap, 0.5, guess)?.along(&fold)?;
        let mut x = sigma.to_vec();
        x.extend(along.states[1..fold.flights.len()].iter().flatten());
        let crossing = Crossing { chain: &found.chain, gap: Ball::exact(gap) };
        for _ in 0..20 {
            let inverse = crossing.jacobian(&points(&x))?.map(|x| x.mid()).try_inverse()?;
            let misses = crossing.values(&points(&x))?.into_iter().map(|x| x.mid());
            let step = inverse * nalgebra::DVector::from_iterator(x.len(), misses);
            x.iter_mut().zip(step.iter()).for_each(|(x, step)| *x -= step);
        }
        let effort = Effort { largest: 0.1 * apart, domains: 4, images: 10, slow: 2 };
        proved(&crossing, &x, effort).map(|zero| crossing.all(&zero.at))
    };
    [near(1.0), near(-1.0)].into_iter().flatten().collect()
}

/// Lemma J10: for `D` below `D*` there are two common points near the tangency, for `D` above none in a box about it.
#[test]
fn two_homoclinic_points_meet_at_the_tangency() {
    const BELOW: f64 = 1e-12;
    let found = tangency();
    let apart = (2.0f64 * 806.0 * BELOW / 1.158e9).sqrt();
    // For each sigma_u there is one D in the box, and no other; in the box of the tangency it is the only critical point.
    let curve = Curve { chain: &found.chain, sigma: Ball::new(found.x[0], 3.0 * apart) };
    let effort = Effort { largest: 0.5 * found.zero.domain[0].rad(), domains: 6, images: 1, slow: 1 };
    let domain = curve.all(&proved(&curve, &found.x[1..], effort).unwrap().domain);
    // Two points of this curve lie below, one on each side.
    let below = crossings(&found, found.x[2] - BELOW, apart);
    assert_eq!(below.len(), 2);
    let [a, b] = [0, 1].map(|i| below[i][0]);
    let own = found.zero.at[0];
    assert!((a - own).mid() - (a - own).rad() > 0.0 && (own - b).mid() - (own - b).rad() > 0.0, "{a:?} {own:?} {b:?}");
    let is_inside =
        |(i, x): (usize, &Ball)| (i >= FIRST && (i - FIRST) % 4 > 1) || i == 3 || x.is_interior_to(&domain[i]);
    assert!(below.iter().all(|x| x.iter().enumerate().all(is_inside)));
    assert!(crossings(&found, found.x[2] + BELOW, apart).is_empty());
}
