//! Scene files: what they say, what is refused, and how they are flown.

use std::error::Error;

use impact_pair::ErrorKind;
use impact_pair::exact::{Exact, ExactError, ParseError};
use impact_pair::orbit::{Impact, Orbit, Place, Settings};
use impact_pair::pair::Wall;
use impact_pair::scene::Scene;
use impact_pair_certificate::Certificate;

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

fn refusal(text: &str) -> String {
    let error = Scene::parse(text).expect_err(text);
    assert!(matches!(error.kind(), ErrorKind::Scene | ErrorKind::OutOfRange));
    error.to_string()
}

#[test]
fn numbers_are_the_decimals_that_are_written() {
    let scene = Scene::parse(&with("gap = 9.42497", "gap = +9.424_970_000_000_000_000_000_1")).unwrap();
    let gap = scene.pair().gap();
    assert_eq!(gap.text(), "+9.424_970_000_000_000_000_000_1");
    assert_eq!(gap.as_rational(), "9.4249700000000000000001".parse::<Exact>().unwrap().as_rational());
    assert_eq!(scene.title(), Some("Figure 14"));
    assert_eq!(scene.pair().excitation().reference().frequency().text(), "pi");
    assert!(matches!(scene.start().place(), Place::Wall(Wall::Left)));
    assert_eq!((scene.settings().impacts, scene.settings().digits), (Some(20), 9));
}

#[test]
fn strings_are_expressions_and_intervals() {
    let scene = Scene::parse(&with("gap = 9.42497", "gap = \"[9.42, 3*pi]\"")).unwrap();
    assert!(!scene.pair().gap().is_point());
    let scene = Scene::parse(&with("wall = \"left\"", "position = \"-9.42497/4\"")).unwrap();
    assert!(matches!(scene.start().place(), Place::Inside(_)));
}

#[test]
fn a_hundred_impacts_unless_the_scene_says_where_to_stop() {
    let settings = |run: &str| Scene::parse(&with("impacts = 20", run)).unwrap().settings();
    assert_eq!(settings("").impacts, Some(100));
    assert_eq!(settings("impacts = 0").impacts, Some(0));
    let until = settings("until = \"100*pi\"");
    assert_eq!((until.impacts, until.until.unwrap().text()), (None, "100*pi".into()));
    let both = settings("until = 5.5\nimpacts = 3");
    assert_eq!((both.impacts, both.until.unwrap().text()), (Some(3), "5.5".into()));
    assert_eq!(Scene::parse(FIGURE_14.split("[run]").next().unwrap()).unwrap().settings().impacts, Some(100));
}

#[test]
fn values_out_of_range_are_named_with_their_line() {
    let cases = [
        ("restitution = 0.5", "restitution = 1.2", "line 8: pair.restitution is 1.2, but must lie in [0, 1]"),
        ("restitution = 0.5", "restitution = -0.1", "line 8: pair.restitution is -0.1, but must lie in [0, 1]"),
        (
            "restitution = 0.5",
            "restitution = \"[0.9, 1.1]\"",
            "line 8: pair.restitution is [0.9, 1.1], but must lie in [0, 1]",
        ),
        ("gap = 9.42497", "gap = 0", "line 7: pair.gap is 0, but must be greater than 0"),
        ("gap = 9.42497", "gap = \"-3*pi\"", "line 7: pair.gap is -3*pi, but must be greater than 0"),
        ("amplitude = 8", "amplitude = -8", "line 3: excitation.amplitude is -8, but must be at least 0"),
        ("frequency = \"pi\"", "frequency = 0.0", "line 4: excitation.frequency is 0.0, but must be greater than 0"),
        (
            "velocity = -12.56636",
            "velocity = 12.56636",
            "line 12: start.velocity is 12.56636, but on the left wall it must be at most 0",
        ),
        (
            "wall = \"left\"",
            "wall = \"right\"",
            "line 12: start.velocity is -12.56636, but on the right wall it must be at least 0",
        ),
    ];
    for (line, by, message) in cases {
        assert_eq!(refusal(&with(line, by)), message);
    }
    let outside = refusal(&with("wall = \"left\"", "position = 4.712485"));
    assert!(outside.starts_with("line 11: start.position is 4.712485, but must lie strictly between"), "{outside}");
}

#[test]
fn a_text_that_is_no_number_is_named_with_its_line() {
    let number = "but must be a number, or a string with an expression (\"3*pi\") or an interval (\"[9.42, 9.43]\")";
    for value in ["true", "1979-05-27", "[1]", "{ value = 1 }"] {
        let refused = refusal(&with("gap = 9.42497", &format!("gap = {value}")));
        assert_eq!(refused, format!("line 7: pair.gap is {value}, {number}"));
    }
    for value in ["nan", "-inf", "\"nan\"", "\"10*pie\"", "\"\"", "0x10", "\"1/0\"", "\"[3, 2]\""] {
        let refused = refusal(&with("gap = 9.42497", &format!("gap = {value}")));
        let expected = format!("line 7: pair.gap is {value}, but does not read as a number: column ");
        assert!(refused.starts_with(&expected), "{refused}");
    }
}

