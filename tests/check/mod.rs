//! Certificates of orbits, checked: what an outcome says, sums of harmonics, rests and grazes.

mod outcomes;
mod rests;
mod sums;

use serde_json::{Value, json};

use impact_pair::Scene;
use impact_pair::document;
use impact_pair::exact::{Enclosure, Exact};
use impact_pair::orbit::{Arithmetic, Settings};
use impact_pair::watch::{Stage, Unwatched, proceed_if};
use impact_pair_certificate::{Certificate, Effort, Verdict};

/// The orbit JSON of a scene of one harmonic, with all its events.
fn certificate(amplitude: &str, start: &str, restitution: &str, impacts: u64) -> Value {
    orbit(&format!(
        "excitation = {{ amplitude = {amplitude}, frequency = \"pi\", phase = \"pi\" }}\n\
         pair = {{ gap = 9.42497, restitution = {restitution} }}\nstart = {{ time = 0, {start} }}\nrun = {{ impacts = {impacts} }}",
    ))
}

/// The orbit JSON of a scene, with all its events.
fn orbit(scene: &str) -> Value {
    let scene = Scene::parse(scene).unwrap();
    let settings = Settings { arithmetic: Arithmetic::Interval, attractor: false, ..scene.settings() };
    serde_json::to_value(document::orbit(scene.pair(), scene.start(), settings).unwrap()).unwrap()
}

/// The harmonic as two; of what is claimed to be one point, a release, it is claimed that it is within `10^-12` of it.
fn split(document: &Value) -> Value {
    let mut split = document.clone();
    let excitation = &mut split["scene"]["excitation"];
    excitation["amplitude"] = json!([excitation["amplitude"][0], excitation["amplitude"][0]]);
    excitation["frequency"] = json!(["pi", "pi"]);
    excitation["phase"] = json!(["4*pi/3", "2*pi/3"]);
    for event in split["events"].as_array_mut().unwrap() {
        if event["event"] == "release" {
            let time: u32 = event["time"][0].as_str().unwrap().parse().unwrap();
            event["time"] = json!([format!("{}.999999999999", time - 1), format!("{time}.000000000001")]);
        }
    }
    split
}

/// The impacts that a document lists, found again: times and velocities.
fn found_again(document: &Value) -> Vec<(Enclosure, Enclosure)> {
    Certificate::parse(&document.to_string()).unwrap().retraced(192).unwrap()
}

fn verdict(document: &Value) -> Verdict {
    Certificate::parse(&document.to_string()).unwrap().check(&Unwatched).unwrap()
}

/// The verdict of a copy with another value at a path.
fn corrupted(document: &Value, path: &str, value: Value) -> Verdict {
    let mut copy = document.clone();
    *copy.pointer_mut(path).expect(path) = value;
    // Words that say something else would be refused whatever the fields are.
    copy["outcome"]["message"] = json!("");
    verdict(&copy)
}

/// The first event of a kind.
fn event(document: &Value, name: &str) -> usize {
    document["events"].as_array().unwrap().iter().position(|event| event["event"] == name).expect(name)
}

/// A path to an entry of an event.
fn entry(event: usize, key: &str) -> String {
    format!("/events/{event}/{key}")
}
