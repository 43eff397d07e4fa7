//! Files appear whole or not at all, pipes may close, Ctrl-C keeps what is certified.

use crate::common;
use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::process::Stdio;

use crate::common::{files, folder, run};

#[test]
fn a_file_holds_what_stdout_would() {
    let folder = folder("output-whole");
    let file = folder.join("events.json");
    fs::write(&file, "old").unwrap();
    let arguments = ["scenes/figure-12.toml", "--impacts", "30", "--format", "json"];
    let to_file = run(&arguments).arg("--output").arg(&file).output().unwrap();
    let to_stdout = run(&arguments).output().unwrap();
    assert!(to_file.status.success() && to_file.stdout.is_empty() && to_file.stderr.is_empty());
    assert_eq!(fs::read(&file).unwrap(), to_stdout.stdout);
    assert_eq!(files(&folder), ["events.json"]);
}

#[test]
fn an_undecided_orbit_still_leaves_its_file() {
    let folder = folder("output-undecided");
    let file = folder.join("events.csv");
    let answer =
        run(&["scenes/figure-14.toml", "--impacts", "200", "--arithmetic", "interval", "--format", "csv", "--output"])
            .arg(&file)
            .output();
    let answer = answer.unwrap();
    assert_eq!(answer.status.code(), Some(1));
    assert!(String::from_utf8(answer.stderr).unwrap().starts_with("undecided after impact "));
    assert!(fs::read_to_string(&file).unwrap().lines().count() > 20);
}

/// Help and the version are data as well.
#[cfg(target_os = "linux")]
#[test]
fn i58_a_full_disk_is_an_error_of_every_text() {
    for arguments in
        [&["--help"][..], &["--version"], &["run", "--help"], &["help", "run"], &["man"], &["completions", "bash"]]
    {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let answer = common::program(arguments).stdout(full).output().unwrap();
        let said = String::from_utf8(answer.stderr).unwrap();
        assert_eq!(answer.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(said.starts_with("error: cannot write ") && said.contains("No space left"), "{arguments:?}: {said}");
    }
    let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let answer = common::verb("two-impact", &["scenes/figure-12.toml"]).stdout(full).output().unwrap();
    assert!(answer.stderr.starts_with(b"error: cannot write the output: "), "the scene is not at fault");
}

#[test]
fn bad_input_leaves_the_file_as_it_was() {
    let folder = folder("output-kept");
    let (scene, file) = (folder.join("scene.toml"), folder.join("events.csv"));
    fs::write(&scene, common::scene("figure-12.toml").replace("restitution = 0.5", "restitution = 2")).unwrap();
    fs::write(&file, "old").unwrap();
    let answer = run(&[]).arg(&scene).arg("--output").arg(&file).output().unwrap();
    assert_eq!(answer.status.code(), Some(2));
    assert_eq!(fs::read_to_string(&file).unwrap(), "old");
    assert_eq!(files(&folder).len(), 2);
}

#[test]
fn a_closed_pipe_is_success() {
    for format in ["table", "csv", "jsonl"] {
        let mut child = run(&["scenes/figure-12.toml", "--impacts", "1000000000", "--format", format])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut first = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut first).unwrap();
        assert!(!first.is_empty());
        let answer = child.wait_with_output().unwrap();
        assert!(answer.status.success() && answer.stderr.is_empty(), "{format}: {answer:?}");
    }
}

#[cfg(unix)]
mod interrupted {
    use super::*;

