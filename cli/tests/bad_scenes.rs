//! A bad scene: exit 2, one message with its line and the faulty text marked on stderr, nothing on stdout. Messages: `tests/scene.rs`.

use crate::common::{answer_to, scene};

/// The refusal of figure 12 with the line of a key replaced.
fn refusal(key: &str, by: &str) -> String {
    let text = scene("figure-12.toml");
    let is_it = |line: &str| line.split(" = ").next() == Some(key);
    assert!(text.lines().any(is_it), "{key}");
    let changed: String = text.lines().map(|line| format!("{}\n", if is_it(line) { by } else { line })).collect();
    refused(&changed)
}

fn refused(scene: &str) -> String {
    let answer = answer_to(scene, &["--format", "csv"]);
    assert_eq!((answer.status.code(), answer.stdout.is_empty()), (Some(2), true));
    String::from_utf8(answer.stderr).unwrap()
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
        let refusal = refusal(key, by);
        assert!(refusal.starts_with("error: stdin: line ") && refusal.ends_with(marked), "{refusal}");
    }
    let message = refusal("gap", "gap = = 9");
    assert!(message.contains(" in `gap = = 9`\n") && message.lines().count() == 4, "{message}");
    let missing = "error: stdin: excitation is missing, but must be a table with amplitude (A), frequency (W, angular-frequency), phase (tau)\n";
    assert_eq!(refused(""), missing);
    let fast = "error: stdin: line 17: start.velocity is -1e300, but double-precision flights accept at most 2^400 in units of gap widths and forcing periods\n";
    assert!(refusal("velocity", "velocity = -1e300").starts_with(fast));
}
