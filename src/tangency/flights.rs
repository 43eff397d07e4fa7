//! First contacts of all flights of a homoclinic orbit, with lower bounds of their speeds and times: Lemma J9 of `docs/proofs/tangency.md#J9`.

use super::boxes::low;
use super::chain::Chain;
use super::flight::{Pair, State, sin_cos};
use crate::chaos::{Flights, Law, Quad, Side};
use crate::number::{Ball, Number, is_positive};

/// Lower bounds over a homoclinic orbit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Least {
    /// A lower bound of speeds, in `A W`.
    pub speed: f64,
    /// A lower bound of times of flight, in radians.
    pub time: f64,
}

/// The lesser of two bounds; `None` where a bound is not positive, or NaN.
fn lesser(bound: f64, x: f64) -> Option<f64> {
    is_positive(x).then_some(if x < bound { x } else { bound })
}

/// Whether all flights from a box are proved to be first contacts, for the zeros of `g` whose phases are in a second box's.
fn is_first(pair: &Pair<Ball>, [theta, w]: State<Ball>, [phi, _]: State<Ball>, side: Side) -> Option<bool> {
    let turn = theta.turn();
    let [start, end] = [theta.checked_div(turn)?, phi.checked_div(turn)?];
    let quad = Quad::rectangle([start.mid(), w.mid()], [start.rad(), w.rad()], low(w));
    let law = Law { gap: pair.gap, restitution: pair.restitution };
    let Some(landing) = Flights::new(&law, &quad).land(side, end.mid() - side.shift()) else { return Some(false) };
    let contacts = landing.along([Ball::exact(1.0), Ball::exact(0.0)], [Ball::exact(0.0); 2]);
    // Both in one ball, over which the speed towards the wall is positive: they are the same contacts.
    let apart = (contacts - end).mag() + contacts.rad();
    let arrivals = turn * end.widened(apart).widened(contacts.rad());
    let drift = pair.restitution * w + sin_cos(&theta)?.1;
    let speed = drift.signed(side.sign()) + sin_cos(&arrivals)?.1;
    Some(is_positive(low(speed)))
}

/// Proves the flights of the chain over a box of unknowns, and those of the manifolds to the fixed point. Lemma J9
pub(super) fn least(chain: &Chain<Ball>, domain: &[Ball]) -> Option<Least> {
    let pair = chain.pair(domain);
    let mut all: Vec<(State<Ball>, State<Ball>, Side)> = Vec::new();
    let states: Vec<State<Ball>> = chain.states(domain)?.into_iter().map(|state| state.map(|x| x.value)).collect();
    for (k, side) in chain.flights.iter().enumerate() {
        all.push((states[k], states[k + 1], *side));
    }
    for (manifold, sigma) in chain.manifolds.iter().zip(domain) {
        let part = manifold.at(&pair, chain.over, &Ball::new(0.0, sigma.mag()))?.at.map(|x| x.value);
        all.push((part, [part[0] + part[0].turn(), part[1]], Side::Far));
    }
    let mut least = Least { speed: f64::INFINITY, time: f64::INFINITY };
    for (from, to, side) in all {
        if !is_first(&pair, from, to, side)? {
            return None;
        }
        let half = if side == Side::Far { 0.5 } else { 0.0 };
        let time = to[0] - from[0] - Ball::exact(half) * to[0].turn();
        least.speed = lesser(lesser(least.speed, low(from[1]))?, low(to[1]))?;
        least.time = lesser(least.time, low(time))?;
    }
    Some(least)
}
