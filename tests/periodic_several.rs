//! Periodic orbits under several harmonics, Lemmas H10-H12: against one harmonic in two terms, against certified runs.

use crate::periodic::{all, physical, problem, start, value};
use crate::tolerances::{PHASE, TRACE};
use approx::abs_diff_eq;
use impact_pair::exact::{Dyadic, Enclosure, Exact};
use impact_pair::orbit::{Arithmetic, Orbit, Outcome, Settings, Start};
use impact_pair::pair::Wall;
use impact_pair::periodic::{Budget, PeriodicOrbit, Precision, Problem, Stability};
use impact_pair::{Excitation, Harmonic, ImpactPair};
use num_rational::BigRational;
use num_traits::ToPrimitive;

/// A pair with a gap of 1 and harmonics with the given amplitudes, frequencies and phases.
fn pair(terms: &[(&str, &str, &str)], restitution: &str) -> ImpactPair {
    let term = |&(a, w, tau): &(&str, &str, &str)| Harmonic::new(value(a), value(w), value(tau)).unwrap();
    let excitation = Excitation::new(terms.iter().map(term).collect()).unwrap();
    ImpactPair::new(excitation, value("1"), value(restitution)).unwrap()
}

/// The phases of an orbit in doubles.
fn middles(orbit: &PeriodicOrbit) -> Vec<f64> {
    orbit.phases().iter().map(|phase| phase.mid()).collect()
}

/// Pairs whose fastest harmonic has `W = 2 pi` and `tau = 0`, so that phases are times, a word, and cycles: two odd
/// harmonics, two that are not, three in a square wave, and hops of every length.
fn questions() -> Vec<(ImpactPair, &'static str, u32)> {
    vec![
        (pair(&[("1/9.42497", "2*pi/3", "0"), ("0.5/9.42497", "2*pi", "0")], "0.5"), "LR", 3),
        (pair(&[("0.1", "pi", "0.3"), ("1/10", "2*pi", "0")], "0.5"), "LR", 2),
        (pair(&[("1/5", "2*pi/5", "0"), ("1/15", "6*pi/5", "1"), ("1/25", "2*pi", "0")], "0.6"), "LR", 5),
        (pair(&[("1/100", "pi", "0"), ("2", "2*pi", "0")], "0.8"), "RRLLLRRLLL", 2),
    ]
}

/// The same of one harmonic.
fn of_one_harmonic() -> impl Iterator<Item = (ImpactPair, &'static str, u32)> {
    let known = [
        ("LR", 1, "1/9.42497", "0.5"),
        ("LR", 3, "2/9.42497", "0.5"),
        ("LLR", 1, "8/9.42497", "0.5"),
        ("RRLL", 1, "2", "0.8"),
        ("RRLLL", 1, "2", "0.8"),
        ("LLR", 1, "0.498", "0.8"),
        ("RRRRRLLLLL", 1, "7.5", "0.8"),
    ];
    known.into_iter().map(|(word, cycles, ratio, e)| (pair(&[(ratio, "2*pi", "0")], e), word, cycles))
}

/// The admissible orbits found for all of them, to `digits` decimal digits.
fn motions(digits: u32) -> Vec<(ImpactPair, Problem, PeriodicOrbit)> {
    let mut motions = Vec::new();
    for (pair, word, cycles) in questions().into_iter().chain(of_one_harmonic()) {
        let problem = problem(&pair, word, cycles);
        let census = problem.find(&start(), Precision { digits, max_bits: 1 << 14 });
        let before = motions.len();
        let physical = census.orbits.into_iter().filter(|orbit| orbit.physical == Some(true));
        motions.extend(physical.map(|orbit| (pair.clone(), problem.clone(), orbit)));
        assert!(motions.len() > before, "{word} in {cycles}");
    }
    motions
}

