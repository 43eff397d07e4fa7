//! H-sets that are followed: there and back, and what they lead to at other values.

use super::super::law::Law;
use super::super::quad::{Chord, State};
use super::followed::Followed;
use super::spread::Seed;
use super::*;
use crate::Scene;
use crate::chaos::vector::length;
use crate::number::{Ball, Number};
use crate::watch::Unwatched;

/// H-sets that the search finds for figure 14 with an amplitude of 7.38: one is left after 3 impacts along the saddle of P1 P3 P2.
fn bases() -> Vec<HSet> {
    let base =
        |[a, b, c, d]: [State; 4]| HSet { left: Chord { bottom: a, top: b }, right: Chord { bottom: c, top: d } };
    let one = [[0.809132, 1.459969], [0.808817, 1.462298], [0.830951, 1.489599], [0.830635, 1.491928]];
    let other = [[0.804133, 1.496848], [0.803496, 1.501544], [0.825808, 1.527534], [0.825171, 1.53223]];
    vec![base(one), base(other)]
}

/// Figure 14 with an amplitude.
fn law(amplitude: f64) -> Law {
    let gap = Ball::exact(9.42497).checked_div(Ball::exact(amplitude)).expect("not 0");
    Law { gap, restitution: Ball::exact(0.5) }
}

/// The greatest distance of a corner from that of other h-sets.
fn apart(some: &[HSet], others: &[HSet]) -> f64 {
    let corners = |base: &HSet| [base.left.bottom, base.left.top, base.right.bottom, base.right.top];
    let pairs = some.iter().flat_map(corners).zip(others.iter().flat_map(corners));
    pairs.map(|(a, b)| length([a[0] - b[0], a[1] - b[1]])).fold(0.0, f64::max) // shown: a distance
}

fn stretch(low: &str, high: &str, verdict: Verdict) -> Stretch {
    Stretch::new([low, high].map(|end| end.parse().unwrap()), verdict, 0)
}

fn stable(word: &str) -> Verdict {
    Verdict::Stable { word: word.parse().unwrap(), cycles: 1, beside: None }
}

#[test]
fn h_sets_that_are_followed_there_and_back_are_the_same() {
    let start = Followed::of(&law(7.38), &bases()).unwrap();
    let there = start.to(&law(7.7)).unwrap();
    let back = there.to(&law(7.38)).unwrap();
    assert!(apart(&there.bases(), &bases()) > 0.01, "the amplitude moves saddles");
    assert!(apart(&back.bases(), &bases()) < 1e-8);
}

/// There is none where no periodic orbit of few impacts is in an h-set, and it is lost on the way to an amplitude at which that orbit is no saddle.
#[test]
fn a_saddle_that_is_not_there_is_not_followed() {
    let nowhere = HSet::new([0.3, 9.0], [0.001, 0.001], [-0.001, 0.001]);
    assert!(Followed::of(&law(7.38), &[nowhere]).is_none());
    assert!(Followed::of(&law(7.38), &bases()).unwrap().to(&law(0.5)).is_none());
}

/// Moved h-sets lead to a horseshoe at a value at which they do not as they were.
#[test]
fn moved_h_sets_lead_to_a_horseshoe() {
    let (here, there) = (law(7.38), law(7.55));
    let moved = Followed::of(&here, &bases()).unwrap().to(&there).unwrap().bases();
    let proved = |law: &Law, bases: Vec<HSet>| Horseshoe::quick(law, bases, 8, &Unwatched);
    assert!(proved(&here, bases()).is_some() && proved(&there, moved).is_some());
    assert_eq!(proved(&there, bases()), None);
}

/// Lemma D14: what is undecided beside a value is cut into parts, each with a horseshoe that its ends have as well; what is decided stays,
/// and what is not proved is undecided.
#[test]
fn a_stretch_is_decided_by_the_h_sets_of_a_neighbour() {
    let scene = Scene::parse(include_str!("../../../scenes/figure-14.toml")).unwrap();
    let requested = RangeSettings { over: "amplitude=7.38..7.43".parse().unwrap(), cells: 1, halvings: 4, depth: 8 };
    let work = Work { pair: scene.pair(), start: scene.start(), requested: &requested, watch: &Unwatched };
    let decided = stable("P1 P2");
    let given = vec![stretch("7.38", "7.4", Verdict::Undecided), stretch("7.4", "7.43", decided.clone())];
    let seed = Seed { value: "7.38".parse().unwrap(), bases: bases() };
    let found = work.walked(&seed, given.clone(), true).unwrap();
    assert_eq!((found[0].low.text(), found.last().unwrap().high.text()), ("7.38".into(), "7.43".into()));
    assert!(found.len() > 2 && found.windows(2).all(|pair| pair[0].high.text() == pair[1].low.text()));
    assert_eq!(found.last().unwrap().verdict, decided);
    for part in &found[..found.len() - 1] {
        let horseshoe = part.verdict.horseshoe().expect("one is proved");
        for end in [&part.low, &part.high] {
            let one = Law::of(&scene.pair().with(requested.over.key(), end.clone()).unwrap()).unwrap();
            let own = Horseshoe::of(&one, horseshoe.bases.clone(), 8, &Unwatched).expect("it has one by itself");
            assert!(own.entropy[0] >= 0.9 * horseshoe.entropy[0] && horseshoe.entropy[0] > 0.0);
        }
    }
    let nothing = Seed { bases: vec![HSet::new([0.3, 9.0], [0.001, 0.001], [-0.001, 0.001])], ..seed };
    let left = work.walked(&nothing, given, true).unwrap();
    assert_eq!(
        left.iter().map(|stretch| stretch.verdict.kind().to_string()).collect::<Vec<_>>(),
        ["undecided", "stable"]
    );
}

