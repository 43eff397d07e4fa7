//! Orbits: chains of certified impacts from a point or a box of initial data.

mod aside;
mod attraction;
mod course;
mod event;
mod given;
mod later;
mod motion;
mod passage;
#[cfg(feature = "multiprecision")]
mod plan;
#[cfg(feature = "multiprecision")]
mod precise;
#[cfg(feature = "multiprecision")]
mod raise;
mod recurrence;
mod set;
mod shadowed;
mod shortfall;
mod textbook;
mod watch;
mod width;

pub use course::{Course, CoursePoint};
pub use event::{Graze, Impact, Outcome, Progress, Release, Rest};
pub use impact_pair_model::{Arithmetic, BITS, MAX_BITS, Period, Place, Settings, Start};
#[cfg(feature = "multiprecision")]
pub use plan::Plan;
pub use shadowed::Shadowing;
pub use watch::Watch;

use std::cmp::Ordering;

use inari::Interval;

use crate::Error;
use crate::Scene;
pub use crate::clock::Clock;
use crate::clock::Phase;
use crate::contact::{Contact, Undecided};
use crate::exact::{Enclosure, Exact};
use crate::mapping::Mapping;
use crate::number::interval::enclosing;
use crate::number::{Ball, Number};
use crate::pair::{ImpactPair, Reduced, Wall, too_large};
use crate::periodic::Passing;
use crate::rest;
use crate::switch_plane::{SwitchPoint, absolute};
use crate::turns;
use aside::Aside;
use event::finite;
use given::Given;
use motion::Motion;
#[cfg(feature = "multiprecision")]
use raise::Raise;
use shadowed::Near;
use width::Width;

/// Bits beyond those of the digits asked for that `auto` spends on a decision: what they do not tell is a graze, or `Undecided`.
pub const VERDICT_BITS: u32 = 8192;

/// An orbit as an iterator over its certified impacts; it ends with an [`Outcome`].
///
/// **Enclosure**: for every start and all parameters of the scene, impact `i` of the true orbit lies in the `i`-th
/// item, on that wall, and no other wall contact comes between, but those of a rest or a graze: [`Orbit::advance`]
/// tells of these, too. With [`Arithmetic::Float`] nothing is claimed.
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
    asked: Asked,
    engine: Engine,
    /// Where the motion starts.
    start: Cursor,
    /// Where the motion is.
    cursor: Cursor,
    /// Impacts handed out.
    listed: u64,
    first_wide: Option<u64>,
    aside: Aside,
    outcome: Option<Outcome>,
}

/// What is asked for.
#[derive(Debug)]
struct Asked {
    settings: Settings,
    until: Option<Phase>,
    /// Widths, of phases in turns and of velocities in gaps a turn.
    widths: [Width; 2],
    /// Bits of what is printed beyond doubles.
    shown: u32,
}

/// What flies.
#[derive(Debug)]
struct Engine {
    /// What is followed, from the orbit's start or the last release.
    given: Given,
    pair: Reduced<Ball>,
    motion: Box<dyn Motion>,
    /// What computes now: a shadow becomes [`Arithmetic::Auto`] at a release, [`Arithmetic::Interval`] where there is none.
    arithmetic: Arithmetic,
    /// No interval among the data: more precision makes every enclosure narrower.
    is_point: bool,
    /// What is left to try when the motion does not suffice.
    #[cfg(feature = "multiprecision")]
    raise: Option<Raise>,
    /// The most bits of motions before the last release.
    bits: u32,
    /// No chatter is shorter than the velocity before an impact times this, in turns.
    haste: f64,
    /// Nor is it told before it is as short as this, or ends before the pressure does.
    patience: Option<f64>,
}

/// How far the motion has come.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cursor {
    index: u64,
    /// The wall of the last impact; `None` where there is none, or a graze of the other wall may have been one.
    wall: Option<Wall>,
    /// Inside the gap: at the start, or after a graze.
    is_inside: bool,
    turns: i64,
    phase: Ball,
    /// Before the impact.
    velocity: Ball,
}

