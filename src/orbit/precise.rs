//! One impact after another in multiprecision, for any excitation.
//!
//! The centre of the set is a pair of numbers of many bits and flies in balls; the set around it is the parallelogram of
//! [`super::set`], in units of a power of two, since a chaotic orbit of 10,000 impacts starts with one of `2^-5800`.
//! The Jacobian (A.7) multiplies these radii, so doubles do for it.

use std::sync::Arc;

use super::motion::{Motion, States};
use super::plan::Plan;
use super::set::{Noise, SHORTEST_EDGE, Shape};
use crate::contact::{Contact, Grazed, Undecided};
use crate::exact::{Enclosure, Exact};
use crate::flight::Launch;
use crate::mapping::jacobian_between;
use crate::number::{Ball, Float, LEAST_BITS, Magnitude, MpBall};
use crate::pair::Wall;
use crate::several::FlightNumber;
use crate::shaken::precise::{Arrival, Flights};
use crate::shaken::shaking::Shaking;
use crate::shaken::{Flying, Location, Origin};
use crate::turns;

/// Bits below the radius of a set that are negligible for its centre.
const NEGLIGIBLE_BITS: i64 = 64;

/// Certified in as many bits as the plan gives each impact.
#[derive(Debug)]
pub(super) struct PreciseMotion<S: Flying> {
    shaken: Arc<S>,
    /// The parameters, in the bits of the first impact.
    parameters: S::In<MpBall>,
    plan: Plan,
    /// Impacts so far.
    index: u64,
    /// Whole forcing periods of the last contact.
    turns: i64,
    states: States<PreciseSet, MpBall>,
    /// Phases and velocities of the set in doubles, where they are known.
    doubles: Option<[Ball; 2]>,
    /// Sines and cosines at the start of the next flight from the centre, where they are known.
    waves: Option<S::Waves<MpBall>>,
}

/// A parallelogram of states around a centre.
#[derive(Debug)]
pub(super) struct PreciseSet {
    pub phase: Float,
    pub velocity: Float,
    /// The parallelogram around the centre, in units of `2^unit`.
    pub shape: Shape,
    pub unit: i64,
}

impl PreciseSet {
    /// Box of all states within two balls.
    pub fn new(phase: &MpBall, velocity: &MpBall, scale: f64) -> Self {
        let unit = greatest_exponent(&[phase.rad(), velocity.rad()]);
        let shape = Shape::new(phase.rad().in_units_of(unit), velocity.rad().in_units_of(unit), scale);
        Self { phase: phase.mid().clone(), velocity: velocity.mid().clone(), shape, unit }
    }

    /// Encloses phases and velocities of the set.
    pub fn balls(&self) -> (MpBall, MpBall) {
        let (phase, velocity) = (self.shape.phase_radius(), self.shape.velocity_radius());
        let ball = |mid: &Float, rad| MpBall::new(mid.clone(), Magnitude::new(rad, self.unit));
        (ball(&self.phase, phase), ball(&self.velocity, velocity))
    }

    /// Phases and velocities in doubles.
    pub fn doubles(&self) -> [Ball; 2] {
        let (phase, velocity) = self.balls();
        [phase.to_ball(), velocity.to_ball()]
    }

    /// `log2` of the radii of phases and velocities.
    pub fn log2_radii(&self) -> (f64, f64) {
        let (phase, velocity) = self.balls();
        (phase.rad().log2(), velocity.rad().log2())
    }

    /// Phases and velocities as intervals, in at most `bits` bits.
    pub fn enclosures(&self, bits: u32) -> Option<(Enclosure, Enclosure)> {
        let (phase, velocity) = self.balls();
        Some((phase.enclosure_in(bits)?, velocity.enclosure_in(bits)?))
    }

