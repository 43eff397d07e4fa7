//! Grazes: a wall is touched, or nearly touched, with a velocity of zero or nearly zero (Lemma V4).

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_rational::BigRational;

use super::affine::Affine;
use super::clock::{SetPosition, beside};
use super::contact::{Claimed, Doubt, clear_throughout};
use super::data::Data;
use super::flight::{Flight, Part};
use super::step::Launch;
use super::walk::{Walk, compare};
use crate::{Certificate, Claim};
use impact_pair_exact::{Dyadic, Real};
use impact_pair_model::{EventKind, Miss, Wall};

/// Ratio of the gap to the greatest distance by which a graze may miss its wall, and to the greatest width of a claimed distance.
const PARTS_OF_GAP: i32 = 1_000_000;
/// Greatest width of a claimed distance over interval data, relative to the width of its enclosure.
const MAX_WIDENING: i32 = 4;
/// Message that refutes a graze farther from its wall than `PARTS_OF_GAP` allows.
const TOO_FAR: &str = "the wall is missed, or crossed, by more than a graze does";

/// An extremum of all flights of a set, relative to the nearby wall.
struct Summit {
    /// Two points around the extremum, `y''` not 0 between them.
    before: Real,
    after: Real,
    /// The times of the extrema.
    top: Real,
    /// Distance of the extremum beyond the wall; negative where the wall is not reached.
    excess: Real,
    /// Bounds of `|y''|`.
    least: Real,
    most: Real,
}

/// The touch of a wall by the flights of a set that reach the wall.
struct Touch {
    /// Times, counted from the extremum, at which the wall may be touched.
    spread: Real,
    /// Speeds at which it may be touched.
    speed: Real,
}

/// Whether claimed bounds of a distance are wider than `than`.
fn is_wider([lower, upper]: &[BigRational; 2], than: &BigRational) -> bool {
    upper - lower > *than
}

/// Greatest distance by which a graze may miss its wall \[length\]. Lemma V4
fn near(data: &Data) -> BigRational {
    data.least_gap() / BigInt::from(PARTS_OF_GAP)
}

impl Certificate {
    /// Proves that grazes with wide claims are wide because of the data, from the distances enclosed over each piece of the data (Lemma V4).
    pub(super) fn are_grazes(&self, data: &Data, found: &BTreeMap<usize, Real>) -> Result<(), (usize, Doubt)> {
        let near = near(data);
        for (&event, distance) in found {
            let EventKind::Graze { miss: Some(miss) } = &self.events()[event].kind else { continue };
            let around = [-near.clone(), near.clone()];
            if let SetPosition::Outside = beside(distance, &around) {
                return Err((event, Doubt::False(TOO_FAR.into())));
            }
            let own = distance.enclosure().wid().to_rational();
            let may_be_0 = distance.is_across() || matches!(beside(distance, &around), SetPosition::Inside);
            if !may_be_0 || is_wider(&miss.distance, &(own * BigInt::from(MAX_WIDENING))) {
                return Err((event, Doubt::open(Walk::WIDE)));
            }
        }
        Ok(())
    }
}

