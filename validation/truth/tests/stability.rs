//! Every arithmetic says the same, as far as it goes, at the extremes: e = 0 and 1, A/d from 1e-9 to 1e9, 1e40 periods
//! after the start of time, the tiniest and largest units, chaos over 10,000 impacts at 100 digits, boxes of data.

use crate::common::arithmetics::{CERTIFIED, Run, assert_stable};
use crate::common::scene::{At, Scene, Value};
use crate::common::{Random, cases};
use impact_pair::contact::Reason;
use impact_pair::orbit::{Arithmetic, Outcome, Settings};
use impact_pair_truth::{Contact, Wall};
use rug::Float;
use std::collections::BTreeMap;

#[test]
fn the_figures_are_the_same_in_every_arithmetic() {
    for number in 12..=17 {
        print!("figure {number}: ");
        let runs = assert_stable(&Scene::figure(number), 200, 1536);
        for run in runs.iter().filter(|run| run.kind.0 == Arithmetic::Auto) {
            assert_eq!(run.len(), 200, "figure {number}, {:?}: {}", run.kind, run.end());
        }
    }
}

/// `mantissa` times 10 to the `exponent`, far beyond the range of doubles if need be, as text.
fn scaled(mantissa: f64, exponent: f64) -> String {
    let whole = exponent.floor();
    format!("{:.6}e{whole}", mantissa * 10f64.powf(exponent - whole))
}

fn pick<T: Copy>(random: &mut Random, from: &[T]) -> T {
    from[random.below(from.len() as u64) as usize]
}

/// Corners: what is drawn is often an end of its range, or nothing at all.
fn corner(random: &mut Random) -> Scene {
    let units = if random.below(2) == 0 { 3.0 } else { 280.0 };
    let (length, rate) = (random.uniform(-units, units), random.uniform(-units, units));
    let ratio = match random.below(4) {
        0 => pick(random, &[-9.0, 9.0]),
        1 => random.uniform(-9.0, 9.0),
        _ => random.uniform(-1.5, 1.5),
    };
    let omega = scaled(1.0, rate);
    let periods = pick(
        random,
        &["0", "0.25", "-0.5", "1e-12", "-7.3", "1e15", "1000000000000000.3", "-123456789012345678.9", "1e40", "1e-40"],
    );
    let direction = pick(random, &[-1.0, 1.0]);
    let speed = match random.below(4) {
        0 => 0.0,
        1 => random.magnitude(-9.0, 0.0),
        _ => random.uniform(0.0, 3.0),
    };
    let pace = if random.below(2) == 0 { length + ratio } else { length };
    let at = match random.below(4) {
        0 => At::Inside(Value(scaled(direction * random.uniform(0.0, 0.4999), length), None)),
        1 => At::Inside(Value(scaled(direction * (0.5 - random.magnitude(-5.0, -1.0)), length), None)),
        _ if direction > 0.0 => At::Wall(Wall::Right),
        _ => At::Wall(Wall::Left),
    };
    let restitution = match random.below(3) {
        0 => pick(random, &["0", "1"]).into(),
        1 => pick(random, &["1e-9", "0.999999999", "1/3", "0.8"]).into(),
        _ => Value::decimal((random.uniform(0.0, 1.0) * 1e4).round() / 1e4),
    };
    let velocity = if speed == 0.0 { "0".into() } else { scaled(direction * speed, pace + rate) };
    Scene {
        amplitude: Value(scaled(1.0, length + ratio), None),
        tau: pick(random, &["0", "pi/2", "pi", "1.047196", "-2"]).into(),
        gap: Value(scaled(1.0, length), None),
        restitution,
        time: Value(format!("{periods}*2*pi/{omega}"), None),
        omega: Value(omega, None),
        velocity: Value(velocity, None),
        at,
    }
}

