//! `check` on certificates of motions that are attracted, under one harmonic and several: right ones are confirmed, corrupted ones
//! are not. Lemma V6

use impact_pair::Scene;
use impact_pair::document;
use impact_pair::orbit::{Arithmetic, Settings};
use impact_pair::watch::Unwatched;
use impact_pair_certificate::{Certificate, Verdict};
use proptest::prelude::*;
use serde_json::{Value, json};

/// The orbit JSON of a scene, its attractor included.
fn document(scene: &str) -> Value {
    let scene = Scene::parse(scene).unwrap();
    let settings = Settings { arithmetic: Arithmetic::Interval, attractor: true, ..scene.settings() };
    serde_json::to_value(document::orbit(scene.pair(), scene.start(), settings).unwrap()).unwrap()
}

fn scene(excitation: &str, pair: &str, velocity: &str, impacts: u32) -> String {
    format!(
        "excitation = {{ {excitation} }}\npair = {{ {pair} }}\n\
         start = {{ time = 0, wall = \"left\", velocity = {velocity} }}\nrun = {{ impacts = {impacts} }}"
    )
}

/// Scenes whose motions are attracted: a symmetric orbit, one that is not, flights of more than a forcing period, and sums with and
/// without a mirror.
fn attracted() -> Vec<(&'static str, Value)> {
    let one = |amplitude: &str| format!("amplitude = {amplitude}, frequency = \"pi\", phase = 0");
    let several = |amplitudes: &str, frequencies: &str| {
        format!("amplitude = [{amplitudes}], frequency = [{frequencies}], phase = 0")
    };
    let pair = "gap = 9.42497, restitution = 0.5";
    [
        ("figure 13", scene(&one("2"), pair, "-12.56636", 40)),
        ("intervals", scene(&one("\"[2, 2 + 1e-7]\""), pair, "-12.56636", 40)),
        ("odd", scene(&several("1, \"1/9\"", "\"pi\", \"3*pi\""), pair, "-12.56636", 60)),
        ("even", scene(&several("2, \"1/7\"", "\"pi\", \"2*pi\""), pair, "-12.56636", 60)),
        ("no whole ratio", scene(&several("1, \"1/5\"", "\"2*pi\", \"3*pi\""), pair, "-25", 80)),
        ("three", scene(&several("1, \"1/9\", \"1/25\"", "\"pi\", \"3*pi\", \"5*pi\""), pair, "-12.56636", 80)),
        (
            "late start",
            scene(&several("1, \"1/9\"", "\"pi\", \"3*pi\""), pair, "-12.56636", 60)
                .replace("time = 0", "time = \"1e15/3\""),
        ),
    ]
    .into_iter()
    .map(|(name, scene)| (name, document(&scene)))
    .collect()
}

fn verdict(document: &Value) -> Verdict {
    Certificate::parse(&document.to_string()).unwrap().check(&Unwatched).unwrap()
}

fn is_confirmed(document: &Value) -> bool {
    matches!(verdict(document), Verdict::Confirmed { .. })
}

/// Whether a copy with another value at a path of the outcome is confirmed.
fn is_confirmed_with(document: &Value, path: &str, value: Value) -> bool {
    let mut copy = document.clone();
    *copy["outcome"].pointer_mut(path).expect(path) = value;
    // Words that say something else would be refused whatever the fields are.
    copy["outcome"]["message"] = json!("");
    is_confirmed(&copy)
}

/// Bounds as far higher, or lower, as they are wide.
fn moved(bounds: &Value, sign: i32) -> Value {
    let exact = |end: usize| impact_pair::exact::Exact::parse(bounds[end].as_str().unwrap()).unwrap();
    let width = exact(1) - exact(0);
    let width = if width.sign() == Some(std::cmp::Ordering::Equal) { "1e-30".parse().unwrap() } else { width };
    let by = if sign > 0 { width } else { -width };
    // Rounded to decimals far finer than the width.
    let end = |end: usize| {
        let [lower, upper] = impact_pair::exact::decimal_bounds(&(exact(end) + &by).enclose(600));
        assert!(lower == upper || lower.len() > 100, "{lower} {upper}");
        json!(if sign > 0 { upper } else { lower })
    };
    json!([end(0), end(1)])
}

