//! Every bad input of the contract: exit 2, one message on stderr, nothing on stdout.

use crate::common::{answer_to, scene};

/// Figure 12 with the line of `key` replaced, or an addition where `key` is a table's header.
fn figure_12_with(key: &str, by: &str) -> String {
    let text = scene("figure-12.toml");
    let is_it = |line: &str| line == key || line.split(" = ").next() == Some(key);
    assert!(text.lines().any(is_it), "{key}");
    text.lines().map(|line| format!("{}\n", if is_it(line) { by } else { line })).collect()
}

fn refusal(scene: &str) -> String {
    let answer = answer_to(scene, &["--format", "csv"]);
    assert_eq!(answer.status.code(), Some(2));
    assert!(answer.stdout.is_empty());
    String::from_utf8(answer.stderr).unwrap()
}

/// Whether an excerpt is the line that the message names, with marks below; whether it is empty if the message names no line.
fn shows_a_line(scene: &str, message: &str, excerpt: &str) -> bool {
    let Some((number, _)) = message.strip_prefix("line ").and_then(|rest| rest.split_once(':')) else {
        return excerpt.is_empty();
    };
    let line = scene.lines().nth(number.parse::<usize>().unwrap() - 1).unwrap();
    let [_, shown, marks] = excerpt.lines().collect::<Vec<_>>()[..] else { return false };
    shown == format!("{number} | {line}") && marks.trim_start_matches([' ', '|']).chars().all(|mark| mark == '^')
}

#[test]
fn the_faulty_text_is_marked() {
    for (key, by, marked) in [
        ("gap", "gap = \"9,42497\"", "11 | gap = \"9,42497\"\n   |         ^\n"),
        ("wall", "wall = \"Left\"", "16 | wall = \"Left\"\n   |        ^^^^^^\n"),
        ("frequency", "frequency = 2*pi", "7 | frequency = 2*pi\n  |             ^^^^\n"),
        ("gap", "gaps = 2", "11 | gaps = 2\n   | ^^^^\n"),
        ("phase", "phase = [0, \"2pi\"]", "8 | phase = [0, \"2pi\"]\n  |               ^\n"),
    ] {
        let refusal = refusal(&figure_12_with(key, by));
        assert!(refusal.ends_with(marked), "{refusal}");
    }
}

macro_rules! refusals {
    ($($name:ident: $key:literal => $by:literal, $message:literal;)*) => {
        $(#[test]
        fn $name() {
            let scene = figure_12_with($key, $by);
            let refusal = refusal(&scene);
            let (message, excerpt) = refusal.split_once('\n').unwrap();
            assert_eq!(message, concat!("error: stdin: ", $message));
            assert!(shows_a_line(&scene, $message, excerpt), "{refusal}");
        })*
    };
}

