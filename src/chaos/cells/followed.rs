//! H-sets that are followed over a parameter: each moves with a saddle that it holds.
//!
//! Labels: proposes throughout.

use super::super::global::closed;
use super::super::guess::Guess;
use super::super::law::Law;
use super::super::quad::{Chord, State};
use super::super::vector::{cross, length, minus, times, unit};
use super::super::words::HSet;
use crate::number::Ball;

/// The most impacts of saddles that are looked for, and the places along the h-set from which they are, a half length being 1.
const MAX_SADDLE_IMPACTS: usize = 16;
const SADDLE_PLACES: [f64; 7] = [0.0, -0.25, 0.25, -0.5, 0.5, -0.75, 0.75];
/// The greatest change of `D` or `e` that is followed in one step.
const MAX_STEP: f64 = 5e-4;

/// A periodic state of saddle type, and the directions that expand and contract there, of unit length.
#[derive(Clone, Copy, Debug)]
struct Saddle {
    state: State,
    impacts: usize,
    directions: [State; 2],
}

/// H-sets at values of `D` and `e`, each with its saddle.
#[derive(Clone, Debug)]
pub(super) struct Followed {
    at: [f64; 2],
    held: Vec<(HSet, Saddle)>,
}

impl Saddle {
    /// Saddle that Newton's method leads to from a seed; `None` where it leads to none, or to an orbit that attracts.
    fn near(guess: &Guess, seed: State, impacts: usize) -> Option<Self> {
        let [phase, speed] = *closed(guess, seed, impacts)?.first()?;
        let state = [phase + (seed[0] - phase).round(), speed];
        Some(Self { state, impacts, directions: directions(derivative(guess, state, impacts)?)? })
    }

    /// The saddle at other values of the parameters.
    fn moved(&self, guess: &Guess) -> Option<Self> {
        let found = Self::near(guess, self.state, self.impacts)?;
        let along = |own: State, before: State| {
            let to = minus(own, before);
            let from = [own[0] + before[0], own[1] + before[1]];
            if length(to) < length(from) { own } else { own.map(|x| -x) }
        };
        let [expands, contracts] = [0, 1].map(|k| along(found.directions[k], self.directions[k]));
        Some(Self { directions: [expands, contracts], ..found })
    }

    /// State whose coordinates about the moved saddle `to` are those of `state` about this saddle.
    fn carried(&self, to: &Self, state: State) -> State {
        let [p, q] = self.directions;
        let away = minus(state, self.state);
        let [a, b] = [cross(away, q) / cross(p, q), cross(p, away) / cross(p, q)];
        [0, 1].map(|i| to.state[i] + a * to.directions[0][i] + b * to.directions[1][i])
    }
}

/// Jacobian of the `impacts`-th iterate.
fn derivative(guess: &Guess, state: State, impacts: usize) -> Option<[[f64; 2]; 2]> {
    let after = (0..impacts).try_fold((state, [[1.0, 0.0], [0.0, 1.0]]), |(state, product), _| {
        let image = guess.map(state)?;
        Some((image.state, times(image.jacobian, product)))
    });
    Some(after?.1)
}

/// The directions that a saddle's derivatives expand and contract; `None` if it is none.
fn directions([[a, b], [c, d]]: [[f64; 2]; 2]) -> Option<[State; 2]> {
    let (half, determinant) = (0.5 * (a + d), a * d - b * c);
    let root = (half * half - determinant).sqrt();
    let expands = if half > 0.0 { half + root } else { half - root };
    let contracts = determinant / expands;
    let of = |value: f64| {
        let (one, other) = ([b, value - a], [value - d, c]);
        unit(if length(one) > length(other) { one } else { other })
    };
    (expands.abs() > 1.0 && contracts.abs() < 1.0).then(|| [of(expands), of(contracts)])
}

impl HSet {
    /// The middle, and the half vectors along and across.
    fn axes(&self) -> [State; 3] {
        let [[a, b], [c, d]] = [self.left, self.right].map(|chord| [chord.bottom, chord.top]);
        let mean = |signs: [f64; 4]| {
            [0, 1].map(|i| 0.25 * (signs[0] * a[i] + signs[1] * b[i] + signs[2] * c[i] + signs[3] * d[i]))
        };
        [mean([1.0; 4]), mean([-1.0, -1.0, 1.0, 1.0]), mean([-1.0, 1.0, -1.0, 1.0])]
    }

    fn mapped(&self, function: impl Fn(State) -> State) -> Self {
        let chord = |chord: Chord| Chord { bottom: function(chord.bottom), top: function(chord.top) };
        Self { left: chord(self.left), right: chord(self.right) }
    }

    /// The saddle of fewest impacts that is found in it.
    fn saddle(&self, guess: &Guess) -> Option<Saddle> {
        let [middle, along, across] = self.axes();
        let is_inside = |saddle: &Saddle| {
            let away = minus(saddle.state, middle);
            let [a, b] = [cross(away, across), cross(along, away)].map(|x| x / cross(along, across));
            a.abs() < 1.0 && b.abs() < 1.0
        };
        let of = |impacts: usize| {
            let starts = SADDLE_PLACES.iter().map(|part| [0, 1].map(|i| middle[i] + part * along[i]));
            starts.filter_map(|state| Saddle::near(guess, state, impacts)).find(is_inside)
        };
        (1..=MAX_SADDLE_IMPACTS).find_map(of)
    }

    /// The h-set, wider by a factor.
    pub(in crate::chaos) fn wider(&self, factor: f64) -> Self {
        let chord = |Chord { bottom, top }: Chord| {
            let end = |sign: f64| [0, 1].map(|i| 0.5 * (bottom[i] + top[i] + sign * factor * (top[i] - bottom[i])));
            Chord { bottom: end(-1.0), top: end(1.0) }
        };
        Self { left: chord(self.left), right: chord(self.right) }
    }
}

impl Followed {
    /// H-sets at the middle of a law's parameters; `None` where one of them holds no saddle that is found.
    pub fn of(law: &Law, bases: &[HSet]) -> Option<Self> {
        let guess = Guess::new(law);
        let held = bases.iter().map(|base| Some((*base, base.saddle(&guess)?))).collect::<Option<_>>()?;
        Some(Self { at: [law.gap.mid(), law.restitution.mid()], held })
    }

    /// The h-sets at the middle of other parameters; `None` where a saddle is lost on the way.
    pub fn to(&self, law: &Law) -> Option<Self> {
        let end = [law.gap.mid(), law.restitution.mid()];
        let change = minus(end, self.at);
        let steps = change.iter().fold(1.0, |most: f64, x| most.max((x.abs() / MAX_STEP).ceil()));
        (1..=steps as u32).try_fold(self.clone(), |followed, step| {
            let part = f64::from(step) / steps;
            followed.at([0, 1].map(|i| self.at[i] + part * change[i]))
        })
    }

    fn at(&self, at: [f64; 2]) -> Option<Self> {
        let [gap, restitution] = at.map(Ball::exact);
        let guess = Guess::new(&Law { gap, restitution });
        let moved = |(base, saddle): &(HSet, Saddle)| {
            let to = saddle.moved(&guess)?;
            Some((base.mapped(|state| saddle.carried(&to, state)), to))
        };
        Some(Self { at, held: self.held.iter().map(moved).collect::<Option<_>>()? })
    }

    /// The h-sets.
    pub fn bases(&self) -> Vec<HSet> {
        self.held.iter().map(|(base, _)| *base).collect()
    }
}
