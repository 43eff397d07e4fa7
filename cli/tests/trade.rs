//! The table, the document and the picture of `trade`: everything but the times, which no two runs share.

use crate::common;
use std::fs;
use std::process::Command;

use crate::common::{files, folder, verb};
use impact_pair::orbit::INARI;
use impact_pair_certificate::document::TradeDocument;
use insta_cmd::assert_cmd_snapshot;
use serde_json::Value;

fn trade(arguments: &[&str]) -> Command {
    verb("trade", arguments)
}

/// Times, widths and errors, with the spaces before them; sizes are tested where they are proved.
const MEASURED: [(&str, &str); 4] = [
    (r"(auto, \d+ digits) +\d+", "$1  (bits)"),
    (r" +\d+\.?\d* +([\d.]+|-) +\d\.\de\d+ ", "  (time)  (time)  (rate) "),
    (r" +\d\.\de-\d+", "  (size)"),
    (r"impact \d+\)", "impact ..)"),
];

#[cfg(all(feature = "inari", target_feature = "fma"))]
#[test]
fn the_table() {
    insta::with_settings!({ filters => MEASURED.to_vec() }, {
        assert_cmd_snapshot!("figure_14_as_a_table", trade(&["scenes/figure-14.toml", "--impacts", "150"]));
    });
}

#[test]
fn the_command_line() {
    assert_cmd_snapshot!("arguments_of_trade", trade(&["--help"]));
    assert_cmd_snapshot!("no_impacts", trade(&["scenes/figure-12.toml", "--impacts", "0"]));
    assert_cmd_snapshot!("picture_of_another_kind", trade(&["scenes/figure-12.toml", "--plot", "trade.pdf"]));
    assert_cmd_snapshot!("trade_as_csv", trade(&["scenes/figure-12.toml", "--format", "csv"]));
    let twice = ["scenes/figure-12.toml", "--output", "a.svg", "--plot", "a.svg"];
    assert_cmd_snapshot!("one_file_for_both", trade(&twice));
    assert_cmd_snapshot!("trade_of_no_scene", trade(&["scenes/figure-99.toml"]));
}

#[test]
fn a_scene_that_asks_for_no_impact_is_refused() {
    let scene = folder("trade-no-impact").join("scene.toml");
    fs::write(&scene, common::scene("figure-12.toml").replace("impacts = 200", "impacts = 0")).unwrap();
    let answer = trade(&[scene.to_str().unwrap()]).output().unwrap();
    assert_eq!(answer.status.code(), Some(2));
    let text = String::from_utf8(answer.stderr).unwrap();
    assert!(text.contains("run.impacts is 0: no impacts to measure (try --impacts)"), "{text}");
}

#[test]
fn document_and_picture_are_written_atomically() {
    let folder = folder("trade-whole");
    let (document, picture) = (folder.join("trade.json"), folder.join("trade.svg"));
    let answer = trade(&["scenes/figure-14.toml", "--impacts", "120", "--format", "json"])
        .arg("--output")
        .arg(&document)
        .arg("--plot")
        .arg(&picture)
        .output()
        .unwrap();
    assert!(answer.status.success() && answer.stdout.is_empty() && answer.stderr.is_empty(), "{answer:?}");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 2);
    let document: Value = serde_json::from_str(&fs::read_to_string(&document).unwrap()).unwrap();
    let read: TradeDocument = serde_json::from_value(document.clone()).unwrap();
    assert_eq!(serde_json::to_value(&read).unwrap(), document);
    has_the_shape_of_a_trade(&document);
    let picture = common::words(&fs::read_to_string(&picture).unwrap());
    let wrong = "float (wrong word from impact ";
    for word in ["<svg", "Figure 14", "A = 8, Ω = π", wrong, "certified digits", "[µs]", "</svg>"] {
        assert!(picture.contains(word), "no {word}");
    }
}