/// `A sin(W t + tau + pi/3) + A sin(W t + tau - pi/3) = A sin(W t + tau)`.
#[test]
fn one_harmonic_in_two_terms_has_the_same_orbits() {
    for (word, cycles, ratio, restitution) in [
        ("LR", 1, "1/9.42497", "0.5"),
        ("LR", 3, "2/9.42497", "0.5"),
        ("LLR", 1, "8/9.42497", "0.5"),
        ("LLR", 1, "0.498", "0.8"),
        ("RRLLL", 1, "2", "0.8"),
        ("RRRRRLLLLL", 1, "7.5", "0.8"),
    ] {
        let one = pair(&[(ratio, "2*pi", "0")], restitution);
        let two = pair(&[(ratio, "2*pi", "pi/3"), (ratio, "2*pi", "-pi/3")], restitution);
        let precision = Precision { digits: 30, max_bits: 4096 };
        let orbits = problem(&one, word, cycles).find(&start(), precision).orbits;
        assert!(!orbits.is_empty(), "{word}");
        let other = problem(&two, word, cycles);
        assert_eq!(other.period(), 1);
        for orbit in orbits {
            // Phases are those of the first term, a sixth of a forcing period ahead.
            let guess: Vec<f64> = middles(&orbit).iter().map(|phase| phase + 1.0 / 6.0).collect();
            let same = other.prove(&guess, precision).expect("proved");
            assert_eq!((same.stability, same.physical), (orbit.stability, orbit.physical), "{word}");
            assert_eq!(
                (same.symmetric, same.repeats, same.is_narrow),
                (orbit.symmetric, orbit.repeats, true),
                "{word}"
            );
            let meet =
                |a: &Enclosure, b: &Enclosure| assert!(a.intersection(b).is_some(), "{word}: {orbit:?} {same:?}");
            meet(&orbit.trace, &same.trace);
            for (a, b) in orbit.eigenvalues.iter().zip(&same.eigenvalues) {
                meet(&a.re, &b.re);
                meet(&a.im, &b.im);
            }
            let sixth = BigRational::new(1.into(), 6.into());
            for (a, b) in orbit.impacts.iter().zip(&same.impacts) {
                meet(&a.velocity, &b.velocity);
                let later = a.phase.add(&Enclosure::from_rational(&sixth, 512), 512);
                let turns = (b.phase.mid_rad().0 - later.mid_rad().0).round();
                meet(&later.add(&Enclosure::from_f64_bounds(turns, turns).unwrap(), 512), &b.phase);
            }
        }
    }
}

/// The same sum, searched: as many orbits as under one harmonic.
#[test]
fn a_search_counts_the_orbits_of_one_harmonic_in_two_terms() {
    for (word, cycles, ratio, restitution) in [
        ("LR", 1, "1/9.42497", "0.5"),
        ("LR", 3, "2/9.42497", "0.5"),
        ("LLR", 1, "8/9.42497", "0.5"),
        ("RRLLL", 1, "2", "0.8"),
    ] {
        let one = pair(&[(ratio, "2*pi", "0")], restitution);
        let two = pair(&[(ratio, "2*pi", "pi/3"), (ratio, "2*pi", "-pi/3")], restitution);
        let counts = [one, two].map(|pair| physical(all(&pair, word, cycles)).len());
        assert!(counts[0] == counts[1] && counts[0] > 0, "{word} in {cycles}: {counts:?}");
    }
}

/// A weak harmonic changes no orbit by much, but determines in which forcing period of the common period an orbit begins. None of the
/// orbits of one harmonic is at a bifurcation: each continues as one orbit for each forcing period of the common period.
#[test]
fn a_search_counts_the_orbits_of_one_harmonic_in_each_period_under_a_faint_slower_one() {
    for (word, ratio, restitution, slow, turns) in [
        ("LR", "1/9.42497", "0.5", "2*pi/3", 3),
        ("LLR", "1/9.42497", "0.5", "4*pi/3", 3),
        ("LRLR", "0.36", "0.8", "pi", 2),
    ] {
        let one = physical(all(&pair(&[(ratio, "2*pi", "0")], restitution), word, turns));
        let expected: usize = one.iter().map(|orbit| turns as usize / orbit.repeats.expect("told")).sum();
        let faint = pair(&[("1e-6", slow, "0.3"), (ratio, "2*pi", "0")], restitution);
        let found = physical(all(&faint, word, turns)).len();
        assert!(found == expected && found > 0, "{word}: {found} for {expected} of {}", one.len());
    }
}

/// No motion that guesses lead to is missed, and what the search lists beside them is one.
#[test]
fn a_search_holds_what_guesses_lead_to() {
    for (pair, word, cycles) in questions().into_iter().take(3) {
        let guessed = physical(problem(&pair, word, cycles).find(&start(), Precision::default())).len();
        assert!(physical(all(&pair, word, cycles)).len() >= guessed && guessed > 0, "{word} in {cycles}");
    }
}

