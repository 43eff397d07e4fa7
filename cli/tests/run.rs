//! Snapshots of stdout, stderr and exit code together.
//!
//! Digits that depend on how well the arithmetic rounds are left out: containment is tested where it is proved.
//! `INSTA_UPDATE=always validation/test --test cli` rewrites them; look at the difference before committing it.

use crate::common;
use crate::common::{UNCERTAIN, program, run, snapshots};
use crate::common::{answer_to, scene};

snapshots! { UNCERTAIN;
    figure_12_as_a_table: run(&["scenes/figure-12.toml", "--impacts", "4"]);
    figure_12_as_json: run(&["scenes/figure-12.toml", "--impacts", "4", "--format", "json"]);
    figure_12_as_json_lines: run(&["scenes/figure-12.toml", "--impacts", "4", "--format", "jsonl"]);
    figure_12_as_csv: run(&["scenes/figure-12.toml", "--impacts", "4", "--format", "csv"]);
    figure_12_in_floats: run(&["scenes/figure-12.toml", "--impacts", "4", "--arithmetic", "float"]);
    figure_12_in_float_json: run(&["scenes/figure-12.toml", "--impacts", "2", "--arithmetic", "float", "--format", "json"]);
    figure_12_exact_until_a_time: run(&["scenes/figure-12-exact.toml", "--impacts", "9", "--until", "7/2"]);
    figure_12_head_only: run(&["scenes/figure-12.toml", "--impacts", "0", "--format", "json"]);
    figure_14_goes_on_with_wider_enclosures:
        run(&["scenes/figure-14.toml", "--impacts", "30", "--arithmetic", "interval", "--format", "csv"]);
    figure_17_as_a_table: run(&["scenes/figure-17.toml", "--impacts", "20"]);
    unknown_format: run(&["scenes/figure-12.toml", "--format", "xml"]);
    too_many_digits: run(&["scenes/figure-12.toml", "--digits", "401"]);
    time_that_is_no_number: run(&["scenes/figure-12.toml", "--until", "soon"]);
    time_that_is_an_interval: run(&["scenes/figure-12.toml", "--until", "[1, 2]"]);
    scene_that_is_not_there: run(&["scenes/figure-99.toml"]);
    output_into_a_folder_that_is_not_there: run(&["scenes/figure-12.toml", "--output", "nowhere/events.csv"]);
    output_onto_a_folder: run(&["scenes/figure-12.toml", "--output", "scenes"]);
    output_onto_the_scene: run(&["scenes/figure-12.toml", "--output", "scenes/figure-12.toml"]);
    verbs_of_this_version: program(&["--help"]);
    arguments_of_run: run(&["--help"]);
    unknown_verb: program(&["juggle"]);
}

