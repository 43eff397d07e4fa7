//! Documents of every verb that `check` reads, in `documents/`: one a file, a value a line. The commands that write them are in
//! `documents.json`; `cli/tests/documents.rs` runs them.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

/// The folder of the documents, from any package of the workspace.
fn folder() -> PathBuf {
    let mut folders = Path::new(env!("CARGO_MANIFEST_DIR"))
        .ancestors()
        .map(|folder| folder.join("crates/certificate/tests/documents"));
    folders.find(|folder| folder.is_dir()).expect("the folder of the documents")
}

fn read(file: &Path) -> Vec<Value> {
    fs::read_to_string(file).unwrap().lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// The documents with their names.
pub fn all() -> Vec<(String, Vec<Value>)> {
    let mut files: Vec<_> = fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let name = |file: &Path| file.file_stem().unwrap().to_string_lossy().replace('-', " ");
    files.iter().map(|file| (name(file), read(file))).collect()
}

/// Those whose check takes seconds, by `documents.json`, or all others.
pub fn all_that_are(is_deep: bool) -> Vec<(String, Vec<Value>)> {
    let table: Vec<Value> = serde_json::from_str(include_str!("documents.json")).unwrap();
    let is_one = |name: &str| table.iter().any(|row| row["name"] == name && (row["deep"] == true) == is_deep);
    all().into_iter().filter(|(name, _)| is_one(name)).collect()
}

/// The lines of the recorded document of this name.
pub fn document(name: &str) -> Vec<Value> {
    read(&folder().join(name.replace(' ', "-") + ".jsonl"))
}

/// A document as it is written.
pub fn text(lines: &[Value]) -> String {
    lines.iter().map(|line| format!("{line}\n")).collect()
}
