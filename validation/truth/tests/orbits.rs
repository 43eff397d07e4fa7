//! Thousands of orbits in physical units: every certified impact against the truth, none missed.

use crate::common::scene::{At, Scene, Value, judge, truth_ends};
use crate::common::{Random, cases};
use impact_pair::orbit::Outcome;
use impact_pair_truth::Wall;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// A number of at most `digits` digits near `value`.
fn short(value: f64, digits: usize) -> f64 {
    format!("{value:.digits$e}").parse().expect("a number")
}

fn sign(random: &mut Random) -> f64 {
    if random.below(2) == 0 { 1.0 } else { -1.0 }
}

/// A frequency, and about how large it is.
fn random_frequency(random: &mut Random) -> (Value, f64) {
    match random.below(3) {
        0 => {
            let factor = 1 + random.below(200);
            (Value::from(format!("{factor}*pi").as_str()), factor as f64 * TAU / 2.0)
        }
        1 => (Value::from("2*pi/3"), TAU / 3.0),
        _ => {
            let rate = short(random.magnitude(-2.0, 4.0), 5);
            (Value::decimal(rate), rate)
        }
    }
}

/// A scene of decimals; `width` > 0 makes boxes of some of them, so wide relative to their size.
fn random_scene(random: &mut Random, width: f64) -> Scene {
    let gap = short(random.magnitude(-3.0, 3.0), 5);
    let amplitude = short(gap * random.magnitude(-2.0, 1.5), 6);
    let (omega, rate) = random_frequency(random);
    let tau = match random.below(4) {
        0 => "0".into(),
        1 => "pi/2".into(),
        2 => "-2*pi/3".into(),
        _ => Value::decimal(short(random.uniform(-7.0, 7.0), 7)),
    };
    let mut spread = |value: f64| {
        let is_box = width > 0.0 && random.below(2) == 0;
        Value::between(value, if is_box { -value.signum() * width * value.abs() } else { 0.0 })
    };
    let amplitude_value = spread(amplitude);
    let boxes = [spread(1.0), spread(1.0), spread(1.0)].map(|value| value.1.is_some());
    let restitution = match random.below(5) {
        0 => Value::from("0"),
        1 => Value::from("1"),
        _ => {
            let e = short(random.uniform(0.01, 0.99), 3);
            Value::between(e, if boxes[0] { width * e * 0.01 } else { 0.0 })
        }
    };
    let periods = match random.below(4) {
        0 => 0.0,
        1 => random.uniform(-10.0, 10.0),
        2 => sign(random) * random.magnitude(0.0, 12.0),
        _ => random.uniform(0.0, 1.0),
    };
    let time = short(periods * TAU / rate, 14);
    let time = Value::between(time, if boxes[1] { width * TAU / rate } else { 0.0 });
    let times = match random.below(6) {
        0 => 0.0,
        1 => random.magnitude(-6.0, 0.0),
        2 => random.magnitude(0.0, 1.0),
        _ => random.uniform(0.0, 2.0),
    };
    let speed = short(amplitude * rate * times, 6);
    let along = if boxes[2] { width * speed } else { 0.0 };
    let (velocity, at) = match random.below(3) {
        0 => (Value::between(-speed, -along), At::Wall(Wall::Left)),
        1 => (Value::between(speed, along), At::Wall(Wall::Right)),
        _ => {
            let place = short(gap * random.uniform(-0.499, 0.499), 6);
            let direction = sign(random);
            let position = Value::between(place, if boxes[1] { -width * place } else { 0.0 });
            (Value::between(direction * speed, direction * along), At::Inside(position))
        }
    };
    let gap = Value::decimal(gap);
    Scene { amplitude: amplitude_value, omega, tau, gap, restitution, time, velocity, at }
}

/// Counts of how orbits end.
#[derive(Default)]
struct Ends(BTreeMap<String, usize>, usize);

impl Ends {
    fn add(&mut self, scene: &Scene, (found, outcome): (usize, Option<Outcome>)) {
        let name = match outcome.expect("the orbit ended") {
            Outcome::Undecided { .. } if truth_ends(scene, 512, found) => "as the truth does".into(),
            Outcome::Undecided { reason, .. } => format!("undecided after {}: {}", found.min(3), reason.name()),
            reached => reached.kind().into(),
        };
        *self.0.entry(name).or_default() += 1;
        self.1 += found;
    }
}

fn point_orbits(seed: u64) {
    let mut random = Random::seeded(seed);
    let mut ends = Ends::default();
    for _ in 0..cases(1500) {
        let scene = random_scene(&mut random, 0.0);
        let contracting = scene.restitution.0.parse::<f64>().is_ok_and(|e| e < 0.3);
        ends.add(&scene, judge(&scene, 512, if contracting { 80 } else { 30 }, &[[0.0; 5]]));
    }
    println!("{} impacts; the orbits end {:?} (after 3: three or more)", ends.1, ends.0);
    assert!(ends.1 > cases(15_000));
}

#[test]
fn random_orbits_hold_the_truth() {
    point_orbits(201);
}

#[test]
fn more_random_orbits_hold_the_truth() {
    point_orbits(202);
}

#[test]
fn orbits_of_boxes_hold_the_orbits_of_their_members() {
    let mut random = Random::seeded(203);
    let mut ends = Ends::default();
    for _ in 0..cases(800) {
        let width = random.magnitude(-13.0, -3.0);
        let scene = random_scene(&mut random, width);
        let corner = |bits: u64| [0, 1, 2, 3, 4].map(|axis| (bits >> axis & 1) as f64);
        let (first, second) = (random.below(32), random.below(32));
        let inner = [0; 5].map(|_| random.uniform(0.0, 1.0));
        ends.add(&scene, judge(&scene, 512, 20, &[corner(first), corner(31 - first), corner(second), inner]));
    }
    println!("{} impacts of boxes; the orbits end {:?}", ends.1, ends.0);
    assert!(ends.1 > cases(2_000));
}

#[test]
fn figures_12_to_17_hold_the_truth_as_far_as_double_precision_reaches() {
    let figures = [
        (12, Scene::figure(12), 2000, 2000),
        (13, Scene::figure(13), 2000, 2000),
        (14, Scene::figure(14), 200, 80),
        (15, Scene::figure(15), 2000, 2000),
        (16, Scene::figure(16), 400, 143),
        (17, Scene::figure(17), 200, 64),
    ];
    for (number, scene, requested, least) in figures {
        let (found, outcome) = judge(&scene, 1024, requested, &[[0.0; 5]]);
        println!("figure {number}: {found} impacts, then {}", outcome.expect("an end").kind());
        assert!(found >= least, "figure {number}: {found} impacts");
    }
}
