//! The first contact of flights under several harmonics, isolated from left to right: Lemmas H2-H6 of `docs/proofs/harmonics.md#H2`.
//!
//! A state and bounds of the third derivative prove a piece of time after it free of contacts; the next state is taken
//! where that proof ends. Pieces are as long as the motion is far from the walls, so their number grows with the number
//! of near approaches. Floating point only proposes: where to look for a contact and where for an extremum near a wall.

use super::flight::{Instant, Kinematics, SumFlight};
use super::harmonics::Rates;
use super::phased::{FlightNumber, magnitude};
use super::reach::Reach;
use super::view::Side;
use crate::contact::Undecided;
use crate::number::{Ball, UNIT, is_positive, up};
use crate::pair::Wall;
use crate::turns::LONGEST_FLIGHT;

/// The contact that is first for every flight of a set.
#[derive(Debug)]
pub(crate) struct Found<N> {
    pub wall: Wall,
    /// Time after the start within `reach` of which each flight touches the wall.
    pub at: Instant<N>,
    pub reach: f64,
    /// Lower bound of `|z'|` at the contact, for each flight.
    pub least: f64,
    /// Velocity and acceleration over the set and the times of contact.
    pub velocity: Ball,
    pub acceleration: Ball,
    /// Bound of the distance of the centre's contact from `at`.
    pub centre_reach: f64,
    /// Velocity of the centre's flight at `at`.
    pub centre_velocity: N,
}

/// The reason why no first contact is isolated.
#[derive(Debug)]
pub(crate) enum Doubt<N> {
    /// A wall may be touched with no velocity, about then; up to `free` it is proved not to be.
    Graze { wall: Wall, free: Instant<N>, at: Instant<N> },
    /// The direction of the departure is not certain.
    SmallAngle,
    /// The ball does not leave its wall.
    Rest,
    /// The flight is longer than is followed.
    Budget,
}

/// The result for an extremum near a wall.
#[derive(Debug)]
enum Valley<N> {
    /// The wall is not touched up to this time.
    Past(Instant<N>),
    /// The wall is touched before.
    Contact(Box<Found<N>>),
    /// The wall may be touched with no velocity.
    Graze { wall: Wall, bottom: Instant<N> },
    /// Nothing is proved of the extremum.
    Unclear,
}

/// Pieces in a row that are shorter than [`SHORT_PIECE`] times the flight so far.
const SHORT_PIECES: u32 = 256;
const SHORT_PIECE: f64 = 1.0 / (1 << 20) as f64; // exact: a power of two
/// Greatest number of steps of Newton's method.
const STEPS: u32 = 64;
const WALLS: [Wall; 2] = [Wall::Left, Wall::Right];

/// The search for the first contact of all the flights of a set.
pub(crate) struct Scan<'f, 'h, N: FlightNumber> {
    all: &'f SumFlight<'h, N>,
    centre: &'f SumFlight<'h, N>,
    rates: Rates,
    /// Time after the start, in forcing periods, up to which the rates hold.
    horizon: f64,
}

impl<'f, 'h, N: FlightNumber> Scan<'f, 'h, N> {
    /// The flights `all`, and the one that starts at their centre.
    pub fn new(all: &'f SumFlight<'h, N>, centre: &'f SumFlight<'h, N>) -> Self {
        Self { all, centre, rates: all.harmonics.rates, horizon: LONGEST_FLIGHT }
    }

    /// The first contact, proved; far ahead where `reach` shows that no wall can be near.
    pub fn first(&self, reach: &mut Reach<'_>) -> Result<Found<N>, Doubt<N>> {
        let soon = self.soon().and_then(|scan| scan.search(reach).ok());
        soon.map_or_else(|| self.search(reach), Ok)
    }

    /// The search for short flights only, where the acceleration hardly changes: on `[0, t]` the third derivative is at most `|j| + S_4 t`. `j`
    /// is the third derivative at the start, and may be far less than at other times.
    fn soon(&self) -> Option<Self> {
        let start = &self.all.launch;
        let sign = start.wall?.sign();
        let inward = |x: &N| x.clone().signed(sign).bounds();
        let [rate, bend, jerk] = [&start.velocity, &self.all.acceleration, &self.all.jerk].map(inward);
        // A few times as long as the bounce lasts, or as the contact force after a release may stay away.
        let horizon = match start.is_release {
            true => 8.0 * jerk.0 / self.rates.fourth,
            false => -8.0 * rate.0 / bend.1,
        };
        let third = up(jerk.0.abs().max(jerk.1.abs()) + up(self.rates.fourth * horizon)); // B2: the farther end
        let is_short = 0.0 < horizon
            && horizon < self.horizon
            && (start.is_release || bend.1 <= 0.0)
            && 4.0 * third < self.rates.third;
        is_short.then_some(Self { rates: Rates { third, ..self.rates }, horizon, ..*self })
    }

