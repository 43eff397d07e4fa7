//! H-sets that are followed: there and back, and what they lead to at other values.

use super::super::law::Law;
use super::super::quad::{Chord, State};
use super::followed::Followed;
use super::spread::Seed;
use super::*;
use crate::Scene;
use crate::chaos::guess::length;
use crate::number::{Ball, Number};
use crate::watch::Unwatched;

/// H-sets that the search finds for figure 14 with an amplitude of 7.38: one is left after 3 impacts along the saddle of P1 P3 P2.
fn bases() -> Vec<Base> {
    let base =
        |[a, b, c, d]: [State; 4]| Base { left: Chord { bottom: a, top: b }, right: Chord { bottom: c, top: d } };
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
fn apart(some: &[Base], others: &[Base]) -> f64 {
    let corners = |base: &Base| [base.left.bottom, base.left.top, base.right.bottom, base.right.top];
    let pairs = some.iter().flat_map(corners).zip(others.iter().flat_map(corners));
    pairs.map(|(a, b)| length([a[0] - b[0], a[1] - b[1]])).fold(0.0, f64::max) // shown: a distance
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
    let nowhere = Base::new([0.3, 9.0], [0.001, 0.001], [-0.001, 0.001]);
    assert!(Followed::of(&law(7.38), &[nowhere]).is_none());
    assert!(Followed::of(&law(7.38), &bases()).unwrap().to(&law(0.5)).is_none());
}

/// Moved h-sets lead to a horseshoe at a value at which they do not as they were.
#[test]
fn moved_h_sets_lead_to_a_horseshoe() {
    let (here, there) = (law(7.38), law(7.55));
    let moved = Followed::of(&here, &bases()).unwrap().to(&there).unwrap().bases();
    let proved = |law: &Law, bases: Vec<Base>| Horseshoe::quick(law, bases, 8, &Unwatched);
    assert!(proved(&here, bases()).is_some() && proved(&there, moved).is_some());
    assert_eq!(proved(&there, bases()), None);
}

/// Lemma D14: what is undecided beside a value is cut into parts, each with a horseshoe that its ends have as well; what is decided stays,
/// and what is not proved is undecided.
#[test]
fn a_stretch_is_decided_by_the_h_sets_of_a_neighbour() {
    let scene = Scene::parse(include_str!("../../../scenes/figure-14.toml")).unwrap();
    let exact = |text: &str| text.parse::<Exact>().unwrap();
    let asked = RangeSettings { over: "amplitude=7.38..7.43".parse().unwrap(), cells: 1, halvings: 4, depth: 8 };
    let work = Work { pair: scene.pair(), start: scene.start(), asked: &asked, watch: &Unwatched };
    let stretch = |low: &str, high: &str, verdict| Stretch { low: exact(low), high: exact(high), verdict, halved: 0 };
    let decided = Verdict::Stable { word: "P1 P2".parse().unwrap(), cycles: 1, beside: None };
    let given = vec![stretch("7.38", "7.4", Verdict::Undecided), stretch("7.4", "7.43", decided.clone())];
    let seed = Seed { value: exact("7.38"), bases: bases() };
    let found = work.walked(&seed, given.clone(), true).unwrap();
    assert_eq!((found[0].low.text(), found.last().unwrap().high.text()), ("7.38".into(), "7.43".into()));
    assert!(found.len() > 2 && found.windows(2).all(|pair| pair[0].high.text() == pair[1].low.text()));
    assert_eq!(found.last().unwrap().verdict, decided);
    for part in &found[..found.len() - 1] {
        let horseshoe = part.verdict.horseshoe().expect("one is proved");
        for end in [&part.low, &part.high] {
            let one = Law::of(&scene.pair().with(asked.over.key, end.clone()).unwrap()).unwrap();
            let own = Horseshoe::quick(&one, horseshoe.bases.clone(), 8, &Unwatched).expect("it has one by itself");
            assert!(own.entropy[0] >= 0.9 * horseshoe.entropy[0] && horseshoe.entropy[0] > 0.0);
        }
    }
    let nothing = Seed { bases: vec![Base::new([0.3, 9.0], [0.001, 0.001], [-0.001, 0.001])], ..seed };
    let left = work.walked(&nothing, given, true).unwrap();
    assert_eq!(left.iter().map(|stretch| stretch.verdict.name()).collect::<Vec<_>>(), ["undecided", "stable"]);
}
