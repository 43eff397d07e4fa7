//! Sweeps as two tables: the lines and cells of the mixed one, which they are compared with; what is refused.

use crate::common;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use crate::common::{files, folder, program};

/// One key, through order and chaos.
const DIAGRAM: [&str; 7] =
    ["scenes/figure-14.toml", "--over", "amplitude=4..9:21", "--transient", "60", "--impacts", "12"];

/// Two keys, with a dot in each.
const BASINS: &str =
    "scenes/cascade.toml --over start.phase=0..2*pi:4 --over start.velocity=-6..0:3 --transient 60 --impacts 4";

fn sweep(arguments: &[&str]) -> Command {
    let mut command = program(&["sweep"]);
    command.args(arguments).arg("--quiet");
    command
}

/// Undecided points cost an exit code of 1, the rest of the answer is as good.
fn run_to_end(command: &mut Command) -> Output {
    let answer = command.output().unwrap();
    assert!(matches!(answer.status.code(), Some(0 | 1)), "{answer:?}");
    answer
}

/// The text that a command writes to stdout.
fn stdout_of(command: &mut Command) -> String {
    String::from_utf8(run_to_end(command).stdout).unwrap()
}

/// The points and the states that a sweep writes into these files.
pub fn tables(command: &mut Command, [points, states]: [&Path; 2]) -> [Vec<u8>; 2] {
    let answer = run_to_end(command.arg("--output").arg(points).arg("--states").arg(states));
    assert!(answer.stdout.is_empty() && answer.stderr.is_empty(), "{answer:?}");
    [points, states].map(|file| fs::read(file).unwrap())
}

/// The lines of a mixed table, cell by cell, its head first.
fn cells(table: &str) -> Vec<Vec<&str>> {
    table.lines().map(|line| line.split(',').collect()).collect()
}

/// The lines of one kind of a mixed table, and of their cells those of these columns.
fn lines_of(record: &str, mixed: &str, is_kept: impl Fn(&str) -> bool) -> String {
    let rows = cells(mixed);
    let (head, rows) = rows.split_first().unwrap();
    let kind = head.iter().position(|name| *name == "record").unwrap();
    let (kept, left): (Vec<usize>, Vec<usize>) = (0..head.len()).partition(|&i| is_kept(head[i]));
    let own: Vec<_> = rows.iter().filter(|row| row[kind] == record).collect();
    assert!(!own.is_empty());
    // Nothing is lost by what is left out.
    assert!(own.iter().all(|row| left.iter().all(|&i| i == kind || row[i].is_empty())), "{record}");
    let line = |row: &Vec<&str>| kept.iter().map(|&i| row[i]).collect::<Vec<_>>().join(",") + "\n";
    [head].into_iter().chain(own).map(line).collect()
}

fn points_of(mixed: &str) -> String {
    lines_of("point", mixed, |name| name != "record" && name != "index")
}

fn states_of(mixed: &str, keys: &[&str]) -> String {
    let own = ["point", "index", "wall", "phase_lower", "phase_upper", "velocity_lower", "velocity_upper"];
    lines_of("state", mixed, |name| own.contains(&name) || keys.contains(&name))
}

/// At `A_2 = 0` the period is one of the first term, and no whole number of the reference's, the second one's.
#[test]
fn a_period_that_is_no_whole_number_of_cycles_has_its_duration() {
    let folder = folder("durations");
    let scene = folder.join("scene.toml");
    let text = "excitation = { amplitude = [1, 0], frequency = [\"pi\", \"sqrt(2)*pi\"], phase = 0 }\n\
                pair = { gap = \"3*pi\", restitution = 0.5 }\n\
                start = { time = 0, wall = \"left\", velocity = -12 }";
    fs::write(&scene, text).unwrap();
    let table = stdout_of(&mut sweep(&[scene.to_str().unwrap(), "--over", "amplitude.2=0..1/100:2", "--summary"]));
    let [head, first, ..] = &cells(&table)[..] else { panic!("{table}") };
    let cell = |name: &str| first[head.iter().position(|known| *known == name).unwrap()];
    assert_eq!((cell("outcome"), cell("period_cycles")), ("attracted", ""), "{table}");
    let [lower, upper] = ["lower", "upper"].map(|end| cell(&format!("period_duration_{end}")).parse::<f64>().unwrap());
    assert!(lower <= 2.0 && 2.0 <= upper && upper - lower < 1e-6, "{table}");
    assert!(!stdout_of(&mut sweep(&[&DIAGRAM[..], &["--summary"]].concat())).contains("duration"));
}

/// A picture changes no number, and with a picture alone there is no table.
#[test]
fn a_picture_changes_no_table() {
    let folder = folder("pictured");
    let [alone, beside, picture] = ["alone.csv", "beside.csv", "a.svg"].map(|name| folder.join(name));
    assert!(stdout_of(sweep(&DIAGRAM).arg("--output").arg(&alone)).is_empty());
    assert!(stdout_of(sweep(&DIAGRAM).arg("--output").arg(&beside).arg("--plot").arg(&picture)).is_empty());
    assert_eq!(fs::read(alone).unwrap(), fs::read(beside).unwrap());
    assert!(stdout_of(sweep(&DIAGRAM).arg("--plot").arg(&picture)).is_empty());
    assert!(stdout_of(sweep(&DIAGRAM).args(["--format", "csv", "--plot"]).arg(&picture)).starts_with("point,"));
}

