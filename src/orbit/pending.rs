//! Events of an orbit besides impacts: grazes, rests, releases, repetition.

use std::cmp::Ordering;

use super::Period;
use super::attraction::Recent;
use super::event::{Outcome, Progress, Rest};
use super::recurrence::Recurrence;
use super::shadowed::NearbyStart;
use super::shortfall::Shortfall;
use super::{Cursor, Followed, Orbit};
use crate::contact::{Grazed, Undecided};
use crate::exact::{Enclosure, Exact};
use crate::impact::{Graze, Impact, Touch, finite};
use crate::number::{Ball, Enclosing, Magnitude};
use crate::orbit::Arithmetic;
use crate::pair::{Inward, Wall};
use crate::shaken::{Origin, Released, Still};
use crate::turns;

/// Greatest half width, in gap widths, to which narrower bounds of a graze's distance are widened: a fourth of the width that `check` allows.
const MOST_SHOWN: f64 = 1e-6 / 8.0;

/// State of an orbit apart from flights: rests, releases, repetitions, and the end of the list.
#[derive(Debug, Default)]
pub(super) struct Pending {
    /// A rest has come, or no wall is ever hit: `pending` has to look at the other fields.
    pub is_expected: bool,
    /// The ball rests.
    pub resting: Option<Resting>,
    /// Number of grazes so far, of a motion that hits no wall.
    pub grazes: u64,
    pub recurrence: Recurrence,
    /// All that was requested is listed, with this outcome; the proof of an attractor is still due.
    pub reached: Option<Outcome>,
    /// No precision decides the open question at the end.
    pub is_lasting: bool,
    /// The requested time has ended the list.
    pub is_late: bool,
    /// Listed impacts whose bounds may reach past the requested time.
    pub late: Vec<Impact>,
    /// The last impacts handed out.
    pub recent: Recent,
    /// Starts, one of which has the orbit, if the orbit is a shadowed one.
    pub near: Option<NearbyStart>,
}

/// The end of a rest.
#[derive(Debug)]
pub(super) enum Resting {
    ForEver,
    Until(Released),
    /// Neither a release nor that there is none is proved.
    Undecided,
}

impl Orbit {
    /// The next event of a motion that has rested, or never hits a wall; `None` when the next flight is due.
    #[cold]
    pub(super) fn pending(&mut self) -> Option<Progress> {
        if self.pending.reached.is_some() {
            return Some(Progress::Ended);
        }
        if let Some(still) = self.followed.still {
            return Some(self.graze_again(still));
        }
        if let Some(event) = self.pending.recurrence.repeat() {
            return Some(match event {
                Ok(event) => self.repeat(event),
                Err(endless) => self.give_up(endless),
            });
        }
        self.pending.resting.take().map(|resting| self.release(resting))
    }

    /// The next graze of a motion that only grazes, once per forcing period, or the end if it does not even graze.
    #[cold]
    fn graze_again(&mut self, still: Still) -> Progress {
        let Cursor { turns, phase, .. } = self.cursor;
        let Some((wall, turns, at)) = still.graze_after(turns, phase.mid()) else {
            self.outcome = Some(Outcome::NeverImpacts);
            return Progress::Ended;
        };
        self.pending.grazes += 1;
        let is_late = self.is_past(turns, Ball::exact(at), || finite(Ball::exact(at)));
        if is_late || self.requested.settings.impacts.is_some_and(|impacts| self.pending.grazes > impacts) {
            self.outcome = Some(Outcome::Periodic(Period { cycles: 1, impacts: 0 }));
            self.pending.is_late = is_late;
            return Progress::Ended;
        }
        (self.cursor.turns, self.cursor.phase) = (turns, Ball::exact(at));
        let zero = || finite(Ball::exact(0.0));
        let at = Touch { wall, turns, phase: finite(Ball::exact(at)) };
        Progress::Graze(Box::new(Graze { at, distance: zero(), speed: zero() }))
    }

    /// An event of a motion that is proved to be periodic.
    fn repeat(&mut self, event: Progress) -> Progress {
        let (turns, enclosed) = match &event {
            Progress::Impact(impact) => (impact.turns, impact.enclosures().0),
            Progress::Graze(graze) => (graze.at.turns, graze.at.phase.clone()),
            Progress::Release(touch) => (touch.turns, touch.phase.clone()),
            // V7: a rest with impacts that may come in time is not repeated
            Progress::Rest(_) | Progress::Retraced(_) | Progress::Ended => return event,
        };
        let (mid, rad) = enclosed.mid_rad();
        let phase = Ball::new(mid, rad);
        if self.is_past(turns, phase, || enclosed) {
            return self.finish(Outcome::TimeReached);
        }
        if let Progress::Impact(impact) = &event {
            self.listed = impact.index;
            self.note_nearness(impact.phase);
            self.note_lateness(impact);
        }
        event
    }

