//! One harmonic: first contacts by the closed form of [`crate::contact`].

use super::shaking::Shaking;
#[cfg(feature = "multiprecision")]
use super::{Arrival, Flights, Precisely};
use super::{Flying, Origin, Released, Shaken, Still};
use crate::Error;
#[cfg(feature = "multiprecision")]
use crate::contact::multiprecision::{Passed, Refined, Start, isolate_first, pass};
use crate::contact::{
    Contact, PairBounds, Radii, SetContact, Undecided, Verdict, accelerations, first_contact, first_contact_f64,
    first_contacts,
};
use crate::exact::{Enclosure, Exact};
use crate::excitation::displacement_velocity_acceleration;
use crate::flight::{Flight, Launch};
use crate::impact::Touch;
use crate::number::{ABOVE_TURN, Ball, Kernel, Number, UNIT, Wave, kernel, up};
#[cfg(feature = "multiprecision")]
use crate::number::{Magnitude, MpBall};
#[cfg(feature = "multiprecision")]
use crate::pair::Inward;
use crate::pair::{ImpactPair, Reduced, Wall};
use crate::rest::{Pressed, accumulation};
use crate::several::{Phased, Turning};
use crate::turns;

/// A pair that is shaken by one harmonic, equation (9).
#[derive(Clone, Debug)]
pub(crate) struct OneHarmonic {
    pub exact: Reduced<Exact>,
    pub bounds_of_pair: PairBounds,
}

impl OneHarmonic {
    pub fn new(exact: Reduced<Exact>, pair: Reduced<Ball>) -> Self {
        Self { exact, bounds_of_pair: PairBounds::new(pair) }
    }

    /// Returns what shakes a pair of one harmonic.
    ///
    /// # Errors
    /// When a value is beyond what exact expressions or doubles hold, or there are several harmonics.
    pub fn of(pair: &ImpactPair) -> Result<Self, Error> {
        let exact = Reduced::exact(pair)?;
        let reduced = exact.enclosed()?;
        Ok(Self::new(exact, reduced))
    }

    /// Returns whether no parameter is an interval of values.
    #[cfg(feature = "multiprecision")]
    pub fn is_point(&self) -> bool {
        [&self.exact.alpha, &self.exact.restitution].iter().all(|x| x.is_point())
    }
}

impl Shaken for OneHarmonic {
    fn pair(&self) -> &Reduced<Ball> {
        &self.bounds_of_pair.pair
    }

    fn period(&self) -> Option<u32> {
        Some(1)
    }

    fn displacement(&self, _: i64, phase: Ball) -> [Ball; 3] {
        let Reduced { alpha, beta, .. } = self.bounds_of_pair.pair;
        let sin_cos = phase.sin_cos();
        let (shift, speed, _) = displacement_velocity_acceleration(alpha, sin_cos);
        [shift, speed, beta.turn() * beta * sin_cos.0]
    }

    fn steepest(&self) -> f64 {
        up(ABOVE_TURN * self.bounds_of_pair.pair.beta.mag())
    }

    #[cfg(feature = "multiprecision")]
    fn acceleration(&self, _: i64, phase: f64) -> f64 {
        let beta = self.bounds_of_pair.centre.beta;
        beta.turn() * beta * kernel::sin_cos(phase).0
    }

    fn max_reported_chatter(&self, _: f64) -> Option<f64> {
        None
    }

    fn accumulation(&self, wall: Wall, _: i64, phase: &Enclosure, after: Ball, _: &[Exact]) -> Option<f64> {
        accumulation(&self.bounds_of_pair.pair, &Pressed::on(wall, phase)?, after)
    }

    fn release(&self, wall: Wall, turns: i64, phase: &Enclosure, _: u32) -> Option<Released> {
        let (ahead, phase) = Pressed::on(wall, phase)?.release(wall)?;
        let phase = Enclosure::from_f64_bounds(phase, phase)?;
        Some(Released { at: Touch { wall, turns: turns::later(turns, ahead)?, phase }, zero: None })
    }

    fn may_be_loose(&self, wall: Wall, _: i64, phase: &Enclosure) -> bool {
        // Where the pressure begins, exactly, it is 0.
        Pressed::on(wall, phase).is_some_and(|pressed| pressed.is_at_its_begin())
    }

    fn still(&self, origin: &Origin<Exact>) -> Option<Still> {
        Still::under_one(&self.exact, origin).ok().flatten()
    }
}

impl Flying for OneHarmonic {
    type In<N: Turning> = Reduced<N>;
    type Waves<N: Phased> = (N, N);

    fn floats(&self) -> &Reduced<f64> {
        &self.bounds_of_pair.centre
    }

    fn balls(&self) -> &Reduced<Ball> {
        &self.bounds_of_pair.pair
    }

    fn waves<N: Phased>(&self, _: &[Exact], phase: &N, _: u32) -> Option<(N, N)> {
        Some(phase.centre_of().wave())
    }

    #[inline(always)]
    fn propose(&self, launch: &Launch<f64>) -> Result<Contact<f64>, Undecided> {
        let flight = Flight::of(&self.bounds_of_pair.centre, launch.clone(), kernel::sin_cos(launch.phase));
        first_contact_f64::<Kernel>(&flight).ok_or(Undecided::endless())
    }