snapshots! { UNCERTAIN;
    cascade_as_a_table: program(&["bifurcations", "scenes/cascade.toml", "--word", "RL", "--cycles", "1",
        "--over", "amplitude=0.3..0.499", "--digits", "20"]);
    pitchfork_as_json: program(&["bifurcations", "scenes/cascade.toml", "--word", "RL", "--cycles", "1",
        "--over", "pair.gap=1.02..1.1", "--doublings", "0", "--format", "json"]);
    bifurcations_over_the_frequency: program(&["bifurcations", "scenes/cascade.toml", "--word", "RL", "--cycles", "1",
        "--over", "frequency=1..2"]);
    bifurcations_over_no_parameter: program(&["bifurcations", "scenes/cascade.toml", "--word", "RL", "--cycles", "1",
        "--over", "phase=1..2"]);
    bifurcations_of_several_harmonics: program(&["bifurcations", "scenes/square-wave.toml", "--word", "RL", "--cycles", "5",
        "--over", "amplitude.2=0..2", "--doublings", "1"]);
    bifurcations_over_one_of_several_frequencies: program(&["bifurcations", "scenes/square-wave.toml", "--word", "RL",
        "--cycles", "5", "--over", "frequency.1=3..4"]);
    arguments_of_bifurcations: program(&["bifurcations", "--help"]);
    figure_14_ends_where_the_digits_do: run(&["scenes/figure-14.toml", "--max-bits", "64", "--format", "csv"]);
    figure_14_ends_where_the_digits_do_quietly:
        run(&["scenes/figure-14.toml", "--max-bits", "64", "--format", "jsonl", "--quiet"]);
    figure_14_undecided_as_a_table: run(&["scenes/figure-14.toml", "--max-bits", "64"]);
    figure_14_in_multiprecision: run(&["scenes/figure-14.toml", "--impacts", "120", "--format", "jsonl"]);
    figure_12_in_thirty_digits: run(&["scenes/figure-12.toml", "--impacts", "3", "--digits", "30"]);
    figure_12_in_128_bits: run(&["scenes/figure-12.toml", "--impacts", "3", "--arithmetic", "128"]);
    figure_12_in_128_bits_as_json:
        run(&["scenes/figure-12.toml", "--impacts", "1", "--arithmetic", "128", "--format", "json"]);
    chatter_as_a_table: run(&["scenes/chatter.toml"]);
    chatter_as_json_lines: run(&["scenes/chatter.toml", "--digits", "3", "--impacts", "12", "--format", "jsonl"]);
    chatter_as_csv: run(&["scenes/chatter.toml", "--digits", "3", "--impacts", "12", "--format", "csv"]);
    graze_as_a_table: run(&["scenes/graze.toml"]);
    graze_in_doubles_as_json:
        run(&["scenes/graze.toml", "--impacts", "2", "--arithmetic", "interval", "--format", "json"]);
    too_few_bits: run(&["scenes/figure-12.toml", "--arithmetic", "32"]);
    too_few_bits_at_most: run(&["scenes/figure-12.toml", "--max-bits", "53"]);
}

/// The outcome and the number of events of `impact-pair run` on a scene of this excitation, pair and start.
fn end_of(excitation: &str, pair: &str, start: &str, arguments: &[&str]) -> (serde_json::Value, usize) {
    let scene = format!("excitation = {{ {excitation} }}\npair = {{ {pair} }}\nstart = {{ time = 0, {start} }}\n");
    let answer = common::answer_to(&scene, &[&["--format", "json"], arguments].concat());
    assert_eq!(answer.status.code(), Some(0), "{}", String::from_utf8_lossy(&answer.stderr));
    let document: serde_json::Value = serde_json::from_slice(&answer.stdout).unwrap();
    (document["outcome"].clone(), document["events"].as_array().unwrap().len())
}

/// Lemmas Z2-Z4: ends that no simulation reaches.
#[test]
fn outcomes_for_all_time_are_stated() {
    let shaken = "amplitude = 1, frequency = \"2*pi\", phase = 0";
    let (outcome, events) = end_of(shaken, "gap = 4, restitution = 0.5", "position = 0.5, velocity = \"-2*pi\"", &[]);
    assert_eq!((outcome["kind"].as_str(), events), (Some("never-impacts"), 0));
    let quiet = "amplitude = 0, frequency = 1, phase = 0";
    let (outcome, events) = end_of(quiet, "gap = 1, restitution = 0", "position = 0, velocity = 1", &[]);
    assert_eq!((outcome["kind"].as_str(), events), (Some("rests-forever"), 2));
    // Pressed against the left wall from the start, and released at t = 1 exactly; e = 0 rests again and again.
    let pressed = "amplitude = 1, frequency = \"pi\", phase = \"pi\"";
    let start = "wall = \"left\", velocity = 0";
    let (outcome, _) = end_of(pressed, "gap = 2, restitution = 0", start, &["--impacts", "5000"]);
    assert_eq!(outcome["kind"], "periodic");
}

