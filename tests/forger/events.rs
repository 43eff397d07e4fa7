//! Events dropped, inserted, exchanged and mirrored, with numbers, mappings and counts mended, so that only the motion is wrong.

use serde_json::{Value, json};

use super::forged::{Forged, Forgery, Original, bounds, fraction, negated, pair};
use super::futures::reworded;

pub const FORGERIES: &[Forgery] = &[
    Forgery {
        name: "events: dropped from one on",
        why: "the outcome says that up to a time, or for ever, no others come",
        forge: cut,
    },
    Forgery { name: "events: one dropped", why: "it comes between the events around it", forge: dropped },
    Forgery { name: "events: one inserted", why: "between two impacts there is no third", forge: inserted },
    Forgery { name: "events: two exchanged", why: "times grow", forge: exchanged },
    Forgery {
        name: "events: walls mirrored",
        why: "from the same start the other wall is too far away at that time",
        forge: mirrored,
    },
];

fn is_orbit(original: &Original) -> bool {
    original.is(&["orbit", "shadow"])
}

fn is_impact(event: &Value) -> bool {
    event["event"] == "impact"
}

/// The document with other events, their numbers and mappings as the walls make them.
pub fn mended(document: &Value, events: Vec<Value>) -> Value {
    let mut copy = document.clone();
    let (mut last, mut index) = (document["scene"]["start"]["wall"].as_str().map(str::to_owned), 0);
    let mut events = events;
    for event in &mut events {
        let wall = event["wall"].as_str().unwrap().to_owned();
        if is_impact(event) {
            index += 1;
            let mapping = last.map(|last| match (last.as_str(), wall.as_str()) {
                ("right", "left") => "P1",
                ("left", "right") => "P2",
                ("right", _) => "P3",
                _ => "P4",
            });
            (event["index"], event["mapping"]) = (json!(index), json!(mapping));
        } else if event["event"] == "graze" {
            continue;
        }
        last = Some(wall);
    }
    copy["events"] = Value::Array(events);
    reworded(copy)
}

fn cut(original: &Original) -> Vec<Forged> {
    let outcome = &original.document["outcome"];
    let says_no_more =
        !outcome["until"].is_null() || ["undecided", "rests-forever", "never-impacts"].contains(&original.outcome());
    if !is_orbit(original) || !says_no_more {
        return Vec::new();
    }
    let events = original.events();
    // An event that is only nearly a graze may be left out.
    (0..events.len())
        .filter(|&k| events[k..].iter().any(|event| event["event"] != "graze"))
        .map(|k| original.forged(format!("from event {k} on"), mended(&original.document, events[..k].to_vec())))
        .collect()
}

fn dropped(original: &Original) -> Vec<Forged> {
    let events = original.events();
    let is_missed = |k: usize| match (events[k]["event"].as_str().unwrap(), events[k + 1]["event"].as_str().unwrap()) {
        // A rest stands for impacts before it as well.
        ("impact" | "release", next) => next == "impact",
        ("rest", next) => next == "release",
        _ => false,
    };
    (0..events.len().saturating_sub(1))
        .filter(|&k| is_orbit(original) && is_missed(k))
        .map(|k| {
            let left = [&events[..k], &events[k + 1..]].concat();
            original.forged(format!("event {k}"), mended(&original.document, left))
        })
        .collect()
}

/// Positions of impacts that another one follows.
fn pairs(original: &Original) -> Vec<usize> {
    let events = original.events();
    let all = 0..if is_orbit(original) { events.len().saturating_sub(1) } else { 0 };
    all.filter(|&k| is_impact(&events[k]) && is_impact(&events[k + 1])).collect()
}

fn inserted(original: &Original) -> Vec<Forged> {
    let events = original.events();
    let mut all = Vec::new();
    for k in pairs(original) {
        let mut twice = events.to_vec();
        twice.insert(k + 1, events[k].clone());
        all.push(original.forged(format!("event {k} twice"), mended(&original.document, twice)));
        let ([_, from], Some([to, _])) = (bounds(&events[k]["time"]).unwrap(), bounds(&events[k + 1]["time"])) else {
            continue;
        };
        let middle = (&from + &to) / fraction(2, 1);
        for (wall, velocity) in [("left", ["-1000", "0"]), ("right", ["0", "1000"])] {
            let mut event = events[k].clone();
            (event["time"], event["wall"], event["velocity"]) = (pair(&middle, &middle), json!(wall), json!(velocity));
            let mut more = events.to_vec();
            more.insert(k + 1, event);
            all.push(
                original.forged(format!("one on the {wall} wall after event {k}"), mended(&original.document, more)),
            );
        }
    }
    all
}

fn exchanged(original: &Original) -> Vec<Forged> {
    let swapped = |k: usize| {
        let mut events = original.events().to_vec();
        events.swap(k, k + 1);
        original.forged(format!("events {k} and {}", k + 1), mended(&original.document, events))
    };
    pairs(original).into_iter().map(swapped).collect()
}

fn mirrored(original: &Original) -> Vec<Forged> {
    let other = |event: &Value| {
        let mut event = event.clone();
        event["wall"] = json!(if event["wall"] == "left" { "right" } else { "left" });
        if is_impact(&event) {
            event["velocity"] = json!([negated(&event["velocity"][1]), negated(&event["velocity"][0])]);
        }
        event
    };
    let events = original.events();
    if !is_orbit(original) || !events.iter().any(is_impact) {
        return Vec::new();
    }
    let mut all =
        vec![original.forged("of all events", mended(&original.document, events.iter().map(other).collect()))];
    for k in (0..events.len()).filter(|&k| is_impact(&events[k])) {
        let mut one = events.to_vec();
        one[k] = other(&events[k]);
        all.push(original.forged(format!("of event {k}"), mended(&original.document, one)));
    }
    all
}
