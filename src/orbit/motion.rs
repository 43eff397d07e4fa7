//! One impact after another, in double precision: plain and certified, for any excitation.

use std::sync::Arc;

use super::plan::Plan;
use super::set::StateSet;
use crate::contact::{Contact, Grazed, Undecided};
use crate::covering::start::Starts;
use crate::exact::Enclosure;
use crate::flight::Launch;
use crate::number::Ball;
use crate::pair::{Wall, rebound};
use crate::shaken::{Flying, Leaving, Location, Origin, State};
use crate::turns;

/// Bounds of some starts: times and velocities in the units of the scene.
pub(super) type StartBounds = (Enclosure, Enclosure);

/// An arithmetic's way from one contact to the next.
pub(super) trait Motion: std::fmt::Debug + Send {
    /// Goes on to the next contact: its wall, phase and velocity, and the whole forcing periods passed, which the caller counts (Lemma N1).
    fn next_contact(&mut self) -> Result<Contact<Ball>, Undecided>;

    /// Starts near the requested one, one of which has this motion; `None` where the motion begins at the requested start.
    fn starts(&self) -> Option<Starts> {
        None
    }

    /// The bounds of these starts, where they are known more narrowly than in doubles.
    fn start_bounds(&self) -> Option<StartBounds> {
        None
    }

    /// The bits that the first impact is computed with.
    fn bits(&self) -> u32 {
        f64::MANTISSA_DIGITS
    }

    /// The bits of each impact, in multiprecision.
    fn plan(&self) -> Option<&Plan> {
        None
    }

    /// Accuracy of the set of flights in bits: `-log2` of the greatest radius, relative for velocities after an impact.
    fn accuracy(&self) -> f64;

    /// Goes past a contact that may be a graze, into the gap, if that is proved; `None` leaves all as it was.
    fn pass_graze(&mut self) -> Option<Grazed> {
        None
    }

    /// `log2` of the radii of phase and velocity after the last contact, where doubles do not show them.
    fn radii(&self) -> Option<(f64, f64)> {
        None
    }

    /// Encloses phase and velocity of the last contact in at most the given bits, where they are known more narrowly than in doubles.
    fn enclosures(&self, _: u32) -> Option<(Enclosure, Enclosure)> {
        None
    }
}

/// The states of a set after a contact, before the impact, or inside the gap.
#[derive(Debug)]
pub(super) enum States<S, N> {
    Wall { wall: Wall, set: S, is_release: bool },
    Inside { height: N, phase: N, velocity: N },
}

/// Plain doubles, nothing proved.
#[derive(Debug)]
pub(super) struct FloatMotion<S> {
    shaken: Arc<S>,
    next: Launch<f64>,
}

impl<S: Flying> FloatMotion<S> {
    pub fn new(shaken: Arc<S>, origin: &Origin<Ball>) -> Self {
        let next = origin.launch(shaken.pair().restitution.mid());
        Self { shaken, next }
    }
}

impl<S: Flying> Motion for FloatMotion<S> {
    fn next_contact(&mut self) -> Result<Contact<Ball>, Undecided> {
        let Contact { wall, turns, phase, time, velocity } = self.shaken.propose(&self.next)?;
        let (turns, phase) = turns::carry(turns, phase);
        let after = rebound(&self.shaken.pair().restitution.mid(), velocity);
        self.next = Launch::from_wall(wall, turns::counted(self.next.turns, turns), phase, after, false);
        let exact = Ball::exact;
        Ok(Contact { wall, turns, phase: exact(phase), time: exact(time), velocity: exact(velocity) })
    }

    fn accuracy(&self) -> f64 {
        f64::INFINITY
    }
}

/// Certified in double precision: the centre of the set flies, the set follows by the Jacobian.
#[derive(Debug)]
pub(super) struct IntervalMotion<S: Flying> {
    shaken: Arc<S>,
    /// Whole forcing periods of the last contact.
    turns: i64,
    states: States<StateSet, Ball>,
    /// Sines and cosines at the start of the next flight, where they are known better than from the phase.
    waves: Option<S::Waves<Ball>>,
}

impl<S: Flying> IntervalMotion<S> {
    pub fn new(shaken: Arc<S>, origin: &Origin<Ball>) -> Self {
        let State { ref place, turns, phase, velocity } = origin.state;
        let states = match *place {
            Location::Wall(wall) => {
                let set = StateSet::new(phase, velocity, shaken.pair().scale(velocity));
                States::Wall { wall, set, is_release: origin.release().is_some() }
            }
            Location::Inside(height) => States::Inside { height, phase, velocity },
        };
        let waves = shaken.waves(&origin.phases, &phase, f64::MANTISSA_DIGITS);
        Self { shaken, turns, states, waves }
    }

    /// Contacts of flights from a wall, and the set after them: **equations** (15), (A.1)-(A.7) over the set.
    #[inline(always)]
    fn step(&self, wall: Wall, set: &StateSet, is_release: bool) -> Result<(Contact<Ball>, StateSet), Undecided> {
        let (phase, before) = (set.phase_ball(), set.velocity_ball());
        let leaving = Leaving { wall, turns: self.turns, phase, before, is_release };
        let (image, jacobian) = self.shaken.fly(leaving, self.waves.as_ref())?;
        Ok((image.all, set.image(&image, &jacobian.jacobian())))
    }

    /// Contacts of flights from inside the gap, and the set after them: the enclosure of all first contacts.
    #[cold]
    fn first(&self, height: Ball, phase: Ball, velocity: Ball) -> Result<(Contact<Ball>, StateSet), Undecided> {
        let all = Launch::from_inside(height, self.turns, phase, velocity);
        let (contact, _) = self.shaken.first_contact(all, self.waves.as_ref())?;
        Ok((contact, StateSet::new(contact.phase, contact.velocity, self.shaken.pair().scale(contact.velocity))))
    }
}

impl<S: Flying> Motion for IntervalMotion<S> {
    fn next_contact(&mut self) -> Result<Contact<Ball>, Undecided> {
        let (contact, set) = match &self.states {
            States::Wall { wall, set, is_release } => self.step(*wall, set, *is_release)?,
            States::Inside { height, phase, velocity } => self.first(*height, *phase, *velocity)?,
        };
        let (turns, phase) = turns::carry(contact.turns, set.phase);
        let set = set.at_phase(phase);
        self.turns = turns::counted(self.turns, turns);
        self.states = States::Wall { wall: contact.wall, set, is_release: false };
        self.waves = None;
        Ok(Contact { turns, phase: set.phase_ball(), velocity: set.velocity_ball(), ..contact })
    }

    fn pass_graze(&mut self) -> Option<Grazed> {
        let launch = match self.states {
            States::Wall { wall, set, is_release } => {
                let after = self.shaken.pair().rebound_of(set.velocity_ball());
                Launch::from_wall(wall, self.turns, set.phase_ball(), after, is_release)
            }
            States::Inside { height, phase, velocity } => Launch::from_inside(height, self.turns, phase, velocity),
        };
        let passed = self.shaken.pass_graze(launch)?;
        let Grazed { phase, height, velocity, .. } = passed;
        self.turns = turns::after(self.turns, passed.turns)?;
        self.states = States::Inside { height, phase, velocity };
        self.waves = None;
        Some(passed)
    }

    fn accuracy(&self) -> f64 {
        let (phase, velocity) = match &self.states {
            States::Wall { set, .. } => (set.phase_ball(), set.velocity_ball()),
            States::Inside { phase, height, .. } => (*phase, *height),
        };
        -phase.rad().max(velocity.rad()).log2() // proposes: bits to raise by
    }
}
