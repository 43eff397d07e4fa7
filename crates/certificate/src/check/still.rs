//! Motions without drift, `c = 0` exactly: they touch no wall, or, with one harmonic, graze the same walls in every forcing period.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_rational::BigRational;

use super::clock::Clock;
use super::contact::{Doubt, clear_throughout};
use super::data::Data;
use super::walk::{Walk, compare};
use crate::Claim;
use impact_pair_exact::{Exact, Real};
use impact_pair_model::{Miss, Wall};

/// `y = m - A sin th` for ever, between the walls.
#[derive(Clone, Debug)]
pub(crate) struct Still {
    /// The last quarter period up to the last graze, or up to the start.
    quarters: BigInt,
    /// True where the left wall is touched at 1/4 period, and the right wall at 3/4.
    touches: [bool; 2],
}

impl Still {
    /// The motion from the scene's start, if the exact data prove that it has no drift (Lemma V5). `is_at_rest`: the ball has no
    /// velocity after the start.
    pub fn of(data: &Data, is_at_rest: bool) -> Option<Self> {
        let tone = data.only()?;
        let shaken = tone.amplitude.sign();
        let stands = shaken == Some(Ordering::Equal);
        let (zero, one) = (Exact::from(0), Exact::from(1));
        let after = if is_at_rest { &zero } else { &data.velocity };
        // If the box may stand still, a ball without velocity on a wall may stick there; with velocity it leaves.
        let leaves = is_at_rest && shaken == Some(Ordering::Greater);
        if data.wall.is_some() && !leaves || !data.has_no_drift(after) {
            return None;
        }
        let quarters = if stands { BigInt::ZERO } else { data.quarter()? };
        let sin = tone.phase.checked_sin().ok()?;
        // The distances of the ball from both walls at the start, and how much farther it swings towards each.
        let gap = data.half_gap.checked_mul(&Exact::from(2)).ok()?;
        let distances = match data.wall {
            None => {
                let height = data.height.clone()?;
                [data.half_gap.checked_add(&height).ok()?, data.half_gap.checked_sub(&height).ok()?]
            }
            Some(Wall::Left) => [zero, gap],
            Some(Wall::Right) => [gap, zero],
        };
        let mut rooms = [Ordering::Less; 2];
        let parts = [one.checked_sub(&sin).ok()?, one.checked_add(&sin).ok()?];
        for ((room, distance), part) in rooms.iter_mut().zip(&distances).zip(parts) {
            // A factor of exactly 0 makes the swing exactly 0, for all amplitudes.
            let is_none = part.sign() == Some(Ordering::Equal);
            let swing = if is_none { part } else { tone.amplitude.checked_mul(&part).ok()? };
            *room = distance.checked_sub(&swing).ok()?.sign()?;
        }
        let quarters = quarters + &data.turns * 4;
        let touches = rooms.map(|room| room == Ordering::Equal);
        rooms.iter().all(|room| room.is_ge()).then_some(Self { quarters, touches })
    }

    /// Whether the motion touches a wall at all.
    pub fn grazes(&self) -> bool {
        self.touches != [false; 2]
    }

    /// The next graze: its wall and its phase in quarter periods.
    pub(super) fn next(&self) -> Option<(Wall, BigInt)> {
        let walls = [(Wall::Left, 1), (Wall::Right, 3)].into_iter().zip(self.touches);
        let next = walls.filter(|(_, touches)| *touches).map(|((wall, at), _)| {
            let ahead: BigInt = (((at - &self.quarters - 1) % 4 + 4) % 4) + 1;
            (wall, &self.quarters + ahead)
        });
        next.min_by(|a, b| a.1.cmp(&b.1))
    }
}

impl Walk<'_> {
    /// Whether a ball that starts inside the gap without drift, so that `y + E` stays constant, is proved to touch no wall: by the bound of
    /// `E`, or over a common period of all harmonics.
    pub(super) fn swings_freely(&self) -> Result<bool, Doubt> {
        let Some(data) = self.standing.start() else { return Ok(false) };
        if data.height.is_none() || !data.has_no_drift(&data.velocity) {
            return Ok(false);
        }
        let departure = self.standing.departure();
        let flight = departure.flights(&self.parameters);
        let (place, reach) = (flight.height.clone() + &flight.shaking.first_place(), flight.shaking.reach());
        if [place.clone() + &reach, reach - &place].iter().all(|most| most.is_below(&flight.half_gap)) {
            return Ok(true);
        }
        let Some(common) = data.common_turns() else { return Ok(false) };
        let turn = Real::pi(flight.bits()) + &Real::pi(flight.bits());
        let period = Real::rational(&common.into(), flight.bits()) * &turn;
        let [_, end] = period.ends();
        clear_throughout(&flight, departure.start, &end, &(end.clone() + &end)).map(|()| true)
    }

    /// Confirms a graze of a motion that grazes in every forcing period.
    pub(super) fn graze_again(
        &mut self,
        still: Still,
        claim: &Claim,
        miss: Option<&Miss<[BigRational; 2]>>,
    ) -> Result<(), Doubt> {
        let bits = self.bits;
        let next = still.next().filter(|(wall, _)| *wall == claim.wall);
        let (_, quarters) = next.ok_or_else(|| Doubt::False("the wall is not touched next".into()))?;
        let clock = Clock::at_quarter_turns(self.data, &quarters, bits);
        let clock = clock.ok_or_else(|| Doubt::open("the time of the graze is too large"))?;
        compare("time", &clock.time(&Real::zero(bits)), &claim.time)?;
        // V5: the wall is touched exactly, without velocity, and all bounds that were read hold 0
        if miss.is_some_and(|miss| self.is_wide(miss)) {
            return Err(Doubt::open(Self::WIDE));
        }
        self.standing.touch(Still { quarters, ..still });
        Ok(())
    }
}
