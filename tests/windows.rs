//! Windows of stable orbits through the public API: against the closed forms of two impacts, and against sinks of figure 14 that were found
//! and proved by other programs.

use impact_pair::Scene;
use impact_pair::chaos::{WindowSettings, Windows};
use impact_pair::exact::Exact;
use impact_pair::periodic::bifurcation::{Kind, NoWindow, Window, WindowSeed};
use impact_pair::periodic::{Precision, Stability};
use impact_pair::watch::{Stage, Unwatched, proceed_if};

use crate::setup::scene;

const SCENE: &str = r#"
    excitation = { amplitude = 0.3, frequency = "pi", phase = 0 }
    pair = { gap = 1, restitution = 0.8 }
    start = { time = 0, wall = "left", velocity = -1 }
"#;

/// The window of the equispaced orbit of two impacts, from a phase and a value of `A/d` or `e` in floating point.
fn window(over: &str, phase: f64, parameter: f64, digits: u32) -> Window {
    let scene = Scene::parse(SCENE).unwrap();
    let seed = WindowSeed { word: "RL".parse().unwrap(), cycles: 1, is_mirrored: true, phases: vec![phase], parameter };
    let precision = Precision { digits, ..Precision::default() };
    Window::of(scene.pair(), &over.parse().unwrap(), &seed, precision, &Unwatched).unwrap().expect("a window")
}

fn kinds(window: &Window) -> [Option<Kind>; 2] {
    window.ends.each_ref().map(|end| end.as_ref().map(|end| end.point.kind))
}

fn holds(window: &Window, end: usize, form: &str) {
    let exact = Exact::parse(form).unwrap().enclose(300);
    let found = &window.ends[end].as_ref().unwrap().parameter;
    assert!(found.contains_enclosure(&exact), "{form} is not in {found:?}");
}

/// Closed forms (Lemmas W2 and W4): `A_sn = d/sqrt(4 + K^2)`, `A_pf = d sqrt(1 + 4 kappa^2/pi^2)/(K (1 - 4/pi^2))`, `kappa = 9`, `K = 9 pi`.
/// Both eigenvalues are complex in between.
#[test]
fn the_window_of_two_impacts_is_that_of_the_closed_forms() {
    let window = window("amplitude=0.03..0.4", 0.28, 0.3, 20);
    assert_eq!(kinds(&window), [Some(Kind::Fold), Some(Kind::Pitchfork)]);
    assert!(window.is_certified() && window.orbit.stability == Stability::Stable);
    holds(&window, 0, "1/sqrt(4 + 81*pi^2)");
    holds(&window, 1, "sqrt(1 + 324/pi^2)/(9*pi*(1 - 4/pi^2))");
    let width = window.width().unwrap();
    assert!((width - 0.3105).abs() < 1e-3, "{width}");
}

/// Over the gap the same ends come in the other order.
#[test]
fn over_the_gap_the_ends_are_exchanged() {
    let window = window("gap=0.8..9", 0.28, 0.3, 9);
    assert_eq!(kinds(&window), [Some(Kind::Pitchfork), Some(Kind::Fold)]);
    assert!(window.is_stable_between);
    holds(&window, 0, "0.3*9*pi*(1 - 4/pi^2)/sqrt(1 + 324/pi^2)");
    holds(&window, 1, "0.3*sqrt(4 + 81*pi^2)");
}

/// A search that is stopped keeps what it has; a range of another key is refused.
#[test]
fn a_search_can_be_stopped_and_requires_a_parameter() {
    let scene = scene("figure-14");
    let over = |over: &str| over.parse().unwrap();
    let settings =
        |over, impacts| WindowSettings { over, impacts, longest: 20, most: 2, precision: Precision::default() };
    let stop = |at: Stage<'_>| proceed_if(!matches!(at, Stage::Searched(_)));
    let found = Windows::of(&scene, &settings(over("gap=9.4..9.5"), 1_000_000), &stop).unwrap();
    assert!(found.interrupted && found.windows.is_empty() && !found.is_certified());
    for refused in ["frequency=1..2", "start.velocity=-2..-1", "gap=9..10:3"] {
        assert!(Windows::of(&scene, &settings(over(refused), 1000), &Unwatched).is_err(), "{refused}");
    }
}

