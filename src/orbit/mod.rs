//! Orbits: chains of certified impacts from a point or a box of initial data.

mod arrivals;
mod attraction;
mod begin;
mod course;
mod dense;
mod document;
mod event;
mod follow;
mod given;
mod motion;
mod passage;
mod pending;
mod plan;
mod precise;
mod raise;
mod recurrence;
mod reference;
mod set;
mod shadowed;
mod shortfall;
mod splice;
#[cfg(all(feature = "inari", target_feature = "fma"))]
mod textbook;
mod units;
mod width;

pub use arrivals::{Arrival, Arrivals};
pub use course::{Course, CoursePoint};
pub use dense::{Dense, DenseState};
pub use document::{Advice, Bounds, Conclusion, Ending, Event, Events};
pub use event::{Outcome, Progress, Rest};
pub use impact_pair_model::{Arithmetic, BITS, EventKind, INARI, MAX_BITS, Period, Place, Settings, Start};
pub use plan::Plan;
pub use reference::{Lasting, Reference};
pub(crate) use set::StateSet;
pub use shadowed::Shadowing;
pub(crate) use shortfall::{GRAZE_BITS, Limit};

pub use crate::clock::Clock;
use crate::clock::Phase;
use crate::contact::{Contact, Undecided};
use crate::exact::{Enclosure, Exact, compare_rational};
use crate::impact::finite;
pub use crate::impact::{Graze, Impact, Touch};
use crate::mapping::Mapping;
use crate::number::{Ball, Number};
use crate::pair::{ImpactPair, Reduced, Wall};
use crate::shaken::{State, Still};
use crate::turns;
use crate::watch::{Latched, Unwatched, Watch};
use given::Given;
use motion::Motion;
use pending::Pending;
use raise::PrecisionRaise;
use width::Width;

/// Bits beyond those of the requested digits that `auto` spends on a decision: a question that they leave open is a graze, or `Undecided`.
pub const VERDICT_BITS: u32 = 8192;

/// An orbit as an iterator over its certified impacts; it ends with an [`Outcome`].
///
/// **Enclosure**: for every start and all parameters of the scene, impact `i` of the true orbit lies in the `i`-th
/// item, on that wall, and no other wall contact comes between, but those of a rest or a graze: [`Orbit::advance`]
/// tells of these, too. With [`Arithmetic::Float`] nothing is certified.
/// **Cost**: a certified flight, a second bracket and a Jacobian for each impact; memory does not grow.
///
/// ```
/// use impact_pair::{Harmonic, ImpactPair};
/// use impact_pair::orbit::{Orbit, Outcome, Settings, Start};
/// use impact_pair::pair::Wall;
/// // The exact two-impact orbit of figure 12: d = 3 pi, v = -4 pi, impacts at t = 1, 2, 3, ...
/// let harmonic = Harmonic::new("1".parse()?, "pi".parse()?, "0".parse()?)?;
/// let pair = ImpactPair::new(harmonic, "3*pi".parse()?, "0.5".parse()?)?;
/// let start = Start::on_wall("0".parse()?, Wall::Left, "-4*pi".parse()?)?;
/// let mut orbit = Orbit::new(&pair, &start, Settings::default())?;
/// while let Some(impact) = orbit.next() {
///     let (time, _velocity) = orbit.bounds(&impact);
///     assert!(time.contains(&num_rational::BigRational::from_integer(impact.index.into())));
/// }
/// assert_eq!(orbit.outcome(), Some(&Outcome::ImpactsReached));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Orbit {
    clock: Clock,
    requested: Requested,
    engine: Engine,
    /// The requested start; for a shadowed orbit the starts near by, one of which has the orbit.
    initial: State<Ball>,
    followed: Followed,
    /// The state after the last impact or graze of the motion.
    cursor: Cursor,
    /// Impacts handed out.
    listed: u64,
    first_wide: Option<u64>,
    pending: Pending,
    outcome: Option<Outcome>,
}

