//! The first contact by interval bisection and interval Newton, as a textbook would find it.
//!
//! The first root of (A.2), (A.4), (A.6) is looked for from the departure on, in pieces of the time axis. On each piece
//! the velocity (12) is enclosed, and with it the height (11). Then one of three things is known:
//!
//! - the ball stays between the walls, and the next piece begins where this one ends,
//! - the ball moves one way and ends beyond a wall, so there is one contact in the piece, and Newton's method finds it,
//! - neither, and the piece is halved.
//!
//! Nothing here is cleverer than that. The method is slow, and serves as a second verifier of [`super::first_contact`]. Lemma I3 of
//! `docs/proofs/intervals.md#I3`, same label.

use std::cmp::Ordering;

use inari::Interval;

use super::extrema::Target;
use super::{Contact, Undecided, Verdict};
use crate::flight::Flight;
use crate::number::inari::between;
use crate::number::{Enclosing, Number, Wave};
use crate::pair::Inward;

/// Length of the first piece, in forcing periods; later pieces are at least as long before they are halved.
const FIRST_PIECE: f64 = 0.125;
/// Length of the shortest piece: a wall that is still in doubt there is called grazed.
const MIN_PIECE: f64 = 1.0 / (1_u128 << 100) as f64; // exact: a power of two
/// Pieces that are looked at, halved ones included, before the flight is called too long.
const MAX_PIECES: usize = 10_000;
/// Newton steps: each shortens the bracket by a quarter at least.
const NEWTON_STEPS: usize = 1_000;

/// Encloses the first contact of a flight by interval bisection and interval Newton.
///
/// **Equation** (14), (A.2), (A.4), (A.6). **Enclosure**: for every flight with members of these intervals the first
/// contact is on that wall and in the intervals returned, it exists, and no wall is touched before (Lemma I3).
/// **Undecided when** a wall may be touched with zero velocity ([`Reason::Graze`](super::Reason::Graze); also where the intervals are too wide
/// to decide, or the ball may not leave), or after 10,000 pieces ([`Reason::Budget`](super::Reason::Budget)).
/// **Cost**: about forty times that of [`super::first_contact`], and more for longer flights.
///
/// ```
/// use impact_pair::contact::{Verdict, textbook::first_contact};
/// use impact_pair::flight::Flight;
/// use impact_pair::number::{Number, Wave};
/// use impact_pair::pair::{Reduced, Wall};
/// use inari::Interval;
/// // No shaking (A = 0): half a gap per forcing period crosses the gap in two forcing periods.
/// let [zero, half, one] = [0.0, 0.5, 1.0].map(Interval::from_f64);
/// let pair = Reduced { alpha: zero, beta: zero, restitution: one };
/// let flight = Flight::from_wall(&pair, Wall::Left, zero, half, zero.wave());
/// let Verdict::Certified(contact) = first_contact(&flight) else { unreachable!() };
/// assert_eq!(contact.wall, Wall::Right);
/// assert!(contact.time.contains(2.0) && contact.time.wid() < 1e-15);
/// ```
pub fn first_contact(flight: &Flight<Interval>) -> Verdict<Contact<Interval>> {
    let walk = Walk(flight);
    let (mut begin, mut length) = (0.0, FIRST_PIECE);
    for _ in 0..MAX_PIECES {
        let end = begin + length;
        if !(length >= MIN_PIECE && end > begin) {
            return Verdict::Undecided(walk.graze(begin));
        }
        match walk.piece(begin, end) {
            Piece::Inside => (begin, length) = (end, (2.0 * length).max(FIRST_PIECE)), // I3: any length
            Piece::Contact(target) => return Verdict::Certified(walk.contact(target, between(begin, end))),
            Piece::Open => length /= 2.0,
        }
    }
    Verdict::Undecided(Undecided::endless())
}

