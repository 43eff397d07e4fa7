//! The counting of motions against a plain scan, and a function whose zeros are known.

use std::cmp::Ordering;
use std::f64::consts::PI;

use super::closed_forms::{closure, grazing_angle, speed_between};
use super::isolate::{Interval, Part, refine, zeros};
use super::jet::Jet;
use super::motion::Parameters;
use super::unequispaced::Spacing;
use crate::exact::Real;
use crate::exact::{Dyadic, Enclosure, Exact};
use crate::watch::Unwatched;

fn real(text: &str, bits: u32) -> Real {
    Real::of(&Exact::parse(text).unwrap(), bits)
}

fn interval(low: f64, high: f64) -> Real {
    Real::new(Enclosure::from_f64_bounds(low, high).unwrap(), 96)
}

/// `sin x - level`
fn wave(x: &Real, level: &str) -> Option<Jet> {
    Some(&Jet::argument(x).sin() - &Jet::constant(&real(level, 96)))
}

#[test]
fn all_zeros_of_a_wave_are_found_and_its_double_zeros_doubted() {
    let x = interval(0.5, 30.0);
    let signs = [Some(Ordering::Greater), Some(Ordering::Less)];
    let parts = zeros(&Interval { x: x.clone(), signs }, |x| wave(x, "0"));
    assert_eq!(parts.len(), 9);
    for (n, part) in parts.iter().enumerate() {
        let Part::Zero { x, left } = part else { panic!("{part:?}") };
        let zero = refine(x.clone(), *left, |x| wave(x, "0"));
        let expected = Real::pi(96) * (n as i64 + 1);
        assert!(!zero.is_apart_from(&expected) && zero.wid() < Dyadic::power_of_two(-80));
    }
    let parts = zeros(&Interval { x, signs: [Some(Ordering::Less); 2] }, |x| wave(x, "1"));
    assert!(parts.len() == 5 && parts.iter().all(|part| matches!(part, Part::Doubt(_))));
}

#[test]
fn an_unknown_sign_at_an_end_is_a_doubt() {
    let at_end = |signs| zeros(&Interval { x: interval(0.0, 1.0), signs }, |x| wave(x, "0"));
    assert!(matches!(at_end([None, Some(Ordering::Greater)]).as_slice(), [Part::Doubt(_)]));
    assert!(at_end([Some(Ordering::Equal), Some(Ordering::Greater)]).is_empty());
}

/// For N = 1 the graze and the pitchfork meet at `e* = 0.08670091501...` (`docs/paper.md`): `tan th_g = 2 kappa/pi`.
#[test]
fn the_graze_meets_the_pitchfork_at_the_known_restitution() {
    let excess = |e: &str| {
        let e = real(e, 120);
        let angle = grazing_angle(&e).unwrap();
        assert!(angle.wid() < Dyadic::power_of_two(-100));
        let kappa = (&e + 1).over(&(Real::int(1, 120) - &e)).unwrap();
        (angle.sin().over(&angle.cos()).unwrap() - (kappa * 2).over(&Real::pi(120)).unwrap()).sign()
    };
    assert_eq!(excess("0.08670091501"), Some(Ordering::Less));
    assert_eq!(excess("0.08670091502"), Some(Ordering::Greater));
}

/// The gap of (57) where (62), (63) hold with `th1 - th0 = N pi + 2 eps`, in plain floating point, by W1: `th0` from the condition (63), which is
/// linear in `cos m` and `sin m`.
fn gap_at(eps: f64, e: f64, cycles: u32) -> f64 {
    let n = f64::from(cycles);
    let delta = n * PI / 2.0 + eps;
    let residual = |m: f64| {
        let (th0, th1) = (m - delta, m + delta);
        let v = (th0.cos() - th1.cos()) / (1.0 - e);
        let (there, back) = (e * v + th0.cos(), -e * v + th1.cos());
        (there * 2.0 * delta + back * (2.0 * n * PI - 2.0 * delta), v, th0, th1, there)
    };
    let (of_cos, of_sin) = (residual(0.0).0, residual(PI / 2.0).0);
    let m = (-of_cos).atan2(of_sin);
    let (_, v, th0, th1, there) = residual(m);
    let gap = th0.sin() - th1.sin() + there * 2.0 * delta;
    // The other sign of (cos m, sin m) gives the other sign of all.
    if v > 0.0 { gap } else { -gap }
}

#[test]
fn a_plain_scan_finds_no_motion_that_was_missed() {
    const STEPS: u32 = 20_000;
    for (e, cycles, ratio) in [
        (0.5, 2, 10.82),
        (0.5, 4, 14.21),
        (0.8, 1, 2.5),
        (0.8, 3, 3.3),
        (0.3, 5, 1.1),
        (0.1, 6, 2.5),
        (0.9, 2, 40.0),
        (0.0, 3, 1.7),
        (0.95, 1, 0.3),
    ] {
        let bits = 96;
        let exact = |x: f64| Real::of(&Exact::parse(&x.to_string()).unwrap(), bits);
        let parameters = Parameters { cycles, ratio: exact(ratio), restitution: exact(e), is_dead: e == 0.0 };
        let room = Some(2.0f64.total_cmp(&ratio));
        let (motions, doubts) = Spacing::new(&parameters, room).solve(&Unwatched);
        assert!(doubts.is_empty());
        let step = f64::from(cycles) * PI / 2.0 / f64::from(STEPS);
        let at = |index: u32| gap_at((f64::from(index) + 0.5) * step, e, cycles) - ratio;
        // Jumps at the ends of pieces are no zeros.
        let is_zero = |index: &u32| at(*index) * at(index + 1) < 0.0 && (at(*index) - at(index + 1)).abs() < 0.5;
        let seen: Vec<u32> = (0..STEPS - 1).filter(is_zero).collect();
        assert_eq!(motions.len(), 2 * seen.len(), "e = {e}, N = {cycles}, d/A = {ratio}: {seen:?}");
        for motion in &motions {
            let (theta0, theta1) = (&motion.theta0, motion.theta1());
            let speed = speed_between(theta0, &theta1, &parameters.restitution).unwrap();
            assert!(!speed.is_apart_from(&motion.speed) && speed.wid() < Dyadic::power_of_two(-50));
            let rest = closure(theta0, &theta1, cycles, &parameters.restitution, &speed);
            assert!(rest.sign().is_none() && rest.wid() < Dyadic::power_of_two(-50));
        }
        for index in seen {
            let eps = f64::from(index + 1) * step;
            let near = |spacing: f64| ((spacing - f64::from(cycles) * PI) / 2.0 - eps).abs() <= step;
            assert!(motions.iter().any(|motion| near(motion.spacing.to_f64())), "e = {e}, N = {cycles}: eps = {eps}");
        }
    }
}
