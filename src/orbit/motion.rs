//! One impact after another, in double precision: plain and certified.

use super::origin::{Location, Origin};
#[cfg(feature = "multiprecision")]
use super::plan::Plan;
use super::set::StateSet;
#[cfg(feature = "multiprecision")]
use crate::contact::multiprecision::{Passed, pass};
use crate::contact::{Contact, Margins, Radii, Undecided, Verdict, first_contact, first_contact_f64, first_contacts};
use crate::exact::Enclosure;
use crate::flight::Flight;
use crate::mapping::{Passage, jacobian};
#[cfg(feature = "multiprecision")]
use crate::number::MpBall;
use crate::number::{ABOVE_TURN, Ball, Kernel, LARGEST_RATE, UNIT, kernel};
use crate::pair::{Inward, Reduced, Wall};

/// An arithmetic's way from one contact to the next.
pub(super) trait Motion: std::fmt::Debug + Send {
    /// Goes on to the next contact: its wall, phase and velocity, and the whole turns passed.
    fn next_contact(&mut self) -> Result<Contact<Ball>, Undecided>;

    /// The bits that the first impact is computed with.
    fn bits(&self) -> u32 {
        f64::MANTISSA_DIGITS
    }

    /// The bits of each impact, in multiprecision.
    #[cfg(feature = "multiprecision")]
    fn plan(&self) -> Option<&Plan> {
        None
    }

    /// How narrow the set of states is: `-log2` of its greatest radius.
    #[cfg(feature = "multiprecision")]
    fn accuracy(&self) -> f64;

    /// Goes past a contact that may be a graze, into the gap, if that is proved; `None` leaves all as it was.
    #[cfg(feature = "multiprecision")]
    fn pass_graze(&mut self) -> Option<Passed> {
        None
    }

    /// `log2` of the radii of phase and velocity after the last contact, where doubles do not show them.
    fn radii(&self) -> Option<(f64, f64)> {
        None
    }

    /// Phase and velocity of the last contact more narrowly than in doubles, if they are known so.
    fn enclosures(&self) -> Option<(Enclosure, Enclosure)> {
        None
    }
}

/// A floating motion that knows how the box pushes.
#[cfg(feature = "multiprecision")]
pub(super) trait Swinging: Motion {
    /// `y''` at the last contact, or at the start, in gaps a turn squared.
    fn swing(&self) -> f64;
}

/// Shifts a phase into `[-1/2, 1/2]`, exactly (Sterbenz), and moves the turn to the count.
#[inline(always)]
pub(super) fn carry(turns: f64, phase: f64) -> (f64, f64) {
    if phase > 0.5 {
        (turns + 1.0, phase - 1.0)
    } else if phase < -0.5 {
        (turns - 1.0, phase + 1.0)
    } else {
        (turns, phase)
    }
}

/// Bits enough to lose nothing of doubles on the way past a graze.
#[cfg(feature = "multiprecision")]
pub(super) const PASSING_BITS: u32 = 128;

/// A power of two near the velocities to come.
pub(super) fn scale(pair: &Reduced<Ball>, velocity: Ball) -> f64 {
    let speed = pair.beta.mag().max(velocity.mag()).clamp(1.0 / LARGEST_RATE, LARGEST_RATE); // S2: any power of two
    2f64.powi(speed.log2().round() as i32) // S2: any power of two
}

/// Plain doubles, nothing proved.
#[derive(Clone, Debug)]
pub(super) struct FloatMotion {
    pair: Reduced<f64>,
    next: Flight<f64>,
}

impl FloatMotion {
    pub fn new(pair: &Reduced<Ball>, origin: &Origin<Ball>) -> Self {
        let pair = pair.centre();
        let (phase, velocity) = (origin.phase.mid(), origin.velocity.mid());
        let next = match origin.place {
            Location::Wall(wall) => Self::rebound(&pair, wall, phase, velocity),
            Location::Inside(height) => {
                Flight::from_inside(&pair, height.mid(), phase, velocity, kernel::sin_cos(phase))
            }
        };
        Self { pair, next }
    }

    #[inline(always)]
    fn rebound(pair: &Reduced<f64>, wall: Wall, phase: f64, velocity: f64) -> Flight<f64> {
        let after = wall.inward(pair.rebound(velocity));
        Flight::from_wall(pair, wall, phase, after, kernel::sin_cos(phase))
    }
}

impl Motion for FloatMotion {
    fn next_contact(&mut self) -> Result<Contact<Ball>, Undecided> {
        let contact = first_contact_f64::<Kernel>(&self.next).ok_or(Undecided::endless())?;
        let (turns, phase) = carry(contact.turns, contact.phase);
        self.next = Self::rebound(&self.pair, contact.wall, phase, contact.velocity);
        let exact = Ball::exact;
        Ok(Contact {
            wall: contact.wall,
            turns,
            phase: exact(phase),
            time: exact(contact.time),
            velocity: exact(contact.velocity),
        })
    }

    #[cfg(feature = "multiprecision")]
    fn accuracy(&self) -> f64 {
        f64::INFINITY
    }
}