#[cfg(not(all(feature = "inari", target_feature = "fma")))]
#[test]
fn a_build_without_the_textbooks_method_says_so() {
    let answer = run(&["scenes/figure-12.toml", "--arithmetic", "inari"]).output().unwrap();
    let text = String::from_utf8(answer.stderr).unwrap();
    assert_eq!(answer.status.code(), Some(2));
    assert!(text.contains("build impact-pair with the cargo feature \"inari\""), "{text}");
}

#[test]
fn every_scene_of_the_repository_is_certified() {
    let scenes = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes")).unwrap();
    let mut count = 0;
    for scene in scenes {
        let path = scene.unwrap().path();
        let answer = run(&[path.to_str().unwrap(), "--quiet"]).output().unwrap();
        assert!(answer.status.success(), "{path:?}: {}", String::from_utf8_lossy(&answer.stdout));
        count += 1;
    }
    assert!(count >= 7);
}

#[test]
fn a_scene_may_come_from_stdin() {
    let from_stdin = common::answer_to(&common::scene("figure-12.toml"), &["--impacts", "5"]);
    let from_file = run(&["scenes/figure-12.toml", "--impacts", "5"]).output().unwrap();
    assert_eq!(from_stdin, from_file);
}

#[test]
fn completions_exist_for_every_shell() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let answer = program(&["completions", shell]).output().unwrap();
        let script = String::from_utf8(answer.stdout).unwrap();
        assert!(answer.status.success() && answer.stderr.is_empty());
        for word in ["completions", "arithmetic", "format", "output"] {
            assert!(script.contains(word), "{shell} knows no {word}");
        }
        let knows_values = !matches!(shell, "elvish" | "powershell");
        assert!(!knows_values || script.contains("jsonl"), "{shell}");
    }
}

#[test]
fn columns_stand_below_their_names() {
    let scene = "excitation = { amplitude = 1, frequency = \"pi\", phase = 0 }\n\
                 pair = { gap = \"3*pi\", restitution = 0.5 }\n\
                 start = { time = 1000, wall = \"left\", velocity = \"-4*pi\" }";
    let answer = common::answer_to(scene, &["--impacts", "100"]);
    let text = String::from_utf8(answer.stdout).unwrap();
    let [names, rows @ ..] = text.lines().skip(4).take(101).collect::<Vec<_>>().leak() else { panic!("no table") };
    assert_eq!(rows.len(), 100);
    for name in ["mapping", "wall", "time", "velocity"] {
        let column = names.find(name).unwrap();
        for row in rows.iter() {
            let (left, right) = row.split_at(column);
            assert!(left.ends_with("  ") && !right.starts_with(' '), "{row}");
        }
    }
}

/// The impacts that the last line of an answer tells as certified to the digits; all of them where that is all that was requested.
fn reached(last: &str) -> u64 {
    let number = |after: &str| -> Option<u64> {
        let digits: String = last.split_once(after)?.1.chars().take_while(char::is_ascii_digit).collect();
        digits.parse().ok()
    };
    let decided =
        if last.starts_with("certified: ") { u64::MAX } else { number("undecided after impact ").unwrap_or(0) };
    number("; impact ").map_or(decided, |wide| wide - 1)
}

