//! Manifolds of two impacts in N cycles over a parameter, through the public interface: what they claim of the motions in them.

use std::sync::atomic::{AtomicUsize, Ordering};

use impact_pair::exact::{Exact, decimal_bounds};
use impact_pair::pair::Wall;
use impact_pair::two_impact::{Axis, Manifold, Mark, Problem, Range, Unknown};
use impact_pair::watch::{Stage, Unwatched, proceed_if};
use impact_pair::{Harmonic, ImpactPair};

use crate::two_impact::{BITS, exact, holds, meets, pair};

fn curve(pair: &ImpactPair, axis: Axis, from: &str, to: &str, cycles: u32) -> Manifold {
    let range = Range { pair, speed: exact("20"), axis, from: exact(from), to: exact(to), count: 60 };
    range.manifold(cycles, 20, &Unwatched).unwrap()
}

/// Each part of a manifold is what the motion at a point inside is found to be.
#[test]
fn parts_of_the_manifolds_agree_with_the_motions_in_them() {
    let pair = pair("1", "20", "0.8");
    for cycles in [1, 3] {
        let curve = curve(&pair, Axis::Frequency, "0.9", "12", cycles);
        let marks: Vec<_> = curve.points.iter().filter_map(|point| point.mark).collect();
        let expected = [Mark::Graze, Mark::Pitchfork, Mark::Level, Mark::Fold];
        assert!(marks == if cycles == 1 { &expected[1..] } else { &expected[..] }, "{marks:?}");
        for ends in curve.points.windows(2) {
            let between = ends[0].at.sup().to_f64_up() / 2.0 + ends[1].at.inf().to_f64_down() / 2.0;
            let frequency = Exact::from_f64(between).unwrap();
            let harmonic = Harmonic::new(exact("1"), frequency, exact("0")).unwrap();
            let there = ImpactPair::new(harmonic, exact("20"), exact("0.8")).unwrap();
            let found = Problem::new(&there, cycles, Unknown::Amplitude(exact("20"))).unwrap().answer(15);
            let (orbit, part) = (&found.orbits[0], ends[0].after.unwrap());
            assert_eq!(orbit.measured.physical, Some(part.is_physical), "{between}");
            assert_eq!(orbit.measured.stability, part.stability, "{between}");
            assert_eq!(orbit.sine.unwrap().is_gt(), part.is_solid, "{between}");
            let hull = ends[0].amplitude.hull(&ends[1].amplitude);
            assert!(hull.contains_enclosure(&orbit.amplitude), "{between}");
        }
    }
}

/// A parameter manifold that is ended early is the beginning of the whole; it claims nothing after the last point.
#[test]
fn a_manifold_that_is_ended_is_the_beginning_of_the_whole() {
    let pair = pair("1", "20", "0.8");
    for axis in [Axis::Frequency, Axis::Velocity(Wall::Right)] {
        let range = Range { pair: &pair, speed: exact("20"), axis, from: exact("1"), to: exact("30"), count: 40 };
        let summary = |manifold: &Manifold| -> Vec<_> {
            let points = manifold.points.iter();
            points
                .map(|point| (decimal_bounds(&point.at), decimal_bounds(&point.amplitude), point.mark, point.after))
                .collect()
        };
        let whole = summary(&range.manifold(3, 12, &Unwatched).unwrap());
        let calls = AtomicUsize::new(0);
        for most in [0_usize, 1, 2, 7, 39, 40, 41, 55, 79] {
            calls.store(0, Ordering::Relaxed);
            let watch = |_: Stage<'_>| proceed_if(calls.fetch_add(1, Ordering::Relaxed) < most);
            let mut found = summary(&range.manifold(3, 12, &watch).unwrap());
            assert!(found.len() == most.saturating_sub(40), "{most}: {}", found.len());
            if let Some(last) = found.last_mut() {
                assert_eq!(last.3, None);
                last.3 = whole[most - 41].3;
            }
            assert_eq!(found, whole[..found.len()], "{most}");
        }
    }
}

#[test]
fn manifolds_over_v_are_mirror_images_on_both_walls() {
    let pair = pair("1", "20", "0.8");
    let left = curve(&pair, Axis::Velocity(Wall::Left), "-30", "-1", 1);
    let right = curve(&pair, Axis::Velocity(Wall::Right), "1", "30", 1);
    assert_eq!(left.points.len(), right.points.len());
    for (a, b) in left.points.iter().zip(right.points.iter().rev()) {
        assert!(a.mark == b.mark && meets(&a.amplitude, &b.amplitude));
        assert!(holds(&a.at.add(&b.at, BITS), "0"));
    }
    let refused = |cycles, from: &str| {
        let range = Range {
            pair: &pair,
            speed: exact("1"),
            axis: Axis::Frequency,
            from: exact(from),
            to: exact("2"),
            count: 5,
        };
        range.manifold(cycles, 9, &Unwatched).is_err()
    };
    assert!(refused(2, "1") && refused(1, "0") && refused(1, "2") && !refused(1, "1"));
}
