//! Each outcome in the place of each other.

use num_rational::BigRational;
use serde_json::{Value, json};

use super::forged::{Forged, Forgery, Original, bounds, decimal, fraction};
use super::futures::{ended, goes_on, next_event};
use crate::corrupted::documents;

pub const FORGERIES: &[Forgery] = &[
    Forgery {
        name: "outcome: rests-forever",
        why: "where A > 0 no rest lasts for ever, and one that does is on one wall",
        forge: rests,
    },
    Forgery { name: "outcome: never-impacts", why: "a wall is touched after the listed events", forge: never },
    Forgery { name: "outcome: periodic", why: "impacts do not come at this rate", forge: periodic },
    Forgery { name: "outcome: attracted", why: "the orbit is none of this scene, or no stable one", forge: attracted },
    Forgery {
        name: "outcome: time-reached",
        why: "an event that is not listed comes before that time, or a listed one after it",
        forge: time_reached,
    },
    Forgery {
        name: "outcome: undecided",
        why: "an event that is not listed comes before the time up to which there is none",
        forge: undecided,
    },
    Forgery {
        name: "outcome: until an interval of times",
        why: "one of these times comes after an event that is not listed",
        forge: until_any,
    },
    Forgery { name: "outcome: impacts-reached", why: "another number of impacts is listed", forge: impacts_reached },
];

fn is_orbit(original: &Original) -> bool {
    original.is(&["orbit", "shadow"])
}

/// The document with each of these outcomes.
fn each(original: &Original, outcomes: Vec<(String, Value)>) -> Vec<Forged> {
    if !is_orbit(original) {
        return Vec::new();
    }
    outcomes.into_iter().map(|(what, fields)| original.forged(what, ended(&original.document, &fields))).collect()
}

fn rests(original: &Original) -> Vec<Forged> {
    let is_one = original.outcome() == "rests-forever";
    let walls = ["left", "right"].into_iter().filter(|wall| !is_one || original.document["outcome"]["wall"] != **wall);
    each(original, walls.map(|wall| (wall.to_owned(), json!({ "kind": "rests-forever", "wall": wall }))).collect())
}

fn never(original: &Original) -> Vec<Forged> {
    let is_false = original.outcome() != "never-impacts";
    each(original, is_false.then(|| ("never".to_owned(), json!({ "kind": "never-impacts" }))).into_iter().collect())
}

fn periodic(original: &Original) -> Vec<Forged> {
    let own = &original.document["outcome"]["period"];
    let number = |key: &str| own[key].as_u64();
    let (cycles, impacts) = (number("cycles").unwrap_or(1), number("impacts").unwrap_or(0));
    let mut rates = vec![(7, 100), (cycles, impacts + 1)];
    if impacts > 0 {
        rates.push((cycles + 1, impacts));
    }
    if own.is_null() && goes_on(original) {
        rates.push((1, 0));
    }
    // An outcome that it is not known to have, in a scene that may be periodic all the same.
    let forged = each(
        original,
        rates
            .into_iter()
            .map(|(cycles, impacts)| {
                let fields = json!({ "kind": "periodic", "period": { "cycles": cycles, "impacts": impacts } });
                (format!("{impacts} impacts in {cycles} cycles"), fields)
            })
            .collect(),
    );
    if own.is_null() { forged.into_iter().map(Forged::probably).collect() } else { forged }
}

/// An orbit that a motion converges to, and the unstable one of the same scene.
fn attractors() -> [Value; 2] {
    let all = documents::all();
    let document =
        |sought: &str| all.iter().find(|(name, _)| name == sought).map(|(_, document)| document.clone()).unwrap();
    let (attracted, orbits) = (document("attracted"), document("stable and unstable"));
    let mut outcome = attracted["outcome"].clone();
    let outcome = outcome.as_object_mut().unwrap();
    for key in ["impacts", "message", "until"] {
        outcome.remove(key);
    }
    let unstable = orbits["orbits"].as_array().unwrap().iter().find(|orbit| orbit["stability"] == "unstable").unwrap();
    let mut other = outcome.clone();
    (other["orbit"], other["orbit"]["stability"]) = (unstable.clone(), json!("stable"));
    other["word"] = orbits["word"].clone();
    [json!(outcome), json!(other)]
}

