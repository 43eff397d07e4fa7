//! Relations against the floating map, counts against an independent search, and regions that attract.

use proptest::prelude::*;

use super::chain::{Chain, Laws};
use super::graph::Graph;
use super::relation::Relation;
use super::word::WallChain;
use super::*;
use crate::chaos::guess::Guess;
use crate::chaos::law::Side;
use crate::tests::scene_of;
use crate::watch::{Stage, Unwatched, proceed_if};

fn scene(excitation: &str, pair: &str) -> Scene {
    scene_of(excitation, pair, "time = 0, wall = \"left\", velocity = -12.5")
}

fn figure(number: u32) -> Scene {
    crate::tests::scene(&format!("figure-{number}"))
}

fn found(scene: &Scene, impacts: RangeInclusive<u32>) -> Cycles {
    Cycles::of(scene, Effort::default(), &impacts, Precision::default(), &Unwatched).unwrap().unwrap()
}

/// Whether a number computed in floating point, with an error of 1e-8, may be in an interval.
fn holds(x: Interval, y: f64) -> bool {
    let error = 1e-8 * (1.0 + y.abs());
    x.inf() <= y + error && y - error <= x.sup()
}

proptest! {
    /// Lemma D20: speeds and derivatives over a box, against the floating map and differences.
    #[test]
    fn legs_hold_the_flights_between_two_boxes(
        number in prop::sample::select(vec![14_u32, 16, 17]), phase in 0.0..1.0f64, speed in 0.05..1.5f64,
        radius in prop_oneof![Just(0.0), Just(1e-5), 1e-3..1e-2f64], at in prop::array::uniform2(-1.0..=1.0f64),
    ) {
        let law = Law::of(figure(number).pair()).unwrap();
        let relation = Relation::new(&law);
        let Some(image) = Guess::new(&law).map([phase, speed]) else { return Ok(()) };
        prop_assume!(image.state[1] > 1e-3);
        let ends = [phase, image.state[0]];
        let boxes = [0, 1].map(|i| Interval::new(ends[i] - radius, ends[i] + radius));
        let other = [0, 1].map(|i| Interval::point(ends[i] + at[i] * radius).intersection(boxes[i]).unwrap_or(boxes[i]));
        let Some(leg) = relation.leg(image.side, boxes, other.map(|x| Interval::point(x.mid()))) else { return Ok(()) };
        let own = ends.map(Interval::point);
        let exact = relation.leg(image.side, own, own).unwrap();
        let e = law.restitution.mid();
        prop_assert!(holds(leg.after, e * speed) && holds(leg.before, image.state[1]), "{leg:?} {image:?}");
        prop_assert!(holds(exact.after, e * speed) && exact.after.wid() < 1e-9);
        // The change from the one pair of phases to the other.
        for row in 0..2 {
            let change = (0..2).map(|i| leg.slopes[row][i] * (own[i] - Interval::point(other[i].mid())));
            let change = change.reduce(|a, b| a + b).unwrap();
            let difference = exact.centre[row].mid() - leg.centre[row].mid();
            prop_assert!(holds(change, difference), "{leg:?} {exact:?}");
        }
        let derivative = |row: usize, i: usize| {
            let moved = |by: f64| {
                let mut ends = ends;
                ends[i] += by;
                let own = ends.map(Interval::point);
                relation.leg(image.side, own, own).unwrap().centre[row].mid()
            };
            (moved(1e-6) - moved(-1e-6)) / 2e-6
        };
        for (row, i) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let (slope, seen) = (exact.slopes[row][i], derivative(row, i));
            prop_assert!(slope.wid() < 1e-6 && (slope.mid() - seen).abs() < 1e-4 * (1.0 + seen.abs()), "{row} {i}: {slope:?} {seen}");
        }
    }

    /// Lemma D22: a chain of boxes around a floating-point orbit is cut, and the orbit stays in the boxes.
    #[test]
    fn chains_keep_the_orbit_they_hold(
        number in prop::sample::select(vec![14_u32, 16, 17]), phase in 0.0..1.0f64, speed in 0.1..1.0f64, flights in 1..6usize,
        radius in prop_oneof![Just(1e-4), 1e-3..1e-2f64], at in prop::collection::vec(-0.9..0.9f64, 12),
    ) {
        let law = Law::of(figure(number).pair()).unwrap();
        let guess = Guess::new(&law);
        let mut states = vec![[phase, speed]];
        let mut sides = Vec::new();
        for _ in 0..flights {
            let Some(image) = guess.map(states[states.len() - 1]) else { return Ok(()) };
            states.push(image.state);
            sides.push(image.side);
        }
        prop_assume!(states.iter().all(|state| state[1] > 1e-2));
        let part = |i: usize, which: usize| {
            let centre = states[i][which] + at[2 * i + which] * radius;
            Interval::new(centre - radius, centre + radius)
        };
        let column = |which: usize| (0..=flights).map(|i| part(i, which)).collect::<Vec<_>>();
        let mut chain = Chain { phases: column(0), speeds: column(1), sides, turns: None };
        let before = chain.size(0);
        let laws = Laws { relation: Relation::new(&law), times: Interval::new(0.0, 10.0) };
        prop_assert!(chain.narrow(&laws, 0).is_some());
        for (i, state) in states.iter().enumerate() {
            prop_assert!(holds(chain.phases[i], state[0]) && holds(chain.speeds[i], state[1]), "{i} {chain:?} {states:?}");
        }
        prop_assert!(chain.size(0) <= before);
    }
}

