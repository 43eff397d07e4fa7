//! Orbits of the scene files through the public API: theorems, reach, invariance.

use impact_pair::exact::{Enclosure, Exact};
use impact_pair::mapping::Mapping;
use impact_pair::orbit::{Arithmetic, Impact, Orbit, Outcome, Settings, Start};
use impact_pair::pair::Wall;
use impact_pair::scene::Scene;
use impact_pair::{Harmonic, ImpactPair};
use num_rational::BigRational;
use proptest::prelude::*;

fn scene(name: &str) -> Scene {
    crate::setup::scene(&format!("figure-{name}"))
}

fn orbit(scene: &Scene, arithmetic: Arithmetic, impacts: u64) -> Orbit {
    let settings = Settings { impacts: Some(impacts), arithmetic, ..Settings::default() };
    Orbit::new(scene.pair(), scene.start(), settings).expect("a valid scene")
}

fn holds(bounds: &Enclosure, exact: &Exact) -> bool {
    bounds.contains_enclosure(&exact.enclose(400)) || exact.as_rational().is_some_and(|value| bounds.contains(value))
}

/// Theorem: (66)-(69) with d = 3 pi, v = -4 pi: impacts at t = k, v = -+4 pi, for ever.
#[test]
fn the_exact_orbit_of_figure_12_is_enclosed_for_a_thousand_impacts() {
    let scene = scene("12-exact");
    let mut orbit = orbit(&scene, Arithmetic::Interval, 1000);
    let mut count = 0;
    while let Some(impact) = orbit.next() {
        count += 1;
        let (time, velocity) = orbit.bounds(&impact);
        let (wall, sign) = if count % 2 == 1 { (Wall::Right, 4) } else { (Wall::Left, -4) };
        assert_eq!((impact.wall, impact.index), (wall, count));
        assert!(time.contains(&BigRational::from_integer(count.into())), "impact {count}");
        assert!(holds(&velocity, &(Exact::pi() * Exact::from(sign))), "impact {count}");
        assert!(time.wid().to_f64_up() < 1e-13 && velocity.wid().to_f64_up() < 1e-12);
    }
    assert_eq!((count, orbit.outcome()), (1000, Some(&Outcome::ImpactsReached)));
}

/// The numbers of impacts that doubles certify at least, from the printed point data.
#[test]
fn the_figures_reach_as_far_as_doubles_certify() {
    for (name, requested, least) in [
        ("12", 100_000, 100_000),
        ("13", 100_000, 100_000),
        ("14", 1000, 78),
        ("15", 10_000, 10_000),
        ("16", 1000, 130),
        ("17", 1000, 60),
    ] {
        let mut orbit = orbit(&scene(name), Arithmetic::Interval, requested);
        let widest = orbit.by_ref().map(|impact| impact.phase.rad()).fold((0, 0.0f64), |(n, w), r| (n + 1, w.max(r)));
        assert!(widest.0 >= least, "figure {name}: {} impacts", widest.0);
        if least > 1000 {
            assert_eq!(orbit.first_wide(), None, "figure {name}: {widest:?}");
        }
    }
}

/// The textbook's method: the same impacts as far as it goes, which is less far, and never without an end.
#[cfg(all(feature = "inari", target_feature = "fma"))]
#[test]
fn plain_interval_arithmetic_agrees_as_far_as_it_goes() {
    for (name, least) in [("12", 1000), ("13", 1000), ("14", 50), ("15", 110), ("16", 75), ("17", 45)] {
        let [mut ours, mut textbook] =
            [Arithmetic::Interval, Arithmetic::Inari].map(|arithmetic| orbit(&scene(name), arithmetic, 1000));
        let mut count = 0;
        while let (Some(one), Some(other)) = (ours.next(), textbook.next()) {
            count += 1;
            assert_eq!((one.wall, one.mapping, one.index), (other.wall, other.mapping, other.index), "figure {name}");
            let (one, other) = (ours.intervals(&one), textbook.intervals(&other));
            assert!(!one.0.disjoint(other.0) && !one.1.disjoint(other.1), "figure {name}: {one:?} {other:?}");
        }
        assert!(count >= least, "figure {name}: {count}");
    }
}

