//! The enclosure disposes: floating-point proposals are proved.
//!
//! Lemmas C3 (one root), C4 (nothing earlier on pieces), C5 (monotone flights) and C6 (hops) of
//! `docs/proofs/flights.md#C3`, same labels, with the bounds of [`super::bounds`].

use std::cmp::Ordering;

use super::bounds::{Bounds, HOP_SINE_ERROR, NARROW, Radii, SLACK, TAU};
use super::extrema::{Extrema, Target};
use super::solve::{Iterate, look_near};
use crate::number::kernel::{ACOS_ERROR, SIN_COS_ERROR, SmallAngle};
use crate::number::{Ball, Kernel, UNIT, binade, up};

/// The wall, phase and time of a flight's arrival: exactly one root of the piece lies in these bounds, for each start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arrival {
    pub target: Target,
    /// Whole forcing periods between the start's phase and the phase of arrival.
    pub turns: f64,
    /// Phase of arrival less the whole forcing periods.
    pub phase: Ball,
    /// Time since the start, in forcing periods.
    pub time: Ball,
}

/// A proved arrival, with what is known of the state there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bracket {
    pub arrival: Arrival,
    /// `z'` on arrival.
    pub velocity: Ball,
    /// Mirrored sine on arrival.
    pub sin: Ball,
    /// The part of the velocity's radius that does not come from the radius of the root.
    pub rest: f64,
}

/// Property that could not be proved of a bracketed contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Doubt {
    /// The direction of departure is not certain.
    SmallAngle,
    /// An extremum of this kind may touch its wall.
    Extremum { target: Target },
    /// The contact may lie at an extremum.
    Location,
}

/// Longest flight from a wall, in forcing periods, that is bracketed with the departure root divided out; the formulas hold up to 1/8.
pub(super) const SHORT_FLIGHT: f64 = 0.124;

/// Whether the kernel accepts a time, of a flight that ends near its start (Lemma K2).
#[inline(always)]
pub(super) fn is_near_time(time: f64) -> bool {
    (4.909093465297727e-91..=0.125).contains(&time)
}

/// A root proved by Lemma C3.
struct Root {
    /// Exactly one root for each start lies in here.
    at: Ball,
    /// `z'` there.
    velocity: Ball,
    /// The mirrored sine there.
    sin: Ball,
    /// The part of the velocity's radius that does not come from the radius of the root.
    rest: f64,
}

