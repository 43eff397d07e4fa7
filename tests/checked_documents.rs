//! Sweeps, and documents one after another: what `check` proves of them, and nothing else is confirmed.

use crate::effort::effort;
use impact_pair::Scene;
use impact_pair::document;
use impact_pair::exact::Exact;
use impact_pair::orbit::Settings;
use impact_pair::pair::Wall;
use impact_pair::periodic::{Precision, Problem};
use impact_pair::sweep::{self, Grid, PointSettings};
use impact_pair::two_impact::{self, Unknown};
use impact_pair::units::Units;
use impact_pair::watch::Unwatched;
use impact_pair_certificate::{Claims, Verdict};
use serde_json::{Value, json};

/// The lines of a sweep: impacts 4 to 8 of each point.
fn sweep(scene: &str, over: &[&str]) -> Vec<Value> {
    sweep_of(scene, over, 5)
}

/// The lines of a sweep: `impacts` impacts of each point after a transient of three.
pub fn sweep_of(scene: &str, over: &[&str], impacts: u64) -> Vec<Value> {
    let scene = Scene::parse(scene).unwrap();
    let grid = Grid::new(over.iter().map(|axis| axis.parse().unwrap()).collect()).unwrap();
    let settings = Settings { digits: 6, ..Settings::default() };
    let reference = grid.reference(&scene).unwrap();
    let requested = PointSettings { transient: 3, impacts, summary: false, reference, settings };
    let mut lines = vec![json!(sweep::head(&scene, &grid, &requested, None))];
    for number in 0..grid.points() {
        let values = grid.values(number).unwrap();
        let point = sweep::follow(&grid.scene(&scene, &values).unwrap(), &requested, &Unwatched).unwrap().unwrap();
        lines.push(json!(sweep::record(number, &values, &point)));
    }
    lines
}

pub fn verdict(lines: &[Value]) -> Verdict {
    let text: Vec<_> = lines.iter().map(Value::to_string).collect();
    Claims::parse(&text.join("\n")).unwrap().check_within(&effort(), &Unwatched).unwrap()
}

/// The verdict on one document.
pub fn judged(document: &Value) -> Verdict {
    Claims::parse(&document.to_string()).unwrap().check_within(&effort(), &Unwatched).unwrap()
}

/// Whether a document is read and confirmed.
pub fn is_confirmed(lines: &[Value]) -> bool {
    let text: Vec<_> = lines.iter().map(Value::to_string).collect();
    let verdict = Claims::parse(&text.join("\n")).map(|claims| claims.check_within(&effort(), &Unwatched).unwrap());
    matches!(verdict, Ok(Verdict::Confirmed { .. }))
}

pub const SCENE: &str = r#"
    excitation = { amplitude = 8, frequency = "pi", phase = 0.1 }
    pair = { gap = 9.42497, restitution = 0.5 }
    start = { time = 0, wall = "left", velocity = -12.56636 }"#;

#[test]
fn r17_the_impacts_of_a_sweep_are_confirmed() {
    for over in [&["amplitude=7..9:3"][..], &["restitution=0.4..0.6:2", "start.phase=0..1:3"], &["gap=pi..4*pi:2"]] {
        let lines = sweep(SCENE, over);
        assert!(is_confirmed(&lines), "{over:?}: {:?}", verdict(&lines));
    }
    let inside = SCENE.replace("wall = \"left\"", "position = 1");
    let lines = sweep(&inside, &["start.position=-2..2:3", "start.velocity=1..2:2"]);
    assert!(is_confirmed(&lines), "{:?}", verdict(&lines));
}

