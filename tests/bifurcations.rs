//! Bifurcations through the public API: against the closed forms, and against the stability of the orbits beside them.

use std::sync::atomic::{AtomicU32, Ordering};

use crate::tolerances::{CLOSED_FORM, QUOTIENT};
use approx::assert_abs_diff_eq;
use impact_pair::exact::{Dyadic, Enclosure, Exact};
use impact_pair::periodic::bifurcation::{BranchEnd, Diagram, DiagramSettings, Kind, Point, survey};
use impact_pair::periodic::{PeriodicOrbit, Precision, Problem, Stability};
use impact_pair::scene::{Key, Range, Term};
use impact_pair::watch::{Stage, Unwatched, Watch, proceed_if};
use impact_pair::{Error, Harmonic, ImpactPair, Scene};

const SCENE: &str = r#"
    excitation = { amplitude = 0.36, frequency = "pi", phase = 0 }
    pair = { gap = 1, restitution = 0.8 }
    start = { time = 0, wall = "left", velocity = -1 }
"#;

/// What is found of a word in some cycles.
fn surveyed(
    scene: &str,
    (word, cycles): (&str, u32),
    over: &str,
    doublings: u32,
    watch: &dyn Watch,
) -> Result<Diagram, Error> {
    let scene = Scene::parse(scene).unwrap();
    let precision = Precision { digits: 20, ..Precision::default() };
    let diagram_settings = DiagramSettings { over: over.parse()?, doublings, precision };
    survey(scene.pair(), scene.start(), (&word.parse().unwrap(), cycles), &diagram_settings, watch)
}

