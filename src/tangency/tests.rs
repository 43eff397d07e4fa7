//! The manifolds against the map in floating point, and what lies to either side of the first tangency beside figure 14.

use approx::assert_abs_diff_eq;

use super::FlightWord;
use super::chain::{Chain, FIRST, Sparse};
use super::flight::Pair;
use super::local::Local;
use super::manifold::Manifold;
use super::prove::{InDoubles, in_doubles, settle, settled};
use super::saddle::{Guessed, Side};
use super::search::{Floats, Fold};
use super::unfolding::Unfolding;
use crate::chaos;
use crate::number::{Ball, Enclosing};
use crate::periodic::krawczyk::{Effort, Equations, prove};
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

/// For every `e` within 1e-5 of 1/2 there is one, and only one near: the chain's equations are solved for the whole ball of `e` at once.
#[test]
fn the_tangency_is_one_of_a_family_over_e() {
    let word: FlightWord = WORD.parse().unwrap();
    let folds = Floats::new(GAP, 0.5, saddle()).unwrap().folds(GAP, &word.0);
    let fold = settled(&folds[0], 0.5).unwrap();
    let [family, one] = [1e-5, 0.0].map(|radius| in_doubles(&fold, Ball::new(0.5, radius)).unwrap());
    let [all, own] = [&family, &one].map(|found| found.zero.at[2]);
    assert!((all.mid() - own.mid()).abs() + own.rad() < all.rad() && all.rad() < 1e-3, "{all:?} {own:?}");
    // At both ends, by Newton's iteration alone.
    for e in [0.499_99, 0.500_01] {
        let chain = Chain { restitution: Ball::exact(e), ..one.chain.clone() };
        let end = settle(&chain, one.x.clone()).unwrap()[2];
        assert!((end - all.mid()).abs() < all.rad(), "{e}: {end} {all:?}");
    }
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
    type Jacobian = nalgebra::DMatrix<Ball>;

    fn values(&self, x: &[Ball]) -> Option<Vec<Ball>> {
        Some(self.chain.values(&self.all(x))?.chunks(4).flat_map(|row| [row[0], row[1]]).collect())
    }

    fn jacobian(&self, x: &[Ball]) -> Option<Self::Jacobian> {
        let mut matrix = nalgebra::DMatrix::from_element(x.len(), x.len(), Ball::exact(0.0));
        let all: Sparse<Ball> = self.chain.jacobian(&self.all(x))?;
        for (i, j, value) in all.entries().filter(|(i, _, _)| i % 4 < 2) {
            let column = match j {
                0 | 1 => j,
                _ if j >= FIRST && (j - FIRST) % 4 < 2 => 2 + (j - FIRST) / 4 * 2 + (j - FIRST) % 4,
                _ => continue,
            };
            let row = i / 4 * 2 + i % 4;
            matrix[(row, column)] = matrix[(row, column)] + *value;
        }
        Some(matrix)
    }
}

/// The number of common points that are proved at one `D` along the word, from two guesses.
fn crossings(found: &InDoubles, gap: f64, apart: f64) -> Vec<Vec<Ball>> {
    let near = |sign: f64| -> Option<Vec<Ball>> {
        let guess = Guessed::all(gap, 0.5)[0];
        let sigma = [found.x[0] + sign * apart, found.x[1]];
        let fold = Fold { gap, guess, flights: found.chain.flights.clone(), sigma, distance: 0.0 };
        let along = Floats::new(gap, 0.5, guess)?.along(&fold)?;
        let mut x = sigma.to_vec();
        x.extend(along.states[1..fold.flights.len()].iter().flatten());
        let crossing = Crossing { chain: &found.chain, gap: Ball::exact(gap) };
        let points = |x: &[f64]| x.iter().map(|x| Ball::exact(*x)).collect::<Vec<_>>();
        for _ in 0..20 {
            let inverse = crossing.jacobian(&points(&x))?.map(|x| x.mid()).try_inverse()?;
            let misses = crossing.values(&points(&x))?.into_iter().map(|x| x.mid());
            let step = inverse * nalgebra::DVector::from_iterator(x.len(), misses);
            x.iter_mut().zip(step.iter()).for_each(|(x, step)| *x -= step);
        }
        let inverse = Preconditioner::new(&crossing.jacobian(&points(&x))?.map(|x| x.mid()))?;
        let effort = Effort { largest: 0.1 * apart, domains: 4, images: 10, slow: 2 };
        prove(&crossing, &inverse, &points(&x), effort).map(|zero| zero.at)
    };
    [near(1.0), near(-1.0)].into_iter().flatten().collect()
}

/// Lemma J10: for `D` below `D*` there are two common points near the tangency, for `D` above none in a box about it.
#[test]
fn two_homoclinic_points_meet_at_the_tangency() {
    let found = tangency();
    let at = |radius: f64| -> Vec<Ball> { found.x.iter().map(|x| Ball::new(*x, radius)).collect() };
    let is_negative = |x: Ball| x.certain_sign().is_some_and(std::cmp::Ordering::is_lt);
    // The widest box over which m has a sign.
    let over =
        |radius: &f64| Unfolding::new(&found.chain, &at(*radius)).is_some_and(|over| is_negative(over.unfolding));
    let radius = (6..12).map(|k| 0.1f64.powi(k)).find(over).unwrap();
    let apart = (2.0f64 * 806.0 * 1e-12 / 1.158e9).sqrt();
    let below = crossings(&found, found.x[2] - 1e-12, apart);
    assert_eq!(below.len(), 2);
    let [a, b] = [below[0][0], below[1][0]];
    assert!((a - b).mid() - (a - b).rad() > apart, "{a:?} {b:?}");
    for x in &below {
        let all = Crossing { chain: &found.chain, gap: Ball::exact(found.x[2] - 1e-12) }.all(x);
        let states = all.iter().zip(at(radius)).enumerate().filter(|(i, _)| *i < 3 || *i > 3 && (i - FIRST) % 4 < 2);
        assert!(states.into_iter().all(|(_, (x, outer))| x.is_interior_to(&outer)), "{radius}");
    }
    assert!(crossings(&found, found.x[2] + 1e-12, apart).is_empty());
}