#[test]
fn r17_no_sweep_that_is_changed_is_confirmed() {
    let lines = sweep(SCENE, &["amplitude=7..9:3", "start.phase=0..1:2"]);
    assert!(is_confirmed(&lines));
    let beside = |bounds: &Value, by: f64| {
        let moved = |end: usize| format!("{:.17}", bounds[end].as_str().unwrap().parse::<f64>().unwrap() + by);
        json!([moved(0), moved(1)])
    };
    let first = lines[2].clone();
    let state = &first["states"][2];
    for (line, path, value) in [
        (2, "/states/2/phase", beside(&state["phase"], 1e-3)),
        (2, "/states/2/phase", beside(&state["phase"], 2.0 * std::f64::consts::PI)),
        (2, "/states/2/phase", beside(&state["phase"], -2.0 * std::f64::consts::PI)),
        (2, "/states/2/velocity", beside(&state["velocity"], 1e-3)),
        (2, "/states/2/velocity", json!([state["velocity"][1], state["velocity"][0]])),
        (2, "/states/2/wall", json!(if state["wall"] == "left" { "right" } else { "left" })),
        (2, "/states/2/index", json!(7)),
        (2, "/states/4", first["states"][3].clone()),
        (2, "/states", json!([])),
        (2, "/impacts", json!(9)),
        (2, "/impacts", json!(7)),
        (2, "/point", json!(2)),
        (2, "/point", json!(100)),
        (2, "/values/0", json!("7.5")),
        (2, "/values/1", json!("0.9")),
        (0, "/scene/gap", json!("9.5")),
        (0, "/scene/restitution", json!("0.51")),
        (0, "/over/0/to", json!("10")),
        (0, "/over/0/key", json!("gap")),
        (0, "/over/1/count", json!(3)),
        (0, "/transient", json!(2)),
    ] {
        let mut copy = lines.clone();
        *copy[line].pointer_mut(path).expect(path) = value.clone();
        assert!(!is_confirmed(&copy), "{line}: {path}: {value}");
    }
    // The scene's own value of what varies only names it.
    let mut copy = lines.clone();
    *copy[0].pointer_mut("/scene/excitation/amplitude/0").unwrap() = json!("1");
    assert!(is_confirmed(&copy));
}

/// False values are refuted at an amplitude at which no bounce repeats a wall, so that nothing can rest.
#[test]
fn r17_an_impact_that_is_false_is_refuted() {
    let lines = sweep(&SCENE.replace("amplitude = 8", "amplitude = 2"), &["amplitude=2..2.1:2"]);
    assert!(is_confirmed(&lines));
    for (key, value) in [("velocity", json!(["1000", "1001"])), ("phase", json!(["0", "1e-9"]))] {
        let mut copy = lines.clone();
        copy[2]["states"][0][key] = value;
        assert!(matches!(verdict(&copy), Verdict::Refuted(_)), "{:?}", verdict(&copy));
    }
}

/// A chatter among the points leaves it undecided, however right the others are; a false one is found all the same.
#[test]
fn r17_a_point_that_is_not_proved_does_not_hide_one_that_is_false() {
    let chatter = r#"
        excitation = { amplitude = 1, frequency = "pi", phase = "pi" }
        pair = { gap = 9.42497, restitution = 0.3 }
        start = { time = 0, wall = "left", velocity = -0.5 }"#;
    let mut lines = sweep(chatter, &["restitution=0.1..0.2:2", "amplitude=1..8:2"]);
    assert!(matches!(verdict(&lines), Verdict::Undecided(_)), "{:?}", verdict(&lines));
    lines[4]["values"][0] = json!("0.15");
    assert!(matches!(verdict(&lines), Verdict::Refuted(_)), "{:?}", verdict(&lines));
}

pub fn two_impact(cycles: u32) -> Value {
    let scene = Scene::parse(&SCENE.replace("amplitude = 8", "amplitude = 2")).unwrap();
    let answer = two_impact::Problem::new(scene.pair(), cycles, Unknown::Velocity).unwrap().answer(9);
    json!(document::two_impact(scene.start(), &answer, Wall::Left))
}

