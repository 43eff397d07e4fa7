//! Orbits under several harmonics: against the same motion under one, against themselves in other arithmetics, mirrored.

use impact_pair::contact::Reason;
use impact_pair::exact::Enclosure;
use impact_pair::orbit::{Arithmetic, Orbit, Outcome, Period, Progress, Settings};
use impact_pair::pair::Wall;
use impact_pair::scene::Scene;
use proptest::prelude::*;

/// The data of a scene file: those of the excitation, and all others as one text.
#[derive(Clone, Debug)]
struct Case {
    amplitudes: Vec<String>,
    frequencies: Vec<String>,
    phases: Vec<String>,
    rest: String,
}

impl Case {
    fn scene(&self) -> Scene {
        let list = |items: &[String]| format!("{items:?}");
        let (amplitudes, frequencies, phases) = (list(&self.amplitudes), list(&self.frequencies), list(&self.phases));
        let excitation =
            format!("excitation = {{ amplitude = {amplitudes}, frequency = {frequencies}, phase = {phases} }}");
        Scene::parse(&format!("{excitation}\n{}", self.rest)).expect("a valid scene")
    }

    fn events(&self, arithmetic: Arithmetic, impacts: u64) -> (Vec<Event>, Option<Outcome>) {
        let settings = Settings { impacts: Some(impacts), arithmetic, max_bits: 2000, ..Settings::default() };
        let scene = self.scene();
        let mut orbit = Orbit::new(scene.pair(), scene.start(), settings).expect("a valid scene");
        let mut events = Vec::new();
        loop {
            events.push(match orbit.advance() {
                Progress::Impact(impact) => {
                    let (time, velocity) = orbit.bounds(&impact);
                    Event { kind: "impact", wall: impact.wall, time, velocity: Some(velocity) }
                }
                Progress::Rest(rest) => {
                    Event { kind: "rest", wall: rest.at.wall, time: orbit.rest_time(&rest), velocity: None }
                }
                Progress::Release(release) => {
                    Event { kind: "release", wall: release.wall, time: orbit.touch_time(&release), velocity: None }
                }
                Progress::Graze(graze) => {
                    Event { kind: "graze", wall: graze.at.wall, time: orbit.touch_time(&graze.at), velocity: None }
                }
                Progress::Retraced(_) => continue,
                Progress::Ended => return (events, orbit.outcome().cloned()),
            });
        }
    }
}

/// One event of an orbit.
#[derive(Clone, Debug)]
struct Event {
    kind: &'static str,
    wall: Wall,
    time: Enclosure,
    velocity: Option<Enclosure>,
}

impl Event {
    fn meets(&self, other: &Self) -> bool {
        let meet = |a: &Enclosure, b: &Enclosure| a.intersection(b).is_some();
        let velocities = match (&self.velocity, &other.velocity) {
            (Some(a), Some(b)) => meet(a, b),
            (a, b) => a.is_none() && b.is_none(),
        };
        (self.kind, self.wall) == (other.kind, other.wall) && meet(&self.time, &other.time) && velocities
    }
}

/// Two lists of what is one motion agree as far as both go, but for how long chatter is listed.
fn agree(a: &[Event], b: &[Event]) -> Result<(), TestCaseError> {
    for (i, (one, other)) in a.iter().zip(b).enumerate() {
        // A chatter is listed until it is shorter than the digits: which impact that is may differ by rounding.
        if (one.kind == "rest") != (other.kind == "rest") {
            return Ok(());
        }
        prop_assert!(one.meets(other), "event {}: {one:?} and {other:?}", i + 1);
    }
    Ok(())
}

/// The rest of a scene: e often at its ends, starts on a wall with any velocity or none, or inside.
fn others() -> impl Strategy<Value = String> {
    let restitution = prop_oneof![
        Just("0".to_owned()),
        Just("1".to_owned()),
        Just("1/2".to_owned()),
        (0.0..1.0f64).prop_map(|e| format!("{e}")),
        (1.0..12.0f64).prop_map(|e| format!("{:e}", 10f64.powf(-e))),
    ];
    let speed = prop_oneof![Just(0.0), (0.0..3.0f64), (-9.0..1.0f64).prop_map(|e| 10f64.powf(e))];
    let start = prop_oneof![
        3 => speed.clone().prop_map(|v| format!("wall = \"left\", velocity = \"-{v:e}\"")),
        2 => speed.clone().prop_map(|v| format!("wall = \"right\", velocity = \"{v:e}\"")),
        1 => (-0.49..0.49f64, -2.0..2.0f64).prop_map(|(y, v)| format!("position = \"{y}\", velocity = \"{v}\"")),
    ];
    (restitution, start, 0..8u32).prop_map(|(e, start, t)| {
        format!("pair = {{ gap = 1, restitution = \"{e}\" }}\nstart = {{ time = \"{t}/4\", {start} }}")
    })
}