/// A certified run from the given state: times and velocities of `count` impacts.
fn run(pair: &ImpactPair, wall: Wall, [time, velocity]: [Exact; 2], count: usize) -> Vec<(Wall, Enclosure, Enclosure)> {
    let start = Start::on_wall(time, wall, velocity).unwrap();
    let settings = Settings { impacts: Some(count as u64), arithmetic: Arithmetic::Bits(1024), ..Settings::default() };
    let mut orbit = Orbit::new(pair, &start, settings).unwrap();
    let mut impacts = Vec::new();
    while let Some(impact) = orbit.next() {
        let (time, velocity) = orbit.bounds(&impact);
        impacts.push((impact.wall, time, velocity));
    }
    assert_eq!(impacts.len(), count, "from {start:?}: {:?}", orbit.outcome());
    impacts
}

#[test]
fn certified_runs_from_a_proved_box_stay_at_the_orbit() {
    for (pair, problem, orbit) in motions(150) {
        assert!(orbit.is_narrow);
        let interval = |x: &Enclosure| {
            let end = |x: &Dyadic| Exact::from_rational(x.to_rational());
            Exact::interval(&end(x.inf()), &end(x.sup())).unwrap()
        };
        let (first, count) = (&orbit.impacts[0], orbit.impacts.len());
        let impacts = run(&pair, first.wall, [interval(&first.phase), interval(&first.velocity)], 6 * count);
        for (i, (wall, time, velocity)) in impacts.iter().enumerate() {
            let at = &orbit.impacts[(i + 1) % count];
            let rounds = f64::from(problem.chain().cycles()) * ((i + 1) / count) as f64;
            let time = time.sub(&Enclosure::from_f64_bounds(rounds, rounds).unwrap(), 2048);
            assert_eq!(*wall, at.wall, "impact {i}");
            assert!(time.intersection(&at.phase).is_some(), "impact {i}: {time:?} {:?}", at.phase);
            assert!(velocity.intersection(&at.velocity).is_some(), "impact {i}");
        }
    }
}

/// Trace and determinant by central differences of certified runs of one period from rational states in the box; Lemma T4 and Vieta.
#[test]
fn trace_and_determinant_agree_with_differences_of_runs() {
    let step = BigRational::new(1.into(), num_bigint::BigInt::from(1) << 100);
    let middle = |x: &Enclosure| (x.inf().to_rational() + x.sup().to_rational()) / BigRational::from_integer(2.into());
    for (pair, _, orbit) in motions(60) {
        let first = &orbit.impacts[0];
        let state = [middle(&first.phase), middle(&first.velocity)];
        let after = |which: usize, by: &BigRational| {
            let mut state = state.clone();
            state[which] += by;
            let (_, time, velocity) =
                run(&pair, first.wall, state.map(Exact::from_rational), orbit.impacts.len()).pop().unwrap();
            [middle(&time), middle(&velocity)]
        };
        let column = |which: usize| {
            let (up, down) = (after(which, &step), after(which, &-step.clone()));
            [0, 1].map(|row: usize| ((&up[row] - &down[row]) / (&step + &step)).to_f64().unwrap())
        };
        let [[a, c], [b, d]] = [column(0), column(1)];
        let (low, high) = orbit.trace.to_f64_bounds();
        let size = 1e-10 * (a.abs() + d.abs());
        assert!(low - size <= a + d && a + d <= high + size, "{} {orbit:?}", a + d);
        let (low, high) = orbit.determinant.to_f64_bounds();
        let size = 1e-10 * ((a * d).abs() + (b * c).abs());
        assert!(low - size <= a * d - b * c && a * d - b * c <= high + size, "{}", a * d - b * c);
        let meet = |x: &Enclosure, y: &Enclosure| assert!(x.intersection(y).is_some(), "{x:?} {y:?} {orbit:?}");
        let power = pair.restitution().enclose(256).powi(2 * orbit.impacts.len() as i32, 256).unwrap();
        meet(&orbit.determinant, &power);
        let [one, other] = &orbit.eigenvalues;
        meet(&one.re.add(&other.re, 256), &orbit.trace);
        meet(&one.im.add(&other.im, 256), &Exact::from(0).enclose(256));
        meet(&one.re.mul(&other.re, 256).sub(&one.im.mul(&other.im, 256), 256), &orbit.determinant);
    }
}

