//! Orbits that converge for all values of a parameter: sets of states that move with it. Lemma D15 of `docs/proofs/chaos.md#D15`
//!
//! A set is followed from impact to impact as a parallelogram about a middle that is a function of the parameters. So a change
//! of the parameters widens no set. Where the motion contracts, the parallelograms become small. A parallelogram that lies in
//! an earlier one is proved to contract to a periodic orbit.

use std::f64::consts::TAU;

use num_integer::Integer;

use super::flights::Flights;
use super::guess::Guess;
use super::law::{Law, Side};
use super::quad::{Quad, State};
use super::scene::Visited;
use super::vector::apart;
use super::vector::{applied, length};
use crate::mapping::{Mapping, Word};
use crate::number::{Ball, Number, UNIT, up};
use crate::pair::Wall;
use crate::watch::Watch;

#[cfg(test)]
mod tests;

/// Impacts that are followed.
const MAX_IMPACTS: usize = 2000;
/// The most impacts from a set to a later one that lies in it; this many more are followed to find the shortest period.
const MAX_RETURN_IMPACTS: usize = 128;
/// Number of impacts after which sets may begin anew, with sides as long as a multiple of the distance by which the orbit misses an
/// earlier impact, if that is near: each multiple is tried.
const ENLARGING_INTERVAL: usize = 32;
const ENLARGING_FACTORS: [f64; 2] = [0.0, 8.0];
/// Lengths of the sides of sets by which a shorter round is looked for at one value: each of these is tried.
const SIDE_LENGTHS: [f64; 3] = [1e-6, 1e-5, 1e-4];
const NEAR_DISTANCE: f64 = 0.02;
/// Factor by which sides are longer than they have to be, so that it can be proved that they are long enough.
const SIDE_FACTOR: f64 = 1.0 + 1e-9;
/// Wider sets are not followed.
const MAX_WIDTH: f64 = 0.25;

/// States `middle + a sides[0] + b sides[1] + c moved[0] + d moved[1]`, `|a|, |b| <= 1`; `c` and `d` in `[-1, 1]` give `e` and `D`.
#[derive(Clone, Copy, Debug)]
struct Set {
    middle: State,
    sides: [State; 2],
    moved: [State; 2],
    /// Wall of the impact, and whole forcing periods that passed before the middle's phase.
    wall: Wall,
    turns: f64,
}

/// The vectors whose products with a vector are its coordinates by two sides; `None` if these are not proved to be independent.
fn coordinates([p, q]: [State; 2]) -> Option<[[Ball; 2]; 2]> {
    let [[a, b], [c, d]] = [p.map(Ball::exact), q.map(Ball::exact)];
    let area = a * d - b * c;
    let divided = |x: Ball, y: Ball| Some([x.checked_div(area)?, y.checked_div(area)?]);
    Some([divided(d, -c)?, divided(-b, a)?])
}

impl Set {
    fn of(first: &Visited) -> Self {
        let turns = first.phase.mid().floor(); // exact: whole forcing periods, counted by themselves
        Self {
            middle: [first.phase.mid() - turns, first.speed.mid()],
            // D15: what the middle is rounded by
            sides: [[up(first.phase.rad() + UNIT), 0.0], [0.0, first.speed.rad()]],
            moved: [[0.0; 2]; 2],
            wall: first.wall,
            turns,
        }
    }

    fn quad(&self) -> Quad {
        let Self { middle, sides, moved, .. } = *self;
        let states = Quad { centre: middle, sides, twist: [0.0; 2], slack: [0.0; 2], floor: 0.0 };
        let [_, down] = states.radii(&moved);
        Quad { floor: middle[1] - up(down + UNIT * middle[1]), ..states }
    }

    /// The set of the images, and on which wall they are; `None` where it is not proved that all land on one, without a graze.
    fn next(&self, law: &Law, guess: &Guess) -> Option<(Self, Side)> {
        let quad = self.quad();
        if !(quad.floor > 0.0 && self.sides.iter().all(|side| length(*side) < MAX_WIDTH)) {
            return None; // exact: given up, nothing is certified
        }
        // proposes: where the images are, and how they lie there
        let image = guess.map(self.middle)?;
        let arrival = image.state[0] - image.side.shift();
        let [by_gap, by_restitution] = image.moved;
        let [before, own] = [self.moved, [by_restitution, by_gap]];
        let moved = [0, 1].map(|k| {
            let [u, w] = applied(image.jacobian, before[k]);
            [own[k][0] + u, own[k][1] + w]
        });
        let directions = directions(self.sides.map(|side| applied(image.jacobian, side)));
        let turns = image.state[0].floor(); // exact: whole forcing periods, counted by themselves
        let middle = [image.state[0] - turns, image.state[1]];

        let landing = Flights::moved(law, &quad, self.moved).land(image.side, arrival)?;
        let point = [Ball::exact(middle[0]) + Ball::exact(turns), Ball::exact(middle[1])];
        let reach =
            |sides: [State; 2]| Some(coordinates(sides)?.map(|normal| landing.beside(normal, point, moved).mag()));
        let long = reach(directions)?;
        let sides = [0, 1].map(|i| directions[i].map(|x| x * long[i] * SIDE_FACTOR));
        // D15: the sides reach as far as the images
        if !reach(sides)?.iter().all(|reach| *reach <= 1.0) {
            return None;
        }
        Some((
            Self { middle, sides, moved, wall: image.side.lands_on(self.wall), turns: self.turns + turns },
            image.side,
        ))
    }

