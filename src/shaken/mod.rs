//! The excitation, as motions see it: one harmonic, equation (9), or several, equation (1).
//!
//! First contacts are proved by two theorems in two places: by the closed form of [`crate::contact`] and by the scan of [`crate::several`]. Here
//! both have one interface, so that the flight from impact to impact is written once. Times are in periods of the fastest harmonic, expressed as
//! whole forcing periods and the rest, lengths in gaps.

mod clear;
mod later;
mod one;
mod origin;
pub(crate) mod precise;
mod several;
pub mod shaking;
mod still;
mod sum;

use std::fmt::Debug;
use std::sync::Arc;

use impact_pair_model::Start;

use crate::Error;
use crate::clock::Clock;
use crate::contact::{Contact, SetContact, Undecided};
use crate::exact::{Enclosure, Exact};
use crate::flight::Launch;
use crate::mapping::Sheared;
use crate::number::Ball;
use crate::pair::{ImpactPair, Reduced, Wall, rebound_of};
use crate::several::{FlightNumber, PhaseNumber, phases_at};
pub(crate) use clear::{Since, clear};
pub(crate) use one::OneHarmonic;
pub(crate) use origin::{Location, Origin, Released, State};
pub(crate) use precise::Precise;
pub(crate) use several::SeveralHarmonics;
use shaking::Shaking;
pub(crate) use still::Still;
pub(crate) use sum::Sum;

/// The box, and a ball that lies on its walls.
pub(crate) trait Shaken: Debug + Send + Sync {
    /// The pair without units; with several harmonics `alpha` and `beta` are the sums of theirs.
    fn pair(&self) -> &Reduced<Ball>;

    /// Forcing periods after which all phases repeat, where that is proved.
    fn period(&self) -> Option<u32>;

    /// `E/d`, `E'` in gap widths per forcing period and `y''` in gap widths per forcing period squared. **Equations** (1), (9), (10)
    fn displacement(&self, turns: i64, phase: Ball) -> [Ball; 3];

    /// Upper bound of `|y''|` at all times, in gap widths per forcing period squared.
    fn steepest(&self) -> f64;

    /// `y''` in plain doubles.
    fn acceleration(&self, turns: i64, phase: f64) -> f64;

    /// Greatest duration, in forcing periods, of chatter that may be reported, if widths of `least` forcing periods are. `None`: any chatter that
    /// ends before the contact force does, at most half a forcing period after the force began. It proposes.
    fn max_reported_chatter(&self, least: f64) -> Option<f64>;

    /// Upper bound of the duration, in forcing periods, of chatter after a bounce; `after` is the velocity after the impact. 0 for a ball that
    /// does not leave; `None` if not proved. `phases` are those of an origin that the chatter starts from. Lemmas Z1, H7
    fn accumulation(&self, wall: Wall, turns: i64, phase: &Enclosure, after: Ball, phases: &[Exact]) -> Option<f64>;

    /// Release of a ball that rests on a wall since a phase, shown in `bits` bits. Lemmas Z2, H8
    fn release(&self, wall: Wall, turns: i64, phase: &Enclosure, bits: u32) -> Option<Released>;

    /// Whether the contact force on a wall may be 0 at a phase.
    fn may_be_loose(&self, wall: Wall, turns: i64, phase: &Enclosure) -> bool;

    /// The motion from an origin that is proved never to hit a wall again. Lemma Z4
    fn still(&self, origin: &Origin<Exact>) -> Option<Still>;
}

/// The data that flights depend on, in any arithmetic.
pub(crate) trait Parameters: Shaken + Sized + 'static {
    /// The parameters in an arithmetic.
    type In<N: PhaseNumber>: Shaking<N> + Clone + Debug + Send;
    /// Sines and cosines at the start of a flight.
    type Waves<N: FlightNumber>: Debug + Send;

    /// The centres of the parameters.
    fn floats(&self) -> &Self::In<f64>;

    /// The parameters in doubles.
    fn balls(&self) -> &Self::In<Ball>;

    /// Sines and cosines at the centre of an origin's phases; `exact` are the phases of the harmonics there, where they are known.
    fn waves<N: FlightNumber>(&self, exact: &[Exact], phase: &N, bits: u32) -> Option<Self::Waves<N>>;
}