/// Lemma D14: downward as well, and in the order of the values.
#[test]
fn a_stretch_below_is_decided_by_the_h_sets_of_a_neighbour() {
    let scene = Scene::parse(include_str!("../../../scenes/figure-14.toml")).unwrap();
    let requested = RangeSettings { over: "amplitude=7.33..7.38".parse().unwrap(), cells: 1, halvings: 4, depth: 8 };
    let work = Work { pair: scene.pair(), start: scene.start(), requested: &requested, watch: &Unwatched };
    let given = vec![stretch("7.33", "7.36", stable("P1 P2")), stretch("7.36", "7.38", Verdict::Undecided)];
    let found = work.walked(&Seed { value: "7.38".parse().unwrap(), bases: bases() }, given, false).unwrap();
    assert_eq!(
        (found[0].verdict.kind(), found[0].low.text(), found[0].high.text()),
        (StretchVerdict::Stable, "7.33".into(), "7.36".into())
    );
    assert!(found.windows(2).all(|pair| pair[0].high.text() == pair[1].low.text()));
    let last = found.last().unwrap();
    assert_eq!((last.verdict.kind(), last.high.text()), (StretchVerdict::Horseshoe, "7.38".into()));
}

/// Lemmas D14, D15: neighbours of which the same is proved are one, also where one gives several rounds of the orbit; others are not.
#[test]
fn only_equal_verdicts_are_joined() {
    let attracted = |word: &str, beside: Option<&Horseshoe>| Verdict::Attracted {
        word: word.parse().unwrap(),
        cycles: word.split(' ').count() as u32 / 2,
        beside: beside.cloned(),
    };
    let horseshoe = Horseshoe::quick(&law(7.38), bases(), 8, &Unwatched).unwrap();
    let joined = |verdicts: [Verdict; 2]| {
        let mut found = Vec::new();
        for ((verdict, [low, high]), halved) in verdicts.into_iter().zip([["1", "2"], ["2", "3"]]).zip([3, 1]) {
            join(&mut found, Stretch { halved, ..stretch(low, high, verdict) });
        }
        found
    };
    let twice = attracted("P1 P2 P1 P2", None);
    for (verdicts, expected) in [
        ([stable("P1 P2"), stable("P1 P2")], stable("P1 P2")),
        ([attracted("P1 P2", None), twice.clone()], attracted("P1 P2", None)),
        ([twice.clone(), attracted("P1 P2", None)], attracted("P1 P2", None)),
    ] {
        let found = joined(verdicts);
        assert!(found.len() == 1 && found[0].verdict == expected && found[0].halved == 1, "{found:?}");
        assert_eq!((found[0].low.text(), found[0].high.text()), ("1".into(), "3".into()));
    }
    for verdicts in [
        [stable("P1 P2"), stable("P1 P3 P2")],
        [stable("P1 P2"), Verdict::Undecided],
        [stable("P1 P2"), attracted("P1 P2", None)],
        [attracted("P1 P2", None), attracted("P1 P3 P2", None)],
        [attracted("P1 P2", None), attracted("P2 P4 P1 P3", None)],
        [attracted("P2 P4 P1 P3", None), attracted("P1 P2", None)],
        [attracted("P1 P2", None), Verdict::Attracted { word: "RLRL".parse().unwrap(), cycles: 3, beside: None }],
        [attracted("P1 P2", Some(&horseshoe)), twice],
        [Verdict::Horseshoe(horseshoe.clone()), Verdict::Undecided],
    ] {
        let found = joined(verdicts.clone());
        let kept: Vec<Verdict> = found.into_iter().map(|stretch| stretch.verdict).collect();
        assert_eq!(kept, verdicts);
    }
}
