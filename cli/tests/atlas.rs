//! Atlases: a row a point or cell, the same whatever the shards and interruptions; the page; what is refused.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use serde_json::Value;

use crate::common::{EXACT, crc, files, folder, program, snapshots, verb};

snapshots! { EXACT;
    arguments_of_atlas: program(&["atlas", "--help"]);
    atlas_over_one_axis: program(&["atlas", SCENE, "--over", "gap=1..2:3"]);
    atlas_over_a_start: program(&["atlas", SCENE, "--over", "gap=1..2:3", "--over", "start.time=0..1:2"]);
    atlas_of_elastic_impacts: program(&["atlas", SCENE, "--over", "gap=1..2:3", "--over", "restitution=0.5..1:2"]);
    atlas_under_two_harmonics:
        program(&["atlas", "scenes/two-tones.toml", "--over", "gap=1..2:3", "--over", "restitution=0..0.5:2"]);
    atlas_shard_as_svg: program(&["atlas", SCENE, "--shard", "1/2", "--over", "gap=1..2:3", "--output", "one.svg"]);
}

const SCENE: &str = "scenes/figure-12.toml";
/// Of `A/d` from 0.6 to 3 and `e` from 0.1 to 0.6, with few boxes: cycles with rests, an attractor, closed components.
const PLANE: [&str; 6] = ["--over", "amplitude=0.6..3:4", "--over", "restitution=0.1..0.6:3", "--effort", "0.02"];

