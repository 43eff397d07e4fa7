//! The published package: files that a user compiles and reads, and none that test them.

use std::fs;
use std::path::Path;
use std::process::Command;

/// The files of the package, as cargo lists them; made by cargo itself are three of them.
fn packaged() -> Vec<String> {
    let root = impact_pair_tests::ROOT;
    let arguments = ["package", "--list", "--allow-dirty", "--offline", "--package", "impact-pair"];
    let answer = Command::new(env!("CARGO")).args(arguments).current_dir(root).output().unwrap();
    assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
    let files = String::from_utf8(answer.stdout).unwrap();
    files.lines().map(|file| file.replace('\\', "/")).collect()
}

#[test]
fn a_package_holds_the_library_its_examples_and_scenes() {
    let files = packaged();
    for needed in [
        "src/lib.rs",
        "examples/events.rs",
        "scenes/figure-14.toml",
        "README.md",
        "LICENSE-MIT",
        "docs/proofs/chaos.md",
    ] {
        assert!(files.iter().any(|file| file == needed), "{needed} is missing");
    }
    for foreign in ["validation/", "tests/", "target/", "python/", "cli/", "docs/gallery/"] {
        assert!(!files.iter().any(|file| file.starts_with(foreign)), "{foreign} is packaged");
    }
    let size = |file: &String| fs::metadata(Path::new(impact_pair_tests::ROOT).join(file)).map_or(0, |of| of.len());
    let bytes: u64 = files.iter().map(size).sum();
    assert!(bytes < 11 << 18, "{bytes} bytes, some 760 KiB when compressed are expected of 2.6 MB");
}
