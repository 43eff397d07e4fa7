//! `two-impact` on the command line: stdout, stderr and exit code together.

use crate::common;
use std::fs;
use std::process::Command;

use crate::common::{folder, verb};
use insta_cmd::assert_cmd_snapshot;
use serde_json::Value;

fn two_impact(arguments: &[&str]) -> Command {
    verb("two-impact", arguments)
}

#[test]
fn motions_as_tables() {
    assert_cmd_snapshot!("exact_orbit", two_impact(&["scenes/figure-12-exact.toml"]));
    assert_cmd_snapshot!("figure_13_of_three_cycles", two_impact(&["scenes/figure-13.toml", "--cycles", "1..3"]));
    let right = ["scenes/figure-12-exact.toml", "--solve-for", "amplitude", "--wall", "right", "--digits", "15"];
    assert_cmd_snapshot!("amplitude_on_the_right", two_impact(&right));
    assert_cmd_snapshot!("gap", two_impact(&["scenes/figure-12-exact.toml", "--solve-for", "gap"]));
}

#[test]
fn motions_as_json() {
    assert_cmd_snapshot!("exact_orbit_as_json", two_impact(&["scenes/figure-12-exact.toml", "--format", "json"]));
    let answer = two_impact(&["scenes/figure-13.toml", "--cycles", "1..2", "--format", "json"]).output().unwrap();
    let documents: Value = serde_json::from_slice(&answer.stdout).unwrap();
    let counts: Vec<usize> = [0, 1].map(|i| documents[i]["orbits"].as_array().unwrap().len()).to_vec();
    assert_eq!(counts, [2, 4]);
    for document in documents.as_array().unwrap() {
        assert_eq!(document["schema"], "impact-pair/periodic/1");
        assert!(document["exhaustive"].as_bool().unwrap());
    }
}

/// The right-most mapping of a word starts at the impact listed first: P2 on the left wall, P1 on the right one.
#[test]
fn i58_a_word_starts_at_the_impact_listed_first() {
    for (wall, word) in [("left", "P1 P2"), ("right", "P2 P1")] {
        let arguments = ["scenes/figure-13.toml", "--cycles", "1..2", "--wall", wall];
        let answer = two_impact(&[&arguments[..], &["--format", "json"]].concat()).output().unwrap();
        let documents: Value = serde_json::from_slice(&answer.stdout).unwrap();
        for document in documents.as_array().unwrap() {
            assert_eq!(document["word"], word);
            let orbits = document["orbits"].as_array().unwrap();
            assert!(!orbits.is_empty() && orbits.iter().all(|orbit| orbit["impacts"][0]["wall"] == wall));
        }
        let table = two_impact(&arguments).output().unwrap().stdout;
        assert!(String::from_utf8(table).unwrap().contains(&format!("N = 1, {word}: ")));
    }
}

/// An answer is called certified where all of it is decided, and only then the exit code is 0: with e = 1 elliptic motions are, one of them with a
/// trace within 10^-29 of 2 that takes more bits; two motions within the bounds of one another are not, nor is one with the trace 2.
#[test]
fn i62_an_answer_is_certified_where_all_is_decided() {
    let path = folder("two-impact-certified").join("scene.toml");
    for (amplitude, restitution, digits, code) in [
        ("0.1", "1", "20", 0),
        ("1/(pi^2/2 - 2)*(1 + 1e-30)", "1", "20", 0),
        ("1/(pi^2/2 - 2)", "1", "20", 1),
        ("1/sqrt(4 + (3*pi)^2)*(1 + 1e-24)", "0.5", "3", 1),
    ] {
        let scene = format!(
            "excitation = {{ amplitude = \"{amplitude}\", frequency = \"2*pi\", phase = 0 }}\npair = {{ gap = 1, restitution = {restitution} }}\n\
             start = {{ time = 0, wall = \"left\", velocity = -1 }}"
        );
        fs::write(&path, scene).unwrap();
        let answer = two_impact(&[path.to_str().unwrap(), "--digits", digits, "--format", "json"]).output().unwrap();
        let document: Value = serde_json::from_slice(&answer.stdout).unwrap();
        let found = (answer.status.code(), document["certified"].as_bool());
        assert_eq!(found, (Some(code), Some(code == 0)), "{amplitude}");
        let is_elliptic = |orbit: &Value| orbit["stability"] == "elliptic";
        let any = document["orbits"].as_array().unwrap().iter().any(is_elliptic);
        assert_eq!(any, restitution == "1" && code == 0, "{amplitude}");
    }
}

#[test]
fn undecided_parts_are_stated() {
    let fold = common::scene("figure-12.toml").replace("9.42497", "\"sqrt(4 + 9*pi^2)\"");
    let path = folder("two-impact-fold").join("fold.toml");
    fs::write(&path, fold).unwrap();
    let answer = two_impact(&[path.to_str().unwrap()]).output().unwrap();
    assert_eq!(answer.status.code(), Some(1));
    let text = String::from_utf8(answer.stdout).unwrap();
    assert!(text.contains("undecided: there may be others with th1 - th0 = 3.14159"), "{text}");
}

#[test]
fn manifolds() {
    let figure_10 = ["scenes/figure-10.toml", "--manifold", "frequency=1..20:5", "--cycles", "1..4"];
    assert_cmd_snapshot!("figure_10_as_a_table", two_impact(&figure_10));
    assert_cmd_snapshot!("figure_10_as_csv", two_impact(&[&figure_10[..], &["--format", "csv"]].concat()));
    let figure_11 = ["scenes/figure-11.toml", "--manifold", "velocity=-300..-1:3", "--format", "json"];
    assert_cmd_snapshot!("figure_11_as_json", two_impact(&figure_11));
}

#[test]
fn the_command_line() {
    assert_cmd_snapshot!("arguments_of_two_impact", two_impact(&["--help"]));
    let scene = "scenes/figure-10.toml";
    assert_cmd_snapshot!("cycles_out_of_order", two_impact(&[scene, "--cycles", "5..1"]));
    assert_cmd_snapshot!("manifold_without_a_count", two_impact(&[scene, "--manifold", "frequency=1..2"]));
    assert_cmd_snapshot!("manifold_over_rest", two_impact(&[scene, "--manifold", "velocity=-1..1:3"]));
    assert_cmd_snapshot!(
        "manifold_of_even_cycles",
        two_impact(&[scene, "--manifold", "frequency=1..2:3", "--cycles", "2"])
    );
    assert_cmd_snapshot!("motions_as_csv", two_impact(&[scene, "--format", "csv"]));
    assert_cmd_snapshot!("inset_of_one_range", two_impact(&[scene, "--plot", "a.svg", "--inset", "1..2"]));
    assert_cmd_snapshot!("plot_without_manifold", two_impact(&[scene, "--plot", "a.svg"]));
    assert_cmd_snapshot!("speed_of_a_start_inside", two_impact(&["scenes/graze.toml", "--solve-for", "gap"]));
}
