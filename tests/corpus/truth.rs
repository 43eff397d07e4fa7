//! The truth of a document by the library: the motion is computed anew from the document's own scene, in 320 bits.

use impact_pair::exact::Exact;
use impact_pair::json::vocabulary::OutcomeKind;
use impact_pair::json::{OutcomeDocument, SceneDocument};
use impact_pair::mapping::Word;
use impact_pair::orbit::{Arithmetic, Orbit, Settings};
use impact_pair::pair::Wall;
use impact_pair::periodic::{self, Precision};
use impact_pair::two_impact::{self, Unknown};
use impact_pair::units::Units;
use impact_pair::{ImpactPair, orbit::Start};
use serde_json::{Value, json};

use super::shadow;

/// Digits of the orbits that are found anew.
const DIGITS: u32 = 18;

/// Impacts that are computed beyond those that are claimed.
const EXTRA_IMPACTS: u64 = 2;

/// Whether all claims of a document hold, for both ends of all intervals of its scene.
pub fn is_true(document: &Value) -> bool {
    (0..2).all(|end| {
        let mut scene = document["scene"].clone();
        at_ends(&mut scene, end);
        let Ok(scene) = serde_json::from_value::<SceneDocument>(scene) else { return false };
        let Ok((pair, start)) = scene.model() else { return false };
        match document["orbits"].as_array() {
            Some(orbits) => are_orbits(document, orbits, &pair, &start),
            None => is_motion(document, &pair, &start),
        }
    })
}

/// One end of each interval.
fn at_ends(value: &mut Value, end: usize) {
    match value {
        Value::String(text) => {
            if let Some((lower, upper)) = Exact::parse(text).ok().and_then(|x| x.ends()) {
                *text = if end == 0 { lower.text() } else { upper.text() };
            }
        }
        Value::Array(items) => items.iter_mut().for_each(|item| at_ends(item, end)),
        Value::Object(entries) => entries.values_mut().for_each(|item| at_ends(item, end)),
        _ => {}
    }
}

/// Whether claimed bounds contain the found bounds, which are known to about 60 digits.
pub fn holds(claimed: &Value, found: &Value) -> bool {
    let number = |bounds: &Value, end: usize| bounds[end].as_str().and_then(|text| Exact::parse(text).ok());
    let order = |a: Option<Exact>, b: Option<Exact>| a.zip(b).and_then(|(a, b)| a.compare(&b));
    order(number(claimed, 0), number(found, 0)).is_some_and(std::cmp::Ordering::is_le)
        && order(number(claimed, 1), number(found, 1)).is_some_and(std::cmp::Ordering::is_ge)
}

fn is_motion(document: &Value, pair: &ImpactPair, start: &Start) -> bool {
    let Ok(outcome) = serde_json::from_value::<OutcomeDocument>(document["outcome"].clone()) else { return false };
    let events = document["events"].as_array().unwrap();
    let impacts = events.iter().filter(|event| event["event"] == "impact").count() as u64;
    let is_said = outcome.message.is_empty() || Some(&outcome.message) == outcome.words().as_ref();
    if outcome.impacts != Some(impacts) || !is_said {
        return false;
    }
    if document["claim"] == "shadowed" {
        return outcome.kind == OutcomeKind::ImpactsReached && shadow::is_true(document, &outcome);
    }
    if outcome.start.is_some() || outcome.epsilon.is_some() {
        return false;
    }
    let until = outcome.until.as_ref().map(|until| until.0.clone());
    let most = if events.iter().any(|event| event["event"] != "impact") {
        events.len() as u64
    } else {
        impacts + EXTRA_IMPACTS
    };
    let settings = Settings {
        impacts: Some(if until.is_some() { impacts + 40 } else { most }),
        until,
        arithmetic: Arithmetic::Bits(320),
        attractor: outcome.kind == OutcomeKind::Attracted,
        digits: if outcome.kind == OutcomeKind::Attracted { 25 } else { 9 },
        ..Settings::default()
    };
    let found = serde_json::to_value(Orbit::new(pair, start, settings).unwrap().document()).unwrap();
    let all = found["events"].as_array().unwrap();
    let Some(listed) = listed(events, all) else { return false };
    let next = all.get(listed);
    let ended = &found["outcome"];
    let is_ended = match outcome.kind {
        OutcomeKind::ImpactsReached => true,
        OutcomeKind::TimeReached => next.is_none(),
        OutcomeKind::Periodic => ended["kind"] == "periodic" && ended["period"] == document["outcome"]["period"],
        OutcomeKind::Attracted => ended["kind"] == "attracted" && is_attracted(&document["outcome"], ended),
        OutcomeKind::Undecided => {
            let from =
                outcome.time.as_ref().and_then(|time| time[0].as_ref()).map(|from| Exact::from_rational(from.value()));
            from.is_some_and(|from| {
                next.is_none_or(|next| {
                    let later = Exact::parse(next["time"][1].as_str().unwrap()).unwrap();
                    from.compare(&later).is_some_and(std::cmp::Ordering::is_le)
                })
            })
        }
        kind => {
            ended["kind"] == kind.to_string()
                && outcome.wall.is_none_or(|wall| serde_json::json!(wall) == ended["wall"])
        }
    };
    is_ended && (outcome.until.is_none() || next.is_none())
}

