//! Scene files: what they say, what is refused, and how they are flown.

use std::error::Error;

use impact_pair::ErrorKind;
use impact_pair::exact::{Exact, ExactError, ParseError};
use impact_pair::orbit::{Impact, Orbit, Place, Settings};
use impact_pair::pair::Wall;
use impact_pair::scene::{Key, Over, Range, Scene};
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

/// Lines in the place of others, `\\` between two of them, with the message that refuses each, or its
/// beginning before `...`; `NUMBER` is what a number must be.
const REFUSED: &str = r#"
restitution = 0.5 | restitution = 1.2 | line 8: pair.restitution is 1.2, but must lie in [0, 1]
restitution = 0.5 | restitution = -1e-300 | line 8: pair.restitution is -1e-300, but must lie in [0, 1]
restitution = 0.5 | restitution = "[0.5, 1.0001]" | line 8: pair.restitution is [0.5, 1.0001], but must lie in [0, 1]
restitution = 0.5 | restitution = 0.5\\restitition = 0.6 | line 9: pair.restitition is 0.6, but is not a key of [pair]: accepted are gap (d), restitution (e); did you mean `restitution`?
restitution = 0.5 | | line 6: pair.restitution is missing, but must be NUMBER
gap = 9.42497 | gap = 0 | line 7: pair.gap is 0, but must be greater than 0
gap = 9.42497 | gap = -9.42497 | line 7: pair.gap is -9.42497, but must be greater than 0
gap = 9.42497 | gap = "-3*pi" | line 7: pair.gap is -3*pi, but must be greater than 0
gap = 9.42497 | gap = 9.42497\\bounce = 0.5 | line 8: pair.bounce is 0.5, but is not a key of [pair]: accepted are gap (d), restitution (e)
gap = 9.42497 | d = -1 | line 7: pair.gap is -1, but must be greater than 0
gap = 9.42497 | gap = 9\\d = 9 | line 8: pair.gap is 9, but pair.d and pair.gap, on line 7, are one key: give one of them
amplitude = 8 | A = 8\\amplitude = 8 | line 4: excitation.amplitude is 8, but excitation.amplitude and excitation.A, on line 3, are one key: give one of them
frequency = "pi" | W = "pi"\\angular-frequency = 3 | line 5: excitation.frequency is 3, but excitation.angular-frequency and excitation.W, on line 4, are one key: give one of them
gap = 9.42497 | gap = 9.42497\\A = 1 | line 8: pair.A is 1, but is not a key of [pair]: accepted are gap (d), restitution (e); did you mean `excitation.amplitude`?
gap = 9.42497 | gap = 9\\gap = 10 | line 8: duplicate key in `gap = 10`
gap = 9.42497 | gap = true | line 7: pair.gap is true, but must be NUMBER
gap = 9.42497 | gap = 1979-05-27 | line 7: pair.gap is 1979-05-27, but must be NUMBER
gap = 9.42497 | gap = [1] | line 7: pair.gap is [1], but must be NUMBER
gap = 9.42497 | gap = { value = 1 } | line 7: pair.gap is { value = 1 }, but must be NUMBER
gap = 9.42497 | gap = nan | line 7: pair.gap is nan, but does not read as a number: column 1: found `nan`, accepted are finite real numbers only
gap = 9.42497 | gap = "nan" | line 7: pair.gap is "nan", but does not read as a number: column 1: found `nan`...
gap = 9.42497 | gap = "3*pie" | line 7: pair.gap is "3*pie", but does not read as a number: column 3: found `pie`...
gap = 9.42497 | gap = "" | line 7: pair.gap is "", but does not read as a number: column 1: found the end...
gap = 9.42497 | gap = 0x10 | line 7: pair.gap is 0x10, but does not read as a number: column 2: found `x10`...
gap = 9.42497 | gap = "1/0" | line 7: pair.gap is "1/0", but does not read as a number: column...
gap = 9.42497 | gap = "[3, 2]" | line 7: pair.gap is "[3, 2]", but does not read as a number: column...
gap = 9.42497 | gap = "8 mm" | line 7: pair.gap is "8 mm", but does not read as a number: column 3: found `mm`, accepted are `+`, `-`, `*`, `/`, `^` or the end; numbers have no units here: use one unit of length and one of time throughout
gap = 9.42497 | gap = 9,42497 | line 7: unexpected key or value, expected newline, `#` in `gap = 9,42497`; did you mean `gap = 9.42497`?
amplitude = 8 | amplitude = -8 | line 3: excitation.amplitude is -8, but must be at least 0
amplitude = 8 | amplitude = [1, "1/3"] | line 4: excitation.frequency is "pi", but has 1 term, must have 2 like excitation.amplitude
frequency = "pi" | frequency = 0.0 | line 4: excitation.frequency is 0.0, but must be greater than 0
frequency = "pi" | frequency = "-pi" | line 4: excitation.frequency is -pi, but must be greater than 0
frequency = "pi" | frequency = "2pi" | line 4: excitation.frequency is "2pi", but does not read as a number: column 2: found `pi`, accepted are `+`, `-`, `*`, `/`, `^` or the end; did you mean `2*pi`?
frequency = "pi" | frequency = 2*pi | line 4: string values must be quoted, expected literal string in `frequency = 2*pi`; did you mean `frequency = "2*pi"`?
velocity = -12.56636 | velocity = 1e-9 | line 12: start.velocity is 1e-9, but on the left wall it must be at most 0
velocity = -12.56636 | velocity = -inf | line 12: start.velocity is -inf, but does not read as a number: column 2: found `inf`, accepted are finite real numbers only
wall = "left" | wall = "right" | line 12: start.velocity is -12.56636, but on the right wall it must be at least 0
wall = "left" | wall = "top" | line 11: start.wall is "top", but must be "left" or "right"
wall = "left" | wall = "Left" | line 11: start.wall is "Left", but must be "left" or "right"; did you mean `"left"`?
wall = "left" | wall = left | line 11: string values must be quoted, expected literal string in `wall = left`; did you mean `wall = "left"`?
wall = "left" | wall = 1 | line 11: start.wall is 1, but must be "left" or "right"
wall = "left" | | line 9: start.wall is missing, but must be "left" or "right", or start.position be given
wall = "left" | wall = "left"\\position = 0 | line 12: start.position is 0, but start.wall is given too, on line 11: a start has one or the other
wall = "left" | position = 5 | line 11: start.position is 5, but must lie strictly between the walls at -d/2 and d/2 (on a wall: give start.wall)
wall = "left" | position = "-9.42497/2" | line 11: start.position is -9.42497/2, but must lie strictly between the walls at -d/2 and d/2 (on a wall: give start.wall)
title = "Figure 14" | title = 14 | line 1: title is 14, but must be a string
title = "Figure 14" | title = "a\u001b[31m" | line 1: title is "a\u001b[31m", but must be one line without control characters
[run] | [ran] | line 13: ran is [ran], but is not a key of a scene: accepted are title, excitation, pair, start, run; did you mean `run`?
[run] | [chart] | line 13: chart is [chart], but is not a key of a scene: accepted are title, excitation, pair, start, run
impacts = 20 | impacts = -1 | line 14: run.impacts is -1, but must be an integer of at least 0
impacts = 20 | impacts = 2.5 | line 14: run.impacts is 2.5, but must be an integer of at least 0
impacts = 20 | impacts = "20" | line 14: run.impacts is "20", but must be an integer of at least 0
impacts = 20 | until = "[1, 2]" | line 14: run.until is "[1, 2]", but must be a single number, not an interval
digits = 9 | digits = 0 | line 15: run.digits is 0, but must be an integer from 1 to 400
digits = 9 | digits = 401 | line 15: run.digits is 401, but must be an integer from 1 to 400
"#;
const NUMBER: &str = "a number, or a string with an expression (\"3*pi\") or an interval (\"[9.42, 9.43]\")";

