//! Complete chatter and release under several harmonics: Lemmas H7 and H8 of `docs/proofs/harmonics.md#H7`.
//!
//! Measured from the wall, `p = -z''` is the contact force. With bounds of `p'` and `p''` at all times the lemmas Z1 and Z2 need
//! no closed form: chatter is proved to end where the contact force hardly changes meanwhile, and the ball is released at
//! the first proved change of the contact force's sign.

mod precise;

use std::sync::Arc;

use super::flight::Instant;
use super::harmonics::Harmonics;
use super::phased::FlightNumber;
use super::spectrum::Spectrum;
use super::touch::past_touch;
use crate::exact::Enclosure;
use crate::number::interval::Interval;
use crate::number::{Ball, is_positive};
use crate::pair::Wall;
use crate::rest::duration;
use crate::turns;

/// Upper bound of the duration, in forcing periods, of chatter after a bounce of a whole set, as [`crate::rest::accumulation`] for one harmonic.
/// `phase` follows `turns` whole forcing periods; `velocity` is that after the impact.
pub(crate) fn accumulation(
    harmonics: &Harmonics<Ball>,
    restitution: Ball,
    wall: Wall,
    turns: i64,
    phase: Ball,
    velocity: Ball,
) -> Option<f64> {
    let (speed, rebound) = (velocity.mag(), restitution.mag());
    let pressed = pressure(harmonics, wall, turns, &phase).interval();
    if !is_positive(pressed.inf()) {
        return None;
    }
    // H7: exactly at rest
    if speed == 0.0 {
        return Some(0.0);
    }
    // Twice the time under the present contact force. Any window serves into which the sum fits.
    let window = 4.0 * speed / (pressed.inf() * (1.0 - rebound));
    let (rates, ahead) = (&harmonics.rates, Interval::new(0.0, window));
    let jerk = Interval::within(harmonics.jerk(turns, &phase).interval().mag());
    // H7: the smaller of two bounds
    let change = (jerk + Interval::within(rates.fourth) * ahead).intersection(Interval::within(rates.third))? * ahead;
    duration(speed, rebound, pressed + change, window)
}

/// The contact force: `-z''`, measured from the wall.
fn pressure<N: FlightNumber>(harmonics: &Harmonics<N>, wall: Wall, turns: i64, rest: &N) -> N {
    harmonics.sums(turns, rest).acceleration.signed(-wall.sign())
}

/// A simple zero of the contact force: the ball is released there.
#[derive(Clone, Debug)]
pub(crate) struct Zero {
    spectrum: Arc<Spectrum>,
    pub wall: Wall,
    pub turns: i64,
    /// The one zero within `reach` of this phase, less whole forcing periods; the contact force falls there at the rate `least` or faster.
    near: f64,
    reach: f64,
    least: f64,
    /// Encloses the change of the slope of the contact force per forcing period.
    bend: Interval,
}

/// Greatest number of steps of the search.
const STEPS: u32 = 1 << 16;
/// The reason why no change of sign is proved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unproved {
    /// In these digits a change of sign and a touch are not distinguished: more of them may do so.
    Digits,
    /// The contact force goes to 0 so slowly that the steps towards it do not end, in any digits: a zero of a higher order.
    Steps,
}

/// The reason why a search has found no change of sign, and the time up to which the contact force is proved not to be negative.
#[derive(Debug)]
pub(super) struct Stopped {
    why: Unproved,
    turns: i64,
    phase: f64,
}

/// Greatest number of touches of the contact force that are passed.
const MOST_TOUCHES: u32 = 1 << 10;

/// First change of the contact force's sign after a phase at which it acts, or begins to act; `None` where none is proved. Lemmas H8, H15
pub(crate) fn release(
    spectrum: &Arc<Spectrum>,
    harmonics: &Harmonics<Ball>,
    wall: Wall,
    turns: i64,
    phase: f64,
) -> Option<Zero> {
    let (mut turns, mut phase) = (turns, phase);
    for _ in 0..MOST_TOUCHES {
        let found = first_zero(spectrum, harmonics, wall, turns, Ball::exact(phase));
        let beyond = match &found {
            Ok(_) => None,
            Err(stopped) => past_touch(spectrum, wall, stopped.turns, stopped.phase).zip(Some(stopped.turns)),
        };
        match beyond {
            Some(beyond) => (phase, turns) = beyond,
            None => return precise::decided(found.map_err(|stopped| stopped.why), spectrum, wall, turns, phase).ok(),
        }
    }
    None
}

