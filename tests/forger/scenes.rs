//! The claims of one scene under another one's name.

use impact_pair::json::SceneDocument;
use serde_json::{Value, json};

use super::forged::{Forged, Forgery, Original, negated, with};

pub const FORGERIES: &[Forgery] = &[
    Forgery {
        name: "scene: neighbour",
        why: "the bounds are narrower than what a datum changed so little changes",
        forge: neighbours,
    },
    Forgery { name: "scene: mirrored", why: "in the mirrored scene each impact is on the other wall", forge: mirrored },
    Forgery {
        name: "scene: units",
        why: "in these units all lengths or all times are a thousand times those that are claimed",
        forge: units,
    },
    Forgery {
        name: "scene: harmonics",
        why: "a harmonic more, or one less, moves all impacts by more than the bounds are wide",
        forge: harmonics,
    },
];

/// The path of the scene in a document.
fn place(original: &Original) -> &'static str {
    if original.is(&["sweep", "atlas"]) { "/0/scene" } else { "/scene" }
}

/// The document under the name of a scene, if this is one.
fn under(original: &Original, what: String, scene: Value) -> Option<Forged> {
    serde_json::from_value::<SceneDocument>(scene.clone()).ok()?.model().ok()?;
    let forged = original.with(what, &[(place(original), scene)]);
    // Of basins no impact is listed, but what becomes of them.
    let is_of_basins = original.is(&["sweep"]) && original.document[0]["summary"] == true;
    let forged = if is_of_basins { forged.at(&["[1].period", "[1].exponent"]) } else { forged };
    // If there is no impact, a neighbour may have none either.
    Some(forged.probably())
}

fn scene(original: &Original) -> &Value {
    original.document.pointer(place(original)).unwrap()
}

fn is_interval(text: &Value) -> bool {
    text.as_str().is_some_and(|text| text.starts_with('['))
}

fn neighbours(original: &Original) -> Vec<Forged> {
    // Horseshoes, stable orbits, regions and cycles with rests are as true of neighbours.
    let is_without_orbits = original.is(&["global"]) && !original.document.to_string().contains("\"orbit\"");
    if is_without_orbits || original.is(&["trap", "chaos", "hyperbolic", "atlas", "cells"]) {
        return Vec::new();
    }
    let keys = [
        "/gap",
        "/restitution",
        "/excitation/amplitude/0",
        "/excitation/frequency/0",
        "/excitation/phase/0",
        "/start/velocity",
        "/start/position",
        "/start/time",
    ];
    // Of sweeps bounds have fewer digits.
    let steps: &[&str] = if original.is(&["sweep"]) { &["1e-3"] } else { &["1e-3", "1e-9"] };
    let mut all = Vec::new();
    for key in keys {
        let own = scene(original);
        let Some(value) = own.pointer(key).filter(|value| value.is_string() && !is_interval(value)) else { continue };
        for step in steps {
            let moved = |sign: &str| with(own, &[(key, json!(format!("({}) {sign} {step}", value.as_str().unwrap())))]);
            let forged =
                ["+", "-"].into_iter().find_map(|sign| under(original, format!("{key} {sign} {step}"), moved(sign)));
            all.extend(forged.filter(|_| !is_named_only(original, key)));
        }
    }
    all
}

/// Whether the value only names the scene. A sweep replaces it by the values of its axes. From a given phase on, a motion under one
/// harmonic is the same for every `tau` (Lemma R1), and so are windows of periodic orbits, whose impacts are listed by phase.
fn is_named_only(original: &Original, key: &str) -> bool {
    if original.is(&["windows"]) {
        return key == "/excitation/phase/0";
    }
    let axes = original.document[0]["over"].as_array().filter(|_| original.is(&["sweep"])).cloned().unwrap_or_default();
    axes.iter().any(|axis| {
        let name = axis["key"].as_str().unwrap().replace('.', "/");
        key.contains(&name) || name == "start/phase" && ["/start/time", "/excitation/phase/0"].contains(&key)
    })
}

