//! Tests that only `validation/run --full` runs: each names its size, and the test that keeps its promise by default.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use impact_pair_tests::ROOT;

/// The folders with sources in Rust.
const RUST: [&str; 9] =
    ["src", "crates", "cli", "python/src", "benches", "examples", "fuzz", "tests", "validation/truth"];

/// The sources in a folder and the folders in it.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries
        .flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] })
        .filter(|path| path.extension().is_some_and(|end| end == "rs"))
        .collect()
}

/// The test functions of all sources, and the reasons of those that are ignored.
fn tests() -> (BTreeSet<String>, Vec<(String, String)>) {
    let (mut by_default, mut ignored) = (BTreeSet::new(), Vec::new());
    for path in RUST.iter().flat_map(|folder| sources(&Path::new(ROOT).join(folder))) {
        let mut attributes: Vec<String> = Vec::new();
        for line in fs::read_to_string(&path).unwrap().lines().map(str::trim) {
            if line.starts_with("#[") {
                attributes.push(line.to_owned());
            } else if let Some(name) = line.strip_prefix("fn ").and_then(|rest| rest.split('(').next()) {
                let is_test = attributes.iter().any(|own| own == "#[test]");
                match attributes.iter().find_map(|own| own.strip_prefix("#[ignore")) {
                    Some(reason) => ignored.push((name.to_owned(), reason.to_owned())),
                    None if is_test => drop(by_default.insert(name.to_owned())),
                    None => {}
                }
                attributes.clear();
            } else if !line.starts_with("//") {
                attributes.clear();
            }
        }
    }
    (by_default, ignored)
}

#[test]
fn an_ignored_test_names_its_size_and_a_test_that_runs_by_default() {
    let (by_default, ignored) = tests();
    assert!(by_default.len() > 500 && ignored.len() > 20, "sources are read: {}, {}", by_default.len(), ignored.len());
    let unexplained: Vec<_> = ignored
        .iter()
        .filter(|(_, reason)| {
            let named = reason.strip_prefix(" = \"deep: ").and_then(|rest| rest.strip_suffix("\"]"));
            let other = named.and_then(|own| own.split_once("; by default ")).map(|(_, other)| other);
            !other.is_some_and(|other| by_default.contains(other))
        })
        .collect();
    assert!(unexplained.is_empty(), "write #[ignore = \"deep: SIZE; by default TEST\"]: {unexplained:#?}");
}
