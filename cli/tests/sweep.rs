//! Sweeps: the same bytes whatever the threads, interruptions and shards; all outcomes; what is refused.

use crate::common;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use crate::common::{crc, files, folder, verb};
use crate::sweep_tables::tables;
use insta_cmd::assert_cmd_snapshot;
use serde_json::Value;

fn sweep(arguments: &[&str]) -> Command {
    verb("sweep", arguments)
}

/// A sweep through order and chaos, short enough for a test.
const DIAGRAM: [&str; 7] =
    ["scenes/figure-14.toml", "--over", "amplitude=4..9:21", "--transient", "60", "--impacts", "12"];

fn written(command: &mut Command, file: &Path) -> Vec<u8> {
    let answer = command.arg("--output").arg(file).output().unwrap();
    assert_eq!(answer.status.code(), Some(0), "{answer:?}");
    assert!(answer.stdout.is_empty());
    fs::read(file).unwrap()
}

fn error(answer: &Output) -> String {
    assert_eq!(answer.status.code(), Some(2), "{answer:?}");
    String::from_utf8(answer.stderr.clone()).unwrap()
}

#[test]
fn any_number_of_threads_writes_the_same_bytes() {
    let folder = folder("sweep-threads");
    for format in ["csv", "jsonl"] {
        let of = |threads: &str| {
            let file = folder.join(format!("{threads}.{format}"));
            written(sweep(&DIAGRAM).args(["--format", format, "--threads", threads]), &file)
        };
        let one = of("1");
        assert_eq!(one, of("2"));
        assert_eq!(one, sweep(&DIAGRAM).args(["--format", format, "--threads", "3"]).output().unwrap().stdout);
        assert!(one.len() > 10_000);
    }
    assert_eq!(files(&folder), ["1.csv", "1.jsonl", "2.csv", "2.jsonl"]);
}

#[test]
fn shards_put_together_are_the_whole() {
    let folder = folder("sweep-shards");
    let shard = |number: u32| {
        let file = folder.join(format!("{number}.jsonl"));
        written(sweep(&DIAGRAM).args(["--shard", &format!("{number}/3")]), &file);
        file.to_str().unwrap().to_owned()
    };
    let [one, two, three] = [1, 2, 3].map(shard);
    let mut formats = vec!["csv", "jsonl"];
    if cfg!(feature = "parquet") {
        formats.push("parquet");
    }
    for format in formats {
        let whole = written(sweep(&DIAGRAM).args(["--format", format]), &folder.join("whole"));
        let merged = sweep(&["--merge", &three, &one, &two, "--format", format]).output().unwrap();
        assert_eq!((merged.status.code(), merged.stdout == whole), (Some(0), true), "{format}");
        let of = |kind: &str, command: &mut Command| {
            let written = ["points", "states"].map(|name| folder.join(format!("{kind}-{name}.{format}")));
            tables(command.args(["--quiet", "--format", format]), [&written[0], &written[1]])
        };
        if format != "jsonl" {
            let merged = of("merged", &mut sweep(&["--merge", &three, &one, &two]));
            assert!(merged == of("whole", &mut sweep(&DIAGRAM)), "{format}");
        }
    }
    let merge = |shards: &[&str]| error(&sweep(&[&["--merge"], shards].concat()).output().unwrap());
    assert!(merge(&[&one, &two]).contains("shard 3/3 is missing"));
    // A shard in the place of its own states, and shards without impacts.
    assert!(merge(&[&one, &two, &three, "--states", &three]).contains("3.jsonl: it is the input"));
    let summary = folder.join("summary.jsonl");
    written(sweep(&DIAGRAM).args(["--shard", "1/1", "--summary"]), &summary);
    let refused = merge(&[summary.to_str().unwrap(), "--states", folder.join("none.csv").to_str().unwrap()]);
    assert_eq!(refused, "error: --states writes the impacts, but a sweep with --summary has none\n");
    assert!(!folder.join("none.csv").exists());
    assert!(merge(&[&one, &two, &two]).contains("is shard 2/3, which is given twice"));
    let whole = folder.join("whole.jsonl");
    written(sweep(&DIAGRAM).args(["--format", "jsonl"]), &whole);
    assert!(merge(&[whole.to_str().unwrap()]).contains("is a whole sweep, not a shard"));
    // A shard of another sweep, one that is not finished, and one that is damaged.
    let other = folder.join("other.jsonl");
    written(sweep(&DIAGRAM).args(["--digits", "7", "--shard", "2/3"]), &other);
    assert!(
        merge(&[&one, other.to_str().unwrap(), &three]).contains("of more than one sweep: digits is 7 in one and 6")
    );
    let text = fs::read_to_string(&two).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let damaged = folder.join("damaged.jsonl");
    let with = |text: String| {
        fs::write(&damaged, text).unwrap();
        merge(&[&one, damaged.to_str().unwrap(), &three])
    };
    assert!(with(lines[..lines.len() - 1].join("\n")).contains("lacks point 19: the shard is not finished"));
    assert!(
        with(text.replace("\"point\":1,", "\"point\":2,")).contains("line 2: point 2 does not belong to this sweep")
    );
    assert!(with(format!("{text}{}\n", lines[1])).contains("point 1 occurs twice"));
    // r41: values of another point; a shard that is none, which was a panic.
    let moved = text.replacen("\"values\":[\"", "\"values\":[\"1+", 1);
    assert!(moved != text && with(moved).contains("line 2: the values of point 1 are 1+"));
    for shard in ["[0,0]", "[0,3]", "[4,3]", "[1,0]"] {
        let refused = with(text.replacen("\"shard\":[2,3]", &format!("\"shard\":{shard}"), 1));
        assert!(refused.contains("the shard is ") && refused.contains("accepted is I/N"), "{refused}");
    }
    assert!(with(text[..text.len() / 2].to_owned()).contains("is not the record of a point"));
    assert!(with("nothing".into()).contains("line 1 is no head"));
}