/// The request.
#[derive(Debug)]
struct Requested {
    start: Start,
    settings: Settings,
    until: Option<Phase>,
    /// Requested widths: of phases in forcing periods, and of velocities in gap widths per forcing period.
    widths: [Width; 2],
    /// Bits of bounds that are printed with more than doubles.
    shown: u32,
    /// No interval among the pair and the start.
    is_point: bool,
}

/// The motion and its arithmetic.
#[derive(Debug)]
struct Engine {
    /// The pair and the start that are followed, from the orbit's start or the last release.
    given: Given,
    pair: Reduced<Ball>,
    motion: Box<dyn Motion>,
    /// The current arithmetic: a shadow becomes [`Arithmetic::Auto`] at a release, [`Arithmetic::Interval`] where there is none.
    arithmetic: Arithmetic,
    /// No interval among the data, nor a graze passed: more precision makes every enclosure narrower.
    is_point: bool,
    /// The ways to raise the precision if the motion does not suffice.
    raise: Option<PrecisionRaise>,
    /// The most bits of motions before the last release.
    bits: u32,
    /// Lower bound of a chatter's duration over the velocity before an impact: forcing periods per gap width per forcing period.
    min_chatter_time_per_speed: f64,
    /// Greatest duration of chatter that is reported, in forcing periods; `None`: any that ends before the contact force does.
    max_reported_chatter: Option<f64>,
}

/// State that the motion is followed from, and properties that belong to that state.
#[derive(Clone, Copy, Debug)]
struct Followed {
    from: Cursor,
    /// True if it is [`Given::origin`] itself, and not a box of starts near by, or past a graze.
    is_given: bool,
    /// No wall is ever hit from there on.
    still: Option<Still>,
}

/// The state up to which the motion has been followed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cursor {
    index: u64,
    /// The wall of the last impact; `None` where there is none, or a graze of the other wall may have been one.
    wall: Option<Wall>,
    /// Above the left wall, in gaps, where the ball is inside the gap: at the start, or after a graze.
    height: Option<Ball>,
    turns: i64,
    phase: Ball,
    /// Velocity before the impact; inside the gap the velocity of the flight.
    velocity: Ball,
}

impl Orbit {
    /// Clock that converts phases into times, and velocities without units into velocities of the scene.
    pub fn clock(&self) -> &Clock {
        &self.clock
    }

    /// The pair.
    pub fn pair(&self) -> &ImpactPair {
        &self.engine.given.pair
    }

    /// The requested start.
    pub fn start(&self) -> &Start {
        &self.requested.start
    }

    /// The requested arithmetic.
    pub fn arithmetic(&self) -> Arithmetic {
        self.requested.settings.arithmetic
    }

    /// Maximum precision of an impact so far, in bits: 53 in double precision.
    pub fn bits(&self) -> u32 {
        self.engine.bits.max(self.engine.motion.bits()) // shown
    }

    /// Bits of each impact, once computed in multiprecision.
    pub fn plan(&self) -> Option<&Plan> {
        self.engine.motion.plan()
    }

    /// Outcome of the orbit; `None` while the orbit continues.
    pub fn outcome(&self) -> Option<&Outcome> {
        self.outcome.as_ref()
    }

    /// First impact whose enclosure is wider than the requested digits, if there is one.
    pub fn first_wide(&self) -> Option<u64> {
        self.first_wide
    }

    /// Number of impacts so far.
    pub fn listed(&self) -> u64 {
        self.listed
    }

    /// Advances to the next event, or computes an impact listed before again in higher precision.
    ///
    /// For those who show progress or may stop; as an iterator the orbit does all this at once.
    pub fn advance(&mut self) -> Progress {
        self.advance_within(&Unwatched)
    }

    /// Advances as [`advance`](Self::advance) does; where the watch stops what comes after the last event, the orbit has no outcome yet.
    fn advance_within(&mut self, watch: &dyn Watch) -> Progress {
        let progress = self.fly().map_or_else(|other| other, Progress::Impact);
        if let Progress::Ended = progress {
            self.conclude(watch);
        }
        progress
    }

