//! Atlases of cells: what is claimed for all parameters of each, and which cells there are (Lemma V38).

use impact_pair_certificate::{Claims, Effort, Verdict};
use impact_pair_document::VerdictName;
use impact_pair_model::watch::Unwatched;
use serde_json::{Value, json};

/// The head of an atlas of cells over `A/d` and `e`, of which it is one shard: one tile.
fn head(over: [(&str, &str, &str, u64); 2], shard: [u64; 2]) -> Value {
    let axis =
        |(key, from, to, count): (&str, &str, &str, u64)| json!({ "key": key, "from": from, "to": to, "count": count });
    json!({
        "schema": "impact-pair/atlas/1", "program": "impact-pair 0.1.0", "title": null,
        "scene": {
            "excitation": { "amplitude": ["1"], "frequency": ["1"], "phase": ["0"] }, "gap": "1", "restitution": "0.5",
            "start": { "time": "0", "wall": "left", "velocity": "0" },
        },
        "over": over.map(axis), "points": shard[1], "cells": true,
        "boxes": 256, "halvings": 18, "most": 20000, "work": 5_000_000, "digits": 9, "shard": shard,
    })
}

/// The record of a cell, with one component of a kind.
fn record(point: u64, values: [&str; 2], class: &str, component: Value) -> Value {
    let counted = |kind: &str| u64::from(component["kind"] == kind);
    json!({
        "point": point, "values": values, "class": class, "n_attracting": counted("attracting"), "n_rest": counted("rest-cycle"),
        "n_saddle": counted("saddle"), "n_undecided": counted("undecided"), "undecided_area": component["area"], "seconds": 0.1,
        "greatest_speed": "4.015625", "components": [component], "order": [],
    })
}

/// The cycle with rests of one forcing period, half a period on each wall, for a wide range of parameters: as `atlas --cells` writes it.
fn rests(values: [&str; 2]) -> Value {
    let cycle = json!({ "kind": "rest-cycle", "cycles": 1, "alternates": true, "boxes": 0, "area": "0.000000", "closed": true });
    record(14, values, "one-rest-cycle", cycle)
}

fn open(point: u64, values: [&str; 2]) -> Value {
    let component = json!({ "kind": "undecided", "boxes": 9, "area": "0.500000", "closed": false, "reason": "most" });
    record(point, values, "undecided", component)
}

/// The last tile but one of 9 x 2 cells: two of them, each by itself.
pub fn cut() -> [Value; 2] {
    let mut tile = open(14, ["[2.4, 3]", "[0.05, 0.075]"]);
    tile["quarters"] = json!([rests(["[2.4, 2.7]", "[0.05, 0.075]"]), rests(["[2.7, 3]", "[0.05, 0.075]"])]);
    [head([("amplitude", "0.3", "3", 9), ("restitution", "0.05", "0.1", 2)], [15, 16]), tile]
}

/// A cell on which the equispaced motion (66) of two impacts in one forcing period is stable, between its fold and its pitchfork.
fn stable() -> [Value; 2] {
    let mut cell = open(0, ["[0.25, 0.2501]", "[0.5, 0.5001]"]);
    cell["stable"] = json!([{ "word": "P1 P2", "impacts": 2, "cycles": 1 }]);
    [head([("amplitude", "0.25", "0.2502", 2), ("restitution", "0.5", "0.5002", 2)], [1, 4]), cell]
}

fn verdict([head, tile]: &[Value; 2]) -> Verdict {
    let claims = Claims::parse(&format!("{head}\n{tile}\n")).unwrap();
    let Claims::Atlas(atlas) = &claims else { panic!("an atlas") };
    atlas.check_within(&Effort::default(), &Unwatched).unwrap()
}

/// The verdict on a copy with one value of the record at a path changed.
fn changed(atlas: &[Value; 2], path: &str, value: Value) -> Verdict {
    let mut atlas = atlas.clone();
    *atlas[1].pointer_mut(path).unwrap_or_else(|| panic!("{path}")) = value;
    verdict(&atlas)
}

#[test]
fn v38_cells_of_cycles_with_rests_are_confirmed() {
    assert!(matches!(verdict(&cut()), Verdict::Confirmed { .. }), "{:?}", verdict(&cut()));
}