#[test]
fn a_truncated_journal_is_resumed_and_a_damaged_one_refused() {
    let folder = folder("sweep-torn");
    let whole = written(&mut sweep(&DIAGRAM), &folder.join("whole.csv"));
    let lines = sweep(&DIAGRAM).args(["--format", "jsonl"]).output().unwrap().stdout;
    let lines = String::from_utf8(lines).unwrap();
    let (file, partial) = (folder.join("resumed.csv"), folder.join("resumed.csv.partial"));
    let resume = || sweep(&DIAGRAM).args(["--resume", "--output"]).arg(&file).output().unwrap();
    // The head, points 0 to 6, and part of the next one: what a crash may leave.
    let sealed: Vec<String> = lines.lines().map(|line| format!("{:08x} {line}\n", crc(line.as_bytes()))).collect();
    let torn = sealed[..8].concat() + &sealed[8][..100];
    // One sign changed, of all the signs of a number; a line changed for a good one of other bytes; one of an earlier version.
    let minus = torn.rfind("\"-").unwrap();
    let line = torn[..minus].lines().count();
    fs::write(&partial, [&torn[..minus], "\" ", &torn[minus + 2..]].concat()).unwrap();
    let said = error(&resume());
    assert!(said.contains(&format!("resumed.csv.partial: line {line}: it is corrupted")), "{said}");
    fs::write(&partial, torn.replace("\"point\":3", "\"point\":9")).unwrap();
    assert!(error(&resume()).contains("resumed.csv.partial: line 5: it is corrupted"));
    fs::write(&partial, &lines).unwrap();
    assert!(error(&resume()).contains("line 1: it has no checksum: an earlier version started this sweep"));
    fs::write(&partial, torn).unwrap();
    let refused = sweep(&DIAGRAM).arg("--output").arg(&file).output().unwrap();
    assert!(error(&refused).contains("holds an unfinished sweep: continue it with --resume, or remove the file"));
    let answer = sweep(&DIAGRAM).args(["--digits", "5", "--resume", "--output"]).arg(&file).output().unwrap();
    assert!(error(&answer).contains("belongs to another sweep or another version: digits is 6 in one and 5"));
    assert!(String::from_utf8(resume().stderr).unwrap().contains("(14 in "), "seven points are taken over");
    assert_eq!(fs::read(&file).unwrap(), whole);
    assert_eq!(files(&folder), ["resumed.csv", "whole.csv"]);
    // With nothing to resume, the sweep begins.
    assert_eq!(written(sweep(&DIAGRAM).arg("--resume"), &folder.join("new.csv")), whole);
}