#[cfg(all(feature = "inari", target_feature = "fma"))]
#[test]
fn the_textbooks_method_is_known_of_one_harmonic() {
    let two = crate::setup::scene("two-tones");
    let settings = Settings { arithmetic: Arithmetic::Inari, ..Settings::default() };
    let error = Orbit::new(two.pair(), two.start(), settings).unwrap_err().to_string();
    assert!(error.contains("2 harmonics") && error.contains("inari"), "{error}");
}

/// A request by name or by its variant gives an error that names the feature.
#[cfg(not(all(feature = "inari", target_feature = "fma")))]
#[test]
fn the_textbooks_method_is_a_feature() {
    let settings = Settings { arithmetic: Arithmetic::Inari, ..Settings::default() };
    let scene = scene("12");
    for error in [Orbit::of(&scene, settings).unwrap_err(), "inari".parse::<Arithmetic>().unwrap_err()] {
        assert!(error.to_string().contains("build impact-pair with the cargo feature \"inari\""), "{error}");
    }
    assert!(!"?".parse::<Arithmetic>().unwrap_err().to_string().contains("inari"));
}

/// Figure 12 alternates P2 and P1; figure 15 settles on m = 2 impacts on the right and n = 3 on the left a cycle.
/// What a scene file and the command line refuse, the library refuses: no panic, and no orbit that takes for ever.
#[test]
fn settings_that_are_not_accepted_are_refused() {
    let scene = scene("14");
    let said = |settings| Orbit::of(&scene, settings).unwrap_err().to_string();
    for bits in [0, 63, 2_000_000_000] {
        let settings = Settings { arithmetic: Arithmetic::Bits(bits), ..Settings::default() };
        assert!(said(settings).starts_with(&format!("the arithmetic is \"{bits}\", but accepted are")));
    }
    for digits in [0, 401, 1_000_000] {
        let settings = Settings { digits, ..Settings::default() };
        assert_eq!(said(settings), format!("digits is {digits}, but must lie in [1, 400]"));
    }
}

#[test]
fn words_of_the_periodic_figures() {
    use Mapping::{P1, P2, P3, P4};
    let word = |name, skip, take| -> Vec<Mapping> {
        let orbit = orbit(&scene(name), Arithmetic::Interval, (skip + take) as u64);
        orbit.skip(skip).filter_map(|impact| impact.mapping).collect()
    };
    assert!(word("12", 100, 20).chunks(2).all(|pair| pair == [P2, P1] || pair == [P1, P2]));
    let cycle = [P2, P3, P1, P4, P4];
    let found = word("15", 1000, 10);
    assert!((0..5).any(|shift| (0..10).all(|i| found[i] == cycle[(i + shift) % 5])), "{found:?}");
}

#[test]
fn auto_lists_nothing_wider_than_requested() {
    for digits in [3, 6, 9, 12] {
        let settings = Settings { impacts: Some(200), digits, ..Settings::default() };
        let scene = scene("14");
        let mut orbit = Orbit::new(scene.pair(), scene.start(), settings).expect("a valid scene");
        let width = 10f64.powi(-(digits as i32));
        let mut count = 0;
        while let Some(impact) = orbit.next() {
            let (time, velocity) = orbit.bounds(&impact);
            // The period is 2, A W = 8 pi.
            assert!(time.wid().to_f64_up() <= 2.0 * width && velocity.wid().to_f64_up() <= 25.1327 * width);
            count += 1;
        }
        assert!(count >= [60, 40, 20, 3][digits as usize / 3 - 1], "{count} impacts at {digits} digits");
    }
}

#[test]
fn an_impact_is_a_point_of_its_switch_plane() {
    let scene = scene("12-exact");
    let mut orbit = orbit(&scene, Arithmetic::Interval, 2);
    let right = orbit.next().expect("an impact");
    let point = orbit.switch_point(&right);
    // t = 1 = half a period: x = d/2 + sin pi = 3 pi/2, x' = 4 pi + pi cos pi = 3 pi.
    assert_eq!(point.wall, Wall::Right);
    assert!(holds(&point.time, &Exact::from(1)));
    assert!(holds(&point.displacement, &"3*pi/2".parse().unwrap()));
    assert!(holds(&point.absolute_velocity, &"3*pi".parse().unwrap()));
    assert!(holds(&point.relative_velocity, &"4*pi".parse().unwrap()));
}

