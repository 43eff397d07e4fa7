//! Strips of words: the states of an h-set that a word leads across another one, between two curves across it. Lemma D34 of
//! `docs/proofs/chaos.md#D34`.
//!
//! A strip is all that it takes to prove its word again: documents carry it, and `check` follows its states from flight to flight.
//! Floating point proposes strips ([`find`]), intervals prove them ([`cover`]).

mod cover;
mod curve;
mod find;

use std::iter;

use super::frame::Frame;
use super::guess::Guess;
use super::law::{Law, Side};
use super::words::{HSet, Path};
use crate::number::Ball;
use crate::threads::each;
use crate::watch::{Stage, Watch};
use cover::Covering;
use curve::{Curve, Heights};
use find::Finder;

/// The part of an h-set between two curves from below to above it, in the coordinates of the h-set: from -1 to 1 along it and across.
///
/// **Enclosure**: from all states between the two curves, and from above and below the h-set up to the heights of its corners, the word's flights come one after the other, and
/// end between bottom and top of the h-set that is covered; those from one curve end beyond its left edge, those from the other beyond its right one.
/// Lemma D34
#[derive(Clone, Debug, PartialEq)]
pub struct Strip {
    /// The place of the left curve at a height: coefficients of its powers, from the constant on.
    pub left: Vec<f64>,
    /// Those of the right curve.
    pub right: Vec<f64>,
    /// How both move with the parameters, if these are intervals.
    pub moved: Vec<Moved>,
}

/// A power of `D = d/A`, and one of `e`, each from -1 to 1 over its interval, times a polynomial of the height for each curve of a strip.
#[derive(Clone, Debug, PartialEq)]
pub struct Moved {
    /// The exponents of `D` and of `e`.
    pub by: [usize; 2],
    /// What is added to the place of the left curve.
    pub left: Vec<f64>,
    /// What is added to that of the right curve.
    pub right: Vec<f64>,
}

/// Both curves of a strip.
struct Sides {
    left: Curve,
    right: Curve,
}

impl Strip {
    fn sides(&self) -> Sides {
        let left = self.moved.iter().map(|moved| (moved.by, &moved.left[..]));
        let right = self.moved.iter().map(|moved| (moved.by, &moved.right[..]));
        Sides {
            left: Curve::new(iter::once(([0, 0], &self.left[..])).chain(left)),
            right: Curve::new(iter::once(([0, 0], &self.right[..])).chain(right)),
        }
    }
}

impl Sides {
    /// Whether this strip and another one of the h-set have no state in common: one is on the left of the other at all heights. Lemma D34
    fn is_apart(&self, other: &Self, frame: &Frame) -> bool {
        let heights = Heights::of(frame.tall);
        self.right.is_left_of(&other.left, heights) || other.right.is_left_of(&self.left, heights)
    }

    /// Whether the strip leads from below the h-set to above it, between its left and its right edge, and has some breadth everywhere.
    /// Lemma D34
    fn is_across(&self, base: &HSet, frame: &Frame) -> bool {
        let corner = |state: [f64; 2]| frame.place(state.map(Ball::exact), 0.0);
        let ends = [base.left, base.right].map(|edge| [edge.bottom, edge.top].map(corner));
        let [Some([a, b]), Some([c, d])] = ends.map(|[bottom, top]| Some([bottom?, top?])) else { return false };
        let heights = Heights::of(frame.tall);
        // Upper bounds of the places of the left corners, lower ones of those of the right corners.
        let left = [a, b].map(|corner| (corner[0].mid() + corner[0].rad()).next_up()); // D34: upward
        let right = [c, d].map(|corner| (corner[0].mid() - corner[0].rad()).next_down()); // D34: downward
        frame.tall.is_finite()
            && left.iter().all(|&left| Curve::still(left).is_left_of(&self.left, heights))
            && self.left.is_left_of(&self.right, heights)
            && right.iter().all(|&right| self.right.is_left_of(&Curve::still(right), heights))
    }
}

