//! Claims as `check` lists them: each value of a document is listed or named beside, and no value is listed that is not compared.

use std::collections::BTreeSet;
use std::fs;

use impact_pair_certificate::{Claims, Limits};
use impact_pair_document::{CHAOS_CELLS_SCHEMA, CheckDocument, VerdictName};
use impact_pair_model::watch::{Stage, Unwatched, Watch, proceed_if};
use serde_json::{Value, json};

use crate::environment::number;
use crate::limits::limits;
use crate::recorded::{all, all_that_are, document, text};
use crate::schemas;

/// The result of `check`; `None` where the document is refused as it is read.
pub fn checked(lines: &[Value], watch: &dyn Watch) -> Option<CheckDocument> {
    let text = text(lines);
    let claims = Claims::parse(&text).ok()?;
    // Documents in which nothing is to be decided are soon given up.
    let is_light = lines[0]["claim"].is_string() || lines[0]["schema"] == CHAOS_CELLS_SCHEMA;
    let work = if is_light { 1 << 12 } else { limits().work };
    let limits = Limits { bits: 1 << 12, pieces: 16, work, ..Limits::default() };
    let judged = claims.judge(&limits, watch).ok()?;
    Some(claims.document(&judged))
}

/// The lines of a document as a check names what stands in them.
fn roots(lines: &[Value]) -> Vec<String> {
    let last = lines.len() - 1;
    let is_orbit = lines[0]["schema"] == "impact-pair/orbit/1";
    let root = |line: usize| match line {
        0 => String::new(),
        line if is_orbit && line == last => String::new(),
        line if is_orbit => format!("events[{}]", line - 1),
        line => format!("points[{}]", line - 1),
    };
    (0..=last).map(root).collect()
}

/// The path of each plain value of a document, as a check names it.
fn leaves(lines: &[Value]) -> Vec<String> {
    fn walk(path: String, value: &Value, found: &mut Vec<String>) {
        match value {
            Value::Object(entries) if !entries.is_empty() => {
                let dot = if path.is_empty() { "" } else { "." };
                entries.iter().for_each(|(key, value)| walk(format!("{path}{dot}{key}"), value, found));
            }
            Value::Array(items) if !items.is_empty() => {
                items.iter().enumerate().for_each(|(i, item)| walk(format!("{path}[{i}]"), item, found));
            }
            _ => found.push(path),
        }
    }
    let mut found = Vec::new();
    roots(lines).into_iter().zip(lines).for_each(|(path, line)| walk(path, line, &mut found));
    found
}

fn parent(path: &str) -> &str {
    path.rfind(['.', '[']).map_or("", |at| &path[..at])
}

/// Fails where a value is neither a claim, by its own path or its parent's, nor named, or is both.
fn assert_all_are_listed(name: &str, lines: &[Value], found: &CheckDocument) {
    let claims: BTreeSet<&str> = found.claims.iter().map(|claim| claim.path.as_str()).collect();
    let named: BTreeSet<&str> = found.not_checked.iter().map(String::as_str).collect();
    for path in leaves(lines) {
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

/// The names of all schemas.
fn names() -> Vec<String> {
    let files = fs::read_dir(schemas::folder()).unwrap();
    let name = |file: fs::DirEntry| file.file_name().into_string().unwrap().trim_end_matches(".json").to_owned();
    files.map(|file| name(file.unwrap())).collect()
}

/// A document with one more key that its schema has, if it is not there: the name of the schema, the path, and the lines.
fn each_key(mut visit: impl FnMut(&str, Option<&[schemas::Step]>, &[Value])) {
    let mut all = all();
    let orbit = all.iter().find(|(name, _)| name == "count").unwrap().1[0].clone();
    let mut head = orbit.clone();
    let events = head.as_object_mut().unwrap().remove("events").unwrap();
    let outcome = head.as_object_mut().unwrap().remove("outcome").unwrap();
    let end = json!({ "outcome": outcome, "arithmetic": head["arithmetic"] });
    all.push(("lines".into(), [&[head][..], events.as_array().unwrap(), &[end]].concat()));
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
        visit(name, None, &lines);
        for property in schemas::properties(&schema) {
            let mut copy = lines.clone();
            schemas::ensure(&mut copy[line], &property, &schema);
            visit(name, Some(&property), &copy);
        }
    }
}

/// Documents that together have each key of each schema.
pub fn with_each_key() -> Vec<Vec<Value>> {
    let mut found = Vec::new();
    each_key(|_, _, lines| found.push(lines.to_vec()));
    found
}

#[test]
fn r32_every_value_of_every_schema_is_checked_or_listed() {
    // The one left is what a check itself writes.
    let others = names().into_iter().filter(|name| SCHEMAS.iter().all(|(known, ..)| known != name));
    assert_eq!(others.collect::<Vec<_>>(), ["check", "verified"]);
    let (mut listed, mut refused) = (0, Vec::new());
    each_key(|name, property, lines| {
        let found = checked(lines, &|_: Stage<'_>| proceed_if(false));
        let Some(property) = property else { return assert_all_are_listed(name, lines, &found.expect(name)) };
        match found {
            Some(found) => {
                assert_all_are_listed(&format!("{name} with {property:?}"), lines, &found);
                listed += 1;
            }
            None => refused.push(format!("{name} {property:?}")),
        }
    });
    println!("{listed} properties listed, {} refused where they are:\n{}", refused.len(), refused.join("\n"));
    assert!(listed > 8 * refused.len() && listed > 300, "{listed} {refused:?}");
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

/// Numbers are compared, not how they are written: recorded documents are confirmed in every spelling; by default each third one in one of them.
#[test]
fn documents_are_confirmed_in_every_spelling() {
    let (mut wrong, mut count) = (Vec::new(), 0);
    let is_all = number("PROPTEST_CASES", 256) >= 100_000;
    for (i, (name, lines)) in all_that_are(false).into_iter().enumerate().filter(|(i, _)| is_all || i % 3 == 0) {
        let own = if is_all { &SPELLINGS[..] } else { &SPELLINGS[i / 3 % 5..][..1] };
        for spelling in own {
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

/// A list of documents with a text after it is refused.
#[test]
fn r32_nothing_comes_after_a_list_of_documents() {
    let list = json!(document("two impacts")).to_string();
    assert!(Claims::parse(&list).is_ok());
    for more in [&list[..], "{}", "1", "x"] {
        assert!(Claims::parse(&format!("{list}\n{more}")).is_err(), "{more}");
    }
}
