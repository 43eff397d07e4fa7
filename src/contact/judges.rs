//! The judges of a proposal: the enclosure, for one flight and for a set of them, and none at all.

use super::bounds::{Bounds, Margins, Radii};
use super::certify::{Arrival, Bracket, Doubt};
use super::extrema::{Extrema, Target};
use super::solve::{Iterate, NoProposal, Verifier, propose};
use super::{Contact, Reason, Undecided};
use crate::flight::Flight;
use crate::number::kernel::{SIN_COS_ERROR, SmallAngle};
use crate::number::{ABOVE_TWO_PI, Ball, Kernel, Number, UNIT, up};
use crate::pair::{Inward, Reduced, Wall};

impl Bracket {
    /// The contact, out of the mirrored frame of its flight.
    #[inline(always)]
    pub(super) fn contact(&self, flight: &Flight<f64>) -> Contact<Ball> {
        let Arrival { target, turns, phase, time } = self.arrival;
        let (wall, velocity) = (target.wall(flight.wall), flight.wall.inward(self.velocity));
        Contact { wall, turns, phase, time, velocity }
    }
}

impl<const WIDE: bool> Bounds<'_, WIDE> {
    /// The proposed contact is too close to an extremum for its velocity's sign to be proved.
    #[inline(always)]
    fn unbracketed(&self, iterate: &Iterate) -> Undecided {
        unbracketed(self.flight.wall, iterate.target)
    }
}

/// The enclosure disposes.
impl<const WIDE: bool> Verifier for Bounds<'_, WIDE> {
    type Answer = Result<Bracket, Undecided>;

    #[inline(always)]
    fn monotone(&self, iterate: &Iterate) -> Self::Answer {
        let bracket = self.bracket(iterate).ok_or_else(|| self.unbracketed(iterate))?;
        self.is_monotone(&bracket.arrival).map_err(|doubt| doubted(*self, doubt, bracket.arrival))?;
        Ok(bracket)
    }

    #[inline(always)]
    fn hop(&self, iterate: &Iterate, departure: &SmallAngle) -> Self::Answer {
        let bracket = self.hop_bracket(iterate, departure).ok_or_else(|| self.unbracketed(iterate))?;
        self.is_one_hop(&bracket).map_err(|doubt| doubted(*self, doubt, bracket.arrival))?;
        Ok(bracket)
    }

    #[inline(always)]
    fn piece(&self, iterate: &Iterate, extrema: &Extrema, k: f64) -> Self::Answer {
        let bracket = self.bracket(iterate).ok_or_else(|| self.unbracketed(iterate))?;
        self.is_first(extrema, k, &bracket.arrival).map_err(|doubt| doubted(*self, doubt, bracket.arrival))?;
        Ok(bracket)
    }

    #[cold]
    fn nothing(&self, why: NoProposal) -> Self::Answer {
        Err(unproposed(self.flight, why))
    }
}

/// The first contacts of a set of flights.
pub(crate) struct SetContact {
    /// Encloses the contact of every flight of the set.
    pub all: Contact<Ball>,
    /// Encloses the phase on arrival of the flight from the centre.
    pub phase: Ball,
    /// Velocity of that flight at the middle of its phase, but for the radius; elsewhere the slope times the distance is added.
    pub velocity: Ball,
    /// `dv/du` on arrival: the acceleration, over the bracket.
    pub slope: Ball,
}

/// Encloses the first contact of all the flights that start within the radii `all`, and more closely that of those
/// within `point`; both as [`first_contact`] does. With it comes `sin th1` over the set.
///
/// The phase and velocity of the latter lie in `phase x velocity`, sheared by `slope` (Lemma S4).
///
/// A doubt that the centre's flight does not share is the set's width's fault.
#[inline(always)]
pub(crate) fn first_contacts(
    flight: &Flight<f64>,
    margins: &Margins,
    point: Radii,
    all: Radii,
) -> Result<(SetContact, Ball), Undecided> {
    let verifiers = SetAndCentre {
        centre: Bounds::<false>::new(flight, margins, point),
        all: Bounds::<true>::new(flight, margins, all),
    };
    let (all, centre) = propose::<Kernel, _>(flight, &verifiers)?;
    Ok(together(flight, margins, &all, &centre))
}

/// The contacts of a set, and `sin th1` over it, from the brackets of all its flights and of the one from its centre.
#[inline(always)]
pub(super) fn together(flight: &Flight<f64>, margins: &Margins, all: &Bracket, centre: &Bracket) -> (SetContact, Ball) {
    let beta = Ball::new(flight.beta, margins.beta_radius(flight.beta));
    let slope = beta.turn() * beta * centre.sin;
    // The stored phase is rounded, the velocity is that before the rounding (Lemma S4).
    let rounding = UNIT * (2.0 * centre.arrival.phase.mid().abs() + centre.arrival.time.mid().abs());
    let rest = up(slope.mag().mul_add(rounding, centre.rest));
    let contact = SetContact {
        all: all.contact(flight),
        phase: centre.arrival.phase,
        velocity: flight.wall.inward(Ball::new(centre.velocity.mid(), rest)),
        slope: flight.wall.inward(slope),
    };
    (contact, flight.wall.inward(all.sin))
}

