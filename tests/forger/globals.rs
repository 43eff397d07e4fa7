//! Global analyses: components left out, of another kind, twice; another class; other numbers.

use impact_pair::json::GlobalDocument;
use serde_json::{Value, json};

use super::forged::{Forged, Forgery, Original};

pub const FORGERIES: &[Forgery] = &[
    Forgery { name: "global: left out", why: "motions stay in the component for ever", forge: left_out },
    Forgery { name: "global: kinds", why: "a saddle attracts no motion near it, a stable orbit all", forge: kinds },
    Forgery { name: "global: twice", why: "it is one motion", forge: twice },
    Forgery { name: "global: class", why: "the components are those of another class", forge: classes },
    Forgery {
        name: "global: basins",
        why: "a saddle has no basin, and no motion ends in two attractors",
        forge: basins,
    },
    Forgery { name: "global: closed", why: "motions near a saddle leave it", forge: closed },
    Forgery {
        name: "global: a cycle with rests more",
        why: "one is listed, and all begin with the same release, or motions that rest again and again are not proved",
        forge: rests,
    },
    Forgery {
        name: "global: a horseshoe",
        why: "the map has no such horseshoe, or it is where something else is proved",
        forge: horseshoes,
    },
    Forgery {
        name: "global: a set of saddle type",
        why: "motions end there from all states near it",
        forge: saddle_sets,
    },
    Forgery { name: "global: numbers", why: "the period, or the spectral radius, is another one", forge: numbers },
    Forgery {
        name: "global: undecided left out",
        why: "between the basins of attractors, and beside a cycle, motions stay that end in none of them",
        forge: undecided_left_out,
    },
    Forgery { name: "global: another's word", why: "the orbit has another word, or another period", forge: words },
];

/// A document with other components, with the class and the sentence that follow from them.
fn with(original: &Original, name: String, change: impl FnOnce(&mut Vec<Value>)) -> Forged {
    let mut document = original.document.clone();
    let mut components = document["components"].as_array().cloned().unwrap_or_default();
    change(&mut components);
    let count = |kinds: &[&str]| components.iter().filter(|own| kinds.iter().any(|kind| own["kind"] == *kind)).count();
    let class = match (count(&["attracting", "rest-cycle"]), count(&["undecided"])) {
        (1, 0) if count(&["rest-cycle"]) == 1 && components.len() == 1 => "one-rest-cycle",
        (1, 0) => "one-attractor",
        (1.., _) => "attractors",
        _ => "undecided",
    };
    document["components"] = json!(components);
    document["class"] = json!(class);
    document["certified"] = json!(class.starts_with("one-"));
    document["order"] = json!([]);
    document["basins"] = Value::Null;
    let said: GlobalDocument = serde_json::from_value(document).unwrap();
    let changes = ["components", "class", "certified", "order", "statement", "basins"];
    let said = json!(said.with_statement());
    let changes: Vec<(String, Value)> = changes.iter().map(|key| (format!("/{key}"), said[*key].clone())).collect();
    let changes: Vec<(&str, Value)> = changes.iter().map(|(path, value)| (path.as_str(), value.clone())).collect();
    original.with(name, &changes)
}

/// The positions of the components of some kinds.
fn places(original: &Original, kinds: &[&str]) -> Vec<usize> {
    let all = original.document["components"].as_array().filter(|_| original.is(&["global"]));
    let is_one = |(_, own): &(usize, &Value)| kinds.iter().any(|kind| own["kind"] == *kind);
    all.into_iter().flatten().enumerate().filter(is_one).map(|(i, _)| i).collect()
}

/// But for what lies in an undecided component, which may hold any motion (Lemma A14).
fn left_out(original: &Original) -> Vec<Forged> {
    let has_boxes = |i: &usize| original.document["components"][*i]["boxes"] != 0;
    let of = |i: usize| with(original, format!("without component {i}"), |all| drop(all.remove(i)));
    places(original, &["attracting", "rest-cycle", "saddle"]).into_iter().filter(has_boxes).map(of).collect()
}

/// Nothing but what is proved, as if that were all.
fn undecided_left_out(original: &Original) -> Vec<Forged> {
    let all = places(original, &["undecided"]);
    if all.is_empty() || places(original, &["attracting", "rest-cycle"]).is_empty() {
        return Vec::new();
    }
    let forge = |all: &mut Vec<Value>| all.retain(|own| own["kind"] != "undecided");
    vec![with(original, "without what is undecided".to_owned(), forge)]
}

/// The word, the orbit and the period of another attracting motion, one by one, and as many impacts twice, or half.
fn words(original: &Original) -> Vec<Forged> {
    let places = places(original, &["attracting"]);
    let mut all = Vec::new();
    for &i in &places {
        for &j in places.iter().filter(|&&j| j != i) {
            let other = original.document["components"][j].clone();
            for key in ["word", "cycles", "orbit", "reduced_impacts"] {
                if other[key] != original.document["components"][i][key] {
                    let name = format!("{key} of {j} is that of {i}");
                    all.push(with(original, name, |all| all[i][key] = other[key].clone()));
                }
            }
        }
        let reduced = original.document["components"][i]["reduced_impacts"].as_u64().unwrap();
        let others = [2 * reduced, reduced / 2];
        all.extend(others.into_iter().filter(|other| *other > 0).map(|other| {
            with(original, format!("{other} impacts of {i}"), |all| all[i]["reduced_impacts"] = json!(other))
        }));
    }
    all
}

fn kinds(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for (kind, other) in
        [("saddle", "attracting"), ("attracting", "saddle"), ("rest-cycle", "attracting"), ("attracting", "rest-cycle")]
    {
        for i in places(original, &[kind]) {
            all.push(with(original, format!("{kind} {i} is {other}"), |all| all[i]["kind"] = json!(other)));
        }
    }
    all
}