    /// The next impact, or else the event that happened instead: impacts, of which there are many, are not moved about.
    #[inline(always)]
    fn fly(&mut self) -> Result<Impact, Progress> {
        if self.outcome.is_none() && self.requested.settings.impacts.is_some_and(|impacts| self.listed >= impacts) {
            return Err(self.finish(Outcome::ImpactsReached));
        }
        if self.outcome.is_some() {
            return Err(Progress::Ended);
        }
        if self.pending.is_expected
            && let Some(event) = self.pending()
        {
            return Err(event);
        }
        if self.may_rest()
            && let Some(event) = self.come_to_rest()
        {
            return Err(event);
        }
        let contact = match self.engine.motion.next_contact() {
            Ok(contact) => contact,
            Err(undecided) => return Err(self.give_up(undecided)),
        };
        let Some(turns) = turns::after(self.cursor.turns, contact.turns) else {
            return Err(self.give_up(Undecided::endless()));
        };
        let Contact { wall, phase, velocity, .. } = contact;
        let next = Cursor { index: self.cursor.index + 1, wall: Some(wall), height: None, turns, phase, velocity };
        if next.index <= self.listed {
            self.cursor = next;
            return Err(Progress::Retraced(next.index));
        }
        if self.is_past(turns, phase, || self.enclosed(phase)) {
            return Err(self.finish(Outcome::TimeReached));
        }
        let excess = self.excess(turns, &contact);
        if excess > 0.0 {
            if let Some(progress) = self.narrow(&contact, excess) {
                return Err(progress);
            }
            self.first_wide.get_or_insert(next.index);
        }
        let mapping = self.cursor.wall.map(|from| Mapping::between(from, contact.wall));
        self.cursor = next;
        self.listed = next.index;
        self.note_nearness(phase);
        let mut impact = Impact { index: next.index, mapping, wall, turns, phase, velocity, precise: None };
        if self.requested.settings.attractor {
            self.pending.recent.keep(impact.clone());
        }
        impact.precise = self.precise(&contact).map(Box::new);
        self.note_lateness(&impact);
        if self.pending.is_expected {
            self.pending.recurrence.keep(&Progress::Impact(impact.clone()));
        }
        Ok(impact)
    }

    /// Keeps what may have to be repeated.
    #[inline]
    fn record_event(&mut self, event: Progress) -> Progress {
        if self.pending.is_expected {
            self.pending.recurrence.keep(&event);
        }
        event
    }

    /// Whether the last bounce is so slow that it may be the first of a chatter: most are not.
    #[inline]
    fn may_rest(&self) -> bool {
        let Cursor { index, wall: Some(wall), phase, velocity, .. } = self.cursor else { return false };
        let shortest = (velocity.mid() * self.engine.min_chatter_time_per_speed).abs();
        let most = self.engine.max_reported_chatter.unwrap_or_else(|| {
            let phase = phase.mid() + wall.mirror_phase();
            (phase.ceil() - phase).max(f64::EPSILON) // proposes
        });
        shortest <= most && index == self.listed
    }

    /// Ends the list: all that was requested is listed.
    #[cold]
    fn finish(&mut self, reached: Outcome) -> Progress {
        (self.pending.reached, self.pending.is_expected) = (Some(reached), true);
        Progress::Ended
    }

    /// Looks for an attractor once all that was requested is listed; where the watch stops the search, there is no outcome yet.
    #[cold]
    fn conclude(&mut self, watch: &dyn Watch) {
        let Some(reached) = self.pending.reached.clone() else { return };
        let watch = Latched::new(watch);
        let found = match self.pending.recurrence.period() {
            Some(period) => Some(Outcome::Periodic(period)),
            None => self.attractor(&watch).map(|attractor| Outcome::Attracted(Box::new(attractor))),
        };
        if watch.is_stopped() {
            return;
        }
        self.pending.is_late = reached == Outcome::TimeReached;
        (self.pending.reached, self.outcome) = (None, found.or(Some(reached)));
    }

