//! Flights whose answer is a theorem or a published anchor.

use crate::common::{contact, figure};
use crate::tolerances::TRUTH;
use impact_pair_truth::{Problem, Start, Truth, Wall, first_contact, orbit, pi_times};
use rug::Float;

/// |value - decimal| <= tolerance.
#[track_caller]
fn assert_near(value: &Float, decimal: &str, tolerance: f64) {
    let reference = Float::with_val(value.prec(), Float::parse(decimal).unwrap());
    let error = Float::with_val(64, value - reference).abs();
    assert!(error <= tolerance, "{value} is not {decimal}");
}

fn chatter(restitution: &str) -> (Problem, Start) {
    let problem = Problem::new(256, 1, "pi", "pi", "9.42497", restitution);
    let after = Float::with_val(256, &problem.restitution / 2);
    let start = Start::on_wall(&problem, Wall::Left, 0, &after);
    (problem, start)
}

#[test]
fn the_chatter_anchors_return_when_they_should_and_accumulate_at_the_rest_time() {
    for (restitution, first, rest) in [
        // mpmath, 60 digits: sin(pi t) = (pi - e / 2) t. The published anchors (..654180, ..620683) are good to 8e-17.
        ("0.3", "0.171614305606541738445083031560839033018761674", "0.21801340070058368"),
        ("0.5", "0.222657000616206759110886498087668591603079505", "0.35713675989103753"),
    ] {
        let (problem, start) = chatter(restitution);
        let contacts = orbit(&problem, &start, 40);
        assert_eq!(contacts.len(), 40);
        assert!(contacts.iter().all(|contact| contact.wall == Wall::Left));
        assert_near(&contacts[0].time, first, 1e-44);
        // Steps shrink as e^n: what is left after 40 is under 1e-12 for e = 0.5, and less for 0.3.
        assert_near(&contacts[39].time, rest, 2e-12);
    }
}

#[test]
fn the_chatter_anchors_are_released_at_one_and_next_meet_the_right_wall() {
    for restitution in ["0.3", "0.5"] {
        let (problem, _) = chatter(restitution);
        let pressed = Start::on_wall(&problem, Wall::Left, "0.7", 0);
        assert!(matches!(first_contact(&problem, &pressed), Truth::Rests));
        let (time, wall, _) = contact(&problem, &Start::on_wall(&problem, Wall::Left, 1, 0));
        assert_eq!(wall, Wall::Right);
        // mpmath, 60 digits: 1 + s with pi s - sin(pi s) = d. The published anchor 4.0000305639928444715 is good to 3e-16.
        assert_near(&time, "4.00003056399284426550152122386788543078582572", 1e-43);
    }
}

#[test]
fn the_exact_orbit_of_figure_12_impacts_at_every_whole_time() {
    let problem = Problem::new(256, 1, "pi", 0, "3*pi", "1/2");
    let contacts = orbit(&problem, &Start::on_wall(&problem, Wall::Left, 0, "2*pi"), 50);
    let speed = pi_times(256, 4);
    for (index, contact) in contacts.iter().enumerate() {
        let error = Float::with_val(256, &contact.time - (index + 1)).abs();
        assert!(error < TRUTH, "impact {index} at {}", contact.time);
        let wall = if index % 2 == 0 { Wall::Right } else { Wall::Left };
        assert_eq!(contact.wall, wall);
        let error = Float::with_val(256, &contact.velocity_before - Float::with_val(256, &speed * wall.sign())).abs();
        assert!(error < TRUTH, "impact {index} with {}", contact.velocity_before);
    }
    assert_eq!(contacts.len(), 50);
}

#[test]
fn figure_12_as_printed_is_attracted_to_the_equispaced_orbit() {
    let (problem, start) = figure(12, 256);
    let contacts = orbit(&problem, &start, 60);
    let period = Float::with_val(256, &contacts[59].time - &contacts[57].time);
    assert_near(&period, "2", 1e-14);
}

#[test]
fn a_grazing_orbit_with_c_zero_grazes_after_one_forcing_period() {
    // Model II at theta = -pi/2: v = 0, c = 0 up to the rounding of pi, the ball comes back to touch.
    let problem = Problem::new(256, "1/4", 2, "-pi/2", 1, "1/2");
    let Truth::Graze { time } = first_contact(&problem, &Start::on_wall(&problem, Wall::Right, 0, 0)) else {
        panic!("not a graze");
    };
    assert_near(&time, "3.14159265358979323846264338327950288", 1e-34);
}

