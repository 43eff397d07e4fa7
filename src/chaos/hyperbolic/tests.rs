//! Figure 14 at depth 3: four words between two of its three h-sets. The periodic orbits are found in doubles, by Newton's method.

use std::f64::consts::{LN_2, TAU};

use super::cones::is_flat;
use super::frame::Frame;
use super::root::{Edge, ratios, root};
use super::strip::{Branch, Cell, Map, Strip};
use super::{Hyperbolic, KAPPA, propose};
use crate::chaos::guess::{Guess, applied};
use crate::chaos::horseshoe::Chaos;
use crate::chaos::law::{Law, Side};
use crate::chaos::quad::State;
use crate::chaos::words::Base;
use crate::number::Ball;
use crate::watch::Unwatched;

const BASES: [[f64; 6]; 3] = [
    [4.891025, 1.234518, 0.180768, 0.082, -0.00187, 0.002596],
    [4.89839, 1.224294, 0.181119, 0.081513, -0.000935, 0.001298],
    [4.901897, 1.219425, 0.180009, 0.083055, -0.000701, 0.000974],
];

fn law() -> Law {
    Law { gap: Ball::new(1.17812125, 1e-15), restitution: Ball::exact(0.5) }
}

fn chaos() -> Chaos {
    let base = |[u, w, a, b, c, d]: [f64; 6]| Base::new([u / TAU, w], [a / TAU, b], [c / TAU, d]);
    Chaos::proved(&law(), BASES.map(base).to_vec(), 3, &Unwatched)
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

#[test]
fn the_shortest_horseshoe_is_hyperbolic() {
    let set = of(&law(), &chaos());
    assert_eq!(set.words, [0, 2, 3, 5]);
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

/// Where on the middle line of an h-set a word leads to that place in the next one: by halving its strip.
fn before(guess: &Guess, frames: &[Frame], word: &Branch, wanted: f64) -> f64 {
    let (mut low, mut high) = (word.strip.middle - word.strip.half, word.strip.middle + word.strip.half);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        let mut state = frames[word.from].state(Ball::exact(middle), Ball::exact(0.0)).map(Ball::mid);
        word.sides.iter().for_each(|_| state = guess.map(state).expect("a flight").state);
        let [xi, _] = frames[word.to].place(state.map(Ball::exact), word.turns).expect("coordinates");
        *if (xi.mid() < wanted) == word.rises { &mut low } else { &mut high } = middle;
    }
    0.5 * (low + high)
}

/// The logarithm of what the periodic orbit that follows words expands by, its impacts, and its forcing periods.
fn exponent(guess: &Guess, frames: &[Frame], words: &[&Branch]) -> [f64; 3] {
    let mut xi = 0.0;
    for word in words.iter().chain(words).rev() {
        xi = before(guess, frames, word, xi);
    }
    let at = frames[words[0].from].state(Ball::exact(xi), Ball::exact(0.0)).map(Ball::mid);
    let turns: f64 = words.iter().map(|word| word.turns).sum();
    let follow = |start: State| {
        let (mut state, mut product) = (start, [[1.0, 0.0], [0.0, 1.0]]);
        let mut flights = words.iter().flat_map(|word| &word.sides);
        let is_alike = flights.all(|&side| {
            let Some(image) = guess.map(state) else { return false };
            let [a, b] = [0, 1].map(|k| applied(image.jacobian, [product[0][k], product[1][k]]));
            product = [[a[0], b[0]], [a[1], b[1]]];
            state = image.state;
            image.side == side
        });
        is_alike.then_some(([state[0] - turns - start[0], state[1] - start[1]], product))
    };
    let mut at = at;
    for _ in 0..200 {
        let ([u, w], [[a, b], [c, d]]) = follow(at).expect("flights as the words say");
        let (a, d) = (a - 1.0, d - 1.0);
        let determinant = a * d - b * c;
        let step = [(d * u - b * w) / determinant, (a * w - c * u) / determinant];
        // No further than flights are alike.
        let part = (0..40)
            .map(|k| 0.5f64.powi(k))
            .find(|part| follow([at[0] - part * step[0], at[1] - part * step[1]]).is_some());
        let part = part.expect("some part");
        at = [at[0] - part * step[0], at[1] - part * step[1]];
    }
    let ([u, w], [[a, b], [c, d]]) = follow(at).expect("flights as the words say");
    assert!(u.abs() + w.abs() < 1e-11, "{u} {w}");
    let (half_trace, determinant) = (0.5 * (a + d), a * d - b * c);
    let eigenvalue = half_trace.abs() + (half_trace * half_trace - determinant).sqrt();
    let impacts = words.iter().map(|word| word.sides.len() as f64).sum();
    [eigenvalue.ln(), impacts, words.iter().map(|word| 0.5 * word.half_turns as f64).sum()]
}

#[test]
fn exponents_of_its_periodic_orbits_are_within_the_bounds() {
    let (law, chaos) = (law(), chaos());
    let set = of(&law, &chaos);
    let (guess, frames, strips) = strips(&law, &chaos);
    let word = |number: usize| &strips.iter().find(|strip| strip.0 == number).expect("a strip").1;
    let loops: [&[usize]; 6] = [&[0], &[5], &[3, 2], &[0, 3, 2], &[3, 5, 2], &[0, 0, 3, 5, 2]];
    let mut all = [f64::INFINITY, f64::NEG_INFINITY];
    for numbers in loops {
        let words: Vec<&Branch> = numbers.iter().map(|&number| word(number)).collect();
        let [sum, impacts, cycles] = exponent(&guess, &frames, &words);
        for (rate, [low, high]) in [sum / impacts, sum / cycles].into_iter().zip(set.exponents) {
            assert!(low - 1e-9 <= rate && rate <= high + 1e-9, "{numbers:?}: {rate} is not in [{low}, {high}]");
        }
        all = [all[0].min(sum / impacts), all[1].max(sum / impacts)];
    }
    // The bounds are near what they bound.
    assert!(all[0] - set.exponents[0][0] < 0.01 && set.exponents[0][1] - all[1] < 0.01, "{all:?}");
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
            let [place, slope] = branch.strip.line(alpha).map(Ball::mid);
            let mut state =
                frames[branch.from].state(Ball::exact(place + slope * eta), Ball::exact(eta)).map(Ball::mid);
            let [along, across] = [(branch.strip.half + branch.strip.taper * eta, 0.0), (slope, 1.0)]
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
            for (side, known) in sides.iter().zip(image.sides) {
                let side = frame.coordinates(side.map(Ball::exact)).expect("coordinates");
                assert!((0..2).all(|i| holds(known[i], side[i])), "{side:?} is not in {known:?}");
            }
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
        strips.iter().map(|(_, branch)| map.prove(branch, kappa, &Unwatched).is_some()).collect()
    };
    assert_eq!(is_proved(KAPPA), [true; 6]);
    assert_eq!(is_proved(100.0), [true, true, true, false, true, true]);
}

