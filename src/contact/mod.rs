//! The certified first contact of a flight, equations (14), (A.2), (A.4), (A.6).
//!
//! Floating point proposes ([`first_contact_f64`]), the enclosure disposes ([`first_contact`]): Newton in
//! plain doubles, then one bracket a few ulps wide on which the residual changes sign and the velocity does
//! not (existence and uniqueness), then the extrema before it are proved to stay inside the gap (nothing
//! earlier). The lemmas C1-C6 are in `docs/proofs/flights.md#C1`. No step allocates, and none depends on the length of
//! the flight. `textbook` answers the same question by plain interval arithmetic, in a build with the feature `inari`.

mod bounds;
mod certify;
mod extrema;
mod judges;
mod lanes;
pub(crate) mod multiprecision;
mod solve;
#[cfg(test)]
mod tests;
#[cfg(all(feature = "inari", target_feature = "fma"))]
pub mod textbook;

pub use bounds::{Margins, Radii};
pub use impact_pair_model::vocabulary::Reason;
pub(crate) use judges::{SetContact, accelerations, first_contacts};
pub use lanes::{Image, first_contacts_of, image_of, images_of};

use bounds::Bounds;
use judges::Unproved;
use solve::{is_phase, propose};

use crate::exact::Enclosure;
use crate::flight::Flight;
use crate::number::{Ball, Kernel, Trigonometry};
use crate::pair::{Reduced, Wall};

/// A three-valued answer: proved, or not, and then why.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict<T> {
    /// Proved.
    Certified(T),
    /// Not decided in this arithmetic.
    Undecided(Undecided),
}

impl<T> Verdict<T> {
    /// The proved value; `None` if undecided.
    pub fn certified(self) -> Option<T> {
        match self {
            Self::Certified(value) => Some(value),
            Self::Undecided(_) => None,
        }
    }
}

/// An undecided question, with the best enclosure of the contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Undecided {
    /// The reason.
    pub reason: Reason,
    /// Wall that may be touched, if the question is about one.
    pub wall: Option<Wall>,
    /// Encloses the first contact, in forcing periods after the start of the flight, where it is proved but not narrowly enough.
    pub contact: Option<Ball>,
    /// No precision will decide it.
    pub(crate) lasting: bool,
}

impl Undecided {
    /// A wall may be touched with zero velocity: this one, if it is known.
    pub(crate) fn graze(wall: Option<Wall>) -> Self {
        Self { reason: Reason::Graze, wall, contact: None, lasting: false }
    }

    /// The ball sticks to its wall, by the contact force: there is no flight, or none is proved to begin.
    pub(crate) fn rest(wall: Wall) -> Self {
        Self { lasting: true, ..Self::graze(Some(wall)) }
    }

    /// The motion lasts longer than is followed, in any precision.
    pub(crate) fn endless() -> Self {
        Self { reason: Reason::Budget, wall: None, contact: None, lasting: true }
    }

    /// The set that arrives at `contact` is too wide.
    pub(crate) fn width(contact: &Contact<Ball>) -> Self {
        Self { reason: Reason::Width, wall: Some(contact.wall), contact: Some(contact.time), lasting: false }
    }

    /// More digits are requested than those of `contact`.
    pub(crate) fn precision(contact: &Contact<Ball>) -> Self {
        Self { reason: Reason::Precision, ..Self::width(contact) }
    }
}

/// A first contact; times in forcing periods, velocities in gap widths per forcing period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact<N> {
    /// The wall that is touched.
    pub wall: Wall,
    /// Whole forcing periods between the phase of the start and [`Contact::phase`].
    pub turns: f64,
    /// Phase on arrival, less the whole forcing periods.
    pub phase: N,
    /// `h`: the time since the start.
    pub time: N,
    /// The relative velocity `y'` just before the impact.
    pub velocity: N,
}

