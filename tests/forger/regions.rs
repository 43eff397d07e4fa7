//! Regions and horseshoes: entropies, words, bases, blocks, and claims about the scene's own orbit.

use std::collections::BTreeSet;
use std::f64::consts::TAU;

use impact_pair::exact::Exact;
use num_rational::BigRational;
use serde_json::{Value, json};

use super::forged::{Forged, Forgery, Original, bounds, fraction, pair, rational};
use super::futures::motion;

pub const FORGERIES: &[Forgery] = &[
    Forgery { name: "chaos: entropy", why: "it does not follow from the words that are listed", forge: entropies },
    Forgery {
        name: "chaos: words",
        why: "a word is listed twice, or with other half cycles, impacts or bases",
        forge: words,
    },
    Forgery { name: "chaos: bases", why: "bases are disjoint, and words lead from one to another", forge: bases },
    Forgery { name: "chaos: depth", why: "longer words were not looked for", forge: depths },
    Forgery {
        name: "chaos: a base wider than a turn",
        why: "it is not disjoint from itself a turn later",
        forge: wide_bases,
    },
    Forgery { name: "chaos: horseshoe", why: "these are not the shortest two blocks", forge: horseshoes },
    Forgery {
        name: "chaos: scene's orbit",
        why: "it converges to no such orbit, and one box is no region",
        forge: scene_orbits,
    },
    Forgery {
        name: "chaos: hyperbolic",
        why: "a periodic orbit has an exponent beyond the bound, other words another entropy, strips lean too much for so wide cones",
        forge: hyperbolic,
    },
    Forgery { name: "trap: entered", why: "an impact outside comes later", forge: entered },
    Forgery {
        name: "trap: bounds",
        why: "there are faster and slower impacts, longer and shorter flights",
        forge: narrowed,
    },
    Forgery {
        name: "trap: words",
        why: "its own orbit makes more words, or the blocks P1 P2 and P1 P2 P4, which come in any order, do",
        forge: wall_words,
    },
    Forgery { name: "trap: a box less", why: "the scene's own orbit comes to that box", forge: boxes },
];

/// A decimal, a unit of its last place higher.
fn raised(text: &Value) -> Value {
    let text = text.as_str().unwrap();
    let places = text.split_once('.').map_or(0, |(_, digits)| digits.len());
    let whole: i128 = text.replace('.', "").parse().unwrap();
    json!(format!("{}e-{places}", whole + 1))
}

fn entropies(original: &Original) -> Vec<Forged> {
    if original.kind != "chaos" {
        return Vec::new();
    }
    let mut all = Vec::new();
    for key in ["per_impact", "per_cycle"] {
        let path = format!("/entropy/{key}");
        let own = original.document.pointer(&path).unwrap();
        all.extend([raised(own), json!("9")].map(|value| original.with(path.clone(), &[(&path, value)])));
    }
    all
}

fn hyperbolic(original: &Original) -> Vec<Forged> {
    if original.kind != "hyperbolic" {
        return Vec::new();
    }
    let changes = [
        ("/hyperbolic/words", json!([0, 1, 2, 3, 5])),
        ("/hyperbolic/exponents/per_impact/1", json!("0.83")),
        ("/hyperbolic/dimension/1", json!("0.6")),
        ("/hyperbolic/kappa", json!("400")),
        ("/hyperbolic/entropy/per_impact/0", json!("0.2812")),
        ("/hyperbolic/exponents/per_cycle/0", json!("1.36")),
        ("/hyperbolic/second_exponent/0", json!("-2.22")),
        ("/hyperbolic/dimension/0", json!("0.615")),
        ("/hyperbolic/words", json!([0, 2, 3])),
    ];
    changes.into_iter().map(|(path, value)| original.with(format!("{path}: {value}"), &[(path, value)])).collect()
}

