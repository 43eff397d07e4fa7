//! Grazes: past a wall that is touched, or nearly touched, with zero velocity or nearly none (Lemma V4).

use super::affine::Affine;
use super::contact::{Claimed, Doubt, clear_throughout};
use super::flight::{Flight, Part};
use super::step::Launch;
use super::walk::{Walk, compare};
use crate::Claim;
use impact_pair_exact::{Dyadic, Real};
use impact_pair_model::Wall;

/// An extremum of all flights of a set, measured from the wall it is near.
struct Summit {
    /// Two points around it, `y''` not 0 between them.
    before: Real,
    after: Real,
    /// Time of the extremum, and the times around it at which the wall may be touched.
    touch: Real,
    /// Distance that it may reach beyond the wall, negative where it does not reach it.
    excess: Real,
    /// The greatest speed at which the wall may be hit.
    speed: Real,
    /// The greatest `|y''|`.
    curvature: Real,
}

impl Walk<'_> {
    /// A graze that does not repeat: the orbit goes on from a little after it, with both continuations in one set.
    pub(super) fn graze(&mut self, claim: &Claim) -> Result<(), Doubt> {
        let claimed = self.ahead(claim)?;
        let departure = self.standing.departure();
        let flight = departure.flights(&self.parameters);
        self.is_near(&flight, claim, &claimed)?;
        let summit = summit(&flight, claim.wall, &claimed.guess);
        let summit = summit.ok_or_else(|| Doubt::open("no extremum is found there"))?;
        clear_throughout(&flight, departure.start, &summit.before, &claimed.from)?;
        let time = |h: &Real| self.clock.time(&(departure.phase.hull() + h));
        compare("time", &time(&summit.touch), &claim.time)?;
        let missed = -summit.excess.clone();
        self.is_within_reach(claim, &summit.curvature, &missed)?;
        let past = self.pass(&flight, claim.wall, &summit)?;
        self.standing = self.standing.past_graze(past, claim.wall);
        Ok(())
    }

    /// The ball is near the wall at some time claimed: where it is not, no extremum need be sought.
    fn is_near(&self, flight: &Flight, claim: &Claim, claimed: &Claimed) -> Result<(), Doubt> {
        let Some(to) = &claimed.to else { return Ok(()) };
        let [_, to] = to.rounded(flight.bits()).ends();
        let part = claimed.from.hull(&to);
        let inward = flight.level(claim.wall) - &flight.height(&part);
        let missed = if claim.wall == Wall::Right { inward } else { -inward };
        self.is_within_reach(claim, &Real::point(flight.curvature(&part).enclosure().mag(), self.bits), &missed)
    }

    /// The wall is missed by no more than a parabola gets in the time claimed.
    fn is_within_reach(&self, claim: &Claim, curvature: &Real, missed: &Real) -> Result<(), Doubt> {
        let span = Real::rational(&(&claim.time[1] - &claim.time[0]), self.bits);
        let span = self.clock.radians(&span);
        if (curvature.clone() * &span.square()).is_below(missed) {
            return Err(Doubt::False("the wall is missed by more than the bounds of the time allow".into()));
        }
        Ok(())
    }

    /// The states at the end of the summit, of those that miss the wall and of those that hit it.
    ///
    /// The states that hit it do so at a speed of at most `speed`, which the impact takes away, and at most `e` times as much again; each
    /// bends away from the wall up to the end of the summit.
    fn pass(&self, flight: &Flight, wall: Wall, summit: &Summit) -> Result<Launch, Doubt> {
        let Summit { before, after, speed, .. } = summit;
        let lost = (Real::int(1, self.bits) + &self.parameters.restitution.hull()) * speed;
        let lost = if wall == Wall::Right { -lost } else { lost };
        let lost = lost.hull(&Real::zero(self.bits));
        let height = flight.height(after) + &(lost.clone() * &(after.clone() - before));
        let velocity = flight.slope(after) + &lost;
        let is_away = if wall == Wall::Right { velocity.is_negative() } else { velocity.is_positive() };
        if !(is_away && matches!(flight.place(&height), Part::Clear)) {
            return Err(Doubt::open("both ways past the graze are not proved to leave the wall"));
        }
        let phase = self.standing.departure().phase.clone().shifted(after);
        let [height, velocity] = [height, velocity].map(|x| Affine::fixed(x).recentred());
        Ok(Launch::inside(phase, height, velocity))
    }
}

/// The extremum near `guess` towards `wall`; `None` if it is not found.
fn summit(flight: &Flight, wall: Wall, guess: &Real) -> Option<Summit> {
    let bits = guess.bits();
    let outward = |x: Real| if wall == Wall::Right { x } else { -x };
    let slope = |h: &Real| outward(flight.slope(h));
    let mut reach = guess.half();
    for _ in 0..bits {
        if flight.budget.is_spent() {
            return None;
        }
        let (before, after) = (guess.clone() - &reach, guess.clone() + &reach);
        let whole = before.hull(&after);
        // |y''| where it bends away from the wall.
        let bend = -outward(flight.curvature(&whole));
        let clear = |h: &Real| matches!(flight.place(&flight.height(h)), Part::Clear);
        if bend.is_positive() && slope(&before).is_positive() && slope(&after).is_negative() {
            if !(clear(&before) && clear(&after)) {
                return None;
            }
            let mut top = whole;
            for _ in 0..bits.ilog2() {
                // h + y'/|y''|, by interval Newton.
                let middle = Real::point(top.mid(), bits);
                let bend = -outward(flight.curvature(&top));
                top = top.cut(&(middle.clone() + &slope(&middle).over(&bend)?));
            }
            let middle = Real::point(top.mid(), bits);
            let off = top.clone() - &middle;
            let rise = slope(&middle) * &off - &(bend.clone() * &(off.clone() * &off)).half();
            let excess = outward(flight.height(&middle) - &flight.level(wall)) + &rise;
            let end = |x: &Dyadic| Real::point(x.clone(), bits);
            let (least, most) = (end(bend.enclosure().inf()), end(bend.enclosure().sup()));
            let high = if excess.is_negative() { Real::zero(bits) } else { end(excess.enclosure().sup()) };
            let twice = high.clone() + &high;
            let spread = twice.over(&least)?.sqrt()?;
            let speed = (twice * &most).sqrt()?;
            let touch = top + &spread.hull(&-spread.clone());
            return Some(Summit { before, after, touch, excess, speed, curvature: most });
        }
        reach = reach.half();
    }
    None
}