fn impacts(lengths: &str, times: &str, data: &(f64, f64, f64, f64, Option<f64>)) -> Vec<Impact> {
    let (amplitude, restitution, speed, phase, inside) = *data;
    let scaled = |value: f64, unit: &str| format!("{value}*{unit}").parse::<Exact>().expect("an expression");
    let harmonic = Harmonic::new(
        scaled(amplitude, lengths),
        format!("pi/{times}").parse().expect("an expression"),
        phase.to_string().parse().expect("a decimal"),
    );
    let pair = ImpactPair::new(harmonic.unwrap(), scaled(1.0, lengths), scaled(restitution, "1")).unwrap();
    let velocity = scaled(-speed, &format!("{lengths}/{times}"));
    let start = match inside {
        None => Start::on_wall(Exact::from(0), Wall::Left, velocity),
        Some(position) => Start::inside(&pair, Exact::from(0), scaled(position, lengths), velocity),
    };
    let start = start.unwrap();
    let settings = Settings { impacts: Some(20), arithmetic: Arithmetic::Interval, ..Settings::default() };
    Orbit::new(&pair, &start, settings).unwrap().collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// Lemma R1: only ratios of lengths and of times matter [P]; no unit changes a verdict or a bit of a phase.
    #[test]
    fn units_change_nothing(
        amplitude in 0.01..10.0f64, restitution in 0.0..=1.0f64, speed in 0.0..10.0f64, phase in -3.0..3.0f64,
        lengths in -900..900i32, times in -40..40i32, inside in prop_oneof![Just(None), (-0.4..0.4f64).prop_map(Some)],
    ) {
        let data = (amplitude, restitution, speed, phase, inside);
        let plain = impacts("1", "1", &data);
        prop_assert_eq!(&plain, &impacts(&format!("(2^({lengths}))"), &format!("(2^({times}))"), &data));
        prop_assert_eq!(&plain, &impacts("(1e-300)", "(1e12/3)", &data));
    }
}

/// Random motions on walls and inside the gap, many of them chaotic: with small boxes and slow starts a floating-point run soon has another number
/// of impacts.
fn motions() -> impl Strategy<Value = Scene> {
    let velocity = || prop_oneof![Just(0.0), 0.0..3.0f64, 0.0..20.0f64];
    let start = prop_oneof![
        3 => velocity().prop_map(|velocity| format!("wall = \"left\", velocity = -{velocity:.6}")),
        1 => velocity().prop_map(|velocity| format!("wall = \"right\", velocity = {velocity:.6}")),
        1 => (-0.4..0.4f64, -20.0..20.0f64)
            .prop_map(|(position, velocity)| format!("position = {position:.6}, velocity = {velocity:.6}")),
    ];
    let amplitude = prop_oneof![3 => 0.05..0.4f64, 1 => 0.4..2.0f64];
    let restitution = prop_oneof![3 => 0.4..0.8f64, 1 => 0.0..0.98f64];
    let time = prop_oneof![Just(0.0), 0.0..2.0f64];
    (amplitude, 1.0..20.0f64, restitution, time, start).prop_map(|(alpha, gap, restitution, time, start)| {
        let text = format!(
            "excitation = {{ amplitude = {:.6}, frequency = \"pi\", phase = 0 }}\n\
             pair = {{ gap = {gap:.6}, restitution = {restitution:.6} }}\nstart = {{ time = {time:.6}, {start} }}",
            alpha * gap
        );
        Scene::parse(&text).expect("a scene")
    })
}

