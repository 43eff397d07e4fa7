//! Figure 14 at depth 3: four words between two of its three h-sets.

use std::collections::BTreeSet;
use std::f64::consts::{LN_2, TAU};

use super::cones::{Proved, is_flat};
use super::root::{Edge, ratios, root};
use super::strings::{EMPTY_BOUNDS, ends, hull};
use super::strip::{Branch, Cell, Map, StraightStrip};
use super::{Hyperbolic, KAPPA, LeftOut, are_apart, propose};
use crate::chaos::cycles::{Cycle, Cycles};
use crate::chaos::frame::Frame;
use crate::chaos::guess::Guess;
use crate::chaos::horseshoe::Chaos;
use crate::chaos::law::{Law, Side};
use crate::chaos::quad::Chord;
use crate::chaos::vector::applied;
use crate::chaos::words::HSet;
use crate::exact::Enclosure;
use crate::number::interval::Interval;
use crate::number::{Ball, Number, logarithm};
use crate::pair::Wall;
use crate::periodic::Precision;
use crate::watch::Unwatched;
use crate::{Effort, Scene};

const H_SETS: [[f64; 6]; 3] = [
    [4.891025, 1.234518, 0.180768, 0.082, -0.00187, 0.002596],
    [4.89839, 1.224294, 0.181119, 0.081513, -0.000935, 0.001298],
    [4.901897, 1.219425, 0.180009, 0.083055, -0.000701, 0.000974],
];

fn law() -> Law {
    Law { gap: Ball::new(1.17812125, 1e-15), restitution: Ball::exact(0.5) }
}

fn chaos() -> Chaos {
    let base = |[u, w, a, b, c, d]: [f64; 6]| HSet::new([u / TAU, w], [a / TAU, b], [c / TAU, d]);
    Chaos::proved(&law(), H_SETS.map(base).to_vec(), (3, u64::MAX), &Unwatched)
}

fn of(law: &Law, chaos: &Chaos) -> Hyperbolic {
    Hyperbolic::proved(law, chaos.bases(), chaos.words(), &Unwatched).expect("a hyperbolic set")
}

/// The frames and the strips of the words.
fn strips(law: &Law, chaos: &Chaos) -> (Guess, Vec<Frame>, Vec<(usize, Branch)>) {
    let (guess, frames) = (Guess::new(law), chaos.bases().iter().map(Frame::of).collect::<Vec<_>>());
    let strips = propose::branches(&guess, &frames, chaos.words());
    (guess, frames, strips)
}

/// It was a panic at figure 16, none of whose words is proved to expand cones.
#[test]
fn r37_no_words_are_no_hyperbolic_set() {
    let (law, chaos) = (law(), chaos());
    assert_eq!(Hyperbolic::proved(&law, chaos.bases(), &[], &Unwatched), Err(Vec::new()));
    // From no h-set does one word lead back.
    let alone = Hyperbolic::proved(&law, chaos.bases(), &chaos.words()[1..2], &Unwatched);
    assert_eq!(alone, Err(vec![(0, LeftOut::Return)]));
}

/// A quadrilateral of positive speeds whose parallelogram has a corner at -0.09: no ball has the motions of its states.
#[test]
fn r39_a_parallelogram_has_positive_speeds_only() {
    let base = |top: f64| HSet {
        left: Chord { bottom: [0.0, 0.01], top: [0.0, top] },
        right: Chord { bottom: [0.1, 0.01], top: [0.1, 0.1] },
    };
    let (steep, even) = (base(0.5), base(0.1));
    assert!([steep, even].iter().all(|base| base.is_convex() && base.is_near()));
    assert!(are_apart(&[Frame::of(&even)]) && !are_apart(&[Frame::of(&steep)]));
}

