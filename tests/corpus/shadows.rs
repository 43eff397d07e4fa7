//! Shadowed orbits: whose start it is, what follows the shadowed impacts, and how near.

use num_rational::BigRational;
use serde_json::{Value, json};

use super::motions::{ended, motion, with_events};
use super::numbers::{bounds, decimal, fraction, pair, rational};
use super::original::{Forged, Forgery, Original, with};
use super::told::told_anew;

pub const FORGERIES: &[Forgery] = &[
    Forgery {
        name: "shadow: claim",
        why: "the exact start does not have these impacts, or no start within 0.001",
        forge: claims,
    },
    Forgery {
        name: "shadow: start",
        why: "no start in these bounds has the impacts: they are a thousandth away, or hold the scene's own alone",
        forge: starts,
    },
    Forgery {
        name: "shadow: another's events",
        why: "the impacts before determine the next ones to less than they are away",
        forge: followed_by_others,
    },
    Forgery {
        name: "shadow: stillness",
        why: "a ball that has hit a wall has a drift, whatever its scene's own start would do",
        forge: still_after_an_impact,
    },
    Forgery { name: "shadow: epsilon", why: "the middles of the bounds are further from the impacts", forge: epsilons },
];

/// The start as bounds of its time and its velocity.
fn near(document: &Value) -> Option<[BigRational; 2]> {
    let start = &document["scene"]["start"];
    Some([rational(&start["time"])?, rational(&start["velocity"])?])
}

/// The document as one of a start between these velocities.
fn shadowed(document: &Value, time: &BigRational, velocity: &Value) -> Value {
    let mut shadowed = with(document, &[("/claim", json!("shadowed"))]);
    shadowed["outcome"]["start"] = json!({ "time": pair(time, time), "velocity": velocity });
    told_anew(&shadowed)
}

fn claims(original: &Original) -> Vec<Forged> {
    let document = &original.document;
    if original.kind == "shadow" {
        let mut exact = with(document, &[("/claim", json!("exact start"))]);
        ["start", "epsilon"].iter().for_each(|key| drop(exact["outcome"].as_object_mut().unwrap().remove(*key)));
        // A short one may be the exact one's as well.
        return vec![original.forged("exact", told_anew(&exact)).probably()];
    }
    let Some([time, velocity]) = near(document).filter(|_| original.kind == "orbit") else { return Vec::new() };
    if document["outcome"]["impacts"].as_u64() <= Some(1) {
        return Vec::new();
    }
    let beside = |by: [i64; 2]| {
        let [lower, upper] = by.map(|by| &velocity + fraction(by, 1000));
        original.forged("shadowed by a start beside it", shadowed(document, &time, &pair(&lower, &upper)))
    };
    [[1, 2], [-2, -1]].map(beside).into()
}

fn starts(original: &Original) -> Vec<Forged> {
    if original.kind != "shadow" {
        return Vec::new();
    }
    let document = &original.document;
    let start = &document["outcome"]["start"];
    let varied = if start["velocity"][0] == start["velocity"][1] { "time" } else { "velocity" };
    let (path, own) = (format!("/outcome/start/{varied}"), bounds(&start[varied]).unwrap());
    let moved = [fraction(1, 1000), fraction(-1, 1000)]
        .map(|by| original.with(format!("{varied} moved"), &[(&path, pair(&(&own[0] + &by), &(&own[1] + &by)))]));
    let exact = rational(&document["scene"]["start"][varied])
        .map(|exact| original.with("the scene's own alone", &[(&path, pair(&exact, &exact))]).probably());
    moved.into_iter().chain(exact).collect()
}

/// Events of the motion that starts a thousandth away, from the first on that is apart.
fn followed_by_others(original: &Original) -> Vec<Forged> {
    let events = original.events();
    let Some([_, velocity]) = near(&original.document) else { return Vec::new() };
    if !original.is(&["orbit", "shadow"]) || original.document["outcome"]["impacts"].as_u64() < Some(3) {
        return Vec::new();
    }
    let mut scene = original.document["scene"].clone();
    let sign = if velocity < fraction(0, 1) { fraction(-1, 1000) } else { fraction(1, 1000) };
    scene["start"]["velocity"] = json!(decimal(&(velocity + sign)));
    let Some(others) = motion(&scene, events.len() as u64) else { return Vec::new() };
    let is_apart = |k: usize| {
        let times = [&events[k], &others[k]].map(|event| bounds(&event["time"]));
        let [Some(own), Some(other)] = times else { return false };
        own[1].clone() + fraction(1, 10_000) < other[0] || other[1].clone() + fraction(1, 10_000) < own[0]
    };
    let are_impacts = |k: usize| [&events[k], &others[k]].iter().all(|event| event["event"] == "impact");
    let from = |k: usize| {
        let impacts = others[k..].iter().take_while(|event| event["event"] == "impact");
        let all = events[..k].iter().chain(impacts).cloned().collect();
        original.forged(format!("from event {k} on"), with_events(&original.document, all))
    };
    (1..events.len().min(others.len())).filter(|&k| are_impacts(k) && is_apart(k)).map(from).collect()
}

