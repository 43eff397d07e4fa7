//! Bases, found from a floating orbit: parallelograms along the leaves of an attractor. What they lead to is proved.
//!
//! Labels: proposes throughout.

use std::f64::consts::TAU;

use super::entropy::entropy;
use super::flights::{Law, State, is_positive};
use super::guess::{Guess, applied};
use super::propose::Making;
use super::tube::side_of;
use super::words::{Base, Search, Tally};

/// Impacts before the orbit is looked at, and how many are.
const TRANSIENT: usize = 2000;
const LOOKED_AT: usize = 100_000;
/// Points of the orbit that bases are tried at.
const CENTRES: usize = 100;
/// Bases whose words are looked for.
const TRIED: usize = 40;
/// Boxes and depth of such a trial.
const BOXES: u64 = 40_000;
const DEPTH: usize = 24;
/// Half lengths, phases in radians, and half widths relative to them.
const LENGTHS: [f64; 7] = [0.3, 0.2, 0.13, 0.08, 0.05, 0.03, 0.015];
const WIDTHS: [f64; 7] = [0.001, 0.002, 0.005, 0.01, 0.02, 0.04, 0.08];
/// What a base more has to add, as a factor.
const WORTH: f64 = 1.01;
/// The most bases.
const MOST: usize = 6;
/// An orbit that expands less, an impact, is regular.
const LEAST_EXPONENT: f64 = 1e-3;

/// A floating orbit on what attracts it, phases modulo 1, with its expanding directions.
#[derive(Debug)]
pub(crate) struct Seen {
    pub points: Vec<(State, State)>,
    /// The Lyapunov exponent an impact.
    pub exponent: f64,
}

/// The floating orbit from a state; `None` where it ends.
pub(crate) fn seen(guess: &Guess, start: State) -> Option<Seen> {
    let (mut state, mut direction, mut sum) = (start, [1.0 / TAU, 0.3], 0.0);
    let mut points = Vec::with_capacity(LOOKED_AT);
    for k in 0..TRANSIENT + LOOKED_AT {
        let image = guess.map(state)?;
        let [u, w] = applied(image.jacobian, direction);
        let growth = (TAU * u).hypot(w);
        direction = [u / growth, w / growth];
        state = [image.state[0].rem_euclid(1.0), image.state[1]];
        if k >= TRANSIENT {
            sum += growth.ln();
            points.push((state, direction));
        }
    }
    Some(Seen { points, exponent: sum / LOOKED_AT as f64 })
}

impl Seen {
    /// Whether neighbours part.
    pub fn is_chaotic(&self) -> bool {
        self.exponent > LEAST_EXPONENT
    }

    /// Bases along the leaves, those first that the orbit crosses most often.
    fn candidates(&self, guess: &Guess) -> Vec<Base> {
        let mut scored: Vec<(f64, Base)> = Vec::new();
        for &(centre, along) in self.points.iter().step_by(self.points.len() / CENTRES) {
            let Some(across) = guess.contracting(centre) else { continue };
            let determinant = along[0] * across[1] - along[1] * across[0];
            if TAU * determinant.abs() < 0.2 {
                continue;
            }
            // `(xi, eta)` and the leaf's slope there.
            let told = |[u, w]: State| {
                [(u * across[1] - w * across[0]) / determinant, (along[0] * w - along[1] * u) / determinant]
            };
            let near: Vec<[f64; 3]> = self
                .points
                .iter()
                .filter_map(|&([u, w], direction)| {
                    let phase = u - centre[0];
                    let [xi, eta] = told([phase - phase.round(), w - centre[1]]);
                    let [run, rise] = told(direction);
                    (xi.abs() < LENGTHS[0] && eta.abs() < LENGTHS[0] * 0.1).then(|| [xi, eta, rise / run])
                })
                .collect();
            for length in LENGTHS {
                let best = WIDTHS
                    .iter()
                    .map(|width| {
                        let width = width * length;
                        let crosses = |&&[xi, eta, slope]: &&[f64; 3]| {
                            let at = |end: f64| (eta + slope * (end * 1.1 * length - xi)).abs() < 0.9 * width;
                            xi.abs() < length && eta.abs() < 0.9 * width && at(1.0) && at(-1.0)
                        };
                        let spoiled = |&&[xi, eta, _]: &&[f64; 3]| xi.abs() < length && eta.abs() < 1.2 * width;
                        let good = near.iter().filter(crosses).count() as f64;
                        let all = near.iter().filter(spoiled).count() as f64;
                        (good * (good / (all + 1.0)), width)
                    })
                    .fold((0.0, 0.0), |best, next| if next.0 > best.0 { next } else { best });
                if best.0 > 0.0 {
                    let base = Base::new(centre, along.map(|x| x * length), across.map(|x| x * best.1));
                    scored.push((best.0, base));
                }
            }
        }
        scored.sort_by(|a, b| b.0.total_cmp(&a.0));
        scored.into_iter().map(|(_, base)| base).filter(Base::is_convex).collect()
    }

    /// The bases that lead to most entropy, of those tried.
    pub fn bases(&self, law: &Law, making: Making, goes_on: &(dyn Fn() -> bool + Sync)) -> Vec<Base> {
        let candidates = self.candidates(&Guess::new(law));
        let worth = |bases: &[Base]| {
            let mut search = Search::new(law, bases, making);
            let within = |tally: Tally| tally.boxes < BOXES * bases.len() as u64 && goes_on();
            for _ in 0..DEPTH {
                if !search.deepen(&within) {
                    break;
                }
            }
            entropy(&search.words, bases.len(), |word| word.sides.len() as i64)
        };
        let mut best: (f64, Vec<Base>) = (0.0, Vec::new());
        while best.1.len() < MOST && goes_on() {
            let others: Vec<Base> =
                candidates.iter().filter(|base| best.1.iter().all(|other| base.is_apart(other))).copied().take(TRIED).collect();
            let mut better: Option<(f64, Vec<Base>)> = None;
            for base in others {
                let bases: Vec<Base> = best.1.iter().copied().chain([base]).collect();
                let found = worth(&bases);
                if found > better.as_ref().map_or(best.0 * WORTH, |better| better.0) {
                    better = Some((found, bases));
                }
            }
            let Some(next) = better else { break };
            best = next;
        }
        best.1
    }
}

impl Base {
    /// Whether it has no state in common with another one, whole turns later or earlier either: an edge parts them. Lemma U9
    pub fn is_apart(&self, other: &Self) -> bool {
        (-2..=2).all(|turns| self.is_parted(other, f64::from(turns)) || other.is_parted(self, f64::from(-turns)))
    }

    fn is_parted(&self, other: &Self, turns: f64) -> bool {
        let [one, two] = [self, other].map(|Self { left, right }| [left.bottom, right.bottom, right.top, left.top]);
        (0..4).any(|i| two.iter().all(|&state| is_positive(-side_of(one[i], one[(i + 1) % 4], state, turns))))
    }
}
