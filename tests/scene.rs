//! Scene files, flown.

use std::error::Error;

use impact_pair::certificate::Certificate;
use impact_pair::exact::{ExactError, ParseError};
use impact_pair::orbit::{Impact, Orbit, Settings};
use impact_pair::scene::Scene;

const FIGURE_14: &str = r#"title = "Figure 14"
[excitation]
amplitude = 8
frequency = "pi"
phase = 0
[pair]
gap = 9.42497
restitution = 0.5
[start]
time = 0
wall = "left"
velocity = -12.56636
[run]
impacts = 20
digits = 9
"#;

/// Figure 14 with one line replaced.
fn with(line: &str, by: &str) -> String {
    assert!(FIGURE_14.contains(&format!("{line}\n")), "{line}");
    FIGURE_14.replacen(&format!("{line}\n"), &format!("{by}\n"), 1)
}

#[test]
fn tables_may_be_written_in_every_way_of_toml() {
    let text = "excitation = { amplitude = [8], frequency = [\"pi\"], phase = [0] }\r\npair.gap = 9.42497\r\n\
                pair.restitution = 0.5\r\nstart = { time = 0, wall = \"left\", velocity = -12.56636 }\r\n";
    let impacts = |text: &str| -> Vec<Impact> {
        let scene = Scene::parse(text).unwrap();
        Orbit::of(&scene, Settings { impacts: Some(20), ..scene.settings() }).unwrap().collect()
    };
    assert_eq!(impacts(text), impacts(FIGURE_14));
}

#[test]
fn values_beyond_double_precision_flights_are_named_with_their_line() {
    let scene = Scene::parse(&with("velocity = -12.56636", "velocity = -1e200")).unwrap();
    let error = Orbit::of(&scene, scene.settings()).unwrap_err().to_string();
    assert!(error.starts_with("line 12: start.velocity is"), "{error}");
    let scene = Scene::parse(&with("amplitude = 8", "amplitude = 1e200")).unwrap();
    let error = Orbit::of(&scene, scene.settings()).unwrap_err().to_string();
    assert!(error.starts_with("line 3: excitation.amplitude / pair.gap is"), "{error}");
    // A time that the file does not hold has no line in it.
    let scene = Scene::parse(FIGURE_14).unwrap();
    let far = Settings { until: Some("1e300".parse().unwrap()), ..scene.settings() };
    let error = Orbit::of(&scene, far).unwrap_err().to_string();
    assert!(error.starts_with("run.until is 1e300"), "{error}");
}

/// Only ratios of lengths matter [P]: the very same doubles come out, whatever the unit of length.
#[test]
fn scaling_all_lengths_changes_neither_words_nor_phases() {
    let impacts = |text: &str| -> Vec<Impact> {
        let scene = Scene::parse(text).unwrap();
        Orbit::of(&scene, scene.settings()).unwrap().collect()
    };
    let start = "position = 0.25";
    let expected = (impacts(FIGURE_14), impacts(&with("wall = \"left\"", start)));
    assert!(expected.0.len() == 20 && expected.1.len() > 10);
    for factor in ["2^-1000", "2^7", "2^1000", "1e300", "1e-300"] {
        let scaled = |text: &str| {
            ["amplitude", "gap", "velocity", "position"].iter().fold(text.to_owned(), |text, key| {
                text.lines()
                    .map(|line| match line.split_once(" = ") {
                        Some((k, value)) if k == *key => format!("{k} = \"{value} * {factor}\"\n"),
                        _ => format!("{line}\n"),
                    })
                    .collect()
            })
        };
        assert_eq!(impacts(&scaled(FIGURE_14)), expected.0, "{factor}");
        assert_eq!(impacts(&scaled(&with("wall = \"left\"", start))), expected.1, "{factor}");
    }
}

/// What is refused says what it comes from, to programs as well.
#[test]
fn errors_keep_their_causes() {
    let refused = |line: &str, by: &str| Scene::parse(&with(line, by)).unwrap_err();
    let number = refused("gap = 9.42497", "gap = \"pie\"");
    let cause =
        number.source().and_then(|cause| cause.downcast_ref::<ParseError>()).expect("a text that does not read");
    assert!(cause.column() == 1 && number.to_string().contains(&cause.to_string()));
    let toml = refused("gap = 9.42497", "gap = = 2");
    assert!(toml.source().is_some_and(|cause| cause.to_string().contains("gap = = 2")));
    let json = Certificate::parse("{").unwrap_err();
    assert!(json.source().is_some_and(|cause| json.to_string().contains(&cause.to_string())));
    // A quotient that is beyond what expressions hold.
    let scene =
        Scene::parse(&with("amplitude = 8", "amplitude = \"(2^9999)^4\"").replace("9.42497", "\"(2^-9999)^4\""))
            .unwrap();
    let far = Orbit::of(&scene, scene.settings()).unwrap_err();
    assert_eq!(far.source().and_then(|cause| cause.downcast_ref::<ExactError>()), Some(&ExactError::TooLarge));
}