/// A scene file of this test.
fn scene(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

fn records(answer: &Output) -> Vec<Value> {
    let text = std::str::from_utf8(&answer.stdout).unwrap();
    text.lines().skip(1).map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn scenes_that_rest_graze_or_never_impact_have_their_outcomes() {
    let folder = folder("sweep-outcomes");
    let of = |arguments: &[&str]| {
        let answer =
            sweep(arguments).args(["--transient", "4", "--impacts", "40", "--format", "jsonl"]).output().unwrap();
        (answer.status.code(), records(&answer))
    };
    // The chatter comes to rest, from slower starts as well; from the release on the motion is the same.
    let (code, points) = of(&["scenes/chatter.toml", "--over", "start.velocity=-0.5..-0.25:3"]);
    assert_eq!(code, Some(0));
    for point in &points {
        assert_eq!((point["outcome"].as_str(), point["complete"].as_bool()), (Some("periodic"), Some(true)), "{point}");
        assert_eq!(point["exponent"]["per_impact"][1], "-inf");
        assert_eq!(point["states"].as_array().unwrap().len(), 40);
    }
    for point in &points {
        assert_eq!(point["impacts_per_cycle"][0], "inf");
        assert_eq!(point["period"]["cycles"], 9);
    }
    // Without rebound the derivative has rank one.
    let (_, points) = of(&["scenes/chatter.toml", "--over", "restitution=0..0.1:2"]);
    assert_eq!((&points[0]["outcome"], &points[0]["complete"]), (&"attracted".into(), &true.into()));

    // A ball without velocity in the middle of a box that stands still, or nearly.
    let still = scene(
        &folder,
        "still.toml",
        "excitation = { amplitude = 0, frequency = 1, phase = 0 }\npair = { gap = 4, restitution = 0.5 }\n\
         start = { time = 0, position = 0, velocity = 0 }",
    );
    let (code, points) = of(&[&still, "--over", "gap=1..2:3"]);
    assert!(code == Some(0) && points.iter().all(|point| point["outcome"] == "never-impacts"));
    assert!(points.iter().all(|point| point["exponent"]["reason"] == "no-impacts" && point["impacts"] == 0));
    // Without shaking a ball that bounces ends on no wall; one that is at rest on a wall rests for ever.
    let resting = fs::read_to_string(&still).unwrap().replace("position = 0,", "wall = \"left\",");
    let (code, points) = of(&[&scene(&folder, "resting.toml", &resting), "--over", "gap=1..2:2"]);
    assert!(code == Some(0) && points.iter().all(|point| point["outcome"] == "rests-forever"), "{points:?}");
}

#[test]
fn undecided_points_stay_with_what_is_certified() {
    let arguments = ["scenes/figure-14.toml", "--over", "amplitude=1..8:2", "--transient", "20", "--impacts", "300"];
    let answer = sweep(&arguments).args(["--arithmetic", "interval", "--format", "jsonl"]).output().unwrap();
    assert_eq!(answer.status.code(), Some(1));
    let points = records(&answer);
    assert_eq!((&points[0]["outcome"], &points[1]["outcome"]), (&"attracted".into(), &"undecided".into()));
    assert_eq!((&points[1]["reason"], &points[1]["complete"]), (&"width".into(), &false.into()));
    let states = points[1]["states"].as_array().unwrap().len() as u64;
    assert!(states > 20 && points[1]["impacts"] == states + 20);
    assert!(
        String::from_utf8(answer.stderr).unwrap().starts_with("not all certified, 1 incomplete: 2 points, 1 attracted")
    );
    // Floats claim nothing.
    let answer = sweep(&arguments).args(["--arithmetic", "float", "--format", "jsonl"]).output().unwrap();
    assert!(answer.status.success() && answer.stdout.starts_with(b"{\"schema\":\"impact-pair/sweep/1\""));
    let head: Value = serde_json::from_slice(answer.stdout.split(|&byte| byte == b'\n').next().unwrap()).unwrap();
    assert_eq!(head["certified"], false);
}

#[test]
fn a_graze_is_passed_and_has_no_exponent() {
    let arguments = ["scenes/graze.toml", "--over", "restitution=0.4..0.5:2", "--transient", "0", "--impacts", "8"];
    let answer = sweep(&arguments).args(["--format", "jsonl"]).output().unwrap();
    assert_eq!(answer.status.code(), Some(1));
    for point in records(&answer) {
        assert_eq!((&point["exponent"]["reason"], &point["complete"]), (&"graze".into(), &false.into()), "{point}");
    }
}

#[test]
fn pictures_show_all_outcomes() {
    let folder = folder("sweep-pictures");
    let picture = |arguments: &[&str]| {
        let file = folder.join("picture.svg");
        let mut command = sweep(arguments);
        let answer = command.args(["--transient", "60", "--impacts", "40", "--quiet", "--plot"]).arg(&file).output();
        assert!(answer.unwrap().stderr.is_empty());
        common::words(&fs::read_to_string(&file).unwrap())
    };
    let diagram = ["scenes/figure-14.toml", "--over", "amplitude=1..9:9", "--arithmetic", "interval"];
    let phases = picture(&diagram);
    let parts = [
        "phase Ωt + τ of the impact [rad]",
        "3π/2",
        "Ω = π, τ = 0, d = 9.42497",
        "A varied",
        "width=\"960\"",
        "undecided (bar)",
    ];
    assert!(parts.iter().all(|part| phases.contains(part)), "{phases}");
    assert!(["#0072B2", "#D55E00"].iter().all(|colour| phases.contains(&format!("fill=\"{colour}\" d=\"M"))));
    assert!(
        picture(&[&diagram[..], &["--show", "velocity"]].concat()).contains("relative velocity y′ before the impact")
    );
    let basins =
        ["scenes/cascade.toml", "--over", "start.phase=0..2*pi:9", "--over", "start.velocity=-6..0:7", "--summary"];
    let map = picture(&basins);
    assert!(
        [
            "LR in 1 cycle, L at 4.64 rad",
            "3π/2",
            "A = 0.36, Ω = π",
            "LR in 1 cycle, L at 5.14 rad",
            "#E69F00",
            "an attractor, where it hits the left wall"
        ]
        .iter()
        .all(|part| map.contains(part))
    );
}

#[test]
fn a_picture_says_which_of_several_frequencies_phases_are_of() {
    let file = folder("sweep-several").join("picture.svg");
    let mut command =
        sweep(&["scenes/square-wave.toml", "--over", "gap=9..10:3", "--transient", "0", "--impacts", "9"]);
    let answer = command.arg("--plot").arg(&file).output().unwrap();
    assert_eq!(answer.status.code(), Some(0), "{answer:?}");
    let picture = common::words(&fs::read_to_string(&file).unwrap());
    let parts = ["Ω = (π, 3π, 5π)", "phases are those of the greatest Ω"];
    assert!(parts.iter().all(|part| picture.contains(part)), "{picture}");
    let over = ["--over", "amplitude.2=0..1/3:3", "--transient", "0", "--impacts", "9"];
    let answer = sweep(&[&["scenes/square-wave.toml"], &over[..]].concat()).arg("--plot").arg(&file).output().unwrap();
    assert_eq!(answer.status.code(), Some(0), "{answer:?}");
    let picture = common::words(&fs::read_to_string(&file).unwrap());
    let parts = ["A2 varied", "A = (1, A2, 1/5)", "amplitude of the box A2 [length]"];
    assert!(parts.iter().all(|part| picture.contains(part)), "{picture}");
}

/// Two odd harmonics, the second of them of this amplitude and phase; where it has none, figure 12.
fn two_terms(folder: &Path, amplitude: &str, phase: &str) -> String {
    let scene = folder.join("two.toml");
    let text = format!(
        "excitation = {{ amplitude = [1, \"{amplitude}\"], frequency = [\"pi\", \"3*pi\"], phase = [0, \"{phase}\"] }}
        pair = {{ gap = 9.42497, restitution = 0.5 }}
        start = {{ time = 0, wall = \"left\", velocity = -12.56636 }}"
    );
    fs::write(&scene, text).unwrap();
    scene.to_str().unwrap().to_owned()
}

/// A value of one term's parameter gives the results of the scene with that value.
#[test]
fn a_key_with_a_number_varies_that_term() {
    let folder = folder("sweep-terms");
    let records = |scene: &str, over: &[&str]| -> Vec<Value> {
        let shape = ["--transient", "60", "--impacts", "4", "--format", "jsonl", "--quiet"];
        let answer = sweep(&[&[scene], over, &shape[..]].concat()).output().unwrap();
        assert_eq!(answer.status.code(), Some(0), "{answer:?}");
        let lines = String::from_utf8(answer.stdout).unwrap();
        let record = |line: &str| {
            let mut record: Value = serde_json::from_str(line).unwrap();
            ["point", "values"].iter().for_each(|key| drop(record.as_object_mut().unwrap().remove(*key).unwrap()));
            record
        };
        lines.lines().skip(1).map(record).collect()
    };
    let over = ["--over", "amplitude.2=0..1/9:3", "--over", "phase.2=0..pi/2:2"];
    let swept = records(&two_terms(&folder, "1/2", "1"), &over);
    let values = ["0", "1/18", "1/9"].into_iter().flat_map(|amplitude| ["0", "pi/2"].map(|phase| (amplitude, phase)));
    for ((amplitude, phase), swept) in values.zip(&swept) {
        let own = records(&two_terms(&folder, amplitude, phase), &["--over", "gap=9.42497..9.424971:2"]);
        assert_eq!(swept["outcome"], "attracted");
        if amplitude != "0" {
            assert_eq!(*swept, own[0], "{amplitude} {phase}");
            continue;
        }
        // r32: there the cycles are those of the second term as well, which does not move the box.
        let velocities = |record: &Value| [0, 1, 2, 3].map(|i| record["states"][i]["velocity"].clone());
        assert_eq!(velocities(swept), velocities(&own[0]), "{phase}");
        assert_eq!([&swept["period"]["cycles"], &own[0]["period"]["cycles"]], [3, 1]);
        let rate = swept["impacts_per_cycle"][0].as_str().unwrap();
        assert!(rate.starts_with("0.66666666666"), "{rate}");
        assert!(swept["message"].as_str().unwrap().contains("2 impacts every 3 cycles"), "{swept}");
    }
    assert!(swept.len() == 6 && swept[0]["states"] != swept[1]["states"] && swept[4] != swept[5]);
    let arguments = [&two_terms(&folder, "1/9", "0"), "--over", "amplitude=0..1:3"];
    let answer = sweep(&arguments).output().unwrap();
    assert!(
        error(&answer).contains("the excitation has 2 terms: accepted are amplitude.1 to amplitude.2"),
        "{answer:?}"
    );
}

/// Times differ from run to run.
const TIMINGS: [(&str, &str); 1] = [(r"\(\d+ in [\d.]+ s, [\d.]+ a second\)", "(rate)")];

#[test]
fn the_table() {
    insta::with_settings!({ filters => TIMINGS.to_vec() }, {
        let short = ["scenes/figure-12.toml", "--over", "gap=9..3*pi:3", "--transient", "100", "--impacts", "2"];
        assert_cmd_snapshot!("gap_as_csv", sweep(&short));
        assert_cmd_snapshot!("gap_as_jsonl", sweep(&short).args(["--format", "jsonl", "--summary"]));
    });
}

#[test]
fn the_command_line() {
    assert_cmd_snapshot!("arguments_of_sweep", sweep(&["--help"]));
    let scene = "scenes/figure-14.toml";
    assert_cmd_snapshot!("nothing_to_sweep_over", sweep(&[scene]));
    assert_cmd_snapshot!("grid_of_one", sweep(&[scene, "--over", "amplitude=1..2:1"]));
    assert_cmd_snapshot!("no_such_key", sweep(&[scene, "--over", "mass=1..2:3"]));
    assert_cmd_snapshot!("same_key_twice", sweep(&[scene, "--over", "gap=1..2:3", "--over", "pair.gap=1..2:3"]));
    assert_cmd_snapshot!("beyond_the_range", sweep(&[scene, "--over", "restitution=0.5..1.5:3"]));
    assert_cmd_snapshot!("away_from_the_wall", sweep(&[scene, "--over", "start.velocity=-1..1:3"]));
    assert_cmd_snapshot!("position_on_a_wall", sweep(&[scene, "--over", "start.position=-1..1:3"]));
    let over = ["--over", "gap=1..2:3"];
    let with = |rest: &[&str]| sweep(&[&[scene], &over[..], rest].concat());
    assert_cmd_snapshot!("shard_beyond", with(&["--shard", "4/3"]));
    assert_cmd_snapshot!("shard_as_csv", with(&["--shard", "1/3", "--format", "csv"]));
    assert_cmd_snapshot!("one_file_for_output_and_plot", with(&["--output", "a.svg", "--plot", "a.svg"]));
    assert_cmd_snapshot!("resume_without_output", with(&["--resume"]));
    assert_cmd_snapshot!("merge_with_a_scene", with(&["--merge", "a.jsonl"]));
    #[cfg(not(feature = "parquet"))]
    assert_cmd_snapshot!("no_parquet", with(&["--format", "parquet"]));
    assert_cmd_snapshot!("merge_of_no_file", sweep(&["--merge", "no-such.jsonl"]));
}

/// A point that is proved to be attracted had only a finite-time exponent, which may be positive.
#[test]
fn r35_attracted_points_have_the_limit_of_the_exponent() {
    let over = ["scenes/figure-14-sink.toml", "--over", "gap=9.4248032652..9.42480326525:2", "--transient", "30"];
    let jsonl = [&over[..], &["--impacts", "5", "--quiet", "--format", "jsonl"]].concat();
    let number = |bound: &Value| bound.as_str().unwrap().parse::<f64>().unwrap();
    for record in records(&sweep(&jsonl).output().unwrap()) {
        assert_eq!(record["outcome"], "attracted");
        assert!(number(&record["exponent"]["per_impact"][0]) > 0.5, "{record}");
        let [low, high] = [0, 1].map(|end| number(&record["exponent_limit"][end]));
        assert!(-0.5f64.ln().abs() <= low && low < high && high < -0.2, "{record}");
    }
    let csv = [&over[..], &["--impacts", "5", "--quiet", "--summary"]].concat();
    let table = String::from_utf8(sweep(&csv).output().unwrap().stdout).unwrap();
    assert!(
        table.lines().next().unwrap().ends_with(",attracted_from,exponent_limit_lower,exponent_limit_upper"),
        "{table}"
    );
    assert!(table.lines().skip(1).all(|line| line.rsplit(',').take(2).all(|end| end.starts_with("-0.2"))), "{table}");
    // A point that is not attracted has no limit of the exponent.
    let chaos =
        ["scenes/figure-14.toml", "--over", "gap=9.42497..9.425:2", "--transient", "5", "--impacts", "5", "--quiet"];
    let table = String::from_utf8(sweep(&[&chaos[..], &["--summary"]].concat()).output().unwrap().stdout).unwrap();
    assert!(table.lines().skip(1).all(|line| line.contains("undecided-limit") && line.ends_with(",,")), "{table}");
}

/// Of each of the points that were left an orbit was begun, so that a sweep of millions of them ended minutes after Ctrl-C.
#[cfg(unix)]
#[test]
fn r51_after_ctrl_c_no_other_point_is_begun() {
    let folder = folder("sweep-interrupted-among-many");
    let file = folder.join("points.jsonl");
    let over = ["--over", "gap=9..10:2000", "--over", "amplitude=7..8:2000", "--impacts", "3000", "--output"];
    let mut command = sweep(&["scenes/figure-14.toml"]);
    let child = command.args(over).arg(&file).stderr(std::process::Stdio::piped()).spawn().unwrap();
    // The draft appears after the handler is in place.
    while files(&folder).is_empty() {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    common::interrupt(&child);
    let since = std::time::Instant::now();
    let answer = child.wait_with_output().unwrap();
    assert_eq!(answer.status.code(), Some(1), "{answer:?}");
    assert!(String::from_utf8(answer.stderr).unwrap().starts_with("interrupted: "));
    // One point takes about a second, the beginnings of all took several minutes.
    assert!(since.elapsed().as_secs() < 60, "{:?}", since.elapsed());
}