#[cfg(feature = "multiprecision")]
impl Swinging for FloatMotion {
    fn swing(&self) -> f64 {
        self.next.wall.inward(self.next.acceleration_at(self.next.sin))
    }
}

/// Certified in double precision: the centre of the set flies, the set follows by the Jacobian.
#[derive(Clone, Debug)]
pub(super) struct IntervalMotion {
    pair: Reduced<Ball>,
    centre: Reduced<f64>,
    margins: Margins,
    state: State,
}

#[derive(Clone, Copy, Debug)]
enum State {
    Wall { wall: Wall, set: StateSet },
    Inside { height: Ball, phase: Ball, velocity: Ball },
}

impl IntervalMotion {
    pub fn new(pair: &Reduced<Ball>, origin: &Origin<Ball>) -> Self {
        let Origin { phase, velocity, .. } = *origin;
        let state = match origin.place {
            Location::Wall(wall) => State::Wall { wall, set: StateSet::new(phase, velocity, scale(pair, velocity)) },
            Location::Inside(height) => State::Inside { height, phase, velocity },
        };
        Self { pair: *pair, centre: pair.centre(), margins: Margins::new(pair), state }
    }

    /// From inside the gap: the enclosure of all first contacts is the new set.
    #[cold]
    fn first(&self, height: Ball, phase: Ball, velocity: Ball) -> Result<(Contact<Ball>, StateSet), Undecided> {
        let sin_cos = kernel::sin_cos(phase.mid());
        let flight = Flight::from_inside(&self.centre, height.mid(), phase.mid(), velocity.mid(), sin_cos);
        let radii = Radii { phase: phase.rad(), velocity: velocity.rad(), height: height.rad() + UNIT };
        match first_contact(&flight, &self.margins, radii) {
            Verdict::Certified(contact) => {
                let scale = scale(&self.pair, contact.velocity);
                Ok((contact, StateSet::new(contact.phase, contact.velocity, scale)))
            }
            Verdict::Undecided(undecided) => Err(undecided),
        }
    }

    /// From a wall: **equations** (15), (A.1)-(A.7) over the set.
    #[inline(always)]
    fn step(&self, wall: Wall, set: &StateSet) -> Result<(Contact<Ball>, StateSet), Undecided> {
        let (phase, before) = (set.phase_ball(), set.velocity_ball());
        let sin_cos = kernel::sin_cos(set.phase);
        let after = self.pair.rebound_of(Ball::exact(set.velocity));
        let flight = Flight::from_wall(&self.centre, wall, set.phase, wall.inward(after.mid()), sin_cos);
        let point = Radii { velocity: after.rad(), ..Radii::default() };
        let all = Radii { phase: phase.rad(), velocity: self.pair.rebound_of(before).rad(), ..point };
        let (image, sin1) = first_contacts(&flight, &self.margins, point, all)?;
        let contact = image.all;
        let passage = Passage {
            time: contact.time,
            sin0: Ball::exact(sin_cos.0).widened(kernel::SIN_COS_ERROR + ABOVE_TURN * phase.rad()),
            sin1,
            velocity0: before,
            velocity1: contact.velocity,
        };
        let wide = Undecided::width(&contact);
        let jacobian = jacobian(self.pair.beta, self.pair.restitution, &passage).ok_or(wide)?;
        let next = set.image(&image, &jacobian);
        Ok((contact, next))
    }
}

impl Motion for IntervalMotion {
    fn next_contact(&mut self) -> Result<Contact<Ball>, Undecided> {
        let (contact, set) = match &self.state {
            State::Wall { wall, set } => self.step(*wall, set)?,
            State::Inside { height, phase, velocity } => self.first(*height, *phase, *velocity)?,
        };
        let (turns, phase) = carry(contact.turns, set.phase);
        let set = set.at_phase(phase);
        self.state = State::Wall { wall: contact.wall, set };
        Ok(Contact { turns, phase: set.phase_ball(), velocity: set.velocity_ball(), ..contact })
    }

    #[cfg(feature = "multiprecision")]
    fn pass_graze(&mut self) -> Option<Passed> {
        let wide = |x: Ball| MpBall::from_ball(x).rounded(PASSING_BITS);
        let pair = self.pair.map(|x| wide(*x));
        let passed = pass(&match self.state {
            State::Wall { wall, set } => {
                let (phase, before) = (wide(set.phase_ball()), set.velocity_ball());
                let after = wide(wall.inward(self.pair.rebound_of(before)));
                Flight::from_wall(&pair, wall, phase.clone(), after, phase.sin_cos())
            }
            State::Inside { height, phase, velocity } => {
                let phase = wide(phase);
                Flight::from_inside(&pair, wide(height), phase.clone(), wide(velocity), phase.sin_cos())
            }
        })?;
        let phase = MpBall::exact(passed.phase.clone()).to_ball();
        self.state = State::Inside { height: passed.height.to_ball(), phase, velocity: passed.velocity.to_ball() };
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
