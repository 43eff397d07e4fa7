//! User-facing text is in the field's words: the paper's, then CAPD's, SIAM's and IEEE 1788's. This test refuses private ones.
//!
//! It reads README, manual, help texts and messages of the command line, messages of all crates, and Python docstrings, and lists
//! file, line, the words, and what to write instead. Code is exempt: backticks, options, quoted keys, and strings of a single word.

use std::fs;
use std::path::{Path, PathBuf};

/// Words that are refused, what to write instead, and the words before them after which they are a term of the field.
const WORDS: [(&str, &str, &[&str]); 76] = [
    ("told", "given, measured from, expressed as, distinguished from", &[]),
    ("so many", "N, a number of", &[]),
    ("so often", "N times", &[]),
    ("asked for", "requested", &[]),
    ("wider than asked", "wider than requested", &[]),
    ("gaps a turn", "gap widths per forcing period", &[]),
    ("speeds a turn", "speeds per forcing period", &[]),
    ("in turns", "in forcing periods", &[]),
    ("whole turns", "whole forcing periods", &[]),
    ("half turn", "half period", &[]),
    ("quarter turn", "quarter period", &[]),
    ("half a turn", "half a forcing period", &[]),
    ("of a turn", "of a forcing period", &[]),
    ("each turn", "each forcing period", &[]),
    ("two a turn", "two per forcing period", &[]),
    ("nats an impact", "nats per impact", &[]),
    ("entropy an impact", "entropy per impact", &[]),
    ("exponent an impact", "exponent per impact", &[]),
    ("microseconds an impact", "microseconds per impact", &[]),
    ("µs an impact", "µs per impact", &[]),
    ("us an impact", "us per impact", &[]),
    ("time an impact", "time per impact", &[]),
    ("row an impact", "one row per impact", &[]),
    ("line an impact", "one line per impact", &[]),
    ("line an event", "one line per event", &[]),
    ("line a point", "one line per point", &[]),
    ("impacts a cycle", "impacts per forcing period", &[]),
    ("nats a cycle", "nats per forcing period", &[]),
    ("columns a cycle", "columns per forcing period", &[]),
    ("no motion leaves", "trapping region (forward invariant)", &[]),
    ("motion does not leave", "trapping region (forward invariant)", &[]),
    ("bases", "h-sets", &[]),
    ("tube", "chain of boxes", &[]),
    ("tubes", "chains of boxes", &[]),
    ("come again", "periodic orbits, fixed points of an iterate", &[]),
    ("comes again", "is periodic", &[]),
    ("chatter that ends", "complete chatter", &[]),
    ("pressed", "sticking, contact force", &[]),
    ("presses", "contact force", &[]),
    ("pressure", "contact force", &[]),
    ("physical", "admissible (the opposite: virtual)", &[]),
    ("floating orbit", "floating-point orbit", &[]),
    ("floating run", "floating-point run", &[]),
    ("floating solver", "floating-point solver", &[]),
    ("in floats", "in floating point", &[]),
    ("of floats", "of floating point", &[]),
    ("seen, not proved", "non-rigorous", &[]),
    ("dead impact", "perfectly plastic impact", &[]),
    ("impact law", "Newton's impact law", &["newton's"]),
    // A heading of a schema is its name.
    ("manifold", "parameter manifold", &["parameter", "stable", "unstable", "invariant", "##"]),
    ("manifolds", "parameter manifolds", &["parameter", "stable", "unstable", "invariant", "##"]),
    ("is another orbit", "diverges from the true orbit", &[]),
    ("another orbit from", "diverges from the true orbit at", &[]),
    ("spoiled", "corrupted", &[]),
    ("straddling", "near a boundary of branches", &[]),
    ("judge", "compare with, check", &[]),
    ("judges", "compares with, checks", &[]),
    ("judged", "compared with, checked", &[]),
    ("judgement", "comparison, verdict", &[]),
    ("judging", "comparing with, checking", &[]),
    ("proposes", "approximates", &[]),
    ("dispose", "verify", &[]),
    ("rung", "arithmetic, row", &[]),
    ("rungs", "arithmetics, rows", &[]),
    ("rooms", "modules", &[]),
    ("one of both", "either", &[]),
    ("ends among them", "endpoints included", &[]),
    ("ends included", "endpoints included", &[]),
    ("whole or not at all", "written atomically", &[]),
    ("one's own", "your own, a separate one", &[]),
    ("what is certified", "the certified part", &[]),
    ("what is proved so", "the proved part", &[]),
    ("computed anew", "recomputed", &[]),
    ("proved anew", "proved again", &[]),
    ("anybody", "any worker, any user", &[]),
    ("asks for nothing", "without external resources", &[]),
];

/// A text of a file: its words, each with its line.
type Text = Vec<(usize, String)>;

/// The words of a line; code becomes a word of its own that is none of the table's.
fn words(number: usize, line: &str) -> Text {
    let line = line.replace("``", "`");
    let prose: Vec<&str> = line.split('`').enumerate().map(|(i, part)| if i % 2 == 0 { part } else { " # " }).collect();
    let plain = |word: &str| {
        let end = |c: char| matches!(c, ',' | '.' | ';' | ':' | '!' | '?' | ')' | ']' | '*' | '|');
        word.trim_start_matches(['(', '[', '*', '|']).trim_end_matches(end).to_lowercase()
    };
    prose
        .concat()
        .replace("](", " (")
        .split_whitespace()
        .map(|word| (number, plain(word)))
        .filter(|(_, word)| !word.is_empty())
        .collect()
}

