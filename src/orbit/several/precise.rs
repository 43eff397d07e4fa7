//! One impact after another in multiprecision, under several harmonics: as [`super::super::precise`].

use rug::Float;

use super::super::motion::{Motion, scale};
use super::super::origin::{Location, Origin};
use super::super::plan::Plan;
use super::super::precise::{PreciseSet, bits_for};
use super::{Several, from_wall};
use crate::contact::multiprecision::Passed;
use crate::contact::{Contact, Reason, Undecided};
use crate::exact::{Enclosure, Exact};
use crate::mapping::jacobian_between;
use crate::number::{Ball, LEAST_BITS, Magnitude, MpBall, Number};
use crate::pair::{Reduced, Wall};
use crate::several::{Flight, Harmonics, Instant, Launch, Phased, Reach, Scan, pass};
use crate::turns;

/// Certified in as many bits as the plan gives each impact.
#[derive(Debug)]
pub(in crate::orbit) struct PreciseMotion {
    several: Several,
    /// In as many bits as the first impact gets.
    harmonics: Harmonics<MpBall>,
    restitution: MpBall,
    pair: Reduced<Ball>,
    plan: Plan,
    /// Impacts so far.
    index: u64,
    turns: i64,
    state: State,
    /// The start, where its sines and cosines are exactly known.
    waves: Option<Vec<(MpBall, MpBall)>>,
}

#[derive(Debug)]
enum State {
    Wall { wall: Wall, set: PreciseSet, is_release: bool },
    Inside { height: MpBall, phase: MpBall, velocity: MpBall },
}

/// The first contacts of a set: one for each flight, near a time.
struct Isolated {
    wall: Wall,
    turns: i64,
    rest: Float,
    reach: f64,
    least: f64,
    time: Ball,
    velocity: Ball,
    acceleration: Ball,
    /// At the start.
    swing: Ball,
}

/// The contact of the centre: its phase less the whole turns, an error, and the velocity there.
struct Refined {
    at: Instant<MpBall>,
    phase: Float,
    error: Magnitude,
    velocity: MpBall,
}

impl PreciseMotion {
    pub fn new(several: &Several, pair: &Reduced<Ball>, origin: &Origin<Exact>, plan: Plan) -> Self {
        let bits = plan.bits(0);
        let enclose = |x: &Exact| <MpBall as Phased>::enclose(x, bits);
        let harmonics = several.harmonics_in(bits);
        let phase = match &several.release {
            Some(zero) => zero.refined(&several.spectrum, bits),
            None => enclose(&origin.phase),
        };
        let velocity = enclose(&origin.velocity);
        let state = match &origin.place {
            Location::Wall(wall) => {
                let set = PreciseSet::new(&phase, &velocity, scale(pair, velocity.to_ball()));
                State::Wall { wall: *wall, set, is_release: several.is_release() }
            }
            Location::Inside(height) => State::Inside { height: enclose(height), phase: phase.clone(), velocity },
        };
        let waves = if phase.rad().is_zero() { several.waves(bits) } else { None };
        let restitution = several.restitution_in(bits);
        let (several, pair, turns) = (several.clone(), *pair, several.turns);
        Self { several, harmonics, restitution, pair, plan, index: 0, turns, state, waves }
    }

    /// Isolates the first contacts, in doubles if they suffice.
    fn isolate(
        &self,
        harmonics: &Harmonics<MpBall>,
        all: &Launch<MpBall>,
        centre: &Launch<MpBall>,
    ) -> Result<Isolated, Undecided> {
        let several = &self.several;
        let reach = || Reach::new(&several.band, &several.harmonics);
        let launch = all.map(MpBall::to_ball);
        let middle = launch.map(|x| Ball::exact(x.mid()));
        let doubles = [launch, middle].map(|launch| Flight::new(&several.harmonics, launch, None));
        if let Ok(found) = Scan::new(&doubles[0], &doubles[1]).first(&mut reach()) {
            return Ok(Isolated {
                wall: found.wall,
                turns: found.at.turns,
                rest: Float::with_val(f64::MANTISSA_DIGITS, found.at.rest.mid()),
                reach: found.reach,
                least: found.least,
                time: found.at.time().widened(found.reach),
                velocity: found.velocity,
                acceleration: found.acceleration,
                swing: doubles[0].acceleration,
            });
        }
        let flights = [all, centre].map(|launch| Flight::new(harmonics, launch.clone(), self.waves.clone()));
        let found = Scan::new(&flights[0], &flights[1]).first(&mut reach()).map_err(|doubt| {
            let undecided = doubt.undecided(all.wall);
            match Scan::new(&flights[1], &flights[1]).first(&mut reach()) {
                Ok(_) => Undecided { reason: Reason::Width, ..undecided },
                Err(_) => undecided,
            }
        })?;
        Ok(Isolated {
            wall: found.wall,
            turns: found.at.turns,
            rest: found.at.rest.mid().clone(),
            reach: found.reach,
            least: found.least,
            time: found.at.time().to_ball().widened(found.reach),
            velocity: found.velocity,
            acceleration: found.acceleration,
            swing: flights[0].acceleration.to_ball(),
        })
    }

