//! The files that the tests of the public interface read.

use std::fs;
use std::path::{Path, PathBuf};

/// The folder of the workspace.
pub const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// The sources in a file or folder of the workspace, in order; those of its tests left out, if so requested.
pub fn sources(path: impl AsRef<Path>, with_tests: bool) -> Vec<PathBuf> {
    let path = Path::new(ROOT).join(path);
    if !path.is_dir() {
        return Some(path).filter(|path| path.extension().is_some_and(|ending| ending == "rs")).into_iter().collect();
    }
    let mut paths: Vec<PathBuf> = fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| with_tests || path.file_stem().is_none_or(|name| name != "tests"));
    paths.sort();
    paths.iter().flat_map(|path| sources(path, with_tests)).collect()
}
