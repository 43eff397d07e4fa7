//! `check --verified`: the program that answers is found beside this one or on PATH, and its answer is passed on.
//!
//! A script stands for the program: `validation/coq/verified/run` tests the program itself.

#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

use crate::common::{folder, program};
use insta_cmd::assert_cmd_snapshot;

/// `check --verified -` in a folder, with a document on stdin and only this folder on PATH.
fn verified(path: &Path, arguments: &[&str]) -> Command {
    let document = path.join("document.json");
    fs::write(&document, "{}").unwrap();
    let mut command = program(&["check", "--verified", "-"]);
    command.args(arguments).current_dir(path).env("PATH", ".").stdin(fs::File::open(document).unwrap());
    command
}

/// A program of that name that reads all, answers so and exits so.
fn answering(name: &str, answer: &str, code: u8) -> Command {
    let path = folder(name);
    let file = path.join("impact-pair-verified");
    fs::write(&file, format!("#!/bin/sh\nwhile read -r line; do :; done\nprintf '{answer}\\n'\nexit {code}\n"))
        .unwrap();
    fs::set_permissions(&file, fs::Permissions::from_mode(0o755)).unwrap();
    verified(&path, &[])
}

#[test]
fn the_answer_is_passed_on() {
    assert_cmd_snapshot!("verified", answering("verified", "claim: an orbit\\nverified", 0));
    let reason = "not verified: events[3] is a graze: covered are impacts, rests and releases";
    assert_cmd_snapshot!("not_verified", answering("not-verified", reason, 1));
    assert_cmd_snapshot!("unreadable", answering("unreadable", "unreadable: schema is missing", 2));
}

#[test]
fn a_missing_program_is_named() {
    assert_cmd_snapshot!("no_program", verified(&folder("no-program"), &[]));
    assert_cmd_snapshot!("verified_with_effort", verified(&folder("with-effort"), &["--effort", "2"]));
}