#[test]
fn r17_documents_in_a_list_are_checked_one_by_one() {
    let both = json!([two_impact(1), two_impact(2)]);
    let claims = |document: &Value| Claims::parse(&document.to_string()).unwrap();
    let judged = |document: &Value| claims(document).check_within(&effort(), &Unwatched).unwrap();
    assert!(matches!(judged(&both), Verdict::Confirmed { .. }), "{:?}", judged(&both));
    assert!(claims(&both).all().starts_with("2 documents: "), "{}", claims(&both).all());
    assert!(claims(&both).unjudged().iter().any(|key| key == "[1].exhaustive"));
    let mut corrupted = both.clone();
    corrupted[1]["orbits"][0]["impacts"][0]["velocity"] = json!(["-1", "-0.9"]);
    match judged(&corrupted) {
        Verdict::Confirmed { .. } | Verdict::Interrupted { .. } => panic!("confirmed"),
        Verdict::Refuted(finding) | Verdict::Undecided(finding) => {
            let said = claims(&corrupted).described(&finding);
            assert!(said.starts_with("[1]: orbits[0]: "), "{said}");
        }
    }
    assert!(!matches!(judged(&json!([])), Verdict::Confirmed { .. }));
    assert!(Claims::parse("[1]").is_err());
}

/// A list of documents with a text after it is refused.
#[test]
fn r32_nothing_comes_after_a_list_of_documents() {
    let list = json!([two_impact(1)]).to_string();
    assert!(Claims::parse(&list).is_ok());
    for more in [&list[..], "{}", "1", "x"] {
        assert!(Claims::parse(&format!("{list}\n{more}")).is_err(), "{more}");
    }
}

/// The claimed cycle of an impact is checked: of even cycles and of several harmonics.
#[test]
fn r17_cycles_of_impacts_are_checked() {
    let scenes = [
        ("excitation = { amplitude = 1, frequency = 1, phase = 0 }\npair = { gap = 10.82, restitution = 0.5 }", 2),
        (
            "excitation = { amplitude = [1, \"1/5\"], frequency = [\"2*pi\", \"3*pi\"], phase = 0 }\npair = { gap = 9.42497, restitution = 0.5 }",
            6,
        ),
    ];
    for (scene, cycles) in scenes {
        let scene = format!("{scene}\nstart = {{ time = 0, wall = \"left\", velocity = -12 }}");
        let scene = Scene::parse(&scene).unwrap();
        let problem = Problem::new(scene.pair(), &"P1 P2".parse().unwrap(), cycles).unwrap();
        let census = problem.find(scene.start(), Precision { digits: 9, ..Precision::default() });
        let document = json!(Units::gaps(scene.pair()).unwrap().document(&problem, scene.start(), &census));
        for orbit in document["orbits"].as_array().unwrap() {
            assert_eq!(orbit["impacts"][0]["cycle"], 0, "counted from the first impact: {document}");
        }
        assert!(document["orbits"][0]["impacts"][1]["cycle"].is_i64(), "{document}");
        let judged = |document: &Value| {
            Claims::parse(&document.to_string()).unwrap().check_within(&effort(), &Unwatched).unwrap()
        };
        assert!(matches!(judged(&document), Verdict::Confirmed { .. }), "{:?} {document}", judged(&document));
        for (impact, by) in [(0, 1), (1, 1), (1, -1), (1, i64::from(cycles))] {
            let mut copy = document.clone();
            let claimed = &mut copy["orbits"][0]["impacts"][impact]["cycle"];
            *claimed = json!(claimed.as_i64().unwrap() + by);
            assert!(matches!(judged(&copy), Verdict::Refuted(_)), "{impact} {by}: {:?}", judged(&copy));
        }
    }
}

