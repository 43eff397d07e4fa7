//! Folds of the unstable manifold near the stable one, in floating point.
//!
//! Labels: proposes throughout.

use std::cell::Cell;
use std::f64::consts::{PI, TAU};

use super::flight::Pair;
use super::saddle::{Guessed, Side as Manifold};
use super::series::{Base, Series};
use crate::chaos::{Guess, Image, Law, Side, State};
use crate::number::Ball;
use crate::watch::{Stage, Watch};

/// The manifolds of one pair.
pub(super) struct Floats {
    pair: Pair<f64>,
    map: Guess,
    pub guess: Guessed,
    unstable: Series<f64>,
    stable: Series<f64>,
    /// Number of flights that are computed so far.
    computed: Cell<usize>,
}

/// A point at which the image of the unstable manifold is about parallel to the stable one.
#[derive(Clone, Debug)]
pub(super) struct Fold {
    pub pair: Pair<f64>,
    pub guess: Guessed,
    pub flights: Vec<Side>,
    pub sigma: [f64; 2],
    /// Distance of the point from the stable manifold.
    pub distance: f64,
}

/// Phases in radians and speeds along the flights of a fold, with tangents of about length 1 and their scales.
pub(super) struct Along {
    pub states: Vec<[f64; 2]>,
    pub tangents: Vec<[f64; 2]>,
    pub scales: Vec<i32>,
    pub turns: f64,
    pub stretch: f64,
}

/// A point of the unstable manifold, followed for some flights.
#[derive(Clone, Copy)]
struct Sample {
    sigma: f64,
    state: State,
}

/// Order of the series.
const SERIES_ORDER: usize = 16;
/// The range of parameters of the unstable manifold that is searched, and of the stable one.
const MIN_UNSTABLE: f64 = 1e-6;
const MAX_UNSTABLE: f64 = 0.02;
const MAX_STABLE: f64 = 0.15;
/// Samples on either side at first, the distance of images up to which none is put between, and the most there are.
const FIRST_SAMPLES: u32 = 200;
const FINE_DISTANCE: f64 = 0.02;
const MOST_SAMPLES: usize = 40_000;
/// Least distance of two samples, relative.
const MIN_SAMPLE_DISTANCE: f64 = 1e-13;
/// The farthest fold from the stable manifold that is of use.
const MAX_FOLD_DISTANCE: f64 = 0.2;

impl Floats {
    /// The manifolds of a saddle.
    pub fn new(pair: Pair<f64>, guess: Guessed) -> Option<Self> {
        let e = pair.restitution;
        let law = Law { gap: Ball::exact(pair.gap), restitution: Ball::exact(e) };
        let (sin, cos) = guess.theta.sin_cos();
        let series = |lambda: f64| {
            let base = Base { theta: guess.theta, speed: guess.speed, sin, cos, lambda, restitution: e, pi: PI };
            Series::new(&base, SERIES_ORDER)
        };
        let [unstable, stable] = [series(guess.lambda[0])?, series(guess.lambda[1])?];
        Some(Self { pair, map: Guess::new(&law), guess, unstable, stable, computed: Cell::new(0) })
    }

    fn series(&self, side: Manifold) -> &Series<f64> {
        match side {
            Manifold::Unstable => &self.unstable,
            Manifold::Stable => &self.stable,
        }
    }

    /// A point of a manifold, and its derivative: phase in radians.
    pub fn point(&self, side: Manifold, sigma: f64) -> [[f64; 2]; 2] {
        let [at, along, _] = self.series(side).at(&sigma);
        [at, along]
    }

    /// The next flight.
    fn flight(&self, state: State) -> Option<Image> {
        self.computed.set(self.computed.get() + 1);
        self.map.map(state)
    }

    /// The state after the next flight, phases in radians.
    pub fn next(&self, [theta, w]: [f64; 2]) -> Option<[f64; 2]> {
        let [u, w] = self.flight([theta / TAU, w])?.state;
        Some([TAU * u, w])
    }

    /// A state, phases in radians, after some flights.
    pub fn image(&self, [theta, w]: [f64; 2], flights: &[Side]) -> Option<[f64; 2]> {
        let mut state = [theta / TAU, w];
        for side in flights {
            state = self.flight(state).filter(|image| image.side == *side)?.state;
        }
        Some([TAU * state[0], state[1]])
    }

