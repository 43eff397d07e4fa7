//! Tests that curves and marks are drawn at the certified events.

use std::f64::consts::TAU;

use approx::{abs_diff_eq, assert_abs_diff_eq};
use impact_pair::Scene;
use impact_pair::orbit::{Arithmetic, Orbit, Progress, Settings};
use impact_pair::pair::Wall;

use super::curves::POINTS_PER_SEGMENT;
use super::frame::{Frame, Panel};
use super::recorder::{Recorder, end_of};
use super::trace::{Kind, Part, Span, Trace};

use crate::tolerances::{DRAWN, DRAWN_END, DRAWN_PHASE};

fn scene(name: &str) -> Scene {
    let path = format!("{}/../../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    Scene::parse(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// The trace of a scene, and the bounds of its impacts: wall, time, velocity.
fn trace(scene: &Scene, settings: &Settings, cycles: u32) -> (Trace, Vec<(Wall, Span, Span)>) {
    let mut orbit: Orbit = Orbit::of(scene, settings.clone()).unwrap();
    let mut recorder = Recorder::new(&orbit, cycles);
    let mut impacts = Vec::new();
    loop {
        let step = orbit.advance();
        recorder.record(&orbit, &step);
        match step {
            Progress::Impact(impact) => {
                let (time, velocity) = orbit.bounds(&impact);
                impacts.push((impact.wall, Span::from(&time), Span::from(&velocity)));
            }
            Progress::Ended => break,
            _ => {}
        }
    }
    let count = impacts.len() as u64;
    (recorder.finish(&orbit, settings, count), impacts)
}

/// Settings for `count` impacts, certified in doubles, which every build has.
fn impacts(count: u64) -> Settings {
    Settings { impacts: Some(count), arithmetic: Arithmetic::Interval, ..Settings::default() }
}

fn meet(a: Span, b: Span) -> bool {
    a.low <= b.high && b.low <= a.high
}

#[test]
fn curves_meet_the_walls_at_the_impacts_and_nowhere_else() {
    for name in ["figure-12", "figure-13", "figure-14", "figure-15", "figure-16", "figure-17"] {
        let (trace, impacts) = trace(&scene(name), &impacts(60), 1000);
        let jumps: Vec<_> = trace.strokes.iter().filter(|stroke| stroke.part == Part::Jump).collect();
        assert_eq!((jumps.len(), trace.crossings.len()), (60, 60), "{name}");
        for (jump, (wall, time, velocity)) in jumps.iter().zip(&impacts) {
            let [before, after] = jump.points[..] else { panic!("{name}: no jump") };
            let at = if *wall == Wall::Left { trace.wall.negated() } else { trace.wall };
            assert!(before.displacement == at && after.displacement == at, "{name}: {before:?}");
            assert!(meet(before.time, *time) && meet(before.velocity, *velocity), "{name}: {before:?}");
            assert!(before.velocity.middle * after.velocity.middle <= 0.0, "{name}: {after:?}");
        }
        let flights: Vec<_> = trace.strokes.iter().filter(|stroke| stroke.part == Part::Flight).collect();
        assert_eq!(flights.len(), 60, "{name}");
        for (flight, jump) in flights.iter().zip(&jumps) {
            assert_eq!(flight.points.last(), jump.points.first(), "{name}");
            assert!(flight.points.len() > 30 && flight.points.is_sorted_by(|a, b| a.at < b.at), "{name}");
            let inside = &flight.points[1..flight.points.len() - 1];
            let limit = trace.wall.low;
            assert!(inside.iter().all(|point| point.displacement.middle.abs() < limit), "{name}");
        }
        for (jump, flight) in jumps.iter().zip(&flights[1..]) {
            assert_eq!(jump.points.last(), flight.points.first(), "{name}");
        }
    }
}

/// Hermite's bound for a twenty-fourth of a forcing period, in amplitudes.
const HERMITE_BOUND: f64 = 1.3e-5;

#[test]
fn bezier_segments_stay_within_hermites_bound_of_the_enclosed_flight() {
    for name in ["figure-12", "figure-13", "figure-14", "figure-16", "figure-17", "two-tones"] {
        let scene = scene(name);
        let mut orbit: Orbit = Orbit::of(&scene, impacts(40)).unwrap();
        let mut recorder = Recorder::new(&orbit, 1000);
        let (mut course, mut turns, phase) = orbit.first_course();
        let mut flights = vec![];
        let mut from = phase.mid();
        loop {
            let step = orbit.advance();
            recorder.record(&orbit, &step);
            let Progress::Impact(impact) = step else { break };
            flights.push((course, turns, from));
            (course, turns, from) = (orbit.course_after(&impact), impact.turns, impact.phase.mid());
        }
        let trace = recorder.finish(&orbit, &impacts(40), 40);
        let sum: f64 =
            scene.pair().excitation().harmonics().iter().map(|term| term.amplitude().enclose(64).mid_rad().0).sum();
        let omega = TAU / trace.period;
        let strokes = trace.strokes.iter().filter(|stroke| stroke.part == Part::Flight);
        let mut seed = 0.0f64;
        for (stroke, (course, turns, from)) in strokes.zip(flights) {
            for pair in stroke.points.windows(POINTS_PER_SEGMENT + 1).step_by(POINTS_PER_SEGMENT) {
                let [a, b] = [&pair[0], &pair[POINTS_PER_SEGMENT]];
                // A low-discrepancy sequence: other places on each segment.
                seed = (seed + 0.618_033_988_749_894_9).fract();
                let at = seed.mul_add(b.at - a.at, a.at);
                let phase = from + (at - stroke.points[0].at);
                let ball = impact_pair::number::Ball::exact(phase - phase.round());
                let truth = orbit.course_point(&course, turns + phase.round() as i64, ball).unwrap();
                let frame = |panel: Panel| Frame::new(panel, &trace, 1000);
                let cubic = |frame: &Frame<'_>| {
                    let end = |point: &super::trace::Point| {
                        let (place, rate) = (frame.place(point), frame.rate(point));
                        ((place[0].middle, place[1].middle), (rate[0] * (b.at - a.at), rate[1] * (b.at - a.at)))
                    };
                    let (start, [first, second, last]) = (end(a).0, crate::picture::hermite(end(a), end(b)));
                    let (s, t) = (1.0 - seed, seed);
                    let along = |a: f64, b: f64, c: f64, d: f64| {
                        s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d
                    };
                    [along(start.0, first.0, second.0, last.0), along(start.1, first.1, second.1, last.1)]
                };
                let near = |x: f64, truth: Span, bound: f64| {
                    let room = bound + 1e-9 * (truth.low.abs() + truth.high.abs() + 1.0);
                    assert!(x >= truth.low - room && x <= truth.high + room, "{name}: {x} {truth:?} {bound:e}");
                };
                let [y, v] = cubic(&frame(Panel::PhasePlane));
                near(y, (&truth.displacement).into(), HERMITE_BOUND * sum);
                near(v, (&truth.velocity).into(), HERMITE_BOUND * sum * omega);
                let [t, y] = cubic(&frame(Panel::Displacement));
                near(t, (&truth.time).into(), 0.0);
                near(y, (&truth.displacement).into(), HERMITE_BOUND * sum);
                let [x, u] = cubic(&frame(Panel::AbsolutePhasePlane));
                near(x, (&truth.absolute_displacement).into(), 0.0);
                near(u, (&truth.absolute_velocity).into(), 0.0);
            }
        }
    }
}

#[test]
fn absolute_coordinates_move_with_no_force_between_impacts() {
    let (trace, _) = trace(&scene("figure-17"), &impacts(40), 1000);
    for flight in trace.strokes.iter().filter(|stroke| stroke.part == Part::Flight) {
        let velocity = flight.points[0].absolute.1;
        assert!(flight.points.iter().all(|point| meet(point.absolute.1, velocity)), "{flight:?}");
    }
}

#[test]
fn r35_crossings_lie_on_their_walls_at_their_phases() {
    let scene = scene("figure-17");
    let (trace, impacts) = trace(&scene, &impacts(40), 0);
    assert!(trace.strokes.is_empty());
    // As everywhere: W t + tau, not W t.
    let tau = scene.pair().excitation().reference().phase().enclose(64).mid_rad().0;
    assert!(tau > 1.0, "{tau}");
    for (crossing, (wall, time, velocity)) in trace.crossings.iter().zip(&impacts) {
        assert!((0.0..TAU).contains(&crossing.phase.low), "{crossing:?}");
        let phase = (time.middle * TAU / trace.period + tau).rem_euclid(TAU);
        assert!(abs_diff_eq!(phase, crossing.phase.middle, epsilon = DRAWN_PHASE), "{crossing:?}, but {phase}");
        assert!(crossing.wall == *wall && crossing.velocity == *velocity, "{crossing:?}");
        assert!(if *wall == Wall::Left { velocity.high <= 0.0 } else { velocity.low >= 0.0 }, "{crossing:?}");
    }
    for (panel, wall) in [(Panel::SectionLeft, Wall::Left), (Panel::SectionRight, Wall::Right)] {
        let frame = Frame::new(panel, &trace, 1);
        let count = impacts.iter().filter(|(of, ..)| *of == wall).count();
        assert!(count > 10 && frame.crossings().count() == count && frame.crossings().all(|(_, of, _)| of == wall));
    }
}

#[test]
fn the_curve_ends_at_the_requested_time() {
    let scene = scene("figure-12-exact");
    let settings = Settings { impacts: None, until: Some("3.5".parse().unwrap()), ..Settings::default() };
    let (cut, _) = trace(&scene, &settings, 100);
    let last = cut.strokes.last().unwrap();
    assert_eq!(last.part, Part::Flight);
    assert_abs_diff_eq!(last.points.last().unwrap().time.middle, 3.5, epsilon = DRAWN);
    assert!(abs_diff_eq!(cut.known, 1.75, epsilon = DRAWN) && !cut.is_open, "{}", cut.known);
    // Cycles are 2 long.
    let (shown, _) = trace(&scene, &impacts(20), 3);
    let end = shown.strokes.iter().flat_map(|stroke| &stroke.points).map(|point| point.time.high).fold(0.0, f64::max);
    assert_abs_diff_eq!(end, 6.0, epsilon = DRAWN);
    let until = end_of(&scene, 3).unwrap();
    assert_abs_diff_eq!(until.enclose(60).mid_rad().0, 6.0, epsilon = DRAWN_END);
}

#[test]
fn chatter_rest_and_release_are_on_the_wall() {
    let (trace, _) = trace(&scene("chatter"), &impacts(40), 3);
    let kinds: Vec<Kind> = trace.marks.iter().map(|mark| mark.kind).collect();
    assert_eq!(kinds, [Kind::Rest, Kind::Release]);
    let left = trace.wall.negated();
    for part in [Part::Chatter, Part::Rest] {
        let stroke = trace.strokes.iter().find(|stroke| stroke.part == part).unwrap();
        assert!(stroke.points.len() > 10);
        assert!(stroke.points.iter().all(|point| point.displacement == left && point.velocity.low == 0.0));
    }
    let release = trace.marks[1].point;
    assert_abs_diff_eq!(release.time.middle, 1.0, epsilon = DRAWN);
    assert!(release.displacement == left && release.velocity.high == 0.0);
    let flight = trace.strokes.iter().find(|stroke| stroke.part == Part::Flight && stroke.points[0].at >= release.at);
    let first = flight.unwrap().points[0];
    assert!(meet(first.displacement, left) && meet(first.velocity, release.velocity), "{first:?}");
}

#[test]
fn a_graze_is_on_the_curve_and_on_the_wall() {
    let (trace, _) = trace(&scene("graze"), &Settings { arithmetic: Arithmetic::Auto, ..impacts(5) }, 10);
    let [graze] = trace.marks[..] else { panic!("{:?}", trace.marks) };
    assert_eq!(graze.kind, Kind::Graze);
    assert_abs_diff_eq!(graze.point.velocity.middle, 0.0, epsilon = DRAWN);
    assert_abs_diff_eq!(graze.point.displacement.middle, trace.wall.middle, epsilon = DRAWN);
    let [to, from] = &trace.strokes[..2] else { panic!("{:?}", trace.strokes) };
    assert_eq!((to.part, from.part), (Part::Flight, Part::Flight));
    let (end, begin) = (to.points.last().unwrap(), from.points.first().unwrap());
    assert!(end.at == graze.point.at && begin.at == graze.point.at);
    assert_abs_diff_eq!(begin.velocity.middle, end.velocity.middle, epsilon = DRAWN);
}

#[test]
fn unproved_claims_are_undecided() {
    let (trace, impacts) = trace(&scene("figure-14"), &impacts(200), 100);
    assert!(trace.is_open && impacts.len() < 200);
    let last = impacts.last().unwrap().1;
    let end = trace.start + trace.known * trace.period;
    assert!(last.low <= end && end <= last.high, "{end} {last:?}");
    let (from, to) = Frame::new(Panel::Velocity, &trace, 100).open().unwrap();
    assert!(from == end && to == 200.0);
    assert!(Frame::new(Panel::Velocity, &trace, 10).open().is_none());
    assert!(Frame::new(Panel::PhasePlane, &trace, 100).last().is_some());
    assert!(Frame::new(Panel::PhasePlane, &trace, 10).last().is_none());
}

#[test]
fn sets_of_states_have_visible_bands() {
    let text = std::fs::read_to_string(format!("{}/../../scenes/figure-13.toml", env!("CARGO_MANIFEST_DIR"))).unwrap();
    let wide = Scene::parse(&text.replace("9.42497", "\"[9.42, 9.43]\"")).unwrap();
    let (band, _) = trace(&wide, &impacts(4), 10);
    let exact = Scene::parse(&text.replace("9.42497", "9.421")).unwrap();
    let (line, _) = trace(&exact, &impacts(4), 10);
    for (outer, inner) in band.strokes.iter().zip(&line.strokes).filter(|(outer, _)| outer.part == Part::Jump) {
        for (outer, inner) in outer.points.iter().zip(&inner.points) {
            assert!(outer.time.low <= inner.time.low && inner.time.high <= outer.time.high);
            assert!(outer.velocity.low <= inner.velocity.low && inner.velocity.high <= outer.velocity.high);
            assert!(outer.time.high - outer.time.low > 1e-4);
        }
    }
}

#[test]
fn an_impact_at_no_certain_time_is_enclosed_before_and_after() {
    let text = std::fs::read_to_string(format!("{}/../../scenes/figure-13.toml", env!("CARGO_MANIFEST_DIR"))).unwrap();
    let wide = Scene::parse(&text.replace("9.42497", "\"[9.40, 9.45]\"")).unwrap();
    let (wide, impacts) = trace(&wide, &impacts(3), 10);
    let either: Vec<_> = wide.strokes.iter().filter(|stroke| stroke.part == Part::Either).collect();
    assert_eq!(either.len(), 3);
    for (stroke, (_, time, _)) in either.iter().zip(&impacts) {
        let [before, after] = stroke.points[..] else { panic!("{stroke:?}") };
        // Not yet: from the middle on; already: up to it.
        assert!(after.time.low <= time.low && time.middle <= after.time.high, "{after:?}");
        assert!(before.time.low <= time.middle && time.high <= before.time.high, "{before:?}");
        assert!(before.velocity.middle * after.velocity.middle < 0.0, "{stroke:?}");
    }
}

#[test]
fn a_box_beyond_a_forcing_period_is_reduced_modulo_it() {
    let (trace, _) = trace(&scene("figure-12"), &impacts(2), 0);
    let span = |low: f64, high: f64| Span { low, middle: 0.5 * (low + high), high };
    let place = [span(6.0, 6.5), span(-2.0, -1.0)];
    let parts = |panel: Panel| Frame::new(panel, &trace, 1).wrapped(place).collect::<Vec<_>>();
    assert_eq!(parts(Panel::SectionLeft), [place, [span(0.0, 6.5 - TAU), place[1]]]);
    assert_eq!(parts(Panel::AbsoluteSwitchPlane), [place]);
}
