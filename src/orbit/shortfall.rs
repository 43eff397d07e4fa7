//! The treatment of a motion that does not suffice: more precision, a graze passed, or an undecided end.

use super::event::{Outcome, Progress};
use super::{Arithmetic, Cursor, Orbit};
use crate::contact::{Contact, Reason, Undecided};
use crate::exact::Enclosure;
use crate::flight::Launch;
use crate::impact::finite;
use crate::number::Ball;
use crate::shaken::{Since, clear};
use crate::turns;

/// Bits that `auto` takes to distinguish a graze from a near one: at `2^-4000` of the gap both are called a graze.
pub(crate) const GRAZE_BITS: u32 = 4096;

/// The quantity that a motion lacks.
#[derive(Clone, Copy, Debug)]
pub(super) enum Shortfall {
    /// Bits of the requested width.
    Width(f64),
    /// A decision.
    Verdict,
}

/// The obstacle to narrower enclosures, of an orbit that has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Limit {
    /// The bits: more of them make every enclosure narrower.
    Bits,
    /// The intervals among the data.
    Intervals,
    /// The states past a contact that may be a graze: a box whose size the bits before it limit.
    Graze,
    /// Nothing makes the question decidable: the orbit ends at it with any data near by and in any precision.
    Lasting,
}

impl Orbit {
    /// Obstacle to narrower enclosures.
    pub(crate) fn limit(&self) -> Limit {
        match (self.pending.is_lasting, self.engine.is_point, self.requested.is_point) {
            (true, ..) => Limit::Lasting,
            (false, true, _) => Limit::Bits,
            (false, false, false) => Limit::Intervals,
            (false, false, true) => Limit::Graze,
        }
    }

    /// Number of bits by which a contact is wider than requested; not positive if it is not wider.
    #[inline]
    pub(super) fn excess(&self, turns: i64, contact: &Contact<Ball>) -> f64 {
        let [time, velocity] = self.requested.widths;
        let (of_time, of_velocity) = self.clock.widths(turns, contact.phase, contact.velocity);
        if of_time <= time.linear && of_velocity <= velocity.linear {
            return 0.0;
        }
        self.excess_below_doubles(turns, contact)
    }

    /// Number of bits by which a contact is wider than requested, where doubles are too coarse to decide.
    #[cold]
    fn excess_below_doubles(&self, turns: i64, contact: &Contact<Ball>) -> f64 {
        let [time, velocity] = self.requested.widths;
        let radii = self.engine.motion.radii();
        let radii = radii.unwrap_or((contact.phase.rad().log2(), contact.velocity.rad().log2())); // shown
        let (of_time, of_velocity) = self.clock.log2_widths(turns, radii, contact.velocity);
        let excess = [of_time - time.log2, of_velocity - velocity.log2];
        // A maximum would pass over a NaN.
        if excess.iter().any(|x| x.is_nan()) { f64::INFINITY } else { excess[0].max(excess[1]) } // shown
    }

    /// Phase and velocity as intervals where doubles are too coarse to show them.
    pub(super) fn precise(&self, contact: &Contact<Ball>) -> Option<(Enclosure, Enclosure)> {
        let in_full = matches!(self.engine.arithmetic, Arithmetic::Bits(_));
        let [time, velocity] = self.requested.widths;
        let fine = 4.0 * contact.phase.rad() <= time.linear && 4.0 * contact.velocity.rad() <= velocity.linear;
        if fine && !in_full {
            return None;
        }
        self.engine.motion.enclosures(self.requested.shown)
    }

    /// Goes on in more precision, past a graze, or ends the orbit: the motion cannot go on.
    #[cold]
    pub(super) fn give_up(&mut self, undecided: Undecided) -> Progress {
        // C7: no wall is touched up to the time to stop at, whatever comes later.
        if self.requested.until.is_some() && self.is_after_until(&self.not_before(&undecided).0) {
            return self.finish(Outcome::TimeReached);
        }
        // A contact that the precision does not distinguish from a graze is called a graze; both continuations are then followed as one set.
        let may_graze = undecided.reason == Reason::Graze && self.cursor.index == self.listed;
        let deep = self.engine.arithmetic != Arithmetic::Auto || self.engine.motion.bits() >= GRAZE_BITS;
        if may_graze
            && deep
            && let Some(graze) = self.pass_graze()
        {
            return graze;
        }
        if !undecided.lasting && self.restart(Shortfall::Verdict) {
            return Progress::Retraced(0);
        }
        match may_graze.then(|| self.pass_graze()).flatten() {
            Some(graze) => graze,
            None => self.end(undecided),
        }
    }

    /// A contact is wider than requested by `excess` bits; `None` when the contact has to be taken as it is.
    #[cold]
    pub(super) fn narrow(&mut self, contact: &Contact<Ball>, excess: f64) -> Option<Progress> {
        // Of intervals whose `A W` may be 0 nothing is narrow enough relative to it.
        let is_hopeless = !self.engine.is_point && excess.is_infinite();
        if self.engine.arithmetic != Arithmetic::Auto || self.first_wide.is_some() || is_hopeless {
            return None;
        }
        if self.restart(Shortfall::Width(excess)) {
            return Some(Progress::Retraced(0));
        }
        self.engine.is_point.then(|| self.end(Undecided::precision(contact)))
    }

    /// Starts again in more precision, if that may help.
    pub(super) fn restart(&mut self, shortfall: Shortfall) -> bool {
        let Some(raise) = &mut self.engine.raise else { return false };
        let Some(motion) =
            raise.again(shortfall, self.cursor.index - self.followed.from.index, self.engine.motion.accuracy())
        else {
            return false;
        };
        self.engine.motion = motion;
        self.cursor = self.followed.from;
        true
    }

    /// The flights from the last state.
    fn launch(&self) -> Option<Launch<Ball>> {
        let Cursor { wall, height, turns, phase, velocity, .. } = self.cursor;
        let from_wall = |wall| Launch::from_wall(wall, turns, phase, self.engine.pair.rebound_of(velocity), false);
        height.map_or_else(|| wall.map(from_wall), |height| Some(Launch::from_inside(height, turns, phase, velocity)))
    }

    /// The orbit ends undecided.
    pub(super) fn end(&mut self, undecided: Undecided) -> Progress {
        let time = self.not_before(&undecided);
        self.pending.is_lasting = undecided.lasting;
        self.outcome = Some(Outcome::Undecided { reason: undecided.reason, wall: undecided.wall, time });
        Progress::Ended
    }

    /// Encloses a time up to which no wall is touched after the last state (Lemma C7), and the next contact, where that is proved \[time\].
    fn not_before(&self, undecided: &Undecided) -> (Enclosure, Option<Enclosure>) {
        let Cursor { turns, phase, .. } = self.cursor;
        let now = || self.clock.time(turns, &finite(phase));
        let later = |whole: f64, rest: Ball| {
            turns::after(turns, whole).map(|turns| self.clock.time(turns, &finite(phase + rest)))
        };
        let contact = undecided.contact.and_then(|since| {
            let whole = since.mid().floor(); // N1: the rest is kept
            later(whole, since - Ball::exact(whole))
        });
        let clear = || {
            let Since { whole, rest } = clear(&*self.engine.given.shaken, &self.launch()?);
            later(whole, Ball::exact(rest))
        };
        (contact.clone().or_else(clear).unwrap_or_else(now), contact)
    }
}
