//! What follows from the other values of a document, told anew: so that in a false one what is wrong stands alone.

use impact_pair_document::{FateDocument, GlobalDocument, OutcomeDocument};
use serde_json::{Value, json};

/// The document with counts, numbers, mappings, classes and sentences as its other values make them.
pub fn told_anew(document: &Value) -> Value {
    let mut copy = document.clone();
    match &mut copy {
        Value::Array(lines) if lines[0]["schema"] == "impact-pair/sweep/1" => sweep(lines),
        Value::Array(lines) if lines[0]["schema"] == "impact-pair/atlas/1" => lines[1..].iter_mut().for_each(counts),
        Value::Array(documents) => documents.iter_mut().for_each(|document| *document = told_anew(document)),
        _ => {}
    }
    match copy["schema"].as_str().and_then(|schema| schema.split('/').nth(1)) {
        Some("orbit") => orbit(&mut copy),
        Some("cycles") => fixed_points(&mut copy),
        Some("trap") => boxes(&mut copy),
        Some("global") => copy = class(copy),
        Some("chaos") => each(&mut copy["words"], |word| word["impacts"] = length(&word["flights"])),
        Some("windows") => each(&mut copy["windows"], |own| own["reduced_impacts"] = length(&own["flights"])),
        Some("description") => {
            if let Ok(fate) = serde_json::from_value::<FateDocument>(copy["fate"].clone()) {
                copy["fate"]["message"] = json!(fate.words().unwrap_or_default());
            }
        }
        _ => {}
    }
    copy
}

fn each(list: &mut Value, change: impl Fn(&mut Value)) {
    list.as_array_mut().into_iter().flatten().filter(|item| item.is_object()).for_each(change);
}

fn length(text: &Value) -> Value {
    json!(text.as_str().map_or(0, str::len))
}

/// Numbers and mappings of impacts, their count, and the message.
fn orbit(document: &mut Value) {
    let mut last = document["scene"]["start"]["wall"].as_str().map(str::to_owned);
    let mut index = 0;
    for event in document["events"].as_array_mut().into_iter().flatten().filter(|event| event["wall"].is_string()) {
        let wall = event["wall"].as_str().unwrap().to_owned();
        if event["event"] == "impact" {
            index += 1;
            (event["index"], event["mapping"]) = (json!(index), json!(last.map(|last| mapping(&last, &wall))));
        } else if event["event"] == "graze" {
            continue;
        }
        last = Some(wall);
    }
    if let Some(outcome) = document["outcome"].as_object_mut() {
        outcome.insert("impacts".to_owned(), json!(index));
    }
    if let Ok(outcome) = serde_json::from_value::<OutcomeDocument>(document["outcome"].clone()) {
        document["outcome"]["message"] = json!(outcome.words().unwrap_or_default());
    }
}

fn mapping(from: &str, to: &str) -> &'static str {
    match (from, to) {
        ("right", "left") => "P1",
        ("left", "right") => "P2",
        ("right", _) => "P3",
        _ => "P4",
    }
}

/// The impacts of each point, numbered after the transient.
fn sweep(lines: &mut [Value]) {
    let transient = lines[0]["transient"].as_u64().unwrap_or(0);
    for point in lines[1..].iter_mut().filter(|point| point["states"].is_array()) {
        let states = point["states"].as_array_mut().unwrap();
        for (i, state) in states.iter_mut().enumerate().filter(|(_, state)| state.is_object()) {
            state["index"] = json!(transient + 1 + i as u64);
        }
        point["impacts"] = json!(transient + states.len() as u64);
    }
}

/// Lemma D23: the fixed points of `n` impacts are those of the cycles whose least number divides `n`.
fn fixed_points(document: &mut Value) {
    let numbers: Vec<u64> =
        document["orbits"].as_array().into_iter().flatten().filter_map(|own| own["reduced_impacts"].as_u64()).collect();
    for (impacts, count) in document["fixed_points"].as_object_mut().into_iter().flatten() {
        let impacts: u64 = impacts.parse().unwrap_or(0);
        let own = numbers.iter().filter(|number| **number > 0 && impacts.is_multiple_of(**number));
        *count = json!(own.sum::<u64>());
    }
}

fn boxes(document: &mut Value) {
    let size = |run: &Value| Some(run[2].as_i64()? - run[1].as_i64()? + 1);
    document["boxes"] = json!(document["region"].as_array().into_iter().flatten().filter_map(size).sum::<i64>());
}

/// Numbers of components of each kind.
fn number(document: &Value, kind: &str) -> usize {
    document["components"].as_array().into_iter().flatten().filter(|own| own["kind"] == kind).count()
}

/// The numbers of components of a point of an atlas.
fn counts(point: &mut Value) {
    let kinds = [
        ("n_attracting", "attracting"),
        ("n_rest", "rest-cycle"),
        ("n_saddle", "saddle"),
        ("n_undecided", "undecided"),
    ];
    if point["components"].is_array() {
        kinds.iter().for_each(|(key, kind)| point[*key] = json!(number(point, kind)));
        point["class"] = json!(class_of(point));
    }
}

fn class_of(document: &Value) -> &'static str {
    let [rests, attracting, open] = ["rest-cycle", "attracting", "undecided"].map(|kind| number(document, kind));
    match (rests + attracting, open) {
        (1, 0) if rests == 1 && document["components"].as_array().is_some_and(|all| all.len() == 1) => "one-rest-cycle",
        (1, 0) => "one-attractor",
        (1.., _) => "attractors",
        _ => "undecided",
    }
}

/// Class, order and sentence of a global analysis; of other components than there were the basins are others.
fn class(mut document: Value) -> Value {
    let class = class_of(&document);
    (document["class"], document["certified"]) = (json!(class), json!(class.starts_with("one-")));
    let last = document["components"].as_array().map_or(0, Vec::len);
    let is_in = |index: &Value| index.as_u64().is_some_and(|index| (index as usize) < last);
    if let Some(order) = document["order"].as_array_mut() {
        order.retain(|step| (0..2).all(|end| is_in(&step[end])));
    }
    if document["basins"]["areas"].as_array().is_some_and(|areas| !areas.iter().all(|area| is_in(&area["component"]))) {
        document["basins"] = Value::Null;
    }
    serde_json::from_value::<GlobalDocument>(document.clone()).map_or(document, |own| json!(own.with_statement()))
}
