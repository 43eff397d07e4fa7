//! The documents that the checker's own tests read, in `crates/certificate/tests/documents`: those that are written today.
//!
//! `DOCUMENTS_UPDATE=1` writes them.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::{documents, others};

fn folder() -> PathBuf {
    Path::new(impact_pair_tests::ROOT).join("crates/certificate/tests/documents")
}

#[test]
fn the_recorded_documents_are_those_of_today() {
    let orbits = documents::all().into_iter().map(|(name, document)| (name, vec![document]));
    let all = orbits.chain(others::all().into_iter().map(|(name, lines)| (name.to_owned(), lines)));
    let mut written = BTreeSet::new();
    for (name, lines) in all {
        let file = folder().join(name.replace(' ', "-") + ".jsonl");
        let text: String = lines.iter().map(|line| format!("{line}\n")).collect();
        if std::env::var_os("DOCUMENTS_UPDATE").is_some() {
            fs::write(&file, &text).unwrap();
        }
        let recorded = fs::read_to_string(&file).unwrap_or_default();
        assert!(recorded == text, "{} is another one today: DOCUMENTS_UPDATE=1 writes it", file.display());
        written.insert(file);
    }
    let there: BTreeSet<PathBuf> = fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert_eq!(there, written);
}