#[test]
fn a_graze_of_the_far_wall_is_seen_within_the_threshold_and_decided_beyond_it() {
    // From the left wall with c = 0: y = -d/2 + A (1 - sin(theta)) reaches -d/2 + 2 A at theta = 3 pi / 2.
    let answer = |relative: f64| {
        let amplitude = Float::with_val(256, 0.5) * (Float::with_val(256, 1) + relative);
        let problem = Problem::new(256, &amplitude, 1, "pi/2", 1, 1);
        first_contact(&problem, &Start::on_wall(&problem, Wall::Left, 0, 0))
    };
    assert!(matches!(answer(0.0), Truth::Graze { .. }));
    assert!(matches!(answer(1e-60), Truth::Graze { .. }));
    assert!(matches!(answer(1e-50), Truth::Contact { wall: Wall::Right, .. }));
    // 1e-50 short of the far wall, the ball comes back to graze its own one forcing period later.
    let Truth::Graze { time } = answer(-1e-50) else { panic!("not a graze") };
    assert_near(&time, "6.283185307179586476925286766559", 1e-29);
}

#[test]
fn a_ball_that_neither_drifts_nor_reaches_never_touches() {
    let still = Problem::new(256, 0, 1, 0, 1, 1);
    assert!(matches!(first_contact(&still, &Start::inside(&still, 0, "1/3", 0)), Truth::Never));
    let shaken = Problem::new(256, "1/5", 1, "pi/2", 1, 1);
    assert!(matches!(first_contact(&shaken, &Start::inside(&shaken, 0, 0, 0)), Truth::Never));
}

#[test]
fn a_box_at_rest_is_crossed_in_a_straight_line() {
    let problem = Problem::new(256, 0, 1, 0, 3, 1);
    assert!(matches!(first_contact(&problem, &Start::on_wall(&problem, Wall::Left, 0, 0)), Truth::Rests));
    let (time, wall, velocity) = contact(&problem, &Start::on_wall(&problem, Wall::Right, 2, -4));
    assert_eq!((time.to_f64(), wall, velocity.to_f64()), (2.75, Wall::Left, -4.0));
    let (time, wall, _) = contact(&problem, &Start::inside(&problem, 0, 1, 2));
    assert_eq!((time.to_f64(), wall), (0.25, Wall::Right));
}

#[test]
fn with_v_zero_the_ball_leaves_where_the_acceleration_points_inward_and_rests_where_not() {
    for (tau, wall, leaves) in [
        ("1e-30", Wall::Left, true),
        ("1e-30", Wall::Right, false),
        ("-1e-30", Wall::Left, false),
        ("-1e-30", Wall::Right, true),
        // Acceleration zero: y''' decides, and a ball pressed again at once rests.
        ("0", Wall::Left, true),
        ("0", Wall::Right, false),
        ("pi", Wall::Right, true),
        ("pi", Wall::Left, false),
    ] {
        let problem = Problem::new(256, 1, 1, tau, 1, 0);
        let truth = first_contact(&problem, &Start::on_wall(&problem, wall, 0, 0));
        assert_eq!(matches!(truth, Truth::Contact { .. }), leaves, "{tau} {wall:?} {truth:?}");
        assert_eq!(matches!(truth, Truth::Rests), !leaves, "{tau} {wall:?} {truth:?}");
    }
}

#[test]
fn a_tiny_hop_lasts_twice_its_speed_over_the_acceleration() {
    // theta0 = -pi/2 on the left wall: y'' = -A W^2 to second order in time.
    let problem = Problem::new(256, 1, 1, "-pi/2", 1, 1);
    for exponent in [10, 30, 50] {
        let speed = Float::with_val(256, Float::u_exp(1, -exponent));
        let (time, wall, velocity) = contact(&problem, &Start::on_wall(&problem, Wall::Left, 0, &speed));
        assert_eq!(wall, Wall::Left);
        let twice = Float::with_val(256, &time / &speed);
        assert_near(&twice, "2", (-2.0 * f64::from(exponent)).exp2());
        let back = Float::with_val(256, &velocity / &speed);
        assert_near(&back, "-1", (-2.0 * f64::from(exponent)).exp2());
    }
}
