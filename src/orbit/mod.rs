//! Orbits: chains of certified impacts from a point or a box of initial data.

mod clock;
mod motion;
mod set;
mod start;

pub use clock::Clock;
pub use start::{Place, Start};

use num_rational::BigRational;

use crate::contact::{Contact, Reason, Undecided};
use crate::error::Error;
use crate::exact::{Enclosure, Exact};
use crate::mapping::Mapping;
use crate::number::{Ball, Number};
use crate::pair::{ImpactPair, Reduced, Wall, ball, within};
use crate::switch_plane::{SwitchPoint, absolute};
use clock::Phase;
use motion::{FloatMotion, IntervalMotion, Motion, Origin};

/// What computes the orbit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Arithmetic {
    /// The cheapest that certifies each impact to the asked digits; the orbit ends where none does. With intervals
    /// among the data no arithmetic can promise a width: then the orbit goes on as with [`Arithmetic::Interval`].
    #[default]
    Auto,
    /// Plain double precision: nothing is proved.
    Float,
    /// Certified in double precision, as far as it decides; widths are what they are.
    Interval,
}

/// How far an orbit is followed, and how.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Stop after so many impacts.
    pub impacts: Option<u64>,
    /// Stop at this time \[time\].
    pub until: Option<Exact>,
    /// Widths asked for: `10^-digits`, of a time relative to `2 pi/W`, of a velocity relative to `A W`.
    pub digits: u32,
    /// What computes.
    pub arithmetic: Arithmetic,
}

impl Default for Settings {
    /// A hundred impacts at nine digits, `auto`.
    fn default() -> Self {
        Self { impacts: Some(100), until: None, digits: 9, arithmetic: Arithmetic::Auto }
    }
}

/// One impact of an orbit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// Counts the impacts from 1; the start is not counted.
    pub index: u64,
    /// The mapping that led here; `None` for the first contact of a start inside the gap.
    pub mapping: Option<Mapping>,
    /// The wall.
    pub wall: Wall,
    /// Whole turns since the clock's origin.
    pub turns: i64,
    /// The rest of the phase `(W t + tau) / (2 pi)`, in turns, in about `[-1/2, 1/2]`.
    pub phase: Ball,
    /// The relative velocity `y'` just before the impact, in gaps a turn.
    pub velocity: Ball,
}

/// Why an orbit ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// All the impacts asked for.
    ImpactsReached,
    /// All the impacts up to the time asked for.
    TimeReached,
    /// The next impact could not be proved.
    Undecided {
        /// Why.
        reason: Reason,
        /// The wall concerned, when it is one.
        wall: Option<Wall>,
        /// When the wall may be touched \[time\]: from, and to unless it is open.
        time: (Enclosure, Option<Enclosure>),
    },
}

impl Outcome {
    /// The word of the orbit JSON.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::ImpactsReached => "impacts-reached",
            Self::TimeReached => "time-reached",
            Self::Undecided { .. } => "undecided",
        }
    }
}

/// An orbit as an iterator over its certified impacts; it ends with an [`Outcome`].
///
/// **Enclosure**: for every start and all parameters of the scene, impact `i` of the true orbit lies in the `i`-th
/// item, on that wall, and no other wall contact comes between. With [`Arithmetic::Float`] nothing is claimed.
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
    pair: Reduced<Ball>,
    clock: Clock,
    motion: Box<dyn Motion>,
    settings: Settings,
    until: Option<Phase>,
    /// Widths asked for, of phases in turns and of velocities in gaps a turn.
    widths: (f64, f64),
    wall: Option<Wall>,
    turns: i64,
    phase: Ball,
    index: u64,
    /// More precision could meet the digits asked for: `auto`, and no interval among the data.
    stops_when_wide: bool,
    first_wide: Option<u64>,
    outcome: Option<Outcome>,
}

