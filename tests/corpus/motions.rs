//! The motion of a scene from its exact start, and documents that end otherwise.

use impact_pair::json::SceneDocument;
use impact_pair::orbit::{Arithmetic, Orbit, Settings};
use num_rational::BigRational;
use serde_json::{Value, json};

use super::numbers::{bounds, fraction};
use super::original::Original;
use super::told::told_anew;

/// Events computed beyond those that are listed.
const EXTRA_EVENTS: u64 = 3;

/// The events of a scene from its exact start, in 320 bits.
pub fn motion(scene: &Value, impacts: u64) -> Option<Vec<Value>> {
    let (pair, start) = serde_json::from_value::<SceneDocument>(scene.clone()).ok()?.model().ok()?;
    let settings =
        Settings { impacts: Some(impacts), arithmetic: Arithmetic::Bits(320), digits: 60, ..Settings::default() };
    json!(Orbit::new(&pair, &start, settings).ok()?.document())["events"].as_array().cloned()
}

/// Whether an event follows the listed events: for `A > 0` or with a drift, an event always follows.
pub fn goes_on(original: &Original) -> bool {
    !["rests-forever", "never-impacts"].contains(&original.outcome())
}

/// Bounds of the time of the event after the listed ones, of data that are points.
pub fn next_event(original: &Original) -> Option<[BigRational; 2]> {
    let events = original.events();
    let last = events.last().map_or(Some(fraction(-1, 1)), |last| bounds(&last["time"]).map(|[_, to]| to))?;
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
    told_anew(&copy)
}

/// The document with other events.
pub fn with_events(document: &Value, events: Vec<Value>) -> Value {
    let mut copy = document.clone();
    copy["events"] = Value::Array(events);
    told_anew(&copy)
}
