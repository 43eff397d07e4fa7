//! `impact-pair trap` and `impact-pair chaos`: snapshots, and what of a document may be relied on.

use std::collections::BTreeSet;
use std::f64::consts::LN_2;
use std::fs;
use std::time::Instant;

use crate::common::{answer_to, folder, program, scene, snapshots};
use serde_json::Value;

/// The exponent is that of a floating orbit.
const FLOATING_POINT_EXPONENT: [(&str, &str); 1] = [(r"floating-point orbit: -?\d\.\d{3}", "floating-point orbit: ..")];

const BASES: [&str; 2] = ["--bases", "docs/bases-figure-14.json"];

snapshots! { FLOATING_POINT_EXPONENT;
    region_of_figure_14: program(&["trap", "scenes/figure-14.toml"]);
    region_of_figure_12: program(&["trap", "scenes/figure-12.toml"]);
    words_of_figure_14: program(&["trap", "scenes/figure-14.toml", "--words", "22"]);
    words_of_no_walls: program(&["trap", "scenes/figure-14.toml", "--words", "0"]);
    words_of_too_many_walls: program(&["trap", "scenes/figure-14.toml", "--words", "1000000000000"]);
    words_without_a_region: program(&["trap", "scenes/chatter.toml", "--words", "5"]);
    graph_of_words: program(&["trap", "scenes/figure-12.toml", "--words", "5", "--format", "graphml"]);
    graph_of_boxes: program(&["trap", "scenes/figure-12.toml", "--format", "dot"]);
    region_of_chatter: program(&["trap", "scenes/chatter.toml"]);
    region_under_two_harmonics: program(&["trap", "scenes/two-tones.toml"]);
    horseshoe_of_figure_14: program(&["chaos", "scenes/figure-14.toml", BASES[0], BASES[1], "--depth", "3"]);
    horseshoe_over_a_range: program(&["chaos", "scenes/figure-14.toml", BASES[0], BASES[1], "--depth", "3", "--over", "gap=9.42477..9.42498"]);
    hyperbolic_horseshoe: program(&["chaos", "scenes/figure-14.toml", BASES[0], BASES[1], "--depth", "3", "--hyperbolic"]);
    hyperbolic_cells: program(&["chaos", "scenes/figure-14.toml", "--over", "amplitude=1..1.2:2", "--hyperbolic"]);
    horseshoe_within_a_part_in_ten_thousand:
        program(&["chaos", "scenes/figure-14.toml", BASES[0], BASES[1], "--depth", "3", "--over", "gap=9.42403..9.42591"]);
    cells_that_attract: program(&["chaos", "scenes/figure-14.toml", "--over", "amplitude=1..1.2:2"]);
    a_cell_that_is_undecided: program(&["chaos", "scenes/figure-14.toml", "--over", "amplitude=1..7:1", "--effort", "1/256"]);
    cells_without_a_number: program(&["chaos", "scenes/figure-14.toml", "--over", "amplitude=1..9:0"]);
    bases_for_cells: program(&["chaos", "scenes/figure-14.toml", BASES[0], BASES[1], "--over", "amplitude=8..9:3"]);
    bases_of_another_scene: program(&["chaos", "scenes/figure-17.toml", BASES[0], BASES[1], "--depth", "3"]);
    a_regular_motion: program(&["chaos", "scenes/figure-12.toml"]);
    chaos_under_two_harmonics: program(&["chaos", "scenes/two-tones.toml"]);
    bases_that_are_none: program(&["chaos", "scenes/figure-14.toml", "--bases", "scenes/figure-14.toml"]);
    arguments_of_trap: program(&["trap", "--help"]);
    arguments_of_chaos: program(&["chaos", "--help"]);
}

