//! `impact-pair global`: snapshots, and documents that are checked.

use std::fs;

use serde_json::Value;

use crate::common::{self, EXACT, folder, program, snapshots};

snapshots! { EXACT;
    arguments_of_global: program(&["global", "--help"]);
    global_of_figure_12: program(&["global", "scenes/figure-12.toml", "--effort", "0.1"]);
    global_under_two_harmonics: program(&["global", "scenes/two-tones.toml"]);
    global_of_no_effort: program(&["global", "scenes/figure-12.toml", "--effort", "0"]);
}

/// Two saddles and an attractor: the area of its basin, the graph in two languages, and the picture.
#[test]
fn a_basin_has_its_area_and_components_are_drawn() {
    let folder = folder("basin");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let [scene, json, svg] = ["scene.toml", "global.json", "global.svg"].map(path);
    let text = "excitation = { amplitude = 0.583258, frequency = \"pi\", phase = 0 }\n\
                pair = { gap = 1, restitution = 0.377273 }\nstart = { time = 0, wall = \"left\", velocity = -1 }\n";
    fs::write(&scene, text).unwrap();
    let requested = ["global", &scene, "--effort", "1/4", "--plot", &svg, "--output", &json, "--quiet"];
    assert!(program(&requested).status().unwrap().success());
    let text = fs::read_to_string(&json).unwrap();
    let document: Value = serde_json::from_str(&text).unwrap();
    let basins = &document["basins"];
    let [area, undecided] = [&basins["areas"][0]["area"], &basins["undecided"]].map(|part| part.as_str().unwrap());
    let sum: f64 = [area, undecided].iter().map(|part| part.parse::<f64>().unwrap()).sum();
    assert!((sum - 1.0).abs() < 1e-9, "{area} {undecided}");
    let drawn = fs::read_to_string(svg).unwrap();
    assert!(drawn.starts_with("<svg") && drawn.contains("every motion ends in 3 (attracting, 2 cycles): proved"));
    let graph = |format: &str| {
        let output = program(&["global", &scene, "--format", format, "--quiet"]).output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    };
    let (dot, graphml) = (graph("dot"), graph("graphml"));
    assert!(dot.contains("  0 [kind=\"saddle\", boxes=") && dot.contains("  2 [kind=\"attracting\", boxes="), "{dot}");
    assert!(dot.contains("  0 -> 2;") && !dot.contains("  2 -> "), "{dot}");
    assert_eq!(graphml.matches("<edge ").count(), dot.matches(" -> ").count());
    assert!(graphml.contains("<data key=\"kind\">saddle</data>"), "{graphml}");
}

/// Parameters of the reduced map beyond double precision are refused, not computed with.
#[test]
fn i58_amplitudes_beyond_double_precision_are_refused() {
    let folder = folder("global-beyond");
    let figure_14 = common::scene("figure-14.toml");
    let plane = ["--over", "gap=1..2:2", "--over", "restitution=0.1..0.2:2"];
    for amplitude in ["1e309", "1e-309"] {
        let path = folder.join(format!("{amplitude}.toml"));
        fs::write(&path, figure_14.replace("amplitude = 8", &format!("amplitude = \"{amplitude}\""))).unwrap();
        let scene = path.to_str().unwrap();
        let mut refused = vec![
            vec!["global", scene],
            [&["atlas", scene], &plane[..]].concat(),
            [&["atlas", scene, "--cells"], &plane[..]].concat(),
        ];
        // Of a small amplitude windows and tangencies find nothing, which is an answer.
        if amplitude == "1e309" {
            for verb in ["windows", "tangency"] {
                refused.extend(["gap=9..10", "restitution=0.4..0.5"].map(|over| vec![verb, scene, "--over", over]));
            }
        }
        for arguments in refused {
            let answer = program(&arguments).output().unwrap();
            let said = String::from_utf8(answer.stderr).unwrap();
            assert_eq!(answer.status.code(), Some(2), "{arguments:?}: {said}");
            assert!(said.contains("double-precision flights accept at most 2^400"), "{arguments:?}: {said}");
        }
    }
}
