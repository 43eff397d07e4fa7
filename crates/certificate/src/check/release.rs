//! Releases with several harmonics: where the acceleration of the box turns inward (Lemma V3).

use num_bigint::BigInt;
use num_traits::{Signed, ToPrimitive};

use super::affine::Affine;
use super::budget::Budget;
use super::contact::{Doubt, zero};
use super::rest::Rest;
use super::shaking::Shaking;
use super::standing::WalkState;
use super::walk::{Walk, compare};
use crate::Claim;
use impact_pair_exact::Real;
use impact_pair_model::Period;
use impact_pair_model::Wall;

/// Precision, in bits, in which a rest is first followed.
const FIRST_BITS: u32 = 128;

/// A release from a wall.
pub(crate) struct Release {
    pub wall: Wall,
    pub moment: Moment,
    /// Impacts listed before the release.
    pub impacts: u64,
}

/// The moment of a release.
pub(crate) enum Moment {
    /// With one harmonic: half periods since phase 0.
    Halves(BigInt),
    /// With several harmonics: encloses the phase since the origin.
    Phase(Real),
}

impl Walk<'_> {
    /// Proves that the ball leaves at the first zero of the acceleration after the rest began, and that this zero is simple.
    pub(super) fn release_of_several(&mut self, rest: &Rest, claim: &Claim) -> Result<(), Doubt> {
        let root = self.turning(rest).ok_or_else(|| Doubt::open("no release is proved"))?;
        compare("time", &self.clock.time(&root), &claim.time)?;
        self.leave_of_several(rest.wall, root);
        Ok(())
    }

    /// Goes on from a release with several harmonics.
    pub(super) fn leave_of_several(&mut self, wall: Wall, root: Real) {
        // The release is taken as independent of the data: a landing depends on its phase by p - E''(0) h = 0.
        let released = Affine::fixed(root.clone()).recentred();
        self.standing = WalkState::released(&self.parameters, wall, released);
        self.recur(Release { wall, moment: Moment::Phase(root), impacts: self.impacts });
    }

    /// Stores a release, and the periods that end with it. Lemma V3 (recurrence)
    pub(super) fn recur(&mut self, release: Release) {
        let claimed = self.certificate.ended().period;
        let same = || self.released.iter().rev().filter(|before| before.wall == release.wall);
        let since = |before: &Release| {
            let cycles = self.cycles_between(before, &release)?;
            Some(Period { cycles, impacts: release.impacts - before.impacts })
        };
        let period = self.period.or_else(|| same().find_map(since));
        // The claimed number of impacts is compared from the first proved period on.
        let again = claimed.filter(|_| period.is_some()).and_then(|claimed| {
            let found = same().filter_map(since).take_while(|found| found.cycles <= claimed.cycles);
            found.filter(|found| found.cycles == claimed.cycles).last().map(|found| found.impacts == claimed.impacts)
        });
        self.period = period;
        self.has_period = match (self.has_period, again) {
            (Some(known), Some(again)) => Some(known && again),
            (known, again) => known.or(again),
        };
        self.released.push(release);
    }

    /// The cycles between two releases from one wall, if they are proved to be whole common periods of all harmonics apart.
    fn cycles_between(&self, before: &Release, after: &Release) -> Option<u64> {
        match (&before.moment, &after.moment) {
            (Moment::Halves(before), Moment::Halves(after)) => ((after - before) / 2u32).to_u64(),
            (Moment::Phase(before), Moment::Phase(after)) => self.whole_cycles(before, after),
            _ => None,
        }
    }

    /// Encloses the phase at which the contact force vanishes.
    pub(super) fn turning(&self, rest: &Rest) -> Option<Real> {
        let origin = Real::zero(self.bits);
        let set = self.parameters.shaking(&origin, Affine::hull);
        let mut bits = FIRST_BITS.min(self.bits); // X1: any number of bits encloses
        let bracket = loop {
            match turning(&set.rounded(bits), rest, bits, &self.parameters.budget) {
                None if bits < self.bits && !self.parameters.budget.is_spent() => bits = (4 * bits).min(self.bits), // X1
                found => break found?,
            }
        };
        Some(zero(bracket.at(self.bits), |s| set.acceleration(s), |part| set.jerk(part)))
    }

    /// The cycles, if a release at `root` is proved to be whole common periods of all harmonics after a release at `before`.
    ///
    /// A zero of the acceleration within one enclosure, shifted by whole common periods, is a zero within the other; without an
    /// extremum of the acceleration between two zeros they are the same.
    fn whole_cycles(&self, before: &Real, root: &Real) -> Option<u64> {
        let common = self.data.common_turns()?;
        let turn = Real::pi(self.bits) + &Real::pi(self.bits);
        let lasting = Real::rational(&common.clone().into(), self.bits) * &turn;
        let periods = (root.clone() - before).over(&lasting)?.middle() + &Real::int(1, self.bits).half();
        let periods = BigInt::from(periods.floor()?); // exact: shared by all members
        let later = before.clone() + &(Real::rational(&periods.clone().into(), self.bits) * &lasting);
        let jerk = self.parameters.shaking(&Real::zero(self.bits), Affine::hull).jerk(&later.hull(root));
        let is_same = periods.is_positive() && (jerk.is_positive() || jerk.is_negative());
        (common * periods).to_u64().filter(|_| is_same)
    }
}

/// A part of the forcing in which `E'''` is not 0: the contact force is positive from the rest to its beginning and not at its
/// end; phases since the origin.
fn turning(shaking: &Shaking, rest: &Rest, bits: u32, budget: &Budget) -> Option<Real> {
    let inward = |x: Real| if rest.wall == Wall::Left { x } else { -x };
    let point = |x: &Real| Real::point(x.mid(), bits);
    let acceleration = |at: &Real| inward(shaking.acceleration(at));
    let jerk = |part: &Real| inward(shaking.jerk(part));
    let [begin, _] = rest.since.rounded(bits).ends();
    let shortest = |width: &Real| width.enclosure().mag().top().is_none_or(|top| -top > i64::from(bits) / 2);
    let (mut at, mut width) = (begin.clone(), Real::int(1, bits));
    if rest.begins {
        let first = |width: &Real| point(&(begin.clone() + width));
        while !jerk(&rest.since.rounded(bits).hull(&first(&width))).is_negative() {
            width = width.half();
            if shortest(&width) {
                return None;
            }
        }
        at = first(&width);
    }
    for _ in 0..budget.parts {
        budget.spend(bits, shaking.waves.len());
        if budget.is_spent() {
            return None;
        }
        let next = point(&(at.clone() + &width));
        let part = at.hull(&next);
        let (slope, end) = (jerk(&part), acceleration(&next));
        let middle = point(&part);
        let mean = acceleration(&middle) + &(slope.clone() * &(part.clone() - &middle));
        if acceleration(&part).cut(&mean).is_negative() {
            (at, width) = (next, width.clone() + &width);
            continue;
        }
        if slope.is_positive() && end.is_positive() && acceleration(&at).is_negative() {
            return Some(part);
        }
        width = width.half();
        if shortest(&width) {
            return None;
        }
    }
    None
}
