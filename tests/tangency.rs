//! Homoclinic tangencies beside figure 14, against constants of an independent computation in balls (single shooting in 130 digits).

use std::sync::atomic::{AtomicU64, Ordering};

use impact_pair::exact::Exact;
use impact_pair::periodic::Precision;
use impact_pair::tangency::{FlightWord, Tangencies, TangencySettings};
use impact_pair::watch::{Stage, Unwatched, proceed_if};
use impact_pair::{Effort, Scene};

use crate::setup::{changed, scene};

const FIRST: &str = "FFFFFFFNFFFFFNFFNFFNFFFF";
const SECOND: &str = "FFFFFFNFFFFNFFFFFNFFNFFNFFFF";

fn figure_14() -> Scene {
    scene("figure-14")
}

fn settings(over: &str, word: &str, digits: u32) -> TangencySettings {
    let word = Some(word.parse().unwrap());
    let precision = Precision { digits, ..Precision::default() };
    let effort = Effort::default();
    TangencySettings { over: over.parse().unwrap(), word, longest: 10, most: 3, effort, precision }
}

fn found(over: &str, word: &str, digits: u32) -> Tangencies {
    Tangencies::of(&figure_14(), &settings(over, word, digits), &Unwatched).unwrap()
}

/// Whether bounds contain a number of at least 30 digits, up to a unit of the number's 28th decimal place.
fn holds(bounds: &impact_pair::exact::Enclosure, number: &str) -> bool {
    let number = Exact::parse(number).unwrap().enclose(400);
    let places = 28;
    let last = Exact::parse(&format!("1e-{places}")).unwrap().enclose(400);
    bounds.intersection(&number.add(&last, 400).hull(&number.sub(&last, 400))).is_some()
}

#[test]
fn both_tangencies_of_figure_14_are_proved_to_30_digits() {
    let first = found("gap=9.4249..9.4252", FIRST, 30);
    assert!(first.is_certified() && first.tangencies.len() == 1);
    let tangency = &first.tangencies[0];
    assert!(tangency.parameter.wid().to_f64_up() < 1e-29);
    assert!(holds(&tangency.parameter, "8*1.178140797110900618553998549943430006567797667450"));
    assert!(holds(&tangency.unstable, "0.001036717798769376714535248642529318"));
    assert!(holds(&tangency.stable, "0.0001081798474817610146903775763677"));
    assert!(holds(&tangency.eigenvalues[0], "-2.31243652792056483240174683106"));
    assert!((tangency.quadratic.mid_rad().0 + 1_158_440_084.207).abs() < 1e-2);
    assert!((tangency.unfolding.mid_rad().0 + 806.163_64).abs() < 1e-4);
    assert!((0.3528..0.352_828).contains(&tangency.least_speed) && (1.085..1.085_2).contains(&tangency.least_flight));
    assert_eq!(tangency.resonances_excluded_to, 100);
    // Two common points below, none above, to within a millionth of the tangency; the boxes hold its states.
    let beside = tangency.beside.as_ref().unwrap();
    assert!(beside.two.sup() < tangency.parameter.inf() && tangency.parameter.sup() < beside.none.inf());
    assert!(beside.two.inf().to_f64_up() < 9.425_123_1 && beside.none.sup().to_f64_up() > 9.425_29);
    assert!(beside.states.len() == 23 && beside.states.iter().flatten().all(|x| x.wid().to_f64_up() < 2e-3));
    let second = found("gap=9.4245..9.4246", SECOND, 30);
    assert!(second.is_certified() && second.tangencies.len() == 1);
    assert!((second.tangencies[0].parameter.mid_rad().0 - 9.424_516_177_410_88).abs() < 1e-14);
}

/// `D = d/A` alone matters.
#[test]
fn over_the_amplitude_the_ratio_is_the_same() {
    let found = found("amplitude=7.999..8.001", FIRST, 9);
    let [gap, amplitude] = [9.42497, found.tangencies[0].parameter.mid_rad().0];
    assert!((gap / amplitude - 1.178_140_797_110_900_6).abs() < 1e-14);
}

/// At the gap of the tangency for e = 1/2 the restitution of the tangency is 1/2.
#[test]
fn over_the_restitution_the_tangency_is_the_same() {
    let gap = "gap = \"8*1.17814079711090061855399854994343000656779766745018\"";
    let found = Tangencies::of(
        &changed("figure-14", ["gap = 9.42497", gap]),
        &settings("restitution=0.4999..0.5001", FIRST, 30),
        &Unwatched,
    )
    .unwrap();
    assert!(found.is_certified() && holds(&found.tangencies[0].parameter, "1/2"));
    assert!(holds(&found.tangencies[0].unstable, "0.001036717798769376714535248642529318"));
    assert!((found.tangencies[0].quadratic.mid_rad().0 + 1_158_440_084.207).abs() < 1e-2);
}

