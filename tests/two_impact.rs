//! Two impacts in N cycles, through the public interface: what is proved of each motion, and that the certified orbit agrees.

use std::sync::atomic::{AtomicUsize, Ordering};

use impact_pair::exact::{Dyadic, Enclosure, Exact, decimal_bounds};
use impact_pair::json::MeasuredImpact;
use impact_pair::mapping::{Passage, jacobian};
use impact_pair::number::Ball;
use impact_pair::orbit::{Impact, Orbit as Run, Progress, Settings, Start};
use impact_pair::pair::{Reduced, Wall};
use impact_pair::two_impact::{Answer, Axis, Orbit, Problem, Range, Stability, Unknown};
use impact_pair::watch::{Stage, Unwatched, proceed_if};
use impact_pair::{Harmonic, ImpactPair, Scene};
use proptest::prelude::*;

pub const BITS: u32 = 160;

pub fn exact(text: &str) -> Exact {
    Exact::parse(text).unwrap()
}

/// A pair with `W = pi`.
pub fn pair(amplitude: &str, gap: &str, restitution: &str) -> ImpactPair {
    let harmonic = Harmonic::new(exact(amplitude), exact("pi"), exact("0")).unwrap();
    ImpactPair::new(harmonic, exact(gap), exact(restitution)).unwrap()
}

fn all(pair: &ImpactPair, cycles: u32) -> Answer {
    Problem::new(pair, cycles, Unknown::Velocity).unwrap().answer(20)
}

/// Whether two enclosures have a number in common.
pub fn meets(x: &Enclosure, y: &Enclosure) -> bool {
    x.intersection(y).is_some()
}

pub fn holds(x: &Enclosure, text: &str) -> bool {
    meets(x, &exact(text).enclose(BITS))
}

/// (57)-(60) in the units of the scene, `W = pi`, for both flights: each side less the other must hold 0.
fn residuals(pair: &ImpactPair, orbit: &Orbit, cycles: u32) -> [Enclosure; 4] {
    let bits = BITS;
    let [e, gap, amplitude] =
        [pair.restitution(), pair.gap(), pair.excitation().reference().amplitude()].map(|x| x.enclose(bits));
    let frequency = Enclosure::pi(bits);
    let swing = amplitude.mul(&frequency, bits);
    let there = orbit.spacing.div(&frequency, bits).unwrap();
    let period = Enclosure::point(Dyadic::new((2 * cycles).into(), 0));
    let times = [there.clone(), period.sub(&there, bits)];
    let mut found = Vec::new();
    for (i, time) in times.iter().enumerate() {
        let (from, to) = (&orbit.measured.impacts[i], &orbit.measured.impacts[1 - i]);
        let shaken = |phase: &Enclosure| swing.mul(&phase.cos(bits), bits);
        let drift = shaken(&from.phase).sub(&e.mul(&from.velocity, bits), bits);
        found.push(drift.sub(&shaken(&to.phase), bits).sub(&to.velocity, bits));
        let height = |phase: &Enclosure| amplitude.mul(&phase.sin(bits), bits);
        let travel = drift.mul(time, bits).sub(&height(&to.phase), bits).add(&height(&from.phase), bits);
        found.push(if i == 0 { travel.sub(&gap, bits) } else { travel.add(&gap, bits) });
    }
    found.try_into().unwrap()
}

