//! Bifurcations through the public API: against the closed forms, and against the stability of the orbits beside them.
#![cfg(feature = "multiprecision")]

mod tolerances;

use approx::assert_abs_diff_eq;
use impact_pair::exact::{Dyadic, Enclosure, Exact};
use impact_pair::periodic::bifurcation::{Diagram, End, Kind, Point, Wanted, survey};
use impact_pair::periodic::{Precision, Problem, Stability};
use impact_pair::{Harmonic, ImpactPair, Scene};
use tolerances::{CLOSED_FORM, QUOTIENT};

const SCENE: &str = r#"
    excitation = { amplitude = 0.36, frequency = "pi", phase = 0 }
    pair = { gap = 1, restitution = 0.8 }
    start = { time = 0, wall = "left", velocity = -1 }
"#;

fn diagram(over: &str, doublings: u32) -> Diagram {
    let scene = Scene::parse(SCENE).unwrap();
    let precision = Precision { digits: 20, ..Precision::default() };
    let wanted = Wanted { over: over.parse().unwrap(), doublings, precision };
    survey(scene.pair(), scene.start(), (&"RL".parse().unwrap(), 1), &wanted, || true).unwrap()
}

fn kinds(diagram: &Diagram) -> Vec<(Kind, u32)> {
    diagram.points.iter().map(|point| (point.kind, point.doublings)).collect()
}

fn width(x: &Enclosure) -> f64 {
    x.wid().to_f64_up()
}

/// Closed forms (Lemma W2 and W4): `A_sn = d/sqrt(4 + K^2)`, `A_pf = d sqrt(1 + 4 kappa^2/pi^2)/(K (1 - 4/pi^2))`, `kappa = 9`, `K = 9 pi`.
#[test]
fn fold_and_pitchfork_are_those_of_the_closed_forms_and_four_doublings_follow() {
    let diagram = diagram("amplitude=0.03..0.499", 4);
    let cascade = [1, 2, 3, 4].map(|n| (Kind::PeriodDoubling, n));
    assert_eq!(kinds(&diagram), [&[(Kind::Fold, 0), (Kind::Pitchfork, 0)], &cascade[..]].concat());
    assert!(diagram.is_certified());
    let forms = ["1/sqrt(4 + 81*pi^2)", "sqrt(1 + 324/pi^2)/(9*pi*(1 - 4/pi^2))"];
    for (point, form) in diagram.points.iter().zip(forms) {
        let exact = Exact::parse(form).unwrap().enclose(300);
        assert!(point.parameter.contains_enclosure(&exact), "{form}");
    }
    for point in &diagram.points {
        assert!(width(&point.parameter) < 1e-21);
        let orbit = point.orbit.as_ref().unwrap();
        assert_eq!(orbit.physical, Some(true));
        assert_eq!(point.symmetric, Some(point.kind != Kind::PeriodDoubling));
    }
    assert!(diagram.branches.iter().all(|branch| branch.is_proved));
    assert!(diagram.branches.iter().any(|branch| branch.ends.contains(&End::At(Kind::Pitchfork))));
}

/// The eigenvalue -1 is passed: the orbit of the doubled branch's parent is stable before and unstable after.
#[test]
fn stability_changes_at_each_doubling() {
    let diagram = diagram("amplitude=0.45..0.495", 3);
    let doublings: Vec<&Point> = diagram.points.iter().filter(|point| point.kind == Kind::PeriodDoubling).collect();
    assert_eq!(doublings.len(), 3);
    for point in doublings {
        let (at, _) = point.parameter.mid_rad();
        let stability = |amplitude: f64| {
            let harmonic = Harmonic::new(Exact::from_f64(amplitude).unwrap(), Exact::pi(), Exact::from(0)).unwrap();
            let pair = ImpactPair::new(harmonic, Exact::from(1), "0.8".parse().unwrap()).unwrap();
            let guess: Vec<f64> = point.impacts.iter().map(|impact| impact.phase.mid_rad().0).collect();
            let problem = Problem::new(&pair, &point.word, point.cycles).unwrap();
            problem.prove(&guess, Precision::default()).expect("an orbit beside the doubling").stability
        };
        assert_eq!(stability(at - 1e-7), Stability::Stable);
        assert_eq!(stability(at + 1e-7), Stability::Unstable);
    }
}