    fn first_contact(
        &self,
        all: Launch<Ball>,
        _: Option<&(Ball, Ball)>,
    ) -> Result<(Contact<Ball>, [Ball; 2]), Undecided> {
        let (flight, sin_cos) = (all.map(|x| x.mid()), kernel::sin_cos(all.phase.mid()));
        let height = if all.wall.is_none() { all.height.rad() + UNIT } else { 0.0 };
        let radii = Radii { phase: all.phase.rad(), velocity: all.velocity.rad(), height };
        let PairBounds { pair, centre, margins } = &self.bounds_of_pair;
        match first_contact(&Flight::of(centre, flight, sin_cos), margins, radii) {
            Verdict::Certified(contact) => {
                Ok((contact, [all.phase, contact.phase].map(|phase| pair.acceleration(&phase.wave()))))
            }
            Verdict::Undecided(undecided) => Err(undecided),
        }
    }

    #[inline(always)]
    fn first_contacts(
        &self,
        all: Launch<Ball>,
        centre: Launch<Ball>,
        _: Option<&(Ball, Ball)>,
    ) -> Result<(SetContact, [Ball; 2]), Undecided> {
        let PairBounds { pair, centre: parameters, margins } = &self.bounds_of_pair;
        let sin_cos = kernel::sin_cos(centre.phase.mid());
        let flight = Flight::of(parameters, centre.map(|x| x.mid()), sin_cos);
        let point = Radii { velocity: centre.velocity.rad(), ..Radii::default() };
        let radii = Radii { phase: all.phase.rad(), velocity: all.velocity.rad(), ..point };
        let (contact, sin1) = first_contacts(&flight, margins, point, radii)?;
        Ok((contact, accelerations(pair, all.phase, sin_cos.0, sin1)))
    }

    #[cfg(feature = "multiprecision")]
    fn precise(&self, bits: u32) -> Reduced<MpBall> {
        self.exact.map(|x| <MpBall as Phased>::enclose(x, bits))
    }

    #[cfg(feature = "multiprecision")]
    fn widened(&self, bits: u32) -> Reduced<MpBall> {
        self.bounds_of_pair.pair.map(|x| MpBall::from_ball(*x).rounded(bits))
    }

    #[cfg(feature = "multiprecision")]
    fn rounded(&self, pair: &Reduced<MpBall>, bits: u32) -> Reduced<MpBall> {
        pair.map(|x| x.rounded(bits))
    }

    #[cfg(feature = "multiprecision")]
    fn pass(&self, pair: &Reduced<MpBall>, all: Launch<MpBall>, waves: Option<&(MpBall, MpBall)>) -> Option<Passed> {
        let sin_cos = match waves.filter(|_| all.wall.is_some()) {
            Some(centre) => around(centre, &all.phase),
            None => all.phase.sin_cos(),
        };
        pass(&Flight::of(pair, all, sin_cos))
    }

    #[cfg(feature = "multiprecision")]
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
        let start = Start {
            wall: Some(wall),
            height: Ball::exact(0.0),
            phase,
            velocity: wall.inward(doubles.rebound_of(before)),
        };
        let centre = Flight::of(pair, centre, sin_cos.clone());
        let all = || {
            let all = all();
            let sin_cos = around(&sin_cos, &all.phase);
            Flight::of(pair, all, sin_cos)
        };
        let isolated = isolate_first(&self.bounds_of_pair, &start, all, &centre)?;
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

    #[cfg(feature = "multiprecision")]
    fn arrive_from_inside(
        &self,
        pair: &Reduced<MpBall>,
        all: Launch<MpBall>,
        _: Option<&(MpBall, MpBall)>,
        bits: u32,
    ) -> Result<Precisely<(MpBall, MpBall)>, Undecided> {
        let Launch { height, phase, velocity, .. } = all.map(MpBall::to_ball);
        let start = Start { wall: None, height, phase, velocity };
        let sin_cos = all.phase.sin_cos();
        let all = Flight::of(pair, all, sin_cos);
        let isolated = isolate_first(&self.bounds_of_pair, &start, || all.clone(), &all.map(Phased::centre_of))?;
        let contact = isolated.contact(all.wall);
        let narrow = Undecided::precision(&contact);
        let Refined { at, error, velocity, sin_cos } = isolated.refine(&all, bits).ok_or(narrow)?;
        // The velocity at each contact of the set: at most the error away from `at`.
        let velocity = all.wall.inward(velocity.widened(all.steepest() * error));
        Ok((contact, [MpBall::new(at, error), velocity], Some(all.wall.mirror(sin_cos))))
    }
}

/// Sine and cosine of all phases around a centre.
#[cfg(feature = "multiprecision")]
fn around((sin, cos): &(MpBall, MpBall), phase: &MpBall) -> (MpBall, MpBall) {
    let turned = Magnitude::new(6.3, 0) * phase.rad();
    (sin.clone().widened(turned), cos.clone().widened(turned))
}
