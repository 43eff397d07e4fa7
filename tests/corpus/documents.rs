//! The true documents: those that are recorded in `crates/certificate/tests/documents`, one also as JSON Lines, and lists of two.

use serde_json::{Value, json};

use super::original::{KINDS, Original};
use super::recorded;

/// Documents of which two make a list.
const LISTS: [(&str, [&str; 2]); 2] =
    [("orbits", ["two impacts", "every orbit"]), ("motions", ["stable and unstable", "time"])];

/// Bytes of the longest document that is changed: of longer ones all is as of others.
const LONGEST: usize = 20_000;
/// Documents in which it is left open whether orbits are physical, of the same with all decided.
const LEFT_OPEN: [&str; 4] =
    ["stable and unstable", "two impacts", "bifurcations over the amplitude", "bifurcations of three impacts"];

/// All of them, in the order of their kinds.
pub fn all() -> Vec<Original> {
    // A check of deep ones takes seconds.
    let quick = recorded::all_that_are(false);
    let deep = if super::cases() < usize::MAX { Vec::new() } else { recorded::all_that_are(true) };
    let is_short = |(_, lines): &(String, Vec<Value>)| recorded::text(lines).len() < LONGEST;
    let recorded = quick.into_iter().chain(deep).filter(is_short);
    let mut all: Vec<Original> = recorded.map(|(name, lines)| Original::new(&name, &lines)).collect();
    let named = |name: &str| all.iter().find(|original| original.name == name).expect(name).document.clone();
    let lists = LISTS.map(|(name, both)| Original::new(name, &[json!(both.map(named))]));
    let lines = Original::new("a chatter in lines", &as_lines(named("chatter in a time")));
    let open = LEFT_OPEN.map(|name| Original::new(&format!("{name}, left open"), &[left_open(named(name))]));
    all.extend(lists);
    all.extend(open);
    all.push(lines);
    all.sort_by_key(|original| KINDS.iter().position(|kind| *kind == original.kind));
    all
}

/// The recorded document of this name, of one line.
pub fn document(name: &str) -> Value {
    recorded::document(name).swap_remove(0)
}

/// An orbit as JSON Lines: its head, each event, its end.
fn as_lines(mut head: Value) -> Vec<Value> {
    let entries = head.as_object_mut().unwrap();
    let [events, outcome] = ["events", "outcome"].map(|key| entries.remove(key).unwrap());
    let end = json!({ "outcome": outcome, "arithmetic": head["arithmetic"] });
    [&[head][..], events.as_array().unwrap(), &[end]].concat()
}

/// The document without the claims that its orbits are physical.
fn left_open(mut document: Value) -> Value {
    document["certified"] = json!(false);
    for orbit in document["orbits"].as_array_mut().into_iter().flatten() {
        orbit["physical"] = Value::Null;
    }
    for point in document["points"].as_array_mut().into_iter().flatten() {
        point["orbit"]["physical"] = Value::Null;
    }
    document
}