/// The bases that a document lists lead to the same words again.
#[test]
fn a_document_makes_itself_again() {
    let folder = folder("chaos");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let chaos = |bases: &str, name: &str| {
        let output = path(name);
        let asked = ["chaos", "scenes/figure-14.toml", "--depth", "3", "--bases", bases];
        let arguments = [&asked[..], &["--format", "json", "--output", &output]].concat();
        assert!(program(&arguments).status().unwrap().success());
        fs::read_to_string(output).unwrap()
    };
    let first = chaos(BASES[1], "first.json");
    assert_eq!(first, chaos(&path("first.json"), "second.json"));
    let document: Value = serde_json::from_str(&first).unwrap();
    assert_eq!(document["schema"], "impact-pair/chaos/1");
    let per_cycle: f64 = document["entropy"]["per_cycle"].as_str().unwrap().parse().unwrap();
    let least = LN_2 - 1e-6;
    assert!((least..=LN_2).contains(&per_cycle) && document["words"].as_array().unwrap().len() == 6);
    assert_eq!(document["words"][0]["impacts"], document["words"][0]["flights"].as_str().unwrap().len());
}

/// Files that cannot be written are reported before anything is computed: these commands would take minutes.
#[test]
fn files_are_opened_first() {
    let folder = folder("first");
    for verb in ["trap", "chaos"] {
        for (option, name) in [("--output", "file.json"), ("--plot", "file.svg")] {
            let nowhere = folder.join("nowhere").join(name);
            let nowhere = nowhere.to_str().unwrap();
            let begun = Instant::now();
            let output = program(&[verb, "scenes/figure-16.toml", option, nowhere]).output().unwrap();
            let said = String::from_utf8(output.stderr).unwrap();
            assert_eq!(output.status.code(), Some(2), "{verb} {option}");
            assert!(said.contains("cannot write") && output.stdout.is_empty(), "{said}");
            assert!(verb == "trap" || begun.elapsed().as_secs() < 20, "{verb} {option}");
        }
    }
}

/// The diagram in the colours of what is proved, and all of the range in the document.
#[test]
fn cells_are_written_and_drawn() {
    let folder = folder("cells");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let (output, plot) = (path("cells.json"), path("cells.svg"));
    let over = ["--over", "amplitude=1..1.1:2", "--effort", "0.25"];
    let files = ["--format", "json", "--output", &output, "--plot", &plot];
    let arguments = [&["chaos", "scenes/figure-14.toml"], &over[..], &files].concat();
    assert!(program(&arguments).status().unwrap().success());
    let document: Value = serde_json::from_str(&fs::read_to_string(output).unwrap()).unwrap();
    assert_eq!(
        (&document["schema"], &document["shares"]["attracted"]),
        (&"impact-pair/chaos-cells/1".into(), &1.0.into())
    );
    let stretch = &document["stretches"][0];
    assert_eq!((&stretch["low"], &stretch["high"]), (&"1".into(), &"1.1".into()));
    assert_eq!((&stretch["period"]["impacts"], &stretch["period"]["cycles"]), (&2.into(), &1.into()));
    let drawn = fs::read_to_string(plot).unwrap();
    assert!(drawn.starts_with("<svg") && drawn.contains("converges to a periodic one"));
}

/// "0.00 % hold a horseshoe" was said of a range where one is proved, since the scene's own orbit is attracted there.
#[test]
fn r35_a_horseshoe_and_an_orbit_that_is_attracted_do_not_exclude_each_other() {
    let over = ["chaos", "scenes/figure-14-sink.toml", "--over", "gap=9.4248032651..9.4248032653:1"];
    let said = program(&over).output().unwrap();
    assert_eq!(said.status.code(), Some(0));
    let said = String::from_utf8(said.stdout).unwrap();
    let shares = "over 100.00 % of the range the scene's own orbit is attracted, 100.00 % are proved to hold a horseshoe (100.00 % both)";
    assert!(
        said.contains(shares) && said.contains("20 impacts in 8 cycles, beside a horseshoe: entropy at least"),
        "{said}"
    );
    let document = program(&over).args(["--format", "json"]).output().unwrap();
    let document: Value = serde_json::from_slice(&document.stdout).unwrap();
    let stretch = &document["stretches"][0];
    assert_eq!((&stretch["verdict"], &stretch["period"]["impacts"]), (&"attracted".into(), &20.into()));
    assert!(stretch["entropy"]["per_impact"].as_str().unwrap().parse::<f64>().unwrap() > 0.3);
    assert!(!stretch["bases"].as_array().unwrap().is_empty());
    let shares = &document["shares"];
    assert_eq!((&shares["horseshoe"], &shares["attracted"], &shares["both"]), (&1.0.into(), &1.0.into(), &1.0.into()));
}

