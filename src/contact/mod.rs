//! The certified first contact of a flight, equations (14), (A.2), (A.4), (A.6).
//!
//! Floating point proposes ([`first_contact_f64`]), the enclosure disposes ([`first_contact`]): Newton in
//! plain doubles, then one bracket a few ulps wide on which the residual changes sign and the velocity does
//! not (existence and uniqueness), then the extrema before it are proved to stay inside the gap (nothing
//! earlier). The lemmas C1-C6 are in `docs/proofs.md`. No step allocates, and none depends on the length of
//! the flight.

mod certify;
mod extrema;
mod solve;

pub use certify::Radii;
pub(crate) use certify::{Arrival, Doubt, bracket, is_first};
pub(crate) use extrema::Target;
pub(crate) use solve::{NoProposal, Proposal, propose};

use crate::flight::Flight;
use crate::number::{Ball, Kernel, Trigonometry};
use crate::pair::Wall;

/// A three-valued answer: proved, or not, and then why.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict<T> {
    /// Proved.
    Certified(T),
    /// Not decided in this arithmetic.
    Undecided(Undecided),
}

impl<T> Verdict<T> {
    /// What was proved, if it was.
    pub fn certified(self) -> Option<T> {
        match self {
            Self::Certified(value) => Some(value),
            Self::Undecided(_) => None,
        }
    }
}

/// Why a question stayed open.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reason {
    /// A wall may be touched with no velocity: a graze, or a ball that comes to rest.
    Graze,
    /// The set of states has become too wide for one answer.
    Width,
    /// The width asked for is beyond this arithmetic.
    Precision,
    /// The flight is longer than the solver follows, or has no end that it can prove.
    Budget,
}

impl Reason {
    /// The word of the orbit JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Graze => "graze",
            Self::Width => "width",
            Self::Precision => "precision",
            Self::Budget => "budget",
        }
    }
}

/// A question that stayed open, with the best enclosure of where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Undecided {
    /// Why.
    pub reason: Reason,
    /// The wall that may be touched, when it is one.
    pub wall: Option<Wall>,
    /// When it may be touched, in turns after the start of the flight; `None` for any later time.
    pub time: Option<Ball>,
}

/// A first contact; times in turns, velocities in gaps a turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact<N> {
    /// The wall that is touched.
    pub wall: Wall,
    /// Whole turns between the phase of the start and [`Contact::phase`].
    pub turns: f64,
    /// The phase on arrival, less the whole turns.
    pub phase: N,
    /// `h`: the time since the start.
    pub time: N,
    /// The relative velocity `y'` just before the impact.
    pub velocity: N,
    /// `sin th1` on arrival.
    pub sin: N,
}

impl Arrival {
    /// The wall of an arrival.
    pub(crate) fn wall(&self, flight: &Flight<f64>) -> Wall {
        wall_of(flight, self.target)
    }

    /// The arrival out of the mirrored frame of its flight.
    #[inline(always)]
    pub(crate) fn contact(&self, flight: &Flight<f64>) -> Contact<Ball> {
        Contact {
            wall: self.wall(flight),
            turns: self.turns,
            phase: self.phase,
            time: self.time,
            velocity: flight.wall.inward(self.velocity),
            sin: flight.wall.inward(self.sin),
        }
    }
}

#[inline(always)]
fn wall_of(flight: &Flight<f64>, target: Target) -> Wall {
    match target {
        Target::Near => flight.wall,
        Target::Far => flight.wall.other(),
    }
}

