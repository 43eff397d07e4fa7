//! Periodic orbits, their bifurcations and all cycles: one twice, one left out, words and flags of others.

use num_rational::BigRational;
use serde_json::{Value, json};

use super::forged::{Forged, Forgery, Original, bounds, decimal, fraction, pair, walk, with};

pub const FORGERIES: &[Forgery] = &[
    Forgery {
        name: "orbits: one twice",
        why: "they are as many as are listed, each of them another one",
        forge: twice,
    },
    Forgery { name: "orbits: one left out", why: "it says that these are all", forge: left_out },
    Forgery { name: "orbits: word", why: "the impacts are those of another word", forge: words },
    Forgery { name: "orbits: cycles", why: "the impacts come again after another number of cycles", forge: cycles },
    Forgery { name: "orbits: stability", why: "its eigenvalues say otherwise", forge: stability },
    Forgery {
        name: "orbits: symmetric",
        why: "it is its own mirror image, or it is not, whether it is physical or not",
        forge: symmetric,
    },
    Forgery { name: "orbits: physical", why: "an earlier contact there is, or there is none", forge: physical },
    Forgery {
        name: "orbits: an amplitude or a gap of its own",
        why: "amplitude and gap of an orbit are those of its scene",
        forge: of_their_own,
    },
    Forgery { name: "bifurcations: kind", why: "the eigenvalue that passes is another one", forge: kinds },
    Forgery {
        name: "bifurcations: parameter",
        why: "bifurcations are isolated, and this one is elsewhere",
        forge: parameters,
    },
    Forgery {
        name: "bifurcations: a term that vanishes",
        why: "it is one of the other harmonics alone; with this one there is no such orbit",
        forge: vanishing,
    },
    Forgery { name: "cycles: counts", why: "these are not the numbers of its orbits", forge: counts },
];

const ORBITS: [&str; 4] = ["periodic", "two-impact", "bifurcations", "cycles"];

/// The path of the list that holds the orbits, each in an entry, and its entries.
fn list(original: &Original) -> Option<(&'static str, &[Value])> {
    let (key, path) = if original.is(&["bifurcations"]) { ("points", "/points") } else { ("orbits", "/orbits") };
    if !original.is(&ORBITS) {
        return None;
    }
    Some((path, original.document[key].as_array()?.as_slice()))
}

/// The orbits of a document, each with its path and its JSON value.
fn orbits<'a>(original: &'a Original) -> Vec<(String, &'a Value)> {
    let Some((path, all)) = list(original) else { return Vec::new() };
    let within = if original.is(&["bifurcations"]) { "/orbit" } else { "" };
    let one = |(k, entry): (usize, &'a Value)| {
        (format!("{path}/{k}{within}"), if within.is_empty() { entry } else { &entry["orbit"] })
    };
    all.iter().enumerate().map(one).collect()
}

fn wide(value: &Value) -> Value {
    let [lower, upper] = bounds(value).unwrap();
    let width = (&upper - &lower + fraction(1, 1 << 60)) / fraction(100, 1);
    pair(&(lower - &width), &(upper + width))
}

fn twice(original: &Original) -> Vec<Forged> {
    let Some((path, all)) = list(original) else { return Vec::new() };
    let mut forged = Vec::new();
    for (k, entry) in all.iter().enumerate() {
        // The same, and with bounds that are a little wider.
        let mut other = entry.clone();
        let key = if path == "/points" { "/orbit/impacts/0/velocity" } else { "/impacts/0/velocity" };
        let bounds = other.pointer(key).unwrap().clone();
        *other.pointer_mut(key).unwrap() = wide(&bounds);
        for (what, entry) in [("again", entry.clone()), ("again in wider bounds", other)] {
            let mut more = all.to_vec();
            more.insert(k + 1, entry);
            forged.push(original.with(format!("{path}/{k} {what}"), &[(path, Value::Array(more))]));
        }
    }
    forged
}

