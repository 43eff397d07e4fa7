//! Random flights against the scan, against eq. (11) itself, and against twice the precision.

use crate::common::{Random, cases, contact, displacement, figure, random_case};
use crate::tolerances::{TRUTH_AT_RANDOM, TRUTH_LATE, TRUTH_ON_THE_WALL};
use impact_pair_truth::{Number, Problem, Start, Truth, Wall, displacement_f64, first_contact, orbit, scan};
use rug::Float;

/// Nothing before the contact, the wall at it, and beyond the wall soon after it.
fn assert_scan_agrees(problem: &Problem, start: &Start, points: usize) {
    let (time, wall, velocity) = contact(problem, start);
    let elapsed = Float::with_val(1400, &time - &start.time).to_f64();
    assert!(velocity.to_f64() * f64::from(wall.sign()) > 0.0, "{velocity} at {wall:?}");
    assert_eq!(scan(problem, start, elapsed, points), None, "{problem:?} {start:?} {elapsed}");
    let y = displacement(problem, start, &time);
    let miss = Float::with_val(64, y - problem.wall_at(wall)).abs();
    let scale = problem.gap.to_f64().max(problem.amplitude.to_f64());
    // The absolute time carries P bits: at 1e300 and P = 256 the ball is anywhere, so judge such times by the doubles.
    let late = Float::with_val(64, &time * &problem.omega).abs() * velocity.clone().abs() / &problem.omega;
    assert!(miss <= scale * TRUTH_AT_RANDOM + late * TRUTH_LATE, "{problem:?} {start:?} {time} {miss}");
    let omega = problem.omega.to_f64();
    let reaction = (1e-4 / omega).max(1e-9 * elapsed);
    let beyond = displacement_f64(problem, start, elapsed + reaction) * f64::from(wall.sign());
    let slow = velocity.to_f64().abs() * reaction < 1e-8 * scale;
    assert!(slow || beyond > problem.gap.to_f64() / 2.0, "{problem:?} {start:?} {beyond}");
}

#[test]
fn scan_and_first_contact_agree_on_random_problems() {
    let mut random = Random::seeded(1);
    let (mut contacts, mut rests) = (0, 0);
    for _ in 0..cases(2000) {
        let (problem, start) = random_case(&mut random, 1280);
        match first_contact(&problem, &start) {
            Truth::Contact { .. } => {
                contacts += 1;
                assert_scan_agrees(&problem, &start, 2000);
            }
            Truth::Rests => {
                rests += 1;
                assert!(start.velocity_after.is_zero());
                // y'' = A W^2 sin(theta0) presses.
                let theta0 = Float::with_val(3000, &problem.omega * &start.time) + &problem.tau;
                let press = theta0.sin() * start.on.expect("on a wall").sign();
                assert!(press > 0, "{problem:?} {start:?} {press}");
            }
            other => panic!("{other:?} {problem:?} {start:?}"),
        }
    }
    println!("{contacts} contacts, {rests} rests");
    assert!(contacts > cases(1700) && rests > cases(20));
}

#[test]
fn scan_and_first_contact_agree_on_the_figures() {
    for number in 12..=17 {
        let (problem, mut state) = figure(number, 512);
        for contact in orbit(&problem, &state, 60) {
            assert_scan_agrees(&problem, &state, 5000);
            state = contact.after(&problem);
        }
    }
}

#[test]
fn times_at_256_bits_are_those_at_512_bits_to_216_bits() {
    let mut random = Random::seeded(2);
    let mut worst = 0.0f64;
    for _ in 0..cases(2000) {
        let (problem, start) = random_case(&mut random, 256);
        let exact = |x: &Float| Number::from(x);
        let finer = Problem::new(
            512,
            exact(&problem.amplitude),
            exact(&problem.omega),
            exact(&problem.tau),
            exact(&problem.gap),
            exact(&problem.restitution),
        );
        match (first_contact(&problem, &start), first_contact(&finer, &start)) {
            (
                Truth::Contact { time, wall, velocity_before },
                Truth::Contact { time: time2, wall: wall2, velocity_before: velocity2 },
            ) => {
                assert_eq!(wall, wall2, "{problem:?} {start:?}");
                let rounding = Float::with_val(64, time.abs_ref()) >> 256;
                let error = Float::with_val(64, Float::with_val(2048, &time - &time2).abs() - rounding);
                let error = (error * &problem.omega).to_f64();
                assert!(error <= (-216f64).exp2(), "{problem:?} {start:?} {error:e}");
                let speed = Float::with_val(64, &problem.amplitude * &problem.omega)
                    .max(&Float::with_val(64, start.velocity_after.abs_ref()));
                let error2 = (Float::with_val(512, velocity_before - velocity2).abs() / speed).to_f64();
                assert!(error2 <= (-216f64).exp2(), "{problem:?} {start:?} {error2:e}");
                worst = worst.max(error).max(error2);
            }
            (Truth::Rests, Truth::Rests) => {}
            pair => panic!("{pair:?} {problem:?} {start:?}"),
        }
    }
    println!("worst error 2^{:.1}", worst.log2());
}

#[test]
fn a_drift_of_one_in_1e12_meets_the_wall_after_1e12_periods() {
    let mut random = Random::seeded(3);
    for exponent in [3, 5, 8, 12, 20] {
        for _ in 0..cases(20) {
            // From inside, c = +-10^-exponent A W or so, swinging short of both walls.
            let amplitude = random.uniform(0.05, 0.2);
            let problem = Problem::new(256, amplitude, random.magnitude(-1.0, 2.0), random.uniform(0.0, 6.3), 1, 1);
            let time = random.uniform(-10.0, 10.0);
            let position = random.uniform(-0.05, 0.05);
            let mut start = Start::inside(&problem, time, position, 0);
            let theta0 = Float::with_val(300, &problem.omega * &start.time) + &problem.tau;
            let scale = Float::with_val(300, &problem.amplitude * &problem.omega);
            let difference =
                (random.uniform(0.5, 1.0) * 10f64.powi(-exponent)) * if random.below(2) == 0 { 1.0 } else { -1.0 };
            start.velocity_after = Float::with_val(256, &scale * (difference - theta0.cos()));
            let (time, wall, _) = contact(&problem, &start);
            assert_eq!(wall, if difference > 0.0 { Wall::Right } else { Wall::Left });
            // On the wall at `time`, by eq. (11) with the whole phase.
            let miss = displacement(&problem, &start, &time) - problem.wall_at(wall);
            assert!(miss.to_f64().abs() < TRUTH_ON_THE_WALL, "{miss}");
            // In no forcing period before has the extreme of the same kind been there: it was lower by 2 pi c / W per forcing period, so it
            // is enough to look at the forcing period just before, densely.
            let turn = 2.0 * std::f64::consts::PI / problem.omega.to_f64();
            for index in 1..=200 {
                let earlier = Float::with_val(512, &time - turn * f64::from(index) / 200.0);
                let y = displacement(&problem, &start, &earlier) * wall.sign();
                assert!(y < 0.5, "{problem:?} {start:?} {index} {y}");
            }
        }
    }
}
