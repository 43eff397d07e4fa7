//! Certificates that were wrong once: each of these scenes was certified falsely by an earlier version.
//!
//! The truths come from the closed form named with each, or from mpmath in 400 digits. The issue's number is in the name.

use impact_pair::Scene;
use impact_pair::contact::{Margins, Radii, Reason, Verdict, first_contact};
use impact_pair::flight::Flight;
use impact_pair::mapping::Mapping;
use impact_pair::number::{Ball, Number, kernel};
use impact_pair::orbit::{Arithmetic, Impact, Orbit, Outcome, Progress, Settings};
use impact_pair::pair::{Reduced, Wall};
use num_rational::BigRational;

/// `amplitude`, `gap`, `restitution` and the start of a scene with `W = 2 pi` and `tau = 0`.
fn scene(amplitude: &str, gap: &str, restitution: &str, start: &str) -> Scene {
    let text = format!(
        "excitation = {{ amplitude = \"{amplitude}\", frequency = \"2*pi\", phase = 0 }}\n\
         pair = {{ gap = \"{gap}\", restitution = \"{restitution}\" }}\nstart = {{ {start} }}"
    );
    Scene::parse(&text).unwrap()
}

/// All that is certified of the first `impacts` impacts, and the orbit at its end.
fn events(scene: &Scene, arithmetic: Arithmetic, impacts: u64) -> (Vec<Progress>, Orbit) {
    let settings = Settings { arithmetic, impacts: Some(impacts), max_bits: 4096, ..Settings::default() };
    let mut orbit = Orbit::of(scene, settings).unwrap();
    let mut events = Vec::new();
    loop {
        match orbit.advance() {
            Progress::Ended => return (events, orbit),
            Progress::Retraced(_) => {}
            event => events.push(event),
        }
    }
}

/// The arithmetics; those that decide the scenes of few digits come last.
fn arithmetics() -> Vec<Arithmetic> {
    ["interval", "auto", "64", "128", "256", "1024"].map(|name| name.parse().unwrap()).to_vec()
}

fn rational(text: &str) -> BigRational {
    text.parse::<impact_pair::exact::Exact>().unwrap().as_rational().unwrap().clone()
}

/// Whether the impact's time is proved to lie between `low` and `high`.
fn is_between(orbit: &Orbit, impact: &Impact, low: &str, high: &str) -> bool {
    let time = orbit.bounds(impact).0;
    time.inf().to_rational() >= rational(low) && time.sup().to_rational() <= rational(high)
}

/// Asserts that the first event is a touch of this wall, as an impact between these times or as a graze, or that none is decided.
fn touches_first(events: &[Progress], orbit: &Orbit, wall: Wall, low: &str, high: &str) {
    match events.first() {
        Some(Progress::Impact(impact)) => {
            assert!(impact.wall == wall && is_between(orbit, impact, low, high), "{impact:?}");
        }
        Some(Progress::Graze(graze)) => assert_eq!(graze.at.wall, wall),
        Some(event) => panic!("{event:?}"),
        None => assert!(matches!(orbit.outcome(), Some(Outcome::Undecided { .. }))),
    }
}

#[test]
fn r14_a_contact_just_before_a_computed_extremum_is_not_missed() {
    // v h + a h^2/2 = -10^-30 with a = 4 pi^2 sin(0.4 pi): h = 1.0000000019e-20.
    let near = scene("1", "1", "1/2", "time = 0.2, position = \"-1/2+1/10^30\", velocity = \"-1/10^10\"");
    // mpmath: 0.59999830501344636955033.
    let place = "0.4523210701736317114473468961869659622048";
    let start = format!("time = 0.4, position = \"{place}\", velocity = \"-1/10^12\"");
    let later = scene("0.3", "1", "1/2", &start);
    for arithmetic in arithmetics() {
        let (found, orbit) = events(&near, arithmetic, 1);
        touches_first(&found, &orbit, Wall::Left, "0.2", "0.2000000000000001");
        let (found, orbit) = events(&later, arithmetic, 1);
        touches_first(&found, &orbit, Wall::Right, "0.5999983", "0.5999984");
    }
}

