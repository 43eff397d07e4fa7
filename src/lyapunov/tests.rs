//! Against an orbit whose Jacobians are known exactly, against differences of orbits, and against what is known of chaos.

use super::*;
use crate::Scene;
use crate::orbit::Settings;
use crate::tests::{scene, scene_of};
use crate::tolerances::{EXPONENT, NORM, NORM_OF_DIFFERENCES};
use approx::assert_abs_diff_eq;

/// The disturbance after `impacts` impacts from the start.
fn after(scene: &Scene, impacts: u64, digits: u32) -> Disturbance {
    let settings = Settings { impacts: Some(impacts), digits, ..Settings::default() };
    let mut orbit = Orbit::of(scene, settings).unwrap();
    let mut disturbance = Disturbance::of(&orbit);
    loop {
        match orbit.advance() {
            Progress::Ended => return disturbance,
            event => disturbance.follow(&orbit, &event),
        }
    }
}

#[test]
fn bounds_hold_the_exact_norm_of_powers() {
    // Equations (66)-(69), sin th0 = 0: over two impacts DP^2 = (1/4) [[1, 3/8], [0, 1]] exactly, by (A.7).
    for periods in [1u64, 2, 3, 10, 50, 100, 1000] {
        let disturbance = after(&scene("figure-12-exact"), 2 * periods, 9);
        let found = disturbance.growth.logarithm_of_norm().unwrap();
        // Of [[1, x], [0, 1]] the larger singular value is (x + sqrt(x^2 + 4))/2 = exp asinh (x/2).
        let exact = (periods as f64 * 3.0 / 16.0).asinh() - 4f64.ln() * periods as f64;
        let error = (exact - found.mid()).abs();
        assert!(error <= found.rad() + 2.0 * f64::EPSILON * exact.abs(), "{periods}: {error:e} > {:e}", found.rad());
        assert!(found.rad() < 1e-11 * periods as f64, "{periods}: {:e}", found.rad());
    }
}

#[test]
fn the_exponent_tends_to_the_logarithm_of_the_eigenvalue() {
    let Exponent::Finite { per_impact, per_cycle } = after(&scene("figure-12-exact"), 2000, 9).exponent() else {
        panic!("an exponent")
    };
    // Both eigenvalues are 1/4 a cycle of two impacts; the norm grows beyond that like ln(n)/n.
    let above = per_impact.mid() + 2f64.ln();
    assert!(0.0 < above && above < 0.004, "{above}");
    assert_abs_diff_eq!(per_cycle.mid(), 2.0 * per_impact.mid(), epsilon = EXPONENT);
}

#[test]
fn bounds_hold_the_norm_of_differences() {
    let scene = scene("figure-14");
    let (impacts, step) = (12, 1e-25);
    let last = |time: &str, velocity: &str| {
        let start =
            crate::orbit::Start::on_wall(time.parse().unwrap(), crate::pair::Wall::Left, velocity.parse().unwrap())
                .unwrap();
        let settings = Settings { impacts: Some(impacts), digits: 60, ..Settings::default() };
        let mut orbit = Orbit::new(scene.pair(), &start, settings).unwrap();
        let impact = orbit.by_ref().last().unwrap();
        impact.precise.map(|precise| *precise).unwrap()
    };
    // W = pi: a forcing period is 2 time units; a gap per forcing period is 9.42497/2.
    let column = |less: (_, _), more: (_, _)| {
        let half = |a: &crate::exact::Enclosure, b: &crate::exact::Enclosure| b.sub(a, 300).mid_rad().0 / (2.0 * step);
        [half(&less.0, &more.0), half(&less.1, &more.1)]
    };
    let by_time = column(last("-2e-25", "-12.56636"), last("2e-25", "-12.56636"));
    let by_velocity = column(last("0", "-12.56636 - 4.712485e-25"), last("0", "-12.56636 + 4.712485e-25"));
    let squares: f64 = by_time.iter().chain(&by_velocity).map(|x| x * x).sum();
    let determinant = by_time[0] * by_velocity[1] - by_time[1] * by_velocity[0];
    let norm = (0.5 * (squares + (squares * squares - 4.0 * determinant * determinant).sqrt())).sqrt();
    let found = after(&scene, impacts, 20).growth.logarithm_of_norm().unwrap();
    assert!((norm.ln() - found.mid()).abs() <= found.rad() + NORM_OF_DIFFERENCES, "{} {found:?}", norm.ln());
    assert!(found.rad() < NORM_OF_DIFFERENCES, "{found:?}");
}

