//! `impact-pair describe`: snapshots, and what of a document may be relied on.

use std::fs;

use crate::common::{EXACT, folder, program, snapshots, words};
use serde_json::Value;

snapshots! { EXACT;
    description_of_figure_12: program(&["describe", "scenes/figure-12.toml"]);
    description_of_figure_14: program(&["describe", "scenes/figure-14.toml", "--depth", "3"]);
    description_of_chatter: program(&["describe", "scenes/chatter.toml"]);
    description_under_two_harmonics: program(&["describe", "scenes/two-tones.toml"]);
    description_of_no_impacts: program(&["describe", "scenes/figure-12.toml", "--impacts", "0"]);
    arguments_of_describe: program(&["describe", "--help"]);
}

/// A description as JSON, with its exit code.
fn described(arguments: &[&str]) -> (Value, Option<i32>) {
    let answer = program(&[&["describe", "--quiet", "--format", "json"], arguments].concat()).output().unwrap();
    (serde_json::from_slice(&answer.stdout).unwrap(), answer.status.code())
}

/// Each undecided question has a command that the program accepts, also where the name of the scene has spaces and quotes.
#[test]
fn a_command_that_goes_on_is_one_that_works() {
    let folder = folder("describe it's");
    let scene = folder.join("two tones.toml").to_str().unwrap().to_owned();
    // Chaos under tones with a common period: without one no convergence is asked for.
    let text = crate::common::scene("two-tones.toml").replace("sqrt(2)", "3/2").replace("[1, \"1/10\"]", "[8, 1]");
    fs::write(&scene, text).unwrap();
    let (document, code) = described(&[&scene, "--impacts", "20"]);
    assert_eq!((document["fate"]["kind"].as_str(), code), (Some("undecided"), Some(1)));
    let command = document["undecided"][0]["command"].as_str().unwrap();
    let bin = std::path::Path::new(env!("CARGO_BIN_EXE_impact-pair")).parent().unwrap();
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap());
    let again = std::process::Command::new("sh").args(["-c", command]).env("PATH", path).output().unwrap();
    let said = String::from_utf8(again.stdout).unwrap();
    assert!(
        again.status.code() == Some(1) && said.contains("undecided after 200 certified impacts"),
        "{command}: {said}"
    );
}

#[test]
fn the_page_has_four_panels() {
    let folder = folder("description");
    let path = folder.join("page.svg").to_str().unwrap().to_owned();
    let answer = program(&["describe", "scenes/figure-13.toml", "--plot", &path]).output().unwrap();
    assert!(answer.status.success(), "{answer:?}");
    let drawn = words(&fs::read_to_string(&path).unwrap());
    for title in
        ["(a)  time–displacement", "(b)  phase plane, relative", "(c)  switch-planes, relative", "(d)  itinerary"]
    {
        assert!(drawn.contains(title), "{title}");
    }
    assert!(drawn.contains("converges to a stable periodic orbit") && drawn.contains("P1 R→L"));
}

/// Results certified before Ctrl-C are kept.
#[cfg(unix)]
#[test]
fn ctrl_c_keeps_the_region() {
    use crate::common::interrupted_within;

    let command = || program(&["describe", "scenes/figure-14.toml", "--format", "json", "--quiet"]);
    let is_within = |answer: &std::process::Output| {
        let document: Value = serde_json::from_slice(&answer.stdout).unwrap_or_default();
        document["interrupted"] == true && document["fate"]["kind"] == "stays-in-region"
    };
    let answer = interrupted_within(command, || true, is_within);
    let document: Value = serde_json::from_slice(&answer.stdout).unwrap();
    assert_eq!((document["region"]["boxes"].as_u64(), answer.status.code()), (Some(431), Some(1)));
    assert!(document["entropy"].is_null(), "{document}");
}