    /// The search as far as the rates hold.
    fn search(&self, reach: &mut Reach<'_>) -> Result<Found<N>, Doubt<N>> {
        let like = &self.all.launch.phase;
        let mut at = Instant::new(0.0, &like.centre_of());
        if self.all.launch.wall.is_some() {
            let departure = self.departure()?;
            at = at.later(&like.like(departure));
        }
        let mut short_pieces = 0;
        for _ in 0..like.pieces() {
            let state = self.all.state(&at);
            let sides = WALLS.map(|wall| state.side(wall));
            let touched = WALLS.into_iter().zip(&sides).find(|(_, side)| !is_positive(side.room.0));
            if let Some((wall, _)) = touched {
                return Err(Doubt::Graze { wall, free: at.clone(), at });
            }
            for (wall, side) in WALLS.into_iter().zip(&sides) {
                if let Some(found) = self.arrival(wall, side, &at) {
                    return self.in_time(found);
                }
            }
            let step = self.step(&at, &sides);
            // An extremum near a wall that ends the piece is examined.
            let valley = WALLS.into_iter().zip(&sides).find(|(_, side)| {
                let turning = side.turning();
                turning.is_some_and(|turning| step < turning && side.least_bend(&self.rates, 1.25 * turning) > 0.0)
            });
            let next = match valley.map(|(wall, side)| self.valley(wall, side, &at)) {
                Some(Valley::Past(bottom)) => bottom,
                Some(Valley::Contact(found)) => return self.in_time(*found),
                Some(Valley::Graze { wall, bottom }) => return Err(Doubt::Graze { wall, free: at, at: bottom }),
                Some(Valley::Unclear) | None => at.later(&like.like(step)),
            };
            let time = next.time().bounds();
            if time.1 > self.horizon {
                return Err(Doubt::Budget);
            }
            short_pieces = if next.since(&at) < SHORT_PIECE * time.1 { short_pieces + 1 } else { 0 };
            // Without a proved step ahead the scan would stand still.
            if !is_positive(-at.since(&next)) || short_pieces > SHORT_PIECES {
                let nearest = if sides[0].room.0 < sides[1].room.0 { Wall::Left } else { Wall::Right };
                return Err(Doubt::Graze { wall: nearest, free: at.clone(), at });
            }
            let ahead = if self.horizon < LONGEST_FLIGHT { None } else { reach.jump(self.all, time.0) };
            at = match ahead {
                Some(later) if later > LONGEST_FLIGHT => return Err(Doubt::Budget),
                Some(later) if later > time.1 + 0.5 => Instant::new(later, like),
                _ => next,
            };
        }
        Err(Doubt::Budget)
    }

    /// A contact, if the rates hold up to it.
    fn in_time(&self, found: Found<N>) -> Result<Found<N>, Doubt<N>> {
        let end = up(found.at.time().bounds().1 + found.reach);
        if end <= self.horizon { Ok(found) } else { Err(Doubt::Budget) }
    }

