//! The program and its scenes.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// `impact-pair run` with these arguments, in the root of the repository.
pub fn run(arguments: &[&str]) -> Command {
    let mut command = program(&["run"]);
    command.args(arguments);
    command
}

/// `impact-pair` with these arguments, in the root of the repository, without colour.
pub fn program(arguments: &[&str]) -> Command {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the crate lies in the workspace");
    let mut command = Command::new(env!("CARGO_BIN_EXE_impact-pair"));
    command.args(arguments).current_dir(root).env("NO_COLOR", "1");
    command
}

/// What the program answers to a scene on stdin.
#[allow(dead_code, reason = "not every test file needs it")]
pub fn answer_to(scene: &str, arguments: &[&str]) -> Output {
    use std::io::Write;
    let mut command = run(&["-"]);
    command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the program starts");
    child.stdin.take().expect("a pipe").write_all(scene.as_bytes()).expect("the program reads");
    child.wait_with_output().expect("the program ends")
}

/// The text of a scene of the repository.
#[allow(dead_code, reason = "not every test file needs it")]
pub fn scene(name: &str) -> String {
    let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "..", "scenes", name].iter().collect();
    std::fs::read_to_string(path).expect("a scene of the repository")
}