fn has_the_shape_of_a_trade(document: &Value) {
    assert_eq!(document["schema"], "impact-pair/trade/1");
    assert_eq!(document["scene"]["gap"], "9.42497");
    assert_eq!(document["requested"]["impacts"], 120);
    assert_eq!(document["units"]["velocity"], "A W");
    assert_eq!(document["interrupted"], Value::Null);
    let rows = document["arithmetics"].as_array().unwrap();
    let names: Vec<_> = rows.iter().map(|arithmetic| arithmetic["name"].as_str().unwrap()).collect();
    let auto = ["auto, 3 digits", "auto, 9 digits", "auto, 15 digits", "auto, 30 digits", "auto, 100 digits"];
    let textbook: &[&str] = if INARI { &["inari"] } else { &[] };
    assert_eq!(names, [&["float", "interval"], textbook, &["shadow", "64 bits", "128 bits"], &auto].concat());
    for arithmetic in rows {
        let impacts = arithmetic["impacts"].as_u64().unwrap();
        assert_eq!(arithmetic["complete"], Value::Bool(impacts == 120), "{arithmetic}");
        assert_eq!(arithmetic["certified"], Value::Bool(arithmetic["name"] != "float"));
        assert!(arithmetic["outcome"]["kind"].is_string());
        assert!(arithmetic["seconds"]["repetitions"].as_u64().unwrap() > 0);
        let bits = arithmetic["arithmetic"]["bits"].as_u64();
        assert_eq!(bits.is_none(), arithmetic["name"] == "shadow");
        assert!(bits.is_none_or(|bits| bits >= 53));
        if impacts == 0 {
            assert!(
                arithmetic["impacts_per_second"].is_null()
                    && arithmetic["digits"].is_null()
                    && arithmetic["widths"].is_null()
            );
            continue;
        }
        assert!(arithmetic["impacts_per_second"].as_f64().unwrap() > 0.0);
        assert!(arithmetic["microseconds_per_impact"]["orbit"].as_f64().unwrap() > 0.0);
        if arithmetic["certified"] == true {
            let width =
                |of: &str, which: &str| arithmetic["widths"][of][which].as_str().unwrap().parse::<f64>().unwrap();
            let widest = width("time", "greatest").max(width("velocity", "greatest"));
            assert!(width("time", "last") <= width("time", "greatest"));
            let digits = arithmetic["digits"].as_f64().unwrap();
            assert!((-widest.log10() - digits).abs() < 0.02, "{arithmetic}");
            assert!(
                arithmetic["requested"]["digits"].as_f64().is_none_or(|requested| digits >= requested),
                "{arithmetic}"
            );
        }
    }
    // The true errors of the floating-point orbit do not depend on how they were determined, as far as doubles lead.
    let truth = &rows[0]["truth"];
    let [nine, ..] = truth["time_errors"].as_array().unwrap().as_slice() else { panic!("no errors: {truth}") };
    assert_eq!(nine["threshold"], "1e-9");
    assert!(nine["within"].as_u64().unwrap() > 20);
    assert_eq!(nine["within"].as_u64().unwrap() + 1, nine["exceeded"].as_u64().unwrap());
    assert_eq!(truth["judged"].as_u64().unwrap() + 1, truth["leaves_word"]["impact"].as_u64().unwrap());
}

#[cfg(unix)]
#[test]
fn ctrl_c_keeps_what_is_measured() {
    let folder = folder("trade-interrupted");
    let file = folder.join("trade.json");
    let long = ["scenes/figure-12.toml", "--impacts", "1000000000", "--format", "json", "--output"];
    // The draft appears after the handler is in place.
    let answer = common::interrupted(trade(&long).arg(&file), || !files(&folder).is_empty());
    assert_eq!(answer.status.code(), Some(1));
    assert_eq!(String::from_utf8(answer.stderr).unwrap(), "interrupted in row float\n");
    let document: Value = serde_json::from_str(&fs::read_to_string(&file).unwrap()).unwrap();
    assert_eq!(document["interrupted"], "float");
    assert!(document["arithmetics"].as_array().unwrap().is_empty());
}