fn depths(original: &Original) -> Vec<Forged> {
    let own = original.document["depth"].as_u64().filter(|_| original.kind == "chaos");
    own.map(|own| original.with("deeper", &[("/depth", json!(own + 50))])).into_iter().collect()
}

fn words(original: &Original) -> Vec<Forged> {
    if original.kind != "chaos" {
        return Vec::new();
    }
    let own = original.document["words"].as_array().unwrap();
    let (mut all, bases) = (Vec::new(), original.document["bases"].as_array().unwrap().len() as u64);
    for (k, word) in own.iter().enumerate() {
        let mut put = |what: &str, changes: &[(&str, Value)], is_more: bool| {
            let mut other = word.clone();
            for (key, value) in changes {
                other[*key] = value.clone();
            }
            let mut words = own.clone();
            if is_more {
                words.insert(k, other)
            } else {
                words[k] = other
            }
            all.push(original.with(format!("words[{k}]: {what}"), &[("/words", Value::Array(words))]));
        };
        put("twice", &[], true);
        let (cycles, flights) = (word["half_cycles"].as_i64().unwrap(), word["flights"].as_str().unwrap());
        for by in [-2, -1, 1, 2] {
            put("half cycles", &[("half_cycles", json!(cycles + by))], false);
        }
        let longer = format!("{flights}F");
        put("a flight more", &[("flights", json!(longer)), ("impacts", json!(longer.len()))], false);
        let other: String = flights.chars().map(|flight| if flight == 'F' { 'N' } else { 'F' }).collect();
        put("other flights", &[("flights", json!(other))], false);
        let to = word["to"].as_u64().unwrap();
        if bases > 1
            && !own.iter().any(|other| {
                other["flights"] == word["flights"] && other["from"] == word["from"] && other["to"] != word["to"]
            })
        {
            put("to another base", &[("to", json!((to + 1) % bases))], false);
        }
    }
    all.into_iter().map(Forged::probably).collect()
}

/// A base moved by a part of a forcing period and a speed.
fn moved(base: &Value, by: [f64; 2]) -> Value {
    let mut base = base.clone();
    for edge in ["left", "right"] {
        for corner in base["corners"][edge].as_array_mut().unwrap() {
            *corner = json!([0, 1].map(|i| corner[i].as_f64().unwrap() + by[i]));
        }
    }
    let at = |key: &str| base[key].as_str().unwrap().parse::<f64>().unwrap();
    let (phase, speed) = (at("phase") + by[0] * TAU, at("speed") + by[1]);
    (base["phase"], base["speed"]) = (json!(phase.to_string()), json!(speed.to_string()));
    base
}

fn bases(original: &Original) -> Vec<Forged> {
    if original.kind != "chaos" {
        return Vec::new();
    }
    let own = original.document["bases"].as_array().unwrap();
    let mut all = Vec::new();
    let mut more = own.clone();
    more.push(own[0].clone());
    all.push(original.with("one twice", &[("/bases", Value::Array(more))]));
    let words = original.document["words"].as_array().unwrap();
    // One to which no word leads may be elsewhere as well.
    for (k, base) in own.iter().enumerate().filter(|(k, _)| words.iter().any(|word| word["to"] == *k)) {
        let tenth = 0.1 * base["speed"].as_str().unwrap().parse::<f64>().unwrap();
        for by in [[0.0, tenth], [0.0, -tenth], [0.1, 0.0], [0.5, 0.0]] {
            all.push(original.with(format!("base {k} moved"), &[(&format!("/bases/{k}"), moved(base, by))]).probably());
        }
    }
    all
}