#[test]
fn random_corners_are_the_same_in_every_arithmetic() {
    let mut random = Random::seeded(701);
    let mut ends = BTreeMap::<String, u32>::new();
    let (mut impacts, mut least) = (0, 0);
    for index in 0..cases(160) {
        let scene = corner(&mut random);
        print!("{index}: ");
        let runs = assert_stable(&scene, 14, 2048);
        // More bits go farther; `Bits(64)` has no more to offer than doubles have.
        for pair in runs[2..5].windows(2) {
            assert!(
                pair[0].len() <= pair[1].len() || pair[0].rests,
                "{:?} goes farther than {:?}: {scene:?}",
                pair[0].kind,
                pair[1].kind
            );
        }
        let autos = &runs[5..10];
        impacts += autos[0].len();
        least += runs[0].len();
        for run in autos {
            // The number of listed impacts of a chatter depends on the digits requested.
            assert!(run.rests || run.len() >= runs[0].len(), "{:?} {}: {scene:?}", run.kind, run.len());
            let same = (run.len(), run.end()) == (autos[0].len(), autos[0].end());
            assert!(run.rests || autos[0].rests || same, "{:?}: {scene:?}", run.kind);
        }
        // Motions that auto leaves open the truth does, too: the ball rests, never meets a wall again, or in 2^52 forcing periods.
        if let Outcome::Undecided { reason, .. } = autos[0].outcome() {
            let truth = scene.truth(2048, [0.0; 5], autos[0].len() + 1);
            let goes_on = truth.len() > autos[0].len();
            let is_far = *reason == Reason::Budget && goes_on && {
                let since = truth.iter().rev().nth(1).map_or_else(|| scene.time.member(2048, 0.0), |x| x.time.clone());
                let turns = (truth[truth.len() - 1].time.clone() - since) * scene.omega.member(2048, 0.0);
                turns > 2.0f64.powi(52)
            };
            assert!(!goes_on || is_far, "auto ends after {} impacts with {}: {scene:?}", autos[0].len(), reason.name());
        }
        *ends.entry(autos[0].end()).or_default() += 1;
    }
    println!("{impacts} impacts in auto, {least} in interval; the orbits end {ends:?}");
    assert!(impacts > cases(1000));
}

#[test]
fn figure_14_at_100_digits_for_3_000_impacts() {
    let scene = Scene::figure(14);
    let impacts = 3_000;
    let [nine, hundred] = [9, 100].map(|digits| Run::new(&scene, (Arithmetic::Auto, digits), impacts));
    assert_eq!((nine.len(), hundred.len()), (3_000, 3_000));
    println!("{} and {} steps, {} and {} bits", nine.steps, hundred.steps, nine.orbit.bits(), hundred.orbit.bits());
    for run in [&nine, &hundred] {
        run.assert_narrow(&scene);
        assert!(run.orbit.first_wide().is_none());
    }
    hundred.assert_meets(&nine, &scene);
    let truth = scene.truth(2048, [0.0; 5], 1000);
    let mut start = Run { impacts: hundred.impacts[..1000].to_vec(), ..hundred };
    start.bounds.truncate(1000);
    assert_eq!(start.objection(&truth), None);
}

#[test]
fn elastic_orbits_of_1_000_impacts_at_30_digits() {
    for (amplitude, velocity, at) in [("2", "-9", Wall::Left), ("30", "0", Wall::Left)] {
        let scene = Scene {
            amplitude: amplitude.into(),
            omega: "2*pi".into(),
            tau: "0.3".into(),
            gap: "1".into(),
            restitution: "1".into(),
            time: "0".into(),
            velocity: velocity.into(),
            at: At::Wall(at),
        };
        let run = Run::new(&scene, (Arithmetic::Auto, 30), 1000);
        println!("A = {amplitude}: {} impacts in {} bits, {}", run.len(), run.orbit.bits(), run.end());
        assert_eq!(run.len(), 1000, "{}", run.end());
        run.assert_narrow(&scene);
        if let Some(objection) = run.objection(&scene.truth(4096, [0.0; 5], 1000)) {
            panic!("{objection}; {scene:?}");
        }
    }
}