impl Orbit {
    /// The orbit of `pair` from `start`.
    ///
    /// # Errors
    /// When a value is beyond the range of double-precision flights, or this build has no multiprecision and it is
    /// asked for.
    pub fn new(pair: &ImpactPair, start: &Start, settings: Settings) -> Result<Self, Error> {
        let shown = match settings.arithmetic {
            Arithmetic::Bits(bits) => bits,
            // Of log2(10) bits a digit, and a few more.
            _ => settings.digits.saturating_mul(10) / 3 + 64, // shown
        };
        let clock = Clock::new(pair, start.time(), shown)?;
        let given = Given::new(pair, start, &clock)?;
        let reduced = *given.shaken.pair();
        let origin = given.origin_ball().map_err(|error| match error.key() {
            Some("start.velocity") => too_large("start.velocity", start.velocity()),
            _ => error,
        })?;
        let until = settings.until.as_ref().map(|time| until(&clock, start, time)).transpose()?;
        let speed = if reduced.beta.mid() > 0.0 { reduced.beta.mid() - reduced.beta.rad() } else { 1.0 };
        let is_point = pair.is_point() && start.is_point();
        let (motion, arithmetic) = match settings.arithmetic {
            Arithmetic::Shadow => {
                let (motion, regular) = given.shaken.clone().shadow(&origin, settings.impacts);
                match regular.is_some_and(|impacts| Self::is_regular(pair, start, &settings, impacts)) {
                    true => (given.motion(Arithmetic::Interval)?, Arithmetic::Interval),
                    false => (motion, Arithmetic::Shadow),
                }
            }
            arithmetic => (given.motion(arithmetic)?, arithmetic),
        };
        let starts = motion.starts();
        let near = starts.map(|starts| Near::new(&clock, start, origin.turns, starts, starts.1 == origin.velocity));
        let (phase, velocity) = starts.unwrap_or((origin.phase, origin.velocity));
        let (wall, turns) = (origin.wall(), origin.turns);
        let cursor = Cursor { index: 0, wall, is_inside: wall.is_none(), turns, phase, velocity };
        let widths = [Width::new(settings.digits, 1.0), Width::new(settings.digits, speed)];
        let patience = given.shaken.patience(widths[0].linear);
        let engine = Engine {
            given,
            pair: reduced,
            motion,
            arithmetic,
            is_point,
            #[cfg(feature = "multiprecision")]
            raise: None,
            bits: 0,
            haste: rest::haste(&reduced),
            patience,
        };
        let mut orbit = Self {
            clock,
            asked: Asked { settings, until, widths, shown },
            engine,
            start: cursor,
            cursor,
            listed: 0,
            first_wide: None,
            aside: Aside { near, ..Aside::default() },
            outcome: None,
        };
        orbit.look_ahead();
        Ok(orbit)
    }

    /// The orbit of a scene; what is wrong with it is told with its line.
    ///
    /// # Errors
    /// As [`Orbit::new`].
    pub fn of(scene: &Scene, settings: Settings) -> Result<Self, Error> {
        Self::new(scene.pair(), scene.start(), settings.clone()).map_err(|error| scene.located(error, &settings))
    }

    /// What there is to know of a new start.
    fn look_ahead(&mut self) {
        #[cfg(feature = "multiprecision")]
        if self.engine.arithmetic == Arithmetic::Auto {
            let left = self.asked.settings.impacts.map(|impacts| impacts - self.listed.min(impacts)); // exact: not negative
            let settings = Settings { impacts: left, ..self.asked.settings.clone() };
            self.engine.raise =
                Some(Raise::new(self.engine.given.clone(), self.start.turns, self.asked.until, &settings));
        }
        let is_float = self.asked.settings.arithmetic == Arithmetic::Float;
        self.aside.still = self.engine.given.shaken.still(&self.engine.given.origin).filter(|_| !is_float);
        self.aside.is_due |= self.aside.still.is_some();
    }

    /// Turns phases into times and reduced velocities into velocities.
    pub fn clock(&self) -> &Clock {
        &self.clock
    }

    /// What computes.
    pub fn arithmetic(&self) -> Arithmetic {
        self.asked.settings.arithmetic
    }

    /// The most bits that an impact so far was computed with: 53 in double precision.
    pub fn bits(&self) -> u32 {
        self.engine.bits.max(self.engine.motion.bits()) // shown
    }

