//! `check` and `prove`: their results for right certificates, wrong certificates and files that are no certificates.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::common::{program, run};
use insta_cmd::assert_cmd_snapshot;

/// The orbit JSON of a scene, with `edit` applied to its text, in a file that only this test uses.
fn certificate(name: &str, arguments: &[&str], edit: impl Fn(String) -> String) -> PathBuf {
    let answer = run(arguments).args(["--quiet", "--format"]).arg("json").output().expect("the program runs");
    let path = PathBuf::from(format!("{name}.json"));
    fs::write(folder().join(&path), edit(String::from_utf8(answer.stdout).expect("JSON"))).expect("a file");
    path
}

fn folder() -> &'static Path {
    Path::new(env!("CARGO_TARGET_TMPDIR"))
}

const FIGURE_12: [&str; 3] = ["scenes/figure-12.toml", "--impacts", "4"];

/// `verb` on a certificate.
fn on(verb: &str, path: &PathBuf) -> Command {
    let mut command = program(&[verb]);
    command.current_dir(folder()).arg(path);
    command
}

macro_rules! snapshot {
    ($name:expr, $command:expr) => {
        insta::with_settings!({ filters => vec![
            (r"SHA-256 [0-9a-f]{64}", "SHA-256 .."), (r"\(-?\d+,-?\d+\)", "(..)"), (r"(\d\.\d{5})\d+", "$1.."), (r"\(-?0x[0-9a-f]+\) \d+", "(..) .."),
            (r"\(-?0x[0-9a-f]+\)", "(..)"), (r"Leg \d+ \d+ \d+", "Leg .."), (r"Start \d+ \d+", "Start .."),
        ] }, {
            assert_cmd_snapshot!($name, $command);
        });
    };
}

#[test]
fn right_certificates_are_confirmed() {
    snapshot!("confirmed", on("check", &certificate("confirmed", &FIGURE_12, |text| text)));
    let boxed = |text: String| text.replace("\"9.42497\"", "\"[9.42497, 9.42497]\"");
    snapshot!("confirmed_of_an_interval", on("check", &certificate("interval", &FIGURE_12, boxed)));
}

#[test]
fn json_lines_are_read() {
    let lines = run(&["scenes/figure-12.toml", "--impacts", "4", "--format", "jsonl"]).output().unwrap().stdout;
    let path = PathBuf::from("lines.jsonl");
    fs::write(folder().join(&path), lines).unwrap();
    snapshot!("confirmed_lines", on("check", &path));
}

#[test]
fn wrong_certificates_are_refused() {
    let restitution = |text: String| text.replace("\"0.5\"", "\"0.501\"");
    snapshot!("refuted", on("check", &certificate("restitution", &FIGURE_12, restitution)));
    let mapping = |text: String| text.replace("\"mapping\":\"P1\"", "\"mapping\":\"P3\"");
    snapshot!("refuted_mapping", on("check", &certificate("mapping", &FIGURE_12, mapping)));
    let outcome = |text: String| text.replace("impacts-reached", "never-impacts").replace("\"4 impacts\"", "\"\"");
    let figure_14 = ["scenes/figure-14.toml", "--impacts", "4"];
    snapshot!("undecided_outcome", on("check", &certificate("outcome", &figure_14, outcome)));
}

#[test]
fn a_document_that_is_no_certificate_is_named() {
    let edits: [(&str, &str, &str); 5] = [
        ("schema", "impact-pair/orbit/1", "impact-pair/orbit/9"),
        ("float", "\"certified\":true", "\"certified\":false"),
        ("wall", "\"wall\":\"right\"", "\"wall\":\"top\""),
        ("key", "\"velocity\":[", "\"pace\":["),
        ("gap", "\"gap\":\"9.42497\"", "\"gap\":\"-9.42497\""),
    ];
    for (name, from, to) in edits {
        let path = certificate(name, &FIGURE_12, |text| text.replace(from, to));
        snapshot!(format!("bad_{name}"), on("check", &path));
    }
    snapshot!("bad_file", program(&["check", "scenes/figure-12.toml"]));
}