    /// The contact of one flight of the set to `bits` bits: Lemma M3.
    fn refine(&self, isolated: &Isolated, flight: &Flight<'_, MpBall>, bits: u32) -> Option<Refined> {
        let limit = MpBall::new(isolated.rest.clone(), Magnitude::new(isolated.reach, 0));
        let mut at = Instant { turns: isolated.turns, rest: MpBall::exact(Float::with_val(bits, &isolated.rest)) };
        let mut before = Magnitude::INFINITE;
        loop {
            let state = flight.state(&at);
            let room = state.room(isolated.wall);
            let (size, noise) = (room.mag(), room.rad());
            if size <= noise + noise || size >= before {
                // Half a turn is one time in two ways: tell it as the isolated one is told.
                // M3: any instant; it is looked at again
                let turns = MpBall::from_f64((at.turns - isolated.turns) as f64);
                let at = Instant { turns: isolated.turns, rest: at.rest.later(&turns) };
                let is_near = limit.contains(&at.rest);
                return is_near.then(|| self.arrived(isolated, flight, at, bits));
            }
            before = size;
            let newton = room.clone().signed(isolated.wall.sign()).ratio_to(&state.velocity)?;
            let bend = state.acceleration.ratio_to(&state.velocity)?;
            let half = newton.like(0.5);
            let back = newton.clone() + half * bend * newton.clone() * newton;
            at = at.later(&-back);
        }
    }

    /// The contacts of flights of the set, told near a time: Lemma M3.
    fn arrived(&self, isolated: &Isolated, flight: &Flight<'_, MpBall>, at: Instant<MpBall>, bits: u32) -> Refined {
        let state = flight.state(&at);
        let error = state.room(isolated.wall).mag().over(Magnitude::new(isolated.least, 0));
        let sum = flight.launch.phase.clone() + at.rest.clone();
        let phase = Float::with_val(bits, sum.mid());
        let rounding = (MpBall::exact(phase.clone()) - sum).mag();
        let velocity = state.velocity.widened(rounding * Magnitude::new(self.harmonics.rates.second, 0));
        Refined { at, phase, error: error + rounding, velocity }
    }

    fn arrive(
        &self,
        all: &Launch<MpBall>,
        centre: &Launch<MpBall>,
        bits: u32,
        next_bits: u32,
    ) -> Result<(Isolated, Contact<Ball>, Refined), Undecided> {
        let harmonics = self.harmonics.rounded(bits);
        let isolated = self.isolate(&harmonics, all, centre)?;
        let start = all.phase.to_ball();
        let contact = Contact {
            wall: isolated.wall,
            turns: isolated.turns as f64, // N1: below 2^52
            phase: start + MpBall::new(isolated.rest.clone(), Magnitude::new(isolated.reach, 0)).to_ball(),
            time: isolated.time,
            velocity: isolated.velocity,
        };
        let flight = Flight::new(&harmonics, centre.clone(), self.waves.clone());
        let narrow = Undecided::precision(&contact);
        let refined = self.refine(&isolated, &flight, next_bits).ok_or(narrow)?;
        Ok((isolated, contact, refined))
    }

    /// From a wall: **equations** (15), (A.1)-(A.7) over the set.
    fn step(&self, wall: Wall, set: &PreciseSet, is_release: bool) -> Result<(Contact<Ball>, PreciseSet), Undecided> {
        let (bits, next_bits) = (bits_for(&self.plan, set, self.index), bits_for(&self.plan, set, self.index + 1));
        let (phase, before) = set.balls();
        let restitution = self.restitution.rounded(bits);
        let rebound = |velocity: MpBall| -(restitution.clone() * velocity);
        let all = from_wall(wall, self.turns, phase, rebound(before.clone()), is_release);
        let exact = |x: &Float| MpBall::exact(x.clone());
        let centre = from_wall(wall, self.turns, exact(&set.phase), rebound(exact(&set.velocity)), is_release);
        let (isolated, contact, refined) = self.arrive(&all, &centre, bits, next_bits)?;
        let wide = Undecided::width(&contact);
        let swings = [isolated.swing, isolated.acceleration];
        let velocities = [before.to_ball(), contact.velocity];
        let jacobian = jacobian_between(self.pair.restitution, contact.time, swings, velocities).ok_or(wide)?;
        let Refined { phase, error, velocity, .. } = refined;
        let velocity = velocity.rounded(next_bits);
        let (shape, unit) = set.image(&jacobian, error, velocity.rad(), isolated.acceleration);
        Ok((contact, PreciseSet { phase, velocity: velocity.mid().clone(), shape, unit }))
    }

