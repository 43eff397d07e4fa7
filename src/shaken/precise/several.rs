//! First contacts of a set in multiprecision: isolated in doubles, if they suffice, and refined (Lemma M3).

use super::{Arrival, Flights, Precise, Precisely};
use crate::contact::multiprecision::Passed;
use crate::contact::{Contact, Undecided};
use crate::flight::Launch;
use crate::number::{Ball, Float, LEAST_BITS, Magnitude, MpBall, Number};
use crate::several::{FlightNumber, Found, Harmonics, Instant, Scan, SumFlight, pass};
use crate::shaken::{SeveralHarmonics, Sum};

/// The first contacts of a set: one for each flight, near a time.
pub(super) struct Isolated {
    /// Encloses the contacts in doubles.
    pub contact: Contact<Ball>,
    /// `y''` at the start and at the contact.
    pub accelerations: [Ball; 2],
    turns: i64,
    rest: Float,
    reach: f64,
    least: f64,
}

impl Isolated {
    /// The contacts `found`, of flights that start in these phases with this acceleration.
    fn new<N: FlightNumber>(found: &Found<N>, rest: Float, time: Ball, phase: Ball, acceleration: Ball) -> Self {
        let near = MpBall::new(rest.clone(), Magnitude::new(found.reach, 0)).to_ball();
        Self {
            contact: Contact {
                wall: found.wall,
                turns: found.at.turns as f64, // N1: below 2^52
                phase: phase + near,
                time: time.widened(found.reach),
                velocity: found.velocity,
            },
            accelerations: [acceleration, found.acceleration],
            turns: found.at.turns,
            rest,
            reach: found.reach,
            least: found.least,
        }
    }

    /// The contact of one flight of the set to `bits` bits: Lemma M3.
    fn refine(&self, flight: &SumFlight<'_, MpBall>, bits: u32) -> Option<Instant<MpBall>> {
        let limit = MpBall::new(self.rest.clone(), Magnitude::new(self.reach, 0));
        let mut at = Instant { turns: self.turns, rest: MpBall::exact(self.rest.rounded(bits)) };
        let (wall, mut before) = (self.contact.wall, Magnitude::INFINITE);
        loop {
            let state = flight.state(&at);
            let room = state.room(wall);
            let (size, noise) = (room.mag(), room.rad());
            if size <= noise + noise || size >= before {
                // Half a forcing period can be written in two ways: it is written as the isolated one is.
                // M3: any instant; it is looked at again
                let turns = MpBall::from_f64((at.turns - self.turns) as f64);
                let rest = at.rest.later(&turns);
                return limit.contains(&rest).then_some(Instant { turns: self.turns, rest });
            }
            before = size;
            let newton = room.clone().signed(wall.sign()).ratio_to(&state.velocity)?;
            let bend = state.acceleration.ratio_to(&state.velocity)?;
            let half = newton.like(0.5);
            let back = newton.clone() + half * bend * newton.clone() * newton;
            at = at.later(&-back);
        }
    }

    /// Contacts of flights of the set, evaluated near a time: the phase, its error, and the velocity there (Lemma M3).
    pub fn evaluated_near(
        &self,
        flight: &SumFlight<'_, MpBall>,
        at: &Instant<MpBall>,
        bits: u32,
    ) -> (Float, Magnitude, MpBall) {
        let state = flight.state(at);
        let error = state.room(self.contact.wall).mag().over(Magnitude::new(self.least, 0));
        let sum = flight.launch.phase.clone() + at.rest.clone();
        let phase = sum.mid().rounded(bits);
        let rounding = (MpBall::exact(phase.clone()) - sum).mag();
        let velocity = state.velocity.widened(rounding * Magnitude::new(flight.harmonics.rates.second, 0));
        (phase, error + rounding, velocity)
    }
}