/// The result for a piece.
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

    /// Whether the height rises all through the piece: by its first derivative there that is not 0 (Lemma I3 (a)).
    fn rises(&self, piece: Interval, velocity: Interval) -> bool {
        let (flight, starts) = (self.0, |x: Interval| piece.contains(0.0) && x.inf() >= 0.0);
        if velocity.inf() > 0.0 || !starts(flight.velocity) {
            return velocity.inf() > 0.0;
        }
        let (sin, cos) = self.wave(piece);
        let jerk = flight.beta.turn() * flight.acceleration_at(cos);
        flight.acceleration_at(sin).inf() > 0.0 || starts(flight.acceleration_at(flight.sin)) && jerk.inf() > 0.0
    }

    /// Whether the flight starts on its wall, which it can leave by a rise only.
    fn is_on_wall(&self) -> bool {
        self.0.height.inf() <= 0.0
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
            if next.wid().partial_cmp(&(0.75 * time.wid())) != Some(Ordering::Less) {
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

    /// A wall may be touched with zero velocity, in the shortest piece from here on in which the ball may turn.
    fn graze(&self, begin: f64) -> Undecided {
        let (mut piece, mut length) = (between(begin, begin), FIRST_PIECE);
        while length >= MIN_PIECE && self.velocity(between(begin, begin + length)).contains(0.0) {
            (piece, length) = (between(begin, begin + length), length / 2.0);
        }
        let (low, high) = self.bounds(piece, self.velocity(piece));
        let wall = match (low > 0.0, high < 1.0) {
            (false, true) => Some(self.0.wall),
            (true, false) => Some(self.0.wall.other()),
            _ => None,
        };
        Undecided::graze(wall)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::Reason;
    use crate::contact::{Margins, Radii};
    use crate::number::{Ball, kernel};
    use crate::pair::{Reduced, Wall};
    use proptest::prelude::*;

    /// One flight in doubles, all of them exact: from a wall, or from inside at a height.
    #[derive(Clone, Copy, Debug)]
    struct Start {
        alpha: f64,
        wall: Wall,
        height: Option<f64>,
        phase: f64,
        velocity: f64,
    }

    impl Start {
        fn pair(&self) -> Reduced<Ball> {
            let alpha = Ball::exact(self.alpha);
            Reduced::new(alpha, Ball::exact(0.5))
        }

        /// All flights with phases and velocities within these radii.
        fn flight(&self, phase: f64, velocity: f64) -> Flight<Interval> {
            let pair = self.pair().map(|&x| Interval::from(x));
            let [phase, velocity] =
                [(self.phase, phase), (self.velocity, velocity)].map(|(x, r)| between(x - r, x + r));
            match self.height {
                None => Flight::from_wall(&pair, self.wall, phase, velocity, phase.wave()),
                Some(height) => Flight::from_inside(&pair, Interval::from_f64(height), phase, velocity, phase.wave()),
            }
        }

        /// Contact by the textbook method.
        fn contact(&self) -> Verdict<Contact<Interval>> {
            first_contact(&self.flight(0.0, 0.0))
        }

        /// Contact by the closed form.
        fn ours(&self) -> Verdict<Contact<Ball>> {
            let (pair, sin_cos) = (self.pair(), kernel::sin_cos(self.phase));
            let (flight, height) = match self.height {
                None => (Flight::from_wall(&pair.centre(), self.wall, self.phase, self.velocity, sin_cos), 0.0),
                Some(height) => {
                    (Flight::from_inside(&pair.centre(), height, self.phase, self.velocity, sin_cos), f64::EPSILON)
                }
            };
            super::super::first_contact(&flight, &Margins::new(&pair), Radii { height, ..Radii::default() })
        }
    }

    /// Starts on a wall: A/d over six decades, quarter periods among the phases, speeds down to a billionth of the box's, or 0.
    fn from_walls() -> impl Strategy<Value = Start> {
        let wall = prop_oneof![Just(Wall::Left), Just(Wall::Right)];
        let phase = prop_oneof![4 => -0.5..0.5f64, 1 => (-2..=2i32).prop_map(|k| f64::from(k) / 4.0)];
        let speed = prop_oneof![1 => Just(0.0), 4 => (-9.0..1.0f64).prop_map(|x| 10f64.powf(x))];
        ((-3.0..3.0f64).prop_map(|x| 10f64.powf(x)), wall, phase, speed).prop_map(|(alpha, wall, phase, speed)| Start {
            alpha,
            wall,
            height: None,
            phase,
            velocity: speed * alpha * std::f64::consts::TAU,
        })
    }

    /// Starts inside the gap whose height has its maximum at or near the far wall, at the phase `at`, `time` forcing periods later: the
    /// distance from a graze goes down to 0.
    fn towards_grazes() -> impl Strategy<Value = Start> {
        let miss = prop_oneof![
            Just(0.0),
            (-14.0..-2.0f64, any::<bool>()).prop_map(|(x, up)| if up { 10f64.powf(x) } else { -10f64.powf(x) })
        ];
        (-1.0..1.0f64, -0.49..-0.01f64, 0.01..0.3f64, miss).prop_filter_map("inside", |(log_alpha, at, time, miss)| {
            let alpha = 10f64.powf(log_alpha);
            let (turn, beta) = (std::f64::consts::TAU, std::f64::consts::TAU * alpha);
            let (phase, drift) = (at - time, beta * (turn * at).cos());
            let travel = drift * time - alpha * ((turn * at).sin() - (turn * phase).sin());
            let (height, velocity) = (1.0 - travel + miss, drift - beta * (turn * phase).cos());
            (0.0 < height && height < 1.0).then_some(Start {
                alpha,
                wall: Wall::Left,
                height: Some(height),
                phase,
                velocity,
            })
        })
    }

    /// Four times the cases of the environment or the default.
    fn config() -> ProptestConfig {
        let default = ProptestConfig::default();
        ProptestConfig { cases: 4 * default.cases, failure_persistence: None, ..default }
    }

    proptest! {
        #![proptest_config(config())]

        /// Two methods, one truth: where both decide they name the same wall, and their enclosures meet.
        #[test]
        fn the_closed_form_agrees(start in prop_oneof![2 => from_walls(), 1 => towards_grazes()]) {
            let (Verdict::Certified(one), Verdict::Certified(other)) = (start.contact(), start.ours()) else { return Ok(()) };
            prop_assert_eq!(one.wall, other.wall);
            let meet = |x: Interval, y: Ball| !x.disjoint(y.into());
            let phase = other.phase + Ball::exact(other.turns - one.turns);
            prop_assert!(meet(one.time, other.time) && meet(one.phase, phase) && meet(one.velocity, other.velocity), "{one:?} {other:?}");
            // No worse than a plain evaluation in doubles: a unit of what is added up, over the velocity.
            let noise = 1e-14 * (1.0 + start.alpha) * (1.0 + one.time.mag()) / one.velocity.mig();
            prop_assert!(one.time.wid() <= noise + 1e-14 * one.time.mag(), "{one:?} {noise:e}");
        }

        /// The contacts of a box hold those of its members.
        #[test]
        fn a_box_holds_its_members(start in from_walls(), size in -14.0..-3.0f64, at in prop::array::uniform2(-1.0..=1.0f64)) {
            let radii = [10f64.powf(size), 10f64.powf(size).min(start.velocity)];
            let Verdict::Certified(all) = first_contact(&start.flight(radii[0], radii[1])) else { return Ok(()) };
            let (phase, velocity) = (start.phase + at[0] * radii[0] / 2.0, start.velocity + at[1] * radii[1] / 2.0);
            let Verdict::Certified(one) = (Start { phase, velocity, ..start }).contact() else { return Ok(()) };
            prop_assert_eq!(all.wall, one.wall);
            let turns = Interval::from_f64(one.turns - all.turns);
            prop_assert!(!all.time.disjoint(one.time) && !all.velocity.disjoint(one.velocity) && !all.phase.disjoint(one.phase + turns));
        }
    }

    fn undecided(start: Start) -> Undecided {
        match start.contact() {
            Verdict::Undecided(undecided) => undecided,
            Verdict::Certified(contact) => panic!("{start:?}: {contact:?}"),
        }
    }

    #[test]
    fn most_flights_are_decided() {
        let starts = (0..1000).map(|i| {
            let (phase, speed) = (f64::from(i % 97) / 97.0 - 0.5, 0.01 + f64::from(i % 89) / 30.0);
            Start { alpha: 0.85, wall: Wall::Left, height: None, phase, velocity: speed * 5.3 }
        });
        assert_eq!(starts.filter(|start| start.contact().certified().is_none()).count(), 0);
    }

    /// The release of a ball at rest, at exactly `sin th0 = 0`, where velocity and acceleration are 0.
    #[test]
    fn a_released_ball_leaves() {
        for (wall, phase) in [(Wall::Left, 0.0), (Wall::Right, -0.5)] {
            let start = Start { alpha: 0.85, wall, height: None, phase, velocity: 0.0 };
            let (one, other) = (start.contact().certified().unwrap(), start.ours().certified().unwrap());
            assert_eq!((one.wall, one.wall), (other.wall, wall.other()));
            assert!(!one.time.disjoint(other.time.into()) && one.time.wid() < 1e-13);
        }
    }

    #[test]
    fn a_ball_with_contact_force_does_not_leave() {
        let start = Start { alpha: 0.85, wall: Wall::Left, height: None, phase: -0.25, velocity: 0.0 };
        let Undecided { reason, wall, .. } = undecided(start);
        assert_eq!((reason, wall), (Reason::Graze, Some(Wall::Left)));
        // One that would go through the wall has not left it.
        assert_eq!(undecided(Start { velocity: -1.0, ..start }).reason, Reason::Graze);
        // Just before the release and just after it: with a contact force, and without.
        assert_eq!(undecided(Start { phase: -1e-9, ..start }).reason, Reason::Graze);
        assert!(Start { phase: 1e-9, ..start }.contact().certified().is_some());
    }

    /// A box that swings by half a gap: a ball left behind at 1/4 touches the far wall half a forcing period later, with zero velocity.
    #[test]
    fn a_graze_is_named() {
        let start = Start { alpha: 0.5, wall: Wall::Left, height: None, phase: 0.25, velocity: 0.0 };
        let Undecided { reason, wall, .. } = undecided(start);
        assert_eq!((reason, wall), (Reason::Graze, Some(Wall::Right)));
    }

    #[test]
    fn a_flight_without_end_is_undecided() {
        // The drift is 1e-5 gap widths per forcing period.
        let velocity = 1e-5 - 0.3 * std::f64::consts::TAU;
        let start = Start { alpha: 0.3, wall: Wall::Left, height: Some(0.5), phase: 0.0, velocity };
        assert_eq!(undecided(start).reason, Reason::Budget);
    }
}