#[test]
fn figure_14_grows_by_a_factor_of_e_to_the_two_fifths_per_impact() {
    let Exponent::Finite { per_impact, .. } = after(&scene("figure-14"), 1500, 6).exponent() else {
        panic!("an exponent")
    };
    assert!((per_impact.mid() - 0.399).abs() < 0.03 && per_impact.rad() < 1e-5, "{per_impact:?}");
}

#[test]
fn a_rest_forgets_a_graze_has_no_derivative() {
    assert_eq!(after(&scene("chatter"), 40, 9).exponent(), Exponent::Forgets);
    assert_eq!(after(&scene("graze"), 20, 9).exponent(), Exponent::Unknown(NoExponent::Graze));
    // However coarsely the chatter before it is known: at two digits the direction is lost there.
    for digits in [2, 6] {
        assert_eq!(after(&scene("chatter"), 40, digits).exponent(), Exponent::Forgets, "{digits}");
    }
    assert_eq!(after(&scene("figure-14"), 0, 9).exponent(), Exponent::Unknown(NoExponent::NoImpacts));
}

#[test]
fn a_rest_without_contact_force_has_no_exponent() {
    let still = |phase: &str, amplitude: &str| {
        let excitation = format!("amplitude = {amplitude}, frequency = 1, phase = \"{phase}\"");
        let start = "time = 0, wall = \"left\", velocity = 0";
        after(&scene_of(&excitation, "gap = 4, restitution = 0.5", start), 3, 9).exponent()
    };
    let unpressed = Exponent::Unknown(NoExponent::Unpressed);
    assert_eq!((still("pi", "1"), still("pi", "0")), (unpressed, unpressed));
    assert_eq!(still("1.25*pi", "1"), Exponent::Forgets);
}

/// A ball that lies on its wall as the contact force ends, from the start on: one that is there earlier, however little, bounces first. There is no
/// derivative; at the next impact there is. With a contact force that is past there is one at once.
#[test]
fn r62_a_start_where_the_contact_force_ends_has_no_exponent() {
    let scene = |time: &str| {
        let start = format!("time = \"{time}\", wall = \"left\", velocity = 0");
        scene_of("amplitude = 0.3, frequency = \"2*pi\", phase = 0", "gap = 1, restitution = 0.5", &start)
    };
    let at = |time: &str| {
        let disturbance = after(&scene(time), 3, 9);
        (disturbance.exponent(), disturbance.passed())
    };
    assert_eq!(at("1"), (Exponent::Unknown(NoExponent::Width), Passed::Break));
    for time in ["1.01", "1 + 1e-12"] {
        assert!(matches!(at(time), (Exponent::Finite { .. }, Passed::Flights)), "{time}");
    }
    let mut orbit = Orbit::of(&scene("1"), Settings { impacts: Some(3), ..Settings::default() }).unwrap();
    let first = orbit.next().unwrap();
    let mut disturbance = Disturbance::at(&orbit, first);
    for _ in 0..2 {
        let event = Progress::Impact(orbit.next().unwrap());
        disturbance.follow(&orbit, &event);
    }
    assert!(matches!(disturbance.exponent(), Exponent::Finite { .. }) && disturbance.passed() == Passed::Flights);
}

#[test]
fn without_rebound_one_direction_remains() {
    // e = 0: each impact forgets the velocity before it.
    let start = "time = 0.3, wall = \"left\", velocity = -1";
    let scene = scene_of("amplitude = 8, frequency = 1, phase = 0", "gap = 1, restitution = 0", start);
    let settings = Settings { impacts: Some(1), ..Settings::default() };
    let mut orbit = Orbit::of(&scene, settings).unwrap();
    let start = orbit.start_impact().unwrap();
    let first = orbit.next().unwrap();
    let [[a, b], [c, d]] = orbit.jacobian(&start, &first).unwrap();
    let mut disturbance = Disturbance::of(&orbit);
    disturbance.follow(&orbit, &Progress::Impact(first));
    let found = disturbance.growth.logarithm_of_norm().unwrap();
    assert!(b.mid() == 0.0 && d.mid() == 0.0);
    assert!((a.mid().hypot(c.mid()).ln() - found.mid()).abs() <= found.rad() + NORM, "{found:?}");
}
