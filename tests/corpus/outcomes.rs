//! Each outcome in the place of each other, and events that are others.

use num_rational::BigRational;
use serde_json::{Value, json};

use super::documents::document;
use super::motions::{ended, goes_on, motion, next_event, with_events};
use super::numbers::{bounds, decimal, fraction, negated, pair, unit};
use super::original::{Forged, Forgery, Original};

pub const FORGERIES: &[Forgery] = &[
    Forgery {
        name: "outcome: for ever",
        why: "where A > 0 no rest lasts for ever, one that does is on one wall, and a wall is touched after the listed events",
        forge: for_ever,
    },
    Forgery { name: "outcome: periodic", why: "impacts do not come at this rate", forge: periodic },
    Forgery { name: "outcome: attracted", why: "the orbit is none of this scene, or no stable one", forge: attracted },
    Forgery {
        name: "outcome: up to a time",
        why: "an event that is not listed comes before that time, or a listed one after it",
        forge: up_to_a_time,
    },
    Forgery { name: "outcome: impacts-reached", why: "another number of impacts is listed", forge: impacts_reached },
    Forgery { name: "events: one inserted", why: "between two impacts there is no third", forge: inserted },
    Forgery {
        name: "events: walls mirrored",
        why: "from the same start the other wall is too far away at that time",
        forge: mirrored,
    },
    Forgery {
        name: "events: a bound past the truth",
        why: "the bound is moved inward by the first unit of its last place that passes the truth",
        forge: past_the_truth,
    },
];

fn is_orbit(original: &Original) -> bool {
    original.is(&["orbit", "shadow"])
}

/// The document with each of these outcomes.
fn each(original: &Original, outcomes: Vec<(String, Value)>) -> Vec<Forged> {
    let of = |(what, fields): (String, Value)| original.forged(what, ended(&original.document, &fields));
    if is_orbit(original) { outcomes.into_iter().map(of).collect() } else { Vec::new() }
}

fn for_ever(original: &Original) -> Vec<Forged> {
    let is_one = original.outcome() == "rests-forever";
    let walls = ["left", "right"].into_iter().filter(|wall| !is_one || original.document["outcome"]["wall"] != **wall);
    let rests = walls.map(|wall| (wall.to_owned(), json!({ "kind": "rests-forever", "wall": wall })));
    let never =
        (original.outcome() != "never-impacts").then(|| ("never".to_owned(), json!({ "kind": "never-impacts" })));
    each(original, rests.chain(never).collect())
}

/// Of an outcome that it is not known to have the scene may be periodic all the same.
fn periodic(original: &Original) -> Vec<Forged> {
    let own = &original.document["outcome"]["period"];
    let number = |key: &str| own[key].as_u64();
    let (cycles, impacts) = (number("cycles").unwrap_or(1), number("impacts").unwrap_or(0));
    let mut rates = vec![(7, 100), (cycles, impacts + 1)];
    rates.extend((impacts > 0).then_some((cycles + 1, impacts)));
    rates.extend((own.is_null() && goes_on(original)).then_some((1, 0)));
    let of = |(cycles, impacts): (u64, u64)| {
        let fields = json!({ "kind": "periodic", "period": { "cycles": cycles, "impacts": impacts } });
        (format!("{impacts} impacts in {cycles} cycles"), fields)
    };
    let forged = each(original, rates.into_iter().map(of).collect());
    if own.is_null() { forged.into_iter().map(Forged::probably).collect() } else { forged }
}

/// An orbit that another scene's motion converges to, and the unstable one of that scene.
fn attracted(original: &Original) -> Vec<Forged> {
    if original.outcome() == "attracted" {
        return Vec::new();
    }
    let (mut stable, orbits) = (document("attracted")["outcome"].clone(), document("stable and unstable"));
    ["impacts", "message", "until"].iter().for_each(|key| drop(stable.as_object_mut().unwrap().remove(*key)));
    let unstable = orbits["orbits"].as_array().unwrap().iter().find(|orbit| orbit["stability"] == "unstable").unwrap();
    let mut other = stable.clone();
    (other["orbit"], other["orbit"]["stability"]) = (unstable.clone(), json!("stable"));
    other["word"] = orbits["word"].clone();
    each(original, vec![("a stable orbit".into(), stable), ("an unstable orbit".into(), other)])
}

/// Times before which an event comes that is not listed.
fn too_late(original: &Original) -> Vec<(String, BigRational)> {
    if !is_orbit(original) || !goes_on(original) {
        return Vec::new();
    }
    let mut times = vec![("very late".to_owned(), BigRational::from_integer(num_traits::pow(10.into(), 40)))];
    // A ball that hardly moves needs as long as that.
    let last = original.events().last().and_then(|last| bounds(&last["time"])).map(|[_, last]| last);
    if let (Some(last), true) = (last, original.document["scene"]["excitation"]["amplitude"][0] != "0") {
        times.push(("late".to_owned(), last + fraction(1_000_000_000, 1)));
    }
    if let Some([_, time]) = next_event(original).filter(|_| original.kind == "orbit") {
        times.push(("after the next event".to_owned(), time + fraction(1, 1_000_000)));
    }
    times
}

