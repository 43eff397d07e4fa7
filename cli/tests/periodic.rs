//! Snapshots of `impact-pair periodic`: stdout, stderr and exit code together.

use crate::common;
use crate::common::{UNCERTAIN, snapshots, verb};
use insta_cmd::assert_cmd_snapshot;

/// `impact-pair periodic` with these arguments.
fn periodic(arguments: &[&str]) -> std::process::Command {
    verb("periodic", arguments)
}

snapshots! { UNCERTAIN;
    figure_12_as_a_table: periodic(&["scenes/figure-12.toml", "--word", "P1 P2", "--cycles", "1"]);
    figure_13_all_as_json: periodic(&["scenes/figure-13.toml", "--word", "LR", "--cycles", "1", "--all", "--format", "json"]);
    figure_15_its_double: periodic(&["scenes/figure-15.toml", "--word", "RRLLLRRLLL", "--cycles", "2"]);
    figure_12_in_thirty_digits: periodic(&["scenes/figure-12.toml", "--word", "LR", "--cycles", "1", "--digits", "30"]);
    model_two_has_no_orbit: periodic(&["scenes/figure-12.toml", "--word", "P3", "--cycles", "1", "--all"]);
    a_word_that_none_is_found_of: periodic(&["scenes/figure-12.toml", "--word", "LLR", "--cycles", "1", "--format", "json"]);
    a_word_that_is_not_closed: periodic(&["scenes/figure-12.toml", "--word", "P2", "--cycles", "1"]);
    a_word_that_is_none: periodic(&["scenes/figure-12.toml", "--word", "P5", "--cycles", "1"]);
    no_cycles: periodic(&["scenes/figure-12.toml", "--word", "LR", "--cycles", "0"]);
    arguments_of_periodic: periodic(&["--help"]);
}

/// Two harmonics with a common period of three forcing periods; the second frequency is to be filled in.
fn two_harmonics(frequency: &str) -> String {
    format!(
        "excitation = {{ amplitude = [1, \"1/2\"], frequency = [\"pi\", \"{frequency}\"], phase = 0 }}\n\
         pair = {{ gap = 9.42497, restitution = 0.5 }}\n\
         start = {{ time = 0, wall = \"left\", velocity = -12 }}\n"
    )
}

macro_rules! snapshots_of_two_harmonics {
    ($($name:ident: $frequency:expr, $arguments:expr;)*) => {
        $(#[test]
        fn $name() {
            let mut command = periodic(&[&["-", "--word", "LR"][..], &$arguments].concat());
            insta::with_settings!({ filters => UNCERTAIN.to_vec() }, {
                assert_cmd_snapshot!(stringify!($name), command.pass_stdin(two_harmonics($frequency)));
            });
        })*
    };
}

snapshots_of_two_harmonics! {
    two_harmonics_as_a_table: "3*pi", ["--cycles", "3"];
    two_harmonics_that_are_not_odd: "2*pi", ["--cycles", "2", "--format", "json"];
    two_harmonics_in_part_of_a_period: "3*pi", ["--cycles", "4"];
    two_harmonics_without_a_period: "sqrt(2)*pi", ["--cycles", "1"];
    two_harmonics_and_all: "3*pi", ["--cycles", "3", "--all"];
}

/// A list without its witness is as complete, but `check` cannot prove it.
#[test]
fn a_list_without_its_witness_is_not_proved_to_be_complete() {
    let folder = tempfile::tempdir().unwrap();
    let checked = |arguments: &[&str]| {
        let path = folder.path().join("orbits.json");
        let target = path.to_str().unwrap();
        let all =
            ["scenes/figure-13.toml", "--word", "LR", "--cycles", "1", "--all", "--format", "json", "--output", target];
        assert!(periodic(&[&all[..], arguments].concat()).output().unwrap().status.success());
        let check = common::verb("check", &[target]).output().unwrap();
        (std::fs::read_to_string(&path).unwrap(), String::from_utf8(check.stdout).unwrap())
    };
    let (whole, proved) = checked(&[]);
    assert!(
        whole.contains("\"witness\":{\"tree\":")
            && proved.starts_with("confirmed: 2 orbits, and that there are no others")
    );
    let (without, proved) = checked(&["--no-witness"]);
    assert!(!without.contains("witness") && proved.starts_with("confirmed, but not: exhaustive"), "{proved}");
}

/// `--output` writes the document whole, and the JSON says what the table says.
#[test]
fn the_document_goes_to_the_requested_output() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("orbits.json");
    let target = path.to_str().unwrap();
    let arguments = ["scenes/figure-15.toml", "--word", "RRLLL", "--cycles", "1", "--all", "--format", "json"];
    let answer = periodic(&[&arguments[..], &["--output", target]].concat()).output().unwrap();
    assert!(answer.status.success() && answer.stdout.is_empty());
    let document: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    assert_eq!((document["certified"].as_bool(), document["exhaustive"].as_bool()), (Some(true), Some(true)));
    assert_eq!(document["word"], "P2 P4 P4 P1 P3");
    let eigenvalue = document["orbits"][0]["eigenvalues"][0]["re"][0].as_str().unwrap();
    assert!(eigenvalue.starts_with("-1.0021045"), "{eigenvalue}");
}

/// Ctrl-C keeps the orbits that are proved and says that the search is not complete.
#[cfg(unix)]
#[test]
fn an_interrupted_search_keeps_what_is_proved() {
    // Twelve rounds of the cascade's orbits are proved at once; that there are no other orbits is not.
    let word = "LR".repeat(12);
    let command = || periodic(&["scenes/cascade.toml", "--word", &word, "--cycles", "12", "--all", "--format", "json"]);
    let document = |answer: &std::process::Output| serde_json::from_slice::<serde_json::Value>(&answer.stdout);
    let is_within = |answer: &_| document(answer).is_ok_and(|it| !it["orbits"].as_array().unwrap().is_empty());
    let answer = common::interrupted_within(command, || true, is_within);
    let document = document(&answer).unwrap();
    let said = String::from_utf8(answer.stderr).unwrap();
    assert_eq!(answer.status.code(), Some(1), "{said}");
    assert!(said.contains("proved; interrupted, ") && said.contains("may hold others"), "{said}");
    assert_eq!((document["certified"].as_bool(), document["exhaustive"].as_bool()), (Some(false), Some(false)));
    assert!(document["undecided"].is_array());
}