/// `y''` at all starts of a set and at its contacts, from the computed sine of the centre's phase and that over the contacts.
#[inline(always)]
pub(crate) fn accelerations(pair: &Reduced<Ball>, phase: Ball, sin0: f64, sin1: Ball) -> [Ball; 2] {
    let sin0 = Ball::exact(sin0).widened(SIN_COS_ERROR + ABOVE_TWO_PI * phase.rad());
    let acceleration = pair.beta.turn() * pair.beta;
    [acceleration * sin0, acceleration * sin1]
}

/// Judges the flights of a set, and the one of its centre.
struct SetAndCentre<'a> {
    centre: Bounds<'a, false>,
    all: Bounds<'a, true>,
}

impl SetAndCentre<'_> {
    /// The undecided result of a set: its reason is the set's width if the flight from the centre is decided.
    #[cold]
    fn undecided_of_set(doubt: Undecided, centre: Result<Bracket, Undecided>) -> Undecided {
        match centre {
            Ok(_) => Undecided { reason: Reason::Width, ..doubt },
            Err(_) => doubt,
        }
    }
}

impl Verifier for SetAndCentre<'_> {
    type Answer = Result<(Bracket, Bracket), Undecided>;

    #[inline(always)]
    fn monotone(&self, iterate: &Iterate) -> Self::Answer {
        let all =
            self.all.monotone(iterate).map_err(|doubt| Self::undecided_of_set(doubt, self.centre.monotone(iterate)))?;
        let centre = self.centre.bracket(iterate).ok_or_else(|| self.centre.unbracketed(iterate))?;
        Ok((all, centre))
    }

    #[inline(always)]
    fn hop(&self, iterate: &Iterate, departure: &SmallAngle) -> Self::Answer {
        let all = self.all.hop(iterate, departure);
        let all = all.map_err(|doubt| Self::undecided_of_set(doubt, self.centre.hop(iterate, departure)))?;
        let centre = self.centre.hop_bracket(iterate, departure);
        Ok((all, centre.ok_or_else(|| self.centre.unbracketed(iterate))?))
    }

    #[inline(always)]
    fn piece(&self, iterate: &Iterate, extrema: &Extrema, k: f64) -> Self::Answer {
        let all = self.all.piece(iterate, extrema, k);
        let all = all.map_err(|doubt| Self::undecided_of_set(doubt, self.centre.piece(iterate, extrema, k)))?;
        let centre = self.centre.bracket(iterate).ok_or_else(|| self.centre.unbracketed(iterate))?;
        Ok((all, centre))
    }

    #[cold]
    fn nothing(&self, why: NoProposal) -> Self::Answer {
        Err(unproposed(self.centre.flight, why))
    }
}

/// Takes the proposal without proof.
pub(super) struct Unproved<'a>(pub &'a Flight<f64>);

impl Unproved<'_> {
    #[inline(always)]
    fn arrive(&self, iterate: &Iterate, phase: f64, time: f64) -> Option<Contact<f64>> {
        let flight = self.0;
        let (velocity, _) = flight.arrive(iterate.velocity, (iterate.sin, iterate.cos), iterate.step);
        Some(Contact {
            wall: iterate.target.wall(flight.wall),
            turns: iterate.turns,
            phase,
            time,
            velocity: flight.wall.inward(velocity),
        })
    }
}

impl Verifier for Unproved<'_> {
    type Answer = Option<Contact<f64>>;

    #[inline(always)]
    fn monotone(&self, iterate: &Iterate) -> Self::Answer {
        let at = iterate.at - iterate.step;
        self.arrive(iterate, at, iterate.turns + (at - self.0.phase))
    }

    #[inline(always)]
    fn hop(&self, iterate: &Iterate, _: &SmallAngle) -> Self::Answer {
        let time = iterate.at - iterate.step;
        self.arrive(iterate, self.0.phase + time, time)
    }

    #[inline(always)]
    fn piece(&self, iterate: &Iterate, _: &Extrema, _: f64) -> Self::Answer {
        self.monotone(iterate)
    }

    #[inline(always)]
    fn nothing(&self, _: NoProposal) -> Self::Answer {
        None
    }
}

/// Undecided result of a flight without a proposed contact.
#[cold]
fn unproposed(flight: &Flight<f64>, none: NoProposal) -> Undecided {
    match none {
        NoProposal::Rest => Undecided::graze(Some(flight.wall)),
        NoProposal::NoDrift | NoProposal::TooLong => Undecided { lasting: false, ..Undecided::endless() },
    }
}

/// The wall of `target` may be touched with zero velocity, at any later time.
#[cold]
fn unbracketed(from: Wall, target: Target) -> Undecided {
    Undecided::graze(Some(target.wall(from)))
}

/// Undecided result of a bracketed contact before which another contact is not excluded.
#[cold]
fn doubted<const WIDE: bool>(bounds: Bounds<'_, WIDE>, doubt: Doubt, arrival: Arrival) -> Undecided {
    let flight = bounds.flight;
    let wall = match doubt {
        Doubt::SmallAngle => flight.wall,
        Doubt::Extremum { target } => target.wall(flight.wall),
        Doubt::Location => arrival.target.wall(flight.wall),
    };
    Undecided::graze(Some(wall))
}
