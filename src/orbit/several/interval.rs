//! Certified in double precision: the centre of the set flies, the set follows by the Jacobian.

#[cfg(feature = "multiprecision")]
use super::super::motion::PASSING_BITS;
use super::super::motion::{Motion, carry, scale};
use super::super::origin::{Location, Origin};
use super::super::set::StateSet;
use super::{Several, from_wall};
#[cfg(feature = "multiprecision")]
use crate::contact::multiprecision::Passed;
use crate::contact::{Contact, SetContact, Undecided};
use crate::mapping::jacobian_between;
#[cfg(feature = "multiprecision")]
use crate::number::MpBall;
use crate::number::{Ball, UNIT, up};
use crate::pair::{Reduced, Wall};
#[cfg(feature = "multiprecision")]
use crate::several::pass;
use crate::several::{Doubt, Flight, Found, Launch, Reach, Scan};
use crate::turns;

/// One impact after another.
#[derive(Debug)]
pub(in crate::orbit) struct IntervalMotion {
    several: Several,
    pair: Reduced<Ball>,
    /// Whole turns of the last contact.
    turns: i64,
    state: State,
    /// The start, where its sines and cosines are exactly known.
    waves: Option<Vec<(Ball, Ball)>>,
}

#[derive(Debug)]
enum State {
    Wall { wall: Wall, set: StateSet, is_release: bool },
    Inside { height: Ball, phase: Ball, velocity: Ball },
}

impl IntervalMotion {
    pub fn new(several: &Several, pair: &Reduced<Ball>, origin: &Origin<Ball>) -> Self {
        let Origin { phase, velocity, .. } = *origin;
        let state = match origin.place {
            Location::Wall(wall) => {
                let set = StateSet::new(phase, velocity, scale(pair, velocity));
                State::Wall { wall, set, is_release: several.is_release() }
            }
            Location::Inside(height) => State::Inside { height, phase, velocity },
        };
        // Of a phase that is rounded the centre is another.
        let waves = if phase.rad() == 0.0 { several.waves(f64::MANTISSA_DIGITS) } else { None }; // exact: a point
        Self { several: several.clone(), pair: *pair, turns: several.turns, state, waves }
    }

    /// The first contact of the flights from `all` and, more closely, of the one from `centre`.
    fn contact(&self, all: Launch<Ball>, centre: Launch<Ball>) -> Result<(SetContact, Swings), Undecided> {
        let start = all.wall;
        let (phase, middle) = (all.phase, centre.phase.mid());
        let harmonics = &*self.several.harmonics;
        let all = Flight::new(harmonics, all, self.waves.clone());
        let centre = Flight::new(harmonics, centre, self.waves.clone());
        let mut reach = Reach::new(&self.several.band, harmonics);
        let found = Scan::new(&all, &centre).first(&mut reach).map_err(|doubt| match doubt {
            // A doubt that the centre does not share is the set's width's fault.
            Doubt::Graze { .. } | Doubt::Departure if Scan::new(&centre, &centre).first(&mut reach).is_ok() => {
                Undecided { reason: crate::contact::Reason::Width, ..doubt.undecided(start) }
            }
            doubt => doubt.undecided(start),
        })?;
        let swings = [all.acceleration, found.acceleration];
        Ok((set_contact(&found, phase, middle), swings))
    }

    /// From a wall: **equations** (15), (A.1)-(A.7) over the set.
    fn step(&self, wall: Wall, set: &StateSet, is_release: bool) -> Result<(SetContact, StateSet), Undecided> {
        let (phase, before) = (set.phase_ball(), set.velocity_ball());
        let after = |velocity: Ball| self.pair.rebound_of(velocity);
        let all = from_wall(wall, self.turns, phase, after(before), is_release);
        let centre = from_wall(wall, self.turns, Ball::exact(set.phase), after(Ball::exact(set.velocity)), is_release);
        let (image, swings) = self.contact(all, centre)?;
        let contact = image.all;
        let wide = Undecided::width(&contact);
        let jacobian = jacobian_between(self.pair.restitution, contact.time, swings, [before, contact.velocity]);
        let next = set.image(&image, &jacobian.ok_or(wide)?);
        Ok((image, next))
    }

