//! The manifolds against the map in floating point, and against longer series.

use approx::assert_abs_diff_eq;

use super::flight::{Pair, Parameter};
use super::local::Local;
use super::manifold::Manifold;
use super::saddle::{Guessed, Side};
use super::search::Floats;
use crate::chaos;
use crate::number::Ball;
use crate::tolerances::SERIES_OF_MANIFOLDS;

const PAIR: Pair<f64> = Pair { gap: 9.42497 / 8.0, restitution: 0.5 };

fn saddle() -> Guessed {
    Guessed::all(PAIR)[0]
}

/// The map takes the point of `sigma` to that of `lambda sigma`.
#[test]
fn manifolds_are_invariant_under_the_map() {
    let floats = Floats::new(PAIR, saddle()).unwrap();
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
        let local = Local::prove(PAIR, Pair { gap: 1e-4, restitution: 0.0 }, &saddle(), side).unwrap();
        let of = |order: usize, gap: Ball, sigma: f64| {
            let manifold = Manifold { side, guess: saddle(), order, local: Some(local) };
            manifold.at(&Pair { gap, restitution: Ball::exact(0.5) }, Parameter::Gap, &Ball::exact(sigma)).unwrap()
        };
        for part in [0.02, -0.1, 0.25] {
            let [short, long] = [3, 40].map(|order| of(order, Ball::exact(PAIR.gap), part * local.radius));
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
        let far = Pair { gap: Ball::exact(PAIR.gap + 6e-5), restitution: Ball::exact(0.5) };
        assert!(manifold.at(&far, Parameter::Gap, &Ball::exact(0.001)).is_none());
    }
}