/// The symmetric orbit of 44 impacts beside the printed gap of figure 14, listed from an impact from which the curves next to the
/// ends are enclosed the widest.
#[test]
fn r50_the_window_of_44_impacts_is_proved_from_each_of_its_impacts() {
    let scene = scene("figure-14");
    let phases = vec![
        0.96038144142,
        1.28689507003,
        1.81338023917,
        2.28191475797,
        2.85376174154,
        3.2077140417,
        3.38281905672,
        3.82755357029,
        4.2360428389,
        4.42836125635,
        4.79465986524,
        5.29944195533,
        5.81311259119,
        6.27947727091,
        6.86053875211,
        7.19911684404,
        7.37140820356,
        7.84018323148,
        8.21563123342,
        8.39167555342,
        8.81973291511,
        9.24996417972,
    ];
    let word = "LRLRLRRLRRLRLRLRRLRRLRRLRLRLLRLLRLRLRLLRLLRL".parse().unwrap();
    let seed = WindowSeed { word, cycles: 17, is_mirrored: true, phases, parameter: 8.0 / 9.42499606 };
    let over = "gap=9.4247..9.4253".parse().unwrap();
    let window = Window::of(scene.pair(), &over, &seed, Precision::default(), &Unwatched).unwrap().expect("a window");
    assert!(window.is_certified(), "{:?}", window.reason);
    assert_eq!(kinds(&window), [Some(Kind::Pitchfork), Some(Kind::Fold)]);
    assert!((window.width().unwrap() / 3.603e-8 - 1.0).abs() < 1e-3);
}

/// Run through three times, the orbit of two impacts has no least period of six: nothing is claimed of it, whichever step notices that.
#[test]
fn r50_an_orbit_that_is_run_through_three_times_has_no_window() {
    let scene = Scene::parse(SCENE).unwrap();
    let phases = vec![0.28, 0.78, 1.28];
    let seed = WindowSeed { word: "RLRLRL".parse().unwrap(), cycles: 3, is_mirrored: true, phases, parameter: 0.3 };
    let over = "amplitude=0.03..0.4".parse().unwrap();
    let found = Window::of(scene.pair(), &over, &seed, Precision::default(), &Unwatched).unwrap();
    assert!(matches!(found, Err(NoWindow::Branch | NoWindow::Period)), "{:?}", found.err());
}

/// The sinks of the trial near the printed gap of figure 14: the value, and the width of the window in floating point.
const SINKS: [(&str, usize, f64, f64); 5] = [
    ("FNFFNFFFFFNFFNFFFFFFNNFFNFFNFFNFFFF", 35, 9.424970350220496, 1.3e-12),
    ("NFFNFFFFFNFFNFFFFFFNFF", 22, 9.424996066377793, 3.6e-8),
    ("", 24, 9.4250155997097, 2.6e-10),
    ("", 29, 9.424884702879044, 2.3e-10),
    ("", 20, 9.424803265174338, 1.8e-8),
];

/// Whether one sequence of flights is a cyclic rotation of another.
fn is_one(a: &str, b: &str) -> bool {
    a.len() == b.len() && (b.to_owned() + b).contains(a)
}

#[test]
#[ignore = "deep: 80,000,000 impacts; by default the_window_of_two_impacts_is_that_of_the_closed_forms"]
fn the_sinks_near_the_printed_gap_are_found_with_their_windows() {
    let scene = scene("figure-14");
    let settings = WindowSettings {
        over: "gap=9.4247..9.4253".parse().unwrap(),
        impacts: 80_000_000,
        longest: 44,
        most: 100,
        precision: Precision::default(),
    };
    let found = Windows::of(&scene, &settings, &Unwatched).unwrap();
    for (flights, impacts, gap, width) in SINKS {
        let own = found.windows.iter().find(|own| {
            let (at, _) = own.window.at.enclose(80).mid_rad();
            own.impacts == impacts && (at - gap).abs() < 2.0 * width
        });
        let own = own.unwrap_or_else(|| panic!("{impacts} impacts near {gap}"));
        assert!(flights.is_empty() || is_one(flights, &own.flights), "{}", own.flights);
        assert!(own.window.ends.iter().all(Option::is_some), "{impacts} impacts near {gap}");
        assert!(own.window.is_certified(), "{impacts} impacts near {gap}: {:?}", own.window.reason);
        let found = own.window.width().unwrap();
        assert!((0.8..1.25).contains(&(found / width)), "{impacts} impacts: {found} and {width}");
    }
}
