//! True documents of every schema that `check` reads, in several states of their flags.

use std::fs;

use impact_pair::Scene;
use impact_pair::chaos::{Chaos, Cycles, HorseshoeSettings};
use impact_pair::document;
use impact_pair::exact::Exact;
use impact_pair::json::GivenBase;
use impact_pair::orbit::{Arithmetic, Settings};
use impact_pair::periodic::bifurcation::{DiagramSettings, survey};
use impact_pair::periodic::{Budget, Precision, Problem};
use impact_pair::sweep::{self, Grid, PointSettings};
use impact_pair::units::Units;
use impact_pair::watch::Unwatched;
use serde_json::{Value, json};

use super::forged::{Original, with};
use crate::corrupted::{documents, others};
use impact_pair::scene::Range;

/// Kinds of documents, in the order of the table.
const KINDS: [&str; 17] = [
    "orbit",
    "shadow",
    "periodic",
    "two-impact",
    "bifurcations",
    "cycles",
    "windows",
    "global",
    "tangency",
    "trap",
    "chaos",
    "cells",
    "hyperbolic",
    "description",
    "sweep",
    "atlas",
    "list",
];

pub fn all() -> Vec<Original> {
    let mut all: Vec<Original> = documents::all().into_iter().map(|(name, document)| named(&name, document)).collect();
    all.extend(shadows());
    all.push(every_orbit());
    all.extend(bifurcations());
    all.extend([cycles(), trap("figure-14"), trap("figure-12"), chaos(None), chaos(Some("gap=9.42477..9.42498"))]);
    all.push(hyperbolic());
    all.extend(["attracted", "stable", "a horseshoe"].map(|name| Original::new("cells", name, others::cells(name))));
    all.push(Original::new("windows", "of two impacts", others::windows()));
    let globals = ["one cycle with rests", "one attractor", "attractors inside"];
    all.extend(globals.map(|name| Original::new("global", name, others::global(name))));
    all.push(Original::new("global", "a horseshoe", others::global_with_horseshoe()));
    all.push(Original::new("tangency", "beside figure 14", others::tangency()));
    all.push(Original::new("tangency", "over the restitution", others::tangency_over_restitution()));
    let described = ["figure-13", "chatter", "figure-14"];
    all.extend(described.map(|name| Original::new("description", name, others::description(name))));
    all.extend(sweeps());
    all.push(Original::new("atlas", "of four points", Value::Array(others::atlas(None))));
    all.push(Original::new("atlas", "of four cells", Value::Array(others::atlas_of_cells())));
    all.push(Original::new("atlas", "of a stable orbit", Value::Array(others::atlas_of_stable_orbit())));
    all.extend(left_open(&all));
    all.extend(lists(&all));
    all.sort_by_key(|original| KINDS.iter().position(|kind| *kind == original.kind));
    all
}

/// Tangencies with claims of boxes, which take seconds each.
pub fn in_boxes() -> Vec<Original> {
    let names = ["with common points", "over an interval"];
    let all = names.into_iter().zip(others::tangency_in_boxes());
    all.map(|(name, document)| Original::new("tangency", name, document)).collect()
}

fn named(name: &str, document: Value) -> Original {
    let kind = match (document["solved_for"].is_string(), document["orbits"].is_array()) {
        (true, _) => "two-impact",
        (_, true) => "periodic",
        _ if document["claim"] == "shadowed" => "shadow",
        _ => "orbit",
    };
    Original::new(kind, name, document)
}

fn figure(name: &str) -> Scene {
    Scene::parse(&fs::read_to_string(format!("{}/scenes/{name}.toml", impact_pair_tests::ROOT)).unwrap()).unwrap()
}

