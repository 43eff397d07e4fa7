//! The far ends: lengths of 1e-300 and 1e300, a trillion periods, no shaking to speak of, nothing but shaking.

use crate::common::scene::{At, Scene, Value, judge};
use crate::common::{Random, cases};
use impact_pair::ErrorKind;
use impact_pair::orbit::{Impact, Outcome};
use impact_pair_truth::Wall;

/// `mantissa` times 10 to the `exponent`, far beyond the range of doubles if need be, as text.
fn scaled(mantissa: f64, exponent: f64) -> Value {
    let whole = exponent.floor();
    let head = mantissa * 10f64.powf(exponent - whole);
    Value(format!("{head:.6}e{whole}"), None)
}

/// Logarithms (base 10) of length, time and A/d at random; everything else in proportion.
fn random_scene(random: &mut Random, lengths: f64, times: f64, ratios: f64) -> Scene {
    let (length, time) = (random.uniform(-lengths, lengths), random.uniform(-times, times));
    let amplitude = length + random.uniform(-ratios, ratios);
    let mut part = || [0.0, 1e-9, 0.3, 1.0, 7.5][random.below(5) as usize];
    let (speed, share) = (part(), part() / 20.0);
    let periods = random.magnitude(-12.0, 12.0) * if random.below(2) == 0 { 1.0 } else { -1.0 };
    let direction = if random.below(2) == 0 { 1.0 } else { -1.0 };
    let pace = if random.below(2) == 0 { amplitude } else { length };
    let at = match random.below(3) {
        0 => At::Inside(scaled(share * direction, length)),
        _ if direction > 0.0 => At::Wall(Wall::Right),
        _ => At::Wall(Wall::Left),
    };
    Scene {
        amplitude: scaled(1.0, amplitude),
        omega: scaled(1.0, -time),
        tau: ["0", "pi/2", "1.047196", "-2"][random.below(4) as usize].into(),
        gap: scaled(1.0, length),
        restitution: ["0", "1", "0.8", "0.5", "1e-9", "0.999999999"][random.below(6) as usize].into(),
        time: scaled(periods, time),
        velocity: scaled(direction * speed, pace - time),
        at,
    }
}

#[test]
fn orbits_at_the_far_ends_are_right_or_undecided_or_an_error() {
    let mut random = Random::seeded(401);
    let (mut refused, mut impacts, mut ended) = (0, 0, 0);
    for index in 0..cases(800) {
        let (lengths, times) = if index % 2 == 0 { (300.0, 0.0) } else { (300.0, 300.0) };
        let scene = random_scene(&mut random, lengths, times, if index % 8 == 7 { 150.0 } else { 9.0 });
        match scene.orbit(1) {
            Err(error) => {
                refused += 1;
                assert!(error.kind() == ErrorKind::OutOfRange && error.to_string().len() < 600, "{error}: {scene:?}");
                assert!(index % 8 == 7, "{error}: {scene:?}");
            }
            Ok(_) => {
                let (found, outcome) = judge(&scene, 768, 12, &[[0.0; 5]]);
                impacts += found;
                ended += usize::from(matches!(outcome, Some(Outcome::Undecided { .. })));
            }
        }
    }
    println!("{impacts} impacts, {ended} orbits undecided, {refused} scenes refused");
    assert!(impacts > cases(2000));
}

/// The scene with lengths times 2^`lengths` and times times 2^`times`.
fn rescaled(scene: &Scene, lengths: i32, times: i32) -> Scene {
    let by = |value: &Value, power: i32| {
        let end = |text: &String| format!("({text})*2^({power})");
        Value(end(&value.0), value.1.as_ref().map(end))
    };
    Scene {
        amplitude: by(&scene.amplitude, lengths),
        omega: by(&scene.omega, -times),
        tau: scene.tau.clone(),
        gap: by(&scene.gap, lengths),
        restitution: scene.restitution.clone(),
        time: by(&scene.time, times),
        velocity: by(&scene.velocity, lengths - times),
        at: match &scene.at {
            At::Inside(position) => At::Inside(by(position, lengths)),
            At::Wall(wall) => At::Wall(*wall),
        },
    }
}

#[test]
fn units_of_powers_of_two_change_nothing() {
    let mut random = Random::seeded(402);
    let answer = |scene: &Scene| -> (Vec<Impact>, String) {
        let mut orbit = scene.orbit(25).unwrap_or_else(|error| panic!("{error}: {scene:?}"));
        let impacts = orbit.by_ref().collect();
        let end = match orbit.outcome().expect("an end") {
            Outcome::Undecided { reason, wall, .. } => format!("undecided {reason:?} {wall:?}"),
            reached => reached.kind().into(),
        };
        (impacts, end)
    };
    let mut compared = 0;
    for _ in 0..cases(300) {
        let scene = random_scene(&mut random, 3.0, 3.0, 2.0);
        let expected = answer(&scene);
        for _ in 0..3 {
            let power = |random: &mut Random| random.below(1800) as i32 - 900;
            let other = rescaled(&scene, power(&mut random), power(&mut random));
            assert_eq!(answer(&other), expected, "{scene:?} as {other:?}");
            compared += expected.0.len();
        }
    }
    println!("{compared} impacts are the same in other units");
}
