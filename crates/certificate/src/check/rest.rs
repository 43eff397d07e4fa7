//! Rests and releases along an orbit (Lemma V3).

use std::cmp::Ordering;

use num_bigint::BigInt;

use super::affine::Affine;
use super::chatter::{accumulation, bounce, is_held};
use super::clock::{Clock, SetPosition, beside};
use super::contact::{Claimed, Doubt};
use super::data::Data;
use super::release::{Moment, Release};
use super::standing::WalkState;
use super::step::{Landing, Launch};
use super::walk::{Walk, compare};
use crate::Claim;
use impact_pair_exact::Real;
use impact_pair_model::Wall;

/// Greatest number of bounces of a chatter that are followed without being listed.
const MAX_BOUNCES: usize = 1 << 14;

/// The ball lies on a wall from this phase on.
#[derive(Clone, Debug)]
pub(crate) struct Rest {
    pub wall: Wall,
    /// Phase since the origin.
    pub since: Real,
    /// True if the contact force is exactly 0 at the phase `since`, and positive from then on.
    pub begins: bool,
}

impl<'c> Walk<'c> {
    pub(super) fn come_to_rest(&mut self, claim: &Claim, is_accumulation: bool) -> Result<(), Doubt> {
        let departure = self.standing.departure();
        let Some(wall) = departure.start.wall.filter(|&wall| wall == claim.wall && self.standing.rest().is_none())
        else {
            return Err(Doubt::False(format!("the ball is not on the {} wall", claim.wall.name())));
        };
        if is_accumulation {
            let resting = self.chatter(claim)?;
            self.hides_no_impact(claim.wall)?;
            self.standing = resting;
            return Ok(());
        }
        let begins = self.standing.start().and_then(Data::inward_jerk) == Some(Ordering::Less);
        if !is_held(departure, &self.parameters, begins) {
            return Err(Doubt::open("the ball is not proved to stay on its wall"));
        }
        let since = departure.phase.hull();
        compare("time", &self.clock.time(&since), &claim.time)?;
        self.standing = WalkState::resting(departure.clone(), Rest { wall, since, begins });
        Ok(())
    }

