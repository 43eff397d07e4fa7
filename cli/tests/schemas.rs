//! The JSON Schemas in `docs/schemas` are those of the documents, and what the program writes is such documents.

use std::fs;
use std::path::Path;
use std::process::Command;

use impact_pair_certificate::document::{
    AtlasHead, AtlasRecord, AuditDocument, BifurcationDocument, ChaosCellsDocument, ChaosDocument, CheckDocument,
    CyclesDocument, DescriptionDocument, EventDocument, GlobalDocument, ManifoldDocument, OrbitDocument, OrbitEnd,
    OrbitHead, PeriodicDocument, SweepHead, SweepRecord, TangencyDocument, TradeDocument, TrapDocument,
    TwoImpactDocument, VerifiedDocument, WindowsDocument,
};
use schemars::{JsonSchema, schema_for};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// States of each struct that it has no other keys: what reads documents refuses them.
fn close(schema: &mut Value) {
    match schema {
        Value::Object(entries) => {
            if entries.get("properties").is_some_and(Value::is_object)
                && entries.get("type").is_some_and(Value::is_string)
            {
                entries.insert("additionalProperties".to_owned(), Value::Bool(false));
            }
            entries.values_mut().for_each(close);
        }
        Value::Array(items) => items.iter_mut().for_each(close),
        _ => {}
    }
}

/// `SCHEMAS_UPDATE=1` writes the file instead.
fn assert_is_kept<T: JsonSchema>(name: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/schemas").join(format!("{name}.json"));
    let mut schema = serde_json::to_value(schema_for!(T)).unwrap();
    close(&mut schema);
    let schema = format!("{}\n", serde_json::to_string_pretty(&schema).unwrap());
    if std::env::var_os("SCHEMAS_UPDATE").is_some() {
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, &schema).unwrap();
    }
    assert_eq!(fs::read_to_string(&path).unwrap_or_default(), schema, "{}: run with SCHEMAS_UPDATE=1", path.display());
}

#[test]
fn the_schemas_are_those_of_the_documents() {
    assert_is_kept::<OrbitDocument>("orbit");
    assert_is_kept::<OrbitHead>("orbit-lines-head");
    assert_is_kept::<EventDocument>("orbit-lines-event");
    assert_is_kept::<OrbitEnd>("orbit-lines-end");
    assert_is_kept::<PeriodicDocument>("periodic");
    assert_is_kept::<TwoImpactDocument>("two-impact");
    assert_is_kept::<ManifoldDocument>("manifold");
    assert_is_kept::<BifurcationDocument>("bifurcations");
    assert_is_kept::<TrapDocument>("trap");
    assert_is_kept::<ChaosDocument>("chaos");
    assert_is_kept::<ChaosCellsDocument>("chaos-cells");
    assert_is_kept::<CyclesDocument>("cycles");
    assert_is_kept::<WindowsDocument>("windows");
    assert_is_kept::<GlobalDocument>("global");
    assert_is_kept::<AtlasHead>("atlas-head");
    assert_is_kept::<AtlasRecord>("atlas-point");
    assert_is_kept::<TangencyDocument>("tangency");
    assert_is_kept::<DescriptionDocument>("description");
    assert_is_kept::<CheckDocument>("check");
    assert_is_kept::<VerifiedDocument>("verified");
    assert_is_kept::<AuditDocument>("audit");
    assert_is_kept::<SweepHead>("sweep-head");
    assert_is_kept::<SweepRecord>("sweep-point");
    assert_is_kept::<TradeDocument>("trade");
}

const SCENE: &str = r#"excitation = { amplitude = 1, frequency = "pi", phase = 0 }
pair = { gap = 9.42497, restitution = 0.5 }
start = { time = 0, wall = "left", velocity = -12.56636 }
run = { impacts = 20 }
"#;

/// The output of the program, run in a folder with the scene, an orbit of the scene and a list.
fn written(arguments: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    let run = ["run", "scene.toml", "--quiet", "--output", "orbit.json", "--format", "json"];
    Command::new(env!("CARGO_BIN_EXE_impact-pair")).current_dir(&folder).args(run).output().unwrap();
    fs::write(folder.path().join("list.csv"), "wall,time\nright,1.0\nleft,2.5\n").unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_impact-pair")).current_dir(&folder).args(arguments).output().unwrap();
    String::from_utf8(output.stdout).unwrap()
}

/// Read and written again it is the same, to the last key.
fn assert_is<T: DeserializeOwned + Serialize>(text: &str) {
    let value: Value = serde_json::from_str(text).unwrap();
    let read: T = serde_json::from_value(value.clone()).unwrap_or_else(|error| panic!("{error}: {text}"));
    assert_eq!(serde_json::to_value(&read).unwrap(), value);
}

#[test]
fn written_documents_are_read_back_unchanged() {
    assert_is::<OrbitDocument>(&written(&["run", "scene.toml", "--format", "json"]));
    assert_is::<CheckDocument>(&written(&["check", "orbit.json", "--format", "json"]));
    let lines = written(&["run", "scene.toml", "--format", "jsonl"]);
    let lines: Vec<&str> = lines.lines().collect();
    assert_is::<OrbitHead>(lines[0]);
    lines[1..lines.len() - 1].iter().for_each(|line| assert_is::<EventDocument>(line));
    assert_is::<OrbitEnd>(lines[lines.len() - 1]);
    let word = ["--word", "RL", "--cycles", "1", "--format", "json"];
    assert_is::<PeriodicDocument>(&written(&[&["periodic", "scene.toml"], &word[..]].concat()));
    let over = ["bifurcations", "scene.toml", "--over", "amplitude=1..2"];
    assert_is::<BifurcationDocument>(&written(&[&over[..], &word].concat()));
    assert_is::<TrapDocument>(&written(&["trap", "scene.toml", "--format", "json"]));
    assert_is::<ChaosDocument>(&written(&["chaos", "scene.toml", "--format", "json"]));
    let cells = ["chaos", "scene.toml", "--over", "amplitude=1..1.01:1", "--format", "json"];
    assert_is::<ChaosCellsDocument>(&written(&cells));
    assert_is::<DescriptionDocument>(&written(&["describe", "scene.toml", "--format", "json"]));
    assert_is::<CyclesDocument>(&written(&["cycles", "scene.toml", "--impacts", "1..2", "--format", "json"]));
    assert_is::<TwoImpactDocument>(&written(&["two-impact", "scene.toml", "--format", "json"]));
    let manifold = ["two-impact", "scene.toml", "--manifold", "frequency=2..4:5", "--format", "json"];
    assert_is::<ManifoldDocument>(&written(&manifold));
    assert_is::<AuditDocument>(&written(&["audit", "scene.toml", "list.csv", "--format", "json"]));
    let over = ["--over", "gap=2..3:2", "--over", "restitution=0.1..0.2:2", "--effort", "1e-6"];
    let atlas = written(&[&["atlas", "scene.toml", "--format", "jsonl"], &over[..]].concat());
    let (head, points) = atlas.split_once('\n').unwrap();
    assert_is::<AtlasHead>(head);
    points.lines().for_each(assert_is::<AtlasRecord>);
    let sweep = written(&["sweep", "scene.toml", "--over", "amplitude=1..2:3", "--format", "jsonl"]);
    let (head, points) = sweep.split_once('\n').unwrap();
    assert_is::<SweepHead>(head);
    points.lines().for_each(assert_is::<SweepRecord>);
}
