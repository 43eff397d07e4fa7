//! The flight between two successive impacts, and the phase of an impact.

use std::cmp::Ordering;

use super::{Impact, Orbit, Rest};
use crate::exact::Enclosure;
use crate::mapping::Sheared;
use crate::number::{Ball, Enclosing};
use crate::pair::Inward;
use crate::shaken::State;
use crate::units::in_radians;

/// Bits beyond those of a number of forcing periods and of the listed bounds.
const SPARE_BITS: u32 = 64;

impl Orbit {
    /// Phase `W t + tau` of an impact \[rad\]: its lower bound in `[0, 2 pi)`, the upper one beyond if it may be 0.
    pub fn phase(&self, impact: &Impact) -> Enclosure {
        in_radians(&impact.enclosures().0, self.requested.shown)
    }

    /// Phase `(W t + tau)/(2 pi)` of an impact, whole forcing periods included.
    pub(crate) fn turns_of(&self, impact: &Impact) -> Enclosure {
        let whole = self.clock.origin() + impact.turns;
        // X1: any number of bits encloses
        let bits = self
            .requested
            .shown
            .saturating_add(u32::try_from(whole.bits()).unwrap_or(u32::MAX / 2))
            .saturating_add(SPARE_BITS);
        Enclosure::from_rational(&whole.into(), bits).add(&impact.enclosures().0, bits)
    }

    /// Bits of printed bounds beyond the digits.
    pub(crate) fn shown_bits(&self) -> u32 {
        self.requested.shown
    }

    /// Bounds of an impact's velocity \[length/time\], before the impact.
    pub fn velocity(&self, impact: &Impact) -> Enclosure {
        self.clock.velocity(&impact.enclosures().1)
    }

    /// Forcing periods from one impact to a later one.
    pub fn turns_between(&self, from: &Impact, to: &Impact) -> Ball {
        // More than 2^53 forcing periods are rounded, and then the ball of phases is not worth anything: it is widened by that.
        let whole = to.turns - from.turns;
        // N1: twice what the cast below may round
        let rounding = if whole.unsigned_abs() < 1 << 53 { 0.0 } else { f64::EPSILON * whole as f64 };
        Ball::new(whole as f64, rounding.abs()) + (to.phase - from.phase) // N1
    }

    /// Jacobian (A.7) of the flight between two impacts in a row, times in forcing periods, velocities in gap widths per forcing period.
    ///
    /// **Enclosure**: holds the Jacobian at every member of the two impacts. `None` when the later impact may be a graze.
    pub fn jacobian(&self, from: &Impact, to: &Impact) -> Option<[[Ball; 2]; 2]> {
        self.passage(self.engine.pair.restitution, from, to).map(Sheared::jacobian)
    }

    /// Jacobian in two parts, from an impact or from the requested start; for a start inside the gap only the velocity's column is meant.
    pub(super) fn sheared(&self, from: Option<&Impact>, to: &Impact) -> Option<Sheared<Ball>> {
        if let Some(from) = from {
            return self.passage(self.engine.pair.restitution, from, to);
        }
        let State { turns, phase, velocity, .. } = self.initial;
        let wall = self.initial.place.wall();
        // F3: inside the gap the velocity is that of the flight, as after an impact with e = -1.
        let restitution = if wall.is_some() { self.engine.pair.restitution } else { Ball::exact(-1.0) };
        let start = Impact { index: 0, mapping: None, wall: to.wall, turns, phase, velocity, precise: None };
        self.passage(restitution, &start, to)
    }

    /// Jacobian (A.7) of a flight between two states.
    fn passage(&self, restitution: Ball, from: &Impact, to: &Impact) -> Option<Sheared<Ball>> {
        let accelerations =
            [from, to].map(|impact| self.engine.given.shaken.displacement(impact.turns, impact.phase)[2]);
        Sheared::between(restitution, self.turns_between(from, to), accelerations, [from.velocity, to.velocity])
    }

    /// The requested start as impact number 0, when it is on a wall.
    pub fn start_impact(&self) -> Option<Impact> {
        let State { turns, phase, velocity, .. } = self.initial;
        let wall = self.initial.place.wall();
        wall.map(|wall| Impact { index: 0, mapping: None, wall, turns, phase, velocity, precise: None })
    }

    /// Whether the ball is proved to leave the wall of an impact, with a velocity that is not 0 or an acceleration away from the wall. Lemma L3
    pub(crate) fn leaves(&self, impact: &Impact) -> bool {
        let moves = |x: Ball| x.certain_sign().is_some_and(Ordering::is_ne);
        let [_, _, acceleration] = self.engine.given.shaken.displacement(impact.turns, impact.phase);
        moves(self.engine.pair.restitution) && moves(impact.velocity)
            || impact.wall.inward(acceleration).certain_sign() == Some(Ordering::Greater)
    }

    /// Whether all motions that start near a motion with this rest come to rest as well. Lemma L3
    pub(crate) fn forgets(&self, rest: &Rest) -> bool {
        let is_edge = self.engine.given.shaken.may_be_loose(rest.at.wall, rest.at.turns, &rest.at.phase);
        // Lemma L3: without loss neighbours bounce for ever.
        self.engine.pair.restitution.mag() < 1.0
            && self.engine.pair.beta.certain_sign() == Some(Ordering::Greater)
            && !is_edge
    }

    /// `e`
    pub fn restitution(&self) -> Ball {
        self.engine.pair.restitution
    }
}
