//! `Certificate::check`: right certificates are confirmed, wrong ones refuted, to the last printed unit.
//!
//! The truth is that of the reference simulator in MPFR.

use crate::common;
use crate::common::Random;
use crate::common::scene::{At, Scene, Value};
use impact_pair::orbit::Settings;
use impact_pair::watch::Unwatched;
use impact_pair_certificate::{Certificate, Verdict};
use impact_pair_truth::Wall;
use rug::ops::Pow;
use rug::{Float, Integer, Rational};
use serde_json::{Value as Json, json};

/// The orbit JSON of a scene.
fn document(scene: &Scene, impacts: u64, digits: u32) -> Json {
    let (pair, start) = scene.library().unwrap();
    let settings = Settings { impacts: Some(impacts), digits, ..Settings::default() };
    serde_json::to_value(impact_pair::document::orbit(&pair, &start, settings).unwrap()).unwrap()
}

fn verdict(document: &Json) -> Verdict {
    Certificate::parse(&document.to_string()).unwrap().check(&Unwatched).unwrap()
}

fn assert_confirmed(document: &Json) {
    let verdict = verdict(document);
    assert!(matches!(verdict, Verdict::Confirmed { .. }), "{verdict:?} of {document}");
}

/// Refuted at `event`, or at an event that follows from it.
fn assert_refuted(document: &Json, event: usize) {
    match verdict(document) {
        Verdict::Refuted(finding) => assert_eq!(finding.event, event, "{} of {document}", finding.message),
        other => panic!("{other:?} of {document}"),
    }
}

/// Neither proved nor passed over.
fn assert_not_confirmed(document: &Json) {
    assert!(!matches!(verdict(document), Verdict::Confirmed { .. }), "{document}");
}

/// A printed decimal as mantissa and power of ten.
fn units(decimal: &str) -> (Integer, i32) {
    let (number, power) = decimal.split_once('e').unwrap_or((decimal, "0"));
    let (whole, part) = number.split_once('.').unwrap_or((number, ""));
    let mantissa = format!("{whole}{part}").parse().unwrap();
    (mantissa, power.parse::<i32>().unwrap() - part.len() as i32)
}

/// `decimal` and `n` units of its last place more.
fn moved(decimal: &str, n: &Integer) -> String {
    let (mantissa, power) = units(decimal);
    format!("{}e{power}", mantissa + n)
}

/// Number of whole units of its last place that lie between a bound and the truth.
fn units_to(decimal: &str, truth: &Float) -> Integer {
    let (mantissa, power) = units(decimal);
    let unit = Rational::from(Integer::from(10).pow(power.unsigned_abs()));
    let unit = if power < 0 { unit.recip() } else { unit };
    let distance = truth.to_rational().unwrap() - Rational::from(mantissa) * &unit;
    let distance: Rational = distance.abs() / unit;
    distance.trunc().numer().clone()
}

#[test]
fn figures_are_confirmed() {
    for figure in 12..=17 {
        assert_confirmed(&document(&Scene::figure(figure), 200, 9));
    }
}

/// Each bound may be moved inward up to the truth, and not one unit farther: all four of each impact.
#[test]
fn a_bound_is_refused_from_the_unit_on_that_makes_it_false() {
    for (figure, impacts) in [(13, 6), (14, 12), (15, 6), (17, 8)] {
        let scene = Scene::figure(figure);
        let document = document(&scene, impacts as u64, 9);
        let truth = scene.truth(400, [0.5; 5], impacts);
        for (i, contact) in truth.iter().enumerate() {
            for (key, value) in [("time", &contact.time), ("velocity", &contact.velocity_before)] {
                for (end, sign) in [(0, 1), (1, -1)] {
                    let bound = document["events"][i][key][end].as_str().unwrap().to_owned();
                    let last = units_to(&bound, value);
                    let mut edited = document.clone();
                    edited["events"][i][key][end] = json!(moved(&bound, &Integer::from(&last * sign)));
                    assert_confirmed(&edited);
                    edited["events"][i][key][end] = json!(moved(&bound, &((last + 1u32) * sign)));
                    assert_refuted(&edited, i);
                }
            }
        }
    }
}