refusals! {
    unknown_key: "restitution" => "restitution = 0.5\nrestitition = 0.6",
        "line 13: pair.restitition is 0.6, but is not a key of [pair]: accepted are gap, restitution; \
         did you mean `restitution`?";
    unknown_table: "[run]" => "[ran]",
        "line 19: ran is [ran], but is not a key of a scene: accepted are title, excitation, pair, start, run; did you mean `run`?";
    duplicate_key: "gap" => "gap = 1\ngap = 2", "line 12: duplicate key in `gap = 2`";
    missing_key: "restitution" => "",
        "line 10: pair.restitution is missing, but must be a number, or a string with an expression (\"3*pi\") \
         or an interval (\"[9.42, 9.43]\")";
    restitution_above_one: "restitution" => "restitution = 1.2",
        "line 12: pair.restitution is 1.2, but must lie in [0, 1]";
    restitution_below_zero: "restitution" => "restitution = -1e-300",
        "line 12: pair.restitution is -1e-300, but must lie in [0, 1]";
    restitution_that_may_exceed_one: "restitution" => "restitution = \"[0.5, 1.0001]\"",
        "line 12: pair.restitution is [0.5, 1.0001], but must lie in [0, 1]";
    gap_of_zero: "gap" => "gap = 0", "line 11: pair.gap is 0, but must be greater than 0";
    gap_below_zero: "gap" => "gap = -9.42497", "line 11: pair.gap is -9.42497, but must be greater than 0";
    amplitude_below_zero: "amplitude" => "amplitude = -1",
        "line 6: excitation.amplitude is -1, but must be at least 0";
    frequency_of_zero: "frequency" => "frequency = 0",
        "line 7: excitation.frequency is 0, but must be greater than 0";
    frequency_below_zero: "frequency" => "frequency = \"-pi\"",
        "line 7: excitation.frequency is -pi, but must be greater than 0";
    velocity_away_from_the_left_wall: "velocity" => "velocity = 1e-9",
        "line 17: start.velocity is 1e-9, but on the left wall it must be at most 0";
    velocity_away_from_the_right_wall: "wall" => "wall = \"right\"",
        "line 17: start.velocity is -12.56636, but on the right wall it must be at least 0";
    position_outside: "wall" => "position = 5",
        "line 16: start.position is 5, but must lie strictly between the walls at -d/2 and d/2 (on a wall: give start.wall)";
    position_on_the_wall: "wall" => "position = \"-9.42497/2\"",
        "line 16: start.position is -9.42497/2, but must lie strictly between the walls at -d/2 and d/2 \
         (on a wall: give start.wall)";
    wall_and_position: "wall" => "wall = \"left\"\nposition = 0",
        "line 17: start.position is 0, but start.wall is given too, on line 16: a start has one or the other";
    neither_wall_nor_position: "wall" => "",
        "line 14: start.wall is missing, but must be \"left\" or \"right\", or start.position be given";
    unknown_wall: "wall" => "wall = \"top\"", "line 16: start.wall is \"top\", but must be \"left\" or \"right\"";
    not_a_number: "gap" => "gap = nan",
        "line 11: pair.gap is nan, but does not read as a number: column 1: found `nan`, accepted are finite real numbers only";
    infinite: "velocity" => "velocity = -inf",
        "line 17: start.velocity is -inf, but does not read as a number: column 2: found `inf`, accepted are finite real numbers only";
    of_the_wrong_type: "gap" => "gap = true",
        "line 11: pair.gap is true, but must be a number, or a string with an expression (\"3*pi\") or an interval \
         (\"[9.42, 9.43]\")";
    a_product_without_its_sign: "frequency" => "frequency = \"2pi\"",
        "line 7: excitation.frequency is \"2pi\", but does not read as a number: column 2: found `pi`, accepted are `+`, `-`, `*`, \
         `/`, `^` or the end; did you mean `2*pi`?";
    a_unit: "gap" => "gap = \"8 mm\"",
        "line 11: pair.gap is \"8 mm\", but does not read as a number: column 3: found `mm`, accepted are `+`, `-`, `*`, `/`, `^` or \
         the end; numbers have no units here: use one unit of length and one of time throughout";
    a_decimal_comma: "gap" => "gap = 9,42497",
        "line 11: unexpected key or value, expected newline, `#` in `gap = 9,42497`; did you mean `gap = 9.42497`?";
    an_expression_without_quotes: "frequency" => "frequency = 2*pi",
        "line 7: string values must be quoted, expected literal string in `frequency = 2*pi`; did you mean `frequency = \"2*pi\"`?";
    a_wall_without_quotes: "wall" => "wall = left",
        "line 16: string values must be quoted, expected literal string in `wall = left`; did you mean `wall = \"left\"`?";
    a_wall_in_capitals: "wall" => "wall = \"Left\"",
        "line 16: start.wall is \"Left\", but must be \"left\" or \"right\"; did you mean `\"left\"`?";
    an_expression_that_does_not_read: "gap" => "gap = \"3*pie\"",
        "line 11: pair.gap is \"3*pie\", but does not read as a number: column 3: found `pie`, accepted are a number, \
         `pi`, `sqrt(`, `sin(`, `cos(`, `(` or a sign";
    several_terms: "amplitude" => "amplitude = [1, \"1/3\"]",
        "line 7: excitation.frequency is \"pi\", but has 1 term, must have 2 like excitation.amplitude";
    part_of_an_impact: "impacts" => "impacts = 2.5",
        "line 20: run.impacts is 2.5, but must be an integer of at least 0";
    beyond_double_precision: "velocity" => "velocity = -1e300",
        "line 17: start.velocity is -1e300, but double-precision flights accept at most 2^400 in units of gap widths and forcing periods";
}

#[test]
fn no_toml() {
    let message = refusal(&figure_12_with("gap", "gap = = 9"));
    assert!(message.starts_with("error: stdin: line 11: ") && message.contains(" in `gap = = 9`\n"), "{message}");
    assert_eq!(message.lines().count(), 4);
}

#[test]
fn an_empty_scene() {
    assert_eq!(
        refusal(""),
        "error: stdin: excitation is missing, but must be a table with amplitude, frequency, phase\n"
    );
}
