//! Recorded documents with one claim altered: verdicts of `check` that were wrong once.

use impact_pair_certificate::Claims;
use impact_pair_document::VerdictName;
use impact_pair_model::watch::Unwatched;
use serde_json::{Value, json};

use crate::claimed::{checked, text};
use crate::recorded::all;

/// The one line of a recorded document.
fn recorded(name: &str) -> Value {
    all().into_iter().find(|(other, _)| other == name).expect(name).1[0].clone()
}

/// Of a start on an unstable orbit another one near it may be attracted: what a shadowed orbit converges to is not the scene's fate.
#[test]
fn r39_a_fate_is_not_proved_by_an_orbit_that_starts_near() {
    let mut document = recorded("description");
    document["proof"]["claim"] = json!("shadowed");
    document["proof"]["outcome"]["start"] =
        json!({ "time": ["0", "0"], "velocity": ["-12.5663600001", "-12.5663599999"] });
    document["proof"]["outcome"].as_object_mut().unwrap().remove("message");
    let orbit = [document["proof"].clone()];
    assert_eq!(checked(&orbit, &Unwatched).expect("a shadowed orbit").verdict, VerdictName::Confirmed);
    let refused = Claims::parse(&document.to_string()).expect_err("a fate of another start").to_string();
    assert!(refused.contains("proof.claim") && refused.contains("exact start"), "{refused}");
}

/// An orbit beside a region proves how many impacts are certified.
#[test]
fn r39_a_fate_has_as_many_impacts_as_its_proof() {
    let verdict = |impacts: u64| {
        let mut document = recorded("description of a region");
        document["proof"] = recorded("count");
        document["fate"]["impacts"] = json!(impacts);
        checked(&[document], &Unwatched).expect("a description").verdict
    };
    assert_eq!([verdict(6), verdict(999)], [VerdictName::Confirmed, VerdictName::Refuted]);
}

/// One reader takes the first value, another the last.
#[test]
fn r39_a_key_that_is_there_twice_is_refused() {
    for (name, lines) in all() {
        let text = text(&lines);
        for key in ["\"scene\":", "\"gap\":"] {
            let twice = text.replacen(key, &format!("{key}\"9\",{key}"), 1);
            let refused = Claims::parse(&twice).expect_err(&name).to_string();
            assert!(refused.contains("there twice"), "{name}: {refused}");
        }
        let listed = format!("[{}]", lines[0]).replacen("\"gap\":", "\"gap\":\"9\",\"gap\":", 1);
        assert!(Claims::parse(&listed).is_err_and(|refused| refused.to_string().contains("there twice")), "{name}");
    }
}

/// Of a sweep with a point twice another one may lack: its lines are no longer its points.
#[test]
fn r40_a_point_is_listed_once() {
    let (_, mut lines) = all().into_iter().find(|(name, _)| name == "sweep").unwrap();
    assert_eq!(checked(&lines, &Unwatched).expect("a sweep").verdict, VerdictName::Confirmed);
    lines.push(lines[1].clone());
    let found = checked(&lines, &Unwatched).expect("a sweep");
    assert!(found.verdict == VerdictName::Refuted && found.message.contains("listed before"), "{}", found.message);
}

/// A shard must have exactly its points of the grid, a summary no impacts, and a whole sweep all its points.
#[test]
fn r41_shards_summaries_and_missing_points_of_sweeps_are_checked() {
    let (_, lines) = all().into_iter().find(|(name, _)| name == "sweep").unwrap();
    let points = lines.len() - 1;
    assert!(points > 2, "{points}");
    let verdict = |head: &[(&str, Value)], points: &[usize]| {
        let mut own = vec![lines[0].clone()];
        own.extend(points.iter().map(|point| lines[1 + point].clone()));
        head.iter().for_each(|(key, value)| own[0][*key] = value.clone());
        checked(&own, &Unwatched).map(|found| (found.verdict, found.not_checked))
    };
    let of = |number: u64, of: u64| [("shard", json!([number, of]))];
    let whole: Vec<usize> = (0..points).collect();
    let odd: Vec<usize> = (0..points).step_by(2).collect();
    let all = |head: &[(&str, Value)], points: &[usize]| verdict(head, points).map(|(verdict, _)| verdict);
    assert_eq!(all(&[], &whole), Some(VerdictName::Confirmed));
    assert_eq!(all(&of(1, 2), &odd), Some(VerdictName::Confirmed));
    let (_, named) = verdict(&of(1, 2), &odd).unwrap();
    assert!(!named.iter().any(|key| ["shard", "summary"].contains(&key.as_str())), "{named:?}");
    // Points of another shard.
    for (number, shards) in [(2, 2), (1, 3), (2, 3)] {
        assert_eq!(all(&of(number, shards), &odd), Some(VerdictName::Refuted), "{number}/{shards}");
    }
    // Not all of the shard, or of the sweep.
    assert_eq!(all(&of(1, 1), &odd), Some(VerdictName::Undecided));
    assert_eq!(all(&[], &odd), Some(VerdictName::Undecided));
    assert_eq!(all(&[], &whole[1..]), Some(VerdictName::Undecided));
    // No shard at all.
    for shard in [of(0, 0), of(0, 2), of(3, 2), of(1, 0)] {
        assert_eq!(all(&shard, &odd), None, "{shard:?}");
    }
    assert_eq!(all(&[("summary", json!(true))], &whole), Some(VerdictName::Refuted));
}