/// Strips of words between h-sets, in their order, each apart from those of other words: `None` where none is found, or proved, or before the
/// watch stops the search. Lemma D34
pub(super) fn strips(law: &Law, bases: &[HSet], words: &[Path], watch: &dyn Watch) -> Vec<Option<Strip>> {
    let frames: Vec<Frame> = bases.iter().map(Frame::of).collect();
    let numbers: Vec<usize> = (0..words.len()).collect();
    let finder = |number: usize| {
        let path = &words[number];
        Finder { law, guess: Guess::new(law), frames: [path.from, path.to].map(|base| &frames[base]), path }
    };
    let ends: Vec<Option<[f64; 2]>> = each(&numbers, &|&number: &usize| finder(number).ends());
    let found = |&number: &usize| {
        watch.proceed(Stage::Working).is_continue().then_some(())?;
        let (path, own) = (&words[number], ends[number]?);
        let finder = finder(number);
        let word = Covering { base: &bases[path.to], frames: finder.frames, path };
        let others = (0..words.len()).filter(|&other| other != number && words[other].from == path.from);
        let (rises, mut strips) = finder.strips(own, free(own, others.filter_map(|other| ends[other])))?;
        strips.find(|strip| {
            let sides = strip.sides();
            sides.is_across(&bases[path.from], finder.frames[0]) && word.is_proved(law, &sides, rises)
        })
    };
    let mut found = each(&numbers, &found);
    // D34: words of one h-set are told apart by their strips
    let mut kept: Vec<(usize, Sides)> = Vec::new();
    for (word, strip) in words.iter().zip(&mut found) {
        let Some(sides) = strip.as_ref().map(Strip::sides) else { continue };
        if kept.iter().all(|(from, other)| *from != word.from || sides.is_apart(other, &frames[word.from])) {
            kept.push((word.from, sides));
        } else {
            *strip = None;
        }
    }
    found
}

/// The places halfway to the next stretches on both sides of one, or its edges.
fn free(own: [f64; 2], others: impl Iterator<Item = [f64; 2]>) -> [f64; 2] {
    let middle = |[a, b]: [f64; 2]| 0.5 * (a + b);
    others.fold([-1.0, 1.0], |[least, most], other| {
        if middle(other) < middle(own) {
            [least.max((0.5 * (own[0] + other[1])).min(own[0])), most] // proposes: which strips are tried
        } else {
            [least, most.min((0.5 * (own[1] + other[0])).max(own[1]))] // proposes: which strips are tried
        }
    })
}