/// For each e in 1/2 +- 1e-5: the bounds hold the tangency, its saddle and its coefficients for members.
#[test]
fn a_family_over_an_interval_of_the_restitution_is_proved() {
    let of = |e: &str| {
        Tangencies::of(&changed("figure-14", ["= 0.5", e]), &settings("gap=9.425..9.4253", FIRST, 9), &Unwatched)
            .unwrap()
    };
    let family = of("= \"[0.49999, 0.50001]\"");
    assert!(family.is_certified());
    let family = &family.tangencies[0];
    assert!(family.parameter.wid().to_f64_up() < 4e-5 && family.states.as_ref().is_some_and(|all| all.len() == 23));
    let member = of("= 0.500009");
    let member = &member.tangencies[0];
    let pairs = [
        (&family.parameter, &member.parameter),
        (&family.unstable, &member.unstable),
        (&family.stable, &member.stable),
        (&family.phase, &member.phase),
        (&family.speed, &member.speed),
        (&family.eigenvalues[0], &member.eigenvalues[0]),
        (&family.quadratic, &member.quadratic),
        (&family.unfolding, &member.unfolding),
    ];
    assert!(pairs.iter().all(|(all, one)| all.contains_enclosure(one)));
    assert!(family.least_speed <= member.least_speed && member.states.is_none());
    // An interval so wide that nothing is proved of it.
    assert!(of("= \"[0.4999, 0.5001]\"").tangencies.is_empty());
}

/// Of another word, and in a range without one, nothing is claimed.
#[test]
fn nothing_is_claimed_where_there_is_none() {
    for (over, word) in [("gap=9.4249..9.4252", "FFFFFFFNFFFFFNFFNFFNFFFN"), ("gap=9.4249..9.4251", FIRST)] {
        let found = found(over, word, 9);
        assert!(found.tangencies.is_empty() && !found.is_certified(), "{over} {word}");
    }
    // Figure 12: the equispaced motion is stable.
    let found = Tangencies::of(&scene("figure-12"), &settings("gap=9.4..9.5", FIRST, 9), &Unwatched).unwrap();
    assert!(found.tangencies.is_empty());
}

#[test]
fn errors_name_the_accepted_values() {
    let error_of = |scene: &Scene, over: &str| {
        Tangencies::of(scene, &settings(over, FIRST, 9), &Unwatched).unwrap_err().to_string()
    };
    let wide = changed("figure-14", ["amplitude = 8", "amplitude = \"[7, 8]\""]);
    assert!(error_of(&wide, "gap=9.4..9.5").contains("accepted is a single number"));
    assert!(error_of(&figure_14(), "frequency=1..4").contains("KEY one of gap, amplitude, restitution"));
    for e in ["= 0", "= 1"] {
        let found =
            Tangencies::of(&changed("figure-14", ["= 0.5", e]), &settings("gap=9.4..9.5", FIRST, 9), &Unwatched)
                .unwrap();
        assert!(found.tangencies.is_empty() && !found.is_certified());
    }
    assert!("FFX".parse::<FlightWord>().unwrap_err().to_string().contains("letters F"));
    assert!("".parse::<FlightWord>().is_err() && "F".repeat(201).parse::<FlightWord>().is_err());
}

/// Stopped at once, it says so.
#[test]
fn an_interrupted_search_is_not_certified() {
    let found =
        Tangencies::of(&figure_14(), &settings("gap=9.4249..9.4252", FIRST, 9), &|_: Stage<'_>| proceed_if(false))
            .unwrap();
    assert!(found.interrupted && found.tangencies.is_empty() && !found.is_certified());
}

/// A search over all words consults the watch at each of its pieces and folds.
#[test]
fn r48_a_search_over_all_words_can_be_stopped_at_once() {
    let all = TangencySettings { word: None, longest: 10, ..settings("gap=9.4244..9.4254", FIRST, 9) };
    let until = |stops: fn(&Stage<'_>) -> bool| {
        let pieces = AtomicU64::new(0);
        let watch = |at: Stage<'_>| {
            if let Stage::Folds(piece) = at {
                pieces.store(piece, Ordering::Relaxed);
            }
            proceed_if(!stops(&at))
        };
        let found = Tangencies::of(&figure_14(), &all, &watch).unwrap();
        assert!(!found.limited && !found.is_certified());
        (found.interrupted, pieces.into_inner())
    };
    assert_eq!(until(|at| matches!(at, Stage::Folds(_))), (true, 1));
    let (interrupted, pieces) = until(|at| matches!(at, Stage::Working));
    assert!(interrupted && pieces > 1, "{pieces}");
    assert!(!until(|_| false).0);
}

/// The work of a search is bounded; one that ends there is not certified, and says why.
#[test]
fn r48_a_search_ends_at_the_limit_of_its_work() {
    let found = |effort: &str| {
        let effort = effort.parse().unwrap();
        let all = TangencySettings { word: None, longest: 10, effort, ..settings("gap=9.4244..9.4254", FIRST, 9) };
        Tangencies::of(&figure_14(), &all, &Unwatched).unwrap()
    };
    let (few, all) = (found("3e-5"), found("1"));
    assert!(few.limited && !few.interrupted && !few.is_certified());
    assert!(!all.limited);
    let document = few.document(&figure_14());
    assert!(document.limited && !document.certified);
}

/// Without a word the search finds the first tangency by itself, in another section: the same value.
#[test]
#[ignore = "deep: all words of up to 18 impacts; by default both_tangencies_of_figure_14_are_proved_to_30_digits"]
fn the_search_finds_the_first_tangency() {
    let all = TangencySettings { word: None, longest: 18, ..settings("gap=9.4244..9.4254", FIRST, 9) };
    let found = Tangencies::of(&figure_14(), &all, &Unwatched).unwrap();
    assert!(found.is_certified());
    assert!((found.tangencies[0].parameter.mid_rad().0 - 9.425_126_376_887_205).abs() < 1e-14);
}
