//! Periodic orbits through the public API: known ones, and each run again by the certified orbit.

use crate::tolerances::TRACE;
use approx::abs_diff_eq;
use impact_pair::exact::{Enclosure, Exact};
use impact_pair::json::vocabulary::Excludes;
use impact_pair::number::{Ball, LEAST_BITS};
use impact_pair::orbit::{Orbit, Settings, Start};
use impact_pair::periodic::{Budget, Census, Finding, PeriodicOrbit, Precision, Problem, Stability};
use impact_pair::{Harmonic, ImpactPair, Scene};
use proptest::prelude::*;

pub fn value(text: &str) -> Exact {
    text.parse().unwrap()
}

/// A pair of this `A/d` and `e`, in units in which a forcing period takes 1 and the gap is 1.
pub fn pair(ratio: &str, restitution: &str) -> ImpactPair {
    let harmonic = Harmonic::new(value(ratio), value("2*pi"), value("0")).unwrap();
    ImpactPair::new(harmonic, value("1"), value(restitution)).unwrap()
}

/// A start to find guesses from.
pub fn start() -> Start {
    Start::on_wall(value("0"), impact_pair::pair::Wall::Left, value("-1")).unwrap()
}

pub fn problem(pair: &ImpactPair, word: &str, cycles: u32) -> Problem {
    Problem::new(pair, &word.parse().unwrap(), cycles).unwrap()
}

pub fn all(pair: &ImpactPair, word: &str, cycles: u32) -> Census {
    let census = complete(pair, word, cycles);
    assert!(census.is_certified(), "{word} in {cycles} cycles: {census:?}");
    census
}

/// All orbits, whether their stability is decided or not: at `e = 1` that of elliptic ones is not.
pub fn complete(pair: &ImpactPair, word: &str, cycles: u32) -> Census {
    let census = problem(pair, word, cycles).find_all(&start(), Precision::default(), Budget::default());
    assert!(
        census.exhaustive && census.undecided.is_empty(),
        "{word} in {cycles} cycles: {} parts",
        census.undecided.len()
    );
    census
}

pub fn physical(census: Census) -> Vec<PeriodicOrbit> {
    census.orbits.into_iter().filter(|orbit| orbit.physical == Some(true)).collect()
}

fn holds(x: &Enclosure, number: f64, within: f64) -> bool {
    let (low, high) = x.to_f64_bounds();
    low <= number + within && number - within <= high && high - low < within
}

/// `d/A = sqrt(4 + 9 pi^2)` is the widest gap with equispaced orbits of one cycle at `e = 1/2` (the fold of section 3.1); just below
/// it there are two, `10^-9` apart, which enclosures to 5 digits cannot tell apart.
#[test]
fn r17_orbits_next_to_a_fold_are_counted_once() {
    let pair = pair("(1+1e-18)/sqrt(4+9*pi^2)", "0.5");
    let few = Precision { digits: 5, ..Precision::default() };
    let census = problem(&pair, "LR", 1).find(&start(), few);
    let stabilities: Vec<_> = census.orbits.iter().map(|orbit| orbit.stability).collect();
    assert_eq!(stabilities, [Stability::Stable, Stability::Unstable]);
}

/// The first image of a box takes next to nothing off it here, the later ones all.
#[test]
fn r17_a_box_is_narrowed_whatever_its_first_image_takes_off() {
    let census = all(&pair("0.02", "0.8"), "LR", 3);
    let stable: Vec<_> = census.orbits.iter().filter(|orbit| orbit.stability == Stability::Stable).collect();
    let [orbit] = stable[..] else { panic!("one stable orbit") };
    // `two-impact --cycles 3`: 5.36615398045 rad.
    assert!(holds(&orbit.impacts[0].phase, 5.366_153_980_45 / std::f64::consts::TAU, 1e-11));
}

