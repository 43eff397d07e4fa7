//! A chain as equations: Lemma T1 in the form that Krawczyk's operator takes, `F = 0` for the phases.

use std::cmp::Ordering;

use super::chain::Chain;
use super::entries::Entries;
use super::krawczyk::Equations;
use super::legs::Legs;
use super::shaking::Shaking;
use crate::number::Enclosing;

/// The equations of the orbits of a chain.
#[derive(Clone, Copy, Debug)]
pub(super) struct Orbits<'c, S> {
    pub chain: &'c Chain,
    pub shaking: &'c S,
}

impl<N: Enclosing, S: Shaking<N>> Equations<N> for Orbits<'_, S> {
    fn values(&self, phases: &[N]) -> Option<Vec<N>> {
        Some(self.chain.residual(self.shaking, &flights(self.chain, self.shaking, phases)?))
    }

    fn jacobian(&self, phases: &[N]) -> Option<Entries<N>> {
        Some(self.chain.slopes(self.shaking, &flights(self.chain, self.shaking, phases)?)?.into_entries())
    }
}

/// The flights over a box, if each is proved to take time: only then are they flights at all.
pub(super) fn flights<N: Enclosing, S: Shaking<N>>(
    chain: &Chain,
    shaking: &S,
    phases: &[N],
) -> Option<Legs<N, S::Moment>> {
    let legs = chain.legs(shaking, phases)?;
    legs.legs.iter().all(|leg| leg.time.certain_sign() == Some(Ordering::Greater)).then_some(legs)
}