fn refusal(text: &str) -> String {
    let error = Scene::parse(text).expect_err(text);
    assert!(matches!(error.kind(), ErrorKind::Scene | ErrorKind::OutOfRange));
    // The excerpt is the line that the message names.
    let message = error.to_string();
    let line =
        message.strip_prefix("line ").and_then(|rest| rest.split_once(':')).map(|(line, _)| line.parse().unwrap());
    assert_eq!(error.excerpt().map(|own| own.line()), line, "{message}");
    assert!(error.excerpt().is_none_or(|own| text.lines().nth(own.line() - 1) == Some(own.text())), "{message}");
    message
}

#[test]
fn what_a_scene_may_not_say_is_refused_with_its_line() {
    for case in REFUSED.trim().lines() {
        let [line, by, expected] = case.splitn(3, '|').collect::<Vec<_>>()[..] else { panic!("{case}") };
        let expected = expected.trim_start().replace("NUMBER", NUMBER);
        let refused = refusal(&with(line.trim(), &by.trim().replace("\\\\", "\n")));
        let is_it = expected.strip_suffix("...").map_or(refused == expected, |begin| refused.starts_with(begin));
        assert!(is_it, "{refused}\n{expected}");
    }
    for line in ["gap = = 2", "gap 2", "gap = 123456789012345678901234567890", "gap = 1e400"] {
        let refused = refusal(&with("gap = 9.42497", line));
        assert!(refused.starts_with("line 7: ") && refused.contains(line), "{refused}");
    }
    let no_pair = FIGURE_14.replace("[pair]\ngap = 9.42497\nrestitution = 0.5\n", "");
    assert_eq!(refusal(&no_pair), "line 12: pair is missing, but must be a table with gap (d), restitution (e)");
    let elsewhere = with("title = \"Figure 14\"", "pair = 3").replace("[pair]", "[run.pair]");
    assert_eq!(refusal(&elsewhere), "line 1: pair is 3, but must be one table with gap (d), restitution (e)");
    assert_eq!(
        refusal(""),
        "excitation is missing, but must be a table with amplitude (A), frequency (W, angular-frequency), phase (tau)"
    );
}