    /// The bits of each impact, once it is computed in multiprecision.
    #[cfg(feature = "multiprecision")]
    pub fn plan(&self) -> Option<&Plan> {
        self.engine.motion.plan()
    }

    /// How the orbit ended; `None` while it goes on.
    pub fn outcome(&self) -> Option<&Outcome> {
        self.outcome.as_ref()
    }

    /// The first impact whose enclosure is wider than the digits asked for, if one is.
    pub fn first_wide(&self) -> Option<u64> {
        self.first_wide
    }

    /// The bounds of an impact's time \[time\] and velocity \[length/time\].
    pub fn bounds(&self, impact: &Impact) -> (Enclosure, Enclosure) {
        let (phase, velocity) = impact.enclosures();
        (self.clock.time(impact.turns, &phase), self.clock.velocity(&velocity))
    }

    /// The same bounds as intervals of doubles, for whoever computes with such.
    ///
    /// **Enclosure**: the true time \[time\] and velocity \[length/time\] lie in them, but with [`Arithmetic::Float`].
    ///
    /// ```
    /// use impact_pair::Scene;
    /// use impact_pair::orbit::Orbit;
    /// use impact_pair::inari::{Interval, const_interval};
    /// let scene = Scene::parse(r#"
    ///     excitation = { amplitude = 8, frequency = "pi", phase = 0 }
    ///     pair = { gap = 9.42497, restitution = 0.5 }
    ///     start = { time = 0, wall = "left", velocity = -12.56636 }
    /// "#)?;
    /// let mut orbit = Orbit::of(&scene, scene.settings())?;
    /// let mut before = const_interval!(0.0, 0.0);
    /// while let Some(impact) = orbit.next() {
    ///     let (time, velocity): (Interval, Interval) = orbit.intervals(&impact);
    ///     let frequency = (time - before).recip();
    ///     assert!(before.strict_precedes(time) && frequency.wid() < 1e-5 && !velocity.contains(0.0));
    ///     before = time;
    /// }
    /// # Ok::<(), impact_pair::Error>(())
    /// ```
    pub fn intervals(&self, impact: &Impact) -> (Interval, Interval) {
        let (time, velocity) = self.bounds(impact);
        (enclosing(&time), enclosing(&velocity))
    }

    /// The impact as a point of its switch-plane. **Equations** (18)-(23)
    pub fn switch_point(&self, impact: &Impact) -> SwitchPoint {
        let shaking = self.shaking(impact.turns, impact.phase);
        let (displacement, velocity) = absolute(shaking, impact.wall, impact.velocity);
        let (time, relative_velocity) = impact.enclosures();
        SwitchPoint {
            wall: impact.wall,
            time: self.clock.time_in_period(&time),
            relative_velocity: self.clock.velocity(&relative_velocity),
            displacement: self.clock.length(&finite(displacement)),
            absolute_velocity: self.clock.velocity(&finite(velocity)),
        }
    }

    /// `E/d` and `E'` in gaps a turn.
    fn shaking(&self, turns: i64, phase: Ball) -> (Ball, Ball) {
        let [shift, speed, _] = self.engine.given.shaken.displacement(turns, phase);
        (shift, speed)
    }

    /// Goes on: to the next event, or in more precision over an impact that was listed before.
    ///
    /// For those who show progress or may stop; as an iterator the orbit does all this at once.
    pub fn advance(&mut self) -> Progress {
        self.fly().map_or_else(|other| other, Progress::Impact)
    }