fn diagram(over: &str, doublings: u32) -> Diagram {
    surveyed(SCENE, ("RL", 1), over, doublings, &Unwatched).unwrap()
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
    assert!(diagram.branches.iter().any(|branch| branch.ends.contains(&BranchEnd::Pitchfork)));
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

/// The mirror image of a word with more impacts on one wall has more on the other one: no orbit of it is its own, at a graze as well, where the orbit
/// has no derivative.
#[test]
fn r49_a_graze_of_an_orbit_of_three_impacts_is_not_symmetric() {
    let diagram = surveyed(&SCENE.replace("0.8", "0.5"), ("LLR", 1), "amplitude=0.5..0.6", 1, &Unwatched).unwrap();
    let grazes: Vec<&Point> = diagram.points.iter().filter(|point| point.kind == Kind::Graze).collect();
    assert!(!grazes.is_empty() && grazes.iter().all(|point| point.symmetric == Some(false)), "{grazes:?}");
}

/// For `e = 0`, where each flight leaves its wall without velocity: `A_sn = d/sqrt(4 + pi^2)`, the contact force ends at the impacts at `d = pi A`
/// (`th_g = 0`, Lemma W3), and the velocity is 0 at `A = d/2`, whatever the range.
#[test]
fn r62_without_restitution_branches_end_where_the_ball_begins_to_rest() {
    for over in ["amplitude=1..6", "amplitude=1.5..5"] {
        let diagram = of_hard_walls(["1.7", "6.3", "0"], over);
        assert_eq!(kinds(&diagram), [(Kind::Fold, 0), (Kind::Graze, 0), (Kind::Graze, 0)]);
        assert!(diagram.is_certified() && diagram.branches.len() == 1 && diagram.branches[0].is_proved);
        assert_eq!(diagram.branches[0].ends, [BranchEnd::Graze; 2]);
        assert_eq!(diagram.branches[0].range, [0, 2].map(|i: usize| diagram.points[i].parameter.mid_rad().0));
        for (point, form) in diagram.points.iter().zip(["1/sqrt(4 + pi^2)", "1/pi", "1/2"]) {
            assert!(point.parameter.contains_enclosure(&Exact::parse(form).unwrap().enclose(300)), "{form}");
        }
        assert_eq!(diagram.points[0].orbit.as_ref().unwrap().physical, Some(true));
    }
}

/// The branches of RL in one period for an amplitude, a gap and a restitution.
fn of_hard_walls([amplitude, gap, restitution]: [&str; 3], over: &str) -> Diagram {
    let scene = SCENE.replace("0.8", restitution).replace("gap = 1", &format!("gap = {gap}"));
    surveyed(&scene.replace("0.36", amplitude), ("RL", 1), over, 1, &Unwatched).unwrap()
}

/// The graze lies within a step of the end of the range: beyond `e = 0` nothing is a motion, but an orbit may seem to be one.
#[test]
fn a_graze_just_before_the_end_of_the_range_is_found() {
    for over in ["restitution=0..1", "restitution=0..0.5", "restitution=1e-6..1", "restitution=0..0.3"] {
        let diagram = of_hard_walls(["1", "3", "0"], over);
        assert_eq!(kinds(&diagram), [(Kind::Graze, 0)], "{over}");
        let graze = diagram.points[0].parameter.mid_rad().0;
        assert_abs_diff_eq!(graze, 0.000_916_946_148_03, epsilon = QUOTIENT);
        assert!(diagram.is_certified() && diagram.branches.iter().all(|branch| branch.is_proved), "{over}");
        let grazing = |ends: [BranchEnd; 2]| ends.contains(&BranchEnd::Graze);
        assert!(diagram.branches.iter().any(|branch| grazing(branch.ends) && branch.range[0] == graze), "{over}");
    }
}

/// Doubles do not tell the least distance after the start from the start itself: it is no graze where the ball is accelerated away. Each of the
/// three bifurcations differs from that of `e = 0` by less than the tolerance.
#[test]
fn a_flight_that_all_but_starts_at_rest_does_not_graze_its_start() {
    for restitution in ["1e-20", "1e-17", "1e-16", "1e-14", "1e-12"] {
        let diagram = of_hard_walls(["1", "3", restitution], "gap=0.5..8");
        let [graze, fold] = &diagram.points[..] else { panic!("{restitution}: {:?}", diagram.points) };
        assert_eq!([graze.kind, fold.kind], [Kind::Graze, Kind::Fold]);
        assert_abs_diff_eq!(graze.parameter.mid_rad().0, 0.5, epsilon = QUOTIENT);
        assert_abs_diff_eq!(1.0 / fold.parameter.mid_rad().0, 3.724_191_778_237, epsilon = QUOTIENT);
        // Where a touch is this near to the start, it is not proved, but it is not passed over.
        let [other] = &diagram.unproved[..] else { panic!("{restitution}: {:?}", diagram.unproved) };
        assert_abs_diff_eq!(1.0 / other.near, std::f64::consts::PI, epsilon = 1e-4);
        assert_eq!(diagram.branches[0].ends, [BranchEnd::Graze; 2]);
    }
    for over in ["gap=3.141587..3.141590", "gap=3.1..3.2", "gap=0.5..8"] {
        let diagram = of_hard_walls(["1", "3", "1e-12"], over);
        let [other] = &diagram.unproved[..] else { panic!("{over}: {:?}", diagram.unproved) };
        assert_abs_diff_eq!(1.0 / other.near, 3.141_588_034_785, epsilon = QUOTIENT);
        assert!(!diagram.is_certified());
    }
}

/// The three rounds of an orbit have its bifurcations, and what branches off has two periods, not six.
#[test]
fn r62_a_doubling_is_that_of_the_orbit_that_the_word_runs_through() {
    let diagram = surveyed(SCENE, ("RLRLRL", 3), "amplitude=0.46..0.465", 0, &Unwatched).unwrap();
    let [doubling] = &diagram.points[..] else { panic!("{:?}", diagram.points) };
    assert_eq!((doubling.kind, doubling.impacts.len(), doubling.cycles), (Kind::PeriodDoubling, 2, 1));
    assert!(diagram.is_certified() && diagram.branches.iter().any(|branch| branch.cycles == 3));
}

#[test]
fn over_the_gap_the_same_points_come_in_the_other_order() {
    let diagram = diagram("gap=0.77..1.1", 1);
    assert_eq!(kinds(&diagram), [(Kind::PeriodDoubling, 1), (Kind::Pitchfork, 0)]);
    let (gap, _) = diagram.in_units(&diagram.points[1]).unwrap();
    // 0.36/0.3458892783
    assert_abs_diff_eq!(gap.mid_rad().0, 1.040_795_48, epsilon = QUOTIENT);
}

/// The scene with other terms (amplitudes, frequencies, phases), and what is found of it.
fn under(terms: [&str; 3], cycles: u32, over: &str, doublings: u32) -> Result<Diagram, Error> {
    let [amplitude, frequency, phase] = terms;
    let lists = format!("amplitude = [{amplitude}], frequency = [{frequency}], phase = [{phase}]");
    let scene = SCENE.replace("amplitude = 0.36, frequency = \"pi\", phase = 0", &lists);
    surveyed(&scene, ("RL", cycles), over, doublings, &Unwatched)
}

/// Bounds of one number.
fn assert_are_the_same(several: &Diagram, one: &Diagram) {
    assert_eq!(kinds(several), kinds(one));
    assert!(several.is_certified() && one.is_certified() && !one.points.is_empty());
    for (several_point, point) in several.points.iter().zip(&one.points) {
        let [a, b] =
            [(several, several_point), (one, point)].map(|(diagram, point)| diagram.in_units(point).unwrap().0);
        assert!(a.intersection(&b).is_some() && width(&a) < 1e-19, "{a:?} {b:?}");
        assert_eq!(several_point.symmetric, point.symmetric);
        let [a, b] = [several_point, point].map(|point| point.orbit.as_ref().and_then(|orbit| orbit.physical));
        assert_eq!((a, a.is_some()), (b, several_point.kind != Kind::Graze));
    }
}

/// `A sin(W t + pi/3) + A sin(W t - pi/3) = A sin W t`.
#[test]
fn one_harmonic_in_two_terms_has_the_same_bifurcations() {
    let terms = ["0.36, 0.36", "\"pi\", \"pi\"", "\"pi/3\", \"-pi/3\""];
    for over in ["gap=0.77..1.1", "restitution=0.55..0.9"] {
        assert_are_the_same(&under(terms, 1, over, 1).unwrap(), &diagram(over, 1));
    }
    // Grazes as well (Lemma Y7): at half the gap.
    let over = "gap=0.705..0.9";
    let (several, one) = (under(terms, 1, over, 0).unwrap(), diagram(over, 0));
    assert_are_the_same(&several, &one);
    assert!(kinds(&several).contains(&(Kind::Graze, 0)));
    // Terms in step are one harmonic, of which one part varies.
    let parts = under(["0.1, 0.1", "\"pi\", \"pi\"", "0, \"2*pi\""], 1, "amplitude.2=0.2..0.37", 1).unwrap();
    let whole = diagram("amplitude=0.3..0.47", 1);
    assert_eq!(kinds(&parts), kinds(&whole));
    for (part, whole) in parts.points.iter().zip(&whole.points) {
        assert!(part.parameter.intersection(&whole.parameter).is_some());
        let (amplitude, _) = parts.in_units(part).unwrap();
        let both = amplitude.add(&Exact::parse("0.1").unwrap().enclose(100), 100);
        assert!(both.intersection(&whole.parameter).is_some() && width(&amplitude) < 1e-19);
    }
}

/// A third harmonic of `10^-30` moves the bifurcations of the closed forms by less than `10^-22`, and a fifth without amplitude by
/// nothing; the range of its own amplitude may begin where it is none.
#[test]
fn a_harmonic_that_hardly_moves_the_box_hardly_moves_the_bifurcations() {
    let terms = ["0.36, \"1e-30\", 0", "\"pi\", \"3*pi\", \"5*pi\"", "0, 1, 2"];
    let several = under(terms, 3, "amplitude.1=0.03..0.47", 1).unwrap();
    let one = diagram("amplitude=0.03..0.47", 1);
    assert_eq!(kinds(&several), kinds(&one));
    assert_eq!(kinds(&one).len(), 3);
    for (a, b) in several.points.iter().zip(&one.points) {
        assert!(width(&a.parameter.sub(&b.parameter, 200).hull(&Enclosure::point(Dyadic::zero()))) < 1e-20);
        assert_eq!((a.cycles, a.symmetric), (3 * b.cycles, b.symmetric));
    }
    let own = under(terms, 15, "amplitude.3=0..1e-9", 0).unwrap();
    assert!(own.points.is_empty() && own.is_certified() && own.branches.iter().any(|branch| branch.symmetric));
}

/// The orbits near a bifurcation over an amplitude, at a value of it beside its own.
fn orbits_beside(diagram: &Diagram, (point, key): (&Point, Option<Term>), off: f64) -> Vec<PeriodicOrbit> {
    let value = Exact::from_f64(point.parameter.mid_rad().0 + off).unwrap();
    let pair = diagram.pair().with(Key::Amplitude(key), value).unwrap();
    let problem = Problem::new(&pair, &point.word, point.cycles).unwrap();
    let near: Vec<f64> = point.impacts.iter().map(|impact| impact.phase.mid_rad().0).collect();
    // The two beside a fold are apart like the root of the way to it.
    let guesses = (-20..=20).step_by(4).map(|k| {
        let moved = near.iter().enumerate().map(|(i, u)| u + 1e-4 * f64::from(k) * f64::from(i as u8 % 2));
        moved.collect::<Vec<f64>>()
    });
    let mut orbits: Vec<PeriodicOrbit> = Vec::new();
    for found in guesses.filter_map(|guess| problem.prove(&guess, Precision::default())) {
        let phase = found.phases()[0].mid();
        let is_near = (phase - near[0]).abs() < 0.01;
        let is_known = |known: &PeriodicOrbit| (known.phases()[0].mid() - phase).abs() < 1e-9;
        if is_near && !orbits.iter().any(is_known) {
            orbits.push(found);
        }
    }
    orbits
}

/// Of two tones: orbits beside a fold are two or none, those beside a doubling and a pitchfork change their stability.
#[test]
fn bifurcations_of_two_tones_are_seen_in_the_orbits_beside_them() {
    // Even and odd multiples of the common frequency: only the odd ones have a mirror.
    for (second, cycles, phase, found) in [
        ("2*pi", 2, "0, 0", [Kind::Fold, Kind::PeriodDoubling].as_slice()),
        ("3*pi", 3, "0, 0.4", &[Kind::Fold, Kind::Pitchfork, Kind::PeriodDoubling]),
    ] {
        let frequency = format!("\"pi\", \"{second}\"");
        let terms = ["0.36, 0.02", &frequency, phase];
        let diagram = under(terms, cycles, "amplitude.2=0.001..0.075", 2).unwrap();
        let amplitudes = under(terms, cycles, "amplitude.1=0.03..0.06", 1).unwrap();
        let mut seen = Vec::new();
        for (diagram, key) in [(&diagram, Term::new(2)), (&amplitudes, Term::new(1))] {
            for point in diagram.points.iter().filter(|point| point.kind != Kind::Graze) {
                let orbit = point.orbit.as_ref().unwrap();
                assert_eq!(orbit.physical, Some(true));
                let [before, after] = [-1e-7, 1e-7].map(|off| orbits_beside(diagram, (point, key), off));
                let symmetric = |orbits: &[PeriodicOrbit]| -> Vec<Stability> {
                    let them = orbits.iter().filter(|orbit| orbit.symmetric == point.symmetric);
                    them.map(|orbit| orbit.stability).collect()
                };
                let sides = [symmetric(&before), symmetric(&after)];
                match point.kind {
                    Kind::Fold => {
                        assert!(sides.contains(&Vec::new()) && sides.iter().any(|side| side.len() == 2), "{sides:?}")
                    }
                    _ => assert!(
                        sides.iter().all(|side| side.len() == 1) && sides[0] != sides[1],
                        "{:?} {sides:?}",
                        point.kind
                    ),
                }
                seen.push(point.kind);
            }
        }
        assert!(found.iter().all(|kind| seen.contains(kind)), "{seen:?}");
        assert_eq!(seen.contains(&Kind::Pitchfork), cycles == 3);
    }
}

#[test]
fn keys_without_branches_under_several_harmonics_are_refused_in_one_line() {
    let (waves, phases) = ("\"pi\", \"3*pi\"", "0, 0");
    let said = |terms, cycles, over| under(terms, cycles, over, 0).unwrap_err().to_string();
    assert!(said(["1, 1", waves, phases], 3, "frequency.1=3..4").contains("for which no orbit is periodic"));
    assert!(said(["1, 1", waves, phases], 3, "amplitude=0.1..0.2").contains("accepted are amplitude.1 to amplitude.2"));
    assert!(said(["1, 1", waves, phases], 2, "gap=1..2").contains("must be a multiple of 3"));
    let incommensurate = said(["1, 1", "1, \"sqrt(2)\"", phases], 2, "gap=1..2");
    assert!(incommensurate.contains("ratios are proved to be fractions"), "{incommensurate}");
    let open = said(["1, 1", waves, "\"[0, 0.1]\", 0"], 3, "amplitude.1=0.1..0.2");
    assert!(open.contains("whose frequency and phase are not intervals"), "{open}");
}

#[test]
fn ranges_that_no_branch_is_followed_over_are_refused() {
    let scene = Scene::parse(SCENE).unwrap();
    for over in ["start.velocity=-4..-1", "start.phase=0..1", "phase=0..1", "gap=1..2:3"] {
        let error = surveyed(SCENE, ("RL", 1), over, 0, &Unwatched).unwrap_err().to_string();
        assert!(error.starts_with(&format!("the range is \"{over}\", but accepted is KEY=LO..HI")), "{error}");
    }
    let end = |text: &str| Exact::parse(text).unwrap();
    for (low, high) in [("2", "1"), ("1", "1"), ("[1, 2]", "3"), ("1", "[2, 3]"), ("1", "sin(1)^2 + cos(1)^2")] {
        assert!(Range::new(Key::Gap, end(low), end(high), None).is_err(), "{low} {high}");
    }
    let over_the_start = scene.pair().with(Key::StartVelocity, end("-1")).unwrap_err().to_string();
    assert!(over_the_start.starts_with("the key is \"start.velocity\", but a pair has"), "{over_the_start}");
}

/// A survey that is ended early keeps points that the whole one proves, and is not called complete.
#[test]
fn a_survey_that_is_ended_keeps_what_is_proved() {
    let requested = AtomicU32::new(0);
    let up_to = |most: u32| {
        requested.store(0, Ordering::Relaxed);
        let watch = |_: Stage<'_>| proceed_if(requested.fetch_add(1, Ordering::Relaxed) < most);
        surveyed(SCENE, ("RL", 1), "amplitude=0.3..0.48", 2, &watch).unwrap()
    };
    let whole = up_to(u32::MAX);
    let all = requested.load(Ordering::Relaxed);
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

/// A survey that is ended before a branch is followed has a path of one station: nothing is proved of a curve.
#[test]
fn r32_a_branch_of_one_station_is_not_proved_to_be_a_curve() {
    let ended_after = |requested: u32| {
        let done = AtomicU32::new(0);
        let watch = |_: Stage<'_>| proceed_if(done.fetch_add(1, Ordering::Relaxed) < requested);
        surveyed(SCENE, ("RL", 1), "amplitude=0.1..0.2", 0, &watch).unwrap().branches
    };
    // The least number of questions after which a branch is begun.
    let (mut none, mut some) = (0, 1 << 14);
    while some - none > 1 {
        let middle = (none + some) / 2;
        if ended_after(middle).is_empty() { none = middle } else { some = middle }
    }
    let branches = ended_after(some);
    assert!(branches.len() == 1 && branches[0].range[0] == branches[0].range[1], "{branches:?}");
    assert!(!branches[0].is_proved, "{branches:?}");
}
