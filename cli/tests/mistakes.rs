//! Common mistakes on the command line: the message suggests the intended text.

use std::fs;

use crate::common::{folder, program};

const SCENE: &str = "scenes/figure-14.toml";

/// The message for a command line that is refused.
fn error_of(arguments: &[&str]) -> String {
    let done = program(arguments).output().unwrap();
    let error_of = String::from_utf8(done.stderr).unwrap();
    assert_eq!(done.status.code(), Some(2), "{arguments:?}: {error_of}");
    error_of
}

/// The scene of figure 14 with one text in the place of another one.
fn changed(name: &str, [from, to]: [&str; 2]) -> String {
    let text = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/figure-14.toml")).unwrap();
    assert!(text.contains(from));
    let path = folder("mistakes").with_file_name(name);
    fs::write(&path, text.replacen(from, to, 1)).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn r35_symbols_of_the_paper_lead_to_the_keys() {
    for (symbol, key) in [("a", "amplitude"), ("omega", "frequency"), ("D", "gap"), ("r", "restitution")] {
        let scene = changed(&format!("symbol-{symbol}.toml"), [&format!("{key} ="), &format!("{symbol} =")]);
        assert!(error_of(&["run", &scene]).contains(&format!("did you mean `{key}`?")), "{symbol}");
        for verb in [&["sweep", SCENE, "--over"][..], &["chaos", SCENE, "--over"]] {
            let range = format!("{symbol}=1..2:2");
            let error_of = error_of(&[verb, &[&range]].concat());
            assert!(error_of.contains(&format!("did you mean `{key}`?")), "{error_of}");
        }
    }
    for (symbol, key) in [("v", "start.velocity"), ("y0", "start.position"), ("Omega", "frequency")] {
        assert!(
            error_of(&["sweep", SCENE, "--over", &format!("{symbol}=-2..-1:2")])
                .contains(&format!("did you mean `{key}`?"))
        );
    }
    // In the wrong table as well.
    for (symbol, key) in [("A", "excitation.amplitude"), ("v0", "start.velocity")] {
        let scene = changed(&format!("table-{symbol}.toml"), ["gap =", &format!("{symbol} =")]);
        assert!(error_of(&["run", &scene]).contains(&format!("did you mean `{key}`?")), "{symbol}");
    }
}

#[test]
fn r35_values_of_over_are_the_options_and_not_the_files() {
    let bifurcations = ["bifurcations", SCENE, "--word", "RL", "--cycles", "1", "--over", "gap=-1..1"];
    for (arguments, range) in [
        (&["sweep", SCENE, "--over", "gap=-1..1:3"][..], "gap=-1..1:3"),
        (&["chaos", SCENE, "--over", "gap=-1..1"], "gap=-1..1"),
        (&["chaos", SCENE, "--over", "gap=-1..1:2"], "gap=-1..1:2"),
        (&bifurcations, "gap=-1..1"),
    ] {
        let error_of = error_of(arguments);
        assert!(error_of.starts_with(&format!("error: --over {range}: pair.gap is ")), "{error_of}");
    }
}

/// Lengths are in amplitudes there: the message names the amplitude and what is accepted, not a divisor.
#[test]
fn r49_where_lengths_are_in_amplitudes_the_amplitude_is_not_0() {
    for (name, amplitude) in [("still", "0"), ("may-be-still", "\"[0, 1]\"")] {
        let scene = changed(&format!("{name}.toml"), ["amplitude = 8", &format!("amplitude = {amplitude}")]);
        let value = amplitude.trim_matches('"');
        let cells = ["atlas", &scene, "--over", "gap=1..2:2", "--over", "restitution=0..1:2"];
        for arguments in [
            &["trap", &scene][..],
            &["chaos", &scene],
            &["chaos", &scene, "--over", "gap=1..2:2"],
            &["cycles", &scene, "--impacts", "1..2"],
            &["global", &scene],
            &["windows", &scene, "--over", "gap=1..2"],
            &["tangency", &scene, "--over", "gap=1..2"],
            &["tangency", &scene, "--over", "restitution=0.1..0.2"],
            &cells,
        ] {
            let error_of = error_of(arguments);
            let expected = format!("{scene}: excitation.amplitude is {value}, but must be greater than 0\n");
            assert_eq!(error_of, format!("error: {expected}"), "{arguments:?}");
        }
    }
    for verb in ["windows", "tangency", "chaos"] {
        let error_of = error_of(&[verb, SCENE, "--over", "amplitude=0..1"]);
        assert!(error_of.starts_with("error: --over amplitude=0..1: excitation.amplitude is "), "{error_of}");
    }
}

#[test]
fn r35_a_word_in_small_letters_leads_to_the_word() {
    let word = |word: &str| error_of(&["periodic", SCENE, "--word", word, "--cycles", "1"]);
    assert!(word("lr").contains("did you mean `LR`?"));
    assert!(word("p2 p1").contains("did you mean `P2 P1`?"));
    assert!(!word("xy").contains("did you mean"));
}

#[test]
fn r35_files_in_each_others_places_are_named() {
    let folder = folder("mistaken-files");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    fs::write(path("events.csv"), "time,wall\n0.5,right\n").unwrap();
    let swapped = error_of(&["audit", &path("events.csv"), SCENE]);
    assert!(swapped.contains(&format!("did you mean impact-pair audit {SCENE} {}?", path("events.csv"))), "{swapped}");
    let scene = error_of(&["check", SCENE]);
    assert!(scene.contains("is a scene, but accepted is a JSON document: impact-pair run"), "{scene}");
    assert!(program(&["run", SCENE, "--impacts", "2", "--output", &path("orbit.json")]).status().unwrap().success());
    let orbit = error_of(&["run", &path("orbit.json")]);
    assert!(orbit.contains("is a JSON document, but accepted is a scene (TOML): impact-pair check"), "{orbit}");
}

#[test]
fn r35_numbers_that_are_none_say_what_is_accepted() {
    assert!(error_of(&["run", SCENE, "--digits", "abc"]).contains("accepted is a whole number from 1 to 400"));
    let unit = error_of(&["run", SCENE, "--until", "2 s"]);
    assert!(
        unit.contains("numbers are in the units of the scene and have none of their own: did you mean 2?"),
        "{unit}"
    );
    assert!(error_of(&["run", SCENE, "--precision", "30"]).contains("--digits D"));
}

/// Every option of every verb that takes a number reads what stands in its place as its own: the message names the option, the value and
/// what is accepted; also a negative number, which looks like an option.
#[test]
fn i58_numbers_say_what_is_accepted() {
    for (verb, option, accepted) in [
        ("run", "--impacts", "a whole number, 0 or greater"),
        ("run", "--digits", "a whole number from 1 to 400"),
        ("run", "--splice", "a whole number, 0 or greater"),
        ("run", "--max-bits", "a whole number from 64 to 10000000"),
        ("describe", "--impacts", "a whole number from 1 to 100000000"),
        ("describe", "--depth", "a whole number from 1 to 64"),
        ("periodic", "--cycles", "a whole number from 1 to 1000000"),
        ("bifurcations", "--doublings", "a whole number from 0 to 8"),
        ("trap", "--words", "a whole number from 1 to 1000"),
        ("chaos", "--depth", "a whole number from 1 to 64"),
        ("cycles", "--impacts", "an integer from 1 to 64"),
        ("sweep", "--transient", "a whole number from 0 to "),
        ("sweep", "--threads", "a whole number from 1 to 4096"),
        ("trade", "--impacts", "a whole number, 1 or greater"),
        ("two-impact", "--cycles", "an integer from 1 to "),
        ("plot", "--cycles", "a whole number from 1 to 10000"),
        ("plot", "--orbit-cycles", "a whole number from 1 to 10000"),
        ("plot", "--transient", "a whole number from 0 to 4294967295"),
        ("plot", "--splice", "a whole number, 0 or greater"),
        ("prove", "--impacts", "a whole number, 1 or greater"),
    ] {
        for value in ["-5", "", "x", "1.5", "99999999999999999999999"] {
            let message = error_of(&[verb, SCENE, option, value]);
            let refused = format!("invalid value '{value}' for '{option}");
            let is_missing = value.is_empty() && message.contains(&format!("a value is required for '{option}"));
            assert!(message.contains(&refused) || is_missing, "{message}");
            assert!(is_missing || message.contains(&format!("accepted is {accepted}")), "{message}");
        }
    }
    for verb in ["trap", "cycles", "windows", "tangency", "global", "atlas", "chaos", "check"] {
        for value in ["-5", "0", "x", "1e10", "[1, 2]"] {
            let message = error_of(&[verb, SCENE, "--effort", value]);
            let accepted = "accepted is a number above 0 and at most 10^9";
            assert!(message.contains(&format!("invalid value '{value}' for '--effort <X>'")), "{message}");
            assert!(message.contains(accepted), "{message}");
        }
    }
    assert!(error_of(&["audit", SCENE, "--tolerance", "-5"]).contains("invalid value '-5' for '--tolerance"));
    assert!(error_of(&["cycles", SCENE, "--impacts", "-1..3"]).contains("accepted is an integer from 1 to 64"));
    assert!(error_of(&["run", SCENE, "-5"]).contains("unexpected argument '-5'"), "an option that does not exist");
    assert!(error_of(&["run", SCENE, "--max-bits", "1e5"]).contains("did you mean 100000?"));
}

#[test]
fn r35_a_missing_table_names_its_line() {
    let scene = changed("missing-table.toml", ["[pair]\ngap = 9.42497\nrestitution = 0.5\n", ""]);
    let last = fs::read_to_string(&scene).unwrap().trim_end().lines().count();
    let error_of = error_of(&["run", &scene]);
    assert!(
        error_of
            .contains(&format!(": line {last}: pair is missing, but must be a table with gap (d), restitution (e)")),
        "{error_of}"
    );
}

/// The message of a long value, or of one of several lines, is one line with its beginning.
#[test]
fn i58_messages_show_the_beginning_of_a_value() {
    let long = changed("long-value.toml", ["amplitude = 8", "amplitude = \"1e400\""]);
    let message = error_of(&["run", &long]);
    assert!(message.lines().next().unwrap().len() < 300, "{message}");
    let lines = changed("value-of-lines.toml", ["gap = 9.42497", "gap = \"\"\"\n1\n- 2\"\"\""]);
    assert!(error_of(&["run", &lines]).contains("pair.gap is 1 - 2, but must be greater than 0\n"));
}

/// A time to stop at that the command line gives is not looked for in the scene.
#[test]
fn i58_a_time_to_stop_at_is_that_of_until() {
    let plot = ["plot", SCENE, "--panel", "a", "--output", "never.svg", "--until", "-1"];
    for arguments in [&["run", SCENE, "--until", "-1"][..], &plot] {
        assert!(
            error_of(arguments).starts_with("error: --until -1: run.until is -1, but must be at least start.time, 0")
        );
    }
    let own = changed("own-until.toml", ["impacts = 200", "until = -1"]);
    assert!(error_of(&["run", &own]).starts_with(&format!("error: {own}: line ")));
}
