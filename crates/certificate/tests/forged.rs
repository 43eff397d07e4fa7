//! Documents that are false in one claim, and true ones that a checker may take for false: `forged/false` and `forged/true`, one a file.
//!
//! A file holds `what` (the claim), `why` (it is false, or true), `document` (its lines: one, or those of JSON Lines), and where only one
//! verdict is right `verdict`: `unreadable`, `refuted`, `undecided`. The verified checker judges the same files
//! (`validation/coq/verified/forged.py`).

use std::fs;
use std::path::Path;

use impact_pair_certificate::{Claims, Effort, Verdict};
use impact_pair_model::watch::Unwatched;
use serde_json::Value;

/// A file of a folder: its name and what it holds.
fn files(folder: &str) -> Vec<(String, Value)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/forged").join(folder);
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let read = |file: &Path| serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap();
    files.iter().map(|file| (file.file_stem().unwrap().to_string_lossy().into_owned(), read(file))).collect()
}

/// The verdict of `check` on a document, and its message.
fn verdict(file: &Value) -> (&'static str, String) {
    let lines = file["document"].as_array().expect("the lines of a document");
    let text: String = lines.iter().map(|line| format!("{line}\n")).collect();
    let claims = match Claims::parse(&text) {
        Ok(claims) => claims,
        Err(error) => return ("unreadable", error.to_string()),
    };
    match claims.check_within(&Effort::default(), &Unwatched) {
        Ok(verdict) => {
            let name = match verdict {
                Verdict::Confirmed { .. } => "confirmed",
                Verdict::Refuted(_) => "refuted",
                Verdict::Undecided(_) | Verdict::Interrupted { .. } => "undecided",
            };
            (name, claims.verdict_in_words(&verdict, &[]))
        }
        Err(error) => ("unreadable", error.to_string()),
    }
}

#[test]
fn no_false_document_is_confirmed() {
    let wrong: Vec<String> = files("false")
        .iter()
        .filter_map(|(name, file)| {
            assert!(file["what"].is_string() && file["why"].is_string(), "{name} says what is false, and why");
            let (verdict, message) = verdict(file);
            let is_right = file["verdict"].as_str().map_or(verdict != "confirmed", |only| only == verdict);
            (!is_right).then(|| format!("{name}: {verdict}: {message}"))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn each_true_document_is_confirmed() {
    let wrong: Vec<String> = files("true")
        .iter()
        .filter_map(|(name, file)| {
            let (verdict, message) = verdict(file);
            (verdict != "confirmed").then(|| format!("{name}: {verdict}: {message}"))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
