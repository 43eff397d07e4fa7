//! The manifolds against the map in floating point and against longer series, the saddle against differences, and both sides of a tangency.

use approx::assert_abs_diff_eq;

use super::FlightWord;
use super::begin::{in_doubles, settled};
use super::beside::sides;
use super::flight::{Pair, Parameter};
use super::local::Local;
use super::manifold::Manifold;
use super::saddle::{Guessed, Saddle, Side};
use super::search::Floats;
use crate::chaos;
use crate::number::Ball;
use crate::tolerances::{DIFFERENCE_OF_JETS, SERIES_OF_MANIFOLDS};

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

/// The fold of the unstable manifold passes through the stable one between both ranges, from the side that `q` and `m` have.
#[test]
fn two_common_points_meet_at_the_tangency() {
    let word: FlightWord = "FFFFFFFNFFFFFNFFNFFNFFFF".parse().unwrap();
    let folds = Floats::new(PAIR, saddle()).unwrap().folds(&word.0);
    let settled = settled(&folds[0], Parameter::Gap).unwrap();
    let found = in_doubles(&settled, Parameter::Gap, Ball::exact(PAIR.restitution)).unwrap();
    let [two, none] = sides(&found).map(|sides| [sides.two, sides.none]).unwrap().map(|range| range.mid_rad().0);
    assert!(two < found.x[2] && found.x[2] < none);
    let distance = |gap: f64| {
        let pair = Pair { gap, ..PAIR };
        Floats::new(pair, Guessed::all(pair)[0]).unwrap().folds(&word.0)[0].distance
    };
    let [before, after] = [distance(two), distance(none)];
    // m (D - D*) + q (sigma - sigma_u)^2 / 2 with m < 0, q < 0: two zeros where the extremum is positive.
    assert!(before * after < 0.0 && before.abs() < after.abs(), "{before} {after}");
}

/// The derivatives of the fixed point and of its eigenvalues by both parameters, against differences.
#[test]
fn the_saddle_moves_with_both_parameters() {
    let step = 1e-6;
    for by in [Parameter::Gap, Parameter::Restitution] {
        let ball = PAIR.map(|x| Ball::exact(*x));
        let found = Saddle::new(&ball, by, &saddle()).unwrap();
        let at = |sign: f64| Guessed::all(Pair::of(by, PAIR.value(by) + sign * step, *PAIR.value(by.other())))[0];
        let (less, more) = (at(-1.0), at(1.0));
        let pairs = [
            (found.theta.slope, more.theta - less.theta),
            (found.speed.slope, more.speed - less.speed),
            (found.lambda[0].slope, more.lambda[0] - less.lambda[0]),
            (found.lambda[1].slope, more.lambda[1] - less.lambda[1]),
        ];
        for (slope, difference) in pairs {
            assert_abs_diff_eq!(slope.mid(), difference / (2.0 * step), epsilon = DIFFERENCE_OF_JETS);
        }
    }
}
