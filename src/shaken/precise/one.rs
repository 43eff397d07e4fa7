//! One harmonic: first contacts in balls of many digits, isolated in doubles and refined (Lemma M3).

use super::{Arrival, Flights, Precise, Precisely};
use crate::contact::Undecided;
use crate::contact::multiprecision::{Passed, Refined, isolate_first, pass};
use crate::flight::{Flight, Launch};
use crate::number::{Magnitude, MpBall, Number};
use crate::pair::{Inward, Reduced};
use crate::several::FlightNumber;
use crate::shaken::OneHarmonic;

impl OneHarmonic {
    /// Whether no parameter is an interval of values.
    pub fn is_point(&self) -> bool {
        [&self.exact.alpha, &self.exact.restitution].iter().all(|x| x.is_point())
    }
}

impl Precise for OneHarmonic {
    fn precise(&self, bits: u32) -> Reduced<MpBall> {
        self.exact.map(|x| <MpBall as FlightNumber>::enclose(x, bits))
    }

    fn widened(&self, bits: u32) -> Reduced<MpBall> {
        self.bounds_of_pair.pair.map(|x| MpBall::from_ball(*x).rounded(bits))
    }

    fn rounded(&self, pair: &Reduced<MpBall>, bits: u32) -> Reduced<MpBall> {
        pair.map(|x| x.rounded(bits))
    }

    fn pass(&self, pair: &Reduced<MpBall>, all: Launch<MpBall>, waves: Option<&(MpBall, MpBall)>) -> Option<Passed> {
        let sin_cos = match waves.filter(|_| all.wall.is_some()) {
            Some(centre) => around(centre, &all.phase),
            None => all.phase.sin_cos(),
        };
        pass(&Flight::of(pair, all, sin_cos))
    }

    fn arrive(
        &self,
        pair: &Reduced<MpBall>,
        Flights { all, centre, wall, phase, before, waves }: Flights<'_, (MpBall, MpBall)>,
        bits: u32,
    ) -> Result<Arrival<(MpBall, MpBall)>, Undecided> {
        let doubles = &self.bounds_of_pair.pair;
        let own = pair.restitution.bits();
        let rounded = |(sin, cos): &(MpBall, MpBall)| (sin.rounded(own), cos.rounded(own));
        let sin_cos = waves.map_or_else(|| rounded(&centre.phase.sin_cos()), rounded);
        let start = Launch::from_wall(wall, 0, phase, doubles.rebound_of(before), false);
        let centre = Flight::of(pair, centre, sin_cos.clone());
        let all = || {
            let all = all();
            let sin_cos = around(&sin_cos, &all.phase);
            Flight::of(pair, all, sin_cos)
        };
        let isolated = isolate_first(&self.bounds_of_pair, &start, all, &centre);
        let isolated = isolated.map_err(|undecided| self.settled(&start, undecided))?;
        let contact = isolated.contact(wall);
        let narrow = Undecided::precision(&contact);
        let Refined { at, error, velocity, sin_cos: arrival } = isolated.refine(&centre, bits).ok_or(narrow)?;
        let acceleration = doubles.beta.turn() * doubles.beta;
        let sin0 = sin_cos.0.to_ball().widened(6.3 * phase.rad());
        // The acceleration between `at` and the contact.
        let near = isolated.sin.widened(6.3 * error.to_f64());
        Ok(Arrival {
            accelerations: [acceleration * sin0, acceleration * wall.inward(isolated.sin)],
            slope: wall.inward(acceleration * near),
            contact,
            phase: at,
            error,
            velocity: wall.inward(velocity),
            waves: Some(wall.mirror(arrival)),
        })
    }

    fn arrive_from_inside(
        &self,
        pair: &Reduced<MpBall>,
        all: Launch<MpBall>,
        _: Option<&(MpBall, MpBall)>,
        bits: u32,
    ) -> Result<Precisely<(MpBall, MpBall)>, Undecided> {
        let start = all.map(MpBall::to_ball);
        let sin_cos = all.phase.sin_cos();
        let all = Flight::of(pair, all, sin_cos);
        let isolated = isolate_first(&self.bounds_of_pair, &start, || all.clone(), &all.map(FlightNumber::centre_of))?;
        let contact = isolated.contact(all.wall);
        let narrow = Undecided::precision(&contact);
        let Refined { at, error, velocity, sin_cos } = isolated.refine(&all, bits).ok_or(narrow)?;
        // The velocity at each contact of the set: at most the error away from `at`.
        let velocity = all.wall.inward(velocity.widened(all.steepest() * error));
        Ok((contact, [MpBall::new(at, error), velocity], Some(all.wall.mirror(sin_cos))))
    }
}

/// Sine and cosine of all phases around a centre.
fn around((sin, cos): &(MpBall, MpBall), phase: &MpBall) -> (MpBall, MpBall) {
    let turned = Magnitude::new(6.3, 0) * phase.rad();
    (sin.clone().widened(turned), cos.clone().widened(turned))
}
