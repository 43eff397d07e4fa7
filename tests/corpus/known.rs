//! The truth of the claims that a forgery leaves, computed anew by the library.

use impact_pair::Scene;
use impact_pair::chaos::{Chaos, Global, GlobalSettings, HSet, HorseshoeSettings, Kind};
use impact_pair::json::{GivenBase, SceneDocument};
use impact_pair::mapping::Word;
use impact_pair::periodic::Precision;
use impact_pair::periodic::bifurcation::{DiagramSettings, survey};
use impact_pair::watch::Unwatched;
use serde_json::{Value, json};

use super::numbers::bounds;
use super::truth;

/// Whether all checked claims of a document hold; false for kinds that are not computed again.
pub fn is_true(kind: &str, document: &Value) -> bool {
    match kind {
        "list" => document.as_array().is_some_and(|all| all.iter().all(truth::is_true)),
        "lines" => truth::is_true(&of_lines(document)),
        "bifurcations" => has_bifurcations(document) == Some(true),
        "cycles" => document["orbits"].as_array().is_some_and(|all| all.iter().all(|orbit| has_orbit(document, orbit))),
        "chaos" => has_words(document) == Some(true),
        "global" => has_rests(document) == Some(true),
        "orbit" | "shadow" | "periodic" | "two-impact" => truth::is_true(document),
        _ => false,
    }
}

/// The orbit of JSON Lines in one document.
fn of_lines(lines: &Value) -> Value {
    let [head, events @ .., end] = lines.as_array().unwrap().as_slice() else { return Value::Null };
    let mut document = head.clone();
    (document["events"], document["outcome"]) = (json!(events), end["outcome"].clone());
    document
}

/// Whether the document is about a single cycle with rests, and the cycle is the cycle of its scene.
fn has_rests(document: &Value) -> Option<bool> {
    let (pair, _) = serde_json::from_value::<SceneDocument>(document["scene"].clone()).ok()?.model().ok()?;
    let [claimed] = &document["components"].as_array()?[..] else { return None };
    let found = Global::of(&pair, &GlobalSettings::default(), &Unwatched).ok()?;
    let Kind::RestCycle(Some(rest)) = found.components.first()?.kind else { return None };
    let is_one = claimed["cycles"] == rest.cycles && claimed["alternates"] == rest.alternates;
    let basins = &document["basins"];
    let part = |part: &Value| part.as_str().and_then(|part| part.parse::<f64>().ok());
    // All of the state space is its basin.
    let is_basin = |basin: &Value| {
        let (own, rest) = (part(&basin["area"])?, part(&basins["undecided"])?);
        Some(basin["component"] == 0 && (0.0..=1.0).contains(&own) && own + rest >= 1.0)
    };
    let are_basins = match basins["areas"].as_array() {
        Some(areas) => areas.len() == 1 && is_basin(&areas[0]) == Some(true),
        None => basins.is_null(),
    };
    Some(is_one && are_basins && claimed["kind"] == "rest-cycle" && document["class"] == found.class().to_string())
}

/// Each of its points is found, of its kind.
fn has_bifurcations(document: &Value) -> Option<bool> {
    let (pair, start) = serde_json::from_value::<SceneDocument>(document["scene"].clone()).ok()?.model().ok()?;
    let word: Word = document["word"].as_str()?.parse().ok()?;
    let over = &document["over"];
    let over = format!("{}={}..{}", over["key"].as_str()?, over["low"].as_str()?, over["high"].as_str()?);
    let precision = Precision { digits: 20, ..Precision::default() };
    let diagram_settings = DiagramSettings { over: over.parse().ok()?, doublings: 3, precision };
    let requested = (&word, document["cycles"].as_u64()? as u32);
    let diagram = survey(&pair, &start, requested, &diagram_settings, &Unwatched).ok()?;
    let found = json!(diagram.document(&start, requested).ok()?);
    let is_found = |claim: &Value| {
        found["points"].as_array().unwrap().iter().any(|point| {
            let parameters = bounds(&claim["parameter"]).zip(bounds(&point["parameter"]));
            claim["kind"] == point["kind"]
                && claim["word"] == point["word"]
                && parameters.is_some_and(|(claim, point)| claim[0] <= point[0] && point[1] <= claim[1])
        })
    };
    Some(document["points"].as_array()?.iter().all(is_found))
}

/// A cycle is one of the periodic orbits of its word.
fn has_orbit(document: &Value, orbit: &Value) -> bool {
    let [word, cycles] = ["word", "cycles"].map(|key| &orbit[key]);
    truth::is_true(
        &json!({ "scene": document["scene"], "word": word, "cycles": cycles, "certified": false, "orbits": [orbit] }),
    )
}

/// Each of its words is found from its bases.
fn has_words(document: &Value) -> Option<bool> {
    let (pair, start) = serde_json::from_value::<SceneDocument>(document["scene"].clone()).ok()?.model().ok()?;
    let bases: Vec<GivenBase> = serde_json::from_value(document["bases"].clone()).ok()?;
    let question = HorseshoeSettings {
        depth: Some(document["depth"].as_u64()? as usize),
        bases: bases.iter().map(HSet::from).collect(),
        ..HorseshoeSettings::default()
    };
    // It only names what is found.
    let scene = Scene::parse(include_str!("../../scenes/figure-14.toml")).ok()?;
    let found = json!(Chaos::of(&pair, &start, &question, &Unwatched).ok()?.document(&scene, None, None));
    let found = found["words"].as_array()?;
    let all = document["words"].as_array()?;
    let count = |words: &[Value], word: &Value| words.iter().filter(|other| *other == word).count();
    Some(all.iter().all(|word| count(all, word) <= count(found, word)))
}