/// The whole forcing periods of a word.
fn turns(path: &Path) -> f64 {
    let far = path.sides.iter().filter(|&&side| side == Side::Far).count() as i64; // exact: a length
    0.5 * (path.half_turns + far) as f64 // exact: a half of a small integer
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chaos::quad::State;
    use crate::chaos::tried::{MAKINGS, Tried};
    use crate::watch::Unwatched;

    /// `D = 1.178121`, `e = 1/2`, about.
    fn law() -> Law {
        Law { gap: Ball::exact(1.178_121_25), restitution: Ball::exact(0.5) }
    }

    fn bases() -> [HSet; 2] {
        [
            HSet::new([0.77843, 1.234518], [0.02877, 0.082], [-0.0002976, 0.002596]),
            HSet::new([0.779603, 1.224294], [0.028826, 0.081513], [-0.0001488, 0.001298]),
        ]
    }

    fn words(law: &Law, bases: &[HSet]) -> Vec<Path> {
        Tried::new(law, bases, MAKINGS[0]).deepened((9, u64::MAX), &Unwatched).search.words
    }

    #[test]
    fn all_words_have_strips_that_are_apart() {
        let (law, bases) = (law(), bases());
        let words = words(&law, &bases);
        assert!(words.len() > 10, "{}", words.len());
        let found: Vec<Strip> = strips(&law, &bases, &words, &Unwatched).into_iter().flatten().collect();
        assert_eq!(found.len(), words.len());
        let own = |k: &usize, other: &usize| k < other && words[*k].from == words[*other].from;
        let pairs = (0..words.len()).flat_map(|k| (0..words.len()).map(move |other| (k, other)));
        let sides: Vec<Sides> = found.iter().map(Strip::sides).collect();
        assert!(
            pairs
                .filter(|(k, other)| own(k, other))
                .all(|(k, other)| sides[k].is_apart(&sides[other], &Frame::of(&bases[words[k].from])))
        );
    }

    /// States of strips fly in doubles as their words say, and come between bottom and top of the h-set, their sides beyond the edges.
    #[test]
    fn states_of_strips_fly_as_their_words_say() {
        let (law, bases) = (law(), bases());
        let words = words(&law, &bases);
        for (path, strip) in words.iter().zip(strips(&law, &bases, &words, &Unwatched)) {
            flies(&bases, path, &strip.expect("a strip").sides(), &law);
        }
    }

    /// So they do for parameters of a range that is a tenth of the breadth of an h-set, or so, with the sides that strips have there.
    #[test]
    fn states_of_strips_that_move_fly_as_their_words_say() {
        let (middle, bases) = (law(), bases().map(|base| base.wider(4.0)));
        let law = Law { gap: Ball::new(middle.gap.mid(), 4e-4), restitution: Ball::new(0.5, 2e-4) };
        let words = words(&middle, &bases[1..]);
        let found = strips(&law, &bases[1..], &words, &Unwatched);
        assert!(found.iter().flatten().count() > 4, "{}", found.iter().flatten().count());
        assert!(found.iter().flatten().any(|strip| strip.moved.iter().any(|moved| moved.by == [0, 1])));
        for (path, strip) in words.iter().zip(found) {
            let Some(strip) = strip else { continue };
            for [s, t] in [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0], [0.3, -0.6], [0.0, 0.0]] {
                let at = |all: Ball, part: f64| Ball::exact(all.mid() + part * all.rad());
                let own = Law { gap: at(law.gap, s), restitution: at(law.restitution, t) };
                let shift = [[s, 0.0], [t, 0.0]].map(|part| part.map(Ball::exact));
                let Sides { left, right } = strip.sides();
                flies(&bases[1..], path, &Sides { left: left.on(shift), right: right.on(shift) }, &own);
            }
        }
    }

    fn flies(bases: &[HSet], path: &Path, sides: &Sides, law: &Law) {
        let guess = Guess::new(law);
        let [from, to] = [path.from, path.to].map(|base| Frame::of(&bases[base]));
        let flown = |across: f64, height: f64| -> State {
            let [left, right] = [&sides.left, &sides.right].map(|side| side.at(Ball::exact(height)).mid());
            let xi = 0.5 * ((1.0 - across) * left + (1.0 + across) * right);
            let mut state = [0, 1].map(|i| from.centre[i] + xi * from.along[i] + height * from.across[i]);
            for side in &path.sides {
                let image = guess.map(state).expect("a flight");
                assert_eq!(image.side, *side);
                state = image.state;
            }
            to.seen([state[0] - turns(path) - to.centre[0], state[1] - to.centre[1]])
        };
        for j in -6..=6 {
            let at = |i: i32| flown(f64::from(i) / 4.0, f64::from(j) / 6.0);
            assert!((-4..=4).all(|i| at(i)[1].abs() < 1.0));
            let [a, b] = [at(-4)[0], at(4)[0]];
            assert!(a.abs() > 1.0 && b.abs() > 1.0 && a * b < 0.0, "{a} {b}");
        }
    }

    #[test]
    fn false_strips_are_not_proved() {
        let (law, bases) = (law(), bases());
        let words = words(&law, &bases);
        let found = strips(&law, &bases, &words, &Unwatched);
        for (path, strip) in words.iter().zip(&found).take(6) {
            let strip = strip.as_ref().expect("a strip");
            let frames = [path.from, path.to].map(|base| Frame::of(&bases[base]));
            let [from, to] = frames.each_ref();
            let word = Covering { base: &bases[path.to], frames: [from, to], path };
            let is_proved =
                |strip: &Strip| [true, false].into_iter().any(|rises| word.is_proved(&law, &strip.sides(), rises));
            assert!(is_proved(strip));
            let breadth = strip.right[0] - strip.left[0];
            for (left, right) in [(0.3, 0.0), (0.0, -0.3), (0.3, 0.3), (-0.3, -0.3)] {
                let mut other = strip.clone();
                other.left[0] += left * breadth;
                other.right[0] += right * breadth;
                assert!(!is_proved(&other), "{left} {right}");
            }
        }
    }
}