/// The numbers are those of a search in Python that shares no code with this crate: steps and bisection follow a long orbit, and Newton's
/// iteration starts where it nearly comes back (`validation/cycles/search.py` of commit 6b44b0b7, figure 17 with `--near 0.3`).
#[test]
fn counts_are_those_of_an_independent_search() {
    for (number, counts) in [(14, vec![1, 1, 4, 1, 11, 22, 15]), (17, vec![1, 1, 10, 21]), (16, vec![0, 0, 0, 4, 10])] {
        let cycles = found(&figure(number), 1..=counts.len() as u32);
        assert!(cycles.is_certified() && cycles.has_no_attractor(), "figure {number}: {:?}", cycles.undecided());
        assert!(cycles.fixed_points().values().eq(&counts), "figure {number}: {:?}", cycles.fixed_points());
        // Each state that returns is one of a cycle whose impacts divide the number.
        for (&impacts, &count) in cycles.fixed_points() {
            let of = cycles.cycles().iter().filter(|cycle| impacts.is_multiple_of(cycle.impacts));
            assert_eq!(count, of.map(|cycle| cycle.impacts).sum::<usize>(), "figure {number}, {impacts} impacts");
        }
    }
}

/// Figures 12 and 13: the equispaced motion, (66)-(69), is one impact of the mirrored map, and all that there is.
#[test]
fn attracting_motions_are_found_and_stated() {
    for amplitude in ["1", "2"] {
        let excitation = format!("amplitude = {amplitude}, frequency = \"pi\", phase = 0");
        let cycles = found(&scene(&excitation, "gap = 9.42497, restitution = 0.5"), 1..=3);
        assert!(cycles.is_certified() && !cycles.has_no_attractor());
        assert!(cycles.fixed_points().values().eq(&[1, 1, 1]));
        let [Cycle { impacts: 1, orbit, problem }] = cycles.cycles() else { panic!("{:?}", cycles.cycles()) };
        assert_eq!((orbit.stability, orbit.symmetric), (Stability::Stable, Some(true)));
        assert_eq!(problem.word().to_string(), "P1 P2");
    }
}

/// A stop leaves what is proved, and no count that is not.
#[test]
fn an_interrupted_search_claims_no_count() {
    let until = |at: Stage<'_>| proceed_if(!matches!(at, Stage::Cycles { impacts: 3, blocks: 20.., .. }));
    let cycles = Cycles::of(&figure(14), Effort::default(), &(1..=7), Precision::default(), &until).unwrap().unwrap();
    assert!(cycles.fixed_points().keys().eq(&[1, 2]) && !cycles.is_exhaustive() && !cycles.has_no_attractor());
    assert!(!cycles.cycles().is_empty());
}

