//! The first contact by interval bisection and interval Newton, as a textbook would find it.
//!
//! The first root of (A.2), (A.4), (A.6) is looked for from the departure on, in pieces of the time axis. On each piece
//! the velocity (12) is enclosed, and with it the height (11). Then one of three things is known:
//!
//! - the ball stays between the walls, and the next piece begins where this one ends,
//! - the ball moves one way and ends beyond a wall, so there is one contact in the piece, and Newton's method finds it,
//! - neither, and the piece is halved.
//!
//! Nothing here is cleverer than that: it is slow, and it is the second judge of [`super::first_contact`].
//!
//! **Lemma I3.** The contact returned is the first one of every flight with these intervals. *Proof.* The ball is
//! between the walls where a piece begins: there it started, or the piece before says so. Or it is on the wall that it
//! leaves; then the first piece is taken only if the height rises there, so it is above 0 for all later times of the
//! piece. (a) Where the velocity keeps its sign, the height lies between its values at both ends; there is no contact if it is inside at the
//! end, and if it is beyond the wall there is exactly one, by continuity, with velocity towards that wall. (b) Elsewhere
//! `z` lies in `z(m) + z' (T - m)` on the piece `T` around `m` (mean value theorem). (c) A height that rises from 0 on:
//! `z' > 0`; or `z' >= 0` at the departure and `z'' > 0` on the piece; or both are not negative there and `z''' > 0`. (d) Newton:
//! the root lies in `m - (z(m) - w)/z'(T)` by the mean value theorem, and on the side of `m` that the sign of `z(m) - w` tells. []

use inari::Interval;

use super::extrema::Target;
use super::{Contact, Reason, Undecided, Verdict};
use crate::flight::Flight;
use crate::number::interval::between;
use crate::number::{Enclosing, Number, Wave};

/// The first piece, in turns; later ones are at least as long before they are halved.
const PIECE: f64 = 0.125;
/// No piece is shorter: the wall is then called grazed.
const SHORTEST: f64 = 1.0 / (1_u128 << 100) as f64; // exact: a power of two
/// Pieces that are looked at, halved ones included, before the flight is called too long.
const PIECES: usize = 10_000;
/// Newton steps: each shortens the bracket by a quarter at least.
const NEWTON_STEPS: usize = 1_000;

/// Encloses the first contact of a flight by interval bisection and interval Newton.
///
/// **Equation** (14), (A.2), (A.4), (A.6). **Enclosure**: for every flight with members of these intervals the first
/// contact is on that wall and in the intervals returned, it exists, and no wall is touched before (Lemma I3).
/// **Undecided when** a wall may be touched with no velocity ([`Reason::Graze`]; also where the intervals are too wide for
/// one answer, or the ball may not leave), or after 10,000 pieces ([`Reason::Budget`]).
/// **Cost**: about a hundred times that of [`super::first_contact`], and more for longer flights.
///
/// ```
/// use impact_pair::contact::{Verdict, textbook::first_contact};
/// use impact_pair::flight::Flight;
/// use impact_pair::number::{Number, Wave};
/// use impact_pair::pair::{Reduced, Wall};
/// use inari::Interval;
/// // No shaking (A = 0): half a gap a turn crosses the gap in two turns.
/// let [zero, half, one] = [0.0, 0.5, 1.0].map(Interval::from_f64);
/// let pair = Reduced { alpha: zero, beta: zero, restitution: one };
/// let flight = Flight::from_wall(&pair, Wall::Left, zero, half, zero.wave());
/// let Verdict::Certified(contact) = first_contact(&flight) else { unreachable!() };
/// assert_eq!(contact.wall, Wall::Right);
/// assert!(contact.time.contains(2.0) && contact.time.wid() < 1e-15);
/// ```
pub fn first_contact(flight: &Flight<Interval>) -> Verdict<Contact<Interval>> {
    let walk = Walk(flight);
    let (mut begin, mut length) = (0.0, PIECE);
    for _ in 0..PIECES {
        let end = begin + length;
        if !(length >= SHORTEST && end > begin) {
            return Verdict::Undecided(walk.graze(begin));
        }
        match walk.piece(begin, end) {
            Piece::Inside => (begin, length) = (end, (2.0 * length).max(PIECE)), // I3: any length
            Piece::Contact(target) => return Verdict::Certified(walk.contact(target, between(begin, end))),
            Piece::Open => length /= 2.0,
        }
    }
    Verdict::Undecided(Undecided::endless())
}

/// What is known of a piece.
enum Piece {
    /// No wall is touched in it, but for the departure.
    Inside,
    /// Exactly one contact lies in it, with this wall.
    Contact(Target),
    /// Neither is proved.
    Open,
}

/// A flight as functions of the time since its start, in the flight's mirrored frame.
struct Walk<'a>(&'a Flight<Interval>);