fn left_out(original: &Original) -> Vec<Forged> {
    let Some((path, all)) = list(original).filter(|_| !original.is(&["bifurcations"])) else { return Vec::new() };
    let is_all = original.document["exhaustive"] == true;
    let mut forged = Vec::new();
    for k in (0..all.len()).filter(|_| all.len() > 1) {
        let mut fewer = all.to_vec();
        fewer.remove(k);
        let mut claims = vec!["exhaustive"];
        // All that was asked is not proved then.
        claims.extend((original.document["certified"] == true).then_some("certified"));
        claims.extend(original.is(&["cycles"]).then_some("fixed_points"));
        let changes = [(path, Value::Array(fewer)), ("/exhaustive", json!(true))];
        let what = format!("{path}/{k}{}", if is_all { "" } else { ", and said to be all" });
        forged.push(original.with(what, &changes).at(&claims));
    }
    forged
}

fn rotated(word: &Value) -> Option<Value> {
    let parts: Vec<&str> = word.as_str()?.split(' ').collect();
    let turned = [&parts[1..], &parts[..1]].concat();
    (turned != parts).then(|| json!(turned.join(" ")))
}

/// Values of a key that stands once, or in each entry.
fn each_key(original: &Original, key: &str) -> Vec<(String, Value)> {
    let Some((path, all)) = list(original) else { return Vec::new() };
    let entries = all.iter().enumerate().map(|(k, entry)| (format!("{path}/{k}/{key}"), entry[key].clone()));
    let own = (format!("/{key}"), original.document[key].clone());
    entries.chain([own]).filter(|(_, value)| !value.is_null()).collect()
}

fn words(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for (path, word) in each_key(original, "word") {
        // Both words of two impacts are one motion where it is solved for.
        let others = rotated(&word).filter(|_| !original.is(&["two-impact"]));
        let doubled = json!(format!("{0} {0}", word.as_str().unwrap()));
        for other in others.into_iter().chain([doubled, json!("P3"), json!("P4"), json!("P2 P4 P1 P3")]) {
            if other != word {
                all.push(original.with(format!("{path} {other}"), &[(&path, other)]));
            }
        }
    }
    all
}

fn cycles(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for (path, value) in each_key(original, "cycles") {
        let own = value.as_u64().unwrap();
        for other in [own + 1, own.saturating_sub(1), 2 * own] {
            if other != own {
                all.push(original.with(format!("{path} {other}"), &[(&path, json!(other))]));
            }
        }
    }
    all
}

fn stability(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for (path, orbit) in orbits(original) {
        // An orbit with an eigenvalue 1 or -1 is neither.
        for other in ["stable", "unstable"].into_iter().filter(|other| orbit["stability"] != **other) {
            all.push(original.with(format!("{path} {other}"), &[(&format!("{path}/stability"), json!(other))]));
        }
    }
    all
}

fn symmetric(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for (path, orbit) in orbits(original) {
        let Some(is_symmetric) = orbit["symmetric"].as_bool() else { continue };
        let (flag, state) = (format!("{path}/symmetric"), format!("{path}/physical"));
        let other = json!(!is_symmetric);
        for physical in [Value::Null, json!(false)].into_iter().filter(|physical| *physical != orbit["physical"]) {
            let what = format!("{path}, physical then {physical}");
            let changes =
                [(flag.as_str(), other.clone()), (state.as_str(), physical.clone()), ("/certified", json!(false))];
            // Left open it is no claim, and so is that not all is proved.
            let mut of = with(&original.document, &[("/certified", json!(false))]);
            if physical.is_null() {
                of = with(&of, &[(&state, Value::Null)]);
            }
            all.push(Forged { of, ..original.with(what, &changes) });
        }
        all.push(original.with(format!("{path}, physical {}", orbit["physical"]), &[(&flag, other.clone())]));
    }
    all
}

fn physical(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for (path, orbit) in orbits(original) {
        let Some(is_physical) = orbit["physical"].as_bool() else { continue };
        all.push(original.with(path.clone(), &[(&format!("{path}/physical"), json!(!is_physical))]));
    }
    all
}

/// An amplitude or a gap in an orbit, in any document that has orbits: only those that are solved for one of the two have it.
fn of_their_own(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    walk(&original.document, &mut String::new(), &mut |path, value| {
        for key in ["amplitude", "gap"] {
            if !value["stability"].is_null() && value[key].is_null() {
                let path = format!("{path}/{key}");
                all.push(original.with(path.clone(), &[(&path, json!(["0.123", "0.124"]))]));
            }
        }
    });
    all
}