    /// From inside the gap: the enclosure of all first contacts is the new set.
    fn first(&self, height: Ball, phase: Ball, velocity: Ball) -> Result<(SetContact, StateSet), Undecided> {
        let turns = self.turns;
        let all = Launch { wall: None, height, turns, phase, velocity, is_release: false };
        let centre = all.map(|x| Ball::exact(x.mid()));
        let (image, _) = self.contact(all, centre)?;
        let contact = image.all;
        Ok((image, StateSet::new(contact.phase, contact.velocity, scale(&self.pair, contact.velocity))))
    }
}

/// Encloses `y''` at the start of a flight and at its end.
type Swings = [Ball; 2];

/// The contact that was found, of flights that start at `phase`, their centre at `middle`.
fn set_contact(found: &Found<Ball>, phase: Ball, middle: f64) -> SetContact {
    let rest = found.at.rest.mid();
    let at = middle + rest;
    let rounding = UNIT * at.abs();
    let time = found.at.time();
    let velocity = found.centre_velocity;
    // The enclosure of all, around the velocity of the centre.
    let apart = (found.velocity.mid() - velocity.mid()).abs();
    SetContact {
        all: Contact {
            wall: found.wall,
            turns: found.at.turns as f64, // N1: below 2^52
            phase: Ball::new(at, up(found.reach + phase.rad() + (phase.mid() - middle).abs() + rounding)),
            time: time.widened(found.reach),
            velocity: Ball::new(velocity.mid(), up(found.velocity.rad() + apart)),
        },
        phase: Ball::new(at, up(found.centre_reach + rounding)),
        // That at the time found; the phase that is stored is rounded (Lemma S4).
        velocity: velocity.widened(up(found.acceleration.mag() * rounding)),
        slope: found.acceleration,
    }
}

impl Motion for IntervalMotion {
    fn next_contact(&mut self) -> Result<Contact<Ball>, Undecided> {
        let (image, set) = match &self.state {
            State::Wall { wall, set, is_release } => self.step(*wall, set, *is_release)?,
            State::Inside { height, phase, velocity } => self.first(*height, *phase, *velocity)?,
        };
        let contact = image.all;
        let (turns, phase) = carry(contact.turns, set.phase);
        let set = set.at_phase(phase);
        self.turns = turns::after(self.turns, turns).ok_or(Undecided::endless())?;
        self.state = State::Wall { wall: contact.wall, set, is_release: false };
        self.waves = None;
        Ok(Contact { turns, phase: set.phase_ball(), velocity: set.velocity_ball(), ..contact })
    }

    #[cfg(feature = "multiprecision")]
    fn pass_graze(&mut self) -> Option<Passed> {
        let wide = |x: Ball| MpBall::from_ball(x).rounded(PASSING_BITS);
        let launch = match self.state {
            State::Wall { wall, set, is_release } => {
                let after = self.pair.rebound_of(set.velocity_ball());
                from_wall(wall, self.turns, wide(set.phase_ball()), wide(after), is_release)
            }
            State::Inside { height, phase, velocity } => Launch {
                wall: None,
                height: wide(height),
                turns: self.turns,
                phase: wide(phase),
                velocity: wide(velocity),
                is_release: false,
            },
        };
        let harmonics = self.several.harmonics_in(PASSING_BITS);
        let passed = pass(&harmonics, (&self.several.band, &self.several.harmonics), launch)?;
        let phase = MpBall::exact(passed.phase.clone()).to_ball();
        self.turns = turns::after(self.turns, passed.turns)?;
        self.state = State::Inside { height: passed.height.to_ball(), phase, velocity: passed.velocity.to_ball() };
        self.waves = None;
        Some(passed)
    }

    #[cfg(feature = "multiprecision")]
    fn accuracy(&self) -> f64 {
        let (phase, velocity) = match &self.state {
            State::Wall { set, .. } => (set.phase_ball(), set.velocity_ball()),
            State::Inside { phase, height, .. } => (*phase, *height),
        };
        -phase.rad().max(velocity.rad()).log2() // proposes: bits to raise by
    }
}
