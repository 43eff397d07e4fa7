//! Documents of the other verbs, as text: JSON Lines are several values.

use std::fs;

use crate::checked_documents::sweep_of;
use impact_pair::Scene;
use impact_pair::atlas::{self, Plane};
use impact_pair::chaos::{
    BoxGraph, Chaos, Cycles, FoundWindow, Global, GlobalSettings, HorseshoeSettings, Trap, WallWords, WindowSettings,
    Windows,
};
use impact_pair::describe::{Request, describe};
use impact_pair::document;
use impact_pair::json::{AtlasRecord, GivenBase};
use impact_pair::periodic::Precision;
use impact_pair::periodic::bifurcation::{DiagramSettings, Window, WindowSeed, survey};
use impact_pair::scene::Range;
use impact_pair::sweep::Head;
use impact_pair::watch::{Stage, Unwatched, proceed_if};
use serde_json::{Value, json};

fn file(name: &str) -> String {
    fs::read_to_string(format!("{}/{name}", impact_pair_tests::ROOT)).unwrap()
}

fn figure(name: &str) -> Scene {
    Scene::parse(&file(&format!("scenes/{name}.toml"))).unwrap()
}

fn bifurcations() -> Value {
    let scene = Scene::parse(
        r#"
        excitation = { amplitude = 0.36, frequency = "pi", phase = 0.25 }
        pair = { gap = 1, restitution = 0.8 }
        start = { time = 0, wall = "left", velocity = -1 }"#,
    )
    .unwrap();
    let precision = Precision { digits: 9, ..Precision::default() };
    let diagram_settings = DiagramSettings { over: "amplitude=0.3..0.4".parse().unwrap(), doublings: 1, precision };
    let requested = (&"RL".parse().unwrap(), 1);
    let diagram = survey(scene.pair(), scene.start(), requested, &diagram_settings, &Unwatched).unwrap();
    json!(document::bifurcations(scene.start(), requested, &diagram).unwrap())
}

fn chaos() -> Value {
    let read: Value = serde_json::from_str(&file("docs/bases-figure-14.json")).unwrap();
    let bases: Vec<GivenBase> = serde_json::from_value(read["bases"].clone()).unwrap();
    let (scene, question) = (figure("figure-14"), HorseshoeSettings { depth: Some(6), bases: document::bases(&bases) });
    let found = Chaos::of(scene.pair(), scene.start(), &question, &Unwatched).unwrap();
    json!(document::chaos(&scene, None, &found))
}

fn trap() -> Value {
    region("figure-14", 12)
}

/// A trapping region, and its words of `impacts` walls.
pub fn region(name: &str, impacts: u32) -> Value {
    let scene = figure(name);
    let trap = Trap::of(&scene, 0, &Unwatched).unwrap().unwrap();
    let words = WallWords::of(&BoxGraph::of(scene.pair(), &trap).unwrap(), impacts, &Unwatched).unwrap();
    let mut document = document::trap(&scene, &trap).unwrap();
    document.words = Some(document::wall_words(&words));
    json!(document)
}