#[test]
fn v38_cells_that_are_others_are_refuted() {
    let atlas = cut();
    let refuted = |path: &str, value: Value| {
        let found = changed(&atlas, path, value);
        assert!(matches!(found, Verdict::Refuted(_)), "{path}: {found:?}");
    };
    refuted("/values/0", json!("[2.4, 3.1]"));
    refuted("/quarters/0/values/0", json!("[2.4, 2.8]"));
    refuted("/quarters/0/values/0", json!("[2.7, 3]"));
    refuted("/quarters/1/values/1", json!("[0.05, 0.1]"));
    refuted("/quarters/1/point", json!(13));
    refuted("/quarters/1/n_rest", json!(2));
    refuted("/quarters/1/components/0/cycles", json!(2));
    refuted("/quarters/1/components/0/alternates", json!(false));
    refuted("/point", json!(15));
    for quarters in [json!([atlas[1]["quarters"][0]]), json!([atlas[1]["quarters"][1], atlas[1]["quarters"][0]])] {
        refuted("/quarters", quarters);
    }
    let more = json!([atlas[1]["quarters"][0], atlas[1]["quarters"][1], atlas[1]["quarters"][1]]);
    refuted("/quarters", more);
}

/// Keys that are not checked of a point are not checked of a cell that another one is cut into, and no key of one that claims nothing itself.
#[test]
fn r48_what_is_not_checked_of_a_cell_that_is_cut_is_named() {
    let [head, mut tile] = cut();
    tile["quarters"][1]["greatest_speed"] = json!("0.001");
    let text = format!("{head}\n{tile}\n");
    let claims = Claims::parse(&text).unwrap();
    let found = claims.document(&text, &claims.judge(&Effort::default(), &Unwatched).unwrap());
    assert_eq!(found.verdict, VerdictName::Confirmed, "{}", found.message);
    let of_quarter = ["greatest_speed", "undecided_area", "seconds", "components[0].area", "components[0].boxes"];
    let of_quarter = of_quarter.map(|key| format!("quarters[1].{key}"));
    let of_tile = ["class", "components", "n_attracting", "n_rest", "n_saddle", "n_undecided"].map(str::to_owned);
    for path in of_quarter.iter().chain(&of_tile).map(|key| format!("points[0].{key}")) {
        assert!(found.not_checked.contains(&path), "{path}: {:?}", found.not_checked);
        assert!(found.claims.iter().all(|claim| claim.path != path), "{path}");
    }
    let listed = found.claims.iter().filter_map(|claim| claim.path.strip_prefix("points[0].quarters[1]."));
    let of_cell = ["point", "values", "class", "n_attracting", "n_rest", "n_saddle", "n_undecided"];
    let of_component = ["components[0].kind", "components[0].cycles", "components[0].alternates"];
    assert!(listed.eq(of_cell.into_iter().chain(of_component)), "{:?}", found.claims);
}

/// They are counted: each is listed once, from whichever of its impacts its word is read.
#[test]
fn r49_a_stable_orbit_of_a_cell_is_listed_once() {
    let atlas = stable();
    for again in ["P1 P2", "P2 P1"] {
        let both = json!([atlas[1]["stable"][0], { "word": again, "impacts": 2, "cycles": 1 }]);
        let found = changed(&atlas, "/stable", both);
        assert!(matches!(&found, Verdict::Undecided(finding) if finding.message.contains("stable[1]")), "{found:?}");
    }
}

/// Of a smallest cell that is undecided the stable orbit is claimed alone, for all its parameters.
#[test]
fn v38_stable_orbits_of_cells_are_proved_again() {
    let atlas = stable();
    assert!(matches!(verdict(&atlas), Verdict::Confirmed { .. }), "{:?}", verdict(&atlas));
    let others = [
        ("/stable/0/cycles", json!(2)),
        ("/stable/0/impacts", json!(4)),
        ("/stable/0/word", json!("P3 P1 P4 P2")),
        ("/stable", json!([atlas[1]["stable"][0], { "word": "P3 P4", "impacts": 2, "cycles": 1 }])),
    ];
    for (path, value) in others {
        let found = changed(&atlas, path, value);
        assert!(!matches!(found, Verdict::Confirmed { .. }), "{path}: {found:?}");
    }
    // At A/d = 0.6 the equispaced motion is beyond its pitchfork.
    let mut beyond = atlas;
    (beyond[0]["over"][0]["from"], beyond[0]["over"][0]["to"]) = (json!("0.6"), json!("0.6002"));
    let found = changed(&beyond, "/values/0", json!("[0.6, 0.6001]"));
    assert!(!matches!(found, Verdict::Confirmed { .. }), "{found:?}");
}