    /// The set with sides at least twice as long, and of at least a given length; sets shrink as fast as motions converge.
    fn enlarged(self, least: f64) -> Self {
        let longer = |side: State| {
            let power = (least / length(side)).log2().ceil().max(1.0); // D15: at least twice as long
            let factor = f64::powi(2.0, power as i32); // D15: a power of two, so that no side is turned by rounding
            side.map(|x| factor * x)
        };
        Self { sides: self.sides.map(longer), ..self }
    }

    /// The given multiple of the distance to the nearest of some sets before, if that is near, else 0; phases in radians.
    fn room(&self, times: f64, before: &[Self]) -> f64 {
        let away = |other: &Self| apart(other.middle, self.middle);
        let room = times * before.iter().map(away).fold(f64::INFINITY, f64::min); // proposes: how large sets become
        if room < NEAR_DISTANCE { room } else { 0.0 } // proposes: how large sets become
    }

    /// Whole forcing periods by which the set `other` is shifted to lie in this set, for each value of the parameters, with a
    /// margin. `None` where no shift is proved. Lemma D15
    fn holds(&self, other: &Self) -> Option<f64> {
        let (shift, beside) = self.beside(other)?;
        let is_within = |[away, reach]: [Ball; 2]| up(away.mag() + reach.mag()) < 1.0; // D15: strictly inside
        beside.into_iter().all(is_within).then_some(shift)
    }

    /// Whether this set and `other` have no state in common, up to whole forcing periods, for any parameters. Lemma D15 (least)
    fn is_apart_from(&self, other: &Self) -> bool {
        let across = |set: &Self| set.quad().radii(&set.moved)[0];
        // D15: where phases are this narrow, other whole numbers of forcing periods are excluded
        let is_narrow = up(across(self) + across(other)) < 0.5;
        let is_beyond = |[away, reach]: [Ball; 2]| away.mid().abs() - away.rad() > up(1.0 + up(reach.mag() + UNIT));
        is_narrow && self.beside(other).is_some_and(|(_, beside)| beside.into_iter().any(is_beyond))
    }

    /// Whole forcing periods that shift `other`'s middle nearest to this set's. For each coordinate along this set's sides: the
    /// shifted middle, and the reach of `other`'s states from the shifted middle, for all parameters.
    fn beside(&self, other: &Self) -> Option<(f64, [[Ball; 2]; 2])> {
        let shift = (other.middle[0] - self.middle[0]).round(); // exact: any whole number will do
        let away = [
            Ball::exact(other.middle[0]) - Ball::exact(shift) - Ball::exact(self.middle[0]),
            Ball::exact(other.middle[1]) - Ball::exact(self.middle[1]),
        ];
        let along_each = |normal: [Ball; 2]| {
            let along = |[u, w]: [Ball; 2]| normal[0] * u + normal[1] * w;
            let side = |k: usize| along(other.sides[k].map(Ball::exact)).mag();
            let moved = |k: usize| {
                let [was, is] = [self.moved[k], other.moved[k]].map(|by| by.map(Ball::exact));
                along([is[0] - was[0], is[1] - was[1]]).mag()
            };
            [along(away), Ball::exact(up(side(0) + side(1) + moved(0) + moved(1)))]
        };
        Some((shift, coordinates(self.sides)?.map(along_each)))
    }
}

/// Directions of unit length along the longer one of two vectors and square to it, phases in radians.
fn directions([p, q]: [State; 2]) -> [State; 2] {
    let [u, w] = if length(p) > length(q) { p } else { q };
    let size = length([u, w]);
    [[u / size, w / size], [-w / (TAU * size), TAU * u / size]]
}

/// Flights from an impact on a wall until a periodic orbit closes, and their whole forcing periods in the reduced map.
struct Round {
    wall: Wall,
    sides: Vec<Side>,
    turns: f64,
    /// Whether no shorter round is possible, for any parameters.
    is_least: bool,
}

impl Round {
    /// Round from a set to the next set that lies in the first one, `turns` whole forcing periods later. Lemma D15 (round, least)
    fn of(sets: &[Set], sides: &[Side], turns: f64) -> Self {
        let count = sides.len();
        let is_apart_after = |n: usize| (n..count).any(|k| sets[k - n].is_apart_from(&sets[k]));
        let is_least = (1..count)
            .filter(|&n| count.is_multiple_of(n))
            .all(|n| sides[n..] != sides[..count - n] || is_apart_after(n));
        Self { wall: sets[0].wall, sides: sides.to_vec(), turns, is_least }
    }