#[test]
fn two_tables_hold_the_lines_of_the_mixed_one() {
    let folder = folder("tables");
    let shadowed = [&DIAGRAM[..], &["--arithmetic", "shadow"]].concat();
    let basins: Vec<&str> = BASINS.split(' ').collect();
    let cases: [(&[&str], &[&str]); 3] = [
        (&DIAGRAM, &["amplitude"]),
        (&basins, &["start_phase", "start_velocity"]),
        // With a column of claims, which only points have.
        (&shadowed, &["amplitude"]),
    ];
    for (arguments, keys) in cases {
        let mixed = stdout_of(&mut sweep(arguments));
        let [points, states] = [points_of(&mixed), states_of(&mixed, keys)];
        assert_eq!(mixed.lines().count() + 1, points.lines().count() + states.lines().count());
        assert_eq!(mixed.contains(",claim\n"), points.contains(",claim\n"));
        for threads in ["1", "2", "3"] {
            let written = [folder.join("points.csv"), folder.join("states.csv")];
            let found = tables(sweep(arguments).args(["--threads", threads]), [&written[0], &written[1]]);
            assert_eq!(found.map(|table| String::from_utf8(table).unwrap()), [points.clone(), states.clone()]);
            assert_eq!(files(&folder), ["points.csv", "states.csv"]);
        }
        // Either of them on stdout.
        let file = folder.join("file.csv");
        assert_eq!(stdout_of(sweep(arguments).arg("--states").arg(&file)), points);
        assert_eq!(fs::read_to_string(&file).unwrap(), states);
        assert_eq!(stdout_of(sweep(arguments).args(["--states", "-", "--output"]).arg(&file)), states);
        assert_eq!(fs::read_to_string(&file).unwrap(), points);
        fs::remove_file(file).unwrap();
    }
}

#[test]
fn points_without_impacts_have_no_states() {
    let folder = folder("tables-still");
    let still = folder.join("still.toml");
    let text = "excitation = { amplitude = 0, frequency = 1, phase = 0 }\npair = { gap = 4, restitution = 0.5 }\n\
                start = { time = 0, position = 0, velocity = 0 }";
    fs::write(&still, text).unwrap();
    let (points, states) = (folder.join("points.csv"), folder.join("states.csv"));
    let arguments = [still.to_str().unwrap(), "--over", "gap=1..2:3"];
    let [points, states] = tables(&mut sweep(&arguments), [&points, &states]);
    assert_eq!(points, points_of(&stdout_of(&mut sweep(&arguments))).into_bytes());
    assert_eq!(states, b"point,gap,index,wall,phase_lower,phase_upper,velocity_lower,velocity_upper\n");
}

#[cfg(unix)]
#[test]
fn a_resumed_sweep_writes_both_tables() {
    let folder = folder("tables-resumed");
    let long = ["scenes/figure-14.toml", "--over", "amplitude=3..7:101", "--transient", "20", "--impacts", "5"];
    let [points, states, partial] = ["points.csv", "states.csv", "points.csv.partial"].map(|name| folder.join(name));
    let whole = tables(&mut sweep(&long), [&points, &states]);
    // Begun with states and gone on with; and begun without.
    for is_requested in [true, false] {
        [&points, &states].into_iter().for_each(|file| fs::remove_file(file).unwrap());
        let mut begun = program(&[&["sweep"], &long[..]].concat());
        begun.arg("--output").arg(&points);
        if is_requested {
            begun.arg("--states").arg(&states);
        }
        let lines = || fs::read_to_string(&partial).map_or(0, |text| text.lines().count());
        let answer = common::interrupted(&mut begun, || lines() >= 5);
        let said = String::from_utf8(answer.stderr).unwrap();
        let kept = format!("interrupted: {} points kept in", lines() - 1);
        assert!(answer.status.code() == Some(1) && said.starts_with(&kept) && lines() < 102, "{said}");
        assert_eq!(files(&folder), ["points.csv.partial"]);
        assert!(tables(sweep(&long).arg("--resume"), [&points, &states]) == whole);
        assert_eq!(files(&folder), ["points.csv", "states.csv"]);
    }
}

/// The message for a command line that is refused.
fn refusal(command: &mut Command) -> String {
    let answer = command.output().unwrap();
    assert_eq!((answer.status.code(), answer.stdout.is_empty()), (Some(2), true), "{answer:?}");
    String::from_utf8(answer.stderr).unwrap()
}