#[test]
fn r14_half_a_turn_is_decided_before_the_half_is_added() {
    // z = 4 pi^2 (s h^2/2 - h^3/6) with s = 2^-70, up to 10^-40 of it: back at h = 3 s, and with e = 1 never at rest.
    let start = "time = \"-1/1180591620717411303424\", wall = \"right\", velocity = 0";
    let scene = scene("1", "4", "1", start);
    let mut decided = 0;
    for arithmetic in arithmetics() {
        let (found, orbit) = events(&scene, arithmetic, 3);
        for (event, ticks) in found.iter().zip(["2", "3.2426", "4.2270"]) {
            let Progress::Impact(impact) = event else { panic!("{event:?} in {arithmetic:?}") };
            let [low, high] = ["-0.0001", "+0.0001"].map(|by| format!("({ticks}{by})/1180591620717411303424"));
            assert!(impact.wall == Wall::Right && is_between(&orbit, impact, &low, &high), "{impact:?}");
            decided += 1;
        }
    }
    assert!(decided >= 6);
}

#[test]
fn r14_forcing_periods_are_counted_or_the_orbit_ends() {
    // Impact i is at i 2^51, exactly, however late.
    let scene = scene("0", "1", "1", "time = 0, wall = \"left\", velocity = \"-1/2251799813685248\"");
    for arithmetic in arithmetics() {
        let (found, orbit) = events(&scene, arithmetic, 4200);
        for event in &found {
            let Progress::Impact(impact) = event else { panic!("{event:?}") };
            let time = BigRational::from_integer((u128::from(impact.index) << 51).into());
            assert!(orbit.bounds(impact).0.contains(&time), "{impact:?}");
        }
        assert!(found.len() == 4200 || matches!(orbit.outcome(), Some(Outcome::Undecided { .. })));
    }
}

#[test]
fn r14_a_mirrored_phase_that_rounds_to_a_turn_is_not_on_the_next_piece() {
    // A hop of 3 (1/2 - phase) or so; the far wall was certified at 0.31.
    let alpha = Ball::exact(1.0);
    let pair = Reduced { alpha, beta: alpha * alpha.turn(), restitution: Ball::exact(0.5) };
    let phase = 0.5 - 2f64.powi(-54);
    let flight = Flight::from_wall(&pair.centre(), Wall::Right, phase, 1e-33, kernel::sin_cos(phase));
    if let Verdict::Certified(contact) = first_contact(&flight, &Margins::new(&pair), Radii::default()) {
        assert!(contact.wall == Wall::Right && contact.time.mid() < 1e-15, "{contact:?}");
    }
}

#[test]
fn r14_what_the_phase_or_the_height_of_a_public_flight_leaves_open_is_not_certified() {
    let ball = |x: f64| Ball::exact(x);
    let pair = |alpha: f64| Reduced {
        alpha: ball(alpha),
        beta: Ball::new(alpha * std::f64::consts::TAU, 1e-15),
        restitution: ball(0.5),
    };
    // Mirrored, this phase loses all but 2^-16 of its last places.
    let pair_of_phase = pair(0.128_595_656_927_070_44);
    let phase = 274_877_906_943.752_3;
    let far = Flight::from_wall(
        &pair_of_phase.centre(),
        Wall::Right,
        phase,
        0.491_921_966_511_813_86,
        kernel::sin_cos(phase),
    );
    assert!(first_contact(&far, &Margins::new(&pair_of_phase), Radii::default()).certified().is_none());
    // A start that may be 10^-3 off the wall arrives that much earlier.
    let pair_of_height = pair(0.01);
    let off = Flight::from_inside(&pair_of_height.centre(), 0.0, 0.1, 20.0, kernel::sin_cos(0.1));
    let radii = |height: f64| Radii { height, ..Radii::default() };
    let contact = first_contact(&off, &Margins::new(&pair_of_height), radii(1e-3)).certified();
    assert!(contact.is_none_or(|contact| contact.time.rad() > 4e-5), "{contact:?}");
    assert!(first_contact(&off, &Margins::new(&pair_of_height), radii(f64::NAN)).certified().is_none());
}

