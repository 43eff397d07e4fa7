//! Single documents that are false in one claim, and true ones that a checker may take for false: `forged/false` and `forged/true`.
//!
//! A file holds `what` (the claim), `why` (it is false, or true), and `document` (its lines: one, or those of JSON Lines) or `of`, the
//! name of a recorded document. `cases` are documents made of it by a `change` each, a list of `[word, path, value]` with the words
//! `set`, `insert`, `copy` (the value is the path to copy from) and `drop`. Without `cases` it is the document itself.
//!
//! What is right of a case: `verdict`, where only one is (`unreadable`, `refuted`, `undecided`, `confirmed`); `says`, a part of the
//! message; `named` and `judged`, keys that are, or are not, among those not checked. A document of which only the claims `false` are
//! false may be confirmed where all these are named as not checked. `work` is the limit of the check's work. A file or a case that is `deep`
//! takes seconds: `CORPUS_CASES=all` alone reads it. The verified checker judges the same documents, in `target/corpus`.

use std::fs;
use std::path::Path;

use impact_pair_certificate::{Claims, Limits};
use impact_pair_document::VerdictName;
use impact_pair_model::watch::Unwatched;
use serde_json::{Value, json};

use crate::environment::number;
use crate::limits::limits;
use crate::recorded::{self, text};

/// Cases of one file that are judged by default, and of schemas of which a check takes milliseconds.
const CASES: u64 = 4;
const QUICK_CASES: u64 = 40;
const QUICK: [&str; 4] = ["orbit", "trap", "cycles", "description"];

/// A document, and what is right of it.
struct Case {
    name: String,
    file: Value,
    own: Value,
    lines: Vec<Value>,
    is_true: bool,
}

/// The verdict of `check` on a document, its message, and the keys that it names as not checked.
fn judged(lines: &[Value], work: Option<u64>) -> (&'static str, String, Vec<String>) {
    let text = text(lines);
    let limits = Limits { work: work.unwrap_or_else(|| limits().work), ..Limits::default() };
    let checked = Claims::parse(&text).and_then(|claims| {
        let judged = claims.judge(&limits, &Unwatched)?;
        let found = claims.document(&judged);
        let names = [claims.unjudged(), found.unchecked_claims.clone()].concat();
        Ok((found, names))
    });
    match checked {
        Err(error) => ("unreadable", error.to_string(), Vec::new()),
        Ok((found, names)) => (found.verdict.text(), found.message, names),
    }
}

/// A document with a change.
fn changed(document: &Value, change: &Value) -> Value {
    let mut copy = document.clone();
    for step in change.as_array().into_iter().flatten() {
        let [word, path] = [0, 1].map(|i| step[i].as_str().unwrap());
        let value = match word {
            "copy" => copy.pointer(step[2].as_str().unwrap()).unwrap().clone(),
            _ => step[2].clone(),
        };
        let (outer, key) = path.rsplit_once('/').unwrap();
        match (copy.pointer_mut(outer).unwrap_or_else(|| panic!("{path}")), word) {
            (Value::Array(items), "drop") => drop(items.remove(key.parse().unwrap())),
            (Value::Array(items), "set") => items[key.parse::<usize>().unwrap()] = value,
            (Value::Array(items), _) => items.insert(key.parse().unwrap(), value),
            (inner, "drop") => drop(inner.as_object_mut().unwrap().remove(key).expect(path)),
            (inner, _) => inner[key] = value,
        }
    }
    copy
}

/// The cases of a file, if its document is one of this schema.
fn cases_of(schema: &str, name: &str, file: &Value, is_true: bool) -> Vec<Case> {
    assert!(file["what"].is_string() && file["why"].is_string(), "{name} says what is false, and why");
    let lines = match file["of"].as_str() {
        Some(of) => recorded::document(of),
        None => file["document"].as_array().expect("the lines of a document").clone(),
    };
    let own = lines[0]["schema"].as_str().and_then(|schema| schema.split('/').nth(1));
    if own.filter(|own| KINDS.contains(own)).unwrap_or("other") != schema {
        return Vec::new();
    }
    let document = if lines.len() > 1 { json!(lines) } else { lines[0].clone() };
    let single = [json!({ "verdict": file["verdict"] })];
    let all = file["cases"].as_array().map_or(&single[..], Vec::as_slice);
    let most = usize::try_from(number("CORPUS_CASES", if QUICK.contains(&schema) { QUICK_CASES } else { CASES }))
        .unwrap_or(usize::MAX);
    let of = |(i, own): (usize, &Value)| {
        let made = changed(&document, &own["change"]);
        let lines = if lines.len() > 1 { made.as_array().unwrap().clone() } else { vec![made] };
        Case { name: format!("{name} {i}"), file: file.clone(), own: own.clone(), lines, is_true }
    };
    let is_left = |own: &Value| (file["deep"] == true || own["deep"] == true) && most < usize::MAX;
    let all: Vec<_> = all.iter().enumerate().filter(|(_, own)| !is_left(own)).collect();
    let step = all.len().div_ceil(most).max(1);
    all.into_iter().step_by(step).map(of).collect()
}