/// Lemma D21: every cycle has a state in some block, and the layers of the first such block hold all its states in order.
#[test]
fn layers_hold_the_cycles() {
    let scene = figure(14);
    let cycles = found(&scene, 1..=6);
    let law = Law::of(scene.pair()).unwrap();
    let graph = Graph::new(&law, cycles.trap().region());
    for cycle in cycles.cycles() {
        let reduced = |i: usize| {
            let impact = &cycle.orbit.impacts[i % cycle.orbit.impacts.len()];
            let (low, high) = impact.velocity.to_f64_bounds();
            let speed = 0.5 * (low + high).abs() * law.gap.mid() / std::f64::consts::TAU;
            let phase = cycle.orbit.phases()[i % cycle.orbit.impacts.len()].mid();
            [Interval::point(phase + if impact.wall == Wall::Right { 0.5 } else { 0.0 }), Interval::point(speed)]
        };
        let is_held = (0..graph.blocks.len()).any(|block| {
            let Some(layers) = graph.layers(block, cycle.impacts) else { return false };
            let holds = |first: usize| {
                layers.iter().enumerate().all(|(i, layer)| {
                    let [phase, speed] = reduced(first + i);
                    layer.hull(phase, speed).is_some()
                })
            };
            (0..cycle.impacts).any(holds)
        });
        assert!(is_held, "{}", cycle.problem.word());
    }
}

/// One far flight and one near one, in the whole system: twice around, since the walls are exchanged after one round.
#[test]
fn chains_are_given_from_the_left_wall() {
    let point = |x: f64| Interval::point(x);
    let chain = Chain {
        phases: vec![point(0.25), point(1.0)],
        speeds: vec![point(1.0); 2],
        sides: vec![Side::Far, Side::Near],
        turns: Some(1.5 + 0.5),
    };
    let walled = WallChain::new(&chain).unwrap();
    // From the near flight on: it starts at the phase 1, and its arrival at 2.25 is that of the far one.
    assert_eq!((walled.walls.as_str(), walled.cycles), ("LLRR", 3));
    let phases: Vec<f64> = walled.phases.iter().map(|x| x.mid()).collect();
    assert_eq!(phases, [1.0, 2.25, 2.5, 3.75]);
}

/// Lemma D23: where the walls are exchanged after an impact the chain goes around twice, and Newton's iteration may lead to an orbit of two impacts
/// that is not its own mirror image: no state of it returns after one.
#[test]
fn r62_an_orbit_of_two_impacts_is_not_counted_as_returning_after_one() {
    let scene = scene("amplitude = 0.4, frequency = \"pi\", phase = 0", "gap = 1, restitution = 0.8");
    let mut cycles = found(&scene, 1..=2);
    let law = Law::of(scene.pair()).unwrap();
    let [shortest, longest] = cycles.trap().flight();
    let laws = Laws { relation: Relation::new(&law), times: Interval::new(shortest, longest) };
    let (pair, precision) = (scene.pair(), Precision::default());
    let task = Task { pair, law, laws, precision, watch: &Unwatched };
    let problem = Problem::new(pair, &"RL".parse().unwrap(), 1).unwrap();
    let orbits = problem.find(scene.start(), precision).orbits;
    let turned = |orbit: &PeriodicOrbit| orbit.physical == Some(true) && orbit.symmetric == Some(false);
    let orbit = orbits.into_iter().find(turned).expect("an orbit beside its mirror image");
    for (impacts, count) in [(1, 0), (2, 2)] {
        let found = vec![Found { problem: problem.clone(), orbit: orbit.clone() }];
        cycles.collect_blocks(&task, impacts, vec![Block { found, undecided: Vec::new(), is_whole: true }]);
        assert_eq!(cycles.fixed_points()[&impacts], count, "{impacts}");
    }
}