    /// The next impact, or else what has happened instead: impacts, of which there are many, are not moved about.
    #[inline(always)]
    fn fly(&mut self) -> Result<Impact, Progress> {
        if self.outcome.is_none() && self.asked.settings.impacts.is_some_and(|impacts| self.listed >= impacts) {
            self.finish(Outcome::ImpactsReached);
        }
        if self.outcome.is_some() {
            return Err(Progress::Ended);
        }
        if self.aside.is_due
            && let Some(event) = self.aside()
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
        let next = Cursor { index: self.cursor.index + 1, wall: Some(wall), is_inside: false, turns, phase, velocity };
        if next.index <= self.listed {
            self.cursor = next;
            return Err(Progress::Retraced(next.index));
        }
        if self.is_past(turns, phase) {
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
        if let Some(near) = &mut self.aside.near {
            near.nearness.keep(phase.rad());
        }
        if self.asked.settings.attractor {
            self.aside.recent.keep(Passing { index: next.index, wall, turns, phase, velocity });
        }
        let precise = self.precise(&contact).map(Box::new);
        let impact = Impact { index: next.index, mapping, wall, turns, phase, velocity, precise };
        if self.aside.is_due {
            self.aside.recurrence.keep(&Progress::Impact(impact.clone()));
        }
        Ok(impact)
    }

    /// Keeps what may have to be repeated.
    #[inline]
    fn hand_out(&mut self, event: Progress) -> Progress {
        if self.aside.is_due {
            self.aside.recurrence.keep(&event);
        }
        event
    }

    /// Whether the last bounce is slow enough to ask whether it is the first of a chatter: most are not.
    #[inline]
    fn may_rest(&self) -> bool {
        let Cursor { index, wall: Some(wall), phase, velocity, .. } = self.cursor else { return false };
        let shortest = (velocity.mid() * self.engine.haste).abs();
        let most = self.engine.patience.unwrap_or_else(|| {
            let phase = phase.mid() + wall.mirror_phase();
            (phase.ceil() - phase).max(f64::EPSILON) // proposes
        });
        shortest <= most && index == self.listed
    }

    /// All that was asked for is listed.
    #[cold]
    fn finish(&mut self, reached: Outcome) -> Progress {
        self.aside.is_late = reached == Outcome::TimeReached;
        self.outcome = Some(match self.aside.recurrence.period() {
            Some(period) => Outcome::Periodic(period),
            None => self.attractor().map_or(reached, |attractor| Outcome::Attracted(Box::new(attractor))),
        });
        Progress::Ended
    }

    /// The time asked for \[time\], if all events up to it are listed because it ended the list.
    pub fn listed_until(&self) -> Option<&Exact> {
        self.asked.settings.until.as_ref().filter(|_| self.aside.is_late)
    }

    /// When a rest begins \[time\].
    pub fn rest_time(&self, rest: &Rest) -> Enclosure {
        self.clock.time(rest.turns, &rest.phase)
    }

    /// When a wall may be grazed \[time\].
    pub fn graze_time(&self, graze: &Graze) -> Enclosure {
        self.exact_time(graze.turns, &graze.phase)
    }

    /// When a release happens \[time\], as exactly as it can be shown.
    pub fn release_time(&self, release: &Release) -> Enclosure {
        self.exact_time(release.turns, &release.phase)
    }

    /// The time of a phase, itself exact where that is.
    fn exact_time(&self, turns: i64, phase: &Enclosure) -> Enclosure {
        match phase.mid_rad() {
            (exact, 0.0) => self.clock.time_of(turns, exact),
            _ => self.clock.time(turns, phase),
        }
    }

    /// Whether an impact certainly comes after the time to stop at.
    fn is_past(&self, turns: i64, phase: Ball) -> bool {
        self.asked.until.is_some_and(|until| {
            // Lemma N1: exact below 2^53; beyond, rounding keeps the sign, and the rest is at most 2.
            let ahead = Ball::from_f64((turns - until.turns) as f64) + (phase - until.rest);
            ahead.mid() > ahead.rad()
        })
    }
}

/// When to stop: not before the start.
fn until(clock: &Clock, start: &Start, time: &Exact) -> Result<Phase, Error> {
    if time.compare(start.time()) == Some(Ordering::Less) {
        let accepted = format!("must be at least start.time, {}", start.time());
        return Err(Error::range("run.until", time, &accepted));
    }
    clock.phase_of("run.until", time)
}

impl Iterator for Orbit {
    type Item = Impact;

    #[inline]
    fn next(&mut self) -> Option<Impact> {
        loop {
            match self.fly() {
                // Repeated impacts come with the other events.
                Ok(impact) | Err(Progress::Impact(impact)) => return Some(impact),
                Err(Progress::Ended) => return None,
                Err(_) => {}
            }
        }
    }
}
