//! Lists of figure 14 and of a chatter, right and corrupted: what `audit` finds, in which words and with which exit code.

mod columns;
mod crossed;

use crate::common;
use std::process::{Command, Output, Stdio};

use crate::common::program;
use crate::tolerances::AUDITED;
use approx::abs_diff_eq;
use insta_cmd::assert_cmd_snapshot;
use serde_json::Value;

/// The first impacts of figure 14 in doubles.
const LIST: &str = "\
time,wall,velocity
0.5513480202185213,right,35.45263760123459
1.665984287965608,left,-34.282716830303514
2.4871006139206955,right,28.642824118036284
2.897310858998662,right,10.532996648647023
3.5755051910415827,left,-35.00859176221453
4.625699229570843,right,33.079063419977594
5.565813010658395,left,-31.36784149408304
6.702421955260352,right,35.77029746454764
";

const FIGURE_14: [&str; 2] = ["scenes/figure-14.toml", "-"];

/// Bounds depend on how well the arithmetic rounds, errors of doubles on both.
const UNCERTAIN: [(&str, &str); 3] = [
    (r"\([-+]?\d+,[-+]?\d+\) *", "(..) "),
    (r"\d\.\de-1\d", "(small)"),
    (r#""(-?\d+\.\d{7})\d*(e-\d+)?""#, r#""$1..""#),
];

fn audit(arguments: &[&str]) -> Command {
    let mut command = program(&["audit"]);
    command.args(arguments);
    command
}

/// The output of `audit` for a list on stdin.
fn answer(list: &str, arguments: &[&str]) -> Output {
    use std::io::Write;
    let mut command = audit(arguments);
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    // A list that is refused at once is not read to its end.
    let _ = child.stdin.take().unwrap().write_all(list.as_bytes());
    child.wait_with_output().unwrap()
}

/// The audit JSON of a list, which must be answered with this exit code.
fn judged(list: &str, arguments: &[&str], code: i32) -> Value {
    let answer = answer(list, &[arguments, &["--format", "json", "--quiet"]].concat());
    assert_eq!(answer.status.code(), Some(code), "{}", String::from_utf8_lossy(&answer.stderr));
    serde_json::from_slice(&answer.stdout).unwrap()
}

/// The verdicts that disagree, each with the number of its impact or, for a false impact, of its row.
fn disagreements(document: &Value) -> Vec<(String, u64)> {
    let found = document["events"].as_array().unwrap().iter().filter_map(|event| {
        let verdict = event["verdict"].as_str().unwrap();
        let number = match verdict {
            "missed" | "outside" => &event["certified"]["index"],
            "false" => &event["row"],
            _ => return None,
        };
        // A graze has no number.
        Some((verdict.to_owned(), number.as_u64().unwrap_or(0)))
    });
    found.collect()
}

/// The list with its lines, from 1 without the header, changed.
fn corrupted(change: impl FnOnce(&mut Vec<String>)) -> String {
    let (header, rows) = LIST.split_once('\n').unwrap();
    let mut rows: Vec<String> = rows.lines().map(str::to_owned).collect();
    change(&mut rows);
    format!("{header}\n{}\n", rows.join("\n"))
}

macro_rules! snapshots {
    ($($name:ident: $list:expr, $arguments:expr;)*) => {
        $(#[test]
        fn $name() {
            insta::with_settings!({ filters => UNCERTAIN.to_vec(), omit_expression => true }, {
                let list: String = $list.to_owned();
                assert_cmd_snapshot!(stringify!($name), audit(&$arguments).pass_stdin(list));
            });
        })*
    };
}

snapshots! {
    a_right_list: LIST, FIGURE_14;
    a_right_list_in_full: LIST, [FIGURE_14[0], FIGURE_14[1], "--all"];
    a_list_without_an_impact: corrupted(|rows| { rows.remove(4); }), FIGURE_14;
    a_list_with_an_impact_twice: corrupted(|rows| rows.insert(4, rows[4].clone())), FIGURE_14;
    a_list_with_a_late_impact: LIST.replace("3.5755051", "3.5755061"), FIGURE_14;
    a_list_with_a_wrong_wall: LIST.replace("3.5755051910415827,left", "3.5755051910415827,right"), FIGURE_14;
    velocities_after_the_impact: "t,wall,v\n0.5513480202185213,R,-17.7\n1.665984287965608,L,17.1\n", FIGURE_14;
    a_time_that_is_not_a_number: LIST.replace("1.665984287965608", "nan"), FIGURE_14;
    a_time_that_is_an_expression: LIST.replace("1.665984287965608", "5/3"), FIGURE_14;
    a_velocity_that_is_infinite: LIST.replace("-34.282716830303514", "-inf"), FIGURE_14;
    a_wall_that_is_none: LIST.replace("left", "top"), FIGURE_14;
    a_list_with_a_short_line: "0.55 right 35\n1.66\n", FIGURE_14;
    a_list_of_nothing: "", FIGURE_14;
    a_list_of_a_header: "time,wall\n", FIGURE_14;
    a_header_without_walls: "time,speed\n1,2\n", FIGURE_14;
    a_column_that_is_not_there: LIST, [FIGURE_14[0], FIGURE_14[1], "--time-column", "when"];
    a_list_that_is_no_json: "[{\"time\": NaN}]", FIGURE_14;
    a_list_of_json_without_times: "[{\"wall\": \"left\"}]", FIGURE_14;
    a_tolerance_of_minus_one: LIST, [FIGURE_14[0], FIGURE_14[1], "--tolerance=-1"];
    a_scene_and_a_list_on_stdin: LIST, ["-", "-"];
    a_list_that_is_not_there: LIST, [FIGURE_14[0], "nowhere.csv"];
    a_time_beyond_all_orbits: "time,wall\n1e9999,left\n", FIGURE_14;
    a_row_before_the_start: "-1 left -12.56636\n", FIGURE_14;
    arguments_of_audit: LIST, ["--help"];
}

snapshots! {
    a_list_as_json: LIST.replace("3.5755051", "3.5755061"), [FIGURE_14[0], FIGURE_14[1], "--format", "json"];
    a_list_whose_end_is_undecided:
        format!("{LIST}100,left,-1\n"), [FIGURE_14[0], FIGURE_14[1], "--max-bits", "64", "--until", "1000"];
    a_list_beyond_the_bits: "time,wall\n60,right\n100,left\n", [FIGURE_14[0], FIGURE_14[1], "--max-bits", "64"];
}

/// Each corrupted impact is found, and nothing else, wherever it is.
#[test]
fn one_corrupted_impact_is_located_exactly() {
    let found = |list: &str| disagreements(&judged(list, &FIGURE_14, 1));
    for at in 1..7 {
        let number = at as u64 + 1;
        let removed = corrupted(|rows| _ = rows.remove(at));
        assert_eq!(found(&removed), [("missed".into(), number)]);
        let doubled = corrupted(|rows| rows.insert(at, rows[at].clone()));
        assert_eq!(found(&doubled), [("false".into(), number + 1)]);
        let shifted = corrupted(|rows| {
            let (time, rest) = rows[at].split_once(',').unwrap();
            rows[at] = format!("{},{rest}", time.parse::<f64>().unwrap() + 1e-6);
        });
        assert_eq!(found(&shifted), [("outside".into(), number)]);
        let document = judged(&shifted, &FIGURE_14, 1);
        let error = &document["events"][at]["error"]["time"];
        let bound = |i: usize| error[i].as_str().unwrap().parse::<f64>().unwrap();
        assert!(bound(0) <= bound(1) && abs_diff_eq!(bound(0), 1e-6, epsilon = AUDITED), "{error}");
        assert_eq!(document["another_orbit"], Value::Null);
        let swapped = corrupted(|rows| rows.swap(at - 1, at));
        let mut kinds: Vec<String> = found(&swapped).into_iter().map(|(kind, _)| kind).collect();
        kinds.sort();
        assert_eq!(kinds, ["false", "missed"]);
    }
}

/// The tolerance is relative to 2 pi/W = 2 and to A W = 8 pi.
#[test]
fn the_tolerance_is_relative_to_the_scene() {
    let late = LIST.replace("3.5755051910415827", "3.5755061910415827");
    judged(&late, &[&FIGURE_14[..], &["--tolerance", "5.001e-7"]].concat(), 0);
    judged(&late, &[&FIGURE_14[..], &["--tolerance", "4.999e-7"]].concat(), 1);
    let fast = LIST.replace("-35.00859176221453", "-35.00861176221453");
    judged(&fast, &[&FIGURE_14[..], &["--tolerance", "7.96e-7"]].concat(), 0);
    judged(&fast, &[&FIGURE_14[..], &["--tolerance", "7.95e-7"]].concat(), 1);
    judged(&fast, &[&FIGURE_14[..], &["--no-velocity"]].concat(), 0);
}

#[test]
fn a_tolerance_is_a_number_from_0_to_1() {
    for text in ["-1e-9", "2", "[0, 1]", "small", "nan"] {
        let tolerance = format!("--tolerance={text}");
        let answer = program(&["audit", FIGURE_14[0], "-", &tolerance]).output().unwrap();
        assert_eq!(answer.status.code(), Some(2), "{text}");
        assert!(String::from_utf8_lossy(&answer.stderr).contains("--tolerance"), "{answer:?}");
    }
}

#[test]
fn lists_may_be_written_as_people_do() {
    let rows: Vec<Vec<&str>> = LIST.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let lines = |line: fn(&[&str]) -> String| rows.iter().map(|row| line(row) + "\n").collect::<String>();
    let sign = |wall: &str| if wall == "left" { "-1.000000000000000000e+00" } else { "1.000000000000000000e+00" };
    let savetxt: String = rows.iter().map(|row| format!("{} {} {}\n", row[0], sign(row[1]), row[2])).collect();
    let lists = [
        LIST.replace(',', ";").replace("left", "L").replace("right", "R"),
        LIST.replace(',', "\t"),
        LIST.replace('\n', "\r\n"),
        LIST.replace("time,wall,velocity", "\u{feff}\"t\", \"Side\", \"V\""),
        format!("# written by numpy\n# time wall velocity\n{savetxt}# the end\n"),
        savetxt.clone(),
        format!("% from MATLAB\n\n   {}", savetxt.replace('\n', "\n   ")),
        // The columns in another order, as a comment says.
        format!(
            "# v side t\n{}",
            rows.iter().map(|row| format!("{} {} {}\n", row[2], sign(row[1]), row[0])).collect::<String>()
        ),
        format!(
            "[{}]",
            lines(|row| format!(r#"{{"time": {}, "wall": "{}", "velocity": {}}},"#, row[0], row[1], row[2]))
                .trim_end_matches(",\n")
        ),
        lines(|row| format!(r#"{{"t": "{}", "side": "{}", "v": null}}"#, row[0], row[1])),
        format!(
            r#"{{"time": [{}], "wall": [{}]}}"#,
            rows.iter().map(|row| row[0]).collect::<Vec<_>>().join(","),
            rows.iter()
                .map(|row| if row[1] == "left" { "-4.712485" } else { "4.712485" })
                .collect::<Vec<_>>()
                .join(",")
        ),
    ];
    for list in lists {
        let document = judged(&list, &FIGURE_14, 0);
        assert_eq!(document["counts"]["inside"], 8, "{list}");
    }
    let named = LIST.replace("time,wall,velocity", "instant,where,v-");
    let columns = ["--time-column", "instant", "--wall-column", "2", "--velocity-column", "V-"];
    assert_eq!(judged(&named, &[&FIGURE_14[..], &columns].concat(), 0)["counts"]["inside"], 8);
}

#[test]
fn the_documents_of_run_are_lists() {
    for format in ["json", "jsonl", "csv"] {
        let orbit =
            common::run(&["scenes/chatter.toml", "--impacts", "20", "--format", format, "--quiet"]).output().unwrap();
        let list = String::from_utf8(orbit.stdout).unwrap();
        let document = judged(&list, &["scenes/chatter.toml", "-", "--tolerance", "1e-6"], 0);
        let counts = &document["counts"];
        assert_eq!(counts["inside"].as_u64().unwrap() + counts["chatter"].as_u64().unwrap(), 20, "{format}: {counts}");
        assert!(counts["chatter"].as_u64().unwrap() > 2);
    }
}

/// The chatter of scenes/chatter.toml ends at 0.2180134000..., to be released at 1; the next impact comes at 4.0000305639.
const CHATTER: &str = "\
0.171614305606542 left -0.29563689657521763
0.2047323167746362 left -0.093395861552101
0.2140779259130584 left -0.028375903727350337
0.21683696334716607 left -0.008543436343758459
0.21766084305153288 left -0.002565752877363037
0.21790766689573116 left -0.0007699698329534724
";

#[test]
fn skipped_impacts_of_a_chatter_are_neither_false_nor_missed() {
    let scene = ["scenes/chatter.toml", "-", "--tolerance", "1e-4"];
    let found = |tail: &str, code: i32| {
        let document = judged(&format!("{CHATTER}{tail}"), &scene, code);
        (disagreements(&document), document["counts"]["chatter"].as_u64().unwrap())
    };
    assert_eq!(found("4.00003056399284 right 6.2831852926972\n", 0), (vec![], 1));
    // Anywhere between: on the wall, slow, as often as one likes.
    let many = "0.2179 left -0.0001\n0.21795 left -0.0001\n0.218 left -0.00001\n0.218 left 0\n0.2181 left 0\n";
    assert_eq!(found(many, 0).0, []);
    // Too fast, on the other wall, at rest.
    assert_eq!(found("0.21799 left -0.3\n", 1).0, [("false".into(), 7)]);
    assert_eq!(found("0.21799 right 0.00001\n", 1).0, [("false".into(), 7)]);
    assert_eq!(found("0.5 left 0\n", 1).0, [("false".into(), 7)]);
    // Before the tolerance makes them one with the end, impacts are requested.
    let short: String = CHATTER.lines().take(3).map(|line| format!("{line}\n")).collect();
    let document = judged(&(short + "4.00003056399284 right 6.2831852926972\n"), &scene, 1);
    assert_eq!(disagreements(&document), [("missed".into(), 4), ("missed".into(), 5)]);
}

#[test]
fn a_graze_need_not_be_listed() {
    let impacts = "1.3574628917487979 right\n1.9989856537174956 left\n";
    for list in [impacts.to_owned(), format!("0.8333333333 right\n{impacts}")] {
        assert_eq!(disagreements(&judged(&list, &["scenes/graze.toml", "-"], 0)), []);
    }
    let elsewhere = format!("0.7 right\n{impacts}");
    assert!(!disagreements(&judged(&elsewhere, &["scenes/graze.toml", "-"], 1)).is_empty());
}

#[test]
fn the_start_may_be_listed() {
    let list = LIST.replace("velocity\n", "velocity\n0,left,-12.56636\n");
    assert_eq!(judged(&list, &FIGURE_14, 0)["counts"]["inside"], 9);
    let wrong = LIST.replace("velocity\n", "velocity\n0,left,12.56636\n");
    assert_eq!(judged(&wrong, &FIGURE_14, 1)["counts"]["outside"], 1);
}

#[test]
fn a_list_is_compared_up_to_a_time() {
    let late = LIST.replace("6.702421955260352", "6.8");
    judged(&late, &FIGURE_14, 1);
    let document = judged(&late, &[&FIGURE_14[..], &["--until", "6"]].concat(), 0);
    assert_eq!((&document["counts"]["left_out"], &document["counts"]["inside"]), (&1.into(), &7.into()));
    // Impacts certified before the requested time are due, listed or not.
    let document = judged(LIST, &[&FIGURE_14[..], &["--until", "7.7"]].concat(), 1);
    assert_eq!(disagreements(&document), [("missed".into(), 9)]);
}

#[test]
fn the_first_impact_of_another_orbit_is_named() {
    let floats =
        common::run(&["scenes/figure-14.toml", "--impacts", "200", "--arithmetic", "float", "--format", "json"])
            .output()
            .unwrap();
    let list = String::from_utf8(floats.stdout).unwrap();
    let document = judged(&list, &FIGURE_14, 1);
    let first = document["first_disagreement"]["impact"].as_u64().unwrap();
    let other = document["another_orbit"]["impact"].as_u64().unwrap();
    assert!((50..80).contains(&first) && (95..120).contains(&other), "{first}, {other}");
    // The list is the float orbit itself.
    let own = &document["double_precision"]["float"];
    assert_eq!(
        (own["first_disagreement"]["impact"].as_u64(), own["another_orbit"]["impact"].as_u64()),
        (Some(first), Some(other))
    );
    // Data in doubles alone lead to another orbit, about as soon.
    let data = &document["double_precision"]["rounded_data"];
    let [data_first, data_other] =
        [&data["first_disagreement"], &data["another_orbit"]].map(|of| of["impact"].as_u64().unwrap());
    assert!((50..90).contains(&data_first) && (95..140).contains(&data_other), "{data}");
    let (before, after): (Vec<u64>, Vec<u64>) =
        disagreements(&document).iter().map(|(_, number)| *number).partition(|&number| number < other);
    assert!(before.len() as u64 <= other - first && after.len() > 80);
}

#[test]
fn a_verdict_may_be_written_to_a_file() {
    let file = common::folder("audit").join("audit.json");
    let arguments = [&FIGURE_14[..], &["--format", "json", "--output", file.to_str().unwrap()]].concat();
    let answer = answer(&corrupted(|rows| _ = rows.remove(2)), &arguments);
    assert_eq!(answer.status.code(), Some(1));
    assert!(answer.stdout.is_empty());
    assert_eq!(String::from_utf8(answer.stderr).unwrap(), "disagreed: 1 impact\n");
    let document: Value = serde_json::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap();
    assert_eq!((&document["schema"], &document["agreed"]), (&"impact-pair/audit/1".into(), &false.into()));
    assert_eq!(document["message"], "disagreed: 1 impact");
}

#[cfg(unix)]
#[test]
fn ctrl_c_keeps_the_verdicts() {
    let folder = common::folder("audit-interrupted");
    let (list, file) = (folder.join("list.csv"), folder.join("audit.json"));
    // The exact orbit, long enough that Ctrl-C comes before its end.
    let impact = |t: u32| format!("{t},{}\n", if t % 2 == 1 { "right" } else { "left" });
    let impacts: String = (1..=100_000).map(impact).collect();
    std::fs::write(&list, format!("time,wall\n{impacts}")).unwrap();
    let arguments = ["scenes/figure-12-exact.toml", list.to_str().unwrap(), "--format", "json", "--output"];
    // The draft appears after the handler is in place.
    let is_ready = || common::files(&folder).len() == 2;
    let command = || {
        let _ = std::fs::remove_file(&file);
        let mut command = audit(&arguments);
        command.arg(&file);
        command
    };
    let document = || serde_json::from_str::<Value>(&std::fs::read_to_string(&file).unwrap()).unwrap();
    let inside = |document: &Value| document["counts"]["inside"].as_u64().unwrap();
    let answer = common::interrupted_within(command, is_ready, |_| inside(&document()) > 1);
    assert_eq!(answer.status.code(), Some(1));
    let text = String::from_utf8(answer.stderr).unwrap();
    assert!(text.contains("interrupted "), "{text}");
    let document = document();
    let (inside, undecided) = (inside(&document), document["counts"]["undecided"].as_u64().unwrap());
    assert!(undecided > 1 && inside + undecided == 100_000 && document["double_precision"]["float"].is_null());
    let events = document["events"].as_array().unwrap();
    assert!(events[..inside as usize].iter().all(|event| event["verdict"] == "inside"));
}