impl Orbit {
    /// The orbit of `pair` from `start`.
    ///
    /// # Errors
    /// When a value is beyond the range of double-precision flights.
    pub fn new(pair: &ImpactPair, start: &Start, settings: Settings) -> Result<Self, Error> {
        let reduced = pair.reduced()?;
        let clock = Clock::new(pair, &start.time)?;
        let Phase { turns, rest: phase } = clock.phase_of("start.time", &start.time)?;
        let velocity = clock.reduced_velocity(&start.velocity)?;
        let (wall, origin) = match &start.place {
            Place::Wall(wall) => (Some(*wall), Origin::Wall { wall: *wall, phase, velocity }),
            Place::Inside(position) => {
                let half = Exact::from_rational(BigRational::new(1.into(), 2.into()));
                let height = position.checked_div(pair.gap()).and_then(|ratio| ratio.checked_add(&half));
                let height = ball("start.position", &within("start.position", position, height)?)?;
                (None, Origin::Inside { height, phase, velocity })
            }
        };
        let until = settings.until.as_ref().map(|time| clock.phase_of("run.until", time)).transpose()?;
        // Printing may widen by a hundredth. From 324 digits on the width is 0 as a double, which only points meet.
        let width = 0.98 * 10f64.powi(-(settings.digits.min(400) as i32));
        let speed = if reduced.beta.mid() > 0.0 { reduced.beta.mid() - reduced.beta.rad() } else { 1.0 };
        let motion: Box<dyn Motion> = match settings.arithmetic {
            Arithmetic::Float => Box::new(FloatMotion::new(&reduced, origin)),
            Arithmetic::Auto | Arithmetic::Interval => Box::new(IntervalMotion::new(&reduced, origin)),
        };
        let stops_when_wide = settings.arithmetic == Arithmetic::Auto && pair.is_point() && start.is_point();
        Ok(Self {
            pair: reduced,
            clock,
            motion,
            settings,
            until,
            widths: (width, width * speed),
            wall,
            turns,
            phase,
            index: 0,
            stops_when_wide,
            first_wide: None,
            outcome: None,
        })
    }

    /// Turns phases into times and reduced velocities into velocities.
    pub fn clock(&self) -> &Clock {
        &self.clock
    }

    /// What computes.
    pub fn arithmetic(&self) -> Arithmetic {
        self.settings.arithmetic
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
        (self.clock.time(impact.turns, impact.phase), self.clock.velocity(impact.velocity))
    }

    /// The impact as a point of its switch-plane. **Equations** (18)-(23)
    pub fn switch_point(&self, impact: &Impact) -> SwitchPoint {
        let (displacement, velocity) = absolute(&self.pair, impact.wall, impact.phase.sin_cos(), impact.velocity);
        SwitchPoint {
            wall: impact.wall,
            time: self.clock.time_in_period(impact.phase),
            relative_velocity: self.clock.velocity(impact.velocity),
            displacement: self.clock.length(displacement),
            absolute_velocity: self.clock.velocity(velocity),
        }
    }

    fn end(&mut self, undecided: Undecided) {
        let from = self.clock.time(self.turns, self.phase);
        let time = match undecided.time {
            Some(since) => {
                let whole = since.mid().floor();
                let rest = self.phase + (since - Ball::exact(whole));
                let at = self.clock.time(self.turns.saturating_add(whole as i64), rest);
                (at.clone(), Some(at))
            }
            None => (from, None),
        };
        self.outcome = Some(Outcome::Undecided { reason: undecided.reason, wall: undecided.wall, time });
    }

    /// Whether an impact certainly comes after the time to stop at.
    fn is_past(&self, turns: i64, phase: Ball) -> bool {
        self.until.is_some_and(|until| {
            let ahead = Ball::from_f64(turns.saturating_sub(until.turns) as f64) + (phase - until.rest);
            ahead.mid() > ahead.rad()
        })
    }
}

impl Iterator for Orbit {
    type Item = Impact;

    fn next(&mut self) -> Option<Impact> {
        if self.outcome.is_some() {
            return None;
        }
        if self.settings.impacts.is_some_and(|impacts| self.index >= impacts) {
            self.outcome = Some(Outcome::ImpactsReached);
            return None;
        }
        let contact: Contact<Ball> = match self.motion.next_contact() {
            Ok(contact) => contact,
            Err(undecided) => {
                self.end(undecided);
                return None;
            }
        };
        // At most 2^40 turns a flight: no sum of flights that can be listed overflows.
        let turns = self.turns.saturating_add(contact.turns as i64);
        if self.is_past(turns, contact.phase) {
            self.outcome = Some(Outcome::TimeReached);
            return None;
        }
        let widths = self.clock.widths(turns, contact.phase, contact.velocity);
        let wide = widths.0 > self.widths.0 || widths.1 > self.widths.1;
        if wide && self.stops_when_wide {
            self.end(Undecided { reason: Reason::Precision, wall: Some(contact.wall), time: Some(contact.time) });
            return None;
        }
        self.index += 1;
        if wide {
            self.first_wide.get_or_insert(self.index);
        }
        let mapping = self.wall.map(|from| Mapping::between(from, contact.wall));
        (self.wall, self.turns, self.phase) = (Some(contact.wall), turns, contact.phase);
        Some(Impact {
            index: self.index,
            mapping,
            wall: contact.wall,
            turns,
            phase: contact.phase,
            velocity: contact.velocity,
        })
    }
}
