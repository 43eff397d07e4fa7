//! The true documents that the checkers are tried on, in `crates/certificate/tests/documents`: each is what a command writes today.
//!
//! `documents.json` beside the folder has the commands: a scene, by its name or in TOML, and the words for the program. Of slow ones, by
//! default only that they are there is asked. `DOCUMENTS_UPDATE=1` (with `--include-ignored`: the slow ones as well) writes them.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::common::answer_of;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

fn table() -> Vec<Value> {
    let text = fs::read_to_string(root().join("crates/certificate/tests/documents.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn file(row: &Value) -> PathBuf {
    let name = row["name"].as_str().unwrap().replace(' ', "-") + ".jsonl";
    root().join("crates/certificate/tests/documents").join(name)
}

/// What the command of a row writes, without what differs from run to run.
fn written(row: &Value) -> String {
    let scene = match &row["scene"] {
        Value::Array(lines) => lines.iter().map(|line| format!("{}\n", line.as_str().unwrap())).collect(),
        name => fs::read_to_string(root().join(format!("scenes/{}.toml", name.as_str().unwrap()))).unwrap(),
    };
    let words: Vec<&str> = row["command"].as_array().unwrap().iter().map(|word| word.as_str().unwrap()).collect();
    let is_grid = ["sweep", "atlas"].contains(&words[0]);
    let format = ["--quiet", "--format", if is_grid { "jsonl" } else { "json" }];
    let answer = answer_of(&scene, &[&words[..], &format].concat());
    let mut values: Vec<Value> =
        serde_json::Deserializer::from_slice(&answer.stdout).into_iter().map(Result::unwrap).collect();
    assert!(!values.is_empty(), "{row}: {}", String::from_utf8_lossy(&answer.stderr));
    for value in values.iter_mut().filter(|value| value["seconds"].is_number()) {
        value["seconds"] = json!(0.0);
    }
    values.iter().map(|value| format!("{value}\n")).collect()
}

fn assert_written(is_slow: bool) {
    for row in table().iter().filter(|row| row["command"].is_array() && (row["slow"] == true) == is_slow) {
        let (file, text) = (file(row), written(row));
        if std::env::var_os("DOCUMENTS_UPDATE").is_some() {
            fs::write(&file, &text).unwrap();
        }
        let recorded = fs::read_to_string(&file).unwrap_or_default();
        assert!(recorded == text, "{} is another one today: DOCUMENTS_UPDATE=1 writes it", file.display());
    }
}

#[test]
fn the_recorded_documents_are_those_of_today() {
    assert_written(false);
    let there: BTreeSet<PathBuf> = fs::read_dir(file(&json!({ "name": "" })).parent().unwrap())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    assert_eq!(there, table().iter().map(file).collect());
}

#[test]
#[ignore = "deep: seconds for each; by default the_recorded_documents_are_those_of_today"]
fn the_slow_recorded_documents_are_those_of_today() {
    assert_written(true);
}