/// All events up to a time, no event up to an undecided one, and all up to each time of an interval.
fn up_to_a_time(original: &Original) -> Vec<Forged> {
    let until = |until: &str| json!({ "kind": "time-reached", "until": until });
    let late = too_late(original);
    let mut all: Vec<_> = late.iter().map(|(what, time)| (what.clone(), until(&decimal(time)))).collect();
    // A rest may be listed whose end comes later than the time.
    let last = original.events().iter().rfind(|event| event["event"] != "rest");
    if let Some([time, _]) = last.and_then(|last| bounds(&last["time"])) {
        all.push(("before the last event".to_owned(), until(&decimal(&(time - fraction(1, 1_000_000))))));
    }
    for (what, from) in &late {
        let time = json!([decimal(from), decimal(&(from + fraction(1, 1)))]);
        all.extend(["graze", "width", "precision", "budget"].map(|reason| {
            let fields = json!({ "kind": "undecided", "reason": reason, "time": time, "wall": "left" });
            (format!("{what}, {reason}"), fields)
        }));
    }
    if let Some(last) = original.document["outcome"]["until"].as_str().filter(|_| goes_on(original)) {
        all.extend(["0", last].map(|from| (format!("from {from} on"), until(&format!("[{from}, 1000000]")))));
    }
    each(original, all)
}

fn impacts_reached(original: &Original) -> Vec<Forged> {
    let listed = original.document["outcome"]["impacts"].as_u64().unwrap_or(0);
    let of = |count: u64| {
        let mut forged = each(original, vec![(format!("{count} impacts"), json!({ "kind": "impacts-reached" }))]);
        for forged in &mut forged {
            let outcome = &mut forged.document["outcome"];
            (outcome["impacts"], outcome["message"]) = (json!(count), json!(""));
        }
        forged
    };
    [Some(listed + 1), listed.checked_sub(1)].into_iter().flatten().flat_map(of).collect()
}

fn is_impact(event: &Value) -> bool {
    event["event"] == "impact"
}

fn inserted(original: &Original) -> Vec<Forged> {
    let events = original.events();
    let mut all = Vec::new();
    for k in 1..events.len() {
        let [Some([_, from]), Some([to, _])] = [k - 1, k].map(|k| bounds(&events[k]["time"])) else { continue };
        if !is_orbit(original) || !is_impact(&events[k - 1]) || !is_impact(&events[k]) {
            continue;
        }
        let middle = (from + to) / fraction(2, 1);
        for (wall, velocity) in [("left", ["-1000", "0"]), ("right", ["0", "1000"])] {
            let mut event = events[k].clone();
            (event["time"], event["wall"], event["velocity"]) = (pair(&middle, &middle), json!(wall), json!(velocity));
            let mut more = events.to_vec();
            more.insert(k, event);
            let what = format!("on the {wall} wall before event {k}");
            all.push(original.forged(what, with_events(&original.document, more)));
        }
    }
    all
}

fn mirrored(original: &Original) -> Vec<Forged> {
    let other = |event: &Value| {
        let mut event = event.clone();
        event["wall"] = json!(if event["wall"] == "left" { "right" } else { "left" });
        if is_impact(&event) {
            event["velocity"] = json!([negated(&event["velocity"][1]), negated(&event["velocity"][0])]);
        }
        event
    };
    let events = original.events();
    if !is_orbit(original) || !events.iter().any(is_impact) {
        return Vec::new();
    }
    let all = events.iter().map(other).collect();
    let one = |k: usize| {
        let mut one = events.to_vec();
        one[k] = other(&events[k]);
        original.forged(format!("of event {k}"), with_events(&original.document, one))
    };
    let each = (0..events.len()).filter(|&k| is_impact(&events[k])).map(one);
    std::iter::once(original.forged("of all events", with_events(&original.document, all))).chain(each).collect()
}

/// Of data that are points, and of the exact start.
fn past_the_truth(original: &Original) -> Vec<Forged> {
    let (events, scene) = (original.events(), &original.document["scene"]);
    let is_exact = original.is(&["orbit"]) && !scene.to_string().contains("\"[");
    let found = is_exact.then(|| motion(scene, events.len() as u64)).flatten().unwrap_or_default();
    let mut all = Vec::new();
    for (k, (event, fine)) in
        events.iter().zip(&found).enumerate().filter(|(_, (event, fine))| is_impact(event) && is_impact(fine))
    {
        for key in ["time", "velocity"] {
            let [Some(own), Some(fine)] = [&event[key], &fine[key]].map(bounds) else { continue };
            let unit = unit(&own[0]).max(unit(&own[1]));
            let [lower, upper] = &own;
            let [above, below] = [
                ((&fine[1] / &unit).floor() + fraction(1, 1)) * &unit,
                ((&fine[0] / &unit).ceil() - fraction(1, 1)) * &unit,
            ];
            let path = format!("/events/{k}/{key}");
            for (what, [lower, upper]) in [
                ("lower", [&above, &above.clone().max(upper.clone())]),
                ("upper", [&below.clone().min(lower.clone()), &below]),
            ] {
                all.push(
                    original.with(format!("the {what} bound of {key} of event {k}"), &[(&path, pair(lower, upper))]),
                );
            }
        }
    }
    all
}