/// A scene whose gap is 1.
fn scene(folder: &Path) -> String {
    let path = folder.join("scene.toml");
    let text = "title = \"A <plane> & {{DATA}}\"\nexcitation = { amplitude = 1, frequency = 3, phase = 0.7 }\n\
                pair = { gap = 1, restitution = 0.5 }\nstart = { time = 0, wall = \"left\", velocity = -1 }\n";
    fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

fn atlas(scene: &str, more: &[&str]) -> Command {
    verb("atlas", &[&[scene], &PLANE[..], more].concat())
}

/// Lines without the time that they took.
fn without_seconds(lines: &str) -> Vec<Value> {
    let mut all: Vec<Value> = lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    for line in &mut all {
        line.as_object_mut().unwrap().remove("seconds");
    }
    all
}

/// Made anew: its rows are those of `global` at these points, each is confirmed by `check`, and the page has the command that proves one again.
#[test]
fn a_4_by_3_atlas_is_that_of_its_points() {
    let folder = folder("atlas");
    let scene = scene(&folder);
    let [lines, page] = ["atlas.jsonl", "atlas.html"].map(|name| folder.join(name).to_str().unwrap().to_owned());
    let answer = atlas(&scene, &["--output", &lines, "--plot", &page]).output().unwrap();
    let said = String::from_utf8(answer.stderr).unwrap();
    assert!(said.starts_with("not all decided: 12 points, 5 one-rest-cycle, 1 one-attractor, "), "{said}");
    assert!(said.contains("; 50.00 % of the points decided (12 in ") && answer.status.code() == Some(1), "{said}");
    let text = fs::read_to_string(&lines).unwrap();
    let all = without_seconds(&text);
    assert_eq!((all.len(), all[0]["points"].as_u64()), (13, Some(12)));
    // The second axis varies faster, and values are exact.
    assert_eq!(
        (all[5]["values"].to_string(), all[4]["class"].as_str()),
        ("[\"1.4\",\"0.35\"]".into(), Some("one-rest-cycle"))
    );
    let said = String::from_utf8(program(&["check", &lines]).output().unwrap().stdout).unwrap();
    assert!(said.starts_with("confirmed, but not: points.components.area, points.components.closed"), "{said}");
    assert!(said.contains("confirmed are what is proved of every motion that touches a wall, at 9 points"), "{said}");

    let page = fs::read_to_string(&page).unwrap();
    assert!(page.starts_with("<!doctype html>") && page.contains("<title>A &lt;plane&gt; &amp; {{DATA}}: where every"));
    // Nothing comes from elsewhere.
    assert!(["=\"http", "=\"//", "url(", "import("].iter().all(|word| !page.contains(word)), "{page}");
    assert!(page.contains("<td>1.4</td><td>0.35</td><td>closed</td>"));
    let data = page.split_once("type=\"application/json\">").unwrap().1.split_once("</script>").unwrap().0;
    let data: Value = serde_json::from_str(data).unwrap();
    assert_eq!(data["leaves"].as_array().unwrap().len(), 12);
    let leaf = &data["leaves"][3];
    let command = data["command"].as_str().unwrap();
    let words: Vec<&str> = command.split(' ').skip(1).take_while(|word| !word.starts_with("<<")).collect();
    let mut again =
        program(&words).args(["--format", "json"]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    again.stdin.take().unwrap().write_all(leaf["scene"].as_str().unwrap().as_bytes()).unwrap();
    let again: Value = serde_json::from_slice(&again.wait_with_output().unwrap().stdout).unwrap();
    assert_eq!((&again["class"], &again["statement"]), (&all[4]["class"], &leaf["statement"]));
    assert_eq!((&again["components"], &again["order"]), (&all[4]["components"], &all[4]["order"]));
}

/// Shards, put together, and an atlas that goes on from what is kept are the whole, but for the seconds; the table has a row a point.
#[test]
fn shards_and_kept_points_make_the_whole() {
    let folder = folder("atlas-shards");
    let scene = scene(&folder);
    let plane = ["--over", "amplitude=2.2..3:2", "--over", "restitution=0.1..0.2:2", "--effort", "0.02"];
    let made = |name: &str, more: &[&str]| {
        let path = folder.join(name);
        let answer = verb("atlas", &[&[scene.as_str()], &plane[..], more].concat()).arg("--output").arg(&path).output();
        assert_eq!(answer.unwrap().status.code(), Some(0));
        path.to_str().unwrap().to_owned()
    };
    let whole = fs::read_to_string(made("whole.jsonl", &["--threads", "1"])).unwrap();
    let shards = ["1", "2", "3"].map(|number| made(&format!("{number}.jsonl"), &["--shard", &format!("{number}/3")]));
    let merged = folder.join("merged.jsonl");
    let merge: Vec<&str> = ["--merge"].into_iter().chain(shards.iter().map(String::as_str)).collect();
    assert_eq!(verb("atlas", &merge).arg("--output").arg(&merged).status().unwrap().code(), Some(0));
    let merged = fs::read_to_string(merged).unwrap();
    assert_eq!(without_seconds(&merged), without_seconds(&whole));

    // As after a crash: two points are kept, and their seconds with them.
    let sealed = |line: &str| format!("{:08x} {line}\n", crc(line.as_bytes()));
    let kept: String = merged.lines().take(3).map(sealed).collect();
    fs::write(folder.join("again.csv.partial"), kept).unwrap();
    let again = fs::read_to_string(made("again.csv", &["--resume"])).unwrap();
    assert!(again.starts_with(
        "point,amplitude,restitution,class,n_attracting,n_rest,n_saddle,n_undecided,undecided_area,seconds\n"
    ));
    let first: Value = serde_json::from_str(merged.lines().nth(1).unwrap()).unwrap();
    let row = format!("0,2.2,0.1,one-rest-cycle,0,1,0,0,0,{}", first["seconds"]);
    assert_eq!((again.lines().nth(1), again.lines().count()), (Some(row.as_str()), 5));
    assert!(!files(&folder).iter().any(|name| name.ends_with(".partial")));
}

/// All parameters of cells: a row a cell, with its ends; what is decided of the plane is said, of a shard that of its part.
#[test]
fn cells_hold_for_all_their_parameters() {
    let folder = folder("atlas-cells");
    let scene = scene(&folder);
    let plane = ["--over", "amplitude=2.5..3:2", "--over", "restitution=0.05..0.1:2", "--cells", "--effort", "0.2"];
    let answer = verb("atlas", &[&[scene.as_str()], &plane[..]].concat()).output().unwrap();
    let (table, said) = (String::from_utf8(answer.stdout).unwrap(), String::from_utf8(answer.stderr).unwrap());
    assert!(said.starts_with("certified: 4 cells, 4 one-rest-cycle; 100.00 % of the plane decided"), "{said}");
    assert!(table.starts_with("point,amplitude_low,amplitude_high,restitution_low,restitution_high,class,"), "{table}");
    assert!(table.contains("\n3,2.75,3,0.075,0.1,one-rest-cycle,0,1,0,0,0,"), "{table}");
    let answer = verb("atlas", &[&[scene.as_str(), "--shard", "1/4"], &plane[..]].concat()).output().unwrap();
    let said = String::from_utf8(answer.stderr).unwrap();
    assert!(said.starts_with("certified: 1 cell, 1 one-rest-cycle; 100.00 % of this part of the plane"), "{said}");
}