    /// Exact state of the motion, while it is still the one that is followed from.
    fn exactly(&self) -> Option<&Origin<Exact>> {
        let is_there = self.followed.is_given && self.cursor.index == self.followed.from.index;
        is_there.then_some(&self.engine.given.origin)
    }

    /// The ball chatters and comes to rest, or does not leave at all: proved by Lemmas Z1 and Z2, or `None`.
    #[cold]
    pub(super) fn come_to_rest(&mut self) -> Option<Progress> {
        let wall = self.cursor.wall.filter(|_| self.cursor.height.is_none())?;
        let after = wall.inward(self.engine.pair.rebound_of(self.cursor.velocity));
        let is_still = self.engine.pair.beta == Ball::exact(0.0);
        let Cursor { turns, phase, .. } = self.cursor;
        let phase = self.engine.motion.enclosures(u32::MAX).map_or_else(|| finite(phase), |(phase, _)| phase);
        let phases: &[Exact] = self.exactly().map_or(&[], |origin| &origin.phases);
        let time = match is_still {
            true => (after == Ball::exact(0.0)).then_some(0.0)?,
            false => self.engine.given.shaken.accumulation(wall, turns, &phase, after, phases)?,
        };
        self.rest(wall, &phase, time, is_still)
    }

    /// The ball rests from at most `time` forcing periods after the last contact on.
    #[cold]
    fn rest(&mut self, wall: Wall, now: &Enclosure, time: f64, for_ever: bool) -> Option<Progress> {
        if time > 0.0 && !self.bounces() {
            return None;
        }
        let width = self.requested.widths[0];
        // Impacts are listed until they shrink below the requested digits.
        if time.log2() > width.log2 - 1.0 {
            return None;
        }
        let Cursor { turns, phase, .. } = self.cursor;
        if time > 0.0 && !self.is_in_time(turns, &self.until_rest(now, time)?) {
            return None;
        }
        let radius = self.engine.motion.radii().map_or(phase.rad().log2(), |radii| radii.0);
        let is_wide = radius > width.log2 - 2.0;
        if is_wide && self.engine.arithmetic == Arithmetic::Auto && self.restart(Shortfall::Width(1.0)) {
            return Some(Progress::Retraced(0));
        }
        let exactly = self.exactly().map(|origin| origin.state.phase.enclose(self.requested.shown));
        let enclosed = exactly.as_ref().unwrap_or(now); // exact: another enclosure of the same phase
        let enclosed = self.until_rest(enclosed, time)?;
        let released = || self.engine.given.shaken.release(wall, turns, now, self.requested.shown);
        let resting = if for_ever { Resting::ForEver } else { released().map_or(Resting::Undecided, Resting::Until) };
        (self.pending.resting, self.pending.is_expected) = (Some(resting), true);
        let at = Touch { wall, turns, phase: enclosed };
        Some(self.record_event(Progress::Rest(Rest { at, is_accumulation: time > 0.0 })))
    }

    /// Phases of a rest that comes at most `time` forcing periods after the last contact.
    fn until_rest(&self, contact: &Enclosure, time: f64) -> Option<Enclosure> {
        let span = Enclosure::from_f64_bounds(0.0, time)?;
        Some(contact.add(&span, self.requested.shown.saturating_add(64))) // X1: any number of bits encloses
    }

    /// Whether the time to stop at may come between the impacts of a repeated chatter: these impacts have to be listed. Lemma V7
    fn cuts_a_repeated_rest(&self) -> bool {
        let (Some(until), Some(Period { cycles, .. })) = (self.requested.until, self.pending.recurrence.period())
        else {
            return false;
        };
        let is_cut = |at: &Touch, rounds: u64| {
            let cycles = i64::try_from(cycles.checked_mul(rounds)?).ok()?;
            let turns = turns::later(at.turns, cycles)?;
            let (_, phase) = at.at();
            let is_past = self.is_past(turns, phase, || at.phase.clone());
            Some(!is_past && !self.is_in_time(turns, &at.phase))
        };
        let rests = self.pending.recurrence.kept().iter().filter_map(|event| match event {
            Progress::Rest(Rest { at, is_accumulation: true }) => Some(at),
            _ => None,
        });
        rests.into_iter().any(|at| {
            // N1: below 2^63; any round near that time
            let rounds = until.turns.saturating_sub(at.turns).max(0).unsigned_abs() / cycles.max(1);
            (rounds.saturating_sub(1)..=rounds.saturating_add(1)).any(|rounds| is_cut(at, rounds).unwrap_or(true)) // V7: flown anew
        })
    }