#[test]
fn curves_meet_the_sides_of_a_strip_once() {
    let flat = |slope: f64, taper: f64| {
        let strip = Strip { middle: 0.0, slope, half: 0.1, taper };
        is_flat(&Branch { from: 0, to: 0, sides: vec![Side::Far], half_turns: 1, turns: 1.0, strip, rises: true }, 64.0)
    };
    assert!(flat(0.0155, 0.0) && flat(-0.0155, 0.0) && flat(0.01, 0.005));
    assert!(!flat(1.0 / 64.0, 0.0) && !flat(0.01, 0.006) && !flat(-0.02, 0.0) && !flat(f64::NAN, 0.0));
}

#[test]
fn strips_are_disjoint_or_not() {
    let strip = |middle: f64, slope: f64| Strip { middle, slope, half: 0.1, taper: 0.0 };
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

#[test]
fn a_whole_interval_of_the_gap_at_once() {
    let (law, narrow) = (Law { gap: Ball::new(1.17812125, 1e-7), ..law() }, of(&law(), &chaos()));
    let wide = of(&law, &chaos());
    assert_eq!(wide.words, narrow.words);
    assert!(wide.exponents[0][0] <= narrow.exponents[0][0] && narrow.exponents[0][1] <= wide.exponents[0][1]);
    assert!(wide.dimension[0] <= narrow.dimension[0] && narrow.dimension[1] <= wide.dimension[1]);
}