/// All that must hold of any answer.
fn judge(pair: &ImpactPair, answer: &Answer, cycles: u32) {
    for orbit in &answer.orbits {
        for rest in residuals(pair, orbit, cycles) {
            assert!(holds(&rest, "0") && rest.wid() < Dyadic::power_of_two(-40), "{orbit:?} {rest:?}");
        }
        let e = pair.restitution().enclose(BITS);
        assert!(meets(&orbit.measured.determinant, &e.powi(4, BITS).unwrap()));
        let [[re0, im0], [re1, im1]] = orbit.measured.eigenvalues.each_ref().map(|value| [&value.re, &value.im]);
        let product = re0.mul(re1, BITS).sub(&im0.mul(im1, BITS), BITS);
        assert!(
            meets(&product, &orbit.measured.determinant) && meets(&re0.add(re1, BITS), &orbit.measured.trace),
            "{orbit:?}"
        );
        assert!(holds(&im0.add(im1, BITS), "0"));
        let size = |re: &Enclosure, im: &Enclosure| re.powi(2, BITS).unwrap().add(&im.powi(2, BITS).unwrap(), BITS);
        let sizes = [size(re0, im0), size(re1, im1)];
        match orbit.measured.stability {
            Stability::Stable => assert!(sizes.iter().all(|size| size.inf() < &Dyadic::power_of_two(0))),
            Stability::Unstable => assert!(sizes.iter().any(|size| size.sup() > &Dyadic::power_of_two(0))),
            Stability::Elliptic => {
                let is_within = orbit.measured.trace.mag() < Dyadic::power_of_two(1);
                assert!(is_within && sizes.iter().all(|size| holds(size, "1")) && !holds(im0, "0"), "{orbit:?}");
            }
            Stability::Undecided => {}
        }
        if let (Some(is_physical), Some(is_followed)) = (orbit.measured.physical, is_followed(pair, orbit, cycles)) {
            assert_eq!(is_physical, is_followed, "{orbit:?}");
        }
        assert!(meets(&orbit.measured.trace, &product_of_jacobians(pair, orbit, cycles)), "{orbit:?}");
        // Its mirror image is in the list as well.
        let mirrored = |other: &&Orbit| {
            let turned = |a: &Enclosure, b: &Enclosure| {
                holds(&a.sin(BITS).add(&b.sin(BITS), BITS), "0") && holds(&a.cos(BITS).add(&b.cos(BITS), BITS), "0")
            };
            turned(&orbit.measured.impacts[0].phase, &other.measured.impacts[1].phase)
                && turned(&orbit.measured.impacts[1].phase, &other.measured.impacts[0].phase)
                && meets(&orbit.measured.impacts[1].velocity, &other.measured.impacts[1].velocity)
        };
        let mirror: Vec<&Orbit> = answer.orbits.iter().filter(mirrored).collect();
        assert!(mirror.len() == 1 || !orbit.measured.unique, "{orbit:?}");
        assert!(!orbit.measured.unique || Some(std::ptr::eq(mirror[0], orbit)) == orbit.measured.symmetric);
        assert_eq!(mirror[0].measured.physical, orbit.measured.physical);
    }
}

/// The trace of the product of (A.7) by the Jacobian of `mapping`, in forcing periods and gaps, on balls.
fn product_of_jacobians(pair: &ImpactPair, orbit: &Orbit, cycles: u32) -> Enclosure {
    let ball = |x: &Enclosure| {
        let (mid, rad) = x.mid_rad();
        Ball::new(mid, rad)
    };
    let reduced = Reduced::exact(pair).unwrap().enclosed().unwrap();
    let turn = Enclosure::pi(BITS).mul(&exact("2").enclose(BITS), BITS);
    // v in gaps per forcing period: 2 pi v/(W d), W = pi.
    let speed =
        |v: &Enclosure| ball(&v.mul(&exact("2").enclose(BITS), BITS).div(&pair.gap().enclose(BITS), BITS).unwrap());
    let there = orbit.spacing.div(&turn, BITS).unwrap();
    let back = exact(&cycles.to_string()).enclose(BITS).sub(&there, BITS);
    let [left, right] = orbit.measured.impacts.as_slice() else { panic!("two impacts") };
    let step = |from: &MeasuredImpact<Enclosure>, to: &MeasuredImpact<Enclosure>, time: &Enclosure| {
        let passage = Passage {
            time: ball(time),
            sin0: ball(&from.phase.sin(BITS)),
            sin1: ball(&to.phase.sin(BITS)),
            velocity0: speed(&from.velocity),
            velocity1: speed(&to.velocity),
        };
        jacobian(reduced.beta, reduced.restitution, &passage).unwrap()
    };
    let ([[a, b], [c, d]], [[p, q], [r, s]]) = (step(left, right, &there), step(right, left, &back));
    (p * a + q * c + r * b + s * d).enclosure().unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, rng_seed: proptest::test_runner::RngSeed::Fixed(1995), ..ProptestConfig::default() })]

    #[test]
    fn motions_satisfy_their_equations_and_come_with_their_mirror_images(
        amplitude in 1..3000u32, e in 0..=100u32, cycles in 1..6u32,
    ) {
        let pair = pair(&format!("{amplitude}/1000"), "1", &format!("{e}/100"));
        judge(&pair, &all(&pair, cycles), cycles);
    }

    #[test]
    fn intervals_of_parameters_hold_the_motions_of_their_members(amplitude in 100..600u32, e in 10..90u32, part in 0..=10u32) {
        let wide = pair(&format!("[{amplitude}/1000, {amplitude}/1000 + 1/100000]"), "1", &format!("{e}/100"));
        let member = pair(&format!("{amplitude}/1000 + {part}/1000000"), "1", &format!("{e}/100"));
        let (of_set, of_member) = (all(&wide, 1), all(&member, 1));
        prop_assert!(!of_set.is_exhaustive || of_set.orbits.len() == of_member.orbits.len());
        for (orbit, inside) in of_set.orbits.iter().zip(&of_member.orbits).filter(|_| of_set.is_exhaustive) {
            prop_assert!(orbit.measured.physical.is_none() || orbit.measured.physical == inside.measured.physical);
            prop_assert!(orbit.measured.stability == Stability::Undecided || orbit.measured.stability == inside.measured.stability);
            prop_assert!(meets(&orbit.measured.trace, &inside.measured.trace));
            for (a, b) in orbit.measured.impacts.iter().zip(&inside.measured.impacts) {
                prop_assert!(meets(&a.phase, &b.phase) && meets(&a.velocity, &b.velocity));
            }
        }
    }
}