    /// The rest after complete chatter, from phases inside the claimed bounds on.
    fn chatter(&self, claim: &Claim) -> Result<WalkState<'c>, Doubt> {
        let (wall, parameters) = (claim.wall, &self.parameters);
        let mut departure = self.standing.departure().clone();
        if !self.bounces() {
            return Err(Doubt::open("the ball may stay on its wall without any bounce"));
        }
        for _ in 0..MAX_BOUNCES {
            let lasting = accumulation(&departure, parameters)
                .ok_or_else(|| Doubt::open("the chatter is not proved to end in rest"))?;
            let since = departure.phase.hull() + &lasting;
            let time = self.clock.time(&since);
            if let SetPosition::Across = beside(&time, &claim.time) {
                departure = self.bounced(&departure, wall)?;
                continue;
            }
            compare("time", &time, &claim.time)?;
            return Ok(WalkState::resting(departure, Rest { wall, since, begins: false }));
        }
        Err(Doubt::open("the rest is not enclosed as claimed"))
    }

    /// Whether all members are proved to leave their wall with a velocity. Lemma V3
    pub(super) fn bounces(&self) -> bool {
        let velocity = self.standing.departure().velocity.hull();
        // V3: after a first contact, which is transversal, all that is needed is e > 0
        let has_velocity = self.standing.landing().is_some() || velocity.is_positive() || velocity.is_negative();
        has_velocity && self.parameters.restitution.hull().is_positive()
    }

    /// The next bounce of a chatter, after a departure from `wall`.
    pub(super) fn bounce(&self, departure: &Launch, wall: Wall) -> Result<Landing, Doubt> {
        let guess = bounce(departure, &self.parameters)?;
        let claimed = Claimed { from: Real::zero(self.bits), guess, to: None, is_first: true };
        departure.land(&self.parameters, wall, &claimed)
    }

    /// The departure after the next bounce of a chatter, which is not listed.
    fn bounced(&self, departure: &Launch, wall: Wall) -> Result<Launch, Doubt> {
        Ok(Launch::rebound(&self.parameters, &self.bounce(departure, wall)?))
    }

    /// Proves that no unlisted impact of a chatter comes before the time `until`, unless the rest comes before `until` as well
    /// (Lemma V7).
    fn hides_no_impact(&self, wall: Wall) -> Result<(), Doubt> {
        let Some(until) = &self.certificate.ended().until else { return Ok(()) };
        let until = Real::of(&until.0, self.clock.bits());
        let mut departure = self.standing.departure().clone();
        // Whether the first unlisted impact is proved to come before `until`, and whether it may.
        let (mut is_hidden, mut may_be_hidden) = (false, false);
        let hidden =
            || Doubt::False("an impact before the rest, which is not listed, comes before the time `until`".into());
        for _ in 0..MAX_BOUNCES {
            let since = accumulation(&departure, &self.parameters);
            let rest = since.map(|lasting| self.clock.time(&(departure.phase.hull() + &lasting)));
            if let Some(rest) = rest {
                if rest.is_below(&until) {
                    return Ok(());
                }
                if is_hidden && until.is_below(&rest) {
                    return Err(hidden());
                }
            }
            departure = self.bounced(&departure, wall)?;
            let impact = self.clock.time(&departure.phase.hull());
            match (until.is_below(&impact), impact.is_below(&until)) {
                (true, _) if is_hidden => return Err(hidden()),
                (true, _) if may_be_hidden => break,
                (true, _) => return Ok(()),
                (_, true) => is_hidden = true,
                _ => may_be_hidden = true,
            }
        }
        Err(Doubt::open("an impact before the rest, which is not listed, may come before the time `until`"))
    }

    /// The ball leaves where the acceleration turns inward.
    pub(super) fn release(&mut self, claim: &Claim) -> Result<(), Doubt> {
        let Some(rest) = self.standing.rest().filter(|rest| rest.wall == claim.wall).cloned() else {
            return Err(Doubt::False(format!("the ball does not lie on the {} wall", claim.wall.name())));
        };
        if self.parameters.is_still() {
            return Err(Doubt::False("the ball lies on its wall for ever".into()));
        }
        match self.data.only() {
            Some(_) => self.release_of_one(&rest, claim)?,
            None => self.release_of_several(&rest, claim)?,
        }
        Ok(())
    }

    /// Goes on with the release after a rest, without a claim.
    pub(super) fn leave(&mut self, rest: &Rest) -> Result<(), Doubt> {
        if self.parameters.is_still() {
            return Err(Doubt::open("the ball lies on its wall for ever"));
        }
        if self.data.only().is_some() {
            let (halves, clock) = self.released_of_one(rest)?;
            self.leave_of_one(rest.wall, halves, clock);
        } else {
            let root = self.turning(rest).ok_or_else(|| Doubt::open("no release is proved"))?;
            self.leave_of_several(rest.wall, root);
        }
        Ok(())
    }

    /// Proves the release with one harmonic: at an even number of half periods on the left wall, an odd one on the right wall.
    fn release_of_one(&mut self, rest: &Rest, claim: &Claim) -> Result<(), Doubt> {
        let (halves, clock) = self.released_of_one(rest)?;
        compare("time", &clock.time(&Real::zero(self.bits)), &claim.time)?;
        self.leave_of_one(rest.wall, halves, clock);
        Ok(())
    }

    /// Goes on from a release with one harmonic, from which phases are counted.
    fn leave_of_one(&mut self, wall: Wall, halves: BigInt, clock: Clock) {
        let odd = i64::from(wall == Wall::Right);
        self.clock = clock;
        self.parameters.count_from(Real::int(odd, self.bits) * &Real::pi(self.bits));
        self.standing = WalkState::released(&self.parameters, wall, Affine::fixed(Real::zero(self.bits)));
        self.halves = &halves - odd;
        self.recur(Release { wall, moment: Moment::Halves(halves), impacts: self.impacts });
    }

    /// The half period of the release, and the clock of phases counted from it.
    pub(super) fn released_of_one(&self, &Rest { wall, ref since, .. }: &Rest) -> Result<(BigInt, Clock), Doubt> {
        let odd = i64::from(wall == Wall::Right);
        let turn = Real::pi(self.bits) + &Real::pi(self.bits);
        let half = Real::int(odd, self.bits) * &Real::pi(self.bits);
        // exact: shared by all members
        let turns = (self.parameters.origin() + since - &half).over(&turn).and_then(|turns| turns.enclosure().floor());
        let turns = turns.ok_or_else(|| Doubt::open("the forcing period of the release is not decided"))?;
        // Whole forcing periods dropped so far are an even number of half periods, or the odd number of a release before.
        let halves = &self.halves + (turns + 1) * 2 + odd;
        let clock = Clock::at_quarter_turns(self.data, &(&halves * 2), self.bits);
        Ok((halves, clock.ok_or_else(|| Doubt::open("the time of the release is too large"))?))
    }
}