#[test]
fn several_terms_need_equally_many_frequencies_and_one_phase_or_equally_many() {
    let two = with("amplitude = 8", "amplitude = [8, \"1/3\"]")
        .replace("frequency = \"pi\"", "frequency = [\"pi\", \"3*pi\"]");
    let terms = |text: &str| Scene::parse(text).unwrap().pair().excitation().terms().to_vec();
    assert_eq!(terms(&two).iter().map(|term| term.phase().text()).collect::<Vec<_>>(), ["0", "0"]);
    let phases = two.replace("phase = 0", "phase = [0, \"pi/2\"]");
    assert_eq!(terms(&phases)[1].phase().text(), "pi/2");
    for (key, value, message) in [
        (
            "amplitude = [8, \"1/3\"]",
            "amplitude = 8",
            "line 4: excitation.frequency is [\"pi\", \"3*pi\"], but has 2 terms, must have 1",
        ),
        (
            "phase = 0",
            "phase = [0]",
            "line 5: excitation.phase is [0], but has 1 term, must have 2 like excitation.amplitude, or be",
        ),
        ("phase = 0", "phase = []", "line 5: excitation.phase is [], but must have a term"),
        ("\"1/3\"", "-1", "line 3: excitation.amplitude is -1, but must be at least 0"),
    ] {
        let refused = refusal(&two.replace(key, value));
        assert!(refused.starts_with(message), "{refused}");
    }
}

#[test]
fn unknown_missing_and_duplicate_keys_are_named() {
    let cases = [
        (
            with("gap = 9.42497", "gap = 9.42497\nbounce = 0.5"),
            "line 8: pair.bounce is 0.5, but is not a key of [pair]: accepted are gap, restitution",
        ),
        (
            with("[run]", "[chart]"),
            "line 13: chart is [chart], but is not a key of a scene: accepted are title, excitation, pair, start, run",
        ),
        (
            with("gap = 9.42497", ""),
            "line 6: pair.gap is missing, but must be a number, or a string with an expression (\"3*pi\") or an interval (\"[9.42, 9.43]\")",
        ),
        (
            with("wall = \"left\"", ""),
            "line 9: start.wall is missing, but must be \"left\" or \"right\", or start.position be given",
        ),
        (
            with("wall = \"left\"", "wall = \"left\"\nposition = 0"),
            "line 12: start.position is 0, but start.wall is given too, on line 11: a start has one or the other",
        ),
        (
            with("wall = \"left\"", "wall = \"middle\""),
            "line 11: start.wall is \"middle\", but must be \"left\" or \"right\"",
        ),
        (with("wall = \"left\"", "wall = 1"), "line 11: start.wall is 1, but must be \"left\" or \"right\""),
        (with("gap = 9.42497", "gap = 9\ngap = 10"), "line 8: duplicate key in `gap = 10`"),
        (with("title = \"Figure 14\"", "title = 14"), "line 1: title is 14, but must be a string"),
        (
            with("title = \"Figure 14\"", r#"title = "a\u001b[31m""#),
            r#"line 1: title is "a\u001b[31m", but must be one line without control characters"#,
        ),
        (
            with("title = \"Figure 14\"", "pair = 3").replace("[pair]", "[run.pair]"),
            "line 1: pair is 3, but must be one table with gap, restitution",
        ),
    ];
    for (text, message) in cases {
        assert_eq!(refusal(&text), message);
    }
    let no_pair = FIGURE_14.replace("[pair]\ngap = 9.42497\nrestitution = 0.5\n", "");
    assert_eq!(refusal(&no_pair), "line 12: pair is missing, but must be a table with gap, restitution");
}

#[test]
fn the_run_table_is_checked() {
    let cases = [
        ("impacts = 20", "impacts = -1", "line 14: run.impacts is -1, but must be an integer of at least 0"),
        ("impacts = 20", "impacts = 2.5", "line 14: run.impacts is 2.5, but must be an integer of at least 0"),
        ("impacts = 20", "impacts = \"20\"", "line 14: run.impacts is \"20\", but must be an integer of at least 0"),
        ("digits = 9", "digits = 0", "line 15: run.digits is 0, but must be an integer from 1 to 400"),
        ("digits = 9", "digits = 401", "line 15: run.digits is 401, but must be an integer from 1 to 400"),
        (
            "impacts = 20",
            "until = \"[1, 2]\"",
            "line 14: run.until is \"[1, 2]\", but must be a single number, not an interval",
        ),
    ];
    for (line, by, message) in cases {
        assert_eq!(refusal(&with(line, by)), message);
    }
}

#[test]
fn invalid_toml_is_shown_with_its_line() {
    for (line, number) in
        [("gap = = 2", 7), ("gap 2", 7), ("gap = 123456789012345678901234567890", 7), ("gap = 1e400", 7)]
    {
        let refused = refusal(&with("gap = 9.42497", line));
        assert!(refused.starts_with(&format!("line {number}: ")) && refused.contains(line), "{refused}");
    }
    assert!(refusal("").starts_with("excitation is missing"));
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
    let far = |until: &str| Settings { until: Some(until.parse().unwrap()), ..scene.settings() };
    // r46: 2^62 forcing periods of 2 are 9.22e18; the error named 2^400 of them.
    let error = Orbit::of(&scene, far("1e19")).unwrap_err().to_string();
    assert_eq!(error, "run.until is 1e19, but accepted are times less than 2^62 forcing periods from the start");
    assert!(Orbit::of(&scene, far("9e18")).is_ok());
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

/// Errors keep their causes, for programs as well.
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