#[test]
fn the_orbit_of_figure_12_is_exact() {
    let pair = pair("1", "3*pi", "0.5");
    let answer = all(&pair, 1);
    assert!(answer.is_complete && answer.is_exhaustive && answer.orbits.len() == 2);
    let orbit = &answer.orbits[0];
    assert!(orbit.measured.impacts[0].phase.is_point() && holds(&orbit.measured.impacts[0].phase, "0"));
    assert!(holds(&orbit.measured.impacts[0].velocity, "-4*pi") && holds(&orbit.measured.eigenvalues[0].re, "1/4"));
    assert_eq!((orbit.measured.physical, orbit.measured.stability), (Some(true), Stability::Stable));
    // (68) and (67) give the same back.
    let speed = exact("4*pi");
    let found = Problem::new(&pair, 1, Unknown::Amplitude(speed.clone())).unwrap().answer(20);
    assert!(found.orbits.len() == 1 && found.is_complete && holds(&found.orbits[0].amplitude, "1"));
    let found = Problem::new(&pair, 1, Unknown::Gap(speed)).unwrap().answer(20);
    assert!(found.orbits.len() == 1 && found.is_complete && holds(&found.orbits[0].gap, "3*pi"));
}

#[test]
fn even_cycles_are_possible_unequispaced() {
    for (gap, cycles) in [("10.82", 2), ("14.21", 4)] {
        let answer = all(&pair("1", gap, "0.5"), cycles);
        let stable =
            |orbit: &&Orbit| orbit.measured.stability == Stability::Stable && orbit.measured.physical == Some(true);
        assert_eq!(answer.orbits.iter().filter(stable).count(), 2);
        assert!(answer.is_exhaustive && answer.orbits.iter().all(|orbit| orbit.measured.symmetric == Some(false)));
    }
}

#[test]
fn elastic_motions_are_those_of_70_and_71() {
    let odd = all(&pair("1", "20", "1"), 1);
    assert!(
        holds(&odd.orbits[0].measured.impacts[1].velocity, "18")
            && holds(&odd.orbits[1].measured.impacts[1].velocity, "22")
    );
    let even = all(&pair("1", "20", "1"), 2);
    // |v| = d W/(N pi), W = pi
    assert!(even.orbits[..2].iter().all(|orbit| holds(&orbit.measured.impacts[1].velocity, "10")));
    assert!(even.is_exhaustive && even.orbits.len() == 4);
    let stabilities = odd.orbits.iter().map(|orbit| orbit.measured.stability);
    assert!(stabilities.eq([Stability::Unstable, Stability::Elliptic]));
}

