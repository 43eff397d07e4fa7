//! Chains with several harmonics in balls of any precision.

use super::super::chain::Chain;
use super::super::chained::{ChainedPrecisely, Moment};
use super::super::legs::Legs;
use super::super::physical::{all_first, split};
use super::is_first;
use crate::number::MpBall;
use crate::shaken::{SeveralHarmonics, Sum};

impl ChainedPrecisely for SeveralHarmonics {
    fn is_physical_precisely(
        &self,
        sum: &Sum<MpBall>,
        chain: &Chain,
        phases: &[MpBall],
        legs: &Legs<MpBall, Moment<Self, MpBall>>,
    ) -> Option<bool> {
        all_first(chain, split(phases), &legs.legs, |claim| {
            is_first(self, sum, claim, -(sum.restitution.clone() * claim.before.clone()))
        })
    }
}