/// First contacts.
pub(crate) trait Flying: Parameters + Precise {
    /// Approximates the first contact of a floating-point flight, without proof.
    fn propose(&self, launch: &Launch<f64>) -> Result<Contact<f64>, Undecided>;

    /// Encloses the first contact of all flights from these starts, and `y''` at their starts and contacts.
    fn first_contact(
        &self,
        all: Launch<Ball>,
        waves: Option<&Self::Waves<Ball>>,
    ) -> Result<(Contact<Ball>, [Ball; 2]), Undecided>;

    /// Encloses the first contacts of all flights that leave a wall and, more closely, of the flight from the centre; also `y''` at the starts
    /// and contacts of all. A doubt that the centre does not share is due to the set's width.
    fn first_contacts(
        &self,
        all: Launch<Ball>,
        centre: Launch<Ball>,
        waves: Option<&Self::Waves<Ball>>,
    ) -> Result<(SetContact, [Ball; 2]), Undecided>;

    /// Flies a set from a wall to its first contacts, with the Jacobian over it: **equations** (15), (A.1)-(A.7).
    #[inline(always)]
    fn fly(&self, set: Leaving, waves: Option<&Self::Waves<Ball>>) -> Result<(SetContact, Sheared<Ball>), Undecided> {
        let Leaving { wall, turns, phase, before, is_release } = set;
        let restitution = self.pair().restitution;
        let launch = |phase, before| Launch::from_wall(wall, turns, phase, rebound_of(restitution, before), is_release);
        let centre = launch(Ball::exact(phase.mid()), Ball::exact(before.mid()));
        let (image, accelerations) = self.first_contacts(launch(phase, before), centre, waves)?;
        let all = image.all;
        let jacobian = Sheared::between(restitution, all.time, accelerations, [before, all.velocity]);
        Ok((image, jacobian.ok_or(Undecided::width(&all))?))
    }
}

/// The excitation of a pair: one harmonic or several.
#[derive(Clone, Debug)]
pub(crate) enum Either {
    One(Arc<OneHarmonic>),
    Several(Arc<SeveralHarmonics>),
}

/// Evaluates an expression in the excitation, for one harmonic or several.
macro_rules! under {
    ($either:expr, $shaken:ident => $answer:expr) => {
        match $either {
            $crate::shaken::Either::One($shaken) => $answer,
            $crate::shaken::Either::Several($shaken) => $answer,
        }
    };
}
pub(crate) use under;

impl Either {
    /// Excitation of `pair`, phases given by the clock.
    ///
    /// # Errors
    /// If a value is beyond the range of exact expressions or doubles.
    pub fn new(pair: &ImpactPair, clock: &Clock) -> Result<Self, Error> {
        Ok(match SeveralHarmonics::new(pair, clock.origin())? {
            None => Self::One(Arc::new(OneHarmonic::of(pair)?)),
            Some(several) => Self::Several(Arc::new(several)),
        })
    }

    /// State that the motion of `pair` from `start` is followed from.
    pub fn origin(&self, pair: &ImpactPair, start: &Start, clock: &Clock) -> Result<Origin<Exact>, Error> {
        Origin::new(pair, start, clock, |start| match self {
            Self::One(_) => Ok(Vec::new()),
            Self::Several(_) => phases_at(pair, start.time()),
        })
    }
}

/// A set of states on a wall, its velocities before the impact, in doubles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leaving {
    pub wall: Wall,
    pub turns: i64,
    pub phase: Ball,
    pub before: Ball,
    pub is_release: bool,
}