/// Paths to all bounds of the orbit.
fn bounds(document: &Value) -> Vec<String> {
    let impacts = document["outcome"]["orbit"]["impacts"].as_array().unwrap().len();
    let states = (0..impacts).flat_map(|i| ["phase", "velocity"].map(|key| format!("/orbit/impacts/{i}/{key}")));
    let eigenvalues = (0..2).flat_map(|i| ["re", "im"].map(|key| format!("/orbit/eigenvalues/{i}/{key}")));
    states.chain(eigenvalues).chain(["/orbit/trace".into(), "/orbit/determinant".into()]).collect()
}

/// The first impact from which on the listed walls are those of the word.
fn earliest(document: &Value) -> u64 {
    let walls = |list: &Value| -> Vec<String> {
        list.as_array().unwrap().iter().map(|x| x["wall"].as_str().unwrap().to_owned()).collect()
    };
    let (word, events) = (walls(&document["outcome"]["orbit"]["impacts"]), walls(&document["events"]));
    let from = document["outcome"]["from"].as_u64().unwrap() as usize;
    let rounds = (0..=(from - 1) / word.len()).take_while(|rounds| {
        let start = from - 1 - rounds * word.len();
        events[start..].iter().zip(word.iter().cycle()).all(|(event, wall)| event == wall)
    });
    (from - rounds.last().unwrap() * word.len()) as u64
}

#[test]
fn attractors_are_confirmed_and_nothing_else_in_their_place() {
    check_attractors([80, 10, 8]);
}

#[test]
#[ignore = "deep: every value of every attractor; by default attractors_are_confirmed_and_nothing_else_in_their_place"]
fn attractors_with_any_value_changed_are_not_confirmed() {
    check_attractors([1; 3]);
}

/// Every attractor as it is, and with changed values: every `bound`-th bound, every `impact`-th impact and every `other`-th other value.
fn check_attractors([bound, impact, other]: [usize; 3]) {
    for (number, (name, document)) in attracted().into_iter().enumerate() {
        let outcome = &document["outcome"];
        assert_eq!(outcome["kind"], "attracted", "{name}");
        assert!(is_confirmed(&document), "{name}: {:?}", verdict(&document));
        for path in bounds(&document).iter().step_by(bound) {
            for sign in [-1, 1] {
                let moved = moved(outcome.pointer(path).unwrap(), sign);
                assert!(!is_confirmed_with(&document, path, moved), "{name}: {path} {sign}");
            }
        }
        let (symmetric, cycles) =
            (outcome["orbit"]["symmetric"].as_bool().unwrap(), outcome["cycles"].as_u64().unwrap());
        for (path, value) in [
            ("/orbit/symmetric", json!(!symmetric)),
            ("/orbit/symmetric", json!(null)),
            ("/orbit/unique", json!(false)),
            ("/cycles", json!(2 * cycles)),
            ("/cycles", json!(cycles - 1)),
            ("/from", json!(earliest(&document) - 1)),
            ("/word", json!("P3")),
            ("/word", json!(format!("{0} {0}", outcome["word"].as_str().unwrap()))),
        ]
        .into_iter()
        .skip(number % other)
        .step_by(other)
        {
            assert!(!is_confirmed_with(&document, path, value), "{name}: {path}");
        }
        for impact in (0..outcome["orbit"]["impacts"].as_array().unwrap().len()).step_by(impact) {
            let path = format!("/orbit/impacts/{impact}/wall");
            let other = if *outcome.pointer(&path).unwrap() == json!("left") { "right" } else { "left" };
            assert!(!is_confirmed_with(&document, &path, json!(other)), "{name}: {path}");
            let path = format!("/orbit/impacts/{impact}/turn");
            if let Some(turn) = outcome.pointer(&path) {
                let other = json!(turn.as_u64().unwrap() + 1);
                assert!(!is_confirmed_with(&document, &path, other), "{name}: {path}");
            }
        }
        let (from, each) =
            (outcome["from"].as_u64().unwrap(), outcome["orbit"]["impacts"].as_array().unwrap().len() as u64);
        assert!(is_confirmed_with(&document, "/from", json!(from + each)), "{name}: a round later");
        assert!(each == 1 || !is_confirmed_with(&document, "/from", json!(from + 1)), "{name}: later");
        assert!(!is_confirmed_with(&document, "/from", json!(from + 1000 * each)), "{name}: beyond the list");
    }
}

