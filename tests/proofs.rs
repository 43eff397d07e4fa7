//! The pages of docs/proofs hold together: each lemma has one anchor, and each link to a lemma leads to its anchor.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use super::labels::{is_lemma, pages, word};
use impact_pair_tests::sources;

/// The anchors of lemmas, each with its page, and what is wrong with them.
fn anchors(pages: &[(String, String)]) -> (BTreeMap<String, String>, Vec<String>) {
    let (mut anchors, mut faults) = (BTreeMap::new(), Vec::new());
    for (page, text) in pages {
        for (number, line) in text.lines().enumerate() {
            let place = format!("{page}:{}", number + 1);
            let label = line.strip_prefix("<a id=\"").map(word).unwrap_or_default();
            if is_lemma(label) && anchors.insert(label.to_owned(), page.clone()).is_some() {
                faults.push(format!("{place}: a second anchor {label}"));
            }
            let head = format!("<a id=\"{label}\"></a>**Lemma {label}** (");
            if line.contains("**Lemma ") && !(is_lemma(label) && line.starts_with(&head)) {
                faults.push(format!("{place}: a lemma begins with <a id=\"X1\"></a>**Lemma X1** (name"));
            }
        }
    }
    (anchors, faults)
}

/// The links to lemmas of a text, `PAGE.md#X1`, each with what stands before it.
fn links(text: &str) -> impl Iterator<Item = (&str, &str, &str)> {
    text.match_indices(".md#").filter_map(move |(at, dot)| {
        let start = text[..at].rfind(|c: char| !c.is_ascii_lowercase() && c != '-').map_or(0, |before| before + 1);
        let label = word(&text[at + dot.len()..]);
        is_lemma(label).then_some((&text[..start], &text[start..at + 3], label))
    })
}

/// The links of a text that lead to no anchor, or are written with another label than theirs.
fn astray<'a>(text: &'a str, anchors: &'a BTreeMap<String, String>) -> impl Iterator<Item = String> + 'a {
    links(text).filter_map(|(before, page, label)| {
        let path = before.trim_end_matches(|c: char| c != '(' && c != '`');
        let named = path.strip_suffix("](").is_none_or(|path| path.ends_with(&format!("[{label}")));
        let fault = anchors.get(label).is_none_or(|right| right != page) || !named;
        fault.then(|| format!("{page}#{label}"))
    })
}

/// A page without formulas, code and links, from the heads of lemmas on.
fn prose(text: &str) -> String {
    let mut prose = String::new();
    for paragraph in text.split("\n\n").filter(|paragraph| !paragraph.starts_with("$$")) {
        let after_anchor = paragraph.strip_prefix("<a id=").and_then(|rest| rest.split_once("</a>"));
        let paragraph = after_anchor.map_or(paragraph, |(_, rest)| rest);
        let plain: Vec<&str> = paragraph.split('`').step_by(2).collect();
        let plain = plain.join(" ");
        let plain: Vec<&str> = plain.split('$').step_by(2).collect();
        let mut plain = plain.join(" ").replace("**Lemma ", "**Lemma_");
        while let Some((before, rest)) = plain.split_once('[').filter(|(_, rest)| rest.contains("](")) {
            let after = rest.split_once("](").unwrap().1.split_once(')').map_or("", |(_, after)| after);
            plain = format!("{before} {after}");
        }
        prose += &plain;
        prose.push('\n');
    }
    prose
}

/// The lemmas that a page names without a link; P1-P4 are the mappings of the paper.
fn unlinked(text: &str) -> Vec<String> {
    let prose = prose(text);
    let words = prose.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
    words.filter(|word| is_lemma(word) && !word.starts_with('P')).map(str::to_owned).collect()
}

fn markdown(folder: &Path) -> Vec<PathBuf> {
    let paths = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let is_page = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "md");
    paths.flat_map(|path| if path.is_dir() { markdown(&path) } else { vec![path] }).filter(is_page).collect()
}

#[test]
fn every_lemma_has_one_anchor_and_every_link_leads_to_it() {
    let root = Path::new(impact_pair_tests::ROOT);
    let pages = pages(root);
    let (anchors, mut faults) = anchors(&pages);
    assert!(anchors.len() > 130, "{anchors:?}");
    for (page, text) in &pages {
        faults.extend(unlinked(text).iter().map(|label| format!("{page}: {label} without a link")));
    }
    let rooms = ["src", "crates", "cli", "tests"].iter().flat_map(|room| sources(room, false));
    let readers = rooms.filter(|path| !path.ends_with("tests/proofs.rs")).chain(markdown(&root.join("docs")));
    let mut count = 0;
    for path in readers.filter(|path| !path.ends_with("docs/proofs/README.md")) {
        let text = fs::read_to_string(&path).unwrap();
        count += links(&text).count();
        let name = path.strip_prefix(root).unwrap().display();
        faults
            .extend(astray(&text, &anchors).map(|link| format!("{name}: {link} is no anchor, or the link of another")));
    }
    assert!(count > 500, "{count} links");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// The test of the test.
#[test]
fn anchors_and_links_that_are_wrong_are_found() {
    let page = |text: &str| vec![("a.md".to_owned(), text.to_owned())];
    let (known, faults) =
        anchors(&page("<a id=\"D1\"></a>**Lemma D1** (name; code: `a`). By [D1](a.md#D1), $D_2$ and `D3`."));
    assert_eq!((known.len(), faults.len()), (1, 0), "{faults:?}");
    for wrong in ["**Lemma D1** (name)", "<a id=\"D2\"></a>**Lemma D1** (name)", "Here is **Lemma D1** (name)"] {
        assert_eq!(anchors(&page(wrong)).1.len(), 1, "{wrong}");
    }
    assert_eq!(anchors(&page("<a id=\"D1\"></a>**Lemma D1** (a)\n<a id=\"D1\"></a>**Lemma D1** (b)")).1.len(), 1);
    for wrong in ["[D2](a.md#D2)", "[D1](b.md#D1)", "[D2](a.md#D1)", "`docs/proofs/b.md#D1`", "`docs/proofs/a.md#D2`"] {
        assert_eq!(astray(wrong, &known).count(), 1, "{wrong}");
    }
    for right in ["[D1](a.md#D1)", "[D1](../proofs/a.md#D1)", "`docs/proofs/a.md#D1`", "[other](b.md#heading)"] {
        assert_eq!(astray(right, &known).count(), 0, "{right}");
    }
    assert_eq!(unlinked("<a id=\"D1\"></a>**Lemma D1** (name). By D2."), ["D2"]);
    assert_eq!(unlinked("By D1, [D2](a.md#D2), $D_3$, `D4`, P1 and [D5](a.md#D5)-D6."), ["D1", "D6"]);
}