    /// Whether infinitely many impacts follow for each member: none is held on its wall at once, by `e = 0` or a start without velocity. Lemma Z1
    fn bounces(&self) -> bool {
        let is_impact = self.cursor.index > self.followed.from.index;
        let moves = |velocity: Ball| velocity.certain_sign().is_some_and(Ordering::is_ne);
        let rebounds = self.engine.pair.restitution.certain_sign() == Some(Ordering::Greater);
        // C3: certified contacts are transversal, so an impact has a velocity, whatever its ball holds. Floats prove nothing.
        rebounds && (is_impact || moves(self.cursor.velocity))
            || self.requested.settings.arithmetic == Arithmetic::Float
    }

    /// The ball leaves the wall it rests on; the orbit goes on from the exact state of the release.
    #[cold]
    fn release(&mut self, resting: Resting) -> Progress {
        let release = match (resting, self.cursor.wall) {
            (Resting::Until(release), _) => release,
            (Resting::Undecided, Some(wall)) => return self.end(Undecided::rest(wall)),
            (_, wall) => {
                self.outcome = wall.map(Outcome::RestsForever);
                return Progress::Ended;
            }
        };
        let (wall, (turns, phase)) = (release.at.wall, release.at.at());
        if self.is_past(turns, phase, || release.at.phase.clone()) {
            return self.finish(Outcome::TimeReached);
        }
        let event = self.record_event(Progress::Release(release.at.clone()));
        self.pending.recurrence.release(&release, self.listed);
        if self.cuts_a_repeated_rest() {
            self.pending.recurrence.forget();
        }
        self.engine.given.leave(release);
        let velocity = Ball::exact(0.0);
        let from = Cursor { index: self.listed, wall: Some(wall), height: None, turns, phase, velocity };
        (self.cursor, self.followed) = (from, Followed::new(from, true, &self.engine.given, &self.requested.settings));
        self.engine.bits = self.bits();
        self.engine.motion = self
            .engine
            .given
            .motion(self.requested.settings.arithmetic)
            .expect("the arithmetic was there at the start");
        if self.requested.settings.arithmetic == Arithmetic::Shadow {
            self.engine.arithmetic = Arithmetic::Auto;
        }
        self.look_ahead();
        event
    }

    /// Lists a contact that may be a graze and goes on past it.
    pub(super) fn pass_graze(&mut self) -> Option<Progress> {
        let Grazed { wall, touch: (whole, at, enclosure), turns, phase, height, velocity, distance, acceleration } =
            self.engine.motion.pass_graze()?;
        let touched = turns::after(self.cursor.turns, whole)?;
        let enclosed = enclosure.rounded(self.requested.shown);
        if self.is_past(touched, at, || enclosed.clone()) {
            return Some(self.finish(Outcome::TimeReached));
        }
        self.cursor = Cursor {
            wall: self.cursor.wall.filter(|last| *last == wall),
            height: Some(height),
            turns: turns::after(self.cursor.turns, turns)?,
            phase,
            velocity,
            ..self.cursor
        };
        // From here on the data are a box: no precision makes it narrower.
        self.followed = Followed::new(self.cursor, false, &self.engine.given, &self.requested.settings);
        (self.engine.raise, self.engine.is_point) = (None, false);
        let at = Touch { wall, turns: touched, phase: enclosed };
        // G1: any wider bounds hold; narrower ones than the digits requested help nobody
        let digits = i32::try_from(self.requested.settings.digits).unwrap_or(i32::MAX);
        let least = 10.0f64.powi(-digits).min(MOST_SHOWN); // G1
        let (farthest, _) = distance.to_f64_bounds();
        let farthest = farthest.min(-least); // G1: wider bounds
        let distance = distance.rounded(self.requested.shown).hull(&finite(Ball::new(0.0, least)));
        // G1: v^2 <= 2 K epsilon, in wide exponents
        let speed = (Magnitude::new(acceleration, 1) * Magnitude::new(-farthest, 0)).sqrt().to_f64();
        let speed = Enclosure::from_f64_bounds(0.0, speed).expect("the product of both bounds is finite");
        Some(self.record_event(Progress::Graze(Box::new(Graze { at, distance, speed }))))
    }
}
