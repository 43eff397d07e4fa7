//! The properties of a tangency that follow from a zero of a chain: Lemmas J5, J7 and J8 of `docs/proofs/tangency.md#J5`.

use super::beside::Sides;
use super::boxes::StateBounds;
use super::chain::Chain;
use super::flights::Least;
use super::saddle::{Saddle, resonances};
use super::unfolding::Unfolding;
use crate::chaos;
use crate::exact::Enclosure;
use crate::number::Enclosing;
use crate::periodic::precondition::Preconditioner;

/// The proved properties of a tangency, in the units of `docs/proofs/tangency.md`.
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
    /// For a family: bounds of the states between the manifolds; within them each member has one tangency only. Lemma J12
    pub states: Option<Vec<StateBounds>>,
    /// The common points on either side; `None` where they are not proved. Lemma J13
    pub beside: Option<Sides>,
}

/// The order up to which resonances are looked for.
pub(super) const MOST_ORDER: u32 = 100;
/// A phase in radians, a forcing period later if it is negative.
fn in_period<N: Enclosing>(phase: N) -> N {
    match phase.certain_sign() {
        Some(std::cmp::Ordering::Less) => phase.turn() + phase,
        _ => phase,
    }
}

/// Properties that follow from a chain and an enclosure of its zero, its flights proved. Lemmas J7, J8
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
