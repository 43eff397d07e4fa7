//! The certified first contact of a flight, equations (14), (A.2), (A.4), (A.6).
//!
//! Floating point proposes ([`first_contact_f64`]), the enclosure disposes ([`first_contact`]): Newton in
//! plain doubles, then one bracket a few ulps wide on which the residual changes sign and the velocity does
//! not (existence and uniqueness), then the extrema before it are proved to stay inside the gap (nothing
//! earlier). The lemmas C1-C6 are in `docs/proofs.md`. No step allocates, and none depends on the length of
//! the flight.

mod bounds;
mod certify;
mod extrema;
mod solve;

pub use bounds::{Margins, Radii};

use bounds::Bounds;
use certify::{Arrival, Bracket, Doubt, around};
use extrema::{Extrema, Target};
use solve::{Iterate, Judge, NoProposal, propose};

use crate::flight::Flight;
use crate::number::kernel::Departure;
use crate::number::{Ball, Kernel, Number, Trigonometry, UNIT, up};
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
}

impl Bracket {
    /// The contact, out of the mirrored frame of its flight.
    #[inline(always)]
    fn contact(&self, flight: &Flight<f64>) -> Contact<Ball> {
        let Arrival { target, turns, phase, time } = self.arrival;
        let (wall, velocity) = (target.wall(flight.wall), flight.wall.inward(self.velocity));
        Contact { wall, turns, phase, time, velocity }
    }
}

/// Encloses the first contact of a flight.
///
/// **Equation** (14): the smallest `t > t_i` with `|y| = d/2`.
/// **Enclosure**: for every start within `radii` of the flight's, and all parameters of the pair that `margins`
/// was made for, the first contact is on the wall and inside the balls returned, it exists, and no wall is touched
/// between start and contact. The flight's parameters must be the centres of the pair's.
/// **Undecided when** the contact or an earlier extremum may be a graze, the departure's direction is not
/// certain, the drift may be 0, or the radii are too wide for one answer.
/// **Cost**: one floating solve and about a hundred operations; no allocation.
///
/// ```
/// use impact_pair::contact::{Margins, Radii, Verdict, first_contact};
/// use impact_pair::flight::Flight;
/// use impact_pair::number::{Ball, kernel::sin_cos};
/// use impact_pair::pair::{Reduced, Wall};
/// // No shaking (A = 0): half a gap a turn crosses the gap in two turns.
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

/// The enclosure disposes.
impl<const WIDE: bool> Judge for Bounds<'_, WIDE> {
    type Answer = Result<Bracket, Undecided>;

    #[inline(always)]
    fn monotone(&self, iterate: &Iterate) -> Self::Answer {
        let bracket = self.bracket(iterate).ok_or_else(|| unbracketed(self.flight.wall, iterate.target))?;
        self.is_monotone(&bracket.arrival).map_err(|doubt| doubted(*self, doubt, bracket.arrival))?;
        Ok(bracket)
    }

    #[inline(always)]
    fn hop(&self, iterate: &Iterate, departure: &Departure) -> Self::Answer {
        let bracket =
            self.hop_bracket(iterate, departure).ok_or_else(|| unbracketed(self.flight.wall, iterate.target))?;
        self.is_one_hop(&bracket).map_err(|doubt| doubted(*self, doubt, bracket.arrival))?;
        Ok(bracket)
    }

    #[inline(always)]
    fn piece(&self, iterate: &Iterate, extrema: &Extrema, k: f64) -> Self::Answer {
        let bracket = self.bracket(iterate).ok_or_else(|| unbracketed(self.flight.wall, iterate.target))?;
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
    /// Encloses `sin th1` over the set.
    pub sin: Ball,
    /// Encloses the phase on arrival of the flight from the centre.
    pub phase: Ball,
    /// Its velocity at the middle of that phase, but for the radius; elsewhere the slope times the distance is added.
    pub velocity: Ball,
    /// `dv/du` on arrival: the acceleration, over the bracket.
    pub slope: Ball,
}

/// Encloses the first contact of all the flights that start within the radii `all`, and more closely that of those
/// within `point`; both as [`first_contact`] does.
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
) -> Result<SetContact, Undecided> {
    let judges =
        Both { centre: Bounds::<false>::new(flight, margins, point), all: Bounds::<true>::new(flight, margins, all) };
    let (all, centre) = propose::<Kernel, _>(flight, &judges)?;
    let slope = Ball::turn() * Ball::new(flight.beta, margins.beta_radius(flight.beta)) * centre.sin;
    // The stored phase is rounded, the velocity is that before the rounding (Lemma S4).
    let rounding = UNIT * (2.0 * centre.arrival.phase.mid().abs() + centre.arrival.time.mid().abs());
    let rest = up(slope.mag().mul_add(rounding, centre.rest));
    Ok(SetContact {
        all: all.contact(flight),
        sin: flight.wall.inward(all.sin),
        phase: centre.arrival.phase,
        velocity: flight.wall.inward(Ball::new(centre.velocity.mid(), rest)),
        slope: flight.wall.inward(slope),
    })
}