#[test]
fn r14_a_quotient_of_the_smallest_doubles_is_enclosed() {
    let (a, b) = (9.382_619_283_363_795e-308, 9.039_132_257_575_907e-308);
    let radius = 4.0 * f64::from_bits(1);
    let quotient = Ball::exact(a).checked_div(Ball::new(b, radius)).unwrap();
    let exact = |x: f64| BigRational::from_float(x).unwrap();
    for divisor in [exact(b) - exact(radius), exact(b), exact(b) + exact(radius)] {
        let off = exact(a) / divisor - exact(quotient.mid());
        assert!(off.clone() <= exact(quotient.rad()) && -off <= exact(quotient.rad()));
    }
}

#[test]
fn r14_what_may_not_be_shaken_is_not_released() {
    // A = 0 is among the data: there the ball rests for ever.
    let wall = "time = 0.75, wall = \"left\", velocity = 0";
    let still = "time = 0.25, wall = \"left\", velocity = 0";
    for (amplitude, start) in [("[0, 1]", wall), ("[0, 0.4]", still)] {
        for arithmetic in arithmetics() {
            let (found, orbit) = events(&scene(amplitude, "10", "1/2", start), arithmetic, 1);
            assert!(found.is_empty() && matches!(orbit.outcome(), Some(Outcome::Undecided { .. })), "{found:?}");
        }
    }
}

#[test]
fn r14_a_chatter_that_takes_next_to_no_time_takes_some() {
    // Infinitely many impacts, within 10^-336.
    let start = "time = -0.25, wall = \"left\", velocity = \"-1/10^305\"";
    for arithmetic in arithmetics() {
        let (found, _) = events(&scene("10^30", "1", "1/2", start), arithmetic, 1);
        for event in found {
            assert!(!matches!(&event, Progress::Rest(rest) if !rest.is_accumulation), "{event:?}");
        }
    }
}

#[test]
fn r14_phases_of_any_size_are_those_of_the_harmonics() {
    // mpmath, 400 digits; it was certified at 1.14206188.
    let text = "excitation = { amplitude = [0.1, 0.2], frequency = [2, 1], phase = [\"0\", \"1e160\"] }\n\
                pair = { gap = 1, restitution = 0.5 }\nstart = { time = 0.3, wall = \"left\", velocity = -2 }";
    for arithmetic in arithmetics() {
        let (found, orbit) = events(&Scene::parse(text).unwrap(), arithmetic, 1);
        let Some(Progress::Impact(impact)) = found.first() else { panic!("{found:?}") };
        assert!(is_between(&orbit, impact, "1.16900510605", "1.16900510606"), "{arithmetic:?}: {impact:?}");
    }
}

#[test]
fn r14_flights_of_more_periods_than_doubles_count_are_not_followed() {
    // 2 10^16 forcing periods of the faster harmonic; the first contact was certified at ...0.79999995 instead of ...0.99999995.
    for (second, velocity) in [("1e-6", "2.3e-16"), ("0.005", "5e-17")] {
        let text = format!(
            "excitation = {{ amplitude = [0.02, {second}], frequency = [\"pi\", \"20*pi\"], phase = \"pi/2\" }}\n\
             pair = {{ gap = 1, restitution = 0.5 }}\nstart = {{ time = 0, position = 0, velocity = {velocity} }}"
        );
        for arithmetic in arithmetics() {
            let (found, orbit) = events(&Scene::parse(&text).unwrap(), arithmetic, 1);
            assert!(found.is_empty() && matches!(orbit.outcome(), Some(Outcome::Undecided { .. })), "{found:?}");
        }
    }
}

#[test]
fn r16_after_what_may_have_been_a_touch_no_mapping_is_named_that_may_be_false() {
    // (11) in mpmath, 60 digits: the maximum at 2.5286 is 1e-25 beyond the right wall, which is touched; the next mapping is P3.
    let gap = "5.51996296806061375229774706080799496119226455";
    let text = |frequency: &str, amplitude: &str, phase: &str| {
        format!(
            "excitation = {{ amplitude = {amplitude}, frequency = {frequency}, phase = {phase} }}\n\
             pair = {{ gap = {gap}, restitution = 0.5 }}\nstart = {{ time = 0, wall = \"left\", velocity = -0.4 }}"
        )
    };
    // The same harmonic, as one and as two.
    for text in [text("2", "1", "0.7"), text("[2, 2]", "[0.5, 0.5]", "[0.7, 0.7]")] {
        for arithmetic in arithmetics() {
            let (found, _) = events(&Scene::parse(&text).unwrap(), arithmetic, 2);
            let Some(at) = found.iter().position(|event| matches!(event, Progress::Graze(_))) else { continue };
            let Progress::Impact(next) = &found[at + 1] else { panic!("{found:?}") };
            assert_eq!((at, next.wall, next.mapping), (0, Wall::Right, None), "{arithmetic:?}");
            let Progress::Impact(after) = &found[at + 2] else { panic!("{found:?}") };
            assert_eq!(after.mapping, Some(Mapping::P3), "{arithmetic:?}");
        }
    }
}