    /// From inside the gap: the enclosure of all first contacts is the new set.
    fn first(&self, all: &Launch<MpBall>) -> Result<(Contact<Ball>, PreciseSet), Undecided> {
        let centre = all.map(Phased::centre_of);
        let bits = self.plan.bits(1);
        let (isolated, contact, refined) = self.arrive(all, &centre, self.plan.bits(0), bits)?;
        let flight = Flight::new(&self.harmonics, all.clone(), self.waves.clone());
        let Refined { phase, error, velocity, .. } = self.arrived(&isolated, &flight, refined.at, bits);
        let velocity = velocity.widened(error * Magnitude::new(self.harmonics.rates.second, 0));
        let set = PreciseSet::new(&MpBall::new(phase, error), &velocity, scale(&self.pair, contact.velocity));
        Ok((contact, set))
    }

    /// The start of the flight from inside the gap.
    fn inside(&self, height: &MpBall, phase: &MpBall, velocity: &MpBall) -> Launch<MpBall> {
        let (height, phase, velocity) = (height.clone(), phase.clone(), velocity.clone());
        Launch { wall: None, height, turns: self.turns, phase, velocity, is_release: false }
    }
}

impl Motion for PreciseMotion {
    fn next_contact(&mut self) -> Result<Contact<Ball>, Undecided> {
        let (contact, mut set) = match &self.state {
            State::Wall { wall, set, is_release } => self.step(*wall, set, *is_release)?,
            State::Inside { height, phase, velocity } => self.first(&self.inside(height, phase, velocity))?,
        };
        // Into [-1/2, 1/2], exactly (Sterbenz).
        let whole = set.phase.clone().round().to_f64(); // exact: within a few turns
        set.phase -= whole;
        let (phase, velocity) = set.balls();
        let turns = contact.turns + whole;
        self.index += 1;
        self.turns = turns::after(self.turns, turns).ok_or(Undecided::endless())?;
        self.state = State::Wall { wall: contact.wall, set, is_release: false };
        self.waves = None;
        Ok(Contact { turns, phase: phase.to_ball(), velocity: velocity.to_ball(), ..contact })
    }

    fn bits(&self) -> u32 {
        self.plan.bits(0)
    }

    fn pass_graze(&mut self) -> Option<Passed> {
        let launch = match &self.state {
            State::Wall { wall, set, is_release } => {
                let (phase, before) = set.balls();
                from_wall(*wall, self.turns, phase, -(self.restitution.clone() * before), *is_release)
            }
            State::Inside { height, phase, velocity } => self.inside(height, phase, velocity),
        };
        let passed = pass(&self.harmonics, (&self.several.band, &self.several.harmonics), launch)?;
        let (height, velocity) = (passed.height.clone(), passed.velocity.clone());
        self.turns = turns::after(self.turns, passed.turns)?;
        self.state = State::Inside { height, phase: MpBall::exact(passed.phase.clone()), velocity };
        self.waves = None;
        Some(passed)
    }

    fn plan(&self) -> Option<&Plan> {
        Some(&self.plan)
    }

    fn accuracy(&self) -> f64 {
        let (a, b) = match &self.state {
            State::Wall { set, .. } => set.log2_radii(),
            State::Inside { phase, height, .. } => (phase.rad().log2(), height.rad().log2()),
        };
        -a.max(b) // proposes: bits to raise by
    }

    fn radii(&self) -> Option<(f64, f64)> {
        match &self.state {
            State::Wall { set, .. } => Some(set.log2_radii()),
            State::Inside { .. } => None,
        }
    }

    fn enclosures(&self) -> Option<(Enclosure, Enclosure)> {
        match &self.state {
            State::Wall { set, .. } => set.enclosures(),
            State::Inside { .. } => None,
        }
    }
}

/// The harmonics in so many bits at least.
impl Several {
    pub(super) fn harmonics_in(&self, bits: u32) -> Harmonics<MpBall> {
        Harmonics::new(&self.spectrum, bits.max(LEAST_BITS)) // M1: any number of bits
    }

    fn restitution_in(&self, bits: u32) -> MpBall {
        <MpBall as Phased>::enclose(&self.spectrum.restitution, bits)
    }
}