/// Encloses the first contact of a flight.
///
/// **Equation** (14): the smallest `t > t_i` with `|y| = d/2`.
/// **Enclosure**: for every start and all parameters within `radii` of the flight's doubles, the first contact
/// is on the wall and inside the balls returned, it exists, and no wall is touched between start and contact.
/// **Undecided when** the contact or an earlier extremum may be a graze, the departure's direction is not
/// certain, the drift may be 0, or the radii are too wide for one answer.
/// **Cost**: one floating solve and about forty operations; no allocation.
///
/// ```
/// use impact_pair::contact::{Radii, Verdict, first_contact};
/// use impact_pair::flight::Flight;
/// use impact_pair::number::kernel::sin_cos;
/// use impact_pair::pair::{Reduced, Wall};
/// // No shaking (A = 0): half a gap a turn crosses the gap in two turns.
/// let pair = Reduced { alpha: 0.0, beta: 0.0, restitution: 1.0 };
/// let flight = Flight::from_wall(&pair, Wall::Left, 0.0, 0.5, sin_cos(0.0));
/// let Verdict::Certified(contact) = first_contact(&flight, Radii::default()) else { unreachable!() };
/// assert_eq!(contact.wall, Wall::Right);
/// assert!((contact.time.mid() - 2.0).abs() <= contact.time.rad());
/// ```
#[inline]
pub fn first_contact(flight: &Flight<f64>, radii: Radii) -> Verdict<Contact<Ball>> {
    let proposal = match propose::<Kernel>(flight) {
        Ok(proposal) => proposal,
        Err(none) => return Verdict::Undecided(unproposed(flight, none)),
    };
    let Some(arrival) = bracket(flight, &proposal, radii) else {
        return Verdict::Undecided(unbracketed(flight, &proposal));
    };
    match is_first(flight, &proposal, &arrival, radii) {
        Ok(()) => Verdict::Certified(arrival.contact(flight)),
        Err(doubt) => Verdict::Undecided(doubted(flight, doubt, &arrival)),
    }
}

/// The first contact of a flight in plain double precision: fast, and proved in no way.
///
/// `T` is [`Kernel`] or [`crate::number::Std`]. `None` when no contact is found.
#[inline]
pub fn first_contact_f64<T: Trigonometry>(flight: &Flight<f64>) -> Option<Contact<f64>> {
    let proposal = propose::<T>(flight).ok()?;
    let iterate = &proposal.iterate;
    let step = iterate.residual / iterate.velocity;
    let at = iterate.at - step;
    let (phase, time) = match proposal.course {
        solve::Course::Hop => (flight.phase + at, at),
        _ => (at, iterate.turns + (at - flight.phase)),
    };
    let velocity = (-flight.acceleration_at(iterate.sin)).mul_add(step, iterate.velocity);
    Some(Contact {
        wall: wall_of(flight, proposal.target),
        turns: iterate.turns,
        phase,
        time,
        velocity: flight.wall.inward(velocity),
        sin: flight.wall.inward(iterate.sin),
    })
}

/// What it means that the solver found no contact.
#[cold]
pub(crate) fn unproposed(flight: &Flight<f64>, none: NoProposal) -> Undecided {
    match none {
        NoProposal::Rest => Undecided { reason: Reason::Graze, wall: Some(flight.wall), time: Some(Ball::exact(0.0)) },
        NoProposal::NoDrift | NoProposal::TooLong => Undecided { reason: Reason::Budget, wall: None, time: None },
    }
}

/// The proposed contact is too close to an extremum for its velocity's sign to be proved.
#[cold]
pub(crate) fn unbracketed(flight: &Flight<f64>, proposal: &Proposal) -> Undecided {
    Undecided { reason: Reason::Graze, wall: Some(wall_of(flight, proposal.target)), time: None }
}

/// What could not be excluded before a bracketed contact.
#[cold]
pub(crate) fn doubted(flight: &Flight<f64>, doubt: Doubt, arrival: &Arrival) -> Undecided {
    let (wall, time) = match doubt {
        Doubt::Departure => (Some(flight.wall), Some(Ball::exact(0.0))),
        // A label, wide enough for the coarse critical phase: the ball may touch around this time.
        Doubt::Extremum { target, time } => (Some(wall_of(flight, target)), Some(Ball::new(time, 1e-7))),
        Doubt::Location => (Some(arrival.wall(flight)), Some(arrival.time)),
    };
    Undecided { reason: Reason::Graze, wall, time }
}