    /// Time after the start during which the ball is proved to be off its wall (Lemma H3).
    fn departure(&self) -> Result<f64, Doubt<N>> {
        let start = &self.all.launch;
        let sign = start.wall.map_or(1.0, Wall::sign);
        let inward = |x: &N| x.clone().signed(sign).bounds();
        let zero = (0.0, 0.0);
        let bend = if start.is_release { zero } else { inward(&self.all.acceleration) };
        let [rate, jerk] = [&start.velocity, &self.all.jerk].map(inward);
        let most = self.longest();
        // The height over its first power that does not vanish, a polynomial in the time and its remainder.
        let (first, second, rest) = match (rate, bend) {
            (rate, _) if rate.0 > 0.0 => (rate.0, 0.5 * bend.0, self.rates.third / 6.0),
            (rate, bend) if rate == zero && bend.0 > 0.0 => (0.5 * bend.0, -self.rates.third / 6.0, 0.0),
            (rate, bend) if rate == zero && bend == zero && jerk.0 > 0.0 => {
                (jerk.0 / 6.0, -self.rates.fourth / 24.0, 0.0)
            }
            (rate, bend) if rate == zero && bend.1 < 0.0 => return Err(Doubt::Rest),
            (rate, bend) if rate == zero && bend == zero && jerk.1 < 0.0 => return Err(Doubt::Rest),
            _ => return Err(Doubt::SmallAngle),
        };
        let far = Side { room: (1.0, 1.0), rate: (-rate.1, -rate.0), bend: (-bend.1, -bend.0) };
        let mut time = far.reach(&self.rates, most).min(self.horizon); // H3: any time up to the horizon
        if second < 0.0 {
            // Bounces may be as short as they like.
            time = time.min(-0.875 * first / second); // H3: any time; a NaN is passed over
        }
        for _ in 0..STEPS {
            let size = first + time * (second.abs() + time * rest);
            let least = first + time * (second - time * rest) - 16.0 * UNIT * size;
            if least > 0.0 && far.is_free(&self.rates, time) {
                // Short of where the height may be 0 again.
                return Ok(0.75 * time);
            }
            time *= 0.5;
        }
        Err(Doubt::SmallAngle)
    }

    /// Greatest length of a piece that can be proved free: beyond it the third derivative alone may cross the gap.
    fn longest(&self) -> f64 {
        (12.0 / self.rates.third).cbrt().min(self.horizon) // H2: any time up to the horizon
    }

    /// Time after `at` during which both walls are proved not to be touched (Lemma H2).
    fn step(&self, at: &Instant<N>, sides: &[Side; 2]) -> f64 {
        let most = self.longest();
        let mut step = sides[0].reach(&self.rates, most);
        step = sides[1].reach(&self.rates, step.max(0.0)); // H2: any time
        let like = &self.all.launch.phase;
        for _ in 0..STEPS {
            let time = at.later(&like.like(step)).since(at);
            if sides.iter().all(|side| side.is_free(&self.rates, time)) {
                return step;
            }
            step *= 0.7;
        }
        0.0
    }

    /// The contact with a wall that the ball is proved to approach all the way (Lemma H5).
    fn arrival(&self, wall: Wall, side: &Side, at: &Instant<N>) -> Option<Found<N>> {
        let ahead = side.arrival()?;
        if !side.approaches(&self.rates, 1.0625 * ahead) {
            return None;
        }
        let like = &self.all.launch.phase;
        let found = self.close_in(wall, at.later(&like.like(ahead)))?;
        let time = up(found.at.since(at) + found.reach);
        // Lemma H5 looks ahead only.
        (at.since(&found.at) < found.reach && side.approaches(&self.rates, time)).then_some(found)
    }

    /// Result for an extremum near a wall (Lemma H4).
    fn valley(&self, wall: Wall, side: &Side, at: &Instant<N>) -> Valley<N> {
        let like = &self.all.launch.phase;
        let Some(ahead) = side.turning() else { return Valley::Unclear };
        let bottom = self.bottom(at.later(&like.like(ahead)));
        let time = bottom.since(at);
        let lowest = self.all.state(&bottom).side(wall);
        // Convex from here to there.
        let bend = lowest.least_bend(&self.rates, time);
        if !(is_positive(bend) && at.since(&bottom) < 0.0) {
            return Valley::Unclear;
        }
        if lowest.stays_clear(bend) {
            return Valley::Past(bottom);
        }
        if !is_positive(-lowest.room.1) {
            return Valley::Graze { wall, bottom };
        }
        // The contact is on the way down.
        let state = self.centre.state(&bottom);
        let depth = state.room(wall).clone().signed(-1.0);
        let curve = state.acceleration.clone().signed(0.5 * wall.sign());
        let before = depth.ratio_to(&curve).map(|square| -square.root_of());
        let found = before.and_then(|before| self.close_in(wall, bottom.later(&before)));
        match found.filter(|found| self.is_on_the_way_down(wall, found, at)) {
            Some(found) => Valley::Contact(Box::new(found)),
            None => Valley::Graze { wall, bottom },
        }
    }