#[test]
fn the_pitchfork_and_the_fold_are_where_item_2_says() {
    let counts = |amplitude: &str| all(&pair(amplitude, "1", "0.8"), 1).orbits.len();
    // A_sn = 0.0352796142...; between it and A_pf = 0.3458892783... two orbits, beyond four.
    assert_eq!(counts("0.03527"), 0);
    assert_eq!(counts("0.03528"), 2);
    assert_eq!(counts("0.345889278"), 2);
    assert_eq!(counts("0.345889279"), 4);
    // From A = d/2 on the solid branch is gone.
    assert_eq!([counts("0.4999999"), counts("0.5")], [4, 3]);
}

#[test]
fn questions_without_an_answer_are_refused() {
    let still = pair("0", "1", "0.5");
    assert_eq!(Problem::new(&still, 1, Unknown::Velocity).unwrap_err().key(), Some("excitation.amplitude"));
    let wide = pair("1", "1", "[0.9, 1]");
    assert_eq!(Problem::new(&wide, 1, Unknown::Velocity).unwrap_err().key(), Some("pair.restitution"));
    let good = pair("1", "1", "0.5");
    assert!(
        Problem::new(&good, 0, Unknown::Velocity).is_err() && Problem::new(&good, 1000, Unknown::Velocity).is_err()
    );
    assert!(Problem::new(&good, 1, Unknown::Gap(exact("0"))).is_err());
}

/// Every stable physical orbit, started from its bounds, is run for 100 periods.
#[test]
fn stable_orbits_stay_inside_their_bounds() {
    let mut count = 0;
    for (amplitude, gap, e, cycles) in [
        ("1", "3*pi", "0.5", 1),
        ("2", "9.42497", "0.5", 1),
        ("0.36", "1", "0.8", 1),
        ("0.51", "1", "0.15", 1),
        ("1", "10.82", "0.5", 2),
        ("1", "14.21", "0.5", 4),
        ("0.0118", "1", "0.8", 3),
        ("0.4", "1", "0", 1),
    ] {
        let pair = pair(amplitude, gap, e);
        for orbit in &all(&pair, cycles).orbits {
            if orbit.measured.physical == Some(true) && orbit.measured.stability == Stability::Stable {
                follow(&pair, orbit, cycles);
                count += 1;
            }
        }
    }
    assert!(count >= 10, "{count}");
}

fn follow(pair: &ImpactPair, orbit: &Orbit, cycles: u32) {
    let (mut run, periods) = (start(pair, orbit, 200), 100);
    for period in 0..periods {
        for wall in [Wall::Right, Wall::Left] {
            let Progress::Impact(impact) = run.advance() else { panic!("{orbit:?}") };
            assert!(is_expected(&run, &impact, orbit, (cycles, period, wall)), "{period} {orbit:?}");
            assert!(run.bounds(&impact).0.wid() < Dyadic::power_of_two(-30));
        }
    }
    assert!(matches!(run.advance(), Progress::Ended));
}

/// Whether the certified orbit has the two impacts of a motion and no earlier impact; `None` if undecided.
fn is_followed(pair: &ImpactPair, orbit: &Orbit, cycles: u32) -> Option<bool> {
    let mut run = start(pair, orbit, 2);
    for wall in [Wall::Right, Wall::Left] {
        match run.advance() {
            Progress::Impact(impact) if !is_expected(&run, &impact, orbit, (cycles, 0, wall)) => return Some(false),
            Progress::Impact(_) => {}
            Progress::Rest(_) => return Some(false),
            _ => return None,
        }
    }
    Some(true)
}

/// The certified orbit from the bounds of the impact on the left wall.
fn start(pair: &ImpactPair, orbit: &Orbit, impacts: u64) -> Run {
    let interval = |x: &Enclosure| {
        let [low, high] = decimal_bounds(x);
        exact(&format!("[{low}, {high}]"))
    };
    let left = &orbit.measured.impacts[0];
    let harmonic =
        Harmonic::new(pair.excitation().reference().amplitude().clone(), exact("pi"), interval(&left.phase)).unwrap();
    let shifted = ImpactPair::new(harmonic, pair.gap().clone(), pair.restitution().clone()).unwrap();
    let start = Start::on_wall(exact("0"), Wall::Left, interval(&left.velocity)).unwrap();
    Run::new(&shifted, &start, Settings { impacts: Some(impacts), ..Settings::default() }).unwrap()
}