/// A ratio of amplitude and gap is the amplitude at the scene's own gap, in every verb that has --over; the document is that of the amplitude.
#[test]
fn a_ratio_is_the_amplitude_at_the_scenes_own_gap() {
    let folder = folder("ratio");
    let path = folder.join("scene.toml");
    fs::write(&path, scene("figure-14.toml").replace("gap = 9.42497", "d = 2").replace("amplitude = 8", "A = 8"))
        .unwrap();
    let scene = path.to_str().unwrap();
    for (verb, more, count) in [
        ("sweep", "--format jsonl --transient 10 --impacts 2", ":3"),
        ("atlas", "--over e=0.1..0.2:2 --format jsonl --effort 1e-4", ":2"),
        ("chaos", "--depth 1 --format json", ""),
        ("chaos", "--depth 1 --format json --effort 1/256", ":1"),
        ("bifurcations", "--word RL --cycles 1 --doublings 0 --format json", ""),
        ("windows", "--impacts 100 --format json", ""),
        ("tangency", "--longest 1 --format json", ""),
    ] {
        let answer = |over: &str| {
            let over = format!("{over}{count}");
            let words: Vec<&str> = more.split(' ').collect();
            let output = program(&[&[verb, scene, "--quiet", "--over", &over], &words[..]].concat()).output().unwrap();
            assert_ne!(output.status.code(), Some(2), "{verb}: {}", String::from_utf8_lossy(&output.stderr));
            let lines = serde_json::Deserializer::from_slice(&output.stdout).into_iter::<Value>();
            let mut lines: Vec<Value> = lines.map(Result::unwrap).collect();
            lines.iter_mut().filter(|line| line["seconds"].is_number()).for_each(|line| line["seconds"] = 0.into());
            lines
        };
        let found = answer("A/d=0.4..1/2");
        assert_eq!(found, answer("amplitude=0.8..1"), "{verb}");
        assert!(!found.is_empty() && !found[0].to_string().contains("A/d"), "{verb}");
    }
}

/// In a window that the scene's own orbit enters after a chaotic transient: the orbit that `run` proves it to converge to at one end is
/// that of the whole window.
#[test]
fn a_stable_orbit_is_proved_that_the_scenes_own_is_not_proved_to_converge_to() {
    let over = ["chaos", "scenes/figure-14.toml", "--over", "amplitude=6.218..6.22:1", "--effort", "1/256"];
    let output = program(&over).args(["--depth", "3", "--format", "json"]).output().unwrap();
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((output.status.code(), &document["shares"]["stable"]), (Some(0), &1.0.into()));
    let [stretch] = &document["stretches"].as_array().unwrap()[..] else { panic!("{document}") };
    assert_eq!(stretch["verdict"], "stable");
    let end = scene("figure-14.toml").replace("amplitude = 8", "amplitude = 6.22");
    let run = answer_to(&end, &["--impacts", "3000", "--format", "json"]);
    let run: Value = serde_json::from_slice(&run.stdout).unwrap();
    let orbit = &run["outcome"]["orbit"];
    let period = &stretch["period"];
    assert_eq!((&period["impacts"], &period["cycles"]), (&5.into(), &2.into()));
    assert_eq!((orbit["impacts"].as_array().map(Vec::len), &run["outcome"]["cycles"]), (Some(5), &2.into()), "{orbit}");
}