#[test]
fn the_shortest_horseshoe_is_hyperbolic() {
    let set = of(&law(), &chaos());
    assert_eq!(set.words, [0, 2, 3, 5]);
    assert_eq!(set.left_out, [(1, LeftOut::Return), (4, LeftOut::Return)]);
    // As many motions over n cycles as sequences of two letters: the entropy is ln 2, not only at least that.
    let [impact, cycle] = set.entropy;
    assert!(cycle[0] <= LN_2 && LN_2 <= cycle[1] && cycle[1] - cycle[0] < 1e-8);
    assert!(impact[0] > 0.2811995 && impact[1] < 0.2811997);
    // An independent trial: [0.5341, 0.8412], [1.332, 1.757] and [0.600, 0.615] at other cells and strings.
    assert!(
        set.exponents[0][0] > 0.52
            && set.exponents[0][1] < 0.85
            && set.exponents[1][0] > 1.3
            && set.exponents[1][1] < 1.77
    );
    assert!(set.dimension[0] > 0.599 && set.dimension[1] < 0.616);
    for (one, other) in [(0, 1), (1, 0)] {
        assert!((set.exponents[0][one] + set.second[other] + 2.0 * LN_2).abs() < 1e-14);
    }
}

/// An impact of a periodic orbit, mirrored to the left wall, and its flight.
type Impact = ([Ball; 2], Side);

fn ball(x: &Enclosure) -> Ball {
    let (low, high) = x.to_f64_bounds();
    Ball::from(Interval::new(low, high))
}

/// The impacts that a cycle comes back after, in bounds that are proved without words, strips or cones.
fn impacts(law: &Law, cycle: &Cycle) -> Vec<Impact> {
    let all = &cycle.orbit.impacts;
    let fastest = law.beta().expect("a gap");
    let impact = |k: usize| {
        let (own, next) = (&all[k], &all[(k + 1) % all.len()]);
        let (ahead, sign) = if own.wall == Wall::Left { (0.0, -1.0) } else { (0.5, 1.0) };
        let speed = ball(&own.velocity).signed(sign).checked_div(fastest).expect("a speed");
        let side = if own.wall == next.wall { Side::Near } else { Side::Far };
        ([ball(&own.phase) + Ball::exact(ahead), speed], side)
    };
    (0..cycle.impacts).map(impact).collect()
}

/// The words that a cycle follows from some impact on, from the least one on; `None` if it is none of the set.
fn followed(impacts: &[Impact], frames: &[Frame], words: &[(usize, &Branch)]) -> Option<Vec<usize>> {
    let at = |k: usize| impacts[k % impacts.len()];
    let is_in = |k: usize, branch: &Branch| {
        let StraightStrip { left, right } = branch.strip;
        (-3..=3).any(|turns| {
            let place = frames[branch.from].place(at(k).0, f64::from(turns)).expect("coordinates");
            let [xi, eta] = place.map(Ball::mid);
            eta.abs() < 1.0 && left[0] + left[1] * eta < xi && xi < right[0] + right[1] * eta
        })
    };
    let from = |start: usize| {
        let (mut k, mut all) = (start, Vec::new());
        // A word may lead around the cycle several times.
        while all.is_empty() || !(k - start).is_multiple_of(impacts.len()) {
            let is_next = |(_, branch): &&(usize, &Branch)| {
                is_in(k, branch) && branch.sides.iter().enumerate().all(|(n, side)| at(k + n).1 == *side)
            };
            let (number, branch) = words.iter().find(is_next)?;
            all.push(*number);
            k += branch.sides.len();
        }
        Some(all)
    };
    (0..impacts.len()).find_map(from).map(least)
}

/// The sequence that is least of all that begin elsewhere.
fn least(loop_: Vec<usize>) -> Vec<usize> {
    let turned = |k: usize| [&loop_[k..], &loop_[..k]].concat();
    (0..loop_.len()).map(turned).min().expect("a word")
}

/// All closed sequences of words of at most `most` impacts, none of them a shorter one several times.
fn loops(words: &[(usize, &Branch)], most: usize) -> BTreeSet<Vec<usize>> {
    let (mut found, mut open) = (BTreeSet::new(), vec![(Vec::<&(usize, &Branch)>::new(), 0)]);
    while let Some((path, impacts)) = open.pop() {
        if let (Some(first), Some(last)) = (path.first(), path.last())
            && first.1.from == last.1.to
        {
            let numbers: Vec<usize> = path.iter().map(|word| word.0).collect();
            if (1..numbers.len()).all(|k| [&numbers[k..], &numbers[..k]].concat() != numbers) {
                found.insert(least(numbers));
            }
        }
        let fits = |word: &&(usize, &Branch)| path.last().is_none_or(|last| last.1.to == word.1.from);
        for word in words.iter().filter(fits) {
            let impacts = impacts + word.1.sides.len();
            if impacts <= most {
                open.push(([&path[..], &[word]].concat(), impacts));
            }
        }
    }
    found
}

