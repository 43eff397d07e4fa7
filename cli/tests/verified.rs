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

/// Whatever else is on PATH by that name verifies nothing: exit code and last line have to say the same.
#[test]
fn no_verdict_is_an_error() {
    assert_cmd_snapshot!("no_verdict", answering("no-verdict", "claim: an orbit", 0));
    for (name, answer, code) in
        [("silent", "", 0), ("contrary", "not verified: no", 0), ("other", "verified", 1), ("stopped", "verified", 137)]
    {
        let done = answering(name, answer, code).output().unwrap();
        assert_eq!((done.status.code(), done.stdout.as_slice()), (Some(2), &b""[..]), "{name}");
        assert!(String::from_utf8_lossy(&done.stderr).contains("stopped without a verdict"), "{name}");
    }
}

#[test]
fn the_answer_is_written_to_a_file() {
    let mut command = answering("to-a-file", "not verified: events[3] is a graze", 1);
    assert_eq!(command.args(["--output", "answer.txt"]).output().unwrap().status.code(), Some(1));
    let file = command.get_current_dir().unwrap().join("answer.txt");
    assert_eq!(fs::read_to_string(file).unwrap(), "not verified: events[3] is a graze\n");
}

#[test]
fn the_answer_is_a_document_as_well() {
    let lines = "claim: an orbit\\nscene: A = 1\\ndocument: SHA-256 0\\n";
    for (answer, code, reason) in [("verified", 0, "null"), ("not verified: a graze", 1, "\"a graze\"")] {
        let mut command = answering(&format!("json-{code}"), &format!("{lines}{answer}"), code);
        let done = command.args(["--format", "json"]).output().unwrap();
        let text = String::from_utf8(done.stdout).unwrap();
        // The SHA-256 of `{}`.
        let hash = "44136fa355b3678a1146ad16f7e8649e94fb4fc21fe77e8310c060f61caaff8a";
        let own = ["\"claim\":\"an orbit\"", "\"scene\":\"A = 1\"", hash, &format!("\"reason\":{reason}")];
        assert!(own.iter().all(|part| text.contains(part)), "{text}");
        assert_eq!(done.status.code(), Some(i32::from(code)));
    }
}

#[test]
fn a_missing_program_is_named() {
    assert_cmd_snapshot!("no_program", verified(&folder("no-program"), &[]));
    assert_cmd_snapshot!("verified_with_effort", verified(&folder("with-effort"), &["--effort", "2"]));
}
