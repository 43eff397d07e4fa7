//! The beginning of an orbit, from its start and again from each release.

use std::cmp::Ordering;

use super::given::Given;
use super::motion::Motion;
use super::pending::Pending;
use super::raise::PrecisionRaise;
use super::shadowed::NearbyStart;
use super::splice::Splice;
use super::width::Width;
use super::{Arithmetic, Clock, Cursor, Engine, Followed, Orbit, Requested, Settings, Start};
use crate::clock::Phase;
use crate::exact::Exact;
use crate::number::Ball;
use crate::pair::{ImpactPair, too_large};
use crate::shaken::{Origin, State};
use crate::{Error, Scene, rest};

impl Orbit {
    /// The orbit of `pair` from `start`.
    ///
    /// # Errors
    /// If the start is not in the box of `pair`, if the digits or bits are not accepted, if a value is beyond the range of double-precision
    /// flights, or if the arithmetic `inari` is requested and this build has none.
    pub fn new(pair: &ImpactPair, start: &Start, settings: Settings) -> Result<Self, Error> {
        settings.require_accepted()?;
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
        let motion = match settings.arithmetic {
            Arithmetic::Shadow => shadowed(&given, &origin, (pair, start, &clock), &settings)?,
            arithmetic => given.motion(arithmetic)?,
        };
        let near = NearbyStart::new(&clock, start, &*motion);
        let arithmetic = match settings.arithmetic {
            Arithmetic::Shadow if near.is_none() => Arithmetic::Interval,
            arithmetic => arithmetic,
        };
        // A shadow begins at the starts near by, any other motion at its origin.
        let starts = motion.starts().map(|starts| starts.bounds);
        let cursor = Cursor::at(starts.as_ref().unwrap_or(&origin.state)); // exact: one of both
        let initial = starts.unwrap_or_else(|| origin.initial().clone());
        let followed = Followed::new(cursor, near.is_none(), &given, &settings);
        let widths = [Width::new(settings.digits, 1.0), Width::new(settings.digits, speed)];
        let max_reported_chatter = given.shaken.max_reported_chatter(widths[0].linear);
        let engine = Engine {
            given,
            pair: reduced,
            motion,
            arithmetic,
            is_point,
            raise: None,
            bits: 0,
            min_chatter_time_per_speed: rest::min_chatter_time_per_speed(&reduced),
            max_reported_chatter,
        };
        let mut orbit = Self {
            clock,
            requested: Requested { start: start.clone(), settings, until, widths, shown, is_point },
            engine,
            initial,
            followed,
            cursor,
            listed: 0,
            first_wide: None,
            pending: Pending { near, ..Pending::default() },
            outcome: None,
        };
        orbit.look_ahead();
        Ok(orbit)
    }

    /// The orbit of a scene; errors have the line in the scene file.
    ///
    /// # Errors
    /// As [`Orbit::new`].
    pub fn of(scene: &Scene, settings: Settings) -> Result<Self, Error> {
        Self::new(scene.pair(), scene.start(), settings.clone()).map_err(|error| scene.located(error, &settings))
    }

    /// Prepares a new start: the ways to raise the precision, and whether no wall is ever hit.
    pub(super) fn look_ahead(&mut self) {
        if self.engine.arithmetic == Arithmetic::Auto {
            let left = self.requested.settings.impacts.map(|impacts| impacts - self.listed.min(impacts)); // exact: not negative
            let settings = Settings { impacts: left, ..self.requested.settings.clone() };
            self.engine.raise = Some(PrecisionRaise::new(
                self.engine.given.clone(),
                self.followed.from.turns,
                self.requested.until,
                &settings,
            ));
        }
        self.pending.is_expected |= self.followed.still.is_some();
    }
}

impl Cursor {
    /// A state before the first impact.
    fn at(state: &State<Ball>) -> Self {
        let State { ref place, turns, phase, velocity } = *state;
        Self { index: 0, wall: place.wall(), height: place.height(), turns, phase, velocity }
    }
}

impl Followed {
    /// State that is followed: the origin of `given`, if `is_given`, or a box.
    pub(super) fn new(from: Cursor, is_given: bool, given: &Given, settings: &Settings) -> Self {
        let is_proved = is_given && settings.arithmetic != Arithmetic::Float;
        let still = || given.shaken.still(&given.origin);
        Self { from, is_given, still: is_proved.then(still).flatten() }
    }
}

/// The motion of an orbit near the given one; from the exact start where nothing expands, or no chain begins.
fn shadowed(
    given: &Given,
    origin: &Origin<Ball>,
    (pair, start, clock): (&ImpactPair, &Start, &Clock),
    settings: &Settings,
) -> Result<Box<dyn Motion>, Error> {
    let shaken = || given.shaken.clone();
    let Some((motion, regular)) = shaken().shadow(origin, settings.impacts) else {
        return given.motion(Arithmetic::Interval);
    };
    if regular.is_some_and(|impacts| Orbit::is_regular(pair, start, settings, impacts)) {
        return given.motion(Arithmetic::Interval);
    }
    // Of fewer impacts all are proved by precision but the last one.
    let spliced = settings.impacts.map_or(settings.splice, |impacts| impacts.min(settings.splice)); // exact: as many as are requested
    if spliced == 0 {
        return Ok(motion);
    }
    let (reduced, initial) = (*given.shaken.pair(), origin.initial().clone());
    let splice = Splice::new((pair, start, clock), (&reduced, initial), spliced, settings.max_bits)?;
    let left = settings.impacts.map(|impacts| impacts - (spliced - 1));
    shaken().spliced(splice, left).ok_or_else(|| Splice::refused(spliced))
}

/// The phase at which to stop, not before the start.
fn until(clock: &Clock, start: &Start, time: &Exact) -> Result<Phase, Error> {
    if time.compare(start.time()) == Some(Ordering::Less) {
        let accepted = format!("must be at least start.time, {}", start.time());
        return Err(Error::range("run.until", time, &accepted));
    }
    clock.phase_of("run.until", time)
}
