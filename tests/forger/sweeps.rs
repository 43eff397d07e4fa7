//! Sweeps: the impacts of one point under another one's values, one fewer than there are, and a point twice.

use serde_json::{Value, json};

use super::forged::{Forged, Forgery, Original};

pub const FORGERIES: &[Forgery] = &[
    Forgery { name: "sweep: another's impacts", why: "two points of the grid have other orbits", forge: exchanged },
    Forgery { name: "sweep: an impact less", why: "it comes between those around it", forge: dropped },
    Forgery { name: "sweep: transient", why: "each impact is listed as the one after it", forge: later },
    Forgery { name: "sweep: a point twice", why: "a point has one line", forge: twice },
    Forgery { name: "sweep: head", why: "its points are of other shards, or have impacts", forge: headed },
    Forgery { name: "sweep: a point missing", why: "the grid has more points", forge: missing },
    Forgery { name: "sweep: what becomes of points", why: "its orbit does not, or not in this rhythm", forge: ended },
];

fn exchanged(original: &Original) -> Vec<Forged> {
    let own = original.points("sweep");
    let mut all = Vec::new();
    for k in 1..own.len() {
        for key in ["states", "values", "point"] {
            if own[k - 1][key] == own[k][key] || !own[k]["states"].is_array() {
                continue;
            }
            let mut points = own.clone();
            (points[k - 1][key], points[k][key]) = (own[k][key].clone(), own[k - 1][key].clone());
            all.push(original.with_points(format!("{key} of {} and {k}", k - 1), points));
        }
    }
    all
}

fn dropped(original: &Original) -> Vec<Forged> {
    let own = original.points("sweep");
    let mut all = Vec::new();
    for k in 0..own.len() {
        let Some(states) = own[k]["states"].as_array() else { continue };
        for at in 0..states.len().saturating_sub(1) {
            let mut points = own.clone();
            let mut fewer = states.clone();
            fewer.remove(at);
            for (state, index) in fewer.iter_mut().zip(states) {
                state["index"] = index["index"].clone();
            }
            points[k]["states"] = Value::Array(fewer);
            points[k]["impacts"] = json!(own[k]["impacts"].as_u64().unwrap() - 1);
            all.push(original.with_points(format!("state {at} of {k}"), points));
        }
    }
    all
}

fn twice(original: &Original) -> Vec<Forged> {
    let own = original.points("sweep");
    let again = |k: usize| original.with_points(format!("{k} twice"), [&own[..], &own[k..=k]].concat());
    (0..own.len()).map(again).collect()
}

/// A whole sweep of two points or more is no shard, and one that lists impacts no summary.
fn headed(original: &Original) -> Vec<Forged> {
    let own = original.points("sweep");
    let mut all = Vec::new();
    for shard in [[1, 2], [2, 2], [1, 3]].iter().filter(|_| own.len() > 1 && original.document[0]["shard"].is_null()) {
        let mut forged = original.with_points(format!("shard {shard:?}"), own.clone());
        forged.document[0]["shard"] = json!(shard);
        all.push(forged);
    }
    if own.iter().any(|point| point["states"].is_array()) {
        let mut forged = original.with_points("a summary", own);
        forged.document[0]["summary"] = json!(true);
        all.push(forged);
    }
    all
}

fn missing(original: &Original) -> Vec<Forged> {
    let own = original.points("sweep");
    let without = |k: usize| original.with_points(format!("without {k}"), [&own[..k], &own[k + 1..]].concat());
    (0..own.len()).map(without).collect()
}

fn later(original: &Original) -> Vec<Forged> {
    let mut points = original.points("sweep");
    if !points.iter().any(|point| point["states"].is_array()) {
        return Vec::new();
    }
    for point in &mut points {
        for state in point["states"].as_array_mut().into_iter().flatten() {
            state["index"] = json!(state["index"].as_u64().unwrap() + 1);
        }
        point["impacts"] = json!(point["impacts"].as_u64().unwrap() + 1);
    }
    let mut forged = original.with_points("each an impact later", points);
    let transient = original.document[0]["transient"].as_u64().unwrap();
    forged.document[0]["transient"] = json!(transient + 1);
    vec![forged]
}

fn ended(original: &Original) -> Vec<Forged> {
    let own = original.points("sweep");
    let mut all = Vec::new();
    for (k, point) in own.iter().enumerate() {
        for (key, value) in [
            ("outcome", json!("rests-forever")),
            ("outcome", json!("never-impacts")),
            ("period", json!({ "word": "P3", "impacts": 1, "cycles": 7, "from": 1, "first": null })),
            ("impacts_per_cycle", json!(["100", "101"])),
            ("exponent", json!({ "per_impact": ["100", "101"], "per_cycle": ["100", "101"], "reason": null })),
        ] {
            if point[key] != value {
                let mut points = own.clone();
                points[k][key] = value;
                all.push(original.with_points(format!("{key} of {k}"), points));
            }
        }
    }
    all
}