/// All cycles of the region are found without words, strips or cones: those in the set are as many as its words allow, no more and no
/// less, and their eigenvalues say what they expand by.
#[test]
fn cycles_in_the_set_are_those_of_its_words_and_their_exponents_within_the_bounds() {
    const MAX_LENGTH: u32 = 9;
    let (law, chaos) = (law(), chaos());
    let set = of(&law, &chaos);
    let (_, frames, strips) = strips(&law, &chaos);
    let words: Vec<(usize, &Branch)> = strips
        .iter()
        .filter(|(number, _)| set.words.contains(number))
        .map(|(number, branch)| (*number, branch))
        .collect();
    let scene = Scene::parse(include_str!("../../../scenes/figure-14.toml")).expect("a scene");
    let cycles = Cycles::of(&scene, Effort::default(), &(1..=MAX_LENGTH), Precision::default(), &Unwatched)
        .expect("a law")
        .expect("a region");
    assert!(cycles.is_certified());
    let (mut found, mut all) = (BTreeSet::new(), EMPTY_BOUNDS);
    for cycle in cycles.cycles() {
        let Some(numbers) = followed(&impacts(&law, cycle), &frames, &words) else { continue };
        let eigenvalue = ball(&cycle.orbit.eigenvalues[0].re);
        let sum = ends(logarithm(eigenvalue.signed(eigenvalue.mid().signum())).expect("positive"));
        let lengths = [cycle.orbit.impacts.len() as f64, f64::from(cycle.problem.chain().cycles())];
        for (length, [low, high]) in lengths.into_iter().zip(set.exponents) {
            assert!(low * length <= sum[1] && sum[0] <= high * length, "{numbers:?}: {sum:?} in {length}");
        }
        all = hull(all, sum.map(|sum| sum / lengths[0]));
        assert!(found.insert(numbers), "two cycles of one sequence");
    }
    assert_eq!(found, loops(&words, MAX_LENGTH as usize));
    // The bounds are near what they bound.
    assert!(all[0] - set.exponents[0][0] < 0.005 && set.exponents[0][1] - all[1] < 0.005, "{all:?}");
}

#[test]
fn derivatives_hold_those_of_the_states_of_a_cell() {
    let (law, chaos) = (law(), chaos());
    let (guess, frames, strips) = strips(&law, &chaos);
    let map = Map { law: &law, guess: &guess, frames: &frames };
    let cell = Cell { at: [0.25, -0.5], radii: [0.0625, 0.25] };
    for (_, branch) in &strips {
        let image = map.image(branch, cell, &|_, _, _| true).expect("flights of a small cell");
        for (a, b) in [(-1.0, -1.0), (-1.0, 1.0), (0.0, 0.3), (1.0, -1.0), (1.0, 1.0)] {
            let [alpha, eta] = [cell.at[0] + a * cell.radii[0], cell.at[1] + b * cell.radii[1]];
            let [place, slope] = branch.strip.line(Ball::exact(alpha)).map(Ball::mid);
            let mut state =
                frames[branch.from].state(Ball::exact(place + slope * eta), Ball::exact(eta)).map(Ball::mid);
            let [along, across] = [(branch.strip.breadth(Ball::exact(eta)).mid(), 0.0), (slope, 1.0)]
                .map(|(xi, eta)| frames[branch.from].vector(Ball::exact(xi), Ball::exact(eta)).map(Ball::mid));
            let mut sides = [along.map(|x| x * cell.radii[0]), across.map(|x| x * cell.radii[1])];
            for _ in &branch.sides {
                let next = guess.map(state).expect("a flight");
                sides = sides.map(|side| applied(next.jacobian, side));
                state = next.state;
            }
            let frame = &frames[branch.to];
            let holds = |ball: Ball, x: Ball| (ball.mid() - x.mid()).abs() <= ball.rad() + 1e-9;
            let place = frame.place(state.map(Ball::exact), branch.turns).expect("coordinates");
            assert!((0..2).all(|i| holds(image.spread(i), place[i])), "{place:?}");
            for (side, known) in sides.iter().zip(image.sides.both()) {
                let side = frame.coordinates(side.map(Ball::exact)).expect("coordinates");
                assert!((0..2).all(|i| holds(known[i], side[i])), "{side:?} is not in {known:?}");
            }
            let both = sides.map(|side| frame.coordinates(side.map(Ball::exact)).expect("coordinates"));
            let known = image.sides.combined(Ball::exact(-3.0), Ball::exact(2.0));
            let sum = [0, 1].map(|i| Ball::exact(-3.0 * both[0][i].mid() + 2.0 * both[1][i].mid()));
            assert!((0..2).all(|i| holds(known[i], sum[i])), "{sum:?} is not in {known:?}");
        }
    }
}