fn amplitude() -> impl Strategy<Value = f64> {
    (-2.0..1.0f64).prop_map(|e| 10f64.powf(e))
}

/// Harmonics with ratios that are fractions or not, strong and weak.
fn sum() -> impl Strategy<Value = Case> {
    let ratio = proptest::sample::select(vec!["1", "3", "1/3", "sqrt(2)", "2/5", "sqrt(5)/2", "1/200", "2"]);
    let phase = prop_oneof![Just("0".to_owned()), Just("pi".to_owned()), (-3.0..3.0f64).prop_map(|x| format!("{x}"))];
    let term = (amplitude(), -6.0..0.0f64, ratio, phase);
    (proptest::collection::vec(term, 2..5), others()).prop_map(|(terms, rest)| Case {
        amplitudes: terms.iter().map(|(a, weak, ..)| format!("{:e}", a * 10f64.powf(0.5 * weak))).collect(),
        frequencies: terms.iter().map(|(.., ratio, _)| format!("2*pi*{ratio}")).collect(),
        phases: terms.iter().map(|(.., phase)| phase.clone()).collect(),
        rest,
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(60) })]

    /// `A sin(th + pi/3) + A sin(th - pi/3) = A sin th`: the same orbit by two routes of the library.
    #[test]
    fn one_harmonic_in_two_terms_moves_the_same(a in amplitude(), tau in -3.0..3.0f64, rest in others()) {
        let one = Case {
            amplitudes: vec![format!("{a}")],
            frequencies: vec!["2*pi".into()],
            phases: vec![format!("{tau}")],
            rest: rest.clone(),
        };
        let two = Case {
            amplitudes: vec![format!("{a}"); 2],
            frequencies: vec!["2*pi".into(); 2],
            phases: vec![format!("{tau} + pi/3"), format!("{tau} - pi/3")],
            rest,
        };
        for arithmetic in [Arithmetic::Interval, Arithmetic::Auto] {
            agree(&one.events(arithmetic, 25).0, &two.events(arithmetic, 25).0)?;
        }
    }

    /// Doubles and multiprecision enclose one orbit.
    #[test]
    fn arithmetics_agree(case in sum()) {
        let (doubles, _) = case.events(Arithmetic::Interval, 20);
        for arithmetic in [Arithmetic::Bits(200), Arithmetic::Auto] {
            agree(&doubles, &case.events(arithmetic, 20).0)?;
        }
    }

    /// `(y, E) -> (-y, -E)` maps motions to motions.
    #[test]
    fn mirror_images_move_as_mirror_images(case in sum()) {
        let mirrored = |text: &str| {
            let swapped = text.replace("\"left\"", "\"LEFT\"").replace("\"right\"", "\"left\"").replace("\"LEFT\"", "\"right\"");
            let negated = swapped.replace("velocity = \"", "velocity = \"-1*").replace("position = \"", "position = \"-1*");
            negated.replace("-1*-", "")
        };
        let image = Case {
            phases: case.phases.iter().map(|phase| format!("({phase}) + pi")).collect(),
            rest: mirrored(&case.rest),
            ..case.clone()
        };
        let (events, _) = case.events(Arithmetic::Interval, 20);
        let back = image.events(Arithmetic::Interval, 20).0.into_iter().map(|event| Event {
            wall: event.wall.other(),
            velocity: event.velocity.map(|velocity| velocity.negated()),
            ..event
        });
        agree(&events, &back.collect::<Vec<_>>())?;
    }
}

fn case(amplitudes: &[&str], frequencies: &[&str], rest: &str) -> Case {
    let owned = |items: &[&str]| items.iter().map(|x| (*x).to_owned()).collect::<Vec<_>>();
    let phases = vec!["0".to_owned(); amplitudes.len()];
    Case { amplitudes: owned(amplitudes), frequencies: owned(frequencies), phases, rest: rest.to_owned() }
}

/// Equal terms are one harmonic, and one without amplitude is none: the very same bounds.
#[test]
fn terms_that_change_nothing_change_nothing() {
    let rest =
        "pair = { gap = 9.42497, restitution = 0.5 }\nstart = { time = 0, wall = \"left\", velocity = -12.56636 }";
    let times = |case: Case| -> Vec<_> {
        let bounds = |x: Enclosure| (x.inf().to_rational(), x.sup().to_rational());
        case.events(Arithmetic::Auto, 40).0.into_iter().map(|event| bounds(event.time)).collect()
    };
    let one = times(case(&["8"], &["pi"], rest));
    assert_eq!(one, times(case(&["4", "3", "1"], &["pi", "3*pi/3", "pi"], rest)));
    assert_eq!(one, times(case(&["8", "0"], &["pi", "7*pi"], rest)));
}