    /// Whether a contact comes after `at`, with a motion that is convex from there on and falls at its end.
    fn is_on_the_way_down(&self, wall: Wall, found: &Found<N>, at: &Instant<N>) -> bool {
        let arrival = self.all.state(&found.at).side(wall);
        let span = up(found.at.since(at) + found.reach);
        let is_falling = arrival.least_bend(&self.rates, span) > 0.0 && arrival.approaches(&self.rates, found.reach);
        is_falling && at.since(&found.at) < -found.reach
    }

    /// A zero of the velocity near a time, to the precision of the flight.
    pub fn bottom(&self, near: Instant<N>) -> Instant<N> {
        self.newton(near, |state| {
            let step = state.velocity.ratio_to(&state.acceleration)?;
            Some((step, is_noise(&state.velocity)))
        })
    }

    /// Newton's method on the flight of the centre: `step` gives the step back, and whether it is noise.
    fn newton(&self, near: Instant<N>, step: impl Fn(&Kinematics<N>) -> Option<(N, bool)>) -> Instant<N> {
        let (mut at, mut before) = (near, f64::INFINITY);
        for _ in 0..STEPS {
            let Some((back, is_done)) = step(&self.centre.state(&at)) else { return at };
            let size = magnitude(&back);
            if is_done || !is_positive(0.75 * before - size) {
                return at;
            }
            at = at.later(&-back);
            before = size;
        }
        at
    }

    /// Brackets the contact of all flights near a time: exactly one, on that wall (Lemma H5).
    fn close_in(&self, wall: Wall, near: Instant<N>) -> Option<Found<N>> {
        let at = self.newton(near, |state| {
            let room = state.room(wall);
            let newton = room.clone().signed(wall.sign()).ratio_to(&state.velocity)?;
            // The second order of Newton's step, in doubles.
            let (n, velocity, bend) = (low(&newton), low(&state.velocity), low(&state.acceleration));
            let factor = 0.5 * n * bend / velocity;
            let factor = if factor.abs() < 0.25 { factor } else { 0.0 };
            let back = newton.clone() + (newton.like(factor) * newton);
            Some((back.centre_of(), is_noise(room)))
        });
        let (all, centre) = (self.all.state(&at), self.centre.state(&at));
        let side = all.side(wall);
        let (reach, least) = self.bracket(&side)?;
        let error = magnitude(centre.room(wall));
        // The acceleration there, which may be far less than at other times.
        let bend = up(side.bend.0.abs().max(side.bend.1.abs()) + up(self.rates.third * reach)); // B2: the farther end
        Some(Found {
            wall,
            reach,
            least,
            velocity: ball(&all.velocity).widened(up(bend * reach)),
            acceleration: ball(&all.acceleration).widened(up(self.rates.third * reach)),
            centre_reach: up(error / least),
            centre_velocity: centre.velocity,
            at,
        })
    }

    /// Time around a state within which each flight touches the wall, and the least speed there.
    fn bracket(&self, side: &Side) -> Option<(f64, f64)> {
        let error = side.room.0.abs().max(side.room.1.abs()); // B2: the farther end
        let speed = -side.rate.1;
        let bend = side.bend.0.abs().max(side.bend.1.abs()); // B2: the farther end
        // Twice what the speed here makes of it.
        let widest = up(2.0 * error / speed);
        let least = (speed - up(up(bend + up(self.rates.third * widest)) * widest)).next_down();
        let reach = up(error / least);
        (least > 0.0 && reach <= widest).then_some((reach, least))
    }
}

/// Whether a number is as near to 0 as its arithmetic can distinguish.
fn is_noise<N: FlightNumber>(x: &N) -> bool {
    let (low, high) = x.bounds();
    low <= 0.0 && high >= 0.0
}

fn low<N: FlightNumber>(x: &N) -> f64 {
    x.bounds().0
}

impl<N: FlightNumber> Doubt<N> {
    /// The doubt as the orbit reports it.
    pub fn undecided(&self, start: Option<Wall>) -> Undecided {
        match self {
            Self::Graze { wall, .. } => Undecided::graze(Some(*wall)),
            Self::SmallAngle => Undecided::graze(start),
            Self::Rest => Undecided { lasting: true, ..Undecided::graze(start) },
            Self::Budget => Undecided::endless(),
        }
    }
}

/// Ball of doubles that holds all members.
fn ball<N: FlightNumber>(x: &N) -> Ball {
    let (low, high) = x.bounds();
    let middle = 0.5 * (low + high);
    Ball::new(middle, up((high - middle).max(middle - low))) // B2: the farther end; a NaN is in both
}