/// One impact of a start beside that of a ball that hangs still, and then what the still ball does.
fn still_after_an_impact(original: &Original) -> Vec<Forged> {
    let document = &original.document;
    let is_still = !document["scene"]["start"]["position"].is_null()
        && (original.outcome() == "never-impacts" || document["outcome"]["period"]["impacts"] == 0);
    let Some([time, velocity]) = near(document).filter(|_| original.kind == "orbit" && is_still) else {
        return Vec::new();
    };
    // If the still ball grazes, a slow one hits before it would; else a fast one does soon.
    let by = if original.events().is_empty() { fraction(1, 1) } else { fraction(1, 100) };
    let mut scene = document["scene"].clone();
    scene["start"]["velocity"] = json!(decimal(&(&velocity + &by)));
    let found = motion(&scene, 1).unwrap();
    let mut impact = found.iter().find(|event| event["event"] == "impact").unwrap().clone();
    for key in ["time", "velocity"] {
        let [lower, upper] = bounds(&impact[key]).unwrap();
        impact[key] = pair(&(lower - fraction(1, 1000)), &(upper + fraction(1, 1000)));
    }
    let [_, from] = bounds(&impact["time"]).unwrap();
    let later = original.events().iter().filter(|event| bounds(&event["time"]).unwrap()[0] > from);
    let events: Vec<Value> = std::iter::once(&impact).chain(later).cloned().collect();
    // The scene's own start is among them, and the slow or fast one about in the middle.
    let starts = pair(&(&velocity - &by / fraction(100, 1)), &(&velocity + &by * fraction(2, 1)));
    let shadowed = shadowed(document, &time, &starts);
    let forged = |what: &str, events: &[Value], fields: Option<Value>| {
        let document = with_events(&shadowed, events.to_vec());
        let document = fields.map_or(document.clone(), |fields| ended(&document, &fields));
        original.forged(format!("an impact, then {what}"), document)
    };
    let until = json!({ "kind": "time-reached", "until": "1000000000" });
    let period = json!({ "kind": "periodic", "period": { "cycles": 1, "impacts": 0 } });
    vec![
        forged("what the still one does", &events, None),
        forged("none up to a time", &events[..1], Some(until)),
        forged("none for ever", &events[..1], Some(json!({ "kind": "never-impacts" }))),
        forged("a motion that repeats", &events[..1], Some(period)),
    ]
}

/// The first impacts, in bounds rounded outward to as many places, and much nearer to their middles than these tell.
fn epsilons(original: &Original) -> Vec<Forged> {
    if original.kind != "shadow" || original.document["outcome"]["epsilon"].is_null() {
        return Vec::new();
    }
    let rounded = |(places, count): (u32, usize)| {
        let units = BigRational::from_integer(num_traits::pow(10.into(), places as usize));
        let mut events = original.events()[..count].to_vec();
        for event in &mut events {
            let [lower, upper] = bounds(&event["time"]).unwrap();
            let [lower, upper] = [(lower * &units).floor(), (upper * &units).ceil()].map(|x| x.to_integer());
            event["time"] = json!([format!("{lower}e-{places}"), format!("{upper}e-{places}")]);
        }
        let document = with_events(&ended(&original.document, &json!({ "kind": "impacts-reached" })), events);
        let small = json!({ "median": "1e-300", "maximum": "1e-300" });
        let document = told_anew(&with(&document, &[("/outcome/epsilon", small)]));
        original.forged(format!("{count} in bounds of {places} places"), document)
    };
    [(2, 1), (6, 1), (3, 2), (9, 3)]
        .into_iter()
        .filter(|(_, count)| *count <= original.events().len())
        .map(rounded)
        .collect()
}
