//! Windows of stable orbits: ends elsewhere, of another kind, exchanged, values outside, flights and stability of others.

use impact_pair::exact::Exact;
use impact_pair::json::SceneDocument;
use impact_pair::periodic::{Precision, Problem};
use impact_pair::units::Units;
use num_rational::BigRational;
use serde_json::{Value, json};

use super::forged::{Forged, Forgery, Original, bounds, decimal, fraction, pair, with};

pub const FORGERIES: &[Forgery] = &[
    Forgery { name: "windows: ends", why: "the window ends elsewhere", forge: ends },
    Forgery {
        name: "windows: between",
        why: "the orbits between these values are not all stable, or not on one curve through the orbit",
        forge: between,
    },
    Forgery { name: "windows: kinds", why: "another eigenvalue passes at this end", forge: kinds },
    Forgery { name: "windows: an end twice", why: "it ends at two values", forge: twice },
    Forgery {
        name: "windows: one twice",
        why: "the window is listed already, with another of its values",
        forge: again,
    },
    Forgery { name: "windows: value", why: "at this value the orbit is another one", forge: values },
    Forgery { name: "windows: range", why: "the value is outside the range", forge: ranges },
    Forgery { name: "windows: flights", why: "the impacts of the orbit are on other walls", forge: flights },
    Forgery { name: "windows: orbit", why: "the orbit is stable, and takes this time and no other", forge: orbits },
];

/// The windows with their paths.
fn windows(original: &Original) -> Vec<(String, &Value)> {
    let all = original.document["windows"].as_array().filter(|_| original.is(&["windows"]));
    all.into_iter().flatten().enumerate().map(|(i, window)| (format!("/windows/{i}"), window)).collect()
}

/// An end of a window, moved by parts of its width.
fn moved(window: &Value, end: &str, parts: i64) -> Option<Value> {
    let [from, to] = ["from", "to"].map(|key| bounds(&window[key]));
    let (from, to) = (from?, to?);
    let by = (&to[0] - &from[1]) * fraction(parts, 1000);
    let own = if end == "from" { &from } else { &to };
    let [low, high]: [BigRational; 2] = [&own[0] + &by, &own[1] + &by];
    Some(pair(&low, &high))
}

fn ends(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for (path, window) in windows(original) {
        for (end, parts) in [("from", 1), ("from", -1), ("to", 1), ("to", -1), ("from", 200), ("to", -200)] {
            if let Some(bounds) = moved(window, end, parts) {
                all.push(
                    original.with(format!("{end} by {parts}/1000 of the width"), &[(&format!("{path}/{end}"), bounds)]),
                );
            }
        }
    }
    all
}

/// Ends beyond the true ones, the orbit at a value between them, inside or beyond.
fn between(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for (path, window) in windows(original) {
        let [Some(from), Some(to)] = ["from", "to"].map(|key| bounds(&window[key])) else { continue };
        let width = &to[0] - &from[1];
        for (end, parts) in [("from", -200), ("to", 200)] {
            let Some(bounds) = moved(window, end, parts) else { continue };
            let there = if end == "from" { &from[0] } else { &to[1] };
            let at = there + &width * fraction(parts, 2000);
            let at = json!(format!("{}/{}", at.numer(), at.denom()));
            let (end_path, at_path) = (format!("{path}/{end}"), format!("{path}/at"));
            all.push(original.with(format!("{end} beyond"), &[(&end_path, bounds.clone())]));
            all.push(original.with(format!("{end} and the value beyond"), &[(&end_path, bounds), (&at_path, at)]));
        }
        let exchanged =
            [(&format!("{path}/from"), window["to"].clone()), (&format!("{path}/to"), window["from"].clone())];
        all.push(
            original
                .with("the ends exchanged", &exchanged.each_ref().map(|(path, value)| (path.as_str(), value.clone()))),
        );
    }
    all
}

fn kinds(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for (path, window) in windows(original) {
        for (i, kind) in window["ends"].as_array().into_iter().flatten().enumerate() {
            for other in ["fold", "pitchfork", "period-doubling", "graze"].iter().filter(|other| *kind != **other) {
                all.push(original.with(format!("{kind} is {other}"), &[(&format!("{path}/ends/{i}"), json!(other))]));
            }
        }
        let ends = window["ends"].as_array().map(|ends| ends.iter().rev().cloned().collect::<Vec<_>>());
        all.extend(ends.map(|ends| original.with("exchanged", &[(&format!("{path}/ends"), json!(ends))])));
    }
    all
}