    /// A point of the unstable manifold after some flights; `None` where they end on other walls.
    fn after(&self, sigma: f64, flights: &[Side]) -> Option<Sample> {
        let [[theta, w], _] = self.point(Manifold::Unstable, sigma);
        let mut state = [theta / TAU, w];
        for side in flights {
            let image = self.flight(state)?;
            if image.side != *side {
                return None;
            }
            state = image.state;
        }
        Some(Sample { sigma, state })
    }

    /// The parameter along the stable manifold, and the distance from it along the unstable direction.
    fn across(&self, [u, w]: State) -> Option<[f64; 2]> {
        let theta = TAU * u;
        let whole = TAU * ((theta - self.guess.theta) / TAU).round();
        let [_, [_, direction]] = self.point(Manifold::Unstable, 0.0);
        let mut at = [theta - whole - self.guess.theta, 0.0];
        for _ in 0..12 {
            let [[p, q], [dp, dq]] = self.point(Manifold::Stable, at[0]);
            let miss = [theta - whole - p - at[1], w - q - at[1] * direction];
            let determinant = dp * direction - dq;
            let step = [(miss[0] * direction - miss[1]) / determinant, (dp * miss[1] - dq * miss[0]) / determinant];
            at = [at[0] + step[0], at[1] + step[1]];
            if !(at[0].abs() < MAX_STABLE && at[1].abs() < MAX_FOLD_DISTANCE) {
                return None;
            }
        }
        Some(at)
    }

    /// Puts samples between those whose images are far apart or on different walls.
    fn refined(&self, samples: &[Sample], flights: &[Side]) -> Vec<Vec<Sample>> {
        let (before, next) = (&flights[..flights.len() - 1], flights[flights.len() - 1]);
        let image = |sample: &Sample| self.flight(sample.state).map(|image| (image.side, image.state));
        let mut all: Vec<Vec<Sample>> = vec![Vec::new()];
        let mut stack: Vec<Sample> = samples.iter().rev().copied().collect();
        let mut count = 0;
        while let Some(a) = stack.pop() {
            count += 1;
            let here = image(&a).filter(|(side, _)| *side == next);
            if let Some((_, state)) = here {
                all.last_mut().expect("one").push(Sample { sigma: a.sigma, state });
            }
            let Some(b) = stack.last() else { break };
            let there = image(b).filter(|(side, _)| *side == next);
            let far = match (&here, &there) {
                (Some((_, x)), Some((_, y))) => (TAU * (x[0] - y[0])).abs().max((x[1] - y[1]).abs()) > FINE_DISTANCE,
                (None, None) => false,
                _ => (a.sigma - b.sigma).abs() > 1e-3 * (samples[0].sigma - samples[samples.len() - 1].sigma).abs(),
            };
            let near = (a.sigma - b.sigma).abs() < MIN_SAMPLE_DISTANCE * a.sigma.abs();
            if far
                && !near
                && count < MOST_SAMPLES
                && let Some(middle) = self.after(0.5 * (a.sigma + b.sigma), before)
            {
                stack.push(middle);
                stack.push(a);
                if here.is_some() {
                    all.last_mut().expect("one").pop();
                }
                continue;
            }
            if here.is_some() != there.is_some() || far {
                all.push(Vec::new());
            }
        }
        all.into_iter().filter(|piece| piece.len() > 1).collect()
    }

    /// The unstable manifold on both sides of the fixed point, from a parameter on.
    fn begin(&self, least: f64) -> Vec<Vec<Sample>> {
        let ratio = (MAX_UNSTABLE / least).powf(1.0 / f64::from(FIRST_SAMPLES));
        let side = |sign: f64| {
            (0..=FIRST_SAMPLES).filter_map(|i| self.after(sign * least * ratio.powi(i as i32), &[])).collect()
        };
        vec![side(1.0), side(-1.0)]
    }

    /// The folds of the unstable manifold along a word, the nearest to the stable one first.
    pub fn folds(&self, flights: &[Side]) -> Vec<Fold> {
        let mut pieces = self.begin(MIN_UNSTABLE);
        for n in 1..=flights.len() {
            pieces = pieces.iter().flat_map(|piece| self.refined(piece, &flights[..n])).collect();
        }
        let mut found: Vec<Fold> = pieces.iter().flat_map(|piece| self.of_piece(flights, piece)).collect();
        found.sort_by(|a, b| a.distance.abs().total_cmp(&b.distance.abs()));
        found
    }