/// A description of a motion, without a search for a horseshoe.
pub fn description(name: &str) -> Value {
    let (scene, request) = (figure(name), Request { impacts: 60, ..Request::default() });
    let found =
        describe(&scene, &request, &|at: Stage<'_>| proceed_if(!matches!(at, Stage::Horseshoe { .. }))).unwrap();
    json!(found.document(&scene, name).unwrap())
}

/// All cycles of figure 14 with one to `most` impacts.
pub fn cycles(most: u32) -> Value {
    let (scene, requested) = (figure("figure-14"), 1..=most);
    let found = Cycles::of(&scene, 0, &requested, Precision::default(), &Unwatched).unwrap();
    json!(document::cycles(&scene, &requested, found.as_ref().map_err(|why| *why)).unwrap())
}

/// The window of the equispaced orbit of two impacts, as a search finds windows.
pub fn windows() -> Value {
    let scene = Scene::parse(
        r#"
        excitation = { amplitude = 0.3, frequency = "pi", phase = 0.25 }
        pair = { gap = 1, restitution = 0.5 }
        start = { time = 0, wall = "left", velocity = -1 }"#,
    )
    .unwrap();
    let (over, precision): (Range, _) = ("amplitude=0.08..0.45".parse().unwrap(), Precision::default());
    let seed =
        WindowSeed { word: "RL".parse().unwrap(), cycles: 1, is_mirrored: true, phases: vec![0.34], parameter: 0.3 };
    let window = Window::of(scene.pair(), &over, &seed, precision, &Unwatched).unwrap().expect("a window");
    let windows = vec![FoundWindow { impacts: 1, flights: "F".to_owned(), window }];
    let settings = WindowSettings { over: over.clone(), impacts: 1, longest: 1, most: 1, precision };
    let found = Windows { over, windows, unproved: Vec::new(), seen: 1, interrupted: false };
    json!(document::windows(&scene, &settings, &found).unwrap())
}

/// `A/d` and `e` of a pair all of whose motions tend to one periodic motion, or to one of two saddles.
const ONE_ATTRACTOR: [&str; 2] = ["0.583258", "0.377273"];

/// The same of one with two attractors, of 2 and of 6 impacts of the reduced map, which few boxes leave in an undecided component.
const TWO_ATTRACTORS: [&str; 2] = ["0.443933", "0.786364"];

/// A global analysis: of a cycle with rests, of a periodic motion and a saddle, or of two attractors in a component that few boxes leave undecided.
pub fn global(name: &str) -> Value {
    // Of pairs with saddles basins take more boxes than a test has time for.
    let ([amplitude, restitution], settings) = match name {
        "one attractor" => (ONE_ATTRACTOR, GlobalSettings::default()),
        "attractors inside" => {
            (TWO_ATTRACTORS, GlobalSettings { boxes: 1 << 8, halvings: 1, most: 2_000, ..GlobalSettings::default() })
        }
        _ => (["2", "0.2"], GlobalSettings { basins: Some(1 << 10), ..GlobalSettings::default() }),
    };
    let scene = format!(
        "excitation = {{ amplitude = {amplitude}, frequency = \"pi\", phase = 0.25 }}\n\
         pair = {{ gap = 1, restitution = {restitution} }}\nstart = {{ time = 0, wall = \"left\", velocity = -1 }}"
    );
    let scene = Scene::parse(&scene).unwrap();
    let found = Global::of(scene.pair(), &settings, &Unwatched).unwrap();
    json!(document::global(&scene, &settings, &found).unwrap())
}

/// The output of `global scenes/figure-14.toml --boxes 10 --most 3000 --horseshoes 6 --format json`: a closed component with a horseshoe.
pub fn global_with_horseshoe() -> Value {
    serde_json::from_str(include_str!("global-horseshoe.json")).unwrap()
}

/// The plane of four points with cycles with rests, or a shard of it.
pub fn atlas(shard: Option<[u64; 2]>) -> Vec<Value> {
    plane(RESTS, false, shard)
}

/// The same of four cells.
pub fn atlas_of_cells() -> Vec<Value> {
    plane(RESTS, true, None)
}

/// A cell of which few boxes decide nothing, with the stable equispaced motion.
pub fn atlas_of_stable_orbit() -> Vec<Value> {
    plane(["amplitude=0.25..0.2502:2", "restitution=0.5..0.5002:2"], true, Some([1, 4]))
}

/// Axes of a plane of cycles with rests.
const RESTS: [&str; 2] = ["amplitude=2.2..3:2", "restitution=0.1..0.15:2"];

fn plane(axes: [&str; 2], has_cells: bool, shard: Option<[u64; 2]>) -> Vec<Value> {
    let scene = "excitation = { amplitude = 1, frequency = \"pi\", phase = 0.25 }\n\
                 pair = { gap = 1, restitution = 0.2 }\nstart = { time = 0, wall = \"left\", velocity = -1 }";
    let scene = Scene::parse(scene).unwrap();
    let plane = Plane::new(axes.map(|axis| axis.parse().unwrap()).to_vec(), has_cells).unwrap();
    let settings = GlobalSettings { boxes: 1 << 8, most: 1_000, ..GlobalSettings::default() };
    let head = atlas::head(&scene, &plane, &settings, shard);
    let own = (0..plane.points()).filter(|point| head.has(*point));
    let record = |point| atlas::record(&scene, &plane, &settings, point, &Unwatched).unwrap().unwrap();
    let records = own.map(|point| json!(AtlasRecord { seconds: 0.0, ..record(point) }));
    std::iter::once(json!(head)).chain(records).collect()
}

/// The output of `chaos scenes/figure-14.toml --over amplitude=RANGE --depth 4 --format json`: `attracted` over 2.25..2.252:1, `stable` over
/// 3.5969..3.5984:5 with `--halvings 1`, and a horseshoe over 9.4..9.41:1.
pub fn cells(name: &str) -> Value {
    let text = match name {
        "attracted" => include_str!("cells-attracted.json"),
        "stable" => include_str!("cells-stable.json"),
        _ => include_str!("cells-horseshoe.json"),
    };
    serde_json::from_str(text).unwrap()
}

/// The first homoclinic tangency beside figure 14, whose numbers Newton's iteration of another program found in 120 digits.
pub fn tangency() -> Value {
    let mut document: Value = serde_json::from_str(include_str!("../../docs/tangency-figure-14.json")).unwrap();
    document["tangencies"].as_array_mut().unwrap().truncate(1);
    document
}

/// The output of `tangency` for a tangency of ten flights: with the common points on either side, and for all values of an interval of
/// coefficients of restitution.
pub fn tangency_in_boxes() -> [Value; 2] {
    let [counted, interval] = [include_str!("tangency-counted.json"), include_str!("tangency-interval.json")];
    [counted, interval].map(|text| serde_json::from_str(text).unwrap())
}

/// The same over the restitution, at its gap: `D*` is that of a computation in 130 digits.
pub fn tangency_over_restitution() -> Value {
    let mut document = tangency();
    document["scene"]["gap"] = json!("8*1.17814079711090061855399854994343000656779766745018");
    let tangency = &mut document["tangencies"][0];
    let values = [
        ("key", json!("pair.restitution")),
        ("parameter", json!(["0.4999999999999999999999999999", "0.5000000000000000000000000001"])),
        ("unfolding", json!(["-150.1974", "-150.1973"])),
    ];
    for (key, value) in values {
        tangency[key] = value;
    }
    document
}

/// Confirmed documents, by the name of their verb.
pub fn all() -> Vec<(&'static str, Vec<Value>)> {
    let one = r#"
        excitation = { amplitude = 8, frequency = "pi", phase = 0.1 }
        pair = { gap = 9.42497, restitution = 0.5 }
        start = { time = 0, wall = "left", velocity = -12.56636 }"#;
    let two = r#"
        excitation = { amplitude = [8, 1], frequency = ["pi", "3/2*pi"], phase = [0.1, 1] }
        pair = { gap = 9.42497, restitution = 0.5 }
        start = { time = 0, wall = "left", velocity = -12.56636 }"#;
    let [counted, interval] = tangency_in_boxes();
    vec![
        ("bifurcations", vec![bifurcations()]),
        ("chaos", vec![chaos()]),
        ("trap", vec![trap()]),
        ("cycles", vec![cycles(3)]),
        ("windows", vec![windows()]),
        ("global", vec![global("one attractor")]),
        // Of a shard, since each change of it is checked.
        ("atlas", atlas(Some([1, 4]))),
        ("tangency", vec![tangency()]),
        ("tangency counted", vec![counted]),
        ("tangency interval", vec![interval]),
        ("cells", vec![cells("attracted")]),
        ("description", vec![description("figure-13")]),
        ("description of a region", vec![description("figure-14")]),
        ("sweep", sweep_of(one, &["amplitude=7..9:2", "start.phase=0..1:2"], 4)),
        ("sweep over a term", sweep_of(two, &["amplitude.2=0..1:2"], 4)),
    ]
}