/// Equations (70), (71) with tau at a crest: cos th = 0, impacts at `i N pi/W`, |v| = (d -+ 2 A) W/(N pi) for odd N and
/// d W/(N pi) for even N.
#[test]
fn elastic_orbits_of_70_and_71_return_a_thousand_times_exactly() {
    // A W <= |v|: the flights are monotone.
    for (n, tau, velocity) in [(1, "pi/2", "-29/5"), (1, "-pi/2", "-31/5"), (2, "pi/2", "-3"), (3, "-pi/2", "-31/15")] {
        let scene = Scene {
            amplitude: "0.05".into(),
            omega: "2*pi".into(),
            tau: tau.into(),
            gap: "3".into(),
            restitution: "1".into(),
            time: "0".into(),
            velocity: velocity.into(),
            at: At::Wall(Wall::Left),
        };
        let run = Run::new(&scene, (Arithmetic::Auto, 30), 1000);
        println!("N = {n}, tau = {tau}: {} impacts in {} bits, {}", run.len(), run.orbit.bits(), run.end());
        assert_eq!(run.len(), 1000);
        run.assert_narrow(&scene);
        let speed = -scene.velocity.member(1024, 0.0);
        let closed: Vec<Contact> = (1..=1000)
            .map(|index| {
                let wall = if index % 2 == 0 { Wall::Left } else { Wall::Right };
                let time = Float::with_val(1024, n * index) / 2;
                Contact { time, wall, velocity_before: Float::with_val(1024, &speed * wall.sign()) }
            })
            .collect();
        assert_eq!(run.objection(&closed), None);
    }
}

#[test]
fn whole_periods_before_the_start_change_nothing() {
    let shifts = ["", "-1000000000000000", "1234567890123456789012345678901234567890"];
    let starts = [("2*pi", "1"), ("200*pi", "100"), ("pi", "1/2"), ("20*pi/3", "10/3")];
    for (index, (omega, rate)) in starts.into_iter().enumerate() {
        for place in [At::Wall(Wall::Left), At::Wall(Wall::Right), At::Inside("0.1".into())] {
            let scene = |shift: &str| {
                let sign = if shift.starts_with('-') { "-" } else { "" };
                let (whole, part) = match (shift.trim_start_matches('-'), sign) {
                    ("", _) => ("0".into(), "3".into()),
                    // -(n - 1) + 0.3 is -(n - 1.3).
                    (digits, "-") => ((digits.parse::<u64>().expect("digits") - 1).to_string(), "7".to_string()),
                    (digits, _) => (digits.to_string(), "3".into()),
                };
                Scene {
                    amplitude: ["8", "0.3", "1", "2"][index].into(),
                    omega: omega.into(),
                    tau: ["0", "pi/3", "1.047196", "-2"][index].into(),
                    gap: "1".into(),
                    restitution: ["0.5", "1", "0.8", "0"][index].into(),
                    time: format!("{sign}{whole}.{part}/{rate}")
                        .replace("/10/3", "*3/10")
                        .replace("/1/2", "*2")
                        .as_str()
                        .into(),
                    velocity: if place_sign(&place) { "2.5" } else { "-2.5" }.into(),
                    at: place.clone(),
                }
            };
            for kind in CERTIFIED.into_iter().chain([(Arithmetic::Float, 9)]) {
                let runs = shifts.map(|shift| Run::new(&scene(shift), kind, 30));
                for (run, shift) in runs.iter().zip(shifts).skip(1) {
                    assert_eq!(run.impacts, runs[0].impacts, "{kind:?}, shift {shift:?}: {:?}", scene(shift));
                    assert_eq!(run.end(), runs[0].end());
                    if kind.0 == Arithmetic::Float {
                        continue;
                    }
                    let scene = scene(shift);
                    assert_eq!(run.objection(&scene.truth(2048, [0.0; 5], run.len())), None, "{scene:?}");
                    if kind.0 == Arithmetic::Auto {
                        run.assert_narrow(&scene);
                        assert!(run.len() == 30 || run.rests || run.end() == "graze", "{} {}", run.len(), run.end());
                    }
                }
            }
        }
    }
}

/// Whether a start has its velocity to the right here: on the right wall, and nowhere else.
fn place_sign(place: &At) -> bool {
    matches!(place, At::Wall(Wall::Right))
}

