//! `impact-pair cycles`: snapshots, and what of a document may be relied on.

use std::fs;

use crate::common::{EXACT, folder, program, snapshots};
use serde_json::Value;

snapshots! { EXACT;
    cycles_of_figure_14: program(&["cycles", "scenes/figure-14.toml", "--impacts", "1..5"]);
    cycles_of_figure_12: program(&["cycles", "scenes/figure-12.toml", "--impacts", "1..2"]);
    cycles_of_figure_16: program(&["cycles", "scenes/figure-16.toml", "--impacts", "3"]);
    cycles_of_chatter: program(&["cycles", "scenes/chatter.toml", "--impacts", "1..3"]);
    cycles_under_two_harmonics: program(&["cycles", "scenes/two-tones.toml", "--impacts", "1..3"]);
    numbers_of_impacts_that_are_none: program(&["cycles", "scenes/figure-14.toml", "--impacts", "5..4"]);
    arguments_of_cycles: program(&["cycles", "--help"]);
}

/// The orbits of a document are proved again, and a corrupted one is refused.
#[test]
fn a_document_is_checked_orbit_by_orbit() {
    let folder = folder("cycles");
    let path = folder.join("cycles.json").to_str().unwrap().to_owned();
    let arguments =
        ["cycles", "scenes/figure-14.toml", "--impacts", "1..3", "--format", "json", "--output", &path, "--quiet"];
    assert!(program(&arguments).status().unwrap().success());
    let text = fs::read_to_string(&path).unwrap();
    let document: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(document["schema"], "impact-pair/cycles/1");
    assert_eq!(document["fixed_points"], serde_json::json!({ "1": 1, "2": 1, "3": 4 }));
    assert!(document["exhaustive"] == true && document["no_attractor"] == true);
    assert_eq!(document["orbits"][1]["reduced_impacts"], 3);
    let checked = program(&["check", &path]).output().unwrap();
    let said = String::from_utf8(checked.stdout).unwrap();
    assert!(checked.status.success() && said.contains("no_attractor; confirmed are 2 orbits"), "{said}");
    assert!(said.contains("exhaustive") && said.contains("fixed_points"), "{said}");
    let stable = text.replace("\"unstable\"", "\"stable\"");
    let says = |text: &str, words: &str| {
        fs::write(&path, text).unwrap();
        let checked = program(&["check", &path]).output().unwrap();
        let said = String::from_utf8(checked.stdout).unwrap();
        assert!(said.starts_with(words), "{said}");
    };
    says(&stable, "refuted: no_attractor");
    says(&stable.replace("\"no_attractor\":true", "\"no_attractor\":false"), "refuted: orbits[0]");
}

/// The one fixed point of the fourth iterate is a cycle of one impact, which was counted as one of four.
#[test]
fn r52_cycles_of_fewer_impacts_are_not_counted_as_cycles_of_more() {
    let last = |impacts: &str| {
        let answer = program(&["cycles", "scenes/figure-14.toml", "--impacts", impacts]).output().unwrap();
        String::from_utf8(answer.stdout).unwrap().lines().next_back().unwrap().to_owned()
    };
    let fewer = "and one of fewer impacts that returns after as many; none of them attracts";
    assert_eq!(last("4"), format!("certified: the region has no cycle of 4 impacts, {fewer}"));
    assert_eq!(last("3..4"), format!("certified: the region has exactly one cycle of 3 to 4 impacts, {fewer}"));
    assert_eq!(last("1..4"), "certified: the region has exactly 2 cycles of 1 to 4 impacts; none of them attracts");
}