#[test]
fn false_claims_are_refused() {
    let whole = document(&Scene::figure(14), 20, 9);
    let edited = |edit: &dyn Fn(&mut Json)| {
        let mut copy = whole.clone();
        edit(&mut copy);
        copy
    };
    // An impact passed over, and the later ones renumbered.
    for passed in [0, 3, 4, 11] {
        let skipped = edited(&|copy| {
            let events = copy["events"].as_array_mut().unwrap();
            events.remove(passed);
            let mut from = json!("left");
            for (i, event) in events.iter_mut().enumerate() {
                let mapping = match (from == "left", event["wall"] == "left") {
                    (false, true) => "P1",
                    (true, false) => "P2",
                    (false, false) => "P3",
                    (true, true) => "P4",
                };
                (event["index"], event["mapping"]) = (json!(i + 1), json!(mapping));
                from = event["wall"].clone();
            }
        });
        assert_refuted(&skipped, passed);
    }
    let twice = edited(&|copy| {
        let again = copy["events"][5].clone();
        copy["events"].as_array_mut().unwrap().insert(6, again);
    });
    assert_refuted(&twice, 6);
    assert_refuted(&edited(&|copy| copy["events"][7]["mapping"] = json!("P1")), 7);
    let inverted = edited(&|copy| copy["events"][7]["time"].as_array_mut().unwrap().reverse());
    assert!(Certificate::parse(&inverted.to_string()).is_err());
    assert_not_confirmed(&edited(&|copy| {
        copy["events"][7]["wall"] = json!("left");
        copy["events"][7]["mapping"] = json!("P1");
    }));
    for (key, value) in [("restitution", "0.500000000001"), ("gap", "9.42497000001")] {
        assert_refuted(&edited(&|copy| copy["scene"][key] = json!(value)), 0);
    }
    // Shifted by a millionth of a period.
    let shifted = edited(&|copy| {
        for end in 0..2 {
            let bound = copy["events"][9]["time"][end].as_str().unwrap().to_owned();
            let (_, power) = units(&bound);
            copy["events"][9]["time"][end] =
                json!(moved(&bound, &(Integer::from(10).pow((-6 - power).unsigned_abs()) * 2)));
        }
    });
    assert_refuted(&shifted, 9);
}

fn chatter() -> Scene {
    Scene {
        amplitude: "1".into(),
        omega: "pi".into(),
        tau: "pi".into(),
        gap: "9.42497".into(),
        restitution: "0.3".into(),
        time: "0".into(),
        velocity: "-0.5".into(),
        at: At::Wall(Wall::Left),
    }
}

#[test]
fn rests_and_releases_are_compared() {
    let whole = document(&chatter(), 40, 9);
    assert_confirmed(&whole);
    let events = whole["events"].as_array().unwrap();
    let at = |name: &str| events.iter().position(|event| event["event"] == name).unwrap();
    let (rest, release) = (at("rest"), at("release"));
    let edited = |edit: &dyn Fn(&mut Json)| {
        let mut copy = whole.clone();
        edit(&mut copy);
        copy
    };
    assert_refuted(&edited(&|copy| copy["events"][release]["time"] = json!(["3", "3"])), release);
    assert_refuted(&edited(&|copy| copy["events"][release]["time"] = json!(["0.999999999", "0.9999999999"])), release);
    assert_refuted(&edited(&|copy| copy["events"][rest]["time"] = json!(["0.2181", "0.2182"])), rest);
    assert_refuted(&edited(&|copy| copy["events"][rest]["wall"] = json!("right")), rest);
    let unrested = edited(&|copy| {
        copy["events"].as_array_mut().unwrap().remove(rest);
    });
    assert_refuted(&unrested, rest);
    let unreleased = edited(&|copy| {
        copy["events"].as_array_mut().unwrap().remove(release);
    });
    assert_refuted(&unreleased, release);
    assert_not_confirmed(&edited(&|copy| copy["outcome"]["period"]["impacts"] = json!(22)));
    assert_not_confirmed(&edited(&|copy| copy["outcome"]["kind"] = json!("never-impacts")));
}

/// Orbits of random scenes. With intervals among the data what is found need not lie inside what is claimed, though both hold
/// the truth; then nothing is refuted, and most are confirmed all the same.
#[test]
fn orbits_of_random_scenes_are_confirmed() {
    let mut random = Random::seeded(0x00c4_ec4e_d0c5);
    let (mut boxes, mut confirmed) = (0, 0);
    for case in 0..common::cases(30) {
        let width = if case % 2 == 0 { 0.0 } else { random.magnitude(-12.0, -5.0) };
        let gap = random.magnitude(-2.0, 2.0);
        let amplitude = gap * random.magnitude(-2.0, 1.0);
        let omega = random.magnitude(-1.0, 2.0);
        let velocity = -amplitude * omega * random.uniform(0.0, 5.0);
        let scene = Scene {
            amplitude: Value::between(amplitude, amplitude * width),
            omega: Value::decimal(omega),
            tau: Value::between(random.uniform(-3.0, 3.0), width),
            gap: Value::between(gap, gap * width),
            restitution: Value::between(random.uniform(0.1, 0.9), width),
            time: Value::decimal(random.uniform(-10.0, 10.0)),
            velocity: Value::between(velocity, velocity * width),
            at: At::Wall(Wall::Left),
        };
        if width == 0.0 {
            assert_confirmed(&document(&scene, 30, 9));
            continue;
        }
        let document = document(&scene, 3, 9);
        let verdict = verdict(&document);
        assert!(!matches!(verdict, Verdict::Refuted(_)), "{verdict:?} of {document}");
        boxes += 1;
        confirmed += usize::from(matches!(verdict, Verdict::Confirmed { .. }));
    }
    println!("{confirmed} of {boxes} boxes confirmed");
    assert!(10 * confirmed >= 7 * boxes);
}