/// A scene with one interval among its data, and four of its members.
fn members(scene: &Scene, key: &str, [low, high]: [&str; 2]) -> (Scene, Vec<Scene>) {
    let with = |value: Value| {
        let mut scene = scene.clone();
        match key {
            "gap" => scene.gap = value,
            "velocity" => scene.velocity = value,
            _ => panic!("no {key}"),
        }
        scene
    };
    let whole = with(Value(low.into(), Some(high.into())));
    let inner = |part: f64| {
        let [low, high] = [low, high].map(|end| Value::from(end).member(600, 0.0));
        let member: Float = Float::with_val(600, &high - &low) * part + low;
        Value(member.to_string_radix(10, Some(170)), None)
    };
    let members = [low.into(), inner(0.375), inner(0.8125), high.into()];
    (whole, members.into_iter().map(with).collect())
}

/// Asserts that the run holds the orbits of all members.
fn assert_holds_members(run: &Run, members: &[Scene]) {
    for member in members {
        if let Some(objection) = run.objection(&member.truth(1024, [0.0; 5], run.len())) {
            panic!("{objection}; {member:?}");
        }
    }
}

#[test]
fn boxes_of_data_end_by_their_own_width() {
    let boxes = [
        (12, "gap", ["9.42496", "9.42498"]),
        (13, "gap", ["9.42496", "9.42498"]),
        (14, "gap", ["9.42496", "9.42498"]),
        (14, "gap", ["9", "10"]),
        (14, "gap", ["5", "15"]),
        (14, "velocity", ["-12.6", "-12.5"]),
        (14, "velocity", ["-20", "-1"]),
        (16, "velocity", ["-2.0000001", "-2"]),
        (17, "velocity", ["-1e-9", "0"]),
        (15, "gap", ["1", "1.000000000001"]),
    ];
    for (number, key, ends) in boxes {
        let (scene, members) = members(&Scene::figure(number), key, ends);
        let interval = Run::new(&scene, (Arithmetic::Interval, 9), 120);
        let kinds =
            [(Arithmetic::Auto, 9), (Arithmetic::Auto, 30), (Arithmetic::Bits(256), 9), (Arithmetic::Bits(64), 9)];
        let runs = kinds.map(|kind| Run::new(&scene, kind, 120));
        let lines = runs.iter().map(|run| format!("{:?} {} {} in {} steps", run.kind, run.len(), run.end(), run.steps));
        println!(
            "{number} {key} {ends:?}: interval {} {}; {:?}",
            interval.len(),
            interval.end(),
            lines.collect::<Vec<_>>()
        );
        assert_holds_members(&interval, &members);
        for run in &runs {
            assert_holds_members(run, &members);
            assert!(run.len() >= interval.len(), "{:?}: {} of {}", run.kind, run.len(), interval.len());
            if let Outcome::Undecided { reason, .. } = run.outcome() {
                assert!(matches!(reason, Reason::Width | Reason::Graze), "{:?}: {}", run.kind, reason.name());
            }
        }
    }
}

#[test]
fn intervals_narrower_than_doubles_are_followed_farther() {
    let low = "-12.5663600000000000000000000000000000000000";
    let high = "-12.5663599999999999999999999999999999999999";
    let (scene, members) = members(&Scene::figure(14), "velocity", [low, high]);
    let interval = Run::new(&scene, (Arithmetic::Interval, 9), 1000);
    for kind in [(Arithmetic::Auto, 9), (Arithmetic::Auto, 30), (Arithmetic::Bits(256), 9)] {
        let run = Run::new(&scene, kind, 1000);
        println!("{kind:?}: {} {} in {} steps; interval {}", run.len(), run.end(), run.steps, interval.len());
        assert!(run.len() > 180 && interval.len() < 100, "{kind:?} {}", run.len());
        assert!(matches!(run.outcome(), Outcome::Undecided { reason: Reason::Width | Reason::Graze, .. }));
        assert_holds_members(&run, &members);
    }
}

