//! Claims as `check` lists them: each value of a document is listed or named beside, and no value is listed that is not compared.

use std::collections::BTreeSet;

use impact_pair_certificate::{Claims, Effort};
use impact_pair_document::{CHAOS_CELLS_SCHEMA, CheckDocument, VerdictName};
use impact_pair_exact::Exact;
use impact_pair_model::watch::{Stage, Unwatched, Watch, proceed_if};
use serde_json::{Value, json};

use crate::effort::effort;
use crate::environment::number;
use crate::recorded::all;
use crate::{changes, schemas, tiles};

pub fn text(lines: &[Value]) -> String {
    lines.iter().map(Value::to_string).collect::<Vec<_>>().join("\n")
}

/// The result of `check`; `None` where the document is refused as it is read.
pub fn checked(lines: &[Value], watch: &dyn Watch) -> Option<CheckDocument> {
    let text = text(lines);
    let claims = Claims::parse(&text).ok()?;
    // Documents in which nothing is to be decided are soon given up.
    let is_light = lines[0]["claim"].is_string() || lines[0]["schema"] == CHAOS_CELLS_SCHEMA;
    let work = if is_light { 1 << 12 } else { effort().work };
    let effort = Effort { bits: 1 << 12, pieces: 16, work, ..Effort::default() };
    let judged = claims.judge(&effort, watch).ok()?;
    Some(claims.document(&text, &judged))
}

/// The lines of a document as a check names what stands in them, with JSON pointers.
fn roots(lines: &[Value]) -> Vec<(String, String)> {
    let last = lines.len() - 1;
    let is_orbit = lines[0]["schema"] == "impact-pair/orbit/1";
    let root = |line: usize| match line {
        0 => String::new(),
        line if is_orbit && line == last => String::new(),
        line if is_orbit => format!("events[{}]", line - 1),
        line => format!("points[{}]", line - 1),
    };
    (0..=last).map(|line| (root(line), format!("/{line}"))).collect()
}

/// Each plain value of a document: its path as a check names it, and its pointer.
fn leaves(lines: &[Value]) -> Vec<(String, String)> {
    fn walk(path: String, pointer: String, value: &Value, found: &mut Vec<(String, String)>) {
        match value {
            Value::Object(entries) if !entries.is_empty() => {
                for (key, value) in entries {
                    let dot = if path.is_empty() { "" } else { "." };
                    walk(format!("{path}{dot}{key}"), format!("{pointer}/{key}"), value, found);
                }
            }
            Value::Array(items) if !items.is_empty() => {
                for (i, item) in items.iter().enumerate() {
                    walk(format!("{path}[{i}]"), format!("{pointer}/{i}"), item, found);
                }
            }
            _ => found.push((path, pointer)),
        }
    }
    let mut found = Vec::new();
    for ((path, pointer), line) in roots(lines).into_iter().zip(lines) {
        walk(path, pointer, line, &mut found);
    }
    found
}

fn parent(path: &str) -> &str {
    path.rfind(['.', '[']).map_or("", |at| &path[..at])
}

/// Fails where a value is neither a claim, by its own path or its parent's, nor named, or is both.
fn assert_all_are_listed(name: &str, lines: &[Value], found: &CheckDocument) {
    let claims: BTreeSet<&str> = found.claims.iter().map(|claim| claim.path.as_str()).collect();
    let named: BTreeSet<&str> = found.not_checked.iter().map(String::as_str).collect();
    for (path, _) in leaves(lines) {
        let is_claim = claims.contains(path.as_str()) || claims.contains(parent(&path));
        let around =
            std::iter::successors(Some(path.as_str()), |path| Some(parent(path)).filter(|path| !path.is_empty()));
        let is_named = around.into_iter().any(|path| named.contains(path));
        assert!(is_claim != is_named, "{name}: {path} is a claim: {is_claim}, not checked: {is_named}");
    }
}

