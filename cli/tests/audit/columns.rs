//! Columns that are read, by which names, and those that are not.

use super::{FIGURE_14, LIST, answer, judged};

/// A list whose third column has this name, and the velocities negated.
fn with_velocities_called(name: &str) -> String {
    let negated = |line: &str| {
        let (rest, velocity) = line.rsplit_once(',').unwrap();
        let velocity = velocity.strip_prefix('-').map_or(format!("-{velocity}"), str::to_owned);
        format!("{rest},{velocity}\n")
    };
    let rows: String = LIST.lines().skip(1).map(negated).collect();
    format!("t,wall,{name}\n{rows}")
}

/// A column that is not read was dropped without a word, and the list of wrong velocities "agreed".
#[test]
fn r35_columns_that_are_not_read_are_named() {
    let unknown = with_velocities_called("puck_speed");
    let said = answer(&unknown, &FIGURE_14);
    let said = String::from_utf8(said.stdout).unwrap();
    let last = said.lines().next_back().unwrap();
    assert!(
        last.starts_with("agreed: all 8 listed; not read: puck_speed") && last.contains("--velocity-column"),
        "{last}"
    );
    assert_eq!(judged(&unknown, &FIGURE_14, 0)["unused_columns"], serde_json::json!(["puck_speed"]));
    let named = [&FIGURE_14[..], &["--velocity-column", "puck_speed"]].concat();
    assert_eq!(judged(&unknown, &named, 1)["unused_columns"], serde_json::json!([]));
    // Options of the command line are no part of the document, which Python has as well.
    let r52_message = judged(&unknown, &FIGURE_14, 0)["message"].to_string();
    assert!(r52_message.contains("not read: puck_speed") && !r52_message.contains("--"), "{r52_message}");
    // A column that is deliberately not compared is named without advice.
    let without = [&FIGURE_14[..], &["--no-velocity"]].concat();
    let message = judged(LIST, &without, 0)["message"].to_string();
    assert!(message.contains("not read: velocity") && !message.contains("--velocity-column"), "{message}");
}

#[test]
fn r35_usual_names_of_velocities_before_an_impact_are_known() {
    for name in ["v_minus", "v_before", "vel", "velocity_before", "v-", "V_Minus"] {
        let document = judged(&with_velocities_called(name), &FIGURE_14, 1);
        assert_eq!(document["counts"]["outside"], 8, "{name}");
    }
    // Of several columns of velocities the one named as before the impact is read; the other one is reported as unused.
    let row = |line: &str| format!("{line},0\n");
    let both: String = LIST.lines().skip(1).map(row).collect();
    let document = judged(&format!("t,wall,v_minus,v\n{both}"), &FIGURE_14, 0);
    assert_eq!(document["unused_columns"], serde_json::json!(["v"]));
}

#[test]
fn r35_columns_of_json_that_are_not_read_are_named() {
    let rows = |name: &str| {
        let row = |line: &str| {
            let [time, wall, velocity] = line.split(',').collect::<Vec<_>>()[..] else { panic!("three columns") };
            format!(r#"{{"time": {time}, "wall": "{wall}", "{name}": {velocity}}}"#)
        };
        LIST.lines().skip(1).map(row).collect::<Vec<_>>()
    };
    for list in [format!("[{}]", rows("puck_speed").join(",")), rows("puck_speed").join("\n")] {
        assert_eq!(judged(&list, &FIGURE_14, 0)["unused_columns"], serde_json::json!(["puck_speed"]), "{list}");
    }
    let columns = r#"{"time": [0.5513480202185213], "wall": ["right"], "speed": [3]}"#;
    assert_eq!(judged(columns, &FIGURE_14, 0)["unused_columns"], serde_json::json!(["speed"]));
    let known = format!("[{}]", rows("v_minus").join(","));
    assert_eq!(judged(&known, &FIGURE_14, 0)["unused_columns"], serde_json::json!([]));
}