fn wide_bases(original: &Original) -> Vec<Forged> {
    if original.kind != "chaos" {
        return Vec::new();
    }
    let own = original.document["bases"].as_array().unwrap();
    let mut all = Vec::new();
    // Far above all others, so that it meets none but itself, a forcing period later.
    let wide = json!({
        "phase": "3.2", "speed": "50", "expanding": ["3.8", "0"], "contracting": ["-0.01", "0.1"],
        "corners": { "left": [[-0.1, 49.9], [-0.102, 50.1]], "right": [[1.102, 49.9], [1.1, 50.1]] },
    });
    let mut more = own.clone();
    more.push(wide);
    all.push(original.with("one wider than a turn more", &[("/bases", Value::Array(more))]));
    for (k, base) in own.iter().enumerate() {
        all.push(original.with(format!("base {k}"), &[(&format!("/bases/{k}"), widened(base))]));
    }
    all
}

/// A base whose right edge is more than a forcing period further along it.
fn widened(base: &Value) -> Value {
    let mut wide = base.clone();
    for i in 0..2 {
        let [left, right] = ["left", "right"].map(|edge| [0, 1].map(|j| base["corners"][edge][i][j].as_f64().unwrap()));
        let slope = (right[1] - left[1]) / (right[0] - left[0]);
        wide["corners"]["right"][i] = json!([right[0] + 1.1, right[1] + 1.1 * slope]);
    }
    wide
}

fn horseshoes(original: &Original) -> Vec<Forged> {
    if original.kind != "chaos" {
        return Vec::new();
    }
    let own = original.document["horseshoe"].as_str().unwrap();
    let mut others = vec![json!(null), json!("each block is P1 P2 or P1 P2 P1 P2 P1 P2, in any order")];
    others.push(json!(own.replacen("P2", "P2 P3 P4", 1)));
    // Blocks are named by their half cycles as well.
    for (at, _) in own.match_indices('(') {
        let (before, after) = own.split_at(at + 1);
        let digits = after.find(|c: char| !c.is_ascii_digit()).unwrap_or(0);
        let Ok(count) = after[..digits].parse::<u64>() else { continue };
        others.push(json!(format!("{before}{}{}", count + 1, &after[digits..])));
    }
    others.into_iter().map(|other| original.with("another", &[("/horseshoe", other)])).collect()
}

fn scene_orbits(original: &Original) -> Vec<Forged> {
    if original.kind != "chaos" {
        return Vec::new();
    }
    let attracted = json!({ "word": "P1 P2", "impacts": 2, "cycles": 1 });
    let region = json!({ "boxes": 1, "entered_at_impact": 0, "holds_bases": true });
    [(attracted, Value::Null), (Value::Null, region)]
        .map(|(attracted, region)| json!({ "attracted": attracted, "region": region }))
        .map(|orbit| original.with("another", &[("/scene_orbit", orbit)]))
        .into()
}

fn entered(original: &Original) -> Vec<Forged> {
    let entered = original.document["entered_at_impact"].as_u64().filter(|_| original.kind == "trap").unwrap_or(0);
    let at = |impact: u64| original.with(format!("{impact}"), &[("/entered_at_impact", json!(impact))]);
    (0..entered).rev().map(at).collect()
}

fn narrowed(original: &Original) -> Vec<Forged> {
    if original.kind != "trap" {
        return Vec::new();
    }
    let mut all = Vec::new();
    for key in ["speed", "speed_before", "flight", "flight_time"] {
        let path = format!("/{key}");
        let [lower, upper] = bounds(&original.document[key]).unwrap();
        let middle = (&lower + &upper) / fraction(2, 1);
        for [lower, upper] in [[&lower, &middle], [&middle, &upper]] {
            all.push(original.with(path.clone(), &[(&path, pair(lower, upper))]));
        }
    }
    let longest = rational(&original.document["longest_flight"]).unwrap() / fraction(2, 1);
    all.push(original.with("/longest_flight", &[("/longest_flight", json!(super::forged::decimal(&longest)))]));
    all
}

/// The entropy of the words of the blocks FF and FFN in any order, of which no two make one word: `ln x` with `x^3 = x + 1`.
const OF_BLOCKS: &str = "0.28119";

