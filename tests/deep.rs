//! Tests that only `validation/run --full` runs: each names its size, and the test that keeps its promise by default.

use std::collections::BTreeSet;
use std::fs;

use impact_pair_tests::sources;

/// The folders with sources in Rust.
const RUST: [&str; 9] =
    ["src", "crates", "cli", "python/src", "benches", "examples", "fuzz", "tests", "validation/truth"];

#[test]
fn an_ignored_test_names_its_size_and_a_test_that_runs_by_default() {
    let (mut by_default, mut ignored) = (BTreeSet::new(), Vec::new());
    for path in RUST.iter().flat_map(|folder| sources(folder, true)) {
        for test in fs::read_to_string(&path).unwrap().split("#[test]").skip(1) {
            let Some((attributes, rest)) = test.split_once("fn ") else { continue };
            match attributes.split_once("#[ignore") {
                Some((_, reason)) => ignored.push(reason.trim().to_owned()),
                None => drop(by_default.insert(rest.split('(').next().unwrap().to_owned())),
            }
        }
    }
    assert!(by_default.len() > 400 && ignored.len() > 10, "sources are read: {}, {}", by_default.len(), ignored.len());
    ignored.retain(|reason| {
        let named = reason.strip_prefix("= \"deep: ").and_then(|rest| rest.strip_suffix("\"]"));
        !named.and_then(|own| own.split_once("; by default ")).is_some_and(|(_, other)| by_default.contains(other))
    });
    assert!(ignored.is_empty(), "write #[ignore = \"deep: SIZE; by default TEST\"]: {ignored:#?}");
}
