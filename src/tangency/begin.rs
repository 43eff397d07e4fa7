//! The chain of a fold in floating point, and its zero, proved in doubles: Lemma J5 of `docs/proofs/tangency.md#J5`.

use nalgebra::DVector;

use super::chain::Chain;
use super::flight::{Pair, Parameter};
use super::flights::{Least, least};
use super::local::Local;
use super::manifold::Manifold;
use super::saddle::{Guessed, Side};
use super::search::{Floats, Fold};
use crate::chaos;
use crate::number::{Ball, Enclosing};
use crate::periodic::krawczyk::{Equations, Limits, Proved, prove};
use crate::periodic::precondition::Preconditioner;

/// Greatest number of steps of Newton's iteration, the largest step, and the size of the last step.
const STEPS: u32 = 40;
const LARGEST_STEP: f64 = 0.05;
const STEP_TOLERANCE: f64 = 1e-12;
/// Greatest parameter of a manifold, relative to the radius for which the manifold is proved.
const PARAMETER_PART: f64 = 0.125;
/// The radii of `D` for which the manifolds are proved, and of the largest domain.
pub(super) const MANIFOLD_RADIUS: f64 = 1.0 / 8192.0;
const MAX_DOMAIN: f64 = 1.0 / 65_536.0;
/// The error of a series in doubles.
const SERIES_ERROR: f64 = 1e-17;

/// The manifolds, for floating point.
fn manifolds(guess: Guessed) -> [Manifold; 2] {
    [Side::Unstable, Side::Stable].map(|side| Manifold { side, guess, order: 16, local: None })
}

/// The chain along a fold, and its unknowns.
fn begin(fold: &Fold, over: Parameter) -> Option<(Chain<Ball>, Vec<f64>)> {
    let along = Floats::new(fold.pair, fold.guess)?.along(fold)?;
    let mut x = vec![fold.sigma[0], fold.sigma[1], *fold.pair.value(over), along.stretch];
    for (state, tangent) in along.states.iter().zip(&along.tangents).take(fold.flights.len()).skip(1) {
        x.extend(state.iter().chain(tangent));
    }
    let chain = Chain {
        over,
        other: Ball::exact(*fold.pair.value(over.other())),
        flights: fold.flights.clone(),
        turns: along.turns,
        scales: along.scales,
        manifolds: manifolds(fold.guess),
    };
    Some((chain, x))
}

pub(super) fn points(x: &[f64]) -> Vec<Ball> {
    x.iter().map(|x| Ball::exact(*x)).collect()
}

/// The approximate inverse at these doubles.
fn inverse(chain: &Chain<Ball>, x: &[f64]) -> Option<Preconditioner> {
    Preconditioner::new(&chain.jacobian(&points(x))?.map(|x| x.mid()))
}

/// Newton's iteration; proposes.
pub(super) fn settle(chain: &Chain<Ball>, mut x: Vec<f64>) -> Option<Vec<f64>> {
    for _ in 0..STEPS {
        // The fixed point follows the parameter.
        let at = points(&x);
        let misses = DVector::from_iterator(x.len(), chain.values(&at)?.into_iter().map(Ball::mid));
        let matrix = chain.jacobian(&at)?.map(|x| x.mid());
        let mut step = -matrix.dense().lu().solve(&misses)?;
        let size = step.amax();
        if !size.is_finite() {
            return None;
        }
        if size > LARGEST_STEP {
            step *= LARGEST_STEP / size;
        }
        x.iter_mut().zip(step.iter()).for_each(|(x, step)| *x += step);
        if size < STEP_TOLERANCE {
            return Some(x);
        }
    }
    None
}

/// The tangency near a fold, in floating point.
pub(super) fn settled(fold: &Fold, over: Parameter) -> Option<Fold> {
    let (chain, x) = begin(fold, over)?;
    let x = settle(&chain, x)?;
    let pair = Pair::of(over, x[2], *fold.pair.value(over.other()));
    let guess = nearest(pair, &fold.guess)?;
    Some(Fold { pair, guess, flights: fold.flights.clone(), sigma: [x[0], x[1]], distance: 0.0 })
}