#[test]
fn states_that_are_no_table_of_their_own_are_refused() {
    let folder = folder("tables-refused");
    let scene = folder.join("scene.toml");
    fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/figure-14.toml"), &scene).unwrap();
    let refused = |arguments: &[&str]| {
        let mut command = program(&["sweep", "scene.toml", "--over", "amplitude=4..9:21", "--quiet"]);
        let run_to_end = refusal(command.args(arguments).current_dir(&folder));
        assert_eq!(files(&folder), ["scene.toml"], "nothing is begun");
        run_to_end
    };
    let states = ["--states", "states.csv"];
    let cases: [(&[&str], &str); 13] = [
        (&["--format", "jsonl"], "--states writes a table, but a line of jsonl holds a point with its states"),
        (&["--summary"], "--states writes the impacts, but a sweep with --summary has none"),
        (&["--shard", "1/3"], "--states writes a table, but a shard is written as jsonl"),
        (&["--shard", "1/3", "--format", "csv"], "--format is not jsonl, but shards are written as jsonl"),
        (&["--output", "states.csv"], "cannot write states.csv: --output and --states name the same file"),
        (&["--output", "./states.csv"], "cannot write states.csv: --output and --states name the same file"),
        (&["--states", "scene.toml"], "cannot write scene.toml: it is the input"),
        (&["--states", "-"], "--output and --states are both stdout"),
        (&["--output", "-", "--states", "-"], "--output and --states are both stdout"),
        (&["--plot", "a.svg", "--states", "./a.svg"], "--plot and --states name the same file"),
        (&["--output", "a.csv", "--states", "a.csv.partial"], "finished points are kept there until --output appears"),
        (&["--output", "a.csv", "--states", "none/a.csv"], "cannot write none/a.csv: No such file"),
        (&["--output", "a.csv", "--states", "."], "cannot write .: it is a directory"),
    ];
    for (arguments, expected) in cases {
        let more = if arguments.contains(&"--states") { &[][..] } else { &states };
        let run_to_end = refused(&[arguments, more].concat());
        assert!(run_to_end.starts_with("error: ") && run_to_end.contains(expected), "{arguments:?}: {run_to_end}");
    }
    #[cfg(not(feature = "parquet"))]
    assert!(refused(&[&states[..], &["--format", "parquet"]].concat()).contains("build with --features parquet"));
}

#[cfg(feature = "parquet")]
#[test]
fn parquet_holds_the_bounds_of_each_table() {
    let folder = folder("tables-parquet");
    let file = |name: &str| folder.join(name);
    run_to_end(sweep(&DIAGRAM).args(["--format", "parquet", "--output"]).arg(file("mixed.parquet")));
    tables(sweep(&DIAGRAM).args(["--format", "parquet"]), [&file("points.parquet"), &file("states.parquet")]);
    let mixed = stdout_of(&mut sweep(&DIAGRAM));
    assert_holds(&file("mixed.parquet"), &mixed);
    assert_holds(&file("points.parquet"), &points_of(&mixed));
    assert_holds(&file("states.parquet"), &states_of(&mixed, &["amplitude"]));
}

/// Asserts that a Parquet file has the rows and columns of a table over the amplitude.
#[cfg(feature = "parquet")]
fn assert_holds(file: &Path, csv: &str) {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::RowAccessor;

    let reader = SerializedFileReader::new(fs::File::open(file).unwrap()).unwrap();
    let metadata = reader.metadata().file_metadata().key_value_metadata().unwrap();
    let head = metadata.iter().find(|entry| entry.key == "impact-pair/sweep").unwrap();
    assert!(head.value.as_ref().unwrap().contains("\"transient\":60"));
    let names: Vec<String> = csv.lines().next().unwrap().split(',').map(str::to_owned).collect();
    let schema = reader.metadata().file_metadata().schema_descr();
    // The value of the key as written has bounds here.
    assert_eq!(schema.num_columns(), names.len() + 1);
    let column = |name: &str| (0..schema.num_columns()).find(|&i| schema.column(i).name() == name).unwrap();
    let rows: Vec<_> = reader.get_row_iter(None).unwrap().map(Result::unwrap).collect();
    assert_eq!(rows.len(), csv.lines().count() - 1);
    for (line, row) in csv.lines().skip(1).zip(&rows) {
        for (name, text) in names.iter().zip(line.split(',')).filter(|(_, text)| !text.is_empty()) {
            match name.as_str() {
                "amplitude" => assert!(row.get_double(column("amplitude_lower")).is_ok()),
                "point" | "index" | "bits" | "impacts" | "wide_from" | "period_impacts" | "period_cycles"
                | "attracted_from" => {
                    assert_eq!(row.get_long(column(name)).unwrap().to_string(), text);
                }
                "complete" => assert_eq!(row.get_bool(column(name)).unwrap().to_string(), text),
                name if name.ends_with("_lower") || name.ends_with("_upper") => {
                    // Never inside the decimal, and next to what is nearest to it.
                    let (double, nearest) = (row.get_double(column(name)).unwrap(), text.parse::<f64>().unwrap());
                    let out = if name.ends_with("_lower") { nearest.next_down() } else { nearest.next_up() };
                    assert!(double == nearest || double == out, "{name}: {text} {double}");
                }
                name => assert_eq!(row.get_string(column(name)).unwrap(), text),
            }
        }
    }
}