    /// Image of the shape, in a unit that suits the image and the noise of the centre.
    pub fn image(&self, jacobian: &[[Ball; 2]; 2], phase: Magnitude, velocity: Magnitude, slope: Ball) -> (Shape, i64) {
        let edges = self.shape.edges.map(|edge| Magnitude::new(edge, self.unit));
        let unit = greatest_exponent(&[edges[0], edges[1], phase, velocity]);
        let edges = edges.map(|edge| match edge.in_units_of(unit) {
            0.0 => 0.0,
            edge => edge.max(SHORTEST_EDGE), // M4: enlarges the set
        });
        let noise = Noise { phase: phase.in_units_of(unit), velocity: velocity.in_units_of(unit), slope };
        (Shape { edges, ..self.shape }.image(jacobian, &noise), unit)
    }
}

/// Greatest exponent of the magnitudes, 0 when all are 0.
fn greatest_exponent(magnitudes: &[Magnitude]) -> i64 {
    magnitudes.iter().filter_map(|x| x.exponent()).max().unwrap_or(0) // M4: any unit will do for nothing
}

/// Bits planned for an impact, but at most [`NEGLIGIBLE_BITS`] beyond the width of the set.
fn bits_for(plan: &Plan, set: &PreciseSet, index: u64) -> u32 {
    let planned = plan.bits(index);
    let (phase, velocity) = (set.shape.phase_radius(), set.shape.velocity_radius());
    let radius = Magnitude::new(phase.max(velocity / set.shape.scale), set.unit); // proposes: bits to compute with
    match radius.exponent() {
        Some(exponent) => {
            planned.min((NEGLIGIBLE_BITS - exponent).clamp(i64::from(LEAST_BITS), i64::from(planned)) as u32) // proposes
        }
        None => planned,
    }
}

/// Result of a step: the contacts in doubles, the set after it, and the sines and cosines at its centre, if known.
type Arrived<W> = (Contact<Ball>, PreciseSet, Option<W>);

impl<S: Flying> PreciseMotion<S> {
    pub fn new(shaken: Arc<S>, origin: &Origin<Exact>, plan: Plan) -> Self {
        let bits = plan.bits(0);
        let enclose = |x: &Exact| <MpBall as FlightNumber>::enclose(x, bits);
        let phase = match origin.release().and_then(|release| release.zero.as_ref()) {
            Some(zero) => zero.refined(bits),
            None => enclose(&origin.state.phase),
        };
        let velocity = enclose(&origin.state.velocity);
        let waves = shaken.waves(&origin.phases, &phase, bits);
        let states = match &origin.state.place {
            Location::Wall(wall) => {
                let set = PreciseSet::new(&phase, &velocity, shaken.pair().scale(velocity.to_ball()));
                States::Wall { wall: *wall, set, is_release: origin.release().is_some() }
            }
            Location::Inside(height) => States::Inside { height: enclose(height), phase, velocity },
        };
        let parameters = shaken.precise(bits);
        Self { shaken, parameters, plan, index: 0, turns: origin.state.turns, states, doubles: None, waves }
    }

    /// Contacts of flights from a wall, and the set after them: **equations** (15), (A.1)-(A.7) over the set.
    fn step(&self, wall: Wall, set: &PreciseSet, is_release: bool) -> Result<Arrived<S::Waves<MpBall>>, Undecided> {
        let [bits, next_bits] = [self.index, self.index + 1].map(|index| bits_for(&self.plan, set, index));
        let parameters = self.shaken.rounded(&self.parameters, bits);
        let rebound = |phase: MpBall, before: MpBall| {
            let after = -(parameters.restitution().clone() * before);
            Launch::from_wall(wall, self.turns, phase, after, is_release)
        };
        let all = || {
            let (phase, velocity) = set.balls();
            rebound(phase, velocity)
        };
        let [phase, before] = self.doubles.unwrap_or_else(|| set.doubles());
        let centre = rebound(MpBall::exact(set.phase.clone()), MpBall::exact(set.velocity.clone()));
        let flights = Flights { all: &all, centre, wall, phase, before, waves: self.waves.as_ref() };
        let arrival = self.shaken.arrive(&parameters, flights, next_bits)?;
        let Arrival { contact, accelerations, phase, error, velocity, slope, waves } = arrival;
        let restitution = self.shaken.pair().restitution;
        let jacobian = jacobian_between(restitution, contact.time, accelerations, [before, contact.velocity]);
        let velocity = velocity.rounded(next_bits);
        let (shape, unit) = set.image(&jacobian.ok_or(Undecided::width(&contact))?, error, velocity.rad(), slope);
        Ok((contact, PreciseSet { phase, velocity: velocity.mid().clone(), shape, unit }, waves))
    }

