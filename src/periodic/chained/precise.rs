//! Chains in balls of any precision.

use super::super::chain::Chain;
use super::super::legs::Legs;
use super::super::physical::{Claim, all_first, split};
use super::Moment;
use crate::contact::PairBounds;
use crate::contact::multiprecision::isolate_first;
use crate::flight::{Flight, Launch};
use crate::number::{Enclosing, MpBall};
use crate::pair::{Inward, Reduced};
use crate::shaken::{Flying, OneHarmonic};

/// The operations on a pair in balls of any precision that proofs of its chains need.
pub(in super::super) trait ChainedPrecisely: Flying {
    /// Whether each flight is proved to end at its first contact, where doubles leave that open. Lemma T5
    fn is_physical_precisely(
        &self,
        shaking: &Self::In<MpBall>,
        chain: &Chain,
        phases: &[MpBall],
        legs: &Legs<MpBall, Moment<Self, MpBall>>,
    ) -> Option<bool>;
}

impl ChainedPrecisely for OneHarmonic {
    fn is_physical_precisely(
        &self,
        pair: &Reduced<MpBall>,
        chain: &Chain,
        phases: &[MpBall],
        legs: &Legs<MpBall>,
    ) -> Option<bool> {
        all_first(chain, split(phases), &legs.legs, |claim| is_first_in_balls(&self.bounds_of_pair, pair, claim))
    }
}

/// Whether the first contact of a flight is its end; `None` if undecided. Lemma T5
fn is_first_in_balls(bounds_of_pair: &PairBounds, pair: &Reduced<MpBall>, claim: &Claim<MpBall>) -> Option<bool> {
    if !claim.arrives()? {
        return Some(false);
    }
    let after = claim.from.inward(pair.rebound(claim.before.clone()));
    if claim.sticks(&after) {
        return Some(false);
    }
    let flight = |phase: MpBall, after: MpBall| {
        let sin_cos = phase.sin_cos();
        Flight::from_wall(pair, claim.from, phase, after, sin_cos)
    };
    let all = flight(claim.start.clone(), after.clone());
    let centre = flight(claim.start.centre(), after.centre());
    let velocity = claim.from.inward(after.to_ball());
    let start = Launch::from_wall(claim.from, 0, claim.start.to_ball(), velocity, false);
    let isolated = isolate_first(bounds_of_pair, &start, || all, &centre).ok()?;
    let wall = isolated.target.wall(claim.from);
    let phase = MpBall::new(isolated.at.clone(), isolated.reach).rounded(claim.start.bits());
    claim.is_at(pair, wall, (isolated.turns, phase))
}