/// Number of events found that the claimed ones stand for, if these are true: a rest stands for impacts before it as well.
fn listed(claimed: &[Value], found: &[Value]) -> Option<usize> {
    let (mut at, mut skipped) = (0, 0);
    for event in claimed {
        while event["skipped"] == "infinite" && found.get(at)?["event"] == "impact" {
            (at, skipped) = (at + 1, skipped + 1);
        }
        let is_next = event["index"].as_u64().map(|index| index + skipped) == found.get(at)?["index"].as_u64();
        if !(is_next && is_event(event, &found[at])) {
            return None;
        }
        at += 1;
    }
    Some(at)
}

pub fn is_event(claimed: &Value, found: &Value) -> bool {
    let same = ["event", "mapping", "wall", "skipped"].iter().all(|key| claimed[key] == found[key]);
    // A graze has wider bounds in fewer bits, and an exact time is a point.
    let is_there = if claimed["event"] == "graze" {
        overlap(&claimed["time"], &found["time"])
    } else {
        holds(&claimed["time"], &found["time"])
    };
    same && is_there && (claimed["velocity"].is_null() || holds(&claimed["velocity"], &found["velocity"]))
}

fn overlap(claimed: &Value, found: &Value) -> bool {
    let number = |bounds: &Value, end: usize| Exact::parse(bounds[end].as_str().unwrap()).unwrap();
    let below = |a: Exact, b: Exact| a.compare(&b).is_some_and(std::cmp::Ordering::is_le);
    below(number(claimed, 0), number(found, 1)) && below(number(found, 0), number(claimed, 1))
}

/// The orbit that a motion converges to: found by more impacts, which may end at another one of the word.
fn is_attracted(claimed: &Value, found: &Value) -> bool {
    let from = |outcome: &Value| outcome["from"].as_u64().unwrap_or(0);
    from(claimed) + 2 >= from(found)
        && claimed["cycles"] == found["cycles"]
        && (is_orbit(&claimed["orbit"], &found["orbit"]))
}

/// All that is claimed of an orbit holds of the one that is found, from one of its impacts on.
fn is_orbit(claimed: &Value, found: &Value) -> bool {
    let (Some(impacts), Some(others)) = (claimed["impacts"].as_array(), found["impacts"].as_array()) else {
        return false;
    };
    let is_impact = |claimed: &Value, found: &Value| {
        ["wall", "turn"].iter().all(|key| claimed[key] == found[key])
            && ["phase", "velocity"].iter().all(|key| holds(&claimed[key], &found[key]))
    };
    let is_passed = |shift: usize| impacts.iter().zip(others.iter().cycle().skip(shift)).all(|(a, b)| is_impact(a, b));
    let is_number = |key: &str| claimed[key].is_null() || holds(&claimed[key], &found[key]);
    let is_value = |claimed: &Value, found: &Value| ["re", "im"].iter().all(|key| holds(&claimed[key], &found[key]));
    let (values, numbers) = (&claimed["eigenvalues"], &found["eigenvalues"]);
    let are_values = values.is_null()
        || [[0, 1], [1, 0]]
            .iter()
            .any(|[a, b]| is_value(&values[0], &numbers[*a]) && is_value(&values[1], &numbers[*b]));
    let is_same = |key: &str| claimed[key].is_null() || claimed[key] == found[key];
    let is_stable = claimed["stability"] == "undecided" || claimed["stability"] == found["stability"];
    impacts.len() == others.len()
        && (0..others.len()).any(is_passed)
        && ["trace", "determinant", "spacing"].iter().all(|key| is_number(key))
        && are_values
        && ["unique", "physical", "symmetric", "sine"].iter().all(|key| is_same(key))
        && is_stable
}

fn are_orbits(document: &Value, orbits: &[Value], pair: &ImpactPair, start: &Start) -> bool {
    let (Some(word), Some(cycles)) = (document["word"].as_str(), document["cycles"].as_u64()) else { return false };
    let Ok(word) = word.parse::<Word>() else { return false };
    let found = match document["solved_for"].is_string() {
        true => two_impacts(pair, start, cycles as u32),
        false => orbits_of(pair, start, &word, cycles as u32),
    };
    let is_open = |orbit: &Value| {
        orbit["physical"].is_null() || orbit["symmetric"].is_null() || orbit["stability"] == "undecided"
    };
    let says_too_much = document["certified"] == true && document["solved_for"].is_null() && orbits.iter().any(is_open);
    let found = found["orbits"].as_array().unwrap();
    !says_too_much && orbits.iter().all(|orbit| found.iter().any(|found| is_orbit(orbit, found)))
}

fn orbits_of(pair: &ImpactPair, start: &Start, word: &Word, cycles: u32) -> Value {
    let Ok(problem) = periodic::Problem::new(pair, word, cycles) else { return json!({ "orbits": [] }) };
    let census = problem.find(start, Precision { digits: DIGITS, ..Precision::default() });
    json!(Units::gaps(pair).unwrap().document(&problem, start, &census))
}

fn two_impacts(pair: &ImpactPair, start: &Start, cycles: u32) -> Value {
    let answer = two_impact::Problem::new(pair, cycles, Unknown::Velocity).unwrap().answer(DIGITS);
    json!(answer.document(start, Wall::Left))
}
