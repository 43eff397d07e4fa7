//! `impact-pair tangency`: snapshots, and a document that is checked.

use std::fs;

use crate::common::{self, EXACT, UNCERTAIN, folder, program, snapshots};

const OVER_GAP: [&str; 4] = ["tangency", "scenes/figure-14.toml", "--over", "gap=9.4249..9.4252"];
const WORD: [&str; 2] = ["--word", "FFFFFFFNFFFFFNFFNFFNFFFF"];

const FAMILY: [&str; 4] = ["tangency", "docs/tangencies/family.toml", "--over", "gap=9.425..9.4253"];

fn run_with(more: &[&str]) -> std::process::Command {
    program(&[&OVER_GAP[..], more].concat())
}

snapshots! { EXACT;
    arguments_of_tangency: program(&["tangency", "--help"]);
    tangency_of_another_word: run_with(&["--word", "FFFFFFFNFFFFFNFFNFFNFFFN"]);
    tangency_of_a_word_that_is_none: run_with(&["--word", "FFX"]);
    tangency_of_little_effort: run_with(&["--effort", "1e-7"]);
    tangency_over_the_frequency: program(&["tangency", "scenes/figure-14.toml", "--over", "frequency=1..4"]);
    tangency_under_two_harmonics: program(&["tangency", "scenes/two-tones.toml", "--over", "gap=1..2", "--longest", "1"]);
}

snapshots! { UNCERTAIN;
    the_first_tangency_of_figure_14: run_with(&[&WORD[..], &["--digits", "30"]].concat());
    a_family_of_tangencies: program(&[&FAMILY[..], &WORD[..]].concat());
}

#[test]
fn a_tangency_of_figure_14_is_drawn() {
    let picture = folder("tangency").join("tangency.svg").to_str().unwrap().to_owned();
    assert!(run_with(&[&WORD[..], &["--plot", &picture, "--quiet"]].concat()).status().unwrap().success());
    assert!(fs::read_to_string(&picture).unwrap().contains("a homoclinic tangency"));
}

/// Without --over the gaps next to that of the scene are searched.
#[test]
fn i58_a_range_need_not_be_given() {
    let near = program(&["tangency", "scenes/figure-14.toml", WORD[0], WORD[1]]).output().unwrap();
    let said = String::from_utf8(near.stdout).unwrap();
    assert!(said.contains("over pair.gap from 9.424027503 to 9.425912497\n"), "{said}");
    assert!(near.status.success() && said.contains("pair.gap = 9.42512637688720"), "{said}");
    let interval = common::scene("figure-14.toml").replace("gap = 9.42497", "gap = \"[9.4249, 9.425]\"");
    let path = folder("tangency-interval").join("scene.toml");
    fs::write(&path, interval).unwrap();
    let refused = program(&["tangency", path.to_str().unwrap()]).output().unwrap();
    assert_eq!(refused.status.code(), Some(2));
    assert!(refused.stderr.starts_with(b"error: --over is missing, but pair.gap is the interval [9.4249, 9.425]"));
}
