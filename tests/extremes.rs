//! At the extremes: requests are met, and decidable questions are decided. The scenes are those of issue 17, and of its kind.

use std::sync::atomic::{AtomicUsize, Ordering};

use impact_pair::chaos::{NoTrap, Trap};
use impact_pair::contact::Reason;
use impact_pair::orbit::Progress;
use impact_pair::orbit::{Impact, Orbit, Outcome, Settings};
use impact_pair::watch::{Stage, proceed_if};
use impact_pair::{Effort, Scene};

fn scene(excitation: &str, pair: &str, start: &str) -> Scene {
    Scene::parse(&format!("excitation = {{ {excitation} }}\npair = {{ {pair} }}\nstart = {{ {start} }}")).unwrap()
}

/// The requested impacts, in `auto`, and the orbit at its end.
fn run(scene: &Scene, impacts: u64) -> (Vec<Impact>, Orbit) {
    let mut orbit = Orbit::of(scene, Settings { impacts: Some(impacts), ..Settings::default() }).unwrap();
    let impacts = orbit.by_ref().collect();
    (impacts, orbit)
}

fn reason(orbit: &Orbit) -> Option<Reason> {
    match orbit.outcome() {
        Some(Outcome::Undecided { reason, .. }) => Some(*reason),
        _ => None,
    }
}

/// Intervals bound what any precision reaches: a few hundred bits say the same as a million, which took 68 s and more.
#[test]
fn r17_no_bits_are_spent_on_what_intervals_leave_open() {
    for (excitation, pair, start) in [
        (
            "amplitude = 1, frequency = 1, phase = 0",
            "gap = 10, restitution = \"[0, 0.1]\"",
            "time = \"1/3\", wall = \"left\", velocity = -1",
        ),
        (
            "amplitude = \"[0.1, 1]\", frequency = 1, phase = 0",
            "gap = 10, restitution = 0.5",
            "time = \"1/3\", wall = \"left\", velocity = -1",
        ),
        (
            "amplitude = 1, frequency = \"[1, 2]\", phase = 0",
            "gap = 10, restitution = 0.5",
            "time = 100, wall = \"left\", velocity = -1",
        ),
        (
            "amplitude = [1, \"[0, 1]\"], frequency = [1, \"sqrt(2)\"], phase = 0",
            "gap = 10, restitution = 0.5",
            "time = \"1/3\", wall = \"left\", velocity = -0.1",
        ),
    ] {
        let (impacts, orbit) = run(&scene(excitation, pair, start), 20);
        assert!(impacts.is_empty() && reason(&orbit).is_some(), "{excitation} {pair}");
        assert!(orbit.bits() <= 512, "{excitation} {pair}: {} bits", orbit.bits());
    }
}

/// No width is narrow relative to `A W` that may be 0: the impact is listed as wide as the interval makes it. There was no end.
#[test]
fn r40_no_bits_are_spent_on_a_width_relative_to_nothing() {
    let excitation = "amplitude = \"[0, 1e-4]\", frequency = \"pi\", phase = 0";
    let scene = scene(excitation, "gap = 9, restitution = 0.5", "time = 0, wall = \"left\", velocity = -1");
    let (impacts, orbit) = run(&scene, 1);
    let (time, _) = orbit.bounds(&impacts[0]);
    // A box at rest is crossed in 18.
    let [low, high] = [time.inf().to_f64_down(), time.sup().to_f64_up()];
    assert!((17.9..=18.0).contains(&low) && (18.0..18.1).contains(&high), "{low} {high}");
    assert!(orbit.first_wide() == Some(1) && orbit.bits() <= 512, "{} bits", orbit.bits());
}

/// A question that 8,192 bits do not answer ends: fast terms of an amplitude of 1e-300 took more than 100 s.
#[test]
fn r17_decisions_have_a_budget() {
    let excitation = "amplitude = [1, \"1e-300\"], frequency = [1, \"1e300\"], phase = 0";
    let scene = scene(excitation, "gap = 10, restitution = 0.5", "time = 0, wall = \"left\", velocity = -1");
    let (_, orbit) = run(&scene, 20);
    assert!(reason(&orbit).is_some() && orbit.bits() < 10_000);
}

/// Lemma R3. The orbits from points of the interval that have a direction lie in that of all of them.
#[test]
fn r17_a_start_in_the_gap_needs_no_direction() {
    let one = "amplitude = 0.1, frequency = 1, phase = 0.4";
    let two = "amplitude = [0.1, 0.05], frequency = [1, \"sqrt(2)\"], phase = [0.4, 1]";
    for excitation in [one, two] {
        for position in ["0", "0.1", "0.4999", "-0.499999"] {
            let at = |velocity: &str| {
                let start = format!("time = 0, position = \"{position}\", velocity = \"{velocity}\"");
                scene(excitation, "gap = 1, restitution = 0.5", &start)
            };
            let (all, of_all) = run(&at("[-1e-9, 1e-9]"), 3);
            assert_eq!(all.len(), 3, "{excitation} {position}");
            for velocity in ["-1e-9", "1e-9", "-1e-10", "0", "3e-10", "cos(pi/5) - cos(2*pi/5) - 1/2"] {
                let (impacts, orbit) = run(&at(velocity), 3);
                for (impact, wide) in impacts.iter().zip(&all) {
                    let [(time, speed), (wide_time, wide_speed)] = [orbit.bounds(impact), of_all.bounds(wide)];
                    assert!(impact.wall == wide.wall && wide_time.intersection(&time).is_some());
                    assert!(wide_speed.intersection(&speed).is_some() && wide_time.wid() > time.wid(), "{velocity}");
                }
            }
        }
    }
}

