//! From a fold in floating point to a proved tangency: Lemmas J5-J9 of `docs/proofs/tangency.md#J5`.

use nalgebra::DVector;

use super::beside::{Sides, sides};
use super::boxes::StateBounds;
use super::chain::Chain;
use super::flight::{Pair, Parameter};
use super::flights::{Least, least};
use super::local::Local;
use super::manifold::Manifold;
use super::only::is_only;
use super::saddle::{Guessed, Saddle, Side, resonances};
use super::search::{Floats, Fold};
use super::unfolding::Unfolding;
use crate::chaos;
use crate::exact::{Enclosure, Exact};
#[cfg(feature = "multiprecision")]
use crate::number::MpBall;
use crate::number::{Ball, Enclosing};
use crate::periodic::Precision;
use crate::periodic::krawczyk::{Effort, Equations, Proved, prove};
use crate::periodic::precondition::{Jacobian, Preconditioner};

/// What is proved of a tangency, in the units of `docs/proofs/tangency.md`.
#[derive(Clone, Debug)]
pub(super) struct Proof {
    /// The value of the parameter.
    pub parameter: Enclosure,
    pub sigma: [Enclosure; 2],
    pub phase: Enclosure,
    pub speed: Enclosure,
    pub eigenvalues: [Enclosure; 2],
    pub quadratic: Enclosure,
    pub unfolding: Enclosure,
    pub least: Least,
    pub resonances: u32,
    pub flights: Vec<chaos::Side>,
    /// Of a family: bounds of the states between, of which there is one tangency only. Lemma J12
    pub states: Option<Vec<StateBounds>>,
    /// What is proved on either side. Lemma J13
    pub beside: Option<Sides>,
}

/// The parameter that is looked for, and the other one: a number, or all numbers of an interval.
#[derive(Clone, Debug)]
pub(super) struct Question {
    pub over: Parameter,
    pub other: Exact,
    pub precision: Precision,
}

/// Steps of Newton's iteration, the largest one, and when it has ended.
const STEPS: u32 = 40;
const LARGEST_STEP: f64 = 0.05;
const ENOUGH: f64 = 1e-12;
/// A parameter of a manifold is at most that part of the radius for which it is proved.
const PART: f64 = 0.125;
/// The radii of `D` for which the manifolds are proved, and of the largest domain.
pub(super) const REACH: f64 = 1.0 / 8192.0;
const DOMAIN: f64 = 1.0 / 65_536.0;
/// How much wider than the radii of the enclosures the bounds are within which there is no other tangency: more than printing adds (Lemma P1),
/// and the change of units.
const WIDER: f64 = 8.0;
/// The order up to which resonances are looked for.
pub(super) const MOST_ORDER: u32 = 100;
/// The error of a series in doubles.
const ERROR: f64 = 1e-17;

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