fn attracted(original: &Original) -> Vec<Forged> {
    if !is_orbit(original) {
        return Vec::new();
    }
    if original.outcome() != "attracted" {
        static ORBITS: std::sync::OnceLock<[Value; 2]> = std::sync::OnceLock::new();
        let [stable, unstable] = ORBITS.get_or_init(attractors);
        // Scenes whose motion converges to the stable one, but whose outcome does not say so, are not among the documents.
        return each(
            original,
            vec![("a stable orbit".into(), stable.clone()), ("an unstable orbit".into(), unstable.clone())],
        );
    }
    let mut all = Vec::new();
    let own = &original.document["outcome"];
    let changed = |what: &str, key: &str, value: Value| {
        let mut fields = own.clone();
        fields[key] = value;
        (what.to_owned(), fields)
    };
    all.push(changed("in a cycle more", "cycles", json!(own["cycles"].as_u64().unwrap() + 1)));
    let word: Vec<&str> = own["word"].as_str().unwrap().split(' ').collect();
    let turned = [&word[1..], &word[..1]].concat().join(" ");
    all.push(changed("the word rotated", "word", json!(turned)));
    let mut orbit = own["orbit"].clone();
    orbit["stability"] = json!("unstable");
    all.push(changed("unstable", "orbit", orbit));
    let mut orbit = own["orbit"].clone();
    orbit["symmetric"] = json!(orbit["symmetric"] == false);
    all.push(changed("symmetric or not", "orbit", orbit));
    let mut orbit = own["orbit"].clone();
    orbit["impacts"].as_array_mut().unwrap().pop();
    all.push(changed("without the last impact", "orbit", orbit));
    each(original, all)
}

/// Times before which an event comes that is not listed.
fn too_late(original: &Original) -> Vec<(String, BigRational)> {
    if !is_orbit(original) || !goes_on(original) {
        return Vec::new();
    }
    let mut times = vec![("very late".to_owned(), BigRational::from_integer(num_traits::pow(10.into(), 40)))];
    // A ball that hardly moves needs as long as that.
    if original.document["scene"]["excitation"]["amplitude"][0] != "0" {
        times.push(("late".to_owned(), fraction(1_000_000_000, 1)));
    }
    if let Some([_, time]) = next_event(original).filter(|_| original.kind == "orbit") {
        times.push(("after the next event".to_owned(), time + fraction(1, 1_000_000)));
    }
    times
}

fn time_reached(original: &Original) -> Vec<Forged> {
    let mut all = too_late(original);
    // A rest may be listed whose end comes later than the time.
    let last = original.events().iter().rfind(|event| event["event"] != "rest");
    if let Some([time, _]) = last.and_then(|last| bounds(&last["time"])) {
        all.push(("before the last event".to_owned(), time - fraction(1, 1_000_000)));
    }
    let outcome = |until: &BigRational| json!({ "kind": "time-reached", "until": decimal(until) });
    each(original, all.iter().map(|(what, until)| (what.clone(), outcome(until))).collect())
}

fn undecided(original: &Original) -> Vec<Forged> {
    let mut all = Vec::new();
    for (what, from) in too_late(original) {
        for reason in ["graze", "width", "precision", "budget"] {
            let time = json!([decimal(&from), decimal(&(&from + fraction(1, 1)))]);
            all.push((
                format!("{what}, {reason}"),
                json!({ "kind": "undecided", "reason": reason, "time": time, "wall": "left" }),
            ));
        }
    }
    each(original, all)
}

/// Up to a time of an interval that begins where all is listed and ends long after it.
fn until_any(original: &Original) -> Vec<Forged> {
    let last = original.document["outcome"]["until"].as_str().filter(|_| is_orbit(original) && goes_on(original));
    let whole = |from: &str| original.with(from, &[("/outcome/until", json!(format!("[{from}, 1000000]")))]);
    last.map_or(Vec::new(), |last| ["0", last].map(whole).into())
}

fn impacts_reached(original: &Original) -> Vec<Forged> {
    let listed = original.document["outcome"]["impacts"].as_u64().unwrap_or(0);
    each(original, vec![("any".to_owned(), json!({ "kind": "impacts-reached" }))])
        .into_iter()
        .flat_map(|forged| {
            [listed + 1, listed.wrapping_sub(1)].into_iter().filter(|count| *count < 1 << 60).map(move |count| Forged {
                what: format!("{count} impacts"),
                document: super::forged::with(
                    &forged.document,
                    &[("/outcome/impacts", json!(count)), ("/outcome/message", json!(""))],
                ),
                of: forged.of.clone(),
                is_certain: true,
                false_claims: None,
            })
        })
        .collect()
}