/// Each advice is followed in its case and leads further; where none is known to help, none is given.
#[test]
fn r62_advice_leads_further() {
    let last = |scene: &str, arguments: &str| {
        let arguments: Vec<&str> = arguments.split(' ').collect();
        let said = String::from_utf8(answer_to(scene, &arguments).stdout).unwrap();
        said.lines().last().unwrap().to_owned()
    };
    let chaos = scene("figure-14.toml");
    let wide = chaos.replace("gap = 9.42497", "gap = \"[9.42496, 9.42498]\"");
    let narrow = chaos.replace("gap = 9.42497", "gap = \"[9.4249699999, 9.4249700001]\"");
    let tame = |gap: &str| scene("figure-12.toml").replace("gap = 9.42497", &format!("gap = {gap}"));
    let of = |amplitude: u32, pair: &str, start: &str| {
        format!(
            "excitation = {{ amplitude = {amplitude}, frequency = 1, phase = 0 }}\npair = {{ {pair} }}\nstart = {{ {start} }}"
        )
    };
    const INTERVALS: &str = "narrower intervals in the scene lead further";
    const AUTO: &str = "try --arithmetic auto";
    let (few, many) = ("--impacts 200 --digits 2 --max-bits 96", "--impacts 200 --max-bits 400");
    let intervals = tame("\"[9.42, 9.43]\"");
    let few_digits = "try fewer --digits, or narrower intervals in the scene";
    // Past the graze of the right wall the states are a box, whose size the bits limit.
    let drift = "2*pi*sin(1/10)";
    let grazes = format!(
        "excitation = {{ amplitude = 1, frequency = \"2*pi\", phase = 0 }}\n\
         pair = {{ gap = \"sin(1/10)*(pi + 1/10) + 1 + cos(1/10)\", restitution = 0.5 }}\n\
         start = {{ time = 0.25, wall = \"left\", velocity = \"-2*{drift}\" }}"
    );
    // A scene and options with their advice, and what follows it.
    for (scene, arguments, advice, better) in [
        (&chaos, "--impacts 200 --arithmetic interval", AUTO, vec![(&chaos, "--impacts 200")]),
        (&chaos, "--impacts 200 --arithmetic 128", AUTO, vec![(&chaos, "--impacts 200")]),
        (&grazes, "--impacts 20 --arithmetic 256 --digits 50", AUTO, vec![(&grazes, "--impacts 20 --digits 50")]),
        (
            &chaos,
            "--impacts 200 --max-bits 96",
            "try fewer --digits or more --max-bits",
            vec![(&chaos, few), (&chaos, many)],
        ),
        (&chaos, "--impacts 200 --digits 1 --max-bits 96", "try more --max-bits", vec![(&chaos, many)]),
        (&wide, "--impacts 200", INTERVALS, vec![(&narrow, "--impacts 200")]),
        (
            &wide,
            "--impacts 200 --arithmetic interval",
            INTERVALS,
            vec![(&narrow, "--impacts 200 --arithmetic interval")],
        ),
        (&wide, "--impacts 200 --arithmetic 128", INTERVALS, vec![(&narrow, "--impacts 200 --arithmetic 128")]),
        (
            &intervals,
            "--impacts 9",
            few_digits,
            vec![(&intervals, "--impacts 9 --digits 1"), (&tame("\"[9.42497, 9.4249700000001]\""), "--impacts 9")],
        ),
    ] {
        let before = last(scene, arguments);
        assert!(before.ends_with(&format!("; {advice}")), "{arguments}: {before}");
        let is_interval = scene == &chaos && arguments.ends_with("interval");
        let wide = "too wide to decide (right wall";
        assert!(!is_interval || before.starts_with("undecided after impact ") && before.contains(wide), "{before}");
        for (scene, arguments) in better {
            let after = last(scene, arguments);
            assert!(reached(&after) > reached(&before), "{before}\n{arguments}: {after}");
        }
    }
    for scene in [
        // No time is found up to which the flight can be followed.
        of(0, "gap = 16, restitution = 0.5", "time = 0, wall = \"left\", velocity = -1e-15"),
        // The ball may stick to its wall, in any precision: a contact force that vanishes as the ball arrives, and a triple zero.
        of(1, "gap = \"pi\", restitution = 0", "time = 0, wall = \"left\", velocity = -1"),
        of(1, "gap = \"2*pi\", restitution = 0.5", "time = 0, wall = \"left\", velocity = 0"),
    ] {
        let said = last(&scene, "--impacts 10");
        assert!(said.starts_with("undecided") && !said.contains("; "), "{said}");
    }
}
