//! Events after those that a document lists, and outcomes with the words that fit them.

use impact_pair::document;
use impact_pair::json::{OutcomeDocument, SceneDocument};
use impact_pair::orbit::{Arithmetic, Settings};
use num_rational::BigRational;
use serde_json::{Value, json};

use super::forged::{Original, bounds};

/// Events computed beyond those that are listed.
const EXTRA_EVENTS: u64 = 3;

/// The events of a document's own scene, from its exact start.
pub fn motion(scene: &Value, impacts: u64) -> Option<Vec<Value>> {
    let (pair, start) = serde_json::from_value::<SceneDocument>(scene.clone()).ok()?.model().ok()?;
    let settings =
        Settings { impacts: Some(impacts), arithmetic: Arithmetic::Bits(320), digits: 30, ..Settings::default() };
    json!(document::orbit(&pair, &start, settings).ok()?)["events"].as_array().cloned()
}

/// Whether an event follows the listed events: for `A > 0` or with a drift, an event always follows.
pub fn goes_on(original: &Original) -> bool {
    !["rests-forever", "never-impacts"].contains(&original.outcome())
}

/// Bounds of the time of the event after the listed ones, of data that are points.
pub fn next_event(original: &Original) -> Option<[BigRational; 2]> {
    let events = original.events();
    let last = events
        .last()
        .map_or_else(|| Some(super::forged::fraction(-1, 1)), |last| bounds(&last["time"]).map(|[_, to]| to))?;
    let found = motion(&original.document["scene"], events.len() as u64 + EXTRA_EVENTS)?;
    found.iter().filter_map(|event| bounds(&event["time"])).find(|[from, _]| *from > last)
}

/// A document with another outcome: the fields of its kind, and the words that these make.
pub fn ended(document: &Value, fields: &Value) -> Value {
    let mut copy = document.clone();
    let mut outcome = json!({ "kind": "", "message": "" });
    for key in ["impacts", "start", "epsilon"] {
        if let Some(value) = document["outcome"].get(key) {
            outcome[key] = value.clone();
        }
    }
    for (key, value) in fields.as_object().unwrap() {
        outcome[key] = value.clone();
    }
    copy["outcome"] = outcome;
    reworded(copy)
}

/// The document with the count of its impacts and the words of its outcome as its other fields make them.
pub fn reworded(mut document: Value) -> Value {
    let impacts =
        document["events"].as_array().map_or(0, |all| all.iter().filter(|event| event["event"] == "impact").count());
    document["outcome"]["impacts"] = json!(impacts);
    document["outcome"]["message"] = json!("");
    if let Ok(outcome) = serde_json::from_value::<OutcomeDocument>(document["outcome"].clone()) {
        document["outcome"]["message"] = json!(outcome.words().unwrap_or_default());
    }
    document
}
