//! The claims of one scene under another one's name, of which more than one datum differs.

use impact_pair::json::SceneDocument;
use serde_json::{Value, json};

use super::numbers::negated;
use super::original::{Forged, Forgery, Original, with};

pub const FORGERIES: &[Forgery] = &[
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

/// The path of the scene in a document; none where there are several.
fn place(original: &Original) -> Option<&'static str> {
    match original.kind {
        "list" => None,
        "sweep" | "atlas" | "lines" => Some("/0/scene"),
        _ => Some("/scene"),
    }
}

/// The document under the name of a scene, if this is one. If there is no impact, another scene may have none either.
fn under(original: &Original, what: &str, scene: Value) -> Option<Forged> {
    serde_json::from_value::<SceneDocument>(scene.clone()).ok()?.model().ok()?;
    let forged = original.with(what, &[(place(original)?, scene)]).probably();
    // Of basins no impact is listed, but what becomes of them.
    let is_of_basins = original.is(&["sweep"]) && original.document[0]["summary"] == true;
    Some(if is_of_basins { forged.at(&["[1].period", "[1].exponent"]) } else { forged })
}

fn scene(original: &Original) -> Option<&Value> {
    original.document.pointer(place(original)?)
}

fn has_impacts(original: &Original) -> bool {
    original.is(&["sweep"]) && original.document[1]["states"].is_array()
        || original.events().iter().any(|event| event["event"] == "impact")
}

fn mirrored(original: &Original) -> Vec<Forged> {
    let Some(mut scene) = scene(original).filter(|_| has_impacts(original)).cloned() else { return Vec::new() };
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
    under(original, "mirrored", scene).into_iter().collect()
}

fn units(original: &Original) -> Vec<Forged> {
    let is_dimensional =
        has_impacts(original) || original.is(&["periodic", "two-impact", "bifurcations", "cycles", "trap"]);
    let Some(own) = scene(original).filter(|_| is_dimensional) else { return Vec::new() };
    let scaled = |changes: &[(&[&str], &str)]| {
        let mut scene = own.clone();
        for (keys, factor) in changes {
            let all =
                ["", "/0", "/1", "/2"].into_iter().flat_map(|at| keys.iter().map(move |key| format!("/{key}{at}")));
            for key in all {
                let value = scene.pointer(&key).and_then(Value::as_str).filter(|text| !text.starts_with('['));
                if let Some(value) = value.map(|text| format!("({text}) {factor}")) {
                    scene = with(&scene, &[(&key, json!(value))]);
                }
            }
        }
        scene
    };
    let lengths: &[&str] = &["excitation/amplitude", "gap", "start/position", "start/velocity"];
    let rates: &[&str] = &["excitation/frequency", "start/velocity"];
    let all = [
        ("lengths", scaled(&[(lengths, "* 1000")])),
        ("times", scaled(&[(&["start/time"], "* 1000"), (rates, "/ 1000")])),
    ];
    all.into_iter().filter_map(|(what, scene)| under(original, what, scene)).collect()
}

/// Regions, horseshoes and cycles with rests are as true of neighbours.
fn harmonics(original: &Original) -> Vec<Forged> {
    let is_without_orbits = original.is(&["trap", "chaos", "hyperbolic", "atlas", "chaos-cells"])
        || original.is(&["global"]) && !original.document.to_string().contains("\"orbit\"");
    let Some(own) = scene(original).filter(|_| !is_without_orbits) else { return Vec::new() };
    let keys = ["amplitude", "frequency", "phase"];
    let terms = keys.map(|key| own["excitation"][key].as_array().unwrap().clone());
    let of = |what: &str, terms: [Vec<Value>; 3]| {
        let mut scene = own.clone();
        keys.into_iter().zip(terms).for_each(|(key, values)| scene["excitation"][key] = Value::Array(values));
        under(original, what, scene)
    };
    let more = |amplitude: &str, frequency: &str| {
        let first = own["excitation"]["frequency"][0].as_str().unwrap();
        let added = [amplitude.to_owned(), format!("{frequency} * ({first})"), "0.5".to_owned()];
        let mut terms = terms.clone();
        terms.iter_mut().zip(added).for_each(|(values, value)| values.push(json!(value)));
        of(&format!("{amplitude} of {frequency} times the frequency more"), terms)
    };
    let fewer = terms.clone().map(|mut values| {
        values.pop();
        values
    });
    let fewer = (!fewer[0].is_empty()).then(|| of("one less", fewer)).flatten();
    [more("1e-3", "2"), more("1e-3", "3"), more("0.05", "sqrt(2)"), fewer].into_iter().flatten().collect()
}