/// The schemas, and which document has the values that are of none of their properties.
const SCHEMAS: [(&str, &str, usize); 22] = [
    ("orbit", "attracted", 0),
    ("orbit-lines-head", "lines", 0),
    ("orbit-lines-event", "lines", 1),
    ("orbit-lines-end", "lines", 2),
    ("periodic", "stable and unstable", 0),
    ("two-impact", "two impacts", 0),
    ("bifurcations", "bifurcations", 0),
    ("trap", "trap", 0),
    ("chaos", "chaos", 0),
    ("cycles", "cycles", 0),
    ("windows", "windows", 0),
    ("tangency", "tangency", 0),
    ("global", "global", 0),
    ("description", "description", 0),
    ("atlas-head", "atlas", 0),
    ("atlas-point", "atlas", 1),
    ("sweep-head", "sweep", 0),
    ("sweep-point", "sweep", 1),
    ("manifold", "", 0),
    ("chaos-cells", "cells", 0),
    ("audit", "", 0),
    ("trade", "", 0),
];

#[test]
fn r32_every_value_of_every_schema_is_checked_or_listed() {
    let mut all = all();
    let orbit = all.iter().find(|(name, _)| name == "count").unwrap().1[0].clone();
    let mut head = orbit.clone();
    let events = head.as_object_mut().unwrap().remove("events").unwrap();
    let outcome = head.as_object_mut().unwrap().remove("outcome").unwrap();
    let end = json!({ "outcome": outcome, "arithmetic": head["arithmetic"] });
    all.push(("lines".into(), [&[head][..], events.as_array().unwrap(), &[end]].concat()));
    // The one left is what a check itself writes.
    let others = schemas::names().into_iter().filter(|name| SCHEMAS.iter().all(|(known, ..)| known != name));
    assert_eq!(others.collect::<Vec<_>>(), ["check", "verified"]);
    let (mut listed, mut refused) = (0, Vec::new());
    for (name, base, line) in SCHEMAS {
        let schema = schemas::read(name);
        let mut lines = match all.iter().find(|(document, _)| document == base) {
            Some((_, lines)) => lines.clone(),
            None => vec![schemas::sample(&schema, &schema)],
        };
        if base.is_empty() {
            lines[0]["schema"] = json!(format!("impact-pair/{name}/1"));
        }
        // The last of the lines ends an orbit.
        let line = if name == "orbit-lines-end" { lines.len() - 1 } else { line };
        assert_all_are_listed(name, &lines, &checked(&lines, &|_: Stage<'_>| proceed_if(false)).expect(name));
        for property in schemas::properties(&schema) {
            let mut copy = lines.clone();
            schemas::ensure(&mut copy[line], &property, &schema);
            match checked(&copy, &|_: Stage<'_>| proceed_if(false)) {
                Some(found) => {
                    assert_all_are_listed(&format!("{name} with {property:?}"), &copy, &found);
                    listed += 1;
                }
                None => refused.push(format!("{name} {property:?}")),
            }
        }
    }
    println!("{listed} properties listed, {} refused where they are:\n{}", refused.len(), refused.join("\n"));
    assert!(listed > 8 * refused.len() && listed > 300, "{listed} {refused:?}");
}

/// Every object of every document: its path, and its pointer.
fn objects(lines: &[Value]) -> Vec<(String, String)> {
    let whole = json!(lines);
    let mut found = BTreeSet::new();
    for (path, pointer) in leaves(lines) {
        let (mut path, mut pointer) = (&path[..], &pointer[..]);
        while let Some(at) = pointer.rfind('/').filter(|at| *at > 0) {
            (path, pointer) = (parent(path), &pointer[..at]);
            if whole.pointer(pointer).is_some_and(Value::is_object) {
                found.insert((path.to_owned(), pointer.to_owned()));
            }
        }
    }
    found.into_iter().collect()
}

/// A key that the schema does not have, a list of its values in the place of an object, and an object in the place of a word: each makes a
/// document unreadable, at every place of every document.
#[test]
fn no_other_shape_is_read() {
    let mut changed = 0;
    for (name, lines) in all().into_iter().chain([("cells of a cell".to_owned(), tiles::cut().to_vec())]) {
        let whole = json!(lines);
        let is_read = |pointer: &str, other: Value| {
            let mut copy = whole.clone();
            *copy.pointer_mut(pointer).unwrap() = other;
            Claims::parse(&text(copy.as_array().unwrap())).is_ok()
        };
        let mut seen = BTreeSet::new();
        for (path, pointer) in objects(&lines) {
            let entries = whole.pointer(&pointer).unwrap().as_object().unwrap();
            // Items of a list are read alike.
            if !seen.insert((changes::unnumbered(&path), entries.keys().cloned().collect::<Vec<_>>())) {
                continue;
            }
            let mut with_another = entries.clone();
            with_another.insert("unknown".to_owned(), json!("1"));
            assert!(!is_read(&pointer, json!(with_another)), "{name}: {path} with another key");
            assert!(!is_read(&pointer, json!(entries.values().collect::<Vec<_>>())), "{name}: {path} as a list");
            for (key, value) in entries.iter().filter(|(_, value)| value.is_string()) {
                let object = json!({ value.as_str().unwrap(): null });
                assert!(!is_read(&format!("{pointer}/{key}"), object), "{name}: {path}.{key} as an object");
            }
            changed += 1;
        }
    }
    assert!(changed > 250, "{changed}");
}

/// Bounds of which the lower one is above the upper one make a document unreadable, at every place of every document.
#[test]
fn no_bounds_out_of_order_are_read() {
    let mut changed = BTreeSet::new();
    for (name, lines) in all() {
        let whole = json!(lines);
        for (path, pointer) in leaves(&lines) {
            let list = pointer.rfind('/').map_or("", |at| &pointer[..at]);
            let key = changes::unnumbered(parent(&path));
            // Half vectors of h-sets are no bounds.
            let is_vector = [".expanding", ".contracting"].iter().any(|vector| key.ends_with(vector));
            let Some([low, high]) = whole.pointer(list).and_then(bounds).filter(|[low, high]| low < high) else {
                continue;
            };
            let is_list_of_data = key.starts_with("scene.") || key == "values" || key.ends_with(".values");
            if is_vector || is_list_of_data || !changed.insert((name.clone(), key)) {
                continue;
            }
            let mut copy = whole.clone();
            copy.pointer_mut(list).unwrap().as_array_mut().unwrap().swap(0, 1);
            let is_read = Claims::parse(&text(copy.as_array().unwrap())).is_ok();
            assert!(!is_read, "{name}: {path} from {high} to {low}");
        }
    }
    assert!(changed.len() > 100, "{}", changed.len());
}

/// Spellings of a number, the last three of them of exact expressions alone.
const SPELLINGS: [&str; 5] = ["trailing zeros", "an exponent", "a fraction", "a sum", "blanks"];

/// A decimal in another spelling; `None` of what is no decimal.
fn respelled(decimal: &str, spelling: &str) -> Option<String> {
    let is_decimal = decimal.starts_with(|c: char| c == '-' || c.is_ascii_digit()) && decimal.parse::<f64>().is_ok();
    let (number, exponent) = decimal.split_once('e').unwrap_or((decimal, "0"));
    let (whole, places) = number.split_once('.').unwrap_or((number, ""));
    is_decimal
        .then(|| match spelling {
            "trailing zeros" => format!("{whole}.{places}00e{exponent}"),
            "an exponent" => format!("{whole}{places}0e{}", exponent.parse::<i64>().unwrap() - places.len() as i64 - 1),
            "a fraction" => format!("{whole}{places}e{exponent}/1{}", "0".repeat(places.len())),
            "a sum" => format!("1+({decimal}-1)"),
            _ => format!(" {decimal} "),
        })
        // Whole numbers are written without a leading zero.
        .map(|text| match text.strip_prefix("-0").or(text.strip_prefix('0')) {
            Some(rest) if spelling == "an exponent" || spelling == "a fraction" => {
                let digits = rest.trim_start_matches('0');
                let zero = if digits.starts_with(|c: char| c.is_ascii_digit()) { "" } else { "0" };
                format!("{}{zero}{digits}", if text.starts_with('-') { "-" } else { "" })
            }
            _ => text,
        })
}

/// Respells each number in a value; exact expressions are those of the scene, of parameters and of a grid.
fn respell(path: &str, value: &mut Value, spelling: &str) {
    match value {
        Value::Array(items) => items.iter_mut().for_each(|item| respell(path, item, spelling)),
        Value::Object(entries) => {
            entries.iter_mut().for_each(|(key, value)| respell(&format!("{path}.{key}"), value, spelling));
        }
        Value::String(text) => {
            let key = path.rsplit('.').next().unwrap();
            let is_in = |keys: &[&str]| keys.contains(&key);
            let is_exact = path.contains(".scene.")
                || is_in(&["until", "low", "high", "at", "values"])
                || path.contains(".over.") && is_in(&["from", "to"]);
            let is_of_both = SPELLINGS[..2].contains(&spelling);
            if (is_exact || is_of_both) && key != "key" {
                *text = respelled(text, spelling).unwrap_or_else(|| text.clone());
            }
        }
        _ => {}
    }
}

/// Numbers are compared, not how they are written: recorded documents are confirmed in every spelling, each number in the same one, or only
/// every other one.
#[test]
fn documents_are_confirmed_in_every_spelling() {
    let (mut wrong, mut count) = (Vec::new(), 0);
    let is_all = number("PROPTEST_CASES", 256) >= 100_000;
    // Words of a horseshoe take seconds, a tangency over a parameter more work than a test allows.
    let is_tried =
        |name: &str| name != "tangency interval" && (is_all || !["chaos", "tangency counted"].contains(&name));
    for (name, lines) in all().into_iter().filter(|(name, _)| is_tried(name)) {
        for spelling in SPELLINGS {
            let mut copy = json!(lines);
            respell("", &mut copy, spelling);
            let found = checked(copy.as_array().unwrap(), &Unwatched).map(|found| (found.verdict, found.message));
            if found.as_ref().is_none_or(|(verdict, _)| *verdict != VerdictName::Confirmed) {
                let read = Claims::parse(&text(copy.as_array().unwrap())).err();
                wrong.push(format!("{name} with {spelling}: {found:?} {read:?}"));
            }
            count += 1;
        }
    }
    assert!(wrong.is_empty(), "{} of {count}:\n{}", wrong.len(), wrong.join("\n"));
}

/// A periodic orbit has the amplitude and the gap of its scene; one of its own, as motions solved for these have it, is compared with nothing.
#[test]
fn r49_no_orbit_with_an_amplitude_or_a_gap_of_its_own_is_confirmed() {
    let mut refused = 0;
    for (name, lines) in all() {
        let whole = json!(lines);
        for (path, pointer) in leaves(&lines) {
            let Some(orbit) = pointer.strip_suffix("/stability") else { continue };
            for key in ["amplitude", "gap"] {
                let mut copy = whole.clone();
                copy.pointer_mut(orbit).unwrap()[key] = json!(["0.5", "0.5"]);
                match checked(copy.as_array().unwrap(), &|_: Stage<'_>| proceed_if(false)) {
                    Some(found) => {
                        assert_eq!(found.verdict, VerdictName::Refuted, "{name} {path} {key}: {}", found.message)
                    }
                    None => refused += 1,
                }
            }
        }
    }
    assert!(refused > 40, "{refused}");
}

/// Other values in the place of one: false, or, where it bounds from one side or is about, one of them false.
fn others_of(key: &str, value: &Value) -> Vec<Value> {
    let decimal = |text: &str| {
        let x = text.parse::<f64>().ok()?;
        let others = [x + 0.1 * x.abs() + 0.01, x - 0.1 * x.abs() - 0.01, 10.0 * x + 1.0, x / 10.0];
        Some(others.map(|x| json!(format!("{x:.17}"))).to_vec())
    };
    match value {
        Value::Null => vec![json!("P1")],
        Value::Bool(is_so) => vec![json!(!is_so)],
        Value::Number(number) => match number.as_i64() {
            Some(number) => [number + 1, (number - 1).max(0), 0, 9999].map(|x| json!(x)).to_vec(),
            None => vec![json!(number.as_f64().unwrap() + 0.01)],
        },
        Value::String(text) => match (key, changes::other_words(text), decimal(text)) {
            (_, Some(others), _) => others.into_iter().map(|other| json!(other)).collect(),
            ("flights", ..) => vec![json!(text.replace('F', "x").replace('N', "F").replace('x', "N"))],
            ("word", ..) => vec![json!("P3")],
            (_, None, Some(others)) => others,
            _ if Exact::parse(text).is_ok() => {
                vec![json!(format!("({text})*3 + 1")), json!(format!("({text})/3 - 1"))]
            }
            _ => vec![json!("gap"), json!("none")],
        },
        Value::Array(items) if items.is_empty() => vec![json!(["none"])],
        Value::Array(items) => match bounds(value) {
            Some([low, high]) => [1.0, -1.0]
                .map(|side| {
                    let by = side * (3.0 * (high - low) + 0.01 * (1.0 + low.abs()));
                    json!([format!("{:.17}", low + by), format!("{:.17}", high + by)])
                })
                .to_vec(),
            None => {
                let each: Vec<Vec<Value>> = items.iter().map(|item| others_of(key, item)).collect();
                let count = each.iter().map(Vec::len).min().unwrap_or(0);
                (0..count).map(|k| each.iter().map(|others| others[k].clone()).collect()).collect()
            }
        },
        Value::Object(_) => unreachable!("no leaf"),
    }
}

/// A lower and an upper bound.
fn bounds(value: &Value) -> Option<[f64; 2]> {
    let [low, high] = &value.as_array()?[..] else { return None };
    Some([low.as_str()?.parse().ok()?, high.as_str()?.parse().ok()?])
}

/// Whether a claim holds for every value at a path.
fn holds_for_all(name: &str, path: &str, head: &Value) -> bool {
    let excitation = &head["scene"]["excitation"];
    let is_one = excitation["phase"].as_array().is_some_and(|all| all.len() == 1);
    let has_phases = ["orbits", "points", "windows"].iter().any(|list| head[list].is_array()) || name == "sweep";
    match path {
        // Lemma R1: under one harmonic a claim about phases holds for every `tau`, and nothing moves a box that is not shaken.
        "scene.excitation.phase" if is_one && (has_phases || excitation["amplitude"] == json!(["0"])) => true,
        "scene.excitation.frequency" if excitation["amplitude"] == json!(["0"]) => true,
        // Without a drift the ball swings alike in every frequency; a region that attracts is entered from other starts as well.
        "scene.excitation.frequency" => name == "never" || name == "cells",
        "scene.excitation.phase" | "scene.start.time" => name == "trap" || name == "cells",
        "scene.start.wall" => name == "cells",
        // A chatter on one wall does not depend on the other; a perfectly plastic impact forgets the speed before it.
        "scene.gap" => name == "chatter in a time",
        "scene.start.velocity" => name == "dead impacts under two" || name == "cells",
        _ => false,
    }
}

/// The pointer to a value, or to a list of values, by its path.
fn pointer_of(lines: &[Value], path: &str) -> Option<String> {
    leaves(lines).into_iter().find_map(|(leaf, pointer)| {
        let list = pointer.rfind('/').map_or("", |at| &pointer[..at]).to_owned();
        if leaf == path { Some(pointer) } else { (parent(&leaf) == path).then_some(list) }
    })
}

#[test]
fn r32_nothing_is_listed_as_a_claim_that_is_not_compared() {
    let (mut refused, mut missed, mut compared) = (0, Vec::new(), BTreeSet::new());
    let is_all = number("PROPTEST_CASES", 256) >= 100_000;
    // A document that is undecided from its start on claims nothing else. A word that does not exist is sought for seconds, and so
    // are orbits of which shorter ones are requested as well. Boxes between two invariant manifolds take seconds each.
    let slow = ["chaos", "three turns", "attracted under two", "tangency counted", "tangency interval"];
    // Others of the same schema have the same keys.
    let like_others = ["attracted in a time", "chatter in a time", "dead impacts under two", "sweep over a term"];
    let is_left = |name: &str| slow.contains(&name) || like_others.contains(&name);
    let is_tried = |name: &str| name != "too long" && (!is_left(name) || is_all);
    for (name, lines) in all().into_iter().filter(|(name, _)| is_tried(name)) {
        let found = checked(&lines, &Unwatched).expect(&name);
        assert_eq!(found.verdict, VerdictName::Confirmed, "{name}: {}", found.message);
        assert!(found.claims.iter().all(|claim| claim.verdict == VerdictName::Confirmed && claim.reason.is_none()));
        assert_all_are_listed(&name, &lines, &found);
        let whole = json!(lines);
        let last = &lines[lines.len() - 1];
        let kind = [&lines[0]["schema"], &lines[0]["claim"], &last["outcome"]["kind"]].map(Value::to_string);
        // Each claim of these takes a second or more: of each 4 or 25 one is changed.
        let share = match name.as_str() {
            "windows" => 25,
            "tangency" | "global" | "atlas" => 4,
            _ => 1,
        };
        let mut seen = BTreeSet::new();
        for claim in &found.claims {
            let unnumbered = changes::unnumbered(&claim.path);
            if !seen.insert(unnumbered.clone()) || holds_for_all(&name, &unnumbered, &lines[0]) {
                continue;
            }
            // Claims of a document of this kind are compared by the same code in others.
            let is_new = compared.insert((kind.clone(), unnumbered.clone()));
            if !is_all && (!is_new || seen.len() % share != 0) {
                continue;
            }
            let pointer = pointer_of(&lines, &claim.path).unwrap_or_else(|| panic!("{name}: {}", claim.path));
            let key = unnumbered.rsplit('.').next().unwrap().to_owned();
            let value = whole.pointer(&pointer).unwrap().clone();
            let is_confirmed = |other: &Value| {
                let mut copy = whole.clone();
                *copy.pointer_mut(&pointer).unwrap() = other.clone();
                let mut lines = copy.as_array().unwrap().clone();
                // Counts and texts about the changed value are made anew, unless they are the change itself.
                if lines.len() == 1 && !["impacts", "index", "message"].contains(&key.as_str()) {
                    lines[0] = changes::made_consistent(&lines[0]);
                }
                // A value that says nothing is not listed any more.
                checked(&lines, &Unwatched).is_some_and(|found| {
                    found.verdict == VerdictName::Confirmed && !found.not_checked.contains(&claim.path)
                })
            };
            let others = others_of(&key, &value);
            let is_missed = match bounds(&value) {
                Some(_) => others.iter().any(is_confirmed),
                None => others.iter().all(is_confirmed),
            };
            if is_missed {
                missed.push(format!("{name}: {}: {value}, {others:?}", claim.path));
            }
            refused += 1;
        }
    }
    assert!(missed.is_empty(), "{} of {refused}:\n{}", missed.len(), missed.join("\n"));
    println!("{refused} claims are compared");
}
