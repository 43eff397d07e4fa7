//! Verdicts over a parameter: subintervals widened, gaps and overlaps, another verdict, another word, and other shares.

use serde_json::{Value, json};

use super::forged::{Forged, Forgery, Original};

pub const FORGERIES: &[Forgery] = &[
    Forgery {
        name: "cells: widened",
        why: "far from it the motion is another one, and has no such horseshoe",
        forge: widened,
    },
    Forgery { name: "cells: overlap or gap", why: "each value is in one subinterval", forge: misplaced },
    Forgery {
        name: "cells: another verdict",
        why: "nothing of the kind is there, or it is not what is given of it",
        forge: other_verdict,
    },
    Forgery {
        name: "cells: another word",
        why: "the limit has one word and one number of forcing periods",
        forge: other_word,
    },
    Forgery { name: "cells: more entropy", why: "the map has no such entropy", forge: more_entropy },
    Forgery { name: "cells: shares", why: "the shares are those of the list", forge: other_shares },
];

/// The subintervals.
fn stretches(original: &Original) -> Vec<Value> {
    let list = original.document["stretches"].as_array().filter(|_| original.kind == "cells");
    list.cloned().unwrap_or_default()
}

/// The shares of one verdict alone.
fn all_of(verdict: &str) -> Value {
    let mut shares = json!({ "horseshoe": 0.0, "attracted": 0.0, "stable": 0.0, "both": 0.0, "undecided": 0.0 });
    shares[verdict] = json!(1.0);
    shares
}

/// One subinterval is all of a range that is longer: down to amplitudes of models I, up to chaos.
fn widened(original: &Original) -> Vec<Forged> {
    let alone = |(k, stretch): (usize, &Value)| {
        let verdict = stretch["verdict"].as_str().filter(|verdict| *verdict != "undecided")?;
        let [low, high] = ["2.2", "9.41"];
        let mut wide = stretch.clone();
        (wide["low"], wide["high"]) = (json!(low), json!(high));
        let changes = [
            ("/certified", json!(true)),
            ("/over/low", json!(low)),
            ("/over/high", json!(high)),
            ("/shares", all_of(verdict)),
            ("/stretches", json!([wide])),
        ];
        Some(original.with(format!("stretches[{k}]"), &changes))
    };
    stretches(original).iter().enumerate().filter_map(alone).collect()
}

fn misplaced(original: &Original) -> Vec<Forged> {
    let own = stretches(original);
    let mut all = Vec::new();
    for (k, stretch) in own.iter().enumerate() {
        for (end, sign) in [("low", "-"), ("low", "+"), ("high", "-"), ("high", "+")] {
            let moved = format!("{}{sign}0.001", stretch[end].as_str().unwrap());
            all.push(original.with(format!("{end} of {k}"), &[(&format!("/stretches/{k}/{end}"), json!(moved))]));
        }
    }
    for k in 1..own.len() {
        let mut fewer = own.clone();
        fewer.remove(k);
        all.push(original.with(format!("without {k}"), &[("/stretches", json!(fewer))]));
    }
    all
}

fn other_verdict(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for (k, stretch) in stretches(original).iter().enumerate() {
        // A stable orbit may attract the scene's own orbit as well, and the reverse.
        let others = ["horseshoe", "attracted", "stable", "undecided", "chaotic"];
        let is_other = |other: &&&str| {
            let both = ["attracted", "stable"];
            **other != stretch["verdict"] && !(both.contains(*other) && stretch["period"].is_object())
        };
        for other in others.iter().filter(is_other) {
            all.push(original.with(format!("{other} of {k}"), &[(&format!("/stretches/{k}/verdict"), json!(other))]));
        }
        if stretch["verdict"] == "horseshoe" {
            // Another one that is right beside it, too.
            let attracted = json!({ "word": "P1 P2", "impacts": 2, "cycles": 1 });
            let changes = [
                (format!("/stretches/{k}/verdict"), json!("attracted")),
                (format!("/stretches/{k}/period"), attracted),
                ("/shares/attracted".to_owned(), json!(1.0)),
                ("/shares/both".to_owned(), json!(1.0)),
            ];
            let changes: Vec<(&str, Value)> =
                changes.iter().map(|(path, value)| (path.as_str(), value.clone())).collect();
            all.push(original.with(format!("a period beside {k}"), &changes));
        }
    }
    all
}

fn other_word(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for (k, stretch) in stretches(original).iter().enumerate().filter(|(_, stretch)| stretch["period"].is_object()) {
        let cycles = stretch["period"]["cycles"].as_u64().unwrap();
        let mut slower = stretch["period"].clone();
        slower["cycles"] = json!(cycles + 1);
        let others = [
            slower,
            json!({ "word": "P1 P2 P4", "impacts": 3, "cycles": 1 }),
            json!({ "word": "P1 P2 P1 P2", "impacts": 4, "cycles": 2 }),
            json!({ "word": "P1 P2 P1 P2", "impacts": 4, "cycles": 1 }),
        ];
        let forged = |other| original.with(format!("of {k}"), &[(&format!("/stretches/{k}/period"), other)]);
        all.extend(others.into_iter().map(forged));
    }
    all
}

/// Claims entropies above ln 2 per impact, which two letters per impact exclude.
fn more_entropy(original: &Original) -> Vec<Forged> {
    let own = stretches(original);
    let with_entropy = own.iter().enumerate().filter(|(_, stretch)| stretch["entropy"].is_object());
    let more = |(k, _): (usize, &Value)| {
        ["per_impact", "per_cycle"].map(|key| {
            original.with(format!("{key} of {k}"), &[(&format!("/stretches/{k}/entropy/{key}"), json!("2.5"))])
        })
    };
    with_entropy.flat_map(more).collect()
}

fn other_shares(original: &Original) -> Vec<Forged> {
    let keys = ["horseshoe", "attracted", "stable", "both", "undecided"];
    let mut all = Vec::new();
    for key in keys.into_iter().filter(|_| original.kind == "cells") {
        let share = original.document["shares"][key].as_f64().unwrap();
        for other in [share + 0.000_002, share - 0.000_002, 1.0 - share, share + 0.000_000_5] {
            if other != share {
                all.push(original.with(key, &[(&format!("/shares/{key}"), json!(other))]));
            }
        }
    }
    all
}
