//! The time until which a flight whose first contact is undecided is proved to touch no wall.
//!
//! Rests on Lemma C7 of `docs/proofs/flights.md#C7`. It runs once, where an orbit ends undecided, in doubles and from the last state
//! alone, whatever arithmetic came to the doubt, and which question it could not answer.

use super::Shaken;
use crate::flight::Launch;
use crate::number::{Ball, Number, is_positive, up};
use crate::pair::{Inward, Wall};
use crate::several::FlightNumber;
use crate::turns::{self, LONGEST_FLIGHT};

/// Longest and shortest step, in forcing periods.
const MAX_STEP: f64 = 0.0625;
const MIN_STEP: f64 = 1.0 / (1_u64 << 50) as f64; // exact: a power of two
/// Greatest number of steps.
const STEPS: u32 = 1 << 14;
/// A step is halved until the height varies by less than this part of the distance from the walls: so that jumps are long.
const VARIATION_PART: f64 = 0.25;
/// Far more than the rounding of the lengths of all steps.
const LENGTH_MARGIN: f64 = 1.0 / (1_u64 << 30) as f64; // exact: a power of two

/// A time since the start of a flight, in forcing periods.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Since {
    /// Whole forcing periods, ...
    pub whole: f64,
    /// ... and the rest, from 0 to 1.
    pub rest: f64,
}

impl Since {
    const START: Self = Self { whole: 0.0, rest: 0.0 };

    /// The time with its rest reduced below 1.
    fn carried(self) -> Self {
        let over = self.rest.floor(); // exact: whole forcing periods are moved to their count
        Self { whole: self.whole + over, rest: self.rest - over } // N1: exact below 2^52
    }
}

/// Time, since the start, before which no flight of the set touches a wall after its start. Lemma C7
pub(crate) fn clear<S: Shaken + ?Sized>(shaken: &S, launch: &Launch<Ball>) -> Since {
    let flights = Flights::new(shaken, launch);
    let (mut at, mut step, mut seen) = (flights.departed(), MAX_STEP, LeastDistances::default());
    for _ in 0..STEPS {
        let next = at.rest + step;
        match flights.distances(at.whole, [at.rest, next]) {
            Some(distances) => {
                seen.add(distances, next - at.rest);
                (at, step) = (Since { rest: next, ..at }.carried(), MAX_STEP.min(2.0 * step)); // C7: any step
                at.whole += flights.repeated(&mut seen, at);
            }
            None if step > MIN_STEP => step *= 0.5,
            None => break,
        }
        if at.whole >= LONGEST_FLIGHT {
            break;
        }
    }
    at
}

/// Least distances from the left and the right wall over the last times, and the length of these times.
#[derive(Clone, Copy, Debug)]
struct LeastDistances {
    distances: [f64; 2],
    length: f64,
}

impl Default for LeastDistances {
    fn default() -> Self {
        Self { distances: [f64::INFINITY; 2], length: 0.0 }
    }
}

impl LeastDistances {
    fn add(&mut self, distances: [f64; 2], length: f64) {
        for (least, distance) in self.distances.iter_mut().zip(distances) {
            *least = least.min(distance); // C7: the least
        }
        self.length += length * (1.0 - LENGTH_MARGIN); // C7: less than it is
    }
}

/// The flights of a set: `z = base + drift h - E(h)` above the left wall.
struct Flights<'s, S: ?Sized> {
    shaken: &'s S,
    launch: &'s Launch<Ball>,
    base: Ball,
    drift: Ball,
    /// An upper bound of `|y''|` at all times.
    bend: f64,
}

impl<'s, S: Shaken + ?Sized> Flights<'s, S> {
    fn new(shaken: &'s S, launch: &'s Launch<Ball>) -> Self {
        let [shift, speed, _] = shaken.displacement(launch.turns, launch.phase);
        let height = match launch.wall {
            Some(Wall::Right) => Ball::exact(1.0),
            Some(Wall::Left) => Ball::exact(0.0),
            None => launch.height,
        };
        Self { shaken, launch, base: height + shift, drift: launch.velocity + speed, bend: shaken.steepest() }
    }

    /// A time up to which flights that leave a wall are away from both; the start itself where that is not certain. Lemma C7 (a)
    fn departed(&self) -> Since {
        let Some(wall) = self.launch.wall else { return Since::START };
        let (least, most) = wall.inward(self.launch.velocity).bounds();
        let rest = (least / self.bend).min(0.25 / most).min(0.5 / self.bend.sqrt()); // C7: about the least of three, ...
        let rest = (rest * (1.0 - VARIATION_PART)).min(LONGEST_FLIGHT); // C7: ... and less
        if is_positive(least) && is_positive(rest) { Since { whole: 0.0, rest }.carried() } else { Since::START }
    }

    /// Lower bounds of the distances from the walls between two times, where both are positive. Lemma C7 (b)
    fn distances(&self, whole: f64, [from, to]: [f64; 2]) -> Option<[f64; 2]> {
        let middle = 0.5 * (from + to);
        let reach = up((to - middle).max(middle - from)); // C7: the farther end
        let turns = turns::after(self.launch.turns, whole)?;
        let [shift, speed, _] = self.shaken.displacement(turns, self.launch.phase + Ball::exact(middle));
        let time = Ball::exact(whole) + Ball::exact(middle);
        let (low, high) = (self.drift.mul_add(time, self.base) - shift).bounds();
        let spread = up(reach * up((self.drift - speed).mag() + up(0.5 * self.bend * reach)));
        let heights = [low, (1.0 - high).next_down()];
        // A NaN is not below.
        let is_fine = heights.iter().all(|distance| spread < VARIATION_PART * distance);
        is_fine.then(|| heights.map(|distance| (distance - spread).next_down())) // C7: rounded down
    }

    /// Whole forcing periods for which the flights repeat the distances seen, moved by the drift, without touching a wall. Lemma C7 (c), (d)
    fn repeated(&self, seen: &mut LeastDistances, at: Since) -> f64 {
        let (distances, period) = match self.shaken.period() {
            Some(period) if seen.length >= f64::from(period) => (seen.distances, f64::from(period)),
            Some(_) => return 0.0,
            None => {
                let time = Ball::exact(at.whole) + Ball::exact(at.rest);
                let reach = Ball::new(0.0, self.shaken.pair().alpha.mag());
                let (low, high) = (self.drift.mul_add(time, self.base) + reach).bounds();
                ([low, (1.0 - high).next_down()], 1.0)
            }
        };
        *seen = LeastDistances::default();
        let (slowest, fastest) = self.drift.bounds();
        let count = [(distances[0], -slowest), (distances[1], fastest)].map(|(distance, speed)| {
            if speed > 0.0 { distance / up(period * speed) * (1.0 - VARIATION_PART) } else { LONGEST_FLIGHT } // C7: rounded down by far
        });
        let count = count[0].min(count[1]).min(LONGEST_FLIGHT / period).floor(); // C7: any number up to both
        if is_positive(distances[0]) && is_positive(distances[1]) && is_positive(count) { count * period } else { 0.0 }
    }
}

#[cfg(test)]
mod tests;