/// A phase in radians, a forcing period later if it is negative.
fn in_period<N: Enclosing>(phase: N) -> N {
    match phase.certain_sign() {
        Some(std::cmp::Ordering::Less) => phase.turn() + phase,
        _ => phase,
    }
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
        let mut matrix = nalgebra::DMatrix::<f64>::zeros(x.len(), x.len());
        for (i, j, value) in chain.jacobian(&at)?.entries() {
            matrix[(i, j)] += value.mid();
        }
        let mut step = -matrix.lu().solve(&misses)?;
        let size = step.amax();
        if !size.is_finite() {
            return None;
        }
        if size > LARGEST_STEP {
            step *= LARGEST_STEP / size;
        }
        x.iter_mut().zip(step.iter()).for_each(|(x, step)| *x += step);
        if size < ENOUGH {
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

/// The same, its section chosen so that both parameters are small.
fn approximate(fold: &Fold, over: Parameter, reach: f64) -> Option<(Fold, [Local; 2])> {
    let mut found = settled(fold, over)?;
    let Fold { pair, guess, .. } = found;
    let reaches = Pair::of(over, REACH, reach);
    let locals = [Side::Unstable, Side::Stable].map(|side| Local::prove(pair, reaches, &guess, side));
    let [Some(unstable), Some(stable)] = locals else { return None };
    while found.sigma[0].abs() > PART * unstable.radius {
        found.sigma[0] /= guess.lambda[0];
        found.flights.insert(0, chaos::Side::Far);
    }
    while found.sigma[1].abs() > PART * stable.radius {
        found.sigma[1] *= guess.lambda[1];
        found.flights.push(chaos::Side::Far);
    }
    Some((found, [unstable, stable]))
}

/// The saddle of the same kind.
fn nearest(pair: Pair<f64>, guess: &Guessed) -> Option<Guessed> {
    let apart = |other: &Guessed| (other.theta - guess.theta).abs();
    Guessed::all(pair).into_iter().min_by(|a, b| apart(a).total_cmp(&apart(b))) // proposes
}

/// The chain in another arithmetic, its series so long that they err by no more than that.
fn chain_in<N: Enclosing>(chain: &Chain<Ball>, other: N, (locals, x): (&[Local; 2], &[f64]), error: f64) -> Chain<N> {
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

/// A zero proved in doubles, with what is needed to narrow it.
pub(super) struct InDoubles {
    pub chain: Chain<Ball>,
    locals: [Local; 2],
    pub inverse: Preconditioner,
    pub x: Vec<f64>,
    pub zero: Proved<Ball>,
    pub least: Least,
}

/// A chain whose manifolds are proved for the other parameter as well, as far as `reach`, and its zero in floating point.
pub(super) struct Begun {
    pub chain: Chain<Ball>,
    pub locals: [Local; 2],
    pub inverse: Preconditioner,
    pub x: Vec<f64>,
}

impl Begun {
    pub fn new(fold: &Fold, over: Parameter, other: Ball, reach: f64) -> Option<Self> {
        let (fold, locals) = approximate(fold, over, reach)?;
        let (chain, x) = begin(&fold, over)?;
        let x = settle(&chain, x)?;
        let chain = chain_in(&chain, other, (&locals, &x), ERROR);
        let middle = Chain { other: other.centre(), ..chain.clone() };
        let inverse = inverse(&middle, &x)?;
        Some(Self { chain, locals, inverse, x })
    }
}

pub(super) fn in_doubles(fold: &Fold, over: Parameter, other: Ball) -> Option<InDoubles> {
    const FARTHER: f64 = 4.0;
    let Begun { chain, locals, inverse, x } = Begun::new(fold, over, other, FARTHER * other.rad())?;
    let effort = Effort { largest: DOMAIN, domains: 10, images: 30, slow: 3 };
    let zero = prove(&chain, &inverse, &points(&x), effort)?;
    let least = least(&chain, &zero.domain)?;
    Some(InDoubles { chain, locals, inverse, x, zero, least })
}

/// What follows of a chain and an enclosure of its zero, its flights proved. Lemmas J7, J8
pub(super) fn conclude<N: Enclosing>(
    chain: &Chain<N>,
    inverse: &Preconditioner,
    at: &[N],
    least: Least,
) -> Option<Proof> {
    let saddle = Saddle::new(&chain.pair(at), chain.over, &chain.manifolds[0].guess)?;
    let eigenvalues = saddle.lambda.each_ref().map(|x| x.value.as_ball());
    let resonances = resonances(eigenvalues, MOST_ORDER)?;
    let Unfolding { quadratic, unfolding } = Unfolding::new(chain, inverse, at)?;
    if quadratic.certain_sign()?.is_eq() || unfolding.certain_sign()?.is_eq() {
        return None;
    }
    let [unstable, stable] = saddle.lambda.each_ref().map(|x| x.value.as_enclosure());
    Some(Proof {
        parameter: at[2].as_enclosure()?,
        sigma: [at[0].as_enclosure()?, at[1].as_enclosure()?],
        phase: in_period(saddle.theta.value).as_enclosure()?,
        speed: saddle.speed.value.as_enclosure()?,
        eigenvalues: [unstable?, stable?],
        quadratic: quadratic.as_enclosure()?,
        unfolding: unfolding.as_enclosure()?,
        least,
        resonances,
        flights: chain.flights.clone(),
        states: None,
        beside: None,
    })
}

impl InDoubles {
    /// The zero is the only one within its bounds (Lemma J6), and what follows of it.
    fn conclude<N: Enclosing>(&self, chain: &Chain<N>, at: &[N]) -> Option<Proof> {
        let own: Vec<Ball> = at.iter().map(Enclosing::as_ball).collect();
        let is_theirs = own.iter().zip(&self.zero.domain).all(|(x, domain)| x.is_interior_to(domain));
        let within = [0, 1, 2].map(|i| WIDER * at[i].spread().as_ball().mag());
        if !is_theirs || !is_only(&self.chain, &self.zero.domain, &own, within)? {
            return None;
        }
        conclude(chain, &self.inverse, at, self.least)
    }

    /// The same in more bits.
    #[cfg(feature = "multiprecision")]
    fn precisely(&self, other: &Exact, bits: u32) -> Option<Proof> {
        let other = MpBall::enclosing(&other.enclose(bits), bits);
        let error = (24.0 - f64::from(bits)).exp2(); // proposes
        let chain = chain_in(&self.chain, other, (&self.locals, &self.x), error);
        let guess: Vec<MpBall> = self.x.iter().map(|x| MpBall::from_f64_bits(*x, bits)).collect();
        let polished = crate::periodic::krawczyk::polish(&chain, &self.inverse, guess, bits / 16);
        let effort = Effort { largest: (48.0 - f64::from(bits)).exp2(), domains: 1, images: 8, slow: 1 };
        let zero = prove(&chain, &self.inverse, &polished, effort)?;
        self.conclude(&chain, &zero.at)
    }
}

/// Proves the tangency near a fold, as narrow as requested if the precision suffices; `None` where nothing is proved. Of an interval of the
/// other parameter the bounds hold the tangencies of all its members.
pub(super) fn tangency(fold: &Fold, question: &Question) -> Option<Proof> {
    let Question { over, other, precision } = question;
    if !other.is_point() {
        return super::family::tangency(fold, *over, Ball::of(other));
    }
    let found = in_doubles(fold, *over, Ball::of(other))?;
    let is_narrow = |proof: &Proof| {
        let width = |x: &Enclosure| x.wid().top().map_or(f64::NEG_INFINITY, |top| top as f64); // exact: an exponent
        let requested = -std::f64::consts::LOG2_10 * f64::from(precision.digits);
        [&proof.parameter, &proof.sigma[0], &proof.sigma[1]].into_iter().all(|x| width(x) <= requested)
    };
    let with_sides = |proof: Option<Proof>| Some(Proof { beside: sides(&found), ..proof? });
    #[cfg(feature = "multiprecision")]
    {
        let mut bits = 128 + (f64::from(precision.digits) * 3.33) as u32; // proposes
        while bits <= precision.max_bits {
            if let Some(proof) = found.precisely(other, bits).filter(is_narrow) {
                return with_sides(Some(proof));
            }
            bits *= 2;
        }
    }
    with_sides(found.conclude(&found.chain, &found.zero.at).filter(is_narrow))
}