/// An orbit that runs through a shorter one several times says so: figure 12's two orbits of two impacts, once, twice and three times.
#[test]
fn r61_orbits_say_how_often_they_run_through_a_shorter_one() {
    let text = std::fs::read_to_string(format!("{}/scenes/figure-12.toml", impact_pair_tests::ROOT)).unwrap();
    let scene = Scene::parse(&text).unwrap();
    for times in 1..4 {
        let word = vec!["P2 P1"; times].join(" ").parse().unwrap();
        let problem = Problem::new(scene.pair(), &word, times as u32).unwrap();
        let census = problem.find(scene.start(), Precision { digits: 9, ..Precision::default() });
        let document = json!(Units::gaps(scene.pair()).unwrap().document(&problem, scene.start(), &census));
        assert_eq!(document["orbits"].as_array().unwrap().len(), 2, "{document}");
        for orbit in document["orbits"].as_array().unwrap() {
            assert_eq!(orbit.get("times").cloned(), (times > 1).then(|| json!(times)), "{document}");
        }
        let verdict = Claims::parse(&document.to_string()).unwrap().check_within(&effort(), &Unwatched).unwrap();
        assert!(matches!(verdict, Verdict::Confirmed { .. }), "{verdict:?} {document}");
    }
}

const TWO_TERMS: &str = r#"
    excitation = { amplitude = [8, 1], frequency = ["pi", "3/2*pi"], phase = [0.1, 1] }
    pair = { gap = 9.42497, restitution = 0.5 }
    start = { time = 0.3, wall = "left", velocity = -12.56636 }"#;

fn number(text: &Value) -> f64 {
    text.as_str().unwrap().parse::<Exact>().unwrap().enclose(64).mid_rad().0
}

fn middle(bounds: &Value) -> f64 {
    (number(&bounds[0]) + number(&bounds[1])) / 2.0
}

/// Over the amplitude of the fastest term from 0 all is continuous where no graze is near, and so are its properties: phases, impacts
/// a cycle, exponents an impact and a cycle.
#[test]
fn r32_points_of_one_sweep_have_one_unit() {
    let lines = sweep(TWO_TERMS, &["amplitude.2=0..1e-12:2"]);
    assert_eq!(lines[0]["reference"], 2);
    let [without, with] = [&lines[1], &lines[2]];
    let pairs = [
        (&without["impacts_per_cycle"], &with["impacts_per_cycle"]),
        (&without["exponent"]["per_impact"], &with["exponent"]["per_impact"]),
        (&without["exponent"]["per_cycle"], &with["exponent"]["per_cycle"]),
    ];
    let states = without["states"].as_array().unwrap().iter().zip(with["states"].as_array().unwrap());
    let states = states.flat_map(|(a, b)| ["phase", "velocity"].map(|key| (&a[key], &b[key])));
    for (a, b) in pairs.into_iter().chain(states) {
        assert!((middle(a) - middle(b)).abs() < 1e-6 * (1.0 + middle(a).abs()), "{a} {b}");
    }
    assert!(is_confirmed(&lines), "{:?}", verdict(&lines));
}

/// Phases are `W t + tau` of the reference at the times that an orbit of the same scene has, whichever term is the fastest, and a start's
/// phase is one of the reference as well.
#[test]
fn r32_phases_are_of_the_reference_whatever_is_the_fastest() {
    let turn = std::f64::consts::TAU;
    for (over, term) in [
        (&["frequency.2=pi/2..3/2*pi:3"][..], 2),
        (&["frequency.1=pi..2*pi:3"], 1),
        (&["amplitude.2=0..1:2", "start.phase=1..2:2"], 2),
        (&["phase.1=0..1:2", "amplitude.1=0..8:2"], 2),
    ] {
        let lines = sweep(TWO_TERMS, over);
        assert_eq!(lines[0]["reference"], term, "{over:?}");
        assert!(is_confirmed(&lines), "{over:?}: {:?}", verdict(&lines));
        let grid = Grid::new(over.iter().map(|axis| axis.parse().unwrap()).collect()).unwrap();
        for line in &lines[1..] {
            let values = grid.values(line["point"].as_u64().unwrap()).unwrap();
            let scene = grid.scene(&Scene::parse(TWO_TERMS).unwrap(), &values).unwrap();
            let harmonic = &scene.pair().excitation().terms()[term as usize - 1];
            let [frequency, delay] = [harmonic.frequency(), harmonic.phase()].map(|x| x.enclose(64).mid_rad().0);
            let claimed = |time: f64| (frequency * time + delay).rem_euclid(turn);
            let settings = Settings { impacts: Some(8), ..Settings::default() };
            let orbit = json!(document::orbit(scene.pair(), scene.start(), settings).unwrap());
            for (state, event) in
                line["states"].as_array().unwrap().iter().zip(&orbit["events"].as_array().unwrap()[3..])
            {
                let apart = (claimed(middle(&event["time"])) - middle(&state["phase"])).abs();
                assert!(apart < 1e-5 || turn - apart < 1e-5, "{over:?} {state} {event}");
            }
            if let Some(axis) = over.iter().position(|axis| axis.starts_with("start.phase")) {
                let start = claimed(scene.start().time().enclose(64).mid_rad().0);
                assert!((start - number(&line["values"][axis])).abs() < 1e-9, "{line}");
            }
        }
    }
}