#[test]
fn certificates_become_theorems() {
    snapshot!("theorem", on("prove", &certificate("theorem", &FIGURE_12, |text| text)));
    let harmonics = ["validation/coq/tests/harmonics.toml", "--impacts", "2"];
    snapshot!("theorem_of_three_harmonics", on("prove", &certificate("harmonics", &harmonics, |text| text)));
    let restitution = |text: String| text.replace("\"0.5\"", "\"0.501\"");
    snapshot!("no_theorem", on("prove", &certificate("false", &FIGURE_12, restitution)));
    let none = ["scenes/figure-12.toml", "--impacts", "0"];
    snapshot!("nothing_to_prove", on("prove", &certificate("none", &none, |text| text)));
}

/// Fewer impacts than requested are not all of them.
#[test]
fn r42_a_theorem_of_fewer_impacts_than_requested_says_so() {
    let path = certificate("fewer", &FIGURE_12, |text| text);
    let code = |impacts: &str| {
        let answer = on("prove", &path).args(["--impacts", impacts]).output().unwrap();
        (answer.status.code(), String::from_utf8(answer.stderr).unwrap())
    };
    assert_eq!(code("4").0, Some(0));
    let (status, said) = code("5");
    assert!(status == Some(1) && said.contains("a theorem of 4 impacts; the list has 4"), "{said}");
}

/// What a document claims and the theorem does not state is named; an outcome that the list contradicts is not stated.
#[test]
fn r52_a_theorem_names_what_it_leaves_out() {
    let answer = |path: &PathBuf, arguments: &[&str]| {
        let answer = on("prove", path).args(arguments).output().unwrap();
        let [file, said] = [answer.stdout, answer.stderr].map(|text| String::from_utf8(text).unwrap());
        (answer.status.code(), file, said)
    };
    let attracted = certificate("attracted", &["scenes/figure-12.toml", "--impacts", "20"], |text| text);
    let (code, file, said) = answer(&attracted, &[]);
    assert!(code == Some(0) && said.contains("20 impacts; not stated: the outcome `attracted`"), "{said}");
    assert!(file.contains("length printed = 20%nat") && file.contains("What `attracted` says besides"), "{file}");
    assert!(!answer(&attracted, &["--impacts", "3"]).2.contains("not stated"));
    let chatter = certificate("rests", &["scenes/chatter.toml", "--impacts", "20"], |text| text);
    let (code, _, said) = answer(&chatter, &[]);
    assert!(code == Some(0) && said.contains("16 impacts; not stated: events[16] and what comes after it"), "{said}");

    let five = |text: String| text.replace("\"impacts\":4", "\"impacts\":5").replace("\"4 impacts\"", "\"5 impacts\"");
    let (code, file, said) = answer(&certificate("five", &FIGURE_12, five), &[]);
    assert!(code == Some(1) && said.contains("4 impacts are listed") && !file.contains("all_listed"), "{said}");
    let early = |text: String| text.replace("\"until\":\"4.5\"", "\"until\":\"2.5\"");
    let until = ["scenes/figure-12.toml", "--until", "4.5"];
    assert_eq!(answer(&certificate("until", &until, |text| text), &[]).0, Some(0));
    let (code, file, said) = answer(&certificate("early", &until, early), &[]);
    assert!(code == Some(1) && said.contains("after the time `until`") && !file.contains("all_listed"), "{said}");
}

