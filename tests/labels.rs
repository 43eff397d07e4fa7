//! On a certified path every clamp, saturation, rounding, cast and comparison with a literal carries the label of the lemma
//! that allows it (docs/proofs/clamps.md). This test reads the sources and lists the lines that do not.
//!
//! A label is `// X1: ...` at the end of the line, or in the comment above its statement, where `X1` is a lemma that is
//! defined somewhere, or one of three words: `proposes` (nothing certified depends on it), `exact: ...` (no rounding, for the
//! reason given), `shown` (what is printed, or a cost that is planned). A file that only proposes or shows has one label near its top:
//! `// Labels: proposes throughout.`

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use impact_pair_tests::{ROOT, sources};

const WORDS: [&str; 3] = ["proposes", "exact", "shown"];
const NUMBERS: &str = "i8 i16 i32 i64 i128 isize u8 u16 u32 u64 u128 usize f32 f64";
/// Methods that lose something with an argument: without one they are an iterator's, and lose nothing.
const CLAMPS: [&str; 3] = [".max(", ".min(", ".clamp("];
const CALLS: &str = "f64::max f64::min f64::clamp f64::round f64::floor f64::ceil f64::trunc saturating_ wrapping_ .round() \
                     .round_ties_even() .floor() .ceil() .trunc() .fract() unwrap_or( unwrap_or_default";

/// A line as the compiler sees it: strings are emptied, and the comment is apart.
#[derive(Default)]
struct Line {
    code: String,
    comment: String,
}

impl Line {
    fn read(text: &str) -> Self {
        let (mut code, mut rest) = (String::new(), text.chars().peekable());
        let mut quoted = false;
        while let Some(c) = rest.next() {
            match c {
                '\\' if quoted => {
                    rest.next();
                }
                '"' => {
                    // A quote in quotes is a character.
                    quoted = if code.ends_with('\'') { quoted } else { !quoted };
                    code.push(c);
                }
                _ if quoted => {}
                '/' if rest.peek() == Some(&'/') => {
                    let comment: String = rest.collect();
                    let comment = comment.trim_start_matches(['/', '!']).trim().to_owned();
                    return Self { code: code.trim().to_owned(), comment };
                }
                _ => code.push(c),
            }
        }
        Self { code: code.trim().to_owned(), comment: String::new() }
    }

    /// Whether the next line begins another statement.
    fn ends_statement(&self) -> bool {
        self.code.is_empty() || self.code.ends_with([';', '{', '}']) || self.code.ends_with("},") || self.is_arm()
    }

    fn is_arm(&self) -> bool {
        self.code.contains("=>") && self.code.ends_with(',')
    }

    /// Whether the line may be inexact: a clamp, a rounding, a cast, or a comparison with a literal.
    fn suspect(&self) -> bool {
        let code = &self.code;
        let found = |what: &str| {
            code.match_indices(what).map(|(at, what)| code[at + what.len()..].trim_start()).collect::<Vec<_>>()
        };
        CLAMPS.iter().any(|bound| found(bound).iter().any(|rest| !rest.starts_with(')')))
            || CALLS.split_whitespace().any(|call| code.contains(call))
            || found(" as ").iter().any(|rest| NUMBERS.split(' ').any(|number| number == word(rest)))
            || [" == ", " != "].iter().any(|sign| {
                let mut sides = code.match_indices(sign).map(|(at, _)| (&code[..at], &code[at + sign.len()..]));
                sides.any(|(left, right)| starts_with_float(right) || starts_with_float(last_operand(left)))
            })
    }
}

/// The letters, digits and `_` that a text begins with.
pub(super) fn word(text: &str) -> &str {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').next().unwrap_or_default()
}

/// Whether a text starts with a double as a literal.
fn starts_with_float(text: &str) -> bool {
    let text = text.trim_start_matches('-');
    let end = text.find(|c: char| !c.is_ascii_alphanumeric() && c != '.' && c != '_').unwrap_or(text.len());
    text.starts_with(|c: char| c.is_ascii_digit()) && text[..end].contains('.')
}

fn last_operand(text: &str) -> &str {
    text.rsplit(|c: char| !c.is_ascii_alphanumeric() && c != '.' && c != '_').next().unwrap_or_default()
}

/// One capital and a number.
pub(super) fn is_lemma(text: &str) -> bool {
    let (letter, number) = text.split_at(text.chars().next().map_or(0, char::len_utf8));
    letter.chars().all(|c| c.is_ascii_uppercase()) && !number.is_empty() && number.chars().all(|c| c.is_ascii_digit())
}