fn points(original: &Original) -> &[Value] {
    list(original).filter(|(path, _)| *path == "/points").map_or(&[], |(_, all)| all)
}

fn kinds(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for (k, point) in points(original).iter().enumerate() {
        for kind in ["fold", "pitchfork", "period-doubling"].into_iter().filter(|kind| point["kind"] != **kind) {
            let path = format!("/points/{k}/kind");
            all.push(original.with(format!("{path} {kind}"), &[(&path, json!(kind))]));
            // Doublings are counted before their kind is examined.
            let doublings = point["doublings"].as_u64().unwrap();
            let fits = if kind == "period-doubling" { doublings + 1 } else { doublings.saturating_sub(1) };
            let mended = [(path.as_str(), json!(kind)), (&format!("/points/{k}/doublings"), json!(fits))];
            all.push(original.with(format!("{path} {kind}, {fits} doublings"), &mended));
        }
    }
    all
}

fn parameters(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for (k, point) in points(original).iter().enumerate() {
        let path = format!("/points/{k}/parameter");
        let [lower, upper] = bounds(&point["parameter"]).unwrap();
        let widths = (&upper - &lower) * fraction(10, 1);
        for by in [fraction(1, 1000), fraction(-1, 1000), widths.clone(), -widths] {
            let moved = pair(&(&lower + &by), &(&upper + &by));
            all.push(original.with(format!("{path} moved"), &[(&path, moved)]));
        }
    }
    all
}

/// A point of one harmonic's amplitude under two, of which the second one's varies from 0 on.
fn vanishing(original: &Original) -> Vec<Forged> {
    let document = &original.document;
    let is_of_one = document["over"]["key"] == "excitation.amplitude";
    let mut all = Vec::new();
    for (k, point) in points(original).iter().enumerate().filter(|_| is_of_one) {
        let [lower, upper] = bounds(&point["parameter"]).unwrap();
        let middle = (lower + upper) / fraction(2, 1);
        let places = BigRational::from_integer(1000.into());
        // So that a middle of the bounds is the amplitude that is missing.
        let own = ((&middle - fraction(1, 20)) * &places).ceil() / &places;
        let most = (&middle - &own) * fraction(2, 1);
        for frequency in ["sqrt(2)", "2", "3"] {
            let doubled = |key: &str, second: Value| json!([document["scene"]["excitation"][key][0], second]);
            let first = document["scene"]["excitation"]["frequency"][0].as_str().unwrap();
            let mut copy = document.clone();
            copy["scene"]["excitation"]["amplitude"] = json!([decimal(&own), "0.05"]);
            copy["scene"]["excitation"]["frequency"] = doubled("frequency", json!(format!("{frequency} * ({first})")));
            copy["scene"]["excitation"]["phase"] =
                doubled("phase", document["scene"]["excitation"]["phase"][0].clone());
            copy["over"] = json!({ "key": "excitation.amplitude.2", "low": "0", "high": "1" });
            let mut only = point.clone();
            only["parameter"] = pair(&fraction(0, 1), &most);
            copy["points"] = json!([only]);
            copy["branches"] = json!([]);
            all.push(original.forged(format!("point {k}, {frequency} times the frequency"), copy));
        }
    }
    all
}

fn counts(original: &Original) -> Vec<Forged> {
    if !original.is(&["cycles"]) {
        return Vec::new();
    }
    let document = &original.document;
    let mut all = Vec::new();
    for (impacts, count) in document["fixed_points"].as_object().unwrap() {
        let path = format!("/fixed_points/{impacts}");
        all.push(original.with(path.clone(), &[(&path, json!(count.as_u64().unwrap() + 1))]));
    }
    for k in 0..document["orbits"].as_array().unwrap().len() {
        let path = format!("/orbits/{k}/reduced_impacts");
        let own = document.pointer(&path).unwrap().as_u64().unwrap();
        all.push(original.with(path.clone(), &[(&path, json!(own + 1))]));
    }
    let other = json!([1, document["impacts"][1].as_u64().unwrap() + 1]);
    // All of one impact more are not among them.
    all.push(original.with("/impacts", &[("/impacts", other)]).at(&["impacts", "exhaustive", "certified"]));
    all.push(original.with("/no_attractor", &[("/no_attractor", json!(document["no_attractor"] == false))]));
    all
}
