//! `impact-pair global`: snapshots, and documents that are checked.

#![cfg(feature = "multiprecision")]

use std::fs;

use crate::common::{EXACT, folder, program, snapshots};

snapshots! { EXACT;
    arguments_of_global: program(&["global", "--help"]);
    global_of_figure_12: program(&["global", "scenes/figure-12.toml", "--boxes", "12", "--most", "30000"]);
    global_under_two_harmonics: program(&["global", "scenes/two-tones.toml"]);
    global_of_too_many_boxes: program(&["global", "scenes/figure-12.toml", "--boxes", "21"]);
}

/// A cycle with rests, which all motions come to: confirmed; with another period, or without it: not.
#[test]
fn a_global_analysis_is_checked() {
    let folder = folder("global");
    let [scene, path] = ["scene.toml", "global.json"].map(|name| folder.join(name).to_str().unwrap().to_owned());
    let text = "excitation = { amplitude = 2, frequency = 3, phase = 0.7 }\npair = { gap = 1, restitution = 0.2 }\n\
                start = { time = 0, wall = \"left\", velocity = -1 }\n";
    fs::write(&scene, text).unwrap();
    assert!(program(&["global", &scene, "--output", &path, "--quiet"]).status().unwrap().success());
    let text = fs::read_to_string(&path).unwrap();
    assert!(
        text.contains("every motion that touches a wall ends in one cycle with rests, of 1 forcing period"),
        "{text}"
    );
    let says = |text: &str, words: &str| {
        fs::write(&path, text).unwrap();
        let said = String::from_utf8(program(&["check", &path]).output().unwrap().stdout).unwrap();
        assert!(said.starts_with(words), "{said}");
    };
    says(&text, "confirmed: 1 component, and that every motion is in one of them in the end");
    let other = text.replace("\"cycles\":1", "\"cycles\":2").replace("of 1 forcing period", "of 2 forcing periods");
    says(&other, "refuted");
    says(&text.replace("one-rest-cycle", "one-attractor"), "refuted");
}