/// The labels of a comment: what it begins with, up to a colon or its end, and every `Lemma X1` in it.
fn labels(comment: &str) -> Vec<String> {
    let head = comment.split_once(": ").map_or(comment, |(head, _)| head).trim_end_matches(['.', ':']);
    let has_reason = comment.contains(": ");
    let is_name = |name: &&str| !["", "and", "Lemma", "Lemmas"].contains(name);
    let names: Vec<&str> = head.split([',', ' ']).filter(is_name).collect();
    let is_label = |name: &&str| is_lemma(name) || WORDS.contains(name) && (has_reason || *name != "exact");
    let mut labels: Vec<String> = Vec::new();
    if names.iter().all(is_label) {
        labels.extend(names.iter().map(|&name| name.to_owned()));
    }
    labels.extend(mentioned(comment).map(str::to_owned));
    labels.sort();
    labels.dedup();
    labels
}

fn mentioned(comment: &str) -> impl Iterator<Item = &str> {
    comment.match_indices("Lemma ").map(|(at, what)| word(&comment[at + what.len()..])).filter(|name| is_lemma(name))
}

/// The findings on a source: lines without a label, and labels that are defined nowhere.
#[derive(Default)]
struct Findings {
    unlabelled: Vec<String>,
    undefined: Vec<String>,
}

fn examine(name: &str, source: &str, lemmas: &BTreeSet<String>) -> Findings {
    let lines: Vec<Line> = without_tests(source).into_iter().map(Line::read).collect();
    let mut findings = Findings::default();
    let throughout = lines.iter().take(40).find_map(|line| {
        let word = line.comment.strip_prefix("Labels: ")?.strip_suffix(" throughout.")?;
        ["proposes", "shown"].contains(&word).then(|| word.to_owned())
    });
    for (index, line) in lines.iter().enumerate() {
        let text = || format!("{name}:{}: {}", index + 1, source.lines().nth(index).unwrap_or_default().trim());
        if labels(&line.comment).iter().any(|label| is_lemma(label) && !lemmas.contains(label)) {
            findings.undefined.push(text());
        }
        if !line.suspect() {
            continue;
        }
        let mut found = labels(&line.comment);
        found.retain(|label| !is_lemma(label) || lemmas.contains(label));
        if found.is_empty() {
            // Up to the start of the statement, and through the comment above it.
            let mut above = lines[..index].iter().rev().peekable();
            while above.next_if(|line| line.comment.is_empty() && !line.ends_statement()).is_some()
                || above.next_if(|line| !line.code.is_empty() && !line.ends_statement()).is_some()
            {}
            let block = above.take_while(|line| line.code.is_empty() && !line.comment.is_empty());
            found = block.flat_map(|line| labels(&line.comment)).collect();
            found.retain(|label| !is_lemma(label) || lemmas.contains(label));
        }
        found.extend(throughout.clone().filter(|_| found.is_empty()));
        if found.is_empty() {
            findings.unlabelled.push(text());
        }
    }
    findings
}

/// The lines, those of items behind `#[cfg(test)]` empty.
fn without_tests(source: &str) -> Vec<&str> {
    let mut lines = Vec::new();
    let (mut waiting, mut depth) = (false, 0_usize);
    for text in source.lines() {
        let code = Line::read(text).code;
        waiting |= depth == 0 && code.starts_with("#[cfg(test)]");
        let inside = waiting || depth > 0;
        if inside {
            depth = (depth + code.matches('{').count()).saturating_sub(code.matches('}').count());
            waiting = waiting && depth == 0 && !code.ends_with([';', '}']);
        }
        lines.push(if inside { "" } else { text });
    }
    lines
}

/// The lemmas that a text defines: `**Lemma X1`.
fn defined(text: &str) -> impl Iterator<Item = String> {
    text.split("**Lemma ").skip(1).map(|rest| word(rest).to_owned()).filter(|name| is_lemma(name))
}

/// The pages of lemmas, each with its name and text; the index is none.
pub(super) fn pages(root: &Path) -> Vec<(String, String)> {
    let mut pages: Vec<PathBuf> =
        fs::read_dir(root.join("docs/proofs")).unwrap().map(|page| page.unwrap().path()).collect();
    pages.retain(|page| page.extension().is_some_and(|extension| extension == "md") && !page.ends_with("README.md"));
    pages.sort();
    let name = |page: &PathBuf| page.file_name().unwrap().to_str().unwrap().to_owned();
    pages.iter().map(|page| (name(page), fs::read_to_string(page).unwrap())).collect()
}

/// The lemmas of the pages of proofs.
fn lemmas(root: &Path) -> BTreeSet<String> {
    pages(root).iter().flat_map(|(_, text)| defined(text).collect::<Vec<_>>()).collect()
}

/// The code that makes certified results, as the page lists it.
fn certified(root: &Path) -> Vec<PathBuf> {
    let page = include_str!("../docs/proofs/clamps.md").split_once("reads the sources of").unwrap().1;
    let names = page.split_once("lists each").unwrap().0.split('`').skip(1).step_by(2);
    let path = |name| ["src", "crates"].iter().map(|room| root.join(room).join(name)).find(|path| path.exists());
    names.map(|name| path(name).unwrap_or_else(|| panic!("{name} is not there"))).collect()
}

/// Whether a file makes a document of a result: what is printed is rounded outward, and tested as it is printed.
fn is_of_documents(path: &Path) -> bool {
    path.iter().any(|part| part == "document" || part == "document.rs")
}

