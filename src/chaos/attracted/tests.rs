//! Sets that move with the parameters against certified flights of their members, and what is proved of cells against the orbits of values
//! in them.

use proptest::prelude::*;

use super::*;
use crate::Scene;
use crate::chaos::tests::{meet, truth};
use crate::chaos::{Cells, RangeSettings, Stretch, Verdict};
use crate::orbit::{Arithmetic, Orbit, Outcome, Progress, Settings};
use crate::watch::Unwatched;

/// State of a set, and the law with the `e` and `D` that the state belongs to.
fn member(set: &Set, law: &Law, part: [f64; 4]) -> (State, Law) {
    let [a, b, c, d] = part;
    let state = [0, 1].map(|i| {
        let own = a.mul_add(set.sides[0][i], b.mul_add(set.sides[1][i], set.middle[i]));
        c.mul_add(set.moved[0][i], d.mul_add(set.moved[1][i], own))
    });
    // Within the radius, whatever is rounded.
    let within = |x: Ball, part: f64| Ball::exact(x.mid() + part * x.rad() * (1.0 - 1e-9));
    (state, Law { gap: within(law.gap, d), restitution: within(law.restitution, c) })
}

/// Distance of a state from the middle of a set, for the parameters of a member, in coordinates by its sides; less the state's own radius.
fn reach(set: &Set, [phase, speed]: [Ball; 2], [c, d]: [f64; 2]) -> f64 {
    let moved =
        |i: usize| Ball::exact(c) * Ball::exact(set.moved[0][i]) + Ball::exact(d) * Ball::exact(set.moved[1][i]);
    let away = [
        phase - Ball::exact(set.turns) - Ball::exact(set.middle[0]) - moved(0),
        speed - Ball::exact(set.middle[1]) - moved(1),
    ];
    let along = |[n, m]: [Ball; 2]| n * away[0] + m * away[1];
    let far = |x: Ball| x.mid().abs() - x.rad();
    coordinates(set.sides).unwrap().map(|normal| far(along(normal))).into_iter().fold(0.0, f64::max)
}

fn vector(size: f64) -> impl Strategy<Value = State> {
    [-size..=size, -size..=size]
}

proptest! {
    /// Lemma D15: the next set holds the image of each member, given its own parameters; and the difference of images from any states
    /// that move with these is in its bounds.
    #[test]
    fn the_next_set_holds_the_images(
        (gap, restitution) in prop_oneof![Just((1.178125, 0.5)), Just((3.0, 0.5)), Just((1.0, 0.8)), Just((0.1, 0.8))],
        radii in (prop_oneof![Just(0.0), 1e-7..1e-3f64], prop_oneof![Just(0.0), 1e-7..1e-3f64]),
        middle in (0.0..1.0f64, 0.05..1.6f64),
        (p, q) in (vector(1e-3), vector(1e-3)),
        (r, s) in (vector(2e-3), vector(2e-3)),
        other in [vector(1e-3), vector(1e-3)],
        part in [-1.0..=1.0f64, -1.0..=1.0, -1.0..=1.0, -1.0..=1.0],
        is_corner in any::<bool>(),
    ) {
        let law = Law { gap: Ball::new(gap, radii.0), restitution: Ball::new(restitution, radii.1) };
        let set = Set { middle: middle.into(), sides: [p, q], moved: [r, s], wall: Wall::Left, turns: 0.0 };
        let part = if is_corner { part.map(f64::signum) } else { part };
        let (state, one) = member(&set, &law, part);
        if let (Some((next, side)), Some((true_side, image))) = (set.next(&law, &Guess::new(&law)), truth(&one, state)) {
            prop_assert_eq!(side, true_side);
            let found = reach(&next, image, [part[2], part[3]]);
            prop_assert!(found <= 1.0 + 1e-9, "{found}");
            let arrival = image[0].mid() - if side == Side::Far { 0.5 } else { 0.0 };
            let landing = Flights::moved(&law, &set.quad(), set.moved).land(side, arrival);
            for i in 0..2 {
                let normal = [i == 0, i == 1].map(|is_it| Ball::exact(if is_it { 1.0 } else { 0.0 }));
                let moved = Ball::exact(part[2]) * Ball::exact(other[0][i]) + Ball::exact(part[3]) * Ball::exact(other[1][i]);
                if let Some(landing) = landing {
                    let found = landing.beside(normal, [Ball::exact(0.0); 2], other);
                    prop_assert!(meet(found, image[i] - moved), "{found:?} {image:?} {moved:?}");
                }
            }
        }
    }

    /// A set that is held has no member outside, whatever the parameters.
    #[test]
    fn members_are_inside(
        (p, q) in (vector(1e-3), vector(1e-3)), (r, s) in (vector(1e-3), vector(1e-3)),
        (away, t, u) in (vector(3e-4), vector(3e-4), vector(3e-4)), size in 0.1..1.2f64,
        part in [-1.0..=1.0f64, -1.0..=1.0, -1.0..=1.0, -1.0..=1.0], turns in -3..3i32,
    ) {
        let law = Law { gap: Ball::exact(1.0), restitution: Ball::exact(0.5) };
        let set = Set { middle: [0.3, 0.7], sides: [p, q], moved: [r, s], wall: Wall::Left, turns: 0.0 };
        let plus = |a: State, b: State| [a[0] + b[0], a[1] + b[1]];
        let other = Set {
            middle: plus([0.3 + f64::from(turns), 0.7], away),
            sides: [p, q].map(|side| side.map(|x| size * x)),
            moved: [plus(r, t), plus(s, u)],
            ..set
        };
        if let Some(shift) = set.holds(&other) {
            prop_assert_eq!(shift, f64::from(turns));
            let corner = part.map(f64::signum);
            for part in [part, corner] {
                let (state, _) = member(&other, &law, part);
                let state = [Ball::exact(state[0] - shift), Ball::exact(state[1])];
                prop_assert!(reach(&set, state, [part[2], part[3]]) < 1.0 + 1e-9);
            }
        }
    }
}