/// Figures 12, 13 and 15: eigenvalues proved elsewhere by Arb (`validation/paper`).
#[test]
fn the_attractors_of_the_figures_are_found_with_their_eigenvalues() {
    let figure_12 = physical(all(&pair("1/9.42497", "0.5"), "LR", 1));
    assert_eq!(figure_12.len(), 2);
    let stable: Vec<_> = figure_12.iter().filter(|orbit| orbit.stability == Stability::Stable).collect();
    let [attractor] = stable[..] else { panic!("one attractor") };
    assert!(holds(&attractor.eigenvalues[0].re, 0.25764, 1e-5) && holds(&attractor.eigenvalues[1].re, 0.24259, 1e-5));
    assert_eq!(attractor.symmetric, Some(true));

    let figure_13 = physical(all(&pair("2/9.42497", "0.5"), "RL", 1));
    let attractor = figure_13.iter().find(|orbit| orbit.stability == Stability::Stable).unwrap();
    assert!(holds(&attractor.eigenvalues[0].re, -0.19127, 1e-5) && holds(&attractor.eigenvalues[0].im, 0.16098, 1e-5));

    let figure_15 = pair("2", "0.8");
    let single = physical(all(&figure_15, "RRLLL", 1));
    let orbit = single.iter().find(|orbit| holds(&orbit.eigenvalues[0].re, -1.0021046, 1e-7)).unwrap();
    assert_eq!((orbit.stability, orbit.symmetric), (Stability::Unstable, Some(false)));
    let double = problem(&figure_15, "RRLLLRRLLL", 2).find(&start(), Precision::default());
    let orbit = double.orbits.iter().find(|orbit| orbit.stability == Stability::Stable).unwrap();
    assert!(holds(&orbit.eigenvalues[0].re, 0.9915971, 1e-7));
    assert_eq!((orbit.physical, orbit.repeats), (Some(true), Some(1)));
    assert_eq!(double.orbits.iter().filter(|orbit| orbit.repeats == Some(2)).count(), 2);
}

/// The exact orbit of figure 12: d = 3 pi, v = -4 pi, eigenvalues 1/4 twice.
#[test]
fn the_exact_orbit_is_enclosed_to_many_digits() {
    let pair = pair("1/(3*pi)", "0.5");
    let orbit = problem(&pair, "LR", 1).prove(&[0.0, 0.5], Precision { digits: 60, max_bits: 4096 }).unwrap();
    assert!(orbit.is_narrow && orbit.bits > 53 && orbit.physical == Some(true) && orbit.symmetric == Some(true));
    let half = num_rational::BigRational::new(1.into(), 2.into());
    assert!(
        (orbit.impacts[1].phase.contains(&half))
            || (orbit.impacts[1].phase.contains(&(half + num_rational::BigRational::from_integer(1.into()))))
    );
    assert!(orbit.impacts[0].phase.wid().to_f64_up() < 1e-60);
    let quarter = num_rational::BigRational::new(1.into(), 4.into());
    assert!(orbit.eigenvalues.iter().all(|value| value.re.contains(&quarter)));
}

/// Stable orbits: those that `validation/paper` names, and a family from R2L3 to R5L5; the word, the cycles, `A/d`, `e`.
#[test]
fn guesses_of_another_length_prove_nothing() {
    let scene = Scene::parse(include_str!("../scenes/figure-12.toml")).unwrap();
    let problem = problem(scene.pair(), "RL", 1);
    for guess in [&[][..], &[0.0], &[0.0, 0.5, 1.0], &[f64::NAN, 0.5], &[f64::INFINITY, 1e300]] {
        assert!(problem.prove(guess, Precision::default()).is_none(), "{guess:?}");
    }
}

#[test]
fn stable_orbits_of_many_words_are_found() {
    for (word, cycles, ratio, restitution) in [
        ("RRLLL", 1, "1.95", "0.8"),
        ("RRRLLL", 1, "3", "0.8"),
        ("RRRLLLL", 1, "3.95", "0.8"),
        ("RRRRLLLL", 1, "5.15", "0.8"),
        ("RRRRLLLLL", 1, "6.165", "0.8"),
        ("RRRRRLLLLL", 1, "7.5", "0.8"),
        ("RRLL", 1, "1/0.619", "0.8"),
        ("LLR", 1, "0.498", "0.8"),
        ("RRL", 1, "0.498", "0.8"),
        ("LRLRLR", 3, "1/2.236", "0.8"),
        ("LR", 2, "1/10.82", "0.5"),
        ("LR", 4, "1/14.21", "0.5"),
        ("LR", 1, "0.51", "0.15"),
        ("LR", 1, "0.46", "0.8"),
        ("LRLR", 2, "0.468", "0.8"),
    ] {
        let pair = pair(ratio, restitution);
        let found = problem(&pair, word, cycles).find(&start(), Precision::default());
        let is_stable = |orbit: &PeriodicOrbit| {
            orbit.stability == Stability::Stable && orbit.physical == Some(true) && orbit.repeats == Some(1)
        };
        assert!(found.is_certified() && found.orbits.iter().any(is_stable), "{word}: {found:?}");
    }
}