/// The period of an attractor in cycles of the reference where they are a whole number, else in time: without the faster term it is that
/// of figure 13, 2.
#[test]
fn r32_a_period_that_is_no_whole_number_of_cycles_is_given_as_a_time() {
    let scene = |frequency: &str| {
        format!(
            "excitation = {{ amplitude = [2, 0.01], frequency = [\"pi\", \"{frequency}\"], phase = 0 }}
             pair = {{ gap = 9.42497, restitution = 0.5 }}
             start = {{ time = 0, wall = \"left\", velocity = -12.56636 }}"
        )
    };
    let period = |frequency: &str| {
        let scene = Scene::parse(&scene(frequency)).unwrap();
        let grid = Grid::new(vec!["amplitude.2=0..0.01:2".parse().unwrap()]).unwrap();
        let reference = grid.reference(&scene).unwrap();
        let settings = Settings { digits: 6, ..Settings::default() };
        let requested = PointSettings { transient: 60, impacts: 40, summary: true, reference, settings };
        let values = grid.values(0).unwrap();
        let point = sweep::follow(&grid.scene(&scene, &values).unwrap(), &requested, &Unwatched).unwrap().unwrap();
        json!(sweep::record(0, &values, &point))["period"].clone()
    };
    let whole = period("2*pi");
    assert!(whole["cycles"] == 2 && whole["duration"].is_null() && whole["first"].is_object(), "{whole}");
    let broken = period("3/2*pi");
    assert!(broken["cycles"].is_null() && broken["first"].is_null(), "{broken}");
    assert!((middle(&broken["duration"]) - 2.0).abs() < 1e-12, "{broken}");
}

/// Sweeps over what one of several terms has are read, and none is confirmed that is changed.
#[test]
fn r32_a_sweep_over_a_term_is_read_and_none_that_is_changed_is_confirmed() {
    for over in ["amplitude.2=0..1:3", "phase.1=0..1:2", "frequency.2=pi..3/2*pi:2"] {
        let lines = sweep(TWO_TERMS, &[over]);
        assert!(is_confirmed(&lines), "{over}: {:?}", verdict(&lines));
        for (line, path, value) in [
            (0, "/reference", json!(1)),
            (0, "/points", json!(5)),
            (0, "/over/0/key", json!("amplitude.1")),
            (0, "/over/0/to", json!("5")),
            (2, "/values/0", json!("0.7")),
        ] {
            let mut copy = lines.clone();
            *copy[line].pointer_mut(path).expect(path) = value.clone();
            assert!(!is_confirmed(&copy), "{over}: {line}: {path}: {value}");
        }
    }
    let mut wrong = sweep(TWO_TERMS, &["amplitude.2=0..1:2"]);
    for (key, value) in [
        ("reference", json!(3)),
        ("reference", json!(0)),
        ("over", json!([{"key": "amplitude.3", "from": "0", "to": "1", "count": 2}])),
    ] {
        wrong[0][key] = value;
        let text: Vec<_> = wrong.iter().map(Value::to_string).collect();
        assert!(Claims::parse(&text.join("\n")).is_err(), "{key}");
    }
}