/// Steeper cones fail near one corner of one strip alone: a word is lost where a single cell's cone is not mapped into itself.
#[test]
fn each_cell_has_its_cone() {
    let (law, chaos) = (law(), chaos());
    let (guess, frames, strips) = strips(&law, &chaos);
    let map = Map { law: &law, guess: &guess, frames: &frames };
    let is_proved = |kappa: f64| -> Vec<bool> {
        strips.iter().map(|(_, branch)| map.prove(branch, kappa, &Unwatched).is_ok()).collect()
    };
    assert_eq!(is_proved(KAPPA), [true; 6]);
    assert_eq!(is_proved(100.0), [true, true, true, false, true, true]);
}

#[test]
fn curves_meet_the_sides_of_a_strip_once() {
    let flat = |slope: f64, taper: f64| {
        let strip = StraightStrip { left: [-0.1, slope - taper], right: [0.1, slope + taper] };
        is_flat(&Branch { from: 0, to: 0, sides: vec![Side::Far], half_turns: 1, turns: 1.0, strip, rises: true }, 64.0)
    };
    assert!(flat(0.0155, 0.0) && flat(-0.0155, 0.0) && flat(0.01, 0.005));
    assert!(!flat(1.0 / 64.0, 0.0) && !flat(0.01, 0.006) && !flat(-0.02, 0.0) && !flat(f64::NAN, 0.0));
}

#[test]
fn strips_are_disjoint_or_not() {
    let strip = |middle: f64, slope: f64| StraightStrip { left: [middle - 0.1, slope], right: [middle + 0.1, slope] };
    assert!(strip(0.0, 0.0).is_apart(&strip(0.21, 0.0)) && strip(0.21, 0.005).is_apart(&strip(0.0, 0.0)));
    // They meet at one end.
    assert!(!strip(0.0, 0.0).is_apart(&strip(0.21, 0.02)) && !strip(0.0, 0.0).is_apart(&strip(0.0, 0.0)));
    assert!(strip(0.5, 0.3).is_inside() && !strip(0.8, 0.1).is_inside() && !strip(0.8, -0.3).is_inside());
}

/// Two loops of lengths 1 and 2 at one node, and a way there and back that changes nothing around a loop.
fn graph(least: f64, most: f64) -> Vec<Edge> {
    let edge = |from, to, weight: f64, length| Edge { from, to, weight: [weight + least, weight + most], length };
    vec![edge(0, 0, 1.0, 1.0), edge(0, 1, 5.0, 1.0), edge(1, 0, -4.0, 1.0)]
}

