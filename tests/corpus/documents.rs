//! The true documents: those that are recorded in `crates/certificate/tests/documents`, one also as JSON Lines, and lists of two.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::original::{KINDS, Original};

/// Documents of which two make a list.
const LISTS: [(&str, [&str; 2]); 2] =
    [("orbits", ["two impacts", "every orbit"]), ("motions", ["stable and unstable", "time"])];

/// Bytes of the longest document that is changed.
const LONGEST: u64 = 20_000;
/// Documents in which it is left open whether orbits are physical, of the same with all decided.
const LEFT_OPEN: [&str; 4] =
    ["stable and unstable", "two impacts", "bifurcations over the amplitude", "bifurcations of three impacts"];

/// All of them, in the order of their kinds.
pub fn all() -> Vec<Original> {
    let folder = Path::new(impact_pair_tests::ROOT).join("crates/certificate/tests/documents");
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let read = |file: &Path| {
        let text = fs::read_to_string(file).unwrap();
        let lines: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        Original::new(&file.file_stem().unwrap().to_string_lossy().replace('-', " "), &lines)
    };
    // Of the longest ones all is the same as of others; a check of deep ones takes seconds.
    let deep: Vec<String> = deep();
    let is_deep = |file: &Path| deep.iter().any(|name| file.ends_with(name.replace(' ', "-") + ".jsonl"));
    let is_short = |file: &&PathBuf| fs::metadata(file).unwrap().len() < LONGEST && !is_deep(file);
    let mut all: Vec<Original> = files.iter().filter(is_short).map(|file| read(file)).collect();
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

/// Names of the documents whose check takes seconds, by default.
fn deep() -> Vec<String> {
    let table: Vec<Value> =
        serde_json::from_str(include_str!("../../crates/certificate/tests/documents.json")).unwrap();
    let is_deep = |row: &&Value| row["deep"] == true && super::cases() < usize::MAX;
    table.iter().filter(is_deep).map(|row| row["name"].as_str().unwrap().to_owned()).collect()
}

/// The recorded document of this name, of one line.
pub fn document(name: &str) -> Value {
    let file = Path::new(impact_pair_tests::ROOT).join("crates/certificate/tests/documents");
    serde_json::from_str(&fs::read_to_string(file.join(name.replace(' ', "-") + ".jsonl")).unwrap()).unwrap()
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
