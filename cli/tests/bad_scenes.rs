//! Every bad input of the contract: exit 2, one message on stderr, nothing on stdout.

mod common;

use common::{answer_to, scene};

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

macro_rules! refusals {
    ($($name:ident: $key:literal => $by:literal, $message:literal;)*) => {
        $(#[test]
        fn $name() {
            assert_eq!(refusal(&figure_12_with($key, $by)), concat!("error: stdin: ", $message, "\n"));
        })*
    };
}

refusals! {
    unknown_key: "restitution" => "restitution = 0.5\nrestitition = 0.6",
        "line 13: pair.restitition is 0.6, but is no key of [pair]: accepted are gap, restitution";
    unknown_table: "[run]" => "[ran]",
        "line 19: ran is [ran], but is no key of a scene: accepted are title, excitation, pair, start, run";
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
    an_expression_that_does_not_read: "gap" => "gap = \"3*pie\"",
        "line 11: pair.gap is \"3*pie\", but does not read as a number: column 3: found `pie`, accepted are a number, \
         `pi`, `sqrt(`, `sin(`, `cos(`, `(` or a sign";
    several_terms: "amplitude" => "amplitude = [1, \"1/3\"]",
        "line 7: excitation.frequency is \"pi\", but has 1 term, must have 2 like excitation.amplitude";
    part_of_an_impact: "impacts" => "impacts = 2.5",
        "line 20: run.impacts is 2.5, but must be an integer of at least 0";
    beyond_double_precision: "velocity" => "velocity = -1e300",
        "line 17: start.velocity is -1e300, but double-precision flights accept at most 2^400 in units of gaps and turns";
}

#[test]
fn no_toml() {
    let message = refusal(&figure_12_with("gap", "gap = = 9"));
    assert!(message.starts_with("error: stdin: line 11: ") && message.ends_with(" in `gap = = 9`\n"), "{message}");
    assert_eq!(message.lines().count(), 1);
}

#[test]
fn an_empty_scene() {
    assert_eq!(
        refusal(""),
        "error: stdin: excitation is missing, but must be a table with amplitude, frequency, phase\n"
    );
}