/// Follows a motion to its end: its outcome and its last impact's time, none of which is wider than requested.
fn followed(scene: &Scene, impacts: Option<u64>, until: Option<Exact>) -> (Option<Outcome>, u64, Option<Enclosure>) {
    let mut orbit = Orbit::of(scene, Settings { impacts, until, ..Settings::default() }).unwrap();
    let last = orbit.by_ref().last().map(|last| orbit.bounds(&last).0);
    assert_eq!(orbit.first_wide(), None, "{scene:?}");
    (orbit.outcome().cloned(), orbit.listed(), last)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// What is certified of a motion for a number of impacts is certified up to the time of the last of them.
    #[test]
    fn r62_a_time_to_stop_at_certifies_what_a_number_of_impacts_does(scene in motions()) {
        let (Some(Outcome::ImpactsReached | Outcome::Periodic(_)), impacts, Some(last)) = followed(&scene, Some(150), None) else {
            return Ok(());
        };
        let until = Exact::from_rational(last.sup().to_rational());
        let (outcome, listed, _) = followed(&scene, None, Some(until));
        prop_assert!(matches!(outcome, Some(Outcome::TimeReached | Outcome::Periodic(_))), "{:?} {outcome:?}", scene);
        prop_assert!(listed >= impacts, "{listed} of {impacts}");
    }
}

/// The floating-point run, which the bits are planned from, has fewer impacts up to a time than the true orbit.
#[test]
fn r62_the_bits_of_an_orbit_with_more_impacts_than_planned_are_raised() {
    let scene = Scene::parse(
        "excitation = { amplitude = 1.549, frequency = \"pi\", phase = 0 }\npair = { gap = 16.61, restitution = 0.6 }\n\
         start = { time = 0, wall = \"left\", velocity = 0 }",
    );
    let (outcome, listed, _) = followed(&scene.unwrap(), None, Some(Exact::from(290)));
    assert_eq!((outcome, listed), (Some(Outcome::TimeReached), 148));
}

/// The plan follows the impacts requested, and not all up to a time far beyond them: of 45 harmonics these took half a minute.
#[test]
fn r62_the_impacts_requested_end_the_plan_for_a_late_time() {
    let listed = |of: fn(u32) -> String| (1..=45).map(of).collect::<Vec<_>>().join(", ");
    let (amplitudes, frequencies) = (listed(|k| format!("\"1/{}\"", k * k + 1)), listed(|k| format!("\"{k}*pi\"")));
    let scene = Scene::parse(&format!(
        "excitation = {{ amplitude = [{amplitudes}], frequency = [{frequencies}], phase = 0 }}\n\
         pair = {{ gap = 2, restitution = 0.9 }}\nstart = {{ time = 0, wall = \"left\", velocity = -3 }}"
    ));
    let settings =
        Settings { impacts: Some(10), until: Some("10^9".parse().unwrap()), digits: 20, ..Settings::default() };
    let begun = std::time::Instant::now();
    let mut orbit = Orbit::of(&scene.unwrap(), settings).unwrap();
    assert_eq!((orbit.by_ref().count(), orbit.outcome()), (10, Some(&Outcome::ImpactsReached)));
    assert!(begun.elapsed().as_secs() < 5, "{:?}", begun.elapsed());
    assert_eq!(orbit.plan().map(|plan| plan.bits(10) > 64), Some(true));
}

/// Nothing is touched before 1.5e16: that is all that a time to stop at needs.
#[test]
fn r62_an_endless_flight_ends_at_the_time_requested() {
    let scene = Scene::parse(
        "excitation = { amplitude = 0, frequency = 1, phase = 0 }\npair = { gap = 16, restitution = 0.5 }\n\
         start = { time = 0, wall = \"left\", velocity = -1e-15 }",
    );
    let settings = |until: &str| Settings { until: Some(until.parse().unwrap()), ..Settings::default() };
    let outcome = |until| {
        let mut orbit = Orbit::of(scene.as_ref().unwrap(), settings(until)).unwrap();
        assert_eq!(orbit.next(), None);
        orbit.outcome().cloned()
    };
    assert_eq!(outcome("10"), Some(Outcome::TimeReached));
    assert!(matches!(outcome("10^18"), Some(Outcome::Undecided { .. })));
}