/// A flight whose drift takes it across the gap in a hundred thousand forcing periods costs no more pieces than a short one.
#[test]
fn long_flights_jump() {
    for frequencies in [["2*pi", "6*pi"], ["2*pi", "2*pi*sqrt(2)"]] {
        // No velocity but the drift: c = v + sum beta_k cos tau_k with all cosines 0.
        let mut slow = case(
            &["0.05", "0.02"],
            &frequencies,
            "pair = { gap = 1, restitution = 0.5 }\nstart = { time = 0, position = 0, velocity = 1e-5 }",
        );
        slow.phases = vec!["pi/2".into(); 2];
        let (events, _) = slow.events(Arithmetic::Interval, 1);
        let first = &events[0];
        let (low, high) = first.time.to_f64_bounds();
        assert!(low > 3e4 && high - low < 1e-6, "{first:?}");
    }
}

/// No drift, and room for all harmonics: no wall is ever touched.
#[test]
fn without_drift_nothing_is_touched() {
    let mut still = case(
        &["0.2", "0.1"],
        &["2*pi", "2*pi*sqrt(2)"],
        "pair = { gap = 1, restitution = 0.5 }\nstart = { time = 0, position = 0, velocity = 0 }",
    );
    still.phases = vec!["pi/2".into(), "-pi/2".into()];
    let (events, outcome) = still.events(Arithmetic::Auto, 5);
    assert!(events.is_empty() && outcome == Some(Outcome::NeverImpacts), "{outcome:?}");
}

/// y'' = cos t + cos 2t from rest: y = (1 - cos t) + (1 - cos 2t)/4 is in [0, 2], where the amplitudes alone allow 2.5. The sines and
/// cosines of the start need not be whole numbers.
#[test]
fn i62_without_drift_common_periods_decide_that_nothing_is_touched() {
    let outcome = |amplitudes: &[&str], frequencies: &[&str], gap: &str, start: &str| {
        let rest = format!("pair = {{ gap = {gap}, restitution = 0.5 }}\nstart = {{ {start} }}");
        let phases = vec!["pi/2".into(); amplitudes.len()];
        Case { phases, ..case(amplitudes, frequencies, &rest) }.events(Arithmetic::Auto, 3)
    };
    let later = "time = 1, position = \"(1 - cos(1)) + (1 - cos(2))/4\", velocity = \"sin(1) + sin(2)/2\"";
    for start in ["time = 0, position = 0, velocity = 0", later] {
        let (events, still) = outcome(&["1", "1/4"], &["1", "2"], "4.5", start);
        assert!(events.is_empty() && still == Some(Outcome::NeverImpacts), "{start}: {still:?}");
        let (events, _) = outcome(&["1", "1/4"], &["1", "2"], "3.9", start);
        assert!(events.len() == 3 && events[0].wall == Wall::Right, "{start}: {events:?}");
    }
    let later = "time = 1, position = \"1 - cos(1)\", velocity = \"sin(1)\"";
    assert_eq!(outcome(&["1"], &["1"], "4.5", later).1, Some(Outcome::NeverImpacts));
}

/// The contact force of the left wall is 4 (1 - 2 cos x)(1 + cos x), x = t/8: it touches 0 at x = pi and ends at x = 5 pi/3 (Lemma H15).
#[test]
fn i62_a_ball_stays_where_the_contact_force_touches_0() {
    let moves = |start: &str| {
        let rest = format!("pair = {{ gap = 4, restitution = 0 }}\nstart = {{ {start} }}");
        let case = Case { phases: vec!["pi/2".into(); 2], ..case(&["32", "128"], &["1/4", "1/8"], &rest) };
        case.events(Arithmetic::Auto, 3).0
    };
    let inside = moves("time = 0, position = 0, velocity = 0");
    let on_touch = moves("time = \"8*pi\", wall = \"left\", velocity = 0");
    // The second is mpmath's root of y = 2 from the release on.
    let expected =
        [("release", Wall::Left, 40.0 / 3.0 * std::f64::consts::PI), ("impact", Wall::Right, 45.18308358502)];
    for (events, first) in [(&inside, 5), (&on_touch, 1)] {
        for (event, (kind, wall, time)) in events[first..].iter().zip(expected) {
            let (low, high) = event.time.to_f64_bounds();
            let is_then = low - 1e-10 < time && time < high + 1e-10 && high - low < 1e-8;
            assert!((event.kind, event.wall) == (kind, wall) && is_then, "{events:?}");
        }
        assert!(events.len() > first + 1, "{events:?}");
    }
}