/// Lemma T6: the mirror image of a word's orbits are those of the mirrored word, with the same eigenvalues.
#[test]
fn mirrored_words_have_mirrored_orbits() {
    for (ratio, restitution) in [("8/9.42497", "0.5"), ("2", "0.8")] {
        let pair = pair(ratio, restitution);
        for (word, mirrored) in [("LLR", "RRL"), ("LLLR", "RRRL")] {
            for cycles in 1..=3 {
                let traces = |word: &str| {
                    let mut traces: Vec<f64> =
                        physical(all(&pair, word, cycles)).iter().map(|orbit| orbit.trace.mid_rad().0).collect();
                    traces.sort_by(f64::total_cmp);
                    traces
                };
                let (one, other) = (traces(word), traces(mirrored));
                assert_eq!(one.len(), other.len(), "{word} in {cycles}");
                assert!(one.iter().zip(&other).all(|(a, b)| abs_diff_eq!(a, b, epsilon = TRACE * a.abs().max(1.0))));
            }
        }
    }
}

/// (A.7) multiplied over a proved box encloses `e^(2k)`: Lemma T4.
fn determinant_holds(finding: &Finding<Ball>) -> bool {
    let [[a, b], [c, d]] = finding.monodromy;
    let apart = a * d - b * c - finding.determinant;
    apart.mid().abs() <= apart.rad()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]

    /// The equispaced orbit of (66)-(69): found, symmetric, with the closed form's trace and physical
    /// while `sin th0 >= 0`.
    #[test]
    fn equispaced_orbits_have_the_closed_form(angle in -0.2..0.6f64, e in 0.1..0.9f64, odd in 0..3u32) {
        let cycles = 2 * odd + 1;
        let kappa = (1.0 + e) / (1.0 - e);
        let n_pi = std::f64::consts::PI * f64::from(cycles);
        let gap = 2.0 * angle.sin() + n_pi * kappa * angle.cos();
        let pair = pair(&format!("1/{gap:.15}"), &format!("{e:.15}"));
        let problem = problem(&pair, "LR", cycles);
        let first = angle / std::f64::consts::TAU + 1.0;
        let guess = [first, first + 0.5 * f64::from(cycles)];
        let half = 2.0 * e + (1.0 - e * e) * (n_pi / 2.0) * angle.tan();
        let trace = half * half - 2.0 * e * e;
        // A double root at the fold has no proof.
        prop_assume!((trace - 1.0 - e.powi(4)).abs() > 1e-3);
        let orbit = problem.prove(&guess, Precision::default()).unwrap();
        prop_assert_eq!(orbit.symmetric, Some(true));
        prop_assert!(holds(&orbit.trace, trace, 1e-6 * trace.abs().max(1.0)), "{} {:?}", trace, orbit.trace.to_f64_bounds());
        if angle >= 1e-6 {
            prop_assert_eq!(orbit.physical, Some(true));
        }
        let finding = problem.prove_in_doubles(&guess);
        prop_assert!(finding.is_none_or(|finding| determinant_holds(&finding)));
    }

    /// More digits give a part of the same box, and the same verdicts.
    #[test]
    fn more_digits_narrow(ratio in 0.2..3.0f64, cycles in 1..3u32, word in prop::sample::select(vec!["LR", "LLR", "LLRR"])) {
        let pair = pair(&format!("{ratio:.6}"), "0.8");
        let problem = problem(&pair, word, cycles);
        let coarse = problem.find(&start(), Precision::default());
        for orbit in coarse.orbits {
            let guess: Vec<f64> = orbit.phases().iter().map(|phase| phase.mid()).collect();
            let fine = problem.prove(&guess, Precision { digits: 25, max_bits: 1 << 12 }).unwrap();
            prop_assert!(fine.is_narrow && fine.bits >= LEAST_BITS);
            for (a, b) in fine.impacts.iter().zip(&orbit.impacts) {
                prop_assert!(a.phase.intersection(&b.phase).is_some() && a.velocity.intersection(&b.velocity).is_some());
            }
            prop_assert!(orbit.physical.is_none() || fine.physical == orbit.physical);
            prop_assert!(orbit.stability == Stability::Undecided || fine.stability == orbit.stability);
        }
    }
}