#[test]
fn bounds_are_those_of_both_ends() {
    // e^-t + e^-t = 1 with steps of -4 and 5, one after the other: the same for all potentials.
    let [low, high] = root(&[Edge { from: 0, to: 0, weight: [2.0, 3.0], length: 1.0 }; 2]).expect("a root");
    assert!(low <= LN_2 / 3.0 && LN_2 / 3.0 - low < 1e-8 && LN_2 / 2.0 <= high && high - LN_2 / 2.0 < 1e-8);
    let [least, most] = ratios(&graph(0.0, 0.0));
    assert!(least <= 0.5 && 0.5 - least < 1e-9 && 1.0 <= most && most - 1.0 < 1e-9);
    let [least, most] = ratios(&graph(-0.25, 0.5));
    assert!(least <= 0.25 && 0.25 - least < 1e-9 && 1.5 <= most && most - 1.5 < 1e-9);
    // A weight that is no double: a third is less than what is nearest to it, thrice.
    let third = [(1.0f64 / 3.0).next_down(), (1.0f64 / 3.0).next_up()];
    let [least, most] = ratios(&[Edge { from: 0, to: 0, weight: third, length: 3.0 }]);
    assert!(least < third[0] / 3.0 && third[1] / 3.0 < most);
}

/// Lemma D28: an end that is no number bounds nothing, whichever comes first.
#[test]
fn r62_a_hull_with_an_end_that_is_no_number_has_none() {
    for (one, other) in [([f64::NAN, 1.0], [0.0, 2.0]), ([0.0, 2.0], [f64::NAN, 1.0]), (EMPTY_BOUNDS, [f64::NAN, 1.0])]
    {
        let [low, high] = hull(one, other);
        assert!(low.is_nan() && (high == 2.0 || high == 1.0), "{low} {high}");
    }
    assert!(hull([0.0, 1.0], [0.5, f64::NAN])[1].is_nan());
    assert_eq!(hull([0.0, 1.0], [-1.0, 0.5]), [-1.0, 1.0]);
}

/// Lemma D25: a word is not alone if another one leads from where its own states pass to the same h-set, by its last flights; that it is, is
/// proved once the other one's strip is elsewhere, or is its own.
#[test]
fn r62_a_word_that_another_one_cuts_short_is_not_alone() {
    let (law, chaos) = (law(), chaos());
    let (guess, frames, strips) = strips(&law, &chaos);
    let map = Map { law: &law, guess: &guess, frames: &frames };
    let (number, longest) = strips.iter().max_by_key(|(_, branch)| branch.sides.len()).expect("words");
    let images = map.prove(longest, KAPPA, &Unwatched).expect("cones");
    let word = Proved { number: *number, branch: longest.clone(), images };
    // The state of a cell after the first flight, in the coordinates of the h-set that it is nearest to.
    let [middle, _] = longest.strip.line(Ball::exact(0.0));
    let state = frames[longest.from].state(middle, Ball::exact(0.0)).map(Ball::mid);
    let next = guess.map(state).expect("a flight").state.map(Ball::exact);
    let heights = vec![Ball::new(0.0, 1e6); frames.len()];
    let is_alone = |from: usize, turns: f64, middle: f64| {
        let strip = StraightStrip { left: [middle - 1e3, 0.0], right: [middle + 1e3, 0.0] };
        let (sides, half_turns) = (longest.sides[1..].to_vec(), longest.half_turns);
        let branch = Branch { from, sides, half_turns, turns: longest.turns - turns, strip, ..longest.clone() };
        let other = Proved { number: number + 1, branch, images: Vec::new() };
        map.is_alone(&word, &[other], &heights, &Unwatched)
    };
    let place = frames[0].place(next, 0.0).expect("coordinates").map(Ball::mid);
    assert!(!is_alone(0, 0.0, place[0]), "a strip that holds the states on the way");
    assert!(is_alone(0, 0.0, place[0] + 1e5), "a strip beside them");
    assert!(map.is_alone(&word, std::slice::from_ref(&word), &heights, &Unwatched), "itself");
}

#[test]
fn a_whole_interval_of_the_gap_at_once() {
    let (law, narrow) = (Law { gap: Ball::new(1.17812125, 1e-7), ..law() }, of(&law(), &chaos()));
    let wide = of(&law, &chaos());
    assert_eq!(wide.words, narrow.words);
    assert!(wide.exponents[0][0] <= narrow.exponents[0][0] && narrow.exponents[0][1] <= wide.exponents[0][1]);
    assert!(wide.dimension[0] <= narrow.dimension[0] && narrow.dimension[1] <= wide.dimension[1]);
}