impl Walk<'_> {
    /// Sine and cosine.
    fn wave(&self, time: Interval) -> (Interval, Interval) {
        self.0.wall.mirror((self.0.phase + time).wave())
    }

    /// `z` at a time; at short ones without cancellation. **Equation** (11)
    fn height(&self, time: f64) -> Interval {
        let (flight, time) = (self.0, between(time, time));
        match time.short() {
            Some(departure) => flight.height + flight.hop_height(time, departure.versine, departure.excess),
            None => flight.height_above(Interval::from_f64(0.0), time, flight.phase, self.wave(time).0),
        }
    }

    /// `z'`. **Equation** (12)
    fn velocity(&self, time: Interval) -> Interval {
        match time.short() {
            Some(departure) => self.0.hop_velocity(departure.versine, departure.sine),
            None => self.0.velocity_at(self.wave(time).1),
        }
    }

    /// Whether the height rises all through the piece (Lemma I3, (c)).
    fn rises(&self, piece: Interval, velocity: Interval) -> bool {
        let flight = self.0;
        let (sin, cos) = self.wave(piece);
        let acceleration = flight.acceleration_at(sin);
        let jerk = flight.beta.turn() * flight.acceleration_at(cos);
        let starts = |x: Interval| piece.contains(0.0) && x.inf() >= 0.0;
        velocity.inf() > 0.0
            || starts(flight.velocity)
                && (acceleration.inf() > 0.0 || starts(flight.acceleration_at(flight.sin)) && jerk.inf() > 0.0)
    }

    /// Whether the flight starts on its wall, which nothing but a rise takes it off.
    fn is_on_wall(&self) -> bool {
        !(self.0.height.inf() > 0.0)
    }

    fn piece(&self, begin: f64, end: f64) -> Piece {
        let piece = between(begin, end);
        let velocity = self.velocity(piece);
        let target = if self.rises(piece, velocity) {
            Target::Far
        } else if velocity.sup() < 0.0 && (begin > 0.0 || !self.is_on_wall()) {
            Target::Near
        } else {
            let (low, high) = self.bounds(piece, velocity);
            return if low > 0.0 && high < 1.0 { Piece::Inside } else { Piece::Open };
        };
        // (A.2), (A.4), (A.6): how far beyond the wall the ball would be.
        let beyond = (self.height(end) - Interval::from_f64(target.height())).signed(target.direction());
        match (beyond.sup() < 0.0, beyond.inf() > 0.0) {
            (true, _) => Piece::Inside,
            (_, true) => Piece::Contact(target),
            _ => Piece::Open,
        }
    }

    /// Bounds of `z` over the piece, in the mean value form.
    fn bounds(&self, piece: Interval, velocity: Interval) -> (f64, f64) {
        let height = self.height(piece.mid()) + velocity * (piece - piece.centre());
        (height.inf(), height.sup())
    }

    /// The contact in a piece that holds one, by interval Newton, and by bisection where that does not help.
    fn contact(&self, target: Target, mut time: Interval) -> Contact<Interval> {
        for _ in 0..NEWTON_STEPS {
            let middle = time.centre();
            let excess = self.height(time.mid()) - Interval::from_f64(target.height());
            let beyond = excess.signed(target.direction());
            let mut next = time;
            if beyond.inf() > 0.0 {
                next = between(time.inf(), time.mid());
            } else if beyond.sup() < 0.0 {
                next = between(time.mid(), time.sup());
            }
            if let Some(step) = excess.checked_div(self.velocity(time)) {
                next = next.intersection(middle - step);
            }
            if !(next.wid() < 0.75 * time.wid()) {
                break;
            }
            time = next;
        }
        let flight = self.0;
        let phase = flight.phase + time;
        let turns = phase.mid().round(); // exact: any whole number is taken off
        Contact {
            wall: target.wall(flight.wall),
            turns,
            phase: phase - Interval::from_f64(turns),
            time,
            velocity: flight.wall.inward(self.velocity(time)),
        }
    }

    /// A wall may be touched with no velocity, in the shortest piece from here on in which the ball may turn.
    fn graze(&self, begin: f64) -> Undecided {
        let (mut piece, mut length) = (between(begin, begin), PIECE);
        while length >= SHORTEST && self.velocity(between(begin, begin + length)).contains(0.0) {
            (piece, length) = (between(begin, begin + length), length / 2.0);
        }
        let (low, high) = self.bounds(piece, self.velocity(piece));
        let wall = match (low > 0.0, high < 1.0) {
            (false, true) => Some(self.0.wall),
            (true, false) => Some(self.0.wall.other()),
            _ => None,
        };
        Undecided { reason: Reason::Graze, wall, time: Some(piece.as_ball()), lasting: false }
    }
}