    /// Folds along all words of at most `longest` flights, and whether all words were searched: the search takes at most `work` flights.
    pub fn all_folds(&self, longest: usize, work: usize, watch: &dyn Watch) -> (Vec<Fold>, bool) {
        // A fundamental domain: what lies nearer comes to it.
        let begun = self.begin(MAX_UNSTABLE / (self.guess.lambda[0] * self.guess.lambda[0]));
        let mut stack: Vec<(Vec<Side>, Vec<Sample>)> = begun.into_iter().map(|piece| (Vec::new(), piece)).collect();
        let (mut found, mut searched) = (Vec::new(), 0);
        while let Some((flights, piece)) = stack.pop() {
            searched += 1;
            if self.computed.get() > work || watch.proceed(Stage::Folds(searched)).is_break() {
                return (found, false);
            }
            found.extend(self.of_piece(&flights, &piece));
            if flights.len() >= longest {
                continue;
            }
            for side in [Side::Far, Side::Near] {
                let next = [&flights[..], &[side]].concat();
                stack.extend(self.refined(&piece, &next).into_iter().map(|piece| (next.clone(), piece)));
            }
        }
        (found, true)
    }

    /// The folds of a piece of the unstable manifold, near the stable one.
    fn of_piece(&self, flights: &[Side], piece: &[Sample]) -> Vec<Fold> {
        let at: Vec<Option<[f64; 2]>> = piece.iter().map(|sample| self.across(sample.state)).collect();
        let mut found = Vec::new();
        for i in 1..piece.len().max(1) - 1 {
            let (Some([_, a]), Some([_, b]), Some([_, c])) = (at[i - 1], at[i], at[i + 1]) else { continue };
            if (b - a) * (c - b) <= 0.0 {
                found.extend(self.extremum(flights, [piece[i - 1].sigma, piece[i + 1].sigma]));
            }
        }
        found
    }

    /// The fold between two parameters, by thirds.
    fn extremum(&self, flights: &[Side], [mut low, mut high]: [f64; 2]) -> Option<Fold> {
        let of = |sigma: f64| self.across(self.after(sigma, flights)?.state);
        let middle = of(0.5 * (low + high))?[1];
        let sign = if middle > 0.5 * (of(low)?[1] + of(high)?[1]) { 1.0 } else { -1.0 };
        for _ in 0..60 {
            let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if sign * of(a)?[1] > sign * of(b)?[1] { high = b } else { low = a }
        }
        let sigma = 0.5 * (low + high);
        let [along, distance] = of(sigma)?;
        Some(Fold { pair: self.pair, guess: self.guess, flights: flights.to_vec(), sigma: [sigma, along], distance })
    }

    /// The states along a fold, with their tangents.
    pub fn along(&self, fold: &Fold) -> Option<Along> {
        let [[theta, w], mut tangent] = self.point(Manifold::Unstable, fold.sigma[0]);
        let mut state = [theta / TAU, w];
        let (mut states, mut tangents, mut scales) = (vec![[theta, w]], vec![tangent], vec![0]);
        let mut scale = 0;
        for side in &fold.flights {
            let image = self.flight(state)?;
            if image.side != *side {
                return None;
            }
            let [[a, b], [c, d]] = image.jacobian;
            tangent = [a * tangent[0] + TAU * b * tangent[1], c / TAU * tangent[0] + d * tangent[1]];
            let size = tangent[0].hypot(tangent[1]).log2().round() as i32;
            tangent = tangent.map(|x| x * f64::from(-size).exp2());
            scale -= size;
            state = image.state;
            states.push([TAU * state[0], state[1]]);
            tangents.push(tangent);
            scales.push(scale);
        }
        let [[theta, _], along] = self.point(Manifold::Stable, fold.sigma[1]);
        let turns = ((TAU * state[0] - theta) / TAU).round();
        let stretch = (tangent[0] * along[0] + tangent[1] * along[1]) / (along[0].powi(2) + along[1].powi(2));
        Some(Along { states, tangents, scales, turns, stretch })
    }
}