    /// Contacts of flights from inside the gap, and the set after them: the enclosure of all first contacts.
    fn first(
        &self,
        height: &MpBall,
        phase: &MpBall,
        velocity: &MpBall,
    ) -> Result<Arrived<S::Waves<MpBall>>, Undecided> {
        let all = Launch::from_inside(height.clone(), self.turns, phase.clone(), velocity.clone());
        let (shaken, bits) = (&self.shaken, self.plan.bits(1));
        let (contact, [phase, velocity], waves) =
            shaken.arrive_from_inside(&self.parameters, all, self.waves.as_ref(), bits)?;
        Ok((contact, PreciseSet::new(&phase, &velocity, shaken.pair().scale(velocity.to_ball())), waves))
    }
}

impl<S: Flying> Motion for PreciseMotion<S> {
    fn next_contact(&mut self) -> Result<Contact<Ball>, Undecided> {
        let (contact, mut set, waves) = match &self.states {
            States::Wall { wall, set, is_release } => self.step(*wall, set, *is_release)?,
            States::Inside { height, phase, velocity } => self.first(height, phase, velocity)?,
        };
        // Into [-1/2, 1/2], exactly (Sterbenz).
        let whole = set.phase.round().to_f64(); // exact: within a few forcing periods
        set.phase = set.phase.minus(&Float::new(whole), set.phase.bits());
        let [phase, velocity] = set.doubles();
        self.doubles = Some([phase, velocity]);
        let turns = contact.turns + whole;
        self.index += 1;
        self.turns = turns::counted(self.turns, turns);
        (self.states, self.waves) = (States::Wall { wall: contact.wall, set, is_release: false }, waves);
        Ok(Contact { turns, phase, velocity, ..contact })
    }

    fn bits(&self) -> u32 {
        self.plan.bits(0)
    }

    fn pass_graze(&mut self) -> Option<Grazed> {
        let passed = self.shaken.pass(&self.parameters, self.launch(), self.waves.as_ref())?;
        let in_doubles = passed.in_doubles()?;
        let (height, velocity) = (passed.height.clone(), passed.velocity.clone());
        self.turns = turns::after(self.turns, passed.turns)?;
        self.states = States::Inside { height, phase: MpBall::exact(passed.phase.clone()), velocity };
        self.waves = None;
        Some(in_doubles)
    }

    fn plan(&self) -> Option<&Plan> {
        Some(&self.plan)
    }

    fn accuracy(&self) -> f64 {
        let Launch { height, phase, velocity, .. } = self.launch();
        let relative = velocity.rad().log2() - velocity.mag().log2();
        let least = if relative.is_nan() { f64::NEG_INFINITY } else { relative }; // proposes: nothing, exactly
        -least.max(phase.rad().log2()).max(height.rad().log2()) // proposes: bits to raise by
    }

    fn radii(&self) -> Option<(f64, f64)> {
        self.set().map(PreciseSet::log2_radii)
    }

    fn enclosures(&self, bits: u32) -> Option<(Enclosure, Enclosure)> {
        self.set()?.enclosures(bits)
    }
}

impl<S: Flying> PreciseMotion<S> {
    /// Flights of all states to the next contact.
    fn launch(&self) -> Launch<MpBall> {
        match &self.states {
            States::Wall { wall, set, is_release } => {
                let (phase, before) = set.balls();
                let after = -(self.parameters.restitution().clone() * before);
                Launch::from_wall(*wall, self.turns, phase, after, *is_release)
            }
            States::Inside { height, phase, velocity } => {
                Launch::from_inside(height.clone(), self.turns, phase.clone(), velocity.clone())
            }
        }
    }

    /// The states at the last contact.
    fn set(&self) -> Option<&PreciseSet> {
        match &self.states {
            States::Wall { set, .. } => Some(set),
            States::Inside { .. } => None,
        }
    }
}