#[test]
fn r16_a_graze_of_the_wall_that_was_left_leaves_no_doubt_of_the_mapping() {
    // mpmath, 60 digits: the minimum at 2.9192 comes within 10^-44 of the left wall, the maximum at 4.51 is 2.05 from it.
    let text = "excitation = { amplitude = 1, frequency = 2, phase = 2 }\npair = { gap = 2, restitution = 0.5 }\n\
                start = { time = 0, wall = \"left\", velocity = -1.7266462555940501513267306027574550013289669 }";
    let (found, _) = events(&Scene::parse(text).unwrap(), Arithmetic::Interval, 1);
    let [Progress::Graze(graze), Progress::Impact(next)] = &found[..] else { panic!("{found:?}") };
    assert_eq!((graze.at.wall, next.wall, next.mapping), (Wall::Left, Wall::Right, Some(Mapping::P2)));
}

/// A start inside the gap, `10^-52` from the left wall and still: no piece of time is proved free of contacts, and the scan says
/// so at once.
#[test]
fn r14_a_scan_that_cannot_step_ends_as_a_graze() {
    let text = "excitation = { amplitude = [\"3/2\", \"1/10\"], frequency = [\"2*pi\", \"6*pi\"], phase = 0 }\n\
                pair = { gap = 1, restitution = \"1-1/10^16\" }\n\
                start = { time = \"33/37-1/10^60\", position = \"-(1/2-1/10^52)\", velocity = 0 }";
    for arithmetic in arithmetics() {
        let (events, orbit) = events(&Scene::parse(text).unwrap(), arithmetic, 2);
        let is_graze = matches!(orbit.outcome(), Some(Outcome::Undecided { reason: Reason::Graze, .. }));
        assert!(is_graze || !events.is_empty(), "{arithmetic}: {:?}", orbit.outcome());
    }
}

/// A start inside the gap, or on a wall, under one harmonic or two with a gap of 1.
fn undecided(excitation: &str, restitution: &str, start: &str, arithmetic: &str) -> BigRational {
    let text = format!(
        "excitation = {{ {excitation} }}\npair = {{ gap = 1, restitution = \"{restitution}\" }}\nstart = {{ time = 0, {start} }}"
    );
    let (_, orbit) = events(&Scene::parse(&text).unwrap(), arithmetic.parse().unwrap(), 3);
    let Some(Outcome::Undecided { time: (from, None), .. }) = orbit.outcome() else { panic!("{:?}", orbit.outcome()) };
    from.inf().to_rational()
}

#[test]
fn r32_what_is_undecided_may_happen_from_the_time_given_on() {
    // True contacts: mpmath, 50 digits, the first root of (11) for a member of the data; given to below.
    let one = "amplitude = \"0.1\", frequency = \"2*pi\", phase = 0";
    let two = "amplitude = [\"0.1\", \"0.001\"], frequency = [\"2*pi\", \"pi\"], phase = 0";
    let inside = "position = \"[-0.05, 0.05]\", velocity = \"0.02-0.2*pi\"";
    let opposite = "amplitude = \"0.1\", frequency = \"2*pi\", phase = \"pi\"";
    let fast = "wall = \"left\", velocity = \"[-0.799101784376548, -0.798901784376548]\"";
    for (excitation, restitution, start, arithmetic, contact) in [
        (one, "0.5", inside, "interval", "17.7044"),
        (two, "0.5", inside, "interval", "15.6667"),
        (opposite, "1", fast, "interval", "5.2807"),
        (one, "0.5", "position = 0, velocity = \"1e-12-2*pi*0.1\"", "64", "400000000000.75"),
        (
            "amplitude = \"0.05\", frequency = \"2*pi\", phase = \"0-1e-8\"",
            "1e-30",
            "wall = \"right\", velocity = \"1e-3*pi\"",
            "64",
            "1e-8",
        ),
    ] {
        let (from, contact) = (undecided(excitation, restitution, start, arithmetic), rational(contact));
        assert!(from <= contact, "{excitation}, {start}: from {from}, a contact before {contact}");
        let far = &contact * rational("0.999") - rational("1e-7");
        assert!(from >= far, "{excitation}, {start}: from {from}, far before {contact}");
    }
}