/// A contact that may be a graze, passed into the gap; times in forcing periods, heights in gaps, in doubles.
#[derive(Debug)]
pub(crate) struct Grazed {
    /// The wall that may have been touched.
    pub wall: Wall,
    /// The time of the touch since the phase of the start: whole forcing periods, and the rest as a ball and as an interval.
    pub touch: (f64, Ball, Enclosure),
    /// Whole forcing periods from the phase of the start to the state to go on from.
    pub turns: f64,
    /// Encloses the rest of its phase.
    pub phase: Ball,
    /// Height above the left wall and velocity there, of both continuations.
    pub height: Ball,
    /// See `height`.
    pub velocity: Ball,
    /// Distance by which the wall is missed at the extremum; 0 is one of the values.
    pub distance: Enclosure,
    /// Upper bound of the acceleration.
    pub acceleration: f64,
}

/// A pair as the certificates of first contacts want it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairBounds {
    pub pair: Reduced<Ball>,
    pub centre: Reduced<f64>,
    pub margins: Margins,
}

impl PairBounds {
    pub fn new(pair: Reduced<Ball>) -> Self {
        Self { pair, centre: pair.centre(), margins: Margins::new(&pair) }
    }
}

/// Encloses the first contact of a flight.
///
/// **Equation** (14): the smallest `t > t_i` with `|y| = d/2`.
/// **Enclosure**: for every start within `radii` of the flight's, and all parameters of the pair that `margins`
/// was made for, the first contact is on the wall and inside the balls returned, it exists, and no wall is touched
/// between start and contact. The flight's parameters must be the centres of the pair's.
/// **Undecided when** the contact or an earlier extremum may be a graze, the departure's direction is not
/// certain, the drift may be 0, the phase is not within 2 forcing periods of 0, or the radii are too wide to decide.
/// **Cost**: one floating solve and about a hundred operations; no allocation.
///
/// ```
/// use impact_pair::contact::{Margins, Radii, Verdict, first_contact};
/// use impact_pair::flight::Flight;
/// use impact_pair::number::{Ball, kernel::sin_cos};
/// use impact_pair::pair::{Reduced, Wall};
/// // No shaking (A = 0): half a gap per forcing period crosses the gap in two forcing periods.
/// let (zero, one) = (Ball::exact(0.0), Ball::exact(1.0));
/// let pair = Reduced { alpha: zero, beta: zero, restitution: one };
/// let flight = Flight::from_wall(&pair.centre(), Wall::Left, 0.0, 0.5, sin_cos(0.0));
/// let Verdict::Certified(contact) = first_contact(&flight, &Margins::new(&pair), Radii::default()) else {
///     unreachable!()
/// };
/// assert_eq!(contact.wall, Wall::Right);
/// assert!((contact.time.mid() - 2.0).abs() <= contact.time.rad());
/// ```
#[inline]
pub fn first_contact(flight: &Flight<f64>, margins: &Margins, radii: Radii) -> Verdict<Contact<Ball>> {
    if !is_phase(flight.phase) {
        return Verdict::Undecided(Undecided::endless());
    }
    // exact: one phase for all starts
    let verdict = if radii.phase == 0.0 {
        propose::<Kernel, _>(flight, &Bounds::<false>::new(flight, margins, radii))
    } else {
        propose::<Kernel, _>(flight, &Bounds::<true>::new(flight, margins, radii))
    };
    match verdict {
        Ok(bracket) => Verdict::Certified(bracket.contact(flight)),
        Err(undecided) => Verdict::Undecided(undecided),
    }
}

/// Approximates the first contact of a flight in plain double precision: fast, without proof.
///
/// `T` is [`Kernel`] or [`crate::number::Std`]. `None` when no contact is found.
#[inline]
pub fn first_contact_f64<T: Trigonometry>(flight: &Flight<f64>) -> Option<Contact<f64>> {
    propose::<T, _>(flight, &Unproved(flight)).filter(|contact| contact.phase.is_finite())
}