impl SeveralHarmonics {
    /// Isolates the first contacts of the set, in doubles if they suffice, and refines the centre's contact to `bits` bits.
    pub(super) fn isolated(
        &self,
        sum: &Sum<MpBall>,
        all: &Launch<MpBall>,
        centre: &SumFlight<'_, MpBall>,
        waves: Option<&Vec<(MpBall, MpBall)>>,
        bits: u32,
    ) -> Result<(Isolated, Instant<MpBall>), Undecided> {
        let start = all.phase.to_ball();
        let launch = all.map(MpBall::to_ball);
        let middle = launch.map(FlightNumber::centre_of);
        let doubles = [launch, middle].map(|launch| SumFlight::new(&self.balls.harmonics, launch, None));
        let isolated = match Scan::new(&doubles[0], &doubles[1]).first(&mut self.reach()) {
            Ok(found) => {
                let rest = Float::new(found.at.rest.mid());
                Isolated::new(&found, rest, found.at.time(), start, doubles[0].acceleration)
            }
            Err(_) => {
                let all = SumFlight::new(&sum.harmonics, all.clone(), waves);
                let found = self.scan(&all, centre)?;
                let (rest, time) = (found.at.rest.mid().clone(), found.at.time().to_ball());
                Isolated::new(&found, rest, time, start, all.acceleration.to_ball())
            }
        };
        let refined = isolated.refine(centre, bits);
        let at = refined.ok_or_else(|| Undecided::precision(&isolated.contact))?;
        Ok((isolated, at))
    }
}

impl Precise for SeveralHarmonics {
    fn precise(&self, bits: u32) -> Sum<MpBall> {
        let restitution = <MpBall as FlightNumber>::enclose(&self.spectrum.restitution, bits);
        Sum { harmonics: Harmonics::new(&self.spectrum, bits.max(LEAST_BITS)), restitution } // M1: any number of bits
    }

    fn widened(&self, bits: u32) -> Sum<MpBall> {
        self.precise(bits)
    }

    fn rounded(&self, sum: &Sum<MpBall>, bits: u32) -> Sum<MpBall> {
        Sum { harmonics: sum.harmonics.rounded(bits), restitution: sum.restitution.rounded(bits) }
    }

    fn pass(&self, sum: &Sum<MpBall>, all: Launch<MpBall>, _: Option<&Vec<(MpBall, MpBall)>>) -> Option<Passed> {
        pass(&sum.harmonics, (&self.band, &self.balls.harmonics), all)
    }

    fn arrive(
        &self,
        sum: &Sum<MpBall>,
        Flights { all, centre, waves, .. }: Flights<'_, Vec<(MpBall, MpBall)>>,
        bits: u32,
    ) -> Result<Arrival<Vec<(MpBall, MpBall)>>, Undecided> {
        let centre = SumFlight::new(&sum.harmonics, centre, waves);
        let (isolated, at) = self.isolated(sum, &all(), &centre, waves, bits)?;
        let (phase, error, velocity) = isolated.evaluated_near(&centre, &at, bits);
        let Isolated { contact, accelerations, .. } = isolated;
        Ok(Arrival { contact, accelerations, phase, error, velocity, slope: accelerations[1], waves: None })
    }

    fn arrive_from_inside(
        &self,
        sum: &Sum<MpBall>,
        all: Launch<MpBall>,
        waves: Option<&Vec<(MpBall, MpBall)>>,
        bits: u32,
    ) -> Result<Precisely<Vec<(MpBall, MpBall)>>, Undecided> {
        let centre = SumFlight::new(&sum.harmonics, all.map(FlightNumber::centre_of), waves);
        let (isolated, at) = self.isolated(sum, &all, &centre, waves, bits)?;
        let all = SumFlight::new(&sum.harmonics, all, waves);
        let (phase, error, velocity) = isolated.evaluated_near(&all, &at, bits);
        let velocity = velocity.widened(error * Magnitude::new(sum.harmonics.rates.second, 0));
        Ok((isolated.contact, [MpBall::new(phase, error), velocity], None))
    }
}