fn has_impacts(original: &Original) -> bool {
    original.is(&["sweep"]) && original.document[1]["states"].is_array()
        || original.events().iter().any(|event| event["event"] == "impact")
}

fn mirrored(original: &Original) -> Vec<Forged> {
    if !has_impacts(original) {
        return Vec::new();
    }
    let mut scene = scene(original).clone();
    let start = &mut scene["start"];
    if let Some(wall) = start.get("wall").cloned() {
        start["wall"] = json!(if wall == "left" { "right" } else { "left" });
    }
    for key in ["position", "velocity"] {
        if let Some(value) = start.get(key).cloned() {
            start[key] = negated(&value);
        }
    }
    for phase in scene["excitation"]["phase"].as_array_mut().unwrap() {
        *phase = json!(format!("({}) + pi", phase.as_str().unwrap()));
    }
    under(original, "mirrored".into(), scene).into_iter().collect()
}

fn units(original: &Original) -> Vec<Forged> {
    let is_dimensional =
        has_impacts(original) || original.is(&["periodic", "two-impact", "bifurcations", "cycles", "trap"]);
    if !is_dimensional {
        return Vec::new();
    }
    let lengths = [
        "/excitation/amplitude/0",
        "/excitation/amplitude/1",
        "/excitation/amplitude/2",
        "/gap",
        "/start/position",
        "/start/velocity",
    ];
    let times = ["/start/time"];
    let rates = ["/excitation/frequency/0", "/excitation/frequency/1", "/excitation/frequency/2", "/start/velocity"];
    let scaled = |what: &str, keys: &[&str], factor: &str, more: (&[&str], &str)| {
        let mut scene = scene(original).clone();
        for (keys, factor) in [(keys, factor), more] {
            for key in keys {
                let Some(value) = scene.pointer(key).filter(|value| value.is_string() && !is_interval(value)).cloned()
                else {
                    continue;
                };
                scene = with(&scene, &[(key, json!(format!("({}) {factor}", value.as_str().unwrap())))]);
            }
        }
        under(original, what.to_owned(), scene)
    };
    let all = [scaled("lengths", &lengths, "* 1000", (&[], "")), scaled("times", &times, "* 1000", (&rates, "/ 1000"))];
    all.into_iter().flatten().collect()
}

fn harmonics(original: &Original) -> Vec<Forged> {
    let is_without_orbits = original.is(&["global"]) && !original.document.to_string().contains("\"orbit\"");
    if is_without_orbits || original.is(&["trap", "chaos", "hyperbolic", "atlas", "cells"]) {
        return Vec::new();
    }
    let own = scene(original);
    let of = |key: &str| own["excitation"][key].as_array().unwrap().clone();
    let keys = ["amplitude", "frequency", "phase"];
    let with_terms = |what: &str, terms: [Vec<Value>; 3]| {
        let mut scene = own.clone();
        for (key, values) in keys.into_iter().zip(terms) {
            scene["excitation"][key] = Value::Array(values);
        }
        under(original, what.to_owned(), scene)
    };
    let more = |amplitude: &str, frequency: &str| {
        let first = own["excitation"]["frequency"][0].as_str().unwrap().to_owned();
        let added = [amplitude.to_owned(), format!("{frequency} * ({first})"), "0.5".to_owned()];
        let mut terms = keys.map(of);
        for (values, value) in terms.iter_mut().zip(added) {
            values.push(json!(value));
        }
        with_terms(&format!("{amplitude} of {frequency} times the frequency more"), terms)
    };
    let fewer = keys.map(|key| {
        let mut values = of(key);
        values.pop();
        values
    });
    let still = with(own, &[("/excitation/amplitude/0", json!("0"))]);
    let is_of_scene = !is_named_only(original, "/excitation/amplitude/0");
    let still = is_of_scene.then(|| under(original, "the first vanishes".into(), still)).flatten();
    let fewer = (!fewer[0].is_empty()).then(|| with_terms("one less", fewer)).flatten();
    [more("1e-3", "2"), more("1e-3", "3"), more("0.05", "sqrt(2)"), fewer, still].into_iter().flatten().collect()
}
