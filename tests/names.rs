//! Names and comments are in standard terms. These tests refuse private words in comments, units other than the forcing period,
//! and declared names that do not say what the item is.

use std::fs;
use std::path::Path;

use crate::words::files;

/// The folders with sources in Rust.
pub const RUST: [&str; 9] =
    ["src", "crates", "cli", "python/src", "benches", "examples", "fuzz", "tests", "validation/truth"];

/// Refused in every comment, outside code: private words, and other words for the forcing period.
const COMMENTS: [&str; 14] = [
    "so many",
    "is told",
    "are told",
    "asked for",
    "in turns",
    "whole turns",
    "half turns",
    "half a turn",
    "quarter turn",
    "of a turn",
    "each turn",
    "gaps a turn",
    "gaps and turns",
    "turns of the fastest",
];

/// The comment of a line, less code; of Coq and OCaml a line within a comment, whose depth is kept from line to line.
fn comment(line: &str, is_rust: bool, depth: &mut usize) -> Option<String> {
    let text = if is_rust {
        line.split_once("//")?.1
    } else {
        let is_inside = *depth > 0 || line.contains("(*");
        *depth = (*depth + line.matches("(*").count()).saturating_sub(line.matches("*)").count());
        if is_inside { line } else { return None }
    };
    Some(text.split('`').step_by(2).collect::<Vec<_>>().join(" # ").to_lowercase())
}

#[test]
fn comments_name_their_quantities() {
    let root = Path::new(impact_pair_tests::ROOT);
    let coq = ["v", "ml"].map(|ending| ("validation/coq", ending));
    let mut faults = String::new();
    for (folder, ending) in RUST.map(|folder| (folder, "rs")).into_iter().chain(coq) {
        for source in files(&root.join(folder), ending) {
            let (text, mut depth) = (fs::read_to_string(&source).unwrap(), 0);
            let is_exempt = ["words.rs", "names.rs"].iter().any(|name| source == root.join("tests").join(name));
            for (number, line) in text.lines().enumerate().filter(|_| !is_exempt) {
                let found = comment(line, ending == "rs", &mut depth).unwrap_or_default();
                if let Some(word) = COMMENTS.iter().find(|word| found.contains(*word)) {
                    let file = source.strip_prefix(root).unwrap().display();
                    faults += &format!("{file}:{}: \"{word}\": {}\n", number + 1, line.trim());
                }
            }
        }
    }
    assert!(faults.is_empty(), "private words in comments:\n{faults}");
}

/// Refused as a word of a declared name: it does not say what the item is.
const NAMES: [&str; 13] = [
    "told", "asked", "wanted", "hurry", "court", "rung", "rungs", "ladder", "phased", "judges", "patience", "midst",
    "telling",
];
/// Refused as the whole name of a constant.
const CONSTANTS: [&str; 22] = [
    "AGAIN",
    "AHEAD",
    "ALONE",
    "APART",
    "AROUND",
    "BACK",
    "BESIDE",
    "BEYOND",
    "EACH",
    "ELSEWHERE",
    "ENOUGH",
    "FAR",
    "FARTHER",
    "FEW",
    "LEAN",
    "LOOKS",
    "MORE",
    "MOST",
    "NEAR",
    "ROOM",
    "ROOMS",
    "SAID",
];

/// The names that a line of Rust declares.
fn declared(line: &str) -> Option<(&str, &str)> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let kinds = ["fn", "const", "static", "struct", "enum", "trait", "type", "let"];
    let at = words.iter().take(4).position(|word| kinds.contains(word))?;
    let name = *words[at + 1..].iter().find(|word| !["mut", "fn"].contains(word))?;
    let end = name.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(name.len());
    Some((words[at], &name[..end]))
}

/// The words of a name in snake case, in capitals or in camel case.
fn words_of(name: &str) -> Vec<String> {
    let is_camel = name.chars().any(char::is_lowercase) && name.chars().any(char::is_uppercase);
    let spaced: String =
        name.chars().map(|c| if is_camel && c.is_uppercase() { format!("_{c}") } else { c.to_string() }).collect();
    spaced.to_lowercase().split('_').map(str::to_owned).collect()
}

#[test]
fn names_say_what_they_are() {
    let root = Path::new(impact_pair_tests::ROOT);
    let mut faults = String::new();
    let sources = RUST.iter().flat_map(|folder| files(&root.join(folder), "rs"));
    for source in sources.filter(|source| *source != root.join("tests/names.rs")) {
        let text = fs::read_to_string(&source).unwrap();
        for (number, line) in text.lines().enumerate() {
            let Some((kind, name)) = declared(line) else { continue };
            let is_constant = ["const", "static"].contains(&kind) && CONSTANTS.contains(&name);
            if is_constant || words_of(name).iter().any(|word| NAMES.contains(&word.as_str())) {
                faults += &format!("{}:{}: {kind} {name}\n", source.strip_prefix(root).unwrap().display(), number + 1);
            }
        }
    }
    assert!(faults.is_empty(), "names that do not say what the item is:\n{faults}");
}

#[test]
fn private_names_and_comments_are_found() {
    let names = |line| declared(line).map(|(_, name)| words_of(name));
    assert_eq!(names("pub(crate) trait Phased: Turning {"), Some(vec![String::new(), "phased".to_owned()]));
    assert_eq!(names("    let mut is_told = false;"), Some(vec!["is".to_owned(), "told".to_owned()]));
    assert_eq!(declared("const AGAIN: usize = 32;"), Some(("const", "AGAIN")));
    let found = |line, depth: &mut usize| comment(line, false, depth).is_some_and(|text| text.contains("so many"));
    let mut depth = 0;
    assert!(found("(* So many", &mut depth) && depth == 1 && found("   so many *)", &mut depth) && depth == 0);
    assert!(!found("Definition so_many := 1.", &mut depth) && comment("let told = 1;", true, &mut depth).is_none());
    assert_eq!(comment("x // in `turns`, in turns", true, &mut depth).unwrap(), " in  # , in turns");
}