impl<const WIDE: bool> Bounds<'_, WIDE> {
    /// Bracket around a proposed contact of a flight that is no hop (Lemma C3).
    #[inline(always)]
    pub fn bracket(&self, iterate: &Iterate) -> Option<Bracket> {
        let (flight, turns) = (self.flight, iterate.turns);
        let elapsed = flight.elapsed(turns, iterate.at);
        if elapsed <= SHORT_FLIGHT && self.is_on_wall() {
            return self.short_bracket(iterate.target, turns + (iterate.at - flight.phase) - iterate.step);
        }
        let (bracket, is_proved) = self.long_bracket(iterate, elapsed);
        is_proved.then_some(bracket)
    }

    /// Bracket `elapsed` forcing periods after the start, and whether it is proved.
    #[inline(always)]
    pub fn long_bracket(&self, iterate: &Iterate, elapsed: f64) -> (Bracket, bool) {
        let (flight, turns) = (self.flight, iterate.turns);
        let error = self.height(elapsed, turns, iterate.sin, iterate.residual);
        // One unit more than the kernel's for the rounding of the sine at the root.
        let sine_error = SIN_COS_ERROR + UNIT;
        let (Root { at, velocity, sin, rest }, is_proved) =
            self.root(iterate, error, self.velocity(iterate.velocity), sine_error, self.pair.bend);
        let time = turns + (at.mid() - flight.phase);
        let rounding = UNIT * (2.0 * time.abs() + turns.abs());
        let time = Ball::new(time, up(at.rad() + self.phase_radius() + rounding));
        let arrival = Arrival { target: iterate.target, turns, phase: at, time };
        (Bracket { arrival, velocity, sin, rest }, is_proved)
    }

    /// A bracket around the end of a short flight from a wall, `time` after its start.
    ///
    /// With the departure root divided out, the errors are relative to the flight and not to a whole forcing period.
    #[inline(never)]
    fn short_bracket(self, target: Target, time: f64) -> Option<Bracket> {
        if !is_near_time(time) {
            return None;
        }
        let (iterate, departure) = look_near::<Kernel>(self.flight, target, time);
        self.hop_bracket(&iterate, &departure)
    }

    /// Bracket around the end of a hop (Lemma C3).
    #[inline(always)]
    pub fn hop_bracket(&self, iterate: &Iterate, departure: &SmallAngle) -> Option<Bracket> {
        let (bracket, is_proved) = self.near_bracket(iterate, departure);
        is_proved.then_some(bracket)
    }

    /// Bracket around the end of a hop, and whether it is proved.
    #[inline(always)]
    pub fn near_bracket(&self, iterate: &Iterate, departure: &SmallAngle) -> (Bracket, bool) {
        let SmallAngle { versine, excess, sine } = *departure;
        let error = self.hop_height(iterate.at, versine + excess, iterate.residual);
        let velocity_error = self.hop_velocity(versine + sine, iterate.velocity);
        let turned = TAU * self.radii.phase;
        let sine_error = HOP_SINE_ERROR + turned;
        let bend_error = self.pair.bend + self.pair.acceleration * turned;
        let (Root { at, velocity, sin, rest }, is_proved) =
            self.root(iterate, error, velocity_error, sine_error, bend_error);
        let phase = self.flight.phase + at.mid();
        let phase = Ball::new(phase, up(at.rad() + self.phase_radius() + UNIT * binade(phase)));
        let arrival = Arrival { target: iterate.target, turns: 0.0, phase, time: at };
        (Bracket { arrival, velocity, sin, rest }, is_proved)
    }

    /// Lemma C3: exactly one root near the end of the iterate's step, for every start.
    ///
    /// The errors are those of `z`, `z'`, the sine and `z''` at the iterate. `None` when the velocity's sign around
    /// it, or the root's existence, cannot be proved.
    #[inline(always)]
    fn root(
        &self,
        iterate: &Iterate,
        error: f64,
        velocity_error: f64,
        sine_error: f64,
        bend_error: f64,
    ) -> (Root, bool) {
        let pair = self.pair;
        let Iterate { target, at, residual, velocity, sin, cos, step, .. } = *iterate;
        // Within `reach` of the iterate z' differs from its computed value by the fraction `doubt` at most.
        let inverse = 1.0 / velocity.abs();
        let reach = 2.0 * (residual.abs() + error) * inverse;
        let most = pair.acceleration;
        // C3: no sine is greater than 1
        let curvature = if WIDE { most * (sin.abs() + sine_error + TAU * reach).min(1.0) } else { most };
        let doubt = SLACK * curvature.mul_add(reach, velocity_error) * inverse;
        let size = step.abs();
        let is_proved = (doubt <= 0.49) & (size <= reach) & (velocity * target.direction() > 0.0);
        // `left` is |z| at the end of the step, by Taylor's formula; the root is not farther than that over the least |z'|.
        let bend = self.flight.acceleration_at(sin);
        let left = (0.5 * bend * step).mul_add(step, (-velocity).mul_add(step, residual)).abs();
        let taylor = pair.jerk.mul_add(size, bend_error).mul_add(size, velocity_error) * size;
        // 1/(1 - x) <= 1 + 2.1 x up to x = 0.49.
        let tail = (left + taylor + error) * inverse * doubt.mul_add(2.1, 1.0);
        let root = at - step;
        let radius = SLACK * UNIT.mul_add(binade(root), tail);
        let distance = size + radius;
        let (velocity, sin) = self.flight.arrive(iterate.velocity, (sin, cos), step);
        let cubic = (2.1 * pair.jerk * distance).mul_add(distance, bend_error * distance.mul_add(4.0, 1.0));
        let rest = SLACK * (cubic.mul_add(distance, velocity_error) + UNIT * binade(velocity));
        let slope = SLACK * (2.0 * pair.jerk).mul_add(distance, curvature);
        let sine_radius = SLACK * (sine_error * distance.mul_add(7.0, 1.0) + TAU * radius + 20.0 * distance * distance);
        let root = Root {
            at: Ball::new(root, radius),
            // One more rounding, which the slack of both terms covers.
            velocity: Ball::new(velocity, slope.mul_add(radius, rest)),
            sin: Ball::new(sin, sine_radius),
            rest,
        };
        (root, is_proved)
    }

    /// Lemma C5: `z'` keeps its sign for ever, so the root of a monotone flight is the first contact.
    #[inline(always)]
    pub fn is_monotone(&self, arrival: &Arrival) -> Result<(), Doubt> {
        if self.is_clearly_monotone() || self.is_release() { Ok(()) } else { self.is_nearly_monotone(*arrival) }
    }

    /// Lemma C5: the drift is greater than `beta`.
    #[inline(always)]
    pub fn is_clearly_monotone(&self) -> bool {
        let margin = self.flight.drift.abs() - self.flight.beta;
        margin > self.slope() + self.beta_radius() + 2.0 * UNIT * self.flight.drift.abs()
    }

    /// Lemma C5: a start without velocity at exactly `sin th0 = 0`, where `z' = c (1 - cos(th1 - th0))`.
    #[cold]
    fn is_release(self) -> bool {
        let nothing = Radii { height: self.radii.height, ..Radii::default() };
        self.flight.velocity == 0.0 && self.flight.sin == 0.0 && self.radii == nothing // C5: all three exactly
    }

    /// The drift is so close to `beta` that extrema may or may not exist: treated as if they did (Lemma C4).
    // Cold functions take copies: a reference would keep the hot path's values in memory.
    #[cold]
    fn is_nearly_monotone(self, arrival: Arrival) -> Result<(), Doubt> {
        let extrema = Extrema::new::<Kernel>(self.flight);
        let (first, _) = extrema.before(arrival.target);
        let k = (arrival.time.mid() - first).ceil().max(0.0); // proposes: C4 is proved for this k
        // The heights were computed `shift` forcing periods at most from the true extrema, where |z'| <= 28 beta shift^2.
        let shift = self.critical_phase();
        self.is_on_first_piece(&extrema, k, &arrival, 60.0 * self.pair.beta * shift * shift * shift)
    }

    /// Lemma C6: concave all along, so there is one root only, and the far wall is out of reach.
    #[inline(always)]
    pub fn is_one_hop(&self, bracket: &Bracket) -> Result<(), Doubt> {
        let start = self.flight.sin + SLACK * (SIN_COS_ERROR + TAU * self.radii.phase) < 0.0;
        let end = bracket.sin.mid() + bracket.sin.rad() < 0.0;
        let leaves = self.flight.velocity > self.radii.velocity;
        let longest = bracket.arrival.time.mag();
        if self.is_on_wall() && start && end && leaves && longest < 0.25 && up(self.speed() * longest) < 1.0 {
            Ok(())
        } else {
            Err(Doubt::SmallAngle)
        }
    }

    /// Lemma C4 for a piece of the solver's.
    #[inline(always)]
    pub fn is_first(&self, extrema: &Extrema, k: f64, arrival: &Arrival) -> Result<(), Doubt> {
        self.is_on_first_piece(extrema, k, arrival, 0.0)
    }

    /// Whether [`is_first`](Self::is_first) follows from coarse heights of the extrema, without refinement.
    #[inline(always)]
    pub fn is_plainly_first(&self, extrema: &Extrema, k: f64, arrival: &Arrival) -> bool {
        let is_on_piece = self.is_narrow() & self.is_between(extrema, k, arrival, NARROW);
        let (_, coarse) = self.extrema_errors(arrival, NARROW, 0.0);
        let is_clear = extrema.is_on_first(k, arrival.target)
            | extrema.are_inside(self.flight.drift, k, arrival.target, coarse).is_ok();
        self.departure_is_certain(extrema.rising) & is_on_piece & is_clear
    }

    /// Lemma C4: the extrema before the piece of the contact stay inside the gap, and the contact is on its piece.
    ///
    /// `clamped` is an additional error of the extrema's heights.
    #[inline(always)]
    fn is_on_first_piece(&self, extrema: &Extrema, k: f64, arrival: &Arrival, clamped: f64) -> Result<(), Doubt> {
        if !self.departure_is_certain(extrema.rising) {
            return Err(Doubt::SmallAngle);
        }
        let mut shift = NARROW;
        if !(self.is_narrow() && self.is_between(extrema, k, arrival, shift)) {
            shift = self.critical_phase();
            if !self.is_between(extrema, k, arrival, shift) {
                return Err(Doubt::Location);
            }
        }
        if extrema.is_on_first(k, arrival.target) {
            return Ok(());
        }
        let (error, coarse) = self.extrema_errors(arrival, shift, clamped);
        let clear = extrema.are_inside(self.flight.drift, k, arrival.target, coarse);
        if clear.is_ok() { clear } else { self.are_inside_refined(*extrema, k, arrival.target, error) }
    }

    /// Whether the contact is on its piece, for critical phases that may be `shift` off: later than the extremum before last of its kind, earlier
    /// than the last. The sign of `z'` is proved on the bracket.
    #[inline(always)]
    fn is_between(&self, extrema: &Extrema, k: f64, arrival: &Arrival, shift: f64) -> bool {
        let (first, _) = extrema.before(arrival.target);
        let place = (arrival.turns - k) + ((arrival.phase.mid() - self.flight.phase) - first);
        let margin = up(shift + arrival.phase.rad());
        place > margin - 1.0 && place < -margin
    }

    /// Errors of the extrema's heights at the computed critical phases, and as they are computed first.
    #[inline(always)]
    fn extrema_errors(&self, arrival: &Arrival, shift: f64, clamped: f64) -> (f64, f64) {
        let error = self.extremum(arrival.time.mag() + shift) + clamped;
        (error, SLACK * ACOS_ERROR.mul_add(self.flight.drift.abs(), error))
    }

    /// As `are_inside`, with the heights of the extrema at the computed critical phase (Lemma E2).
    #[cold]
    fn are_inside_refined(self, mut extrema: Extrema, k: f64, target: Target, error: f64) -> Result<(), Doubt> {
        extrema.refine::<Kernel>(self.flight);
        let stationary = self.pair.alpha * (SIN_COS_ERROR + 20.0 * ACOS_ERROR * ACOS_ERROR);
        extrema.are_inside(self.flight.drift, k, target, SLACK * (error + stationary))
    }

    /// Whether all starts leave in the same direction and on the same monotone piece.
    #[inline(always)]
    fn departure_is_certain(&self, rising: bool) -> bool {
        let flight = self.flight;
        // Lemma C4: rising pieces meet at the mirrored phase 0, falling ones at 1/2, where the drift reaches beta. Starts on
        // both sides would not share a piece, and a mirrored phase as near as its rounding may be on the wrong one.
        let mirrored = flight.phase + flight.wall.mirror_phase();
        let from_zero = (mirrored - mirrored.round()).abs(); // C4: exact (Sterbenz)
        let room = if rising { from_zero } else { 0.5 - from_zero };
        if room.partial_cmp(&(SLACK * self.phase_radius() + 4.0 * UNIT)) != Some(Ordering::Greater) {
            return false;
        }
        // C4: exactly no velocity
        if flight.velocity == 0.0 && self.radii.velocity == 0.0 {
            flight.sin.abs() > SLACK * (SIN_COS_ERROR + TAU * self.radii.phase)
        } else {
            flight.velocity.abs() > self.radii.velocity
        }
    }
}

impl Extrema {
    /// Whether the piece before extremum `k` begins with the flight, without an extremum before it.
    #[inline(always)]
    fn is_on_first(&self, k: f64, target: Target) -> bool {
        // C4: extremum 0 ends the first piece
        self.rising == (target == Target::Far) && k == 0.0
    }

    /// Whether the extrema that come before extremum `k` of the target's kind are `margin` inside the gap.
    ///
    /// Of this kind the extremum before `k` decides, as the drift brings each nearer to the wall than the one before. Of the other kind the first
    /// extremum decides.
    #[inline(always)]
    fn are_inside(&self, drift: f64, k: f64, target: Target, margin: f64) -> Result<(), Doubt> {
        let last = k - 1.0;
        let (max_number, min_number) = match target {
            Target::Far => (last, 0.0),
            Target::Near => (0.0, last),
        };
        let is_below = 1.0 - max_number.mul_add(drift, self.max) > margin;
        if max_number >= 0.0 && !is_below {
            return Err(Doubt::Extremum { target: Target::Far });
        }
        let is_above = min_number.mul_add(drift, self.min) > margin;
        if min_number >= 0.0 && !is_above {
            return Err(Doubt::Extremum { target: Target::Near });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