#[test]
fn r32_no_event_is_listed_after_the_time_to_stop_at() {
    // The first impact is at 0.551348020218521190909... (mpmath, 50 digits: (A.4) of figure 14): 40 digits distinguish it from the requested time.
    let scene = Scene::parse(include_str!("../scenes/figure-14.toml")).unwrap();
    for (until, listed) in [("0.55134802021852118", 0), ("0.5513480202185212", 1)] {
        let settings = Settings { until: Some(until.parse().unwrap()), digits: 40, ..Settings::default() };
        let mut orbit = Orbit::of(&scene, settings).unwrap();
        assert_eq!((orbit.by_ref().count(), orbit.outcome()), (listed, Some(&Outcome::TimeReached)), "{until}");
    }
}

/// At large times a time to stop at with more digits than are listed is compared as it is written, not as it is enclosed.
#[test]
fn r32_a_time_to_stop_at_of_many_digits_is_compared_exactly() {
    let scene = Scene::parse(
        r#"
        excitation = { amplitude = 0.05, frequency = "2*pi", phase = 0 }
        pair = { gap = 1, restitution = 0 }
        start = { time = "2^40", wall = "right", velocity = 0 }"#,
    )
    .unwrap();
    let listed = |until: &str| {
        let until = Some(until.parse().unwrap());
        let settings = Settings { until, arithmetic: Arithmetic::Bits(64), ..Settings::default() };
        let orbit = Orbit::of(&scene, settings).unwrap().document();
        let document = serde_json::to_value(orbit).unwrap();
        document["events"]
            .as_array()
            .unwrap()
            .iter()
            .map(|event| event["time"][0].as_str().unwrap().to_owned())
            .collect::<Vec<_>>()
    };
    // The second impact is at 1099511627783.32493599890988574345... (`run --digits 30`).
    let [before, after] = ["1099511627783.32493599890988574", "1099511627783.324935998909886"].map(listed);
    assert_eq!(before.len() + 2, after.len(), "an impact and a rest: {before:?}, {after:?}");
}

/// With `e = 0`, or without velocity at a pressed start, a ball stays at once: infinitely many impacts are not those of all members.
#[test]
fn r40_a_rest_comes_after_infinitely_many_impacts_of_every_member() {
    let start = |velocity: &str| format!("time = -0.25, wall = \"left\", velocity = \"{velocity}\"");
    let rests = |restitution: &str, velocity: &str, arithmetic| {
        let (found, _) = events(&scene("1", "1", restitution, &start(velocity)), arithmetic, 1);
        found.iter().find_map(|event| if let Progress::Rest(rest) = event { Some(rest.is_accumulation) } else { None })
    };
    for arithmetic in arithmetics() {
        let found = |restitution: &str, velocity: &str| rests(restitution, velocity, arithmetic);
        assert_eq!([found("1/2", "-1e-12"), found("[0.4, 1/2]", "[-1e-12, -1e-13]")], [Some(true); 2]);
        assert_eq!([found("1/2", "0"), found("[0, 1]", "0"), found("0", "[-1, 0]")], [Some(false); 3]);
        assert_eq!([found("1/2", "[-1e-12, 0]"), found("[0, 1/2]", "-1e-12")], [None; 2]);
    }
    // Floats, which prove nothing, are those of the middles.
    let floats = |restitution: &str, velocity: &str| rests(restitution, velocity, Arithmetic::Float);
    assert_eq!([floats("1/2", "[-1e-12, 0]"), floats("[0, 1/2]", "-1e-12")], [Some(true); 2]);
}