/// Under commensurate frequencies a second release at the same zero of the pressure makes the motion periodic; under
/// others it never does. To nine digits for so long that takes more than doubles.
#[test]
fn only_commensurate_motions_are_called_periodic() {
    let rest = "pair = { gap = 9.42497, restitution = 0.3 }\nstart = { time = 0, wall = \"left\", velocity = -0.5 }";
    let mut commensurate = case(&["1", "0.2"], &["pi", "3*pi"], rest);
    commensurate.phases = vec!["pi".into(), "0".into()];
    let (_, outcome) = commensurate.events(Arithmetic::Auto, 120);
    assert!(matches!(outcome, Some(Outcome::Periodic(period)) if period.cycles % 3 == 0), "{outcome:?}");
    let other = Case { frequencies: vec!["pi".into(), "sqrt(5)*pi".into()], ..commensurate };
    assert_eq!(other.events(Arithmetic::Auto, 120).1, Some(Outcome::ImpactsReached));
}

/// Half a forcing period is written as 1/2 or as -1/2 of the next: two releases there are whole periods apart all the same (Lemma H9).
#[test]
fn a_period_between_releases_at_half_a_period_is_a_whole_number_of_periods() {
    let text = |phase: &str, wall: &str, velocity: &str| {
        format!(
            "excitation = {{ amplitude = [\"0.0977766639*0.002\", \"1.18576041e-05*0.0977766639*0.002\"], \
             frequency = [0.37, 0.185], phase = \"{phase}\" }}\npair = {{ gap = 0.002, restitution = 0.257253855 }}\n\
             start = {{ time = -0.000604953832, wall = \"{wall}\", velocity = {velocity} }}"
        )
    };
    let ends = [text("pi", "right", "7.52918614e-13"), text("0", "left", "-7.52918614e-13")].map(|text| {
        let scene = Scene::parse(&text).unwrap();
        let mut orbit = Orbit::of(&scene, Settings { impacts: Some(50), ..Settings::default() }).unwrap();
        let times: Vec<_> = orbit.by_ref().collect::<Vec<_>>().iter().map(|impact| orbit.bounds(impact).0).collect();
        assert_eq!(orbit.outcome(), Some(&Outcome::Periodic(Period { cycles: 6, impacts: 20 })));
        times
    });
    // The mirror image: the same times, those that are repeated as well.
    for (a, b) in ends[0].iter().zip(&ends[1]) {
        assert!(a.intersection(b).is_some(), "{a:?} {b:?}");
    }
}

/// Steps towards a release do not end at a contact force that goes to 0 like a third power; of one that touches 0 at no
/// part of a period no digits distinguish a touch from a release. The rest comes before both: each impact of its complete chatter was listed, and the release sought again.
#[test]
fn r46_a_rest_whose_release_is_not_proved_is_listed_and_ends_undecided() {
    let ends = |amplitudes: &[&str], phases: &[&str], rest: &str| {
        let phases = phases.iter().map(|phase| (*phase).to_owned()).collect();
        let case = Case { phases, ..case(amplitudes, &["pi", "2*pi", "3*pi"][..amplitudes.len()], rest) };
        let (events, outcome) = case.events(Arithmetic::Auto, 1000);
        let last = &events.last().expect("a rest").kind;
        assert!(*last == "rest" && events.len() < 100, "{events:?}");
        let Some(Outcome::Undecided { reason: Reason::Graze, wall: Some(Wall::Left), time: (from, None) }) = outcome
        else {
            panic!("{outcome:?}")
        };
        from.to_f64_bounds()
    };
    // -E'' = 8 pi^2 sin(pi t) (1 - cos(pi t)): a zero of the third order at t = 4.
    let start = "start = { time = 1.5, wall = \"right\", velocity = 0.01 }";
    let (low, high) = ends(&["8", "1"], &["0", "pi"], &format!("pair = {{ gap = 2, restitution = 0.3 }}\n{start}"));
    assert!(3.45917 < low && high < 3.45918, "{low} {high}");
    // -E'' = -40 pi^2 (c - 1/3)^2 (c + 6/11), c = cos(pi t): it is negative up to c = -6/11 but at c = 1/3, t = 0.3918.
    let start = "start = { time = 0.1, wall = \"left\", velocity = -0.01 }";
    let sizes = ["40*197/396", "40*2/33/4", "40/4/9"];
    let rest = format!("pair = {{ gap = 200, restitution = 0.3 }}\n{start}");
    let (low, high) = ends(&sizes, &["-pi/2", "pi/2", "-pi/2"], &rest);
    assert!(0.1 < low && high < 0.1002, "{low} {high}");
}