/// Claims a set of saddle type instead of an attractor: only the kind is false, not that fewer attractors are proved.
fn saddle_sets(original: &Original) -> Vec<Forged> {
    let periodic = ["reduced_impacts", "word", "cycles", "spectral_radius", "alternates", "orbit"];
    let of = |i: usize| {
        let forged = with(original, format!("component {i} is a set of saddle type"), |all| {
            periodic.iter().for_each(|key| all[i][*key] = Value::Null);
            (all[i]["kind"], all[i]["closed"]) = (json!("saddle"), json!(false));
        });
        forged.at(&[&format!("components[{i}].kind")])
    };
    places(original, &["attracting", "rest-cycle"]).into_iter().map(of).collect()
}

/// A cycle with rests of a period that is not proved, beside the other components.
fn rests(original: &Original) -> Vec<Forged> {
    if !original.is(&["global"]) {
        return Vec::new();
    }
    let rest = |closed: bool| json!({ "kind": "rest-cycle", "boxes": 0, "area": "0.000000", "closed": closed });
    let of = |closed: bool| {
        with(original, format!("a cycle with rests without a period, closed: {closed}"), |all| all.push(rest(closed)))
    };
    [true, false].map(of).into()
}

/// More entropy than the words have, none, h-sets that are not disjoint, and the horseshoe of another component.
fn horseshoes(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for i in places(original, &["undecided"]) {
        let Some(own) = original.document["components"][i]["horseshoe"].as_object().cloned() else { continue };
        let own = Value::Object(own);
        let mut forged = |words: &str, change: &dyn Fn(&mut Value)| {
            let mut other = own.clone();
            change(&mut other);
            all.push(with(original, format!("{words} of component {i}"), |all| all[i]["horseshoe"] = other));
        };
        // Of two letters per impact no more than ln 2 follows per impact.
        for key in ["per_impact", "per_cycle"] {
            forged("more entropy", &|other| other["entropy"][key] = json!("2.5"));
        }
        forged("no entropy", &|other| other["entropy"] = json!({ "per_impact": "0", "per_cycle": "0" }));
        forged("no impacts", &|other| other["depth"] = json!(0));
        forged("one h-set twice", &|other| {
            let base = other["bases"][0].clone();
            other["bases"].as_array_mut().unwrap().push(base);
        });
        for j in places(original, &["attracting", "rest-cycle", "saddle"]) {
            all.push(with(original, format!("that of {i} is in {j}"), |all| all[j]["horseshoe"] = own.clone()));
        }
    }
    all
}

fn twice(original: &Original) -> Vec<Forged> {
    let of = |i: usize| with(original, format!("component {i} twice"), |all| all.push(all[i].clone()));
    places(original, &["attracting", "saddle"]).into_iter().map(of).collect()
}

fn basins(original: &Original) -> Vec<Forged> {
    if original.document["basins"].is_null() {
        return Vec::new();
    }
    let areas = places(original, &["attracting", "rest-cycle"]);
    let saddles = places(original, &["saddle"]);
    let mut all = Vec::new();
    for (k, i) in areas.iter().enumerate() {
        let own = |key: &str, value: Value| (format!("/basins/areas/{k}/{key}"), value);
        let mut changes = vec![own("area", json!("1.000001")), own("area", json!("-0.1"))];
        changes.extend(saddles.iter().map(|saddle| own("component", json!(saddle))));
        all.extend(changes.iter().map(|(path, value)| {
            original.with(format!("{path} of the basin of {i} is {value}"), &[(path.as_str(), value.clone())])
        }));
    }
    // That less is undecided than what is left of the whole.
    let parts: f64 = original.document["basins"]["undecided"].as_str().map_or(0.0, |parts| parts.parse().unwrap());
    if parts > 0.0 {
        let less = json!(format!("{:.6}", 0.5 * parts));
        all.push(original.with("half is undecided of what is", &[("/basins/undecided", less)]));
    }
    all
}

fn closed(original: &Original) -> Vec<Forged> {
    let of =
        |i: usize| original.with(format!("saddle {i} is closed"), &[(&format!("/components/{i}/closed"), json!(true))]);
    places(original, &["saddle"]).into_iter().map(of).collect()
}

fn classes(original: &Original) -> Vec<Forged> {
    if !original.is(&["global"]) {
        return Vec::new();
    }
    let own = original.document["class"].as_str().unwrap();
    let others = ["one-rest-cycle", "one-attractor", "attractors", "closed", "undecided"];
    let others = others.iter().filter(|other| **other != own);
    let mut all: Vec<Forged> =
        others.map(|other| original.with(format!("{own} is {other}"), &[("/class", json!(other))])).collect();
    all.push(
        original.with("another sentence", &[("/statement", json!("every motion that touches a wall is periodic"))]),
    );
    all
}

fn numbers(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for i in places(original, &["attracting", "saddle", "rest-cycle"]) {
        let own = &original.document["components"][i];
        let cycles = own["cycles"].as_u64().unwrap() + 2;
        all.push(with(original, format!("two more cycles of {i}"), |all| all[i]["cycles"] = json!(cycles)));
        if own["kind"] == "rest-cycle" {
            let alternates = own["alternates"] == false;
            all.push(with(original, format!("other walls of {i}"), |all| all[i]["alternates"] = json!(alternates)));
        } else {
            let radius = json!(["0.123", "0.124"]);
            all.push(with(original, format!("another radius of {i}"), |all| all[i]["spectral_radius"] = radius));
            let reduced = own["reduced_impacts"].as_u64().unwrap() + 1;
            all.push(with(original, format!("one more impact of {i}"), |all| {
                all[i]["reduced_impacts"] = json!(reduced)
            }));
        }
    }
    all
}