impl Walk<'_> {
    /// The message about a claim that is wider than the claim of a graze may be.
    pub(super) const WIDE: &'static str = "the bounds of its distance are too wide: an impact may be in them";

    /// Whether the claimed distance is wider than point data allow. Lemma V4
    pub(super) fn is_wide(&self, miss: &Miss<[BigRational; 2]>) -> bool {
        is_wider(&miss.distance, &near(self.data))
    }

    /// Confirms a graze that does not repeat. The walk continues shortly after the graze, with both continuations in one set.
    pub(super) fn graze(&mut self, claim: &Claim, miss: Option<&Miss<[BigRational; 2]>>) -> Result<(), Doubt> {
        let claimed = self.ahead(claim)?;
        let departure = self.standing.departure();
        let flight = departure.flights(&self.parameters);
        let near = near(self.data);
        let around = [-near.clone(), near.clone()];
        let distance = miss.map_or(&around, |miss| &miss.distance);
        self.has_extremum(&flight, claim, &claimed, distance)?;
        let summit = summit(&flight, claim.wall, &claimed.guess);
        let summit = summit.ok_or_else(|| Doubt::open("no extremum is found there"))?;
        // Encloses the distance in mean value form, around the distance of the middle's own extremum in the summit of the set.
        let own = departure.middle_flight(&self.parameters);
        let own = highest(&own, claim.wall, summit.before.hull(&summit.after));
        let missed = own.map(|(_, excess)| {
            let centre = outward(claim.wall, excess);
            let beyond = departure.beyond(&self.parameters, claim.wall, &summit.top, centre);
            (-outward(claim.wall, beyond.hull()), beyond.is_wide_by_data(self.data.deviations()))
        });
        let (missed, is_wide_by_data) = missed.map_or((-summit.excess.clone(), false), |(mean, is_wide)| {
            (mean.cut(&-summit.excess.clone()), is_wide) // exact: both hold all distances
        });
        // V4: no other extremum is in the bounds of the time
        let is_only =
            summit.before.is_below(&claimed.from) && claimed.to.as_ref().is_some_and(|to| to.is_below(&summit.after));
        let only = |doubt: Doubt| match doubt {
            Doubt::False(message) if !is_only => Doubt::Open(message),
            doubt => doubt,
        };
        if let SetPosition::Outside = beside(&missed, distance) {
            compare("distance", &missed, distance).map_err(only)?;
        }
        if self.data.is_point() && matches!(beside(&missed, &around), SetPosition::Outside) {
            return Err(only(Doubt::False(TOO_FAR.into())));
        }
        clear_throughout(&flight, departure.start, &summit.before, &claimed.from)?;
        let excess = -missed.clone();
        let touch = summit.touch(&excess).ok_or_else(|| Doubt::open("the curvature may be 0 there"))?;
        let time = |h: &Real| self.clock.time(&(departure.phase.hull() + h));
        compare("time", &time(&(summit.top.clone() + &touch.spread)), &claim.time)?;
        compare("distance", &missed, distance)?;
        if let Some(miss) = miss {
            compare("speed", &self.clock.velocity(&touch.speed), &miss.speed)?;
            if self.is_wide(miss) {
                if self.data.is_point() || !is_wide_by_data {
                    return Err(Doubt::open(Self::WIDE));
                }
                self.grazes.push((self.event, missed));
            }
        }
        let past = self.pass(&flight, claim.wall, &summit, &touch)?;
        self.standing = self.standing.past_graze(past, claim.wall);
        Ok(())
    }

    /// Refutes the graze if no extremum is possible in the claimed bounds of time and distance. Lemma V4
    fn has_extremum(
        &self,
        flight: &Flight,
        claim: &Claim,
        claimed: &Claimed,
        distance: &[BigRational; 2],
    ) -> Result<(), Doubt> {
        let Some(to) = &claimed.to else { return Ok(()) };
        let [_, to] = to.rounded(flight.bits()).ends();
        let part = claimed.from.hull(&to);
        let slope = flight.slope(&part);
        if slope.is_positive() || slope.is_negative() {
            return Err(Doubt::False("the ball does not turn back then".into()));
        }
        let missed = outward(claim.wall, flight.level(claim.wall) - &flight.height(&part));
        match beside(&missed, distance) {
            SetPosition::Outside => Err(Doubt::False("the ball is not so near to the wall then".into())),
            SetPosition::Inside | SetPosition::Across => Ok(()),
        }
    }

    /// The states at the end of the summit, both of flights that miss the wall and of flights that hit it.
    ///
    /// Flights hit the wall at a speed of at most `speed`. The impact reverses it, so the velocity changes by at most `1 + e` times that
    /// speed; each flight then bends away from the wall up to the end of the summit.
    fn pass(&self, flight: &Flight, wall: Wall, summit: &Summit, touch: &Touch) -> Result<Launch, Doubt> {
        let Summit { before, after, .. } = summit;
        let speed = Real::point(touch.speed.enclosure().sup().clone(), self.bits);
        let lost = (Real::int(1, self.bits) + &self.parameters.restitution.hull()) * &speed;
        let lost = -outward(wall, lost);
        let lost = lost.hull(&Real::zero(self.bits));
        let height = flight.height(after) + &(lost.clone() * &(after.clone() - before));
        let velocity = flight.slope(after) + &lost;
        if !(outward(wall, velocity.clone()).is_negative() && matches!(flight.place(&height), Part::Clear)) {
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
    let outward = |x: Real| outward(wall, x);
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
            let (top, excess) = highest(flight, wall, whole)?;
            let end = |x: &Dyadic| Real::point(x.clone(), bits);
            let (least, most) = (end(bend.enclosure().inf()), end(bend.enclosure().sup()));
            return Some(Summit { before, after, top, excess, least, most });
        }
        reach = reach.half();
    }
    None
}

/// A displacement or velocity, counted towards `wall`.
fn outward(wall: Wall, x: Real) -> Real {
    if wall == Wall::Right { x } else { -x }
}

/// Encloses the times of the extrema in a part on which `y''` bends away from the wall, and their distances beyond the wall.
fn highest(flight: &Flight, wall: Wall, part: Real) -> Option<(Real, Real)> {
    let bits = part.bits();
    let outward = |x: Real| outward(wall, x);
    let slope = |h: &Real| outward(flight.slope(h));
    let mut top = part;
    for _ in 0..bits.ilog2() {
        // h + y'/|y''|, by interval Newton.
        let middle = Real::point(top.mid(), bits);
        let bend = -outward(flight.curvature(&top));
        top = top.cut(&(middle.clone() + &slope(&middle).over(&bend)?));
    }
    let middle = Real::point(top.mid(), bits);
    let bend = -outward(flight.curvature(&top));
    let off = top.clone() - &middle;
    let rise = slope(&middle) * &off - &(bend * &off.square()).half();
    let excess = outward(flight.height(&middle) - &flight.level(wall)) + &rise;
    Some((top, excess))
}

impl Summit {
    /// The touch of flights that reach `excess` beyond the wall; `None` where it is not enclosed. Lemma V4
    fn touch(&self, excess: &Real) -> Option<Touch> {
        let bits = excess.bits();
        let positive = |x: &Dyadic| {
            let x = Real::point(x.clone(), bits);
            if x.is_positive() { x } else { Real::zero(bits) } // exact: less reaches no wall
        };
        let [low, high] = [excess.enclosure().inf(), excess.enclosure().sup()].map(positive);
        let root = |x: Real| (x.clone() + &x).sqrt();
        let spread = (high.clone() + &high).over(&self.least)?.sqrt()?;
        let (slow, fast) = (root(low * &self.least)?, root(high * &self.most)?);
        Some(Touch { spread: spread.hull(&-spread.clone()), speed: slow.hull(&fast) })
    }
}