    /// The orbit also closes after the round `other`, so after the greatest common divisor of the two rounds. Lemma D15
    /// (period, one)
    fn divide(&mut self, other: &Self) {
        let common = self.sides.len().gcd(&other.sides.len());
        self.turns /= (self.sides.len() / common) as f64; // exact: whole forcing periods after each part
        self.sides.truncate(common);
        self.is_least |= other.is_least && other.sides.len() == common;
    }

    /// Word and forcing periods of the round; two rounds make a period where one round ends on the other wall.
    fn period(&self) -> Option<StablePeriod> {
        let far = self.sides.iter().filter(|&&side| side == Side::Far).count();
        let half_cycles = 2 * self.turns as i64 - far as i64; // exact: whole numbers, each far impact is half a forcing period later
        let rounds = if far.is_multiple_of(2) { 1 } else { 2 };
        let mut from = self.wall;
        let mut mappings = Vec::new();
        for side in self.sides.repeat(rounds) {
            let to = side.lands_on(from);
            mappings.push(Mapping::between(from, to));
            from = to;
        }
        let cycles = half_cycles * rounds as i64 / 2; // exact: an even number
        let word = Word::new(mappings).ok()?;
        Some(StablePeriod { word, cycles: u32::try_from(cycles).ok()?, is_least: self.is_least })
    }
}

/// A period of a stable orbit, for all `D` and `e` of a law.
pub(super) struct StablePeriod {
    /// Word of the period, from some impact on.
    pub word: Word,
    /// The forcing periods that it takes.
    pub cycles: u32,
    /// Whether the period is proved to be the least; else it is a multiple of the least period.
    pub is_least: bool,
}

/// Proves that the orbit from a state converges, for all `D` and `e` of the law, to a periodic orbit, and encloses its
/// period. `None` where convergence is not proved. Lemma D15
pub(super) fn attracted(law: &Law, first: &Visited, watch: &dyn Watch) -> Option<StablePeriod> {
    let mut found = ENLARGING_FACTORS.into_iter().find_map(|room| converges(law, first, Enlarged::By(room), watch))?;
    // D15: one pair, which repeats after as many impacts as all others; its sets are small, so that fewer impacts are enough
    let one = Law { gap: Ball::exact(law.gap.mid()), restitution: Ball::exact(law.restitution.mid()) };
    let first = Visited { phase: Ball::exact(first.phase.mid()), speed: Ball::exact(first.speed.mid()), ..*first };
    for length in SIDE_LENGTHS {
        if found.is_least {
            break;
        }
        if let Some(shorter) = converges(&one, &first, Enlarged::To(length), watch) {
            found.divide(&shorter);
        }
    }
    found.period()
}

/// The rule by which sets are enlarged every [`ENLARGING_INTERVAL`] impacts: to find a round soon, by a multiple of the distance by which the orbit
/// misses an earlier impact; to find the shortest round, to sides of at least a given length, phases in radians.
#[derive(Clone, Copy)]
enum Enlarged {
    By(f64),
    To(f64),
}

/// Round of the periodic orbit that the sets from a state on are proved to converge to; `None` where none is proved.
fn converges(law: &Law, first: &Visited, enlarged: Enlarged, watch: &dyn Watch) -> Option<Round> {
    let guess = Guess::new(law);
    let (mut sets, mut sides) = (vec![Set::of(first)], Vec::new());
    let mut found: Option<(Round, usize)> = None;
    while sets.len() <= MAX_IMPACTS && watch.goes_on() {
        let last = sets.len();
        let Some((set, side)) = sets[last - 1].next(law, &guess) else { break };
        sides.push(side);
        let recent = last.saturating_sub(MAX_RETURN_IMPACTS)..last; // exact: all there are
        for from in recent.rev() {
            let impacts = last - from;
            if found.as_ref().is_some_and(|(round, _)| impacts.is_multiple_of(round.sides.len())) {
                continue;
            }
            let Some(shift) = sets[from].holds(&set) else { continue };
            let own = Round::of(&sets[from..], &sides[from..], set.turns - sets[from].turns + shift);
            match &mut found {
                Some((round, _)) => round.divide(&own),
                None => {
                    found = Some((own, last));
                    break;
                }
            }
        }
        let begins_anew = last.is_multiple_of(ENLARGING_INTERVAL);
        // proposes: larger sets hold as much
        sets.push(match enlarged {
            Enlarged::By(times) if begins_anew && (found.is_some() || times > 0.0) => {
                set.enlarged(set.room(times, &sets[last - ENLARGING_INTERVAL..last - ENLARGING_INTERVAL / 2]))
            }
            Enlarged::To(length) if begins_anew => set.enlarged(length),
            _ => set,
        });
        let Some((round, since)) = &found else { continue };
        if round.is_least || matches!(enlarged, Enlarged::By(_)) && last == since + MAX_RETURN_IMPACTS {
            break;
        }
    }
    Some(found?.0)
}