/// The refused words in a text: the line, the words, and what to write instead.
fn refused(text: &Text) -> Vec<(usize, &'static str, &'static str)> {
    let mut found = Vec::new();
    for (refused, instead, after) in WORDS {
        let pattern: Vec<String> = refused.split(' ').map(|word| word.trim_end_matches(',').to_owned()).collect();
        for (i, window) in text.windows(pattern.len()).enumerate() {
            let is_term = i > 0 && after.contains(&text[i - 1].1.as_str());
            if !is_term && window.iter().map(|(_, word)| word).eq(&pattern) {
                found.push((window[0].0, refused, instead));
            }
        }
    }
    found
}

/// The string literals of a Rust source, each with several words, and its `///` comments, if those are a help text.
fn rust(source: &str, is_help: bool) -> Vec<Text> {
    let source = source.split("\n#[cfg(test)]\nmod tests {").next().unwrap_or(source);
    let (mut texts, mut line, mut chars) = (Vec::new(), 1, source.chars().peekable());
    while let Some(c) = chars.next() {
        match c {
            '\n' => line += 1,
            '/' if chars.peek() == Some(&'/') => {
                let comment: String = std::iter::from_fn(|| chars.next_if(|&c| c != '\n')).collect();
                if let (Some(help), true) = (comment.strip_prefix("//"), is_help) {
                    texts.push(words(line, help));
                }
            }
            '\'' => {
                // A character, or a lifetime.
                let first = chars.next();
                if first == Some('\\') {
                    chars.next();
                }
                chars.next_if_eq(&'\'');
            }
            '"' => {
                let (mut literal, mut text) = (String::new(), Text::new());
                let start = line;
                while let Some(c) = chars.next() {
                    match c {
                        '"' => break,
                        '\\' if chars.peek() != Some(&'\n') => match chars.next() {
                            Some('n') => literal.push(' '),
                            Some(c) => literal.push(c),
                            None => {}
                        },
                        '\n' => {
                            text.extend(words(line, &std::mem::take(&mut literal)));
                            line += 1;
                        }
                        '\\' => {}
                        c => literal.push(c),
                    }
                }
                let is_message = line > start || literal.trim().contains(' ');
                text.extend(words(line, &literal));
                if is_message {
                    texts.push(text);
                }
            }
            _ => {}
        }
    }
    texts
}

/// The docstrings of a Python source, and its `#:` comments.
fn python(source: &str) -> Vec<Text> {
    let (mut texts, mut is_inside) = (Vec::new(), false);
    for (i, line) in source.lines().enumerate() {
        let parts: Vec<&str> = line.split("\"\"\"").collect();
        for (k, part) in parts.iter().enumerate() {
            is_inside ^= k > 0;
            if is_inside {
                texts.push(words(i + 1, part));
            }
        }
        if let Some(comment) = line.trim().strip_prefix("#:") {
            texts.push(words(i + 1, comment));
        }
    }
    vec![texts.concat()]
}

/// The files with an ending in a folder and the folders in it, sorted.
pub fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        if entry.is_dir() {
            found.extend(files(&entry, ending));
        } else if entry.extension().is_some_and(|extension| extension == ending) {
            found.push(entry);
        }
    }
    found.sort();
    found
}

#[test]
fn user_facing_text_is_in_the_words_of_the_field() {
    let root = Path::new(impact_pair_tests::ROOT);
    let mut texts: Vec<(PathBuf, Vec<Text>)> = Vec::new();
    let pages = files(&root.join("docs"), "md").into_iter();
    for page in pages.chain([root.join("README.md"), root.join("python/README.md")]) {
        let lines = fs::read_to_string(&page).unwrap();
        let text = lines.lines().enumerate().flat_map(|(i, line)| words(i + 1, line)).collect();
        texts.push((page, vec![text]));
    }
    for folder in ["cli", "crates/certificate", "crates/document", "crates/exact", "crates/model", "crates/plot", "."] {
        for source in files(&root.join(folder).join("src"), "rs") {
            if !source.ends_with("tests.rs") {
                let found = rust(&fs::read_to_string(&source).unwrap(), folder == "cli");
                texts.push((source, found));
            }
        }
    }
    for source in files(&root.join("python/impact_pair"), "py") {
        let found = python(&fs::read_to_string(&source).unwrap());
        texts.push((source, found));
    }
    assert!(texts.len() > 300, "files that are read: {}", texts.len());
    let mut faults = String::new();
    for (file, texts) in &texts {
        let file = file.strip_prefix(root).unwrap().display().to_string();
        for (line, refused, instead) in texts.iter().flat_map(refused) {
            faults += &format!("{}:{line}: \"{refused}\": write {instead}\n", file.trim_start_matches("./"));
        }
    }
    assert!(faults.is_empty(), "private words in user-facing text:\n{faults}");
}

#[test]
fn each_word_of_the_table_is_found_where_it_stands() {
    for (word, ..) in WORDS {
        let in_prose = words(1, &format!("Here (it {word}, as a test) stands."));
        assert!(refused(&in_prose).iter().any(|found| found.1 == word), "{word}");
        assert!(refused(&words(1, &format!("In code `{word}` stays."))).is_empty(), "{word}");
    }
    let source =
        "/// Told\nfn f() { let c = '\"'; say(\"it is told\\nhere, so \\\n many\"); key(\"told\"); } // told\n";
    let lines: Vec<usize> = rust(source, true).iter().flat_map(refused).map(|found| found.0).collect();
    assert_eq!(lines, [1, 2, 2]);
    let docstring = "def f():\n    \"\"\"It is\n    told.\"\"\"\n    told = 1\n";
    assert_eq!(python(docstring).iter().flat_map(refused).count(), 1);
}