#[test]
fn few_bits_at_most_end_in_precision() {
    for (digits, max_bits) in [(15, 64), (30, 64), (30, 100), (9, 100), (100, 100), (100, 300)] {
        let scene = Scene::figure(14);
        let settings = Settings { digits, max_bits, ..Settings::default() };
        let run = Run::within(&scene, settings, 1000);
        println!("{digits} digits, {max_bits} bits: {} impacts, {} in {} steps", run.len(), run.end(), run.steps);
        assert!(matches!(run.outcome(), Outcome::Undecided { reason: Reason::Precision, .. }), "{}", run.end());
        run.assert_narrow(&scene);
        assert_eq!(run.objection(&scene.truth(1024, [0.0; 5], run.len())), None);
    }
}

/// Without velocity at theta = 0 or pi only the third derivative moves the ball, very little at first.
#[test]
fn releases_are_decided_in_every_arithmetic() {
    for amplitude in ["1e-9", "1e-3", "1", "1e3", "1e9"] {
        for (tau, at) in [
            ("pi", At::Inside("0.3".into())),
            ("0", At::Inside("0.3".into())),
            ("pi", At::Inside("-0.49".into())),
            ("0", At::Wall(Wall::Left)),
            ("pi", At::Wall(Wall::Right)),
        ] {
            let scene = Scene {
                amplitude: amplitude.into(),
                omega: "2*pi".into(),
                tau: tau.into(),
                gap: "1".into(),
                restitution: "0.9".into(),
                time: "0".into(),
                velocity: "0".into(),
                at,
            };
            for bits in (64..=256).step_by(8).map(|bits| (Arithmetic::Bits(bits), 9)).chain(CERTIFIED) {
                let run = Run::new(&scene, bits, 1);
                let doubles = matches!(bits.0, Arithmetic::Interval | Arithmetic::Inari);
                assert!(doubles || run.len() == 1, "{bits:?}: {} {scene:?}", run.end());
                assert_eq!(run.objection(&scene.truth(2048, [0.0; 5], run.len())), None, "{scene:?}");
            }
        }
    }
}

/// Motions that no precision decides cost little: a ball that grazes its wall once in each forcing period for ever (the paper's model II), and
/// a drift that takes more than 2^52 forcing periods to cross the gap.
#[test]
fn exact_grazes_cost_little() {
    let scene = |tau: &str, time: &str| Scene {
        amplitude: "0.01".into(),
        omega: "2*pi".into(),
        tau: tau.into(),
        gap: "1".into(),
        restitution: "1".into(),
        time: time.into(),
        velocity: "0".into(),
        at: At::Wall(Wall::Left),
    };
    for (scene, end) in [(scene("pi/2", "0"), "periodic"), (scene("pi/2", "-1e-60"), "budget")] {
        let run = Run::new(&scene, (Arithmetic::Auto, 9), 5);
        println!("{} after {} steps, {} bits", run.end(), run.steps, run.orbit.bits());
        assert_eq!(run.end(), end);
        assert!(run.orbit.bits() < 5_000, "{} bits", run.orbit.bits());
    }
}

/// Flights of more than 2^39 forcing periods, which doubles leave to multiprecision: the forcing period of the contact is a division.
#[test]
fn flights_of_a_trillion_periods_end_in_the_right_period() {
    let mut random = Random::seeded(702);
    for _ in 0..cases(60) {
        let wall = pick(&mut random, &[Wall::Left, Wall::Right]);
        let scene = Scene {
            amplitude: Value(format!("{:.5}e-13", random.uniform(0.3, 2.0)), None),
            omega: "2*pi".into(),
            tau: Value(format!("{:.5}", random.uniform(-3.0, 3.0)), None),
            gap: "1".into(),
            restitution: "1".into(),
            time: "0".into(),
            velocity: Value(format!("{:.5}e-13", -random.uniform(0.0, 6.0) * f64::from(-wall.sign())), None),
            at: At::Wall(wall),
        };
        let truth = scene.truth(1024, [0.0; 5], 1);
        for kind in [(Arithmetic::Bits(128), 9), (Arithmetic::Bits(256), 9), (Arithmetic::Auto, 9)] {
            let run = Run::new(&scene, kind, 1);
            assert_eq!(run.objection(&truth), None, "{scene:?}");
            assert_eq!(run.len(), truth.len(), "{kind:?}: {} {scene:?}", run.end());
        }
    }
}
