//! Sweeps and atlases: what one point has under another one's name, and all impacts as each were the one after it.

use serde_json::json;

use super::original::{Forged, Forgery, Original};

pub const FORGERIES: &[Forgery] = &[
    Forgery { name: "grid: another point's", why: "two points have other motions, or other classes", forge: exchanged },
    Forgery { name: "sweep: transient", why: "each impact is listed as the one after it", forge: later },
    Forgery { name: "sweep: what becomes of points", why: "its orbit does not, or not in this rhythm", forge: ended },
];

/// What two neighbours have, one key or several at a time, where they are not alike.
fn exchanged(original: &Original) -> Vec<Forged> {
    let own = original.points();
    let classes: &[&str] = &["class", "components", "n_attracting", "n_rest", "n_saddle"];
    let all: [&[&str]; 4] = [&["states"], &["values"], &["point"], classes];
    let mut forged = Vec::new();
    for k in 1..own.len() {
        let is_listed = own[k]["states"].is_array();
        for keys in all.into_iter().filter(|keys| is_listed == (keys[0] != "class") || original.kind == "atlas") {
            if own[k - 1][keys[0]] == own[k][keys[0]] {
                continue;
            }
            let mut points = own.clone();
            for key in keys {
                (points[k - 1][key], points[k][key]) = (own[k][key].clone(), own[k - 1][key].clone());
            }
            forged.push(original.with_points(format!("{keys:?} of {} and {k}", k - 1), points));
        }
    }
    forged
}

fn later(original: &Original) -> Vec<Forged> {
    let mut points = original.points();
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
    let own = original.points();
    let others = [
        ("outcome", json!("rests-forever")),
        ("outcome", json!("never-impacts")),
        ("period", json!({ "word": "P3", "impacts": 1, "cycles": 7, "from": 1, "first": null })),
        ("impacts_per_cycle", json!(["100", "101"])),
        ("exponent", json!({ "per_impact": ["100", "101"], "per_cycle": ["100", "101"], "reason": null })),
    ];
    let of = |k: usize| {
        let (own, original) = (&own, original);
        others.clone().into_iter().filter(move |(key, value)| own[k][*key] != *value).map(move |(key, value)| {
            let mut points = own.clone();
            points[k][key] = value;
            original.with_points(format!("{key} of {k}"), points)
        })
    };
    (0..if original.kind == "sweep" { own.len() } else { 0 }).flat_map(of).collect()
}
