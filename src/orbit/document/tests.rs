use super::*;
use crate::Scene;
use crate::exact::{Enclosure, Exact};
use crate::number::Ball;
use crate::orbit::{Arithmetic, Impact, Orbit, Settings};
use impact_pair_certificate::Certificate;
use impact_pair_document::SceneDocument;
use num_rational::BigRational;
use proptest::prelude::*;
use serde_json::{Value, json};

fn scene(amplitude: &str, start: &str) -> Scene {
    let text = format!(
        "excitation = {{ amplitude = {amplitude}, frequency = \"pi\", phase = 0 }}\n\
         pair = {{ gap = 9.42497, restitution = 0.5 }}\nstart = {{ time = 0, {start} }}"
    );
    Scene::parse(&text).unwrap()
}

fn value(decimal: &Value) -> BigRational {
    decimal.as_str().unwrap().parse::<Exact>().unwrap().as_rational().unwrap().clone()
}

fn rational(text: &str) -> BigRational {
    text.parse::<Exact>().unwrap().as_rational().unwrap().clone()
}

fn exact(x: f64) -> BigRational {
    BigRational::from_float(x).unwrap()
}

/// The document and the impacts it was made of.
fn document(scene: &Scene, arithmetic: Arithmetic) -> (Value, Vec<Impact>) {
    // As few bits as there are in multiprecision: chaos ends soon.
    let mut orbit = Orbit::of(scene, Settings { arithmetic, max_bits: 64, ..scene.settings() }).unwrap();
    let impacts: Vec<Impact> = orbit.by_ref().collect();
    let settings = Settings { arithmetic, max_bits: 64, ..scene.settings() };
    let document = Orbit::of(scene, settings).unwrap().document();
    (serde_json::to_value(document).unwrap(), impacts)
}

fn brackets(bounds: &Value, ball: Ball, map: impl Fn(BigRational) -> BigRational) -> bool {
    let (low, high) = (exact(ball.mid()) - exact(ball.rad()), exact(ball.mid()) + exact(ball.rad()));
    value(&bounds[0]) <= map(low) && map(high) <= value(&bounds[1])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    /// With W = pi a time is 2 (forcing periods + phase) and a velocity d/2 of a reduced one: rational, so exactly comparable.
    #[test]
    fn printed_bounds_hold_the_balls_they_come_from(amplitude in 0.0..12.0f64, velocity in -20.0..0.0f64, inside in any::<bool>()) {
        let start = if inside { "position = 0.3" } else { "wall = \"left\"" };
        let scene = scene(&format!("{amplitude:?}"), &format!("{start}, velocity = {velocity:?}"));
        let (document, impacts) = document(&scene, Arithmetic::Interval);
        let events: Vec<&Value> = document["events"].as_array().unwrap().iter().filter(|event| event["event"] == "impact").collect();
        prop_assert_eq!(events.len(), impacts.len());
        for (event, impact) in events.iter().zip(&impacts) {
            let turns = BigRational::from_integer(impact.turns.into());
            prop_assert!(brackets(&event["time"], impact.phase, |u| (u + &turns) * rational("2")));
            prop_assert!(brackets(&event["velocity"], impact.velocity, |v| v * rational("9.42497/2")));
            prop_assert_eq!(&event["index"], &json!(impact.index));
            prop_assert_eq!(&event["wall"], &json!(impact.wall.name()));
        }
    }
}

#[test]
fn the_first_contact_of_a_start_inside_has_no_mapping() {
    let (document, _) = document(&scene("1", "position = 0.25, velocity = -3"), Arithmetic::Auto);
    assert_eq!(document["events"][0]["mapping"], Value::Null);
    assert_eq!(document["scene"]["start"], json!({"time": "0", "position": "0.25", "velocity": "-3"}));
}