    #[test]
    fn json_lines_keep_all_that_is_certified() {
        let mut child = run(&["scenes/figure-12.toml", "--impacts", "1000000000", "--format", "jsonl"])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut out = BufReader::new(child.stdout.take().unwrap());
        let mut text = String::new();
        for _ in 0..100 {
            out.read_line(&mut text).unwrap();
        }
        common::interrupt(&child);
        out.read_to_string(&mut text).unwrap();
        let answer = child.wait_with_output().unwrap();

        assert_eq!(answer.status.code(), Some(1));
        let lines: Vec<serde_json::Value> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        let [head, events @ .., end] = lines.as_slice() else { panic!("too few lines") };
        assert_eq!(head["schema"], "impact-pair/orbit/1");
        let count = events.len();
        assert!(count >= 99 && events[count - 1]["index"] == count);
        let outcome = &end["outcome"];
        assert_eq!((outcome["kind"].as_str(), outcome["reason"].as_str()), (Some("undecided"), Some("budget")));
        assert_eq!(outcome["message"], format!("interrupted after impact {count}"));
        assert_eq!(String::from_utf8(answer.stderr).unwrap(), format!("interrupted after impact {count}\n"));
    }

    /// Returns the document and the message of a command interrupted (Ctrl-C) as soon as the array `what` of its document is not empty.
    fn interrupted(name: &str, arguments: &[&str], what: &str) -> (serde_json::Value, String) {
        let folder = folder(name);
        let file = folder.join("answer.json");
        let command = || {
            let _ = fs::remove_file(&file);
            let mut command = common::program(arguments);
            command.args(["--format", "json", "--output"]).arg(&file);
            command
        };
        let document = || serde_json::from_str::<serde_json::Value>(&fs::read_to_string(&file).unwrap()).unwrap();
        let is_within = |_: &_| !document()[what].as_array().unwrap().is_empty();
        let answer = common::interrupted_within(command, || !files(&folder).is_empty(), is_within);
        assert_eq!(answer.status.code(), Some(1), "{answer:?}");
        assert_eq!(files(&folder), ["answer.json"]);
        (document(), String::from_utf8(answer.stderr).unwrap())
    }

    #[test]
    fn a_manifold_keeps_the_points_that_are_proved() {
        let range =
            ["scenes/figure-10.toml", "--manifold", "frequency=5..60:9000", "--digits", "100", "--cycles", "1..99"];
        let (document, said) = interrupted("manifold-interrupted", &[&["two-impact"], &range[..]].concat(), "curves");
        assert_eq!(said, "interrupted: the points written are proved, others are missing\n");
        assert_eq!((&document["interrupted"], &document["certified"]), (&true.into(), &false.into()));
        let curves = document["curves"].as_array().unwrap();
        assert!(curves.len() < 50 && curves.iter().all(|curve| !curve["points"].as_array().unwrap().is_empty()));
    }

    #[test]
    fn bifurcations_keep_those_that_are_proved() {
        let over = ["--over", "amplitude=0.03..0.499", "--doublings", "8", "--digits", "400"];
        let word = ["bifurcations", "scenes/cascade.toml", "--word", "RL", "--cycles", "1"];
        let (document, said) = interrupted("bifurcations-interrupted", &[&word[..], &over].concat(), "points");
        let points = document["points"].as_array().unwrap();
        assert!(said.starts_with("interrupted: ") && said.contains(&format!("{} bifurcation", points.len())), "{said}");
        assert_eq!((&document["interrupted"], &document["certified"]), (&true.into(), &false.into()));
    }

    #[test]
    fn a_file_appears_with_all_that_is_certified() {
        let folder = folder("output-interrupted");
        let file = folder.join("events.json");
        let long = ["scenes/figure-12.toml", "--impacts", "1000000000", "--format", "json", "--output"];
        // The draft appears after the handler is in place.
        let answer = common::interrupted(run(&long).arg(&file), || !files(&folder).is_empty());
        assert_eq!(answer.status.code(), Some(1));
        let document: serde_json::Value = serde_json::from_str(&fs::read_to_string(&file).unwrap()).unwrap();
        let count = document["events"].as_array().unwrap().len();
        let message = if count == 0 { "before the first impact".into() } else { format!("after impact {count}") };
        assert_eq!(document["outcome"]["message"], format!("interrupted {message}"));
        assert_eq!(files(&folder), ["events.json"]);
    }
}