#[test]
fn symmetry_is_that_of_all_harmonics() {
    let symmetric: Vec<_> =
        attracted().iter().map(|(name, x)| (*name, x["outcome"]["orbit"]["symmetric"].clone())).collect();
    for (name, is_symmetric) in [("figure 13", true), ("odd", true), ("even", false), ("no whole ratio", false)] {
        assert!(symmetric.contains(&(name, json!(is_symmetric))), "{symmetric:?}");
    }
}

/// A period twice over is no orbit of its own.
#[test]
fn an_orbit_twice_over_is_not_confirmed() {
    let (_, mut document) = attracted().swap_remove(0);
    let outcome = &mut document["outcome"];
    outcome["word"] = json!("P1 P2 P1 P2");
    outcome["cycles"] = json!(2);
    outcome["message"] = json!("");
    let impacts = outcome["orbit"]["impacts"].as_array().unwrap().clone();
    outcome["orbit"]["impacts"] = json!([impacts.clone(), impacts].concat());
    for path in ["trace", "determinant", "eigenvalues/0/re", "eigenvalues/0/im", "eigenvalues/1/re", "eigenvalues/1/im"]
    {
        *outcome["orbit"].pointer_mut(&format!("/{path}")).unwrap() = json!(["-1", "1"]);
    }
    match verdict(&document) {
        Verdict::Refuted(finding) => assert_eq!(finding.message, "the orbit is a shorter one 2 times"),
        other => panic!("{other:?}"),
    }
}

/// Beyond the pitchfork there are two orbits, mirror images: the motion converges to one of them.
#[test]
fn the_mirror_image_is_another_attractor() {
    let text = std::fs::read_to_string(format!("{}/scenes/cascade.toml", impact_pair_tests::ROOT)).unwrap();
    let document = document(&text);
    assert!(is_confirmed(&document), "{:?}", verdict(&document));
    let mut mirrored = document.clone();
    let impacts = document["outcome"]["orbit"]["impacts"].as_array().unwrap();
    for (i, impact) in impacts.iter().enumerate() {
        let bounds = |key: &str, of: &dyn Fn(f64) -> f64| {
            let [x, y] = [0, 1].map(|end| of(impact[key][end].as_str().unwrap().parse().unwrap()));
            json!([format!("{:.9}", x.min(y) - 1e-8), format!("{:.9}", x.max(y) + 1e-8)])
        };
        let half = std::f64::consts::PI;
        // From the other impact on, which is on the same wall in the mirror.
        mirrored["outcome"]["orbit"]["impacts"][1 - i]["phase"] =
            bounds("phase", &|x| (x + half).rem_euclid(2.0 * half));
        mirrored["outcome"]["orbit"]["impacts"][1 - i]["velocity"] = bounds("velocity", &|x| -x);
    }
    assert!(matches!(verdict(&mirrored), Verdict::Refuted(_)), "{:?}", verdict(&mirrored));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2))]

    /// Orbits that `run` proves to be attracted are confirmed, by the other route, and with a bound past the truth they are not.
    #[test]
    fn attractors_of_random_scenes_are_confirmed(
        amplitude in 0.5..9.0f64, second in 0.0..0.3f64, frequency in 2u32..4, e in 0.1..0.8f64, velocity in -30.0..-5.0f64,
        corrupted in any::<prop::sample::Index>(),
    ) {
        let excitation = format!(
            "amplitude = [{amplitude}, {}], frequency = [\"pi\", \"{frequency}*pi\"], phase = 0", second * amplitude,
        );
        let document = document(&scene(&excitation, &format!("gap = 9.42497, restitution = {e}"), &velocity.to_string(), 120));
        prop_assume!(document["outcome"]["kind"] == "attracted");
        let mut events = document.clone();
        events["outcome"] = json!({"kind": "impacts-reached", "impacts": document["outcome"]["impacts"]});
        prop_assume!(is_confirmed(&events));
        prop_assert!(is_confirmed(&document), "{:?}", verdict(&document));
        let bounds = bounds(&document);
        let path = corrupted.get(&bounds);
        let moved = moved(document["outcome"].pointer(path).unwrap(), 1);
        prop_assert!(!is_confirmed_with(&document, path, moved), "{path}");
    }
}