/// Chaotic ones that are longer than their exact starts' are, with first impacts proved by precision, up to a time, and where the
/// shadowed impacts end with a rest.
fn shadows() -> Vec<Original> {
    let of = |name: &str, scene: &Scene, settings: Settings| {
        let settings = Settings { arithmetic: Arithmetic::Shadow, until: None, ..settings };
        Original::new("shadow", name, json!(document::orbit(scene.pair(), scene.start(), settings).unwrap()))
    };
    let (steep, usual) = (figure("figure-14"), Settings::default());
    let resting = Scene::parse(
        r#"
        excitation = { amplitude = 4.92, frequency = "pi", phase = 0 }
        pair = { gap = 40, restitution = 0.5 }
        start = { time = 0, wall = "left", velocity = -5 }"#,
    )
    .unwrap();
    let inside = Scene::parse(
        r#"
        excitation = { amplitude = 8, frequency = "pi", phase = 0 }
        pair = { gap = 9.42497, restitution = 0.5 }
        start = { time = 0.1, position = 0.25, velocity = -12.56636 }"#,
    )
    .unwrap();
    vec![
        of("forty impacts", &steep, Settings { impacts: Some(40), ..usual.clone() }),
        of("spliced", &steep, Settings { impacts: Some(30), splice: 10, ..usual.clone() }),
        of("handed over", &resting, Settings { impacts: Some(70), ..usual.clone() }),
        of("from inside", &inside, Settings { impacts: Some(30), ..usual }),
    ]
}

fn scene(excitation: &str, gap: &str, restitution: &str) -> Scene {
    Scene::parse(&format!(
        "excitation = {{ {excitation} }}\npair = {{ gap = {gap}, restitution = {restitution} }}\n\
         start = {{ time = 0, wall = \"left\", velocity = -12 }}"
    ))
    .unwrap()
}

/// All orbits of a word.
fn every_orbit() -> Original {
    let scene = scene("amplitude = 2, frequency = \"pi\", phase = 0", "9.42497", "0.5");
    let problem = Problem::new(scene.pair(), &"P1 P2".parse().unwrap(), 1).unwrap();
    let census = problem.find_all(scene.start(), Precision::default(), Budget::default());
    let document = json!(Units::gaps(scene.pair()).unwrap().document(&problem, scene.start(), &census));
    assert_eq!(document["exhaustive"], true);
    Original::new("periodic", "every orbit", document)
}

/// Folds, pitchforks, doublings and grazes over the amplitude, of one harmonic and of one of two, the gap and the restitution.
fn bifurcations() -> Vec<Original> {
    let one = "amplitude = 0.36, frequency = \"pi\", phase = 0.25";
    let two = "amplitude = [0.36, 0.02], frequency = [\"pi\", \"3*pi\"], phase = [0.25, 0.4]";
    let of = |name: &str, (excitation, word, cycles): (&str, &str, u32), over: &str, (doublings, digits)| {
        let scene = scene(excitation, "1", "0.8");
        let precision = Precision { digits, ..Precision::default() };
        let diagram_settings = DiagramSettings { over: over.parse().unwrap(), doublings, precision };
        let word = word.parse().unwrap();
        let diagram = survey(scene.pair(), scene.start(), (&word, cycles), &diagram_settings, &Unwatched).unwrap();
        let document = json!(document::bifurcations(scene.start(), (&word, cycles), &diagram).unwrap());
        Original::new("bifurcations", name, document)
    };
    vec![
        of("over the amplitude", (one, "RL", 1), "amplitude=0.03..0.48", (1, 12)),
        of("with a graze", (one, "RL", 1), "amplitude=0.3..0.55", (1, 9)),
        of("over the gap", (one, "RL", 1), "gap=0.75..1.1", (1, 9)),
        of("over the restitution", (one, "RL", 1), "restitution=0.6..0.7", (0, 20)),
        of("of three impacts", (one, "LLR", 1), "amplitude=0.4..0.5", (0, 9)),
        of("over the first of two", (two, "RL", 3), "amplitude.1=0.03..0.05", (0, 12)),
        of("over the second of two", (two, "RL", 3), "amplitude.2=0..0.06", (0, 9)),
    ]
}

fn cycles() -> Original {
    let (scene, requested) = (figure("figure-14"), 1..=3);
    let found = Cycles::of(&scene, 0, &requested, Precision::default(), &Unwatched).unwrap();
    Original::new(
        "cycles",
        "of three impacts",
        json!(document::cycles(&scene, &requested, found.as_ref().map_err(|why| *why)).unwrap()),
    )
}

fn trap(name: &str) -> Original {
    Original::new("trap", name, others::region(name, 10))
}