/// At `A = d/2` the velocity of the symmetric orbit is 0: `cos th = 0` in (66).
#[test]
fn the_unstable_symmetric_orbit_ends_in_a_graze_at_half_the_gap() {
    let diagram = diagram("amplitude=0.4..0.51", 0);
    let graze = diagram.points.iter().find(|point| point.kind == Kind::Graze).expect("a graze");
    let half = Enclosure::point(Dyadic::power_of_two(-1));
    assert!(graze.parameter.contains_enclosure(&half) && graze.orbit.is_none());
}

#[test]
fn over_the_gap_the_same_points_come_in_the_other_order() {
    let scene = Scene::parse(SCENE).unwrap();
    let wanted = Wanted { over: "gap=0.77..1.1".parse().unwrap(), doublings: 1, precision: Precision::default() };
    let diagram = survey(scene.pair(), scene.start(), (&"RL".parse().unwrap(), 1), &wanted, || true).unwrap();
    assert_eq!(kinds(&diagram), [(Kind::PeriodDoubling, 1), (Kind::Pitchfork, 0)]);
    let (gap, _) = diagram.in_units(&diagram.points[1]).unwrap();
    // 0.36/0.3458892783
    assert_abs_diff_eq!(gap.mid_rad().0, 1.040_795_48, epsilon = QUOTIENT);
}

#[test]
fn branches_under_several_harmonics_are_refused_in_one_line() {
    let scene = Scene::parse(include_str!("../scenes/square-wave.toml")).unwrap();
    for over in ["amplitude=1..2", "gap=1..2", "restitution=0.1..0.2", "frequency=1..2"] {
        let wanted = Wanted { over: over.parse().unwrap(), doublings: 0, precision: Precision::default() };
        let error = survey(scene.pair(), scene.start(), (&"RL".parse().unwrap(), 5), &wanted, || true).unwrap_err();
        let said = error.to_string();
        assert!(said.contains("has 3 harmonics") && said.contains("sweep --over amplitude.K"), "{said}");
    }
}

/// What is kept when a survey is ended early is among what the whole one proves, and it is not called all.
#[test]
fn a_survey_that_is_ended_keeps_what_is_proved() {
    let scene = Scene::parse(SCENE).unwrap();
    let wanted = Wanted { over: "amplitude=0.3..0.48".parse().unwrap(), doublings: 2, precision: Precision::default() };
    let asked = std::cell::Cell::new(0);
    let up_to = |most: u32| {
        asked.set(0);
        let goes_on = || asked.replace(asked.get() + 1) < most;
        survey(scene.pair(), scene.start(), (&"RL".parse().unwrap(), 1), &wanted, goes_on).unwrap()
    };
    let whole = up_to(u32::MAX);
    let all = asked.get();
    assert!(whole.is_certified() && !whole.interrupted && whole.points.len() == 2 && all > 100);
    let mut counts = Vec::new();
    for most in (0..10).map(|part| part * all / 10).chain([all - 1]) {
        let cut = up_to(most);
        assert!(cut.interrupted && !cut.is_certified(), "{most}");
        for point in &cut.points {
            let is_it = |other: &&Point| other.kind == point.kind && other.doublings == point.doublings;
            let same = whole.points.iter().find(is_it).expect("one of the whole survey's");
            assert_eq!(same.parameter, point.parameter);
        }
        counts.push(cut.points.len());
    }
    assert!(counts.is_sorted() && counts.contains(&0) && counts.contains(&2), "{counts:?}");
    let again = up_to(all);
    assert!(!again.interrupted && again.is_certified());
}

#[test]
fn over_the_frequency_nothing_bifurcates() {
    let diagram = diagram("frequency=1..2", 4);
    assert!(diagram.points.is_empty() && diagram.is_certified());
}

/// `A_pf(e) = 0.36` at the pitchfork over `e`.
#[test]
fn over_the_restitution_the_pitchfork_solves_the_closed_form() {
    let diagram = diagram("restitution=0.55..0.75", 0);
    let pitchfork = diagram.points.iter().find(|point| point.kind == Kind::Pitchfork).expect("a pitchfork");
    let (e, _) = pitchfork.parameter.mid_rad();
    let (kappa, pi) = ((1.0 + e) / (1.0 - e), std::f64::consts::PI);
    let amplitude = (1.0 + 4.0 * (kappa / pi).powi(2)).sqrt() / (pi * kappa * (1.0 - 4.0 / (pi * pi)));
    assert_abs_diff_eq!(amplitude, 0.36, epsilon = CLOSED_FORM);
}
