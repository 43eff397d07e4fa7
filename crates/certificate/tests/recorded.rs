//! Documents of every verb that `check` reads, in `documents/`: one a file, a value a line. `tests/corrupted` of the library writes them.

use std::fs;
use std::path::Path;

use serde_json::Value;

/// The documents with their names.
pub fn all() -> Vec<(String, Vec<Value>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/documents");
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let read = |file: &Path| {
        let text = fs::read_to_string(file).unwrap();
        let lines = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        (file.file_stem().unwrap().to_string_lossy().replace('-', " "), lines)
    };
    files.iter().map(|file| read(file)).collect()
}