/// Numbers of impacts and of cycles of the stable orbit that `run` proves for one value of the parameter, by sets without parameters.
fn impacts_and_cycles(scene: &Scene, requested: &RangeSettings, value: &crate::exact::Exact) -> (usize, u32) {
    let pair = scene.pair().with(requested.over.key(), value.clone()).unwrap();
    let settings =
        Settings { impacts: Some(2000), attractor: true, arithmetic: Arithmetic::Auto, ..Settings::default() };
    let mut orbit = Orbit::new(&pair, scene.start(), settings).unwrap();
    while !matches!(orbit.advance(), Progress::Ended) {}
    let Some(Outcome::Attracted(attractor)) = orbit.outcome() else { panic!("{value:?}: {:?}", orbit.outcome()) };
    (attractor.word.mappings().len(), attractor.cycles)
}

/// Each key, wide cells, motions with one impact a half cycle, three a cycle and doubled ones: as `run` proves at ends and middle.
#[test]
fn orbits_of_values_in_a_cell_converge_as_it_says() {
    let text = include_str!("../../../scenes/figure-14.toml");
    for (amplitude, over, cells, expected) in [
        ("2", "amplitude=1.9..2", 1, (2, 1)),
        ("2", "gap=9.35..9.45", 1, (2, 1)),
        ("2", "restitution=0.49..0.5", 1, (2, 1)),
        ("2", "frequency=3.1..3.125", 1, (2, 1)),
        ("5", "amplitude=5..5.00625", 2, (3, 1)),
    ] {
        let scene = Scene::parse(&text.replace("amplitude = 8", &format!("amplitude = {amplitude}"))).unwrap();
        let requested = RangeSettings { over: over.parse().unwrap(), cells, halvings: 3, depth: 3 };
        let found = Cells::of(scene.pair(), scene.start(), &requested, &Unwatched).unwrap();
        let [Stretch { low, high, verdict: Verdict::Attracted { word, cycles, .. }, .. }] = &found.stretches[..] else {
            panic!("{over}: {:?}", found.stretches)
        };
        assert_eq!((word.mappings().len(), *cycles), expected, "{over}");
        let middle = low.checked_add(high).unwrap().checked_div(&2.into()).unwrap();
        for value in [low, &middle, high] {
            assert_eq!(impacts_and_cycles(&scene, &requested, value), expected, "{over} {value:?}");
        }
    }
}
