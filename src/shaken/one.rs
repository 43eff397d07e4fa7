//! One harmonic: first contacts by the closed form of [`crate::contact`].

use super::shaking::Shaking;
use super::{Flying, Origin, Parameters, Released, Shaken, Still};
use crate::Error;
use crate::contact::{
    Contact, PairBounds, Radii, SetContact, Undecided, Verdict, accelerations, first_contact, first_contact_f64,
    first_contacts,
};
use crate::exact::{Enclosure, Exact};
use crate::excitation::displacement_velocity_acceleration;
use crate::flight::{Flight, Launch};
use crate::impact::Touch;
use crate::number::{ABOVE_TWO_PI, Ball, Kernel, Number, UNIT, Wave, kernel, up};
use crate::pair::{ImpactPair, Reduced, Wall};
use crate::rest::{Pressed, accumulation};
use crate::several::{FlightNumber, PhaseNumber};
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

    /// Excitation of a pair with one harmonic.
    ///
    /// # Errors
    /// If a value is beyond the range of exact expressions or doubles, or there are several harmonics.
    pub fn of(pair: &ImpactPair) -> Result<Self, Error> {
        let exact = Reduced::exact(pair)?;
        let reduced = exact.enclosed()?;
        Ok(Self::new(exact, reduced))
    }
}

impl OneHarmonic {
    /// The reason `undecided`, lasting in any precision if the flight is proved to come to the far wall without velocity: it leaves its own wall
    /// exactly as the contact force ends, and crosses the gap in whole forcing periods. Lemma C5
    pub fn settled(&self, from: &Launch<Ball>, undecided: Undecided) -> Undecided {
        let zero = Ball::exact(0.0);
        let leaves_softly = from.wall.is_some()
            && from.velocity == zero
            && from.phase.rad() == 0.0 // C5: all of these exactly
            && kernel::sin_cos(from.phase.mid()).0 == 0.0; // C5: exactly
        let periods = || Exact::from(1).checked_div(&self.exact.beta).ok()?.as_rational().cloned();
        let lands_softly = leaves_softly && periods().is_some_and(|periods| periods.is_integer());
        Undecided { lasting: undecided.lasting || lands_softly, ..undecided }
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
        up(ABOVE_TWO_PI * self.bounds_of_pair.pair.beta.mag())
    }

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
        // The contact force is 0 exactly at its beginning.
        Pressed::on(wall, phase).is_some_and(|pressed| pressed.is_at_its_begin())
    }

    fn still(&self, origin: &Origin<Exact>) -> Option<Still> {
        Still::under_one(&self.exact, origin).ok().flatten()
    }
}

impl Parameters for OneHarmonic {
    type In<N: PhaseNumber> = Reduced<N>;
    type Waves<N: FlightNumber> = (N, N);

    fn floats(&self) -> &Reduced<f64> {
        &self.bounds_of_pair.centre
    }

    fn balls(&self) -> &Reduced<Ball> {
        &self.bounds_of_pair.pair
    }

    fn waves<N: FlightNumber>(&self, _: &[Exact], phase: &N, _: u32) -> Option<(N, N)> {
        Some(phase.centre_of().wave())
    }
}

impl Flying for OneHarmonic {
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
            Verdict::Undecided(undecided) => Err(self.settled(&all, undecided)),
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
        let found = first_contacts(&flight, margins, point, radii);
        let (contact, sin1) = found.map_err(|undecided| self.settled(&all, undecided))?;
        Ok((contact, accelerations(pair, all.phase, sin_cos.0, sin1)))
    }
}