/// The cases of all files of a schema.
fn all(schema: &str) -> Vec<Case> {
    let mut all = Vec::new();
    for (folder, is_true) in [("false", false), ("true", true)] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/forged").join(folder);
        let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
        files.sort();
        for path in files {
            let file = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
            all.extend(cases_of(schema, &path.file_stem().unwrap().to_string_lossy(), &file, is_true));
        }
    }
    all
}

/// Judges the cases of a schema, and writes them to `target/corpus`; what is wrong of each.
fn judge(schema: &str) {
    let (mut wrong, mut lines) = (Vec::new(), String::new());
    for Case { name, file, own, lines: document, is_true } in all(schema) {
        let (found, message, names) = judged(&document, file["work"].as_u64());
        let only = own["verdict"].as_str().or(is_true.then_some("confirmed"));
        let named = |key: &str| own[key].as_array().into_iter().flatten().filter_map(Value::as_str);
        let is_named = |key: &str| names.iter().any(|own| own == key);
        let is_right = only
            .map_or(found != "confirmed" || named("false").next().is_some() && named("false").all(is_named), |only| {
                only == found
            })
            && own["says"].as_str().is_none_or(|says| message.contains(says))
            && named("named").all(is_named)
            && !named("judged").any(is_named);
        if !is_right {
            wrong.push(format!("{name}: {found}: {message}; {own}"));
        }
        let is_true = is_true || only == Some("confirmed");
        let entry = json!({
            "kind": schema, "of": name, "family": "a file", "place": "", "what": file["what"], "why": file["why"],
            "truth": if is_true { "true" } else { "false" }, "check": if is_true { "true" } else { found }, "text": text(&document),
        });
        lines += &format!("{entry}\n");
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target/corpus");
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join(format!("forged-{schema}.jsonl")), lines).unwrap();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A test for the files of each schema.
macro_rules! each_schema {
    ($($name:ident: $schema:literal,)*) => {
        /// Schemas of documents, and what is none of them.
        const KINDS: [&str; [$($schema),*].len()] = [$($schema),*];

        $(
            #[test]
            fn $name() {
                judge($schema);
            }
        )*
    };
}

each_schema! {
    orbits: "orbit",
    periodic_orbits: "periodic",
    bifurcations: "bifurcations",
    cycles: "cycles",
    windows: "windows",
    global_analyses: "global",
    tangencies: "tangency",
    regions: "trap",
    horseshoes: "chaos",
    cells: "chaos-cells",
    descriptions: "description",
    sweeps: "sweep",
    atlases: "atlas",
    others: "other",
}

/// Each recorded document is confirmed, and a confirmation is a theorem in words.
#[test]
fn recorded_documents_are_confirmed() {
    assert_confirmed(false);
}

#[test]
#[ignore = "deep: seconds for each; by default recorded_documents_are_confirmed"]
fn deep_recorded_documents_are_confirmed() {
    assert_confirmed(true);
}

fn assert_confirmed(is_deep: bool) {
    let mut wrong = Vec::new();
    for (name, lines) in recorded::all_that_are(is_deep) {
        let text = text(&lines);
        let claims = Claims::parse(&text).unwrap();
        let judged = claims.judge(&Limits::default(), &Unwatched).unwrap();
        let found = claims.document(&judged);
        let has_theorem = found.theorem.is_some_and(|theorem| !theorem.is_empty());
        if found.verdict != VerdictName::Confirmed || !has_theorem {
            wrong.push(format!("{name}: {}", found.message));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