/// The tangency near a fold, and its manifolds, with a section chosen so that both parameters are small.
fn approximate(fold: &Fold, over: Parameter, reach: f64) -> Option<(Fold, [Local; 2])> {
    let mut found = settled(fold, over)?;
    let Fold { pair, guess, .. } = found;
    let reaches = Pair::of(over, MANIFOLD_RADIUS, reach);
    let locals = [Side::Unstable, Side::Stable].map(|side| Local::prove(pair, reaches, &guess, side));
    let [Some(unstable), Some(stable)] = locals else { return None };
    while found.sigma[0].abs() > PARAMETER_PART * unstable.radius {
        found.sigma[0] /= guess.lambda[0];
        found.flights.insert(0, chaos::Side::Far);
    }
    while found.sigma[1].abs() > PARAMETER_PART * stable.radius {
        found.sigma[1] *= guess.lambda[1];
        found.flights.push(chaos::Side::Far);
    }
    Some((found, [unstable, stable]))
}

/// The saddle nearest in phase to a guess.
fn nearest(pair: Pair<f64>, guess: &Guessed) -> Option<Guessed> {
    let apart = |other: &Guessed| (other.theta - guess.theta).abs();
    Guessed::all(pair).into_iter().min_by(|a, b| apart(a).total_cmp(&apart(b))) // proposes
}

/// The chain in another arithmetic, with series of an order at which their error is at most `error`.
pub(super) fn chain_in<N: Enclosing>(
    chain: &Chain<Ball>,
    other: N,
    (locals, x): (&[Local; 2], &[f64]),
    error: f64,
) -> Chain<N> {
    let [a, b] = chain.manifolds;
    let with = |manifold: Manifold, local: Local, sigma: f64| Manifold {
        order: Manifold::order_for(&local, sigma.abs(), error),
        local: Some(local),
        ..manifold
    };
    Chain {
        over: chain.over,
        other,
        flights: chain.flights.clone(),
        turns: chain.turns,
        scales: chain.scales.clone(),
        manifolds: [with(a, locals[0], x[0]), with(b, locals[1], x[1])],
    }
}

/// A zero proved in doubles, with the data to narrow it.
pub(super) struct InDoubles {
    pub chain: Chain<Ball>,
    pub locals: [Local; 2],
    pub inverse: Preconditioner,
    pub x: Vec<f64>,
    pub zero: Proved<Ball>,
    pub least: Least,
}

/// A chain whose manifolds are proved for the other parameter as well, as far as `reach`, and its zero in floating point.
pub(super) struct ExtendedChain {
    pub chain: Chain<Ball>,
    pub locals: [Local; 2],
    pub inverse: Preconditioner,
    pub x: Vec<f64>,
}

impl ExtendedChain {
    pub fn new(fold: &Fold, over: Parameter, other: Ball, reach: f64) -> Option<Self> {
        let (fold, locals) = approximate(fold, over, reach)?;
        let (chain, x) = begin(&fold, over)?;
        let x = settle(&chain, x)?;
        let chain = chain_in(&chain, other, (&locals, &x), SERIES_ERROR);
        let middle = Chain { other: other.centre(), ..chain.clone() };
        let inverse = inverse(&middle, &x)?;
        Some(Self { chain, locals, inverse, x })
    }
}

pub(super) fn in_doubles(fold: &Fold, over: Parameter, other: Ball) -> Option<InDoubles> {
    const OUTER_FACTOR: f64 = 4.0;
    let ExtendedChain { chain, locals, inverse, x } =
        ExtendedChain::new(fold, over, other, OUTER_FACTOR * other.rad())?;
    let limits = Limits { largest: MAX_DOMAIN, domains: 10, images: 30, slow: 3 };
    let zero = prove(&chain, &inverse, &points(&x), limits)?;
    let least = least(&chain, &zero.domain)?;
    Some(InDoubles { chain, locals, inverse, x, zero, least })
}