#[test]
fn every_clamp_cast_and_comparison_carries_its_lemma() {
    let root = Path::new(ROOT);
    let lemmas = lemmas(root);
    assert!(lemmas.len() > 130, "{lemmas:?}");
    let (mut unlabelled, mut undefined) = (Vec::new(), Vec::new());
    for path in certified(root).iter().flat_map(|path| sources(path, false)).filter(|path| !is_of_documents(path)) {
        let name = path.strip_prefix(root).unwrap().display().to_string();
        let findings = examine(&name, &fs::read_to_string(&path).unwrap(), &lemmas);
        unlabelled.extend(findings.unlabelled);
        undefined.extend(findings.undefined);
    }
    assert!(undefined.is_empty(), "labels that no lemma has:\n{}", undefined.join("\n"));
    assert!(unlabelled.is_empty(), "{} lines without a label:\n{}", unlabelled.len(), unlabelled.join("\n"));
}

/// Lemmas that are named anywhere, in all sources, are defined.
#[test]
fn every_lemma_that_is_named_is_defined() {
    let root = Path::new(ROOT);
    let lemmas = lemmas(root);
    let rooms = ["src", "crates", "cli", "tests", "validation"];
    let mut paths: Vec<PathBuf> = rooms.iter().flat_map(|room| sources(room, false)).collect();
    paths.retain(|path| !path.ends_with("tests/labels.rs"));
    for path in paths {
        for (index, text) in fs::read_to_string(&path).unwrap().lines().enumerate() {
            let strangers: Vec<&str> = mentioned(text).filter(|name| !lemmas.contains(*name)).collect();
            assert!(strangers.is_empty(), "{}:{}: {strangers:?}", path.display(), index + 1);
        }
    }
}

/// The test of the test: what it must find, and what it must let pass.
#[test]
fn missing_labels_are_found() {
    let lemmas: BTreeSet<String> = defined("**Lemma M0** (a). **Lemma N1** (b). **Lemma (c).**").collect();
    assert_eq!(lemmas.iter().collect::<Vec<_>>(), ["M0", "N1"]);
    let unlabelled = |source: &str| examine("a.rs", source, &lemmas).unlabelled.len();
    let found = [
        "let a = b.max(0.0);",
        "let a = b.min(c); // the smaller one",
        "let a = b.clamp(0.0, 1.0); // exact",
        "let a = b.fold(0.0, f64::max);",
        "let a = b.saturating_sub(1);",
        "let a = b.wrapping_neg();",
        "let a = b.round() + c.floor() - d.ceil() * e.trunc();",
        "let a = (b + c) as i64;",
        "let a = b as f64 + c; // Lemma of nobody",
        "let a = b.unwrap_or(1);",
        "let a = b.unwrap_or_default();",
        "if b == 0.0 {",
        "if 1.5 != b {",
        "if b == -2.5e-3 {",
        "// N1: of another statement\nlet c = 1;\nlet a = b as i64;",
        "match a { // N1\n1 => b as i64,\n}",
        "/// N1: of the signature\nfn a(b: f64) -> i64 {\nb as i64\n}",
        "#[cfg(test)]\nmod tests {\nlet a = b as i64;\n}\nlet a = b as i64;",
        "#[cfg(test)]\nmod tests;\nlet a = b as i64;",
        "let a = '\"'; let b = c as i64; // N 1",
        "// Labels: exact throughout.\nlet a = b as i64;",
    ];
    for source in found {
        assert_eq!(unlabelled(source), 1, "{source}");
    }
    let passed = [
        "let a = b.max(0.0); // M0",
        "let a = b.max(0.0); // M0: an upper bound",
        "let a = b.max(0.0); // M0, N1: an upper bound",
        "// Lemma N1: whole.\nlet a = b as i64;",
        "// It is whole (Lemma N1).\n// And not large.\nlet a = c\n    .d()\n    .e(b as i64);",
        "let a = b as i64; // exact: below 2^53",
        "let a = b as i64; // proposes",
        "let a = b as i64; // shown: the cost",
        "// Labels: proposes throughout.\nlet a = b as i64;\nlet c = b.max(0.0);",
        "let a = b.max();",
        "use a as b;",
        "// let a = b as i64;",
        "/// As `b as i64`.",
        "let a = \"b as i64\";",
        "if b == 0 || c == d.e || f <= 0.0 {",
        "#[cfg(test)]\nmod tests {\nfn b() {}\nlet a = b as i64;\n}",
        "/// As told (Lemma N1).\nfn a(b: f64) -> i64 { b as i64 }",
    ];
    for source in passed {
        assert_eq!(unlabelled(source), 0, "{source}");
    }
    let refused = examine("a.rs", "let a = b.max(0.0); // M7: nobody's\nlet a = 1; // Lemma Q1", &lemmas);
    assert_eq!((refused.unlabelled.len(), refused.undefined.len()), (1, 2));
}
