//! Motions without drift, `c = 0` exactly: they touch no wall, or, under one harmonic, graze the same ones in every turn.

use std::cmp::Ordering;

use num_bigint::BigInt;

use super::clock::Clock;
use super::contact::{Doubt, clear_throughout};
use super::data::Data;
use super::walk::{Walk, compare};
use crate::Claim;
use impact_pair_exact::{Exact, Real};
use impact_pair_model::Wall;

/// `y = m - A sin th` for ever, between the walls.
pub(crate) struct Still {
    /// The phase last grazed, or of the start, in quarter turns; not 0 without shaking only if it is one.
    quarters: BigInt,
    /// Whether the left wall is touched at 1 quarter turn, and the right wall at 3.
    touches: [bool; 2],
}

impl Still {
    /// The motion from the start, if it is proved to be one: from the exact data, at odd quarter turns, where `cos th0 = 0`, or
    /// where the box stands still. `is_at_rest`: the ball has no velocity after the start.
    pub fn of(data: &Data, is_at_rest: bool) -> Option<Self> {
        let amplitude = &data.only()?.amplitude;
        let stands = amplitude.sign() == Some(Ordering::Equal);
        let quarters = if stands { BigInt::ZERO } else { data.quarter()? };
        let is_odd = &quarters % 2 != BigInt::ZERO;
        let on_wall_for_ever = stands && data.wall.is_some();
        if !is_at_rest || !(stands || is_odd) || on_wall_for_ever {
            return None;
        }
        let quarter = i32::try_from(((&quarters % 4) + 4) % 4).ok()?;
        let sin = [0, 1, 0, -1][quarter as usize]; // exact: 0 to 3
        // How far the ball is from each wall at the start, and how much farther it swings towards it.
        let gap = data.half_gap.checked_mul(&Exact::from(2)).ok()?;
        let zero = || Exact::from(0);
        let distances = match data.wall {
            None => {
                let height = data.height.clone()?;
                [data.half_gap.checked_add(&height).ok()?, data.half_gap.checked_sub(&height).ok()?]
            }
            Some(Wall::Left) => [zero(), gap],
            Some(Wall::Right) => [gap, zero()],
        };
        let mut rooms = [Ordering::Less; 2];
        for ((room, distance), part) in rooms.iter_mut().zip(&distances).zip([1 - sin, 1 + sin]) {
            let swing = if part == 0 { zero() } else { amplitude.checked_mul(&Exact::from(part)).ok()? };
            *room = distance.checked_sub(&swing).ok()?.sign()?;
        }
        let quarters = quarters + &data.turns * 4;
        let touches = rooms.map(|room| room == Ordering::Equal);
        rooms.iter().all(|room| room.is_ge()).then_some(Self { quarters, touches })
    }

    /// Whether a wall is ever touched.
    pub fn grazes(&self) -> bool {
        self.touches != [false; 2]
    }

    /// The next graze: its wall and its phase in quarter turns.
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
    /// Whether a ball that starts inside the gap without drift, so that `y + E` stays as it is, is proved to touch no wall:
    /// nowhere where `E` may get to, or nowhere in a common period of all harmonics.
    pub(super) fn swings_freely(&self) -> Result<bool, Doubt> {
        if self.data.height.is_none() || !self.certificate.events().is_empty() || !self.data.has_no_drift() {
            return Ok(false);
        }
        let flight = self.departure.flights(&self.parameters);
        let (place, reach) = (flight.height.clone() + &flight.shaking.first_place(), flight.shaking.reach());
        if [place.clone() + &reach, reach - &place].iter().all(|most| most.is_below(&flight.half_gap)) {
            return Ok(true);
        }
        let Some(common) = self.data.common_turns() else { return Ok(false) };
        let turn = Real::pi(flight.bits()) + &Real::pi(flight.bits());
        let period = Real::rational(&common.into(), flight.bits()) * &turn;
        let [_, end] = period.ends();
        clear_throughout(&flight, self.departure.start, &end, &(end.clone() + &end)).map(|()| true)
    }

    /// A graze of a motion that grazes in every turn.
    pub(super) fn graze_again(&mut self, claim: &Claim) -> Result<(), Doubt> {
        let bits = self.bits;
        let next = self.still.as_ref().and_then(Still::next).filter(|(wall, _)| *wall == claim.wall);
        let (_, quarters) = next.ok_or_else(|| Doubt::False("the wall is not touched next".into()))?;
        let clock = Clock::at_quarter_turns(self.data, &quarters, bits);
        let clock = clock.ok_or_else(|| Doubt::Open("the time of the graze is too large".into()))?;
        compare("time", &clock.time(&Real::zero(bits)), &claim.time)?;
        self.still.iter_mut().for_each(|still| still.quarters = quarters.clone());
        Ok(())
    }
}