/// Exactly no velocity, a phase of exactly a quarter of a forcing period: both in disguise (Lemma X2).
#[test]
fn r17_zeros_in_disguise_are_zeros() {
    let plain = scene(
        "amplitude = 1, frequency = 1, phase = 0.3",
        "gap = 10, restitution = 0.5",
        "time = 0, wall = \"left\", velocity = 0",
    );
    let disguised = "time = 0, wall = \"left\", velocity = \"cos(0.3) - cos(-0.3)\"";
    let disguised = scene("amplitude = 1, frequency = 1, phase = 0.3", "gap = 10, restitution = 0.5", disguised);
    assert_eq!(run(&plain, 5).0, run(&disguised, 5).0);

    // At a quarter of a forcing period with no velocity the drift is 0 and the wall is grazed once per forcing period, for ever (Lemma Z4).
    let excitation = "amplitude = 1, frequency = \"sqrt(2)\", phase = \"pi/2 - sqrt(2)/3\"";
    let start = "time = \"1/3\", wall = \"left\", velocity = 0";
    let (impacts, orbit) = run(&scene(excitation, "gap = 10, restitution = 0.5", start), 5);
    assert!(impacts.is_empty() && matches!(orbit.outcome(), Some(Outcome::Periodic(period)) if period.impacts == 0));
}

/// Chatter that begins `1e-16` forcing periods after the contact force does was listed down to the smallest double and then for ever.
#[test]
fn r17_chatter_at_the_edge_of_the_pressure_is_a_rest() {
    for restitution in ["1e-30", "1e-40", "0.01", "1e-4"] {
        let pair = format!("gap = 1, restitution = \"{restitution}\"");
        let start = "time = 0, wall = \"left\", velocity = -1";
        let scene = scene("amplitude = \"7/2\", frequency = \"sqrt(2)\", phase = \"-3*pi\"", &pair, start);
        let mut orbit = Orbit::of(&scene, Settings { impacts: Some(40), ..Settings::default() }).unwrap();
        let mut rests = 0;
        let mut impacts = 0;
        loop {
            match orbit.advance() {
                Progress::Ended => break,
                Progress::Rest(_) => rests += 1,
                Progress::Impact(_) if rests == 0 => impacts += 1,
                _ => {}
            }
        }
        assert!(rests > 0 && impacts < 12 && reason(&orbit).is_none(), "e = {restitution}: {impacts} impacts");
    }
}

#[test]
fn r17_the_extremes_of_data_are_read() {
    let start = "time = 0, wall = \"left\", velocity = -1";
    let near_one = scene("amplitude = 1, frequency = 1, phase = 0", "gap = 10, restitution = \"1 - 1e-4000\"", start);
    assert_eq!(run(&near_one, 4).0.len(), 4);
    let far = scene("amplitude = 1, frequency = 1, phase = \"1e100\"", "gap = 10, restitution = 0.5", start);
    assert_eq!(run(&far, 4).0.len(), 4);
    // Whole forcing periods change nothing.
    let shifted = |turns: &str| {
        scene(
            &format!("amplitude = 1, frequency = 1, phase = \"0.3 + {turns}*pi\""),
            "gap = 10, restitution = 0.5",
            start,
        )
    };
    let times = |scene: &Scene| {
        let (impacts, orbit) = run(scene, 4);
        impacts.iter().map(|impact| orbit.bounds(impact).0).collect::<Vec<_>>()
    };
    let [near, far] = ["0", "2e100"].map(|turns| times(&shifted(turns)));
    assert!(near.len() == 4 && near.iter().zip(&far).all(|(a, b)| a.intersection(b).is_some()));

    let settings = |until: &str| Settings { until: Some(until.parse().unwrap()), ..Settings::default() };
    let error = Orbit::of(&near_one, settings("-5")).unwrap_err();
    assert_eq!(error.to_string(), "run.until is -5, but must be at least start.time, 0");
    assert!(Orbit::of(&near_one, settings("0")).is_ok());
}

/// At `e = 1` the reduced map preserves the area `w dw dth`, so that no set of boxes is mapped into its interior: none is looked for where the
/// restitution is 1, or may be.
#[test]
fn r48_no_region_is_looked_for_where_the_map_preserves_area() {
    let regions = |restitution: &str| {
        let restitution = format!("restitution = {restitution}");
        let text = include_str!("../scenes/figure-14.toml").replace("restitution = 0.5", &restitution);
        let boxes = AtomicUsize::new(0);
        let watch = |at: Stage<'_>| {
            boxes.fetch_add(usize::from(matches!(at, Stage::Region(_))), Ordering::Relaxed);
            proceed_if(true)
        };
        let found = Trap::of(&Scene::parse(&text).unwrap(), Effort::default(), &watch).unwrap();
        (found.err(), boxes.into_inner())
    };
    for restitution in ["1", "\"[0.99, 1]\"", "\"[0, 1]\""] {
        assert_eq!(regions(restitution), (Some(NoTrap::Elastic), 0), "{restitution}");
    }
    let (refused, boxes) = regions("0.5");
    assert!(refused.is_none() && boxes > 0);
}