/// Judges the flights of a set, and the one of its centre.
struct Both<'a> {
    centre: Bounds<'a, false>,
    all: Bounds<'a, true>,
}

impl Both<'_> {
    /// Whose fault an undecided set is.
    #[cold]
    fn blame(doubt: Undecided, centre: Result<Bracket, Undecided>) -> Undecided {
        match centre {
            Ok(_) => Undecided { reason: Reason::Width, ..doubt },
            Err(_) => doubt,
        }
    }
}

impl Judge for Both<'_> {
    type Answer = Result<(Bracket, Bracket), Undecided>;

    #[inline(always)]
    fn monotone(&self, iterate: &Iterate) -> Self::Answer {
        let all = self.all.monotone(iterate).map_err(|doubt| Self::blame(doubt, self.centre.monotone(iterate)))?;
        let centre =
            self.centre.bracket(iterate).ok_or_else(|| unbracketed(self.centre.flight.wall, iterate.target))?;
        Ok((all, centre))
    }

    #[inline(always)]
    fn hop(&self, iterate: &Iterate, departure: &Departure) -> Self::Answer {
        let all = self.all.hop(iterate, departure);
        let all = all.map_err(|doubt| Self::blame(doubt, self.centre.hop(iterate, departure)))?;
        let centre = self.centre.hop_bracket(iterate, departure);
        Ok((all, centre.ok_or_else(|| unbracketed(self.centre.flight.wall, iterate.target))?))
    }

    #[inline(always)]
    fn piece(&self, iterate: &Iterate, extrema: &Extrema, k: f64) -> Self::Answer {
        let all = self.all.piece(iterate, extrema, k);
        let all = all.map_err(|doubt| Self::blame(doubt, self.centre.piece(iterate, extrema, k)))?;
        let centre =
            self.centre.bracket(iterate).ok_or_else(|| unbracketed(self.centre.flight.wall, iterate.target))?;
        Ok((all, centre))
    }

    #[cold]
    fn nothing(&self, why: NoProposal) -> Self::Answer {
        Err(unproposed(self.centre.flight, why))
    }
}

/// The first contact of a flight in plain double precision: fast, and proved in no way.
///
/// `T` is [`Kernel`] or [`crate::number::Std`]. `None` when no contact is found.
#[inline]
pub fn first_contact_f64<T: Trigonometry>(flight: &Flight<f64>) -> Option<Contact<f64>> {
    propose::<T, _>(flight, &Unproved(flight))
}

/// Takes the proposal as it is.
struct Unproved<'a>(&'a Flight<f64>);

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

impl Judge for Unproved<'_> {
    type Answer = Option<Contact<f64>>;

    #[inline(always)]
    fn monotone(&self, iterate: &Iterate) -> Self::Answer {
        let at = iterate.at - iterate.step;
        self.arrive(iterate, at, iterate.turns + (at - self.0.phase))
    }

    #[inline(always)]
    fn hop(&self, iterate: &Iterate, _: &Departure) -> Self::Answer {
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

/// What it means that the solver found no contact.
#[cold]
fn unproposed(flight: &Flight<f64>, none: NoProposal) -> Undecided {
    match none {
        NoProposal::Rest => Undecided { reason: Reason::Graze, wall: Some(flight.wall), time: Some(Ball::exact(0.0)) },
        NoProposal::NoDrift | NoProposal::TooLong => Undecided { reason: Reason::Budget, wall: None, time: None },
    }
}

/// The proposed contact is too close to an extremum for its velocity's sign to be proved.
#[cold]
fn unbracketed(from: Wall, target: Target) -> Undecided {
    Undecided { reason: Reason::Graze, wall: Some(target.wall(from)), time: None }
}

/// What could not be excluded before a bracketed contact.
#[cold]
fn doubted<const WIDE: bool>(bounds: Bounds<'_, WIDE>, doubt: Doubt, arrival: Arrival) -> Undecided {
    let flight = bounds.flight;
    let (wall, time) = match doubt {
        Doubt::Departure => (flight.wall, Ball::exact(0.0)),
        Doubt::Extremum { target, time } => (target.wall(flight.wall), around(&bounds, time)),
        Doubt::Location => (arrival.target.wall(flight.wall), arrival.time),
    };
    Undecided { reason: Reason::Graze, wall: Some(wall), time: Some(time) }
}