/// The search in one arithmetic: steps on which `p + p' s - S s^2/2` stays positive, `S` a bound of `|p''|`.
pub(super) fn first_zero<N: FlightNumber>(
    spectrum: &Arc<Spectrum>,
    harmonics: &Harmonics<N>,
    wall: Wall,
    turns: i64,
    phase: N,
) -> Result<Zero, Stopped> {
    let fourth = harmonics.rates.fourth;
    let bend = Interval::within(fourth);
    let slope_at = |at: &Instant<N>| harmonics.jerk(turns + at.turns, &at.rest).signed(-wall.sign()).interval();
    let value_at = |at: &Instant<N>| pressure(harmonics, wall, turns + at.turns, &at.rest);
    let mut at = Instant { turns: 0, rest: phase };
    // A contact force that begins here grows for at least this time.
    let low = slope_at(&at).inf();
    if value_at(&at).bounds().0 <= 0.0 && low > 0.0 {
        at = at.later(&at.rest.like(low / fourth));
    }
    // H8: an exact time, which a double holds where it is one
    let stop = |why: Unproved, at: &Instant<N>| Stopped { why, turns: turns + at.turns, phase: at.rest.middle() };
    for _ in 0..STEPS {
        let (value, slope) = (value_at(&at).interval(), slope_at(&at));
        let (p, low) = (value.inf(), slope.inf());
        if !is_positive(p) {
            return Err(stop(Unproved::Digits, &at));
        }
        let ahead = p / -low;
        // Falling all the way to a zero a little farther than Newton's step: it is the first.
        if low < 0.0 && slope.sup() + 2.0 * fourth * ahead < 0.0 {
            let (zero, reach, least) = bracket(bend, &value_at, &slope_at, at.later(&at.rest.like(ahead)))
                .ok_or_else(|| stop(Unproved::Digits, &at))?;
            let time = Interval::point(zero.since(&at)) + Interval::point(reach);
            // Lemma H8 looks ahead only.
            if at.since(&zero) < reach && (slope + bend * time).sup() < 0.0 {
                let rest = zero.rest.interval();
                let reach = (Interval::point(reach) + Interval::point(rest.wid())).sup();
                let turns = turns::later(turns, zero.turns).ok_or_else(|| stop(Unproved::Steps, &at))?;
                // Lemma H8: within `reach` of the rounded place, which is within as much of the zero.
                let least = (Interval::point(least) + bend * Interval::point(2.0 * reach)).inf();
                let zero = Zero { spectrum: spectrum.clone(), wall, turns, near: rest.mid(), reach, least, bend };
                return is_positive(least).then_some(zero).ok_or_else(|| stop(Unproved::Digits, &at));
            }
        }
        let step = 0.98 * (low + (low * low + 2.0 * fourth * p).sqrt()) / fourth;
        let next = at.later(&at.rest.like(step));
        let time = Interval::point(next.since(&at));
        let least = value + time * (slope + Interval::within(0.5 * fourth) * time);
        if !(is_positive(time.inf()) && is_positive(least.inf())) {
            return Err(stop(Unproved::Digits, &at));
        }
        at = next;
    }
    Err(stop(Unproved::Steps, &at))
}

/// Bracket of a zero near a time: the time, its greatest distance from the zero, and the least slope; slopes change by `bend` per forcing period.
fn bracket<N: FlightNumber>(
    bend: Interval,
    value_at: &impl Fn(&Instant<N>) -> N,
    slope_at: &impl Fn(&Instant<N>) -> Interval,
    near: Instant<N>,
) -> Option<(Instant<N>, f64, f64)> {
    let mut at = near;
    let mut before = f64::INFINITY;
    for _ in 0..STEPS {
        let (p, slope) = (value_at(&at), slope_at(&at));
        let back = p.ratio_to(&at.rest.like(slope.mid()))?;
        let (value, size) = (p.interval(), back.bounds().0.abs());
        if value.contains(0.0) || !is_positive(0.75 * before - size) {
            let widest = (2.0 * value.mag() / -slope.sup()).next_up(); // more than the quotient below of an exact zero
            let least = (-slope + bend * Interval::point(widest)).inf();
            let reach = Interval::point(value.mag()).checked_div(Interval::point(least))?.sup();
            return (least > 0.0 && reach <= widest).then_some((at, reach, least));
        }
        (at, before) = (at.later(&-back), size);
    }
    None
}

impl Zero {
    /// Encloses the phase of the release, less the whole forcing periods, in doubles.
    pub fn phase(&self) -> Ball {
        Ball::new(self.near, self.reach)
    }

    /// Encloses the phase of the release as narrowly as `bits` bits allow in this build.
    pub fn enclosure(&self, bits: u32) -> Option<Enclosure> {
        precise::enclosure(self, bits)
    }

    /// Whole forcing periods of `later`, counted as those of `self`, if both are proved to be whole common periods apart (Lemma H9).
    pub fn turns_of_same(&self, later: &Self) -> Option<i64> {
        let period = i64::try_from(self.spectrum.period?).ok()?;
        let apart = Interval::point(later.near) - Interval::point(self.near);
        // exact: -1, 0 or 1, half a period is written in two ways
        let whole = apart.mid().round();
        let turns = later.turns + whole as i64; // N1: one forcing period more
        let (apart, reaches) =
            ((apart - Interval::point(whole)).abs(), Interval::point(self.reach) + Interval::point(later.reach));
        let is_one = (Interval::point(self.least) + self.bend * (apart + reaches)).inf() > 0.0;
        let overlap = apart.inf() <= reaches.sup();
        (self.wall == later.wall && (turns - self.turns) % period == 0 && overlap && is_one).then_some(turns)
    }
}