fn wall_words(original: &Original) -> Vec<Forged> {
    let document = &original.document;
    let Some(impacts) = document["words"]["impacts"].as_u64().filter(|_| original.kind == "trap") else {
        return Vec::new();
    };
    let seen = words_seen(document, impacts as usize).expect("an orbit that is in the region");
    let mut all = Vec::new();
    for fewer in [0, seen - 1] {
        all.push(original.with(format!("{fewer} words"), &[("/words/count", json!(fewer.to_string()))]));
    }
    all.push(original.with("less entropy than none", &[("/words/entropy_at_most", json!("-0.0001"))]));
    if original.name == "figure-14" {
        all.push(original.with("less entropy", &[("/words/entropy_at_most", json!(OF_BLOCKS))]));
        all.push(original.with("longer words", &[("/words/impacts", json!(400))]));
    }
    all
}

/// Number of different words of `impacts` flights that the scene's own orbit makes in its first impacts in the region.
fn words_seen(document: &Value, impacts: usize) -> Option<usize> {
    let entered = document["entered_at_impact"].as_u64()?;
    let events = motion(&document["scene"], entered + 120)?;
    let in_region = events.iter().skip(entered.saturating_sub(1) as usize).filter(|event| event["event"] == "impact");
    let walls: Vec<_> = in_region.map(|event| &event["wall"]).collect();
    let is_far: Vec<bool> = walls.windows(2).map(|pair| pair[0] != pair[1]).collect();
    Some(is_far.windows(impacts).collect::<BTreeSet<_>>().len())
}

/// The boxes that the scene's own orbit is in, from the impact on at which it enters.
fn reached(document: &Value) -> Option<Vec<[i64; 2]>> {
    let scene = &document["scene"];
    let datum = |value: &Value| Exact::parse(value.as_str().unwrap()).unwrap().enclose(64).mid_rad().0;
    let [amplitude, frequency, phase] =
        ["amplitude", "frequency", "phase"].map(|key| datum(&scene["excitation"][key][0]));
    let entered = document["entered_at_impact"].as_u64()?;
    let [columns, rows] = ["columns", "rows"].map(|key| document[key].as_f64().unwrap());
    let float = |x: &BigRational| Exact::from_rational(x.clone()).enclose(64).mid_rad().0;
    let box_of = |event: &Value| {
        let [time, speed] = ["time", "velocity"].map(|key| float(&bounds(&event[key]).unwrap()[0]));
        let phase = (frequency * time + phase) / TAU + if event["wall"] == "right" { 0.5 } else { 0.0 };
        let at = [columns * phase.rem_euclid(1.0), rows * speed.abs() / (amplitude * frequency)];
        // Not where the last digits decide.
        at.iter().all(|x| (x - x.round()).abs() > 1e-6).then(|| at.map(|x| x.floor() as i64))
    };
    let events = motion(scene, entered + 12)?;
    Some(events.iter().skip(entered.saturating_sub(1) as usize).filter_map(box_of).collect())
}

fn boxes(original: &Original) -> Vec<Forged> {
    let document = &original.document;
    let Some(reached) = Some(document).filter(|_| original.kind == "trap").and_then(reached) else { return Vec::new() };
    let without = |[column, row]: &[i64; 2]| {
        let split = |run: &Value| {
            let [at, first, last] = [0, 1, 2].map(|i| run[i].as_i64().unwrap());
            let is_it = at == *column && (first..=last).contains(row);
            let parts = if is_it { vec![[first, row - 1], [row + 1, last]] } else { vec![[first, last]] };
            parts.into_iter().filter(|[first, last]| first <= last).map(move |[first, last]| json!([at, first, last]))
        };
        let runs: Vec<Value> = document["region"].as_array().unwrap().iter().flat_map(split).collect();
        let count = document["boxes"].as_u64().unwrap() - 1;
        original.with(format!("without {column}, {row}"), &[("/boxes", json!(count)), ("/region", Value::Array(runs))])
    };
    reached.iter().map(without).collect()
}