/// Shares of a range that doubles do not tell from a point were not numbers.
#[test]
fn r35_shares_of_a_range_below_the_resolution_of_doubles() {
    let over = ["chaos", "scenes/figure-14.toml", "--over", "amplitude=1..1.00000000000000000001:1"];
    let said = String::from_utf8(program(&over).output().unwrap().stdout).unwrap();
    assert!(said.contains("over 100.00 % of the range the scene's own orbit is attracted"), "{said}");
}

/// Both formats have the same nodes and edges; a node has an edge at least, as every motion goes on, and no letter leads to two nodes.
#[test]
fn graphs_are_written_in_two_languages() {
    let folder = folder("graphs");
    for (words, name) in [(None, "boxes"), (Some("3"), "words")] {
        let mut edges = Vec::new();
        for ending in ["graphml", "dot"] {
            let path = folder.join(format!("{name}.{ending}"));
            let mut arguments = vec!["trap", "scenes/figure-14.toml", "--output", path.to_str().unwrap()];
            arguments.extend(words.into_iter().flat_map(|words| ["--words", words]));
            assert!(program(&arguments).status().unwrap().success());
            edges.push(edges_of(&fs::read_to_string(path).unwrap()));
        }
        let from: BTreeSet<&str> = edges[0].iter().map(|edge| edge[0].as_str()).collect();
        let by_letters: BTreeSet<[&str; 2]> =
            edges[0].iter().map(|[from, letter, _]| [from.as_str(), letter]).collect();
        assert_eq!(edges[0], edges[1]);
        assert!(from.len() == (0..from.len()).filter(|node| from.contains(node.to_string().as_str())).count());
        assert!(by_letters.len() == edges[0].len() || words.is_none(), "{name}");
        assert!(if words.is_some() { from.len() < 100 } else { from.len() == 431 }, "{name}: {}", from.len());
    }
}

/// From where, by which letter, to where, of both formats.
fn edges_of(text: &str) -> Vec<[String; 3]> {
    let of_line = |line: &str| {
        let parts: Vec<&str> = if line.contains("<edge ") {
            let [_, from, _, to, _, flight, rest] = line.split('"').collect::<Vec<_>>()[..] else { panic!("{line}") };
            assert!(flight == "flight" && rest.ends_with("</data></edge>"), "{line}");
            vec![from, &rest[1..2], to]
        } else {
            let (from, rest) = line.trim().split_once(" -> ")?;
            let (to, rest) = rest.split_once(" [label=")?;
            vec![from, &rest[..1], to]
        };
        Some([parts[0].to_owned(), parts[1].to_owned(), parts[2].to_owned()])
    };
    text.lines().filter(|line| line.contains("<edge ") || line.contains(" -> ")).filter_map(of_line).collect()
}

/// Before a doubling a multiplier of the stable orbit is near -1, and sets come back after two rounds long before they do after one. The periods
/// are those of floating-point orbits of another program: 8 impacts, and 16 beyond the doubling, with the same word twice. Lemmas D15, V36
#[test]
fn r49_a_stable_orbit_is_given_with_its_shortest_period_where_a_word_is_repeated() {
    let path = folder("chaos-shortest").join("cells.json");
    let path = path.to_str().unwrap();
    for (over, impacts, cycles) in
        [("amplitude=8.47734375..8.477734375:2", 8, 3), ("amplitude=8.4822265625..8.482421875:1", 16, 6)]
    {
        let requested = ["--over", over, "--effort", "1/256", "--depth", "1", "--output", path, "--quiet"];
        program(&[&["chaos", "scenes/figure-14.toml"][..], &requested].concat()).output().unwrap();
        let document: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
        for stretch in document["stretches"].as_array().unwrap() {
            let period = &stretch["period"];
            assert_eq!((&period["impacts"], &period["cycles"]), (&impacts.into(), &cycles.into()), "{stretch}");
        }
        let said = String::from_utf8(program(&["check", path]).output().unwrap().stdout).unwrap();
        assert!(said.starts_with("confirmed: "), "{said}");
    }
}