#[test]
fn an_undecided_outcome_carries_its_reason_and_enclosure() {
    let (document, impacts) = document(&scene("8", "wall = \"left\", velocity = -12.56636"), Arithmetic::Auto);
    let outcome = &document["outcome"];
    assert_eq!((&outcome["kind"], &outcome["reason"]), (&json!("undecided"), &json!("precision")));
    assert!(outcome["wall"] == "left" || outcome["wall"] == "right");
    let last = document["events"].as_array().unwrap().last().unwrap();
    assert!(value(&last["time"][1]) < value(&outcome["time"][0]));
    assert!(value(&outcome["time"][0]) < value(&outcome["time"][1]));
    let expected = format!("undecided after impact {}: ", impacts.len());
    assert!(outcome["message"].as_str().unwrap().starts_with(&expected));
    // Nothing is said of what would end it: the time is open.
    let (still, _) = self::document(&scene("0", "wall = \"left\", velocity = 0"), Arithmetic::Auto);
    assert_eq!(still["outcome"]["time"][1], Value::Null);
    assert!(still["events"].as_array().unwrap().iter().all(|event| event["event"] == "rest"));
}

#[test]
fn an_orbit_that_did_not_end_was_interrupted() {
    let scene = scene("1", "wall = \"left\", velocity = -12.56636");
    let mut orbit = Orbit::of(&scene, scene.settings()).unwrap();
    let before = json!(Conclusion::of(&orbit, None).document());
    assert_eq!(
        before,
        json!({
            "kind": "undecided", "reason": "budget", "message": "interrupted before the first impact", "impacts": 0,
            "time": ["0", null],
        })
    );
    let event = orbit.next().map(|impact| Event::new(&orbit, &impact));
    let after = json!(Conclusion::of(&orbit, event.as_ref()).document());
    assert_eq!(after["message"], "interrupted after impact 1");
    assert!(value(&after["time"][0]) > rational("1") && after["time"][1].is_null());
}

#[test]
fn floating_point_claims_nothing() {
    let (document, impacts) = document(&scene("1", "wall = \"left\", velocity = -12.56636"), Arithmetic::Float);
    assert_eq!(document["certified"], false);
    assert_eq!(document["arithmetic"], json!({"kind": "float", "bits": 53}));
    for (event, impact) in document["events"].as_array().unwrap().iter().zip(impacts) {
        let time: f64 = event["time"][0].as_str().unwrap().parse().unwrap();
        assert_eq!(event["time"][0], event["time"][1]);
        let expected = 2.0 * (impact.turns as f64 + impact.phase.mid());
        assert!((time - expected).abs() <= 2.0 * f64::EPSILON * expected);
    }
}

/// Returns the times and velocities of the impacts that a document lists, found again by its certificate.
fn found_again(document: &Value) -> Vec<(Enclosure, Enclosure)> {
    Certificate::parse(&document.to_string()).unwrap().retraced(192).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Sets in mean value form hold the orbits of their members (Lemma V2): all data are intervals, members anywhere inside.
    #[test]
    fn sets_checked_again_hold_their_members(
        amplitude in 0.5..20.0f64, phase in 0.0..6.0f64, gap in 5.0..15.0f64, e in 0.2..0.9f64,
        velocity in -30.0..-5.0f64, size in 3u32..9, parts in prop::array::uniform5(0u32..=4),
    ) {
        let width = 10f64.powi(-(size as i32));
        let value = |x: f64, part: Option<u32>| match part {
            None => format!("\"[{x}, {}]\"", x + width),
            Some(part) => format!("\"{x} + ({} - ({x}))*{part}/4\"", x + width),
        };
        let scene = |parts: [Option<u32>; 5]| {
            let [a, p, d, r, v] = parts;
            Scene::parse(&format!(
                "excitation = {{ amplitude = {}, frequency = \"pi\", phase = {} }}\npair = {{ gap = {}, restitution = {} }}\n\
                 start = {{ time = 0, wall = \"left\", velocity = {} }}\nrun = {{ impacts = 3 }}",
                value(amplitude, a), value(phase, p), value(gap, d), value(e, r), value(velocity, v),
            )).unwrap()
        };
        let (set, impacts) = document(&scene([None; 5]), Arithmetic::Interval);
        prop_assume!(impacts.len() == 3);
        let mut member = set.clone();
        let parts = parts.map(Some);
        member["scene"] = json!(SceneDocument::new(scene(parts).pair(), scene(parts).start()));
        let found = found_again(&set);
        prop_assert!(size < 6 || !found.is_empty());
        for ((phases, velocities), (phase, velocity)) in found.iter().zip(found_again(&member)) {
            prop_assert!(phases.contains_enclosure(&phase), "{phases:?} {phase:?}");
            prop_assert!(velocities.contains_enclosure(&velocity), "{velocities:?} {velocity:?}");
        }
    }
}
