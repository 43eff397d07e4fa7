//! Searches for all periodic orbits of a word through the public API: what they find, and that nothing else is there.

use crate::periodic::{all, complete, pair, physical, problem};
use impact_pair::periodic::newton::{is_plausible, polish};
use impact_pair::periodic::{Chain, Precision, Stability};

/// Lemma T4: at `e = 1` doubles prove an orbit elliptic, and no more bits are requested.
#[test]
fn elliptic_orbits_take_no_more_bits() {
    let orbits = complete(&pair("0.1", "1"), "RLRLRL", 3).orbits;
    let (elliptic, rest): (Vec<_>, Vec<_>) = orbits.iter().partition(|orbit| orbit.stability == Stability::Elliptic);
    assert_eq!((elliptic.len(), rest.len()), (1, 5));
    assert_eq!(elliptic[0].bits, f64::MANTISSA_DIGITS);
    assert!(rest.iter().all(|orbit| orbit.stability == Stability::Unstable));
}

/// Words of up to four impacts and three cycles at the parameters of figures 12-15: all orbits, none undecided.
#[test]
fn all_orbits_of_short_words_are_known_at_the_figures() {
    for (ratio, restitution) in [("2/9.42497", "0.5"), ("8/9.42497", "0.5"), ("2", "0.8")] {
        let pair = pair(ratio, restitution);
        for word in ["LR", "LLR", "LRR", "LLRR", "LRLR", "LRRR"] {
            for cycles in 1..=3 {
                all(&pair, word, cycles);
            }
        }
        for word in ["R", "LL", "RRR", "LLLL"] {
            assert!(all(&pair, word, 1).orbits.is_empty());
        }
    }
}

/// At `e = 1`: a long word that a search box by box does not end on.
#[test]
fn r17_a_search_of_a_long_word_is_complete() {
    are_complete(&[("RLRLRL", 3, "0.36", "1", 10)]);
}

/// Another one at `e = 1`, figure 15 doubled, and the cascade.
#[test]
#[ignore = "deep: words of up to 12 impacts; by default r17_a_search_of_a_long_word_is_complete"]
fn r17_searches_of_long_words_are_complete() {
    are_complete(&[
        ("RLRLRL", 1, "0.36", "1", 2),
        ("RRLLLRRLLL", 2, "2", "0.8", 3),
        ("LRLRLLRLRLRR", 5, "0.36", "0.8", 0),
    ]);
}

#[test]
#[ignore = "deep: words of 10 impacts at three pairs; by default r17_a_search_of_a_long_word_is_complete"]
fn r17_searches_of_words_of_ten_impacts_are_complete() {
    are_complete(&[
        ("LRLRLLRLRR", 5, "0.36", "0.8", 0),
        ("LRLRLLRLRR", 5, "8/9.42497", "0.5", 0),
        ("LRLRLLRLRR", 5, "2", "0.8", 0),
    ]);
}

/// Words, cycles, A/d, e, and how many orbits the complete search finds.
fn are_complete(words: &[(&str, u32, &str, &str, usize)]) {
    for &(word, cycles, ratio, restitution, motions) in words {
        let found = physical(complete(&pair(ratio, restitution), word, cycles));
        assert_eq!(found.len(), motions, "{word} in {cycles} at {ratio}, {restitution}");
    }
}

/// Whether two lists of phases are one motion, listed from different impacts.
fn is_one_motion(chain: &Chain, one: &[f64], other: &[f64]) -> bool {
    let count = one.len();
    let at = |i: usize| one[i % count] + if i < count { 0.0 } else { f64::from(chain.cycles()) };
    (0..count).any(|shift| {
        let turns = (at(shift) - other[0]).round();
        let is_near = |i: usize| (at(i + shift) - turns - other[i]).abs() < 1e-6;
        (0..count).all(|i| chain.walls()[(i + shift) % count] == chain.walls()[i] && is_near(i))
    })
}

/// A search lists each motion that Newton's iteration in floats comes to from thousands of phases spread without a plan, once.
#[test]
fn searches_miss_nothing_that_newton_finds() {
    let mut state = 17_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    for (word, cycles, ratio, restitution) in [
        ("LR", 3, "1/9.42497", "0.5"),
        ("LRLR", 2, "0.36", "0.8"),
        ("LLRR", 1, "2", "0.8"),
        ("LLRLR", 2, "0.498", "0.8"),
        ("LRLRLR", 3, "0.36", "1"),
        ("RRLLL", 1, "2", "0.8"),
    ] {
        let pair = pair(ratio, restitution);
        let problem = problem(&pair, word, cycles);
        let chain = problem.chain();
        let known: Vec<Vec<f64>> = physical(complete(&pair, word, cycles))
            .iter()
            .map(|orbit| orbit.phases().iter().map(|phase| phase.mid()).collect())
            .collect();
        let is_repeated = |i: usize| known[..i].iter().any(|other| is_one_motion(chain, &known[i], other));
        assert!(!(0..known.len()).any(is_repeated), "{word}");
        let floats = problem.reduced().unwrap().centre();
        let mut tried: Vec<Vec<f64>> = Vec::new();
        for _ in 0..2_000 {
            let mut phases: Vec<f64> = (0..chain.impacts()).map(|_| f64::from(cycles) * random()).collect();
            phases.sort_by(f64::total_cmp);
            let Some(phases) = polish(chain, &floats, phases).filter(|phases| is_plausible(chain, &floats, phases))
            else {
                continue;
            };
            if known.iter().chain(&tried).any(|other| is_one_motion(chain, &phases, other)) {
                continue;
            }
            // A zero that is in no list: it belongs to no motion.
            let orbit = problem.prove(&phases, Precision::default());
            assert!(orbit.is_none_or(|orbit| orbit.physical == Some(false)), "{word} at {phases:?}");
            tried.push(phases);
        }
    }
}
