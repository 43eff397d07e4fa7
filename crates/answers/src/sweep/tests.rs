//! Sweeps over what one of several terms has: points of one unit, phases of the reference, and periods in cycles or in time.

use impact_pair::Scene;
use impact_pair::exact::Exact;
use impact_pair::orbit::{Orbit, Settings};
use impact_pair::watch::Unwatched;
use serde_json::{Value, json};

use super::{PointSettings, Sweep};
use crate::grid::{Grid, Survey};

/// The lines of a sweep: impacts 4 to 8 of each point.
fn sweep(scene: &str, over: &[&str]) -> Vec<Value> {
    let scene = Scene::parse(scene).unwrap();
    let grid = Grid::new(over.iter().map(|axis| axis.parse().unwrap()).collect()).unwrap();
    let settings = Settings { digits: 6, ..Settings::default() };
    let reference = grid.reference(&scene).unwrap();
    let requested = PointSettings { transient: 3, impacts: 5, summary: false, reference, settings };
    let points = 0..grid.points();
    let sweep = Sweep::new(&scene, grid, requested, None);
    let line = |point| serde_json::from_str(&sweep.line(point, &Unwatched).unwrap().unwrap()).unwrap();
    std::iter::once(json!(sweep.head())).chain(points.map(line)).collect()
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
        let grid = Grid::new(over.iter().map(|axis| axis.parse().unwrap()).collect()).unwrap();
        for line in &lines[1..] {
            let values = grid.values(line["point"].as_u64().unwrap()).unwrap();
            let scene = grid.scene(&Scene::parse(TWO_TERMS).unwrap(), &values).unwrap();
            let harmonic = &scene.pair().excitation().terms()[term as usize - 1];
            let [frequency, delay] = [harmonic.frequency(), harmonic.phase()].map(|x| x.enclose(64).mid_rad().0);
            let claimed = |time: f64| (frequency * time + delay).rem_euclid(turn);
            let settings = Settings { impacts: Some(8), ..Settings::default() };
            let orbit = json!(Orbit::of(&scene, settings).unwrap().document());
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
        let line = Sweep::new(&scene, grid, requested, None).line(0, &Unwatched).unwrap().unwrap();
        serde_json::from_str::<Value>(&line).unwrap()["period"].clone()
    };
    let whole = period("2*pi");
    assert!(whole["cycles"] == 2 && whole["duration"].is_null() && whole["first"].is_object(), "{whole}");
    let broken = period("3/2*pi");
    assert!(broken["cycles"].is_null() && broken["first"].is_null(), "{broken}");
    assert!((middle(&broken["duration"]) - 2.0).abs() < 1e-12, "{broken}");
}