    /// Requested time \[time\], if this time ended the list: then all events up to it are listed.
    pub fn listed_until(&self) -> Option<&Exact> {
        self.requested.settings.until.as_ref().filter(|_| self.pending.is_late)
    }

    /// Whether an event certainly comes after the time to stop at, by its listed bounds. `enclosed` is the event's phase without the whole
    /// forcing periods.
    fn is_past(&self, turns: i64, phase: Ball, enclosed: impl FnOnce() -> Enclosure) -> bool {
        self.beyond_until(turns, phase).is_some_and(|ahead| {
            // V7: what doubles do not decide the bounds do
            ahead.mid() > ahead.rad() || ahead.mid() >= -ahead.rad() && self.is_listed_past(turns, &enclosed())
        })
    }

    /// The phase of an event less that of the time to stop at, in doubles, if there is such a time.
    #[inline]
    fn beyond_until(&self, turns: i64, phase: Ball) -> Option<Ball> {
        let until = self.requested.until?;
        // Lemma N1: exact below 2^53; beyond, rounding keeps the sign, and the rest is at most 2.
        Some(Ball::from_f64((turns - until.turns) as f64) + (phase - until.rest))
    }

    /// Whether an event certainly comes before the time to stop at, or no such time is requested. `phase` bounds the event's phase without the
    /// whole forcing periods.
    fn is_in_time(&self, turns: i64, phase: &Enclosure) -> bool {
        let Some(until) = &self.requested.settings.until else { return true };
        let latest = self.exact_time(turns, phase);
        match until.as_rational() {
            Some(until) => compare_rational(latest.sup(), until).is_lt(),
            None => latest.sup() < until.enclose(self.requested.shown.saturating_mul(2)).inf(), // X1: any number of bits encloses
        }
    }

    /// Keeps an impact that may come after the time to stop at by its bounds, printed as they are rounded outward.
    #[inline]
    fn note_lateness(&mut self, impact: &Impact) {
        // P1: printing widens bounds by less than their width
        if self.beyond_until(impact.turns, impact.phase).is_some_and(|ahead| ahead.mid() >= -2.0 * ahead.rad()) {
            self.pending.late.push(impact.clone());
        }
    }

    /// The listed impacts that may come after the time to stop at by their bounds, and perhaps a few before.
    pub(crate) fn late(&self) -> &[Impact] {
        &self.pending.late
    }

    /// Whether the listed bounds are past the exact time to stop at; an irrational time is enclosed to twice the bits.
    #[cold]
    fn is_listed_past(&self, turns: i64, phase: &Enclosure) -> bool {
        self.is_after_until(&self.exact_time(turns, phase))
    }

    /// Whether these times are all past the exact time to stop at; an irrational time is enclosed to twice the bits.
    fn is_after_until(&self, times: &Enclosure) -> bool {
        let until = self.requested.settings.until.as_ref();
        until.is_some_and(|until| match until.as_rational() {
            Some(until) => compare_rational(times.inf(), until).is_gt(),
            None => until.enclose(self.requested.shown.saturating_mul(2)).sup() < times.inf(), // X1: any number of bits encloses
        })
    }

    /// Phase of the current contact as listed, without the whole forcing periods.
    fn enclosed(&self, phase: Ball) -> Enclosure {
        self.engine.motion.enclosures(self.requested.shown).map_or_else(|| finite(phase), |(phase, _)| phase)
    }
}

impl Iterator for Orbit {
    type Item = Impact;

    #[inline]
    fn next(&mut self) -> Option<Impact> {
        loop {
            match self.fly() {
                // Repeated impacts come with the other events.
                Ok(impact) | Err(Progress::Impact(impact)) => return Some(impact),
                Err(Progress::Ended) => {
                    self.conclude(&Unwatched);
                    return None;
                }
                Err(_) => {}
            }
        }
    }
}