/// Whether an impact may be the motion's impact on this wall in this period.
fn is_expected(run: &Run, impact: &Impact, orbit: &Orbit, (cycles, period, wall): (u32, u32, Wall)) -> bool {
    let number = |n: u32| exact(&n.to_string()).enclose(BITS);
    let (time, velocity) = run.bounds(impact);
    let (expected, index) = match wall {
        Wall::Right => {
            let there = orbit.spacing.div(&Enclosure::pi(BITS), BITS).unwrap();
            (number(2 * cycles * period).add(&there, BITS), 1)
        }
        Wall::Left => (number(2 * cycles * (period + 1)), 0),
    };
    impact.wall == wall && meets(&time, &expected) && meets(&velocity, &orbit.measured.impacts[index].velocity)
}

#[test]
fn features_for_one_harmonic_are_refused_for_several() {
    let scene = Scene::parse(include_str!("../scenes/square-wave.toml")).unwrap();
    let (speed, axis) = (exact("20"), Axis::Frequency);
    let range = Range { pair: scene.pair(), speed, axis, from: exact("1"), to: exact("2"), count: 5 };
    let errors =
        [Problem::new(scene.pair(), 1, Unknown::Velocity).unwrap_err(), range.manifold(1, 9, &Unwatched).unwrap_err()];
    for error in errors {
        let said = error.to_string();
        assert!(said.contains("has 3 harmonics") && said.contains("periodic --word RL --cycles N --all"), "{said}");
    }
}

/// W7 (b) with `2 j = N`: `cos th0 = 0` and `d = N pi |v|/W`, whatever A is.
#[test]
fn r32_elastic_equispaced_motions_of_an_even_number_of_cycles_are_found() {
    let pair = pair("1", "7", "1");
    for (cycles, gap) in [(2, "10"), (4, "20")] {
        let answer = Problem::new(&pair, cycles, Unknown::Gap(exact("5"))).unwrap().answer(20);
        assert_eq!(answer.orbits.len(), 2);
        for orbit in &answer.orbits {
            assert!(holds(&orbit.gap, gap), "{:?}", orbit.gap);
            let there = self::pair("1", gap, "1");
            for residual in residuals(&there, orbit, cycles) {
                assert!(residual.contains(&num_rational::BigRational::from_integer(0.into())), "{residual:?}");
            }
        }
        let refused = Problem::new(&pair, cycles, Unknown::Amplitude(exact("5"))).unwrap_err();
        assert_eq!(refused.key(), Some("cycles"));
    }
}

/// A number of cycles takes long enough to be stopped: what is searched and measured until then stays, the rest is undecided.
#[test]
fn r52_a_search_that_is_stopped_leaves_the_rest_undecided() {
    for restitution in ["0.5", "1"] {
        let problem = Problem::new(&pair("1", "3", restitution), 40, Unknown::Velocity).unwrap();
        let whole = problem.answer(9);
        assert!(whole.is_exhaustive && whole.undecided.is_empty());
        let mut lists = Vec::new();
        for most in [0, 20, 50] {
            let calls = AtomicUsize::new(0);
            let watch = |_: Stage<'_>| proceed_if(calls.fetch_add(1, Ordering::Relaxed) < most);
            let part = problem.answer_within(9, &watch);
            assert!(!part.is_exhaustive && !part.is_complete && !part.undecided.is_empty(), "{most}");
            let spacing = |orbit: &Orbit| orbit.spacing.clone();
            let is_known = |orbit: &Orbit| whole.orbits.iter().any(|other| meets(&spacing(other), &spacing(orbit)));
            assert!(part.orbits.iter().all(is_known));
            // Each motion is listed, or undecided.
            let is_left = |orbit: &Orbit| part.undecided.iter().any(|doubt| meets(doubt, &spacing(orbit)));
            let is_listed = |orbit: &Orbit| part.orbits.iter().any(|other| meets(&spacing(other), &spacing(orbit)));
            assert!(whole.orbits.iter().all(|orbit| is_left(orbit) || is_listed(orbit)), "{most}");
            lists.push(part.orbits.len());
        }
        assert!(lists[0] == 0 && lists[2] > 0 && lists[2] < whole.orbits.len(), "{lists:?} of {}", whole.orbits.len());
    }
}