fn twice(original: &Original) -> Vec<Forged> {
    let both = |(path, window): (String, &Value)| {
        let [from, to] = ["from", "to"].map(|key| window[key].clone());
        [
            original.with("the upper end at the lower one", &[(&format!("{path}/to"), from)]),
            original.with("the lower end at the upper one", &[(&format!("{path}/from"), to)]),
        ]
    };
    windows(original).into_iter().flat_map(both).collect()
}

/// Each window once more, with its orbit halfway to its upper end.
fn again(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for (_, window) in windows(original) {
        let Some(to) = bounds(&window["to"]) else { continue };
        let own: Exact = window["at"].as_str().unwrap().parse().unwrap();
        let at = (own.as_rational().unwrap() + &to[0]) * fraction(1, 2);
        let Some(orbit) = stable_orbit(original, window, &Exact::from_rational(at.clone())) else { continue };
        let mut document = original.document.clone();
        let copy = with(window, &[("/at", json!(format!("{}/{}", at.numer(), at.denom()))), ("/orbit", orbit)]);
        document["windows"].as_array_mut().unwrap().push(copy);
        all.push(original.forged("once more", document));
    }
    all
}

/// The stable orbit of a window at another value of its parameter, found anew.
fn stable_orbit(original: &Original, window: &Value, at: &Exact) -> Option<Value> {
    let scene: SceneDocument = serde_json::from_value(original.document["scene"].clone()).ok()?;
    let (pair, start) = scene.model().ok()?;
    let key = window["key"].as_str()?.trim_start_matches("excitation.").trim_start_matches("pair.").parse().ok()?;
    let pair = pair.with(key, at.clone()).ok()?;
    let cycles = u32::try_from(window["cycles"].as_u64()?).ok()?;
    let problem = Problem::new(&pair, &window["word"].as_str()?.parse().ok()?, cycles).ok()?;
    let census = problem.find(&start, Precision::default());
    let found = json!(Units::gaps(&pair).ok()?.document(&problem, &start, &census));
    found["orbits"].as_array()?.iter().find(|orbit| orbit["stability"] == "stable").cloned()
}

fn ranges(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for (_, window) in windows(original) {
        let [Some(from), Some(to)] = ["from", "to"].map(|key| bounds(&window[key])) else { continue };
        for (end, value) in [("low", &to[1]), ("high", &from[0])] {
            let path = format!("/over/{end}");
            all.push(original.with(format!("the {end} end beyond the window"), &[(&path, json!(decimal(value)))]));
        }
    }
    all
}

fn values(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for (path, window) in windows(original) {
        let [Some(from), Some(to)] = ["from", "to"].map(|key| bounds(&window[key])) else { continue };
        let at: Exact = window["at"].as_str().unwrap().parse().unwrap();
        let at = at.as_rational().unwrap();
        let width = &to[0] - &from[1];
        for parts in [1, -1, 2000, -2000] {
            let other = at + &width * fraction(parts, 1000);
            let text = format!("{}/{}", other.numer(), other.denom());
            all.push(original.with(format!("by {parts}/1000 of the width"), &[(&format!("{path}/at"), json!(text))]));
        }
    }
    all
}

fn flights(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for (path, window) in windows(original) {
        let own = window["flights"].as_str().unwrap();
        let others = [own.replace('F', "N"), own.to_owned() + "F", own.to_owned() + own, String::new()];
        for other in others.iter().filter(|other| *other != own) {
            all.push(original.with(format!("{own} is {other}"), &[(&format!("{path}/flights"), json!(other))]));
        }
        let impacts = window["reduced_impacts"].as_u64().unwrap() + 1;
        all.push(original.with("one more impact", &[(&format!("{path}/reduced_impacts"), json!(impacts))]));
    }
    all
}

fn orbits(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for (path, window) in windows(original) {
        all.push(original.with("unstable", &[(&format!("{path}/orbit/stability"), json!("unstable"))]));
        let cycles = window["cycles"].as_u64().unwrap();
        all.push(original.with("two cycles more", &[(&format!("{path}/cycles"), json!(cycles + 2))]));
        let trace = decimal(&fraction(1, 3));
        all.push(original.with("another trace", &[(&format!("{path}/orbit/trace"), json!([trace, trace]))]));
        all.push(original.with("another key", &[(&format!("{path}/key"), json!("pair.restitution"))]));
    }
    all
}