/// `A/d = 0.9`, `e = 0`: from a release the ball goes to the other wall, rests there, and so on, P1 P2 in one cycle for ever (Lemma Z3). The equations
/// of a chain, of flights without rests (T1, W1), do not have it: of such motions nothing is claimed (T12).
#[test]
fn r32_what_rests_is_excluded_from_what_is_proved_to_be_all() {
    use impact_pair::orbit::{Outcome, Progress};
    use impact_pair::pair::Wall;
    use impact_pair::two_impact::{Problem, Unknown};
    use impact_pair::units::Units;

    let pair = pair("0.9", "0");
    let start = Start::on_wall(value("0"), Wall::Left, value("0")).unwrap();
    let settings = Settings { impacts: Some(12), ..Settings::default() };
    let scene = "excitation = { amplitude = 0.9, frequency = \"2*pi\", phase = 0 }\n\
                 pair = { gap = 1, restitution = 0 }\nstart = { time = 0, wall = \"left\", velocity = 0 }";
    let mut orbit = Orbit::of(&Scene::parse(scene).unwrap(), settings).unwrap();
    let (mut walls, mut rests) = (Vec::new(), 0);
    loop {
        match orbit.advance() {
            Progress::Ended => break,
            Progress::Impact(impact) => walls.push(impact.wall),
            Progress::Rest(_) => rests += 1,
            _ => {}
        }
    }
    assert!(walls.windows(2).all(|pair| pair[0] != pair[1]) && rests >= 2, "{walls:?}, {rests}");
    assert!(matches!(orbit.outcome(), Some(Outcome::Periodic(_))), "{:?}", orbit.outcome());
    let problem = problem(&pair, "LR", 1);
    let census = problem.find_all(&start, Precision::default(), Budget::default());
    let document = Units::gaps(&pair).unwrap().document(&problem, &start, &census);
    assert!(document.exhaustive && document.orbits.iter().all(|orbit| orbit.physical != Some(true)));
    assert_eq!(document.excludes, Some(Excludes::Resting));
    let answer = Problem::new(&pair, 1, Unknown::Velocity).unwrap().answer(9);
    let document = answer.document(&start, Wall::Left);
    assert!(document.exhaustive && document.orbits.iter().all(|orbit| orbit.physical != Some(true)));
    assert_eq!(document.excludes, Some(Excludes::Resting));
    // A search that is not for all has nothing to exclude.
    let some = Units::gaps(&pair).unwrap().document(&problem, &start, &problem.find(&start, Precision::default()));
    assert_eq!((some.exhaustive, some.excludes), (false, None));
}

/// Lemma T14: for `e = 0` at `d = pi A` the ball leaves its walls at the phases 0 and 1/2, exactly as the contact force ends; beside it, at a gap
/// that is smaller however little, it rests there.
#[test]
fn r62_an_orbit_that_leaves_as_the_contact_force_ends_is_admissible() {
    for (gap, is_admissible) in [("pi", Some(true)), ("pi - 1e-12", Some(false)), ("pi + 1e-12", Some(true))] {
        let harmonic = Harmonic::new(value("1"), value("1"), value("0")).unwrap();
        let pair = ImpactPair::new(harmonic, value(gap), value("0")).unwrap();
        let problem = Problem::new(&pair, &"RL".parse().unwrap(), 1).unwrap();
        let orbit = problem.prove(&[0.5, 1.0], Precision::default()).unwrap();
        assert_eq!((orbit.physical, orbit.stability), (is_admissible, Stability::Stable), "{gap}");
        let census = problem.find_all(&start(), Precision::default(), Budget { boxes: 20_000, ..Budget::default() });
        assert!(census.is_certified(), "{gap}: {:?}", census.undecided);
    }
}