/// Of a summary no bounds are compared, so that it is not checked that they are certified.
#[test]
fn r48_that_bounds_are_certified_is_not_checked_of_a_summary() {
    let (_, mut lines) = all().into_iter().find(|(name, _)| name == "sweep").unwrap();
    let is_named = |lines: &[Value]| {
        let found = checked(lines, &Unwatched).expect("a sweep");
        assert_eq!(found.verdict, VerdictName::Confirmed, "{}", found.message);
        found.not_checked.iter().any(|key| key == "certified")
    };
    assert!(!is_named(&lines));
    lines[0]["summary"] = json!(true);
    lines[1..].iter_mut().for_each(|point| _ = point.as_object_mut().unwrap().remove("states"));
    assert!(is_named(&lines));
}

/// An event whose bounds contain the requested time is listed, and may come after it: "3 impacts up to the requested time" was said where
/// the third one is at `t = 3` and the requested time a little before.
#[test]
fn r41_the_message_counts_what_is_listed() {
    let document = recorded("time");
    let message = document["outcome"]["message"].as_str().unwrap();
    let count = document["outcome"]["impacts"].as_u64().unwrap();
    assert_eq!(message, format!("{count} impacts listed; no other event up to the requested time"));
    let mut former = document.clone();
    former["outcome"]["message"] = json!(format!("{count} impacts up to the requested time"));
    assert_eq!(checked(&[former], &Unwatched).expect("an orbit").verdict, VerdictName::Refuted);
}

/// A ball that stays at once, by `e = 0` or without velocity, has no impacts that are left out.
#[test]
fn r40_infinitely_many_impacts_are_those_of_every_member() {
    let verdict = |velocity: &str, restitution: &str| {
        let excitation = json!({ "amplitude": ["1", "1/9"], "frequency": ["pi", "3*pi"], "phase": ["-pi/2", "-pi/2"] });
        let start = json!({ "time": "0", "wall": "left", "velocity": velocity });
        let document = json!({
            "schema": "impact-pair/orbit/1",
            "scene": { "excitation": excitation, "gap": "1", "restitution": restitution, "start": start },
            "certified": true,
            "claim": "exact start",
            "outcome": { "kind": "time-reached", "message": "0 impacts listed; no other event up to the requested time", "impacts": 0, "until": "0.1" },
            "events": [{ "event": "rest", "wall": "left", "time": ["-1e-7", "0.0001014"], "skipped": "infinite" }]
        });
        checked(&[document], &Unwatched).expect("an orbit").verdict
    };
    assert_eq!(verdict("-1e-3", "0.5"), VerdictName::Confirmed);
    assert_eq!(verdict("[-1e-3, -1e-4]", "[0.4, 0.5]"), VerdictName::Confirmed);
    for (velocity, restitution) in [("[-1e-3, 0]", "0.5"), ("-1e-3", "[0, 0.5]")] {
        assert_eq!(verdict(velocity, restitution), VerdictName::Undecided, "{velocity}, {restitution}");
    }
}

/// Of an interval of times something would have to be claimed for each: that all is listed up to 1000 is refuted.
#[test]
fn r49_a_time_to_stop_at_and_the_value_of_a_window_are_single_numbers() {
    let all = all();
    let document = |name: &str| json!(all.iter().find(|(own, _)| own == name).unwrap().1);
    for (name, place, value) in [
        ("chatter in a time", "/0/outcome/until", "[0, 1000]"),
        ("attracted in a time", "/0/outcome/until", "[0, 15.5]"),
        ("windows", "/0/windows/0/at", "[0.1, 0.2]"),
        ("windows", "/0/over/low", "[0, 100]"),
    ] {
        let mut copy = document(name);
        *copy.pointer_mut(place).unwrap() = json!(value);
        let refused = Claims::parse(&text(copy.as_array().unwrap())).unwrap_err().to_string();
        assert!(refused.contains("a single number, not an interval"), "{name}: {refused}");
    }
}
