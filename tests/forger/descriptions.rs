//! Descriptions: fates that are not those of the documents in them.

use serde_json::{Value, json};

use super::forged::{DOCUMENT_ROOT, Forged, Forgery, Original, fraction, pair, rational};

pub const FORGERIES: &[Forgery] = &[
    Forgery {
        name: "description: kind",
        why: "the orbit or the region proves another fate, or no document in it proves this one",
        forge: kinds,
    },
    Forgery { name: "description: fields", why: "the period, the word and the impact are others", forge: fields },
    Forgery {
        name: "description: start",
        why: "the orbit that proves the fate starts near the scene's own start",
        forge: starts,
    },
    Forgery { name: "description: scene", why: "the documents in it are of another scene", forge: scenes },
    Forgery {
        name: "description: region",
        why: "the scene's own orbit comes to a box that is left out",
        forge: regions,
    },
];

/// The kinds of fates, with the fields that they need and their messages.
fn fates() -> Vec<(&'static str, Value)> {
    vec![
        (
            "rests-forever",
            json!({ "kind": "rests-forever", "message": "the ball rests on the left wall for ever", "wall": "left" }),
        ),
        ("never-impacts", json!({ "kind": "never-impacts", "message": "no wall is ever touched after impact 7" })),
        (
            "periodic",
            json!({ "kind": "periodic", "message": "repeats exactly for ever, 3 listed impacts in 1 forcing period", "period": { "impacts": 3, "cycles": 1 } }),
        ),
        (
            "stays-in-region",
            json!({ "kind": "stays-in-region", "from": 0,
                    "message": "stays in a trapping region from the start on, without sticking and complete chatter" }),
        ),
    ]
}

/// Each other fate in the place of the true one. Where no document proves it the description is not confirmed either: it is for its fate,
/// which is not only to be named as not checked.
fn kinds(original: &Original) -> Vec<Forged> {
    if original.kind != "description" {
        return Vec::new();
    }
    let other = |(name, mut fate): (&str, Value)| {
        fate["impacts"] = json!(7);
        original.with(name, &[("/fate", fate)]).at(&[DOCUMENT_ROOT])
    };
    fates().into_iter().map(other).collect()
}

fn fields(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    let fate = &original.document["fate"];
    if original.kind != "description" || fate["kind"] == "periodic" {
        return all;
    }
    let (from, message) = (fate["from"].as_u64().unwrap(), fate["message"].as_str().unwrap());
    let earlier = message.replace(&format!("from impact {from} on"), "from the start on");
    all.push(original.with("from the start on", &[("/fate/from", json!(0)), ("/fate/message", json!(earlier))]));
    if fate["kind"] == "attracted" {
        let (word, other) = (fate["word"].as_str().unwrap(), "P2 P1");
        let message = message.replace(word, other);
        all.push(original.with("another word", &[("/fate/word", json!(other)), ("/fate/message", json!(message))]));
        all.push(original.with("a wider orbit", &[("/fate/orbit/trace", json!(["-1", "1"]))]));
    }
    all
}

/// Replaces the start by one near it: the limit of an orbit that starts near need not be that of the scene's own.
fn starts(original: &Original) -> Vec<Forged> {
    if original.kind != "description" || original.document["proof"].is_null() {
        return Vec::new();
    }
    let start = &original.document["scene"]["start"];
    let velocity = rational(&start["velocity"]).unwrap();
    let [lower, upper] = [-1, 1].map(|sign| &velocity + fraction(sign, 1 << 33));
    let near = json!({ "time": [start["time"], start["time"]], "velocity": pair(&lower, &upper) });
    let changes =
        [("/proof/claim", json!("shadowed")), ("/proof/outcome/start", near), ("/proof/outcome/message", json!(""))];
    vec![original.with("near", &changes).at(&["fate"])]
}

fn scenes(original: &Original) -> Vec<Forged> {
    if original.kind != "description" {
        return Vec::new();
    }
    let all = [("/scene/gap", "9.5"), ("/scene/restitution", "0.51"), ("/scene/start/velocity", "-12")];
    all.map(|(path, value)| original.with(path, &[(path, json!(value))])).into()
}

fn regions(original: &Original) -> Vec<Forged> {
    if original.kind != "description" || original.document["region"].is_null() {
        return Vec::new();
    }
    let region = original.document["region"]["region"].as_array().unwrap();
    let without = |k: usize| region.iter().enumerate().filter(|(i, _)| *i != k).map(|(_, run)| run.clone()).collect();
    let all = (0..region.len()).step_by(7);
    all.map(|k| original.with(format!("without run {k}"), &[("/region/region", Value::Array(without(k)))])).collect()
}
