//! Tangencies for all values of an interval of the other parameter: Lemma J12 of `docs/proofs/tangency.md#J12`.

use super::begin::{ExtendedChain, MANIFOLD_RADIUS, points};
use super::boxes;
use super::chain::{Chain, FIRST_STATE};
use super::flight::Parameter;
use super::flights::least;
use super::proof::{Proof, conclude};
use super::search::Fold;
use crate::number::{Ball, Enclosing};
use crate::periodic::entries::Entries;
use crate::periodic::krawczyk::{Equations, Limits, prove_inflating};
use crate::periodic::precondition::Preconditioner;

/// A chain whose last unknown is the other parameter; the last equation is that it has a value in this ball.
pub(super) struct Family<'c> {
    pub chain: &'c Chain<Ball>,
    pub other: Ball,
}

impl Family<'_> {
    /// The chain at a value of the other parameter, which is the last unknown.
    fn chain<'x>(&self, x: &'x [Ball]) -> Option<(Chain<Ball>, &'x [Ball])> {
        let (other, x) = x.split_last()?;
        Some((Chain { other: *other, ..self.chain.clone() }, x))
    }
}

impl Equations<Ball> for Family<'_> {
    fn values(&self, x: &[Ball]) -> Option<Vec<Ball>> {
        let (chain, own) = self.chain(x)?;
        let mut values = chain.values(own)?;
        values.push(*x.last()? - self.other);
        Some(values)
    }

    fn jacobian(&self, x: &[Ball]) -> Option<Entries<Ball>> {
        let (chain, own) = self.chain(x)?;
        let mut column = chain.by_other(own)?;
        column.push(Ball::exact(1.0));
        Some(chain.jacobian(own)?.bordered(column))
    }
}

/// Proves a tangency for each value of the other parameter; `None` where that fails.
pub(super) fn tangency(fold: &Fold, over: Parameter, other: Ball) -> Option<Proof> {
    let ExtendedChain { chain, inverse, x, .. } = ExtendedChain::new(fold, over, other, MANIFOLD_RADIUS)?;
    let family = Family { chain: &chain, other };
    let guess = [&points(&x)[..], &[other.centre()]].concat();
    let bordered = Preconditioner::new(&family.jacobian(&guess)?.map(|x| x.mid()))?;
    let limits = Limits { largest: 0.0, domains: 20, images: 30, slow: 3 };
    let zero = prove_inflating(&family, &bordered, &guess, limits)?;
    let (at, domain) = (&zero.at[..x.len()], &zero.domain[..x.len()]);
    if !(boxes::is_narrow(domain[2]) && (0..3).all(|i| boxes::is_within(at[i], domain[i]))) {
        return None;
    }
    let states =
        boxes::states((FIRST_STATE..x.len()).step_by(4).map(|i| [(at[i], domain[i]), (at[i + 1], domain[i + 1])]))?;
    let least = least(&chain, domain)?;
    Some(Proof { states: Some(states), ..conclude(&chain, &inverse, at, least)? })
}