fn chaos(over: Option<&str>) -> Original {
    let scene = figure("figure-14");
    let read = fs::read_to_string(format!("{}/docs/bases-figure-14.json", impact_pair_tests::ROOT)).unwrap();
    let bases: Vec<GivenBase> =
        serde_json::from_value(serde_json::from_str::<Value>(&read).unwrap()["bases"].clone()).unwrap();
    let question = HorseshoeSettings { depth: Some(3), bases: document::bases(&bases) };
    let over: Option<Range> = over.map(|over| over.parse().unwrap());
    let pair = match &over {
        Some(over) => scene.pair().with(over.key(), Exact::interval(over.low(), over.high()).unwrap()).unwrap(),
        None => scene.pair().clone(),
    };
    let found = Chaos::of(&pair, scene.start(), &question, &Unwatched).unwrap();
    let name = if over.is_some() { "over a range" } else { "of a point" };
    Original::new("chaos", name, json!(document::chaos(&scene, over.as_ref(), &found)))
}

/// The horseshoe of a point with what its hyperbolic set is measured to be.
fn hyperbolic() -> Original {
    let mut document = chaos(None).document;
    document["hyperbolic"] = crate::checked_chaos::hyperbolic(3)["hyperbolic"].clone();
    Original::new("hyperbolic", "of a point", document)
}

/// Impacts of points, over parameters and initial data; and basins, without impacts.
fn sweeps() -> Vec<Original> {
    let of = |name: &str, scene: &Scene, over: &[&str], requested: PointSettings| {
        let grid = Grid::new(over.iter().map(|axis| axis.parse().unwrap()).collect()).unwrap();
        let requested = PointSettings { reference: grid.reference(scene).unwrap(), ..requested };
        let mut lines = vec![json!(sweep::head(scene, &grid, &requested, None))];
        for number in 0..grid.points() {
            let values = grid.values(number).unwrap();
            let point = sweep::follow(&grid.scene(scene, &values).unwrap(), &requested, &Unwatched).unwrap().unwrap();
            lines.push(json!(sweep::record(number, &values, &point)));
        }
        Original::new("sweep", name, Value::Array(lines))
    };
    let settings = Settings { digits: 6, ..Settings::default() };
    let impacts = PointSettings { transient: 3, impacts: 5, summary: false, reference: None, settings };
    let basins = PointSettings { transient: 10, impacts: 10, summary: true, ..impacts.clone() };
    vec![
        of("of parameters", &figure("figure-14"), &["amplitude=7..9:3"], impacts.clone()),
        of("of starts", &figure("figure-14"), &["start.phase=0..1:2", "start.velocity=-13..-12:2"], impacts),
        of("of basins", &figure("figure-13"), &["start.velocity=-13..-12:2"], basins),
    ]
}

/// The same where it is left open whether orbits are physical.
fn left_open(all: &[Original]) -> Vec<Original> {
    let opened = |original: &Original| {
        let (list, within) = if original.is(&["bifurcations"]) { ("points", "/orbit") } else { ("orbits", "") };
        let count = original.document[list].as_array().unwrap().len();
        let mut document = with(&original.document, &[("/certified", json!(false))]);
        for k in 0..count {
            document = with(&document, &[(&format!("/{list}/{k}{within}/physical"), Value::Null)]);
        }
        // Orbits that may be no motions are not counted.
        if original.is(&["cycles"]) {
            document = with(
                &document,
                &[("/exhaustive", json!(false)), ("/no_attractor", json!(false)), ("/fixed_points", json!({}))],
            );
        }
        Original::new(original.kind, &format!("{}, open whether physical", original.name), document)
    };
    let names =
        ["stable and unstable", "two impacts", "over the amplitude", "over the first of two", "of three impacts"];
    all.iter().filter(|original| names.contains(&original.name.as_str())).map(opened).collect()
}

fn lists(all: &[Original]) -> Vec<Original> {
    let named = |name: &str| all.iter().find(|original| original.name == name).unwrap().document.clone();
    let of = |name: &str, documents: [&str; 2]| Original::new("list", name, json!(documents.map(named)));
    vec![of("orbits", ["two impacts", "every orbit"]), of("motions", ["stable and unstable", "time"])]
}