/// The letters in which results are printed stand for the names of parameters: also of several terms, and where they vary.
#[test]
fn letters_stand_for_the_names_of_parameters() {
    let in_letters = FIGURE_14
        .replace("amplitude =", "A =")
        .replace("frequency =", "W =")
        .replace("phase =", "tau =")
        .replace("gap =", "d =")
        .replace("restitution =", "e =");
    let [own, other] = [FIGURE_14, &in_letters].map(|text| Scene::parse(text).unwrap());
    assert_eq!(own.pair().in_words(), other.pair().in_words());
    let several = with("amplitude = 8", "A = [1, 2]").replace("frequency = \"pi\"", "angular-frequency = [3, 4]");
    let several = Scene::parse(&several).unwrap();
    assert!(several.pair().in_words().starts_with("A = (1, 2), W = (3, 4)"));
    let varied =
        several.with(&[("A.2".parse().unwrap(), Exact::from(5)), ("e".parse().unwrap(), Exact::from(1))]).unwrap();
    assert!(varied.pair().in_words().starts_with("A = (1, 5), ") && varied.pair().in_words().ends_with("e = 1"));
}

/// `A/d` is the amplitude at the scene's own gap, exactly; a gap that is an interval, or that varies as well, is refused.
#[test]
fn a_ratio_varies_the_amplitude_while_the_gap_stays() {
    let over = |text: &str| Over::parse(text, "KEY=LO..HI", |_| true);
    let range = |text: &str, scene: &str| -> Result<Vec<Range>, impact_pair::Error> {
        Over::all(&[over(text)?], Scene::parse(scene)?.pair())
    };
    let ranges = range("A/d=1/3..0.5:4", FIGURE_14).unwrap();
    assert_eq!((ranges[0].key(), ranges[0].count()), (Key::Amplitude(None), Some(4)));
    let third = Exact::parse("9.42497/3").unwrap();
    assert_eq!(ranges[0].low().as_rational(), third.as_rational());
    assert_eq!(ranges[0].high().text(), "4.712485");
    let interval = range("A/d=1..2", &with("gap = 9.42497", "gap = \"[9, 10]\"")).unwrap_err().to_string();
    assert_eq!(interval, "pair.gap is [9, 10], but must be a single number where A/d varies");
    let both = [over("d=9..10").unwrap(), over("A/d=1..2").unwrap()];
    let both = Over::all(&both, Scene::parse(FIGURE_14).unwrap().pair()).unwrap_err().to_string();
    assert!(both.contains("over A/d=1..2 the gap stays, but another range is of the gap"), "{both}");
    assert!("A/d".parse::<Key>().is_err() && over("A/e=1..2").is_err());
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