/// An orbit run through twice is one of the doubled word, its trace `t^2 - 2 det`.
#[test]
fn an_orbit_of_a_word_is_found_in_the_word_run_through_twice() {
    for (pair, word, cycles) in questions().into_iter().take(3) {
        let once = problem(&pair, word, cycles).find(&start(), Precision::default()).orbits;
        let twice = problem(&pair, &word.repeat(2), 2 * cycles);
        for orbit in once {
            let phases = middles(&orbit);
            let later = phases.iter().map(|phase| phase + f64::from(cycles));
            let doubled = twice.prove(&phases.iter().copied().chain(later).collect::<Vec<_>>(), Precision::default());
            let doubled = doubled.expect("proved");
            let half = [orbit.trace.mid_rad().0, orbit.determinant.mid_rad().0];
            let trace = half[0] * half[0] - 2.0 * half[1];
            assert_eq!((orbit.repeats, doubled.repeats), (Some(1), Some(2)));
            assert!(
                abs_diff_eq!(doubled.trace.mid_rad().0, trace, epsilon = TRACE * trace.abs().max(1.0)),
                "{trace} {doubled:?}"
            );
            assert_eq!((doubled.physical, doubled.symmetric), (orbit.physical, orbit.symmetric));
        }
    }
}

/// Half a common period later odd harmonics are their own opposites, so mirror images are orbits too; others have none.
#[test]
fn mirror_images_are_orbits_where_the_harmonics_are_odd() {
    let [odd, even] = [0, 1].map(|i: usize| {
        let (pair, word, cycles) = questions().swap_remove(i);
        problem(&pair, word, cycles).find(&start(), Precision::default()).orbits
    });
    let mut traces: Vec<f64> =
        odd.iter().filter(|orbit| orbit.symmetric == Some(false)).map(|orbit| orbit.trace.mid_rad().0).collect();
    traces.sort_by(f64::total_cmp);
    assert!(!traces.is_empty() && odd.iter().any(|orbit| orbit.symmetric == Some(true)));
    assert!(
        traces.chunks(2).all(|pair| pair.len() == 2 && abs_diff_eq!(pair[0], pair[1], epsilon = TRACE)),
        "{traces:?}"
    );
    assert!(even.iter().all(|orbit| orbit.symmetric == Some(false)));
}

/// Lemma Q3, in whichever forcing period of the common period the run starts: far away in time as well.
#[test]
fn runs_are_proved_to_converge_to_a_stable_orbit() {
    let (pair, word, cycles) = questions().swap_remove(0);
    let orbits = problem(&pair, word, cycles).find(&start(), Precision::default()).orbits;
    let stable: Vec<_> = orbits.iter().filter(|orbit| orbit.stability == Stability::Stable).collect();
    assert!(!stable.is_empty());
    for orbit in stable {
        let first = &orbit.impacts[0];
        for periods in ["0", "3*10^6", "-3*10^6"] {
            let near = |x: f64, by: &str| value(&format!("{x:.5} + ({by})"));
            let (phase, velocity) = (first.phase.mid_rad().0, first.velocity.mid_rad().0);
            let start = Start::on_wall(near(phase, periods), first.wall, near(velocity, "0")).unwrap();
            let settings = Settings { impacts: Some(100), attractor: true, ..Settings::default() };
            let mut run = Orbit::new(&pair, &start, settings).unwrap();
            assert_eq!(run.by_ref().count(), 100);
            let Some(Outcome::Attracted(attractor)) = run.outcome() else { panic!("{:?}", run.outcome()) };
            assert_eq!(attractor.cycles, cycles);
            let wall = |impact: &&impact_pair::periodic::PeriodicImpact| impact.wall == first.wall;
            let same = attractor.orbit.impacts.iter().find(wall).unwrap();
            let turns = same.phase.mid_rad().0 - first.phase.mid_rad().0;
            assert!(
                abs_diff_eq!(turns, 3.0 * (turns / 3.0).round(), epsilon = PHASE)
                    && same.velocity.intersection(&first.velocity).is_some()
            );
        }
    }
}

#[test]
fn cycles_without_a_common_period_are_an_error() {
    let word = &"LR".parse().unwrap();
    let three = pair(&[("1", "pi", "0"), ("1/3", "3*pi", "0")], "0.5");
    let message = Problem::new(&three, word, 4).unwrap_err().to_string();
    assert!(message.contains("the number of cycles is 4") && message.contains("multiple of 3"), "{message}");
    for frequency in ["sqrt(2)*pi", "[3.1, 3.2]"] {
        let never = pair(&[("1", "pi", "0"), ("1/3", frequency, "0")], "0.5");
        let error = Problem::new(&never, word, 1).unwrap_err();
        assert_eq!(error.key(), Some("excitation.frequency"));
        assert!(error.to_string().contains(frequency), "{error}");
    }
    // Lemma T7 holds whatever the shaking.
    assert!(problem(&three, "R", 3).find_all(&start(), Precision::default(), Budget::default()).exhaustive);
}
