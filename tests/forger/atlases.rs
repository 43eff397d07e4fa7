//! Atlases: proofs at one point claimed of another point, components left out or of another kind, other numbers, and missing points.

use serde_json::json;

use super::forged::{Forged, Forgery, Original};

pub const FORGERIES: &[Forgery] = &[
    Forgery { name: "atlas: another's motions", why: "two points have other motions", forge: exchanged },
    Forgery { name: "atlas: left out", why: "motions stay in the component for ever", forge: left_out },
    Forgery { name: "atlas: numbers", why: "the components are others, or as many as listed", forge: numbers },
    Forgery {
        name: "atlas: a stable orbit twice",
        why: "each orbit is listed once, from whichever impact its word is read",
        forge: stable_twice,
    },
    Forgery { name: "atlas: points", why: "a point has one line, and the grid has all", forge: pointed },
];

/// Answers, or values, or numbers of two points that are not of one class.
fn exchanged(original: &Original) -> Vec<Forged> {
    let own = original.points("atlas");
    let mut all = Vec::new();
    for k in 1..own.len() {
        for keys in [&["values"][..], &["point"], &["class", "components", "n_attracting", "n_rest", "n_saddle"]] {
            if own[k - 1]["class"] == own[k]["class"] && keys.len() > 1 {
                continue;
            }
            let mut points = own.clone();
            for key in keys {
                (points[k - 1][key], points[k][key]) = (own[k][key].clone(), own[k - 1][key].clone());
            }
            all.push(original.with_points(format!("{keys:?} of {} and {k}", k - 1), points));
        }
    }
    all
}

/// A point without one of its components, with numbers that agree.
fn left_out(original: &Original) -> Vec<Forged> {
    let own = original.points("atlas");
    let mut all = Vec::new();
    for k in 0..own.len() {
        let components = own[k]["components"].as_array().cloned().unwrap_or_default();
        for (i, component) in components.iter().enumerate() {
            let kind = component["kind"].as_str().unwrap_or_default();
            let key = [("attracting", "n_attracting"), ("rest-cycle", "n_rest"), ("saddle", "n_saddle")];
            // Of a point with undecided components less is claimed.
            if own[k]["n_undecided"] != 0 {
                continue;
            }
            let Some((_, key)) = key.iter().find(|(own, _)| *own == kind) else { continue };
            let mut points = own.clone();
            points[k]["components"].as_array_mut().unwrap().remove(i);
            points[k][*key] = json!(own[k][*key].as_u64().unwrap() - 1);
            all.push(original.with_points(format!("component {i} of {k}"), points));
        }
    }
    all
}

fn numbers(original: &Original) -> Vec<Forged> {
    let own = original.points("atlas");
    let mut all = Vec::new();
    for k in 0..own.len() {
        for key in ["n_attracting", "n_rest", "n_saddle", "n_undecided"] {
            let mut points = own.clone();
            points[k][key] = json!(own[k][key].as_u64().unwrap() + 1);
            all.push(original.with_points(format!("{key} of {k}"), points));
        }
        for class in ["one-rest-cycle", "one-attractor", "attractors", "closed"] {
            let mut points = own.clone();
            points[k]["class"] = json!(class);
            if own[k]["class"] != class {
                all.push(original.with_points(format!("{class} at {k}"), points));
            }
        }
    }
    all
}

/// Read from each of its impacts.
fn stable_twice(original: &Original) -> Vec<Forged> {
    let own = original.points("atlas");
    let mut all = Vec::new();
    for (k, point) in own.iter().enumerate() {
        for (i, orbit) in point["stable"].as_array().into_iter().flatten().enumerate() {
            let word: Vec<&str> = orbit["word"].as_str().unwrap().split(' ').collect();
            for shift in 0..word.len() {
                let mut again = orbit.clone();
                again["word"] = json!([&word[shift..], &word[..shift]].concat().join(" "));
                let mut points = own.clone();
                points[k]["stable"].as_array_mut().unwrap().push(again);
                all.push(original.with_points(format!("orbit {i} of {k}, read {shift} mappings later"), points));
            }
        }
    }
    all
}

fn pointed(original: &Original) -> Vec<Forged> {
    let own = original.points("atlas");
    let mut all = Vec::new();
    for k in 0..own.len() {
        let mut fewer = own.clone();
        fewer.remove(k);
        let twice = own.iter().chain([&own[k]]).cloned().collect();
        all.push(original.with_points(format!("without {k}"), fewer));
        all.push(original.with_points(format!("{k} twice"), twice));
    }
    all
}