/// Of each claim its verdict, of what decides also why, and what is not checked.
#[test]
fn r32_each_claim_has_its_verdict() {
    let judged = |path: &PathBuf, arguments: &[&str]| {
        let answer = on("check", path).args(["--quiet", "--format", "json"]).args(arguments).output().unwrap();
        (answer.status.code(), String::from_utf8(answer.stdout).unwrap())
    };
    let read = |text: &str| serde_json::from_str::<serde_json::Value>(text).unwrap();
    let right = certificate("each_confirmed", &FIGURE_12, |text| text);
    let (code, said) = judged(&right, &[]);
    let said = read(&said);
    assert_eq!(
        (code, &said["schema"], &said["verdict"]),
        (Some(0), &"impact-pair/check/1".into(), &"confirmed".into())
    );
    assert_eq!(said["not_checked"], serde_json::json!(["arithmetic", "program"]));
    let verdict = |said: &serde_json::Value, path: &str| {
        let claims = said["claims"].as_array().unwrap();
        let found = claims.iter().find(|claim| claim["path"] == path).unwrap_or_else(|| panic!("{path}: {said}"));
        (found["verdict"].as_str().unwrap().to_owned(), found["reason"].is_string())
    };
    for path in ["schema", "scene.gap", "scene.start.velocity", "events[0].time", "events[3].wall", "outcome.impacts"] {
        assert_eq!(verdict(&said, path), ("confirmed".to_owned(), false), "{path}");
    }
    // The third impact on the other wall: those before it are confirmed, those after it are not looked at.
    let wrong = certificate("each_refuted", &FIGURE_12, |text| {
        let (before, after) = text.split_once("\"index\":3").unwrap();
        format!("{before}\"index\":3{}", after.replacen("\"wall\":\"right\"", "\"wall\":\"left\"", 1))
    });
    let (code, said) = judged(&wrong, &[]);
    let said = read(&said);
    assert_eq!((code, &said["verdict"]), (Some(1), &"refuted".into()));
    assert_eq!(verdict(&said, "events[1].velocity").0, "confirmed");
    assert_eq!(verdict(&said, "events[2]"), ("refuted".to_owned(), true));
    for path in ["events[2].time", "events[3].time", "outcome.impacts", "scene.gap"] {
        assert_eq!(verdict(&said, path), ("undecided".to_owned(), false), "{path}");
    }
    let both = PathBuf::from("each_of_both.json");
    let texts = [&right, &wrong].map(|path| fs::read_to_string(folder().join(path)).unwrap());
    fs::write(folder().join(&both), format!("[{}, {}]", texts[0], texts[1])).unwrap();
    let (code, said) = judged(&both, &["--output", "each_of_both.check.json"]);
    assert_eq!((code, said.as_str()), (Some(1), ""));
    let said = read(&fs::read_to_string(folder().join("each_of_both.check.json")).unwrap());
    assert_eq!(verdict(&said, "[0].outcome.impacts").0, "confirmed");
    assert_eq!(verdict(&said, "[1].events[2]"), ("refuted".to_owned(), true));
    assert!(said["not_checked"].as_array().unwrap().contains(&"[1].program".into()), "{said}");
}

#[test]
fn both_explain_themselves() {
    snapshot!("arguments_of_check", program(&["check", "--help"]));
    snapshot!("arguments_of_prove", program(&["prove", "--help"]));
}

/// `--strict` accepts no claim that is not checked.
#[test]
fn r61_an_unchecked_claim_is_not_accepted_strictly() {
    let two_impact = ["two-impact", "scenes/figure-12.toml", "--format", "json", "--quiet"];
    let exhaustive = program(&two_impact).output().unwrap().stdout;
    fs::write(folder().join("exhaustive.json"), exhaustive).unwrap();
    let complete = certificate("strict", &FIGURE_12, |text| text);
    let code = |path: &PathBuf, strict: &[&str]| on("check", path).args(strict).output().unwrap().status.code();
    let exhaustive = PathBuf::from("exhaustive.json");
    assert_eq!([code(&exhaustive, &[]), code(&exhaustive, &["--strict"])], [Some(0), Some(1)]);
    assert_eq!(code(&complete, &["--strict"]), Some(0));
}
