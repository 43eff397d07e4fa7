//! H-sets from everywhere on a floating-point orbit, selected by the orbit's returns across them. For slow expansion: horseshoes have long words
//! there, and saddles are not in the middle of their h-sets. Covering relations are proved later.
//!
//! Labels: proposes throughout.

use std::f64::consts::TAU;

use super::bases::LENGTHS;
use super::entropy::entropy;
use super::guess::Guess;
use super::law::Side;
use super::propose::Making;
use super::quad::{Chord, State};
use super::seen::AttractorOrbit;
use super::vector::{apart, cross, radians};
use super::words::{HSet, Path};
use crate::threads::each;

/// Number of points of the orbit whose words are counted.
const COUNTED_POINTS: usize = 40_000;
/// Least distance of the middles of h-sets, phases in radians, and their greatest number.
const MIN_MIDDLE_DISTANCE: f64 = 0.004;
const MAX_MIDDLES: usize = 160;
/// Half lengths, each shorter than the one before by a factor, and half widths relative to them.
const HALF_LENGTHS: (usize, f64) = (16, 0.8);
const RELATIVE_WIDTHS: [f64; 6] = [0.01, 0.02, 0.04, 0.08, 0.16, 0.3];
/// Number of points that are looked at in each h-set, and the number in a row above which they make a crossing.
const SAMPLED_POINTS: usize = 1000;
const MIN_CROSSING_POINTS: usize = 4;
/// Places of images of a crossing, in half lengths and half widths: at least so far beyond the ends, at most so far across.
const CROSSING_PLACES: [f64; 2] = [1.1, 0.85];
/// The least sine of the angle between an end and the leaf, and the least cosine of that between an end and the middle.
const LEAST_SINE: f64 = 0.1;
const LEAST_COSINE: f64 = 0.95;

impl AttractorOrbit {
    /// Points from everywhere on the orbit.
    fn everywhere(&self) -> Vec<(State, State)> {
        let mut found: Vec<(State, State)> = Vec::new();
        for &point in self.points.iter().take(COUNTED_POINTS) {
            if found.len() < MAX_MIDDLES && found.iter().all(|other| apart(point.0, other.0) > MIN_MIDDLE_DISTANCE) {
                found.push(point);
            }
        }
        found
    }

    /// H-sets that the orbit crosses in several ways, those with the most entropy first.
    pub(super) fn crossed(&self, guess: &Guess, (making, depth): (Making, usize)) -> Vec<HSet> {
        let points = &self.points[..self.points.len().min(COUNTED_POINTS)];
        let of_one = |&(centre, along): &(State, State)| {
            let mut scored: Vec<(f64, HSet)> = Vec::new();
            let Some(across) = guess.contracting(centre, making.ahead) else { return scored };
            let sine = cross(along, across);
            if TAU * sine.abs() < LEAST_SINE {
                return scored;
            }
            let coordinates = |&([u, w], _): &(State, State)| {
                let from = [u - centre[0] - (u - centre[0]).round(), w - centre[1]];
                [cross(from, across) / sine, cross(along, from) / sine]
            };
            let all: Vec<[f64; 2]> = points.iter().map(coordinates).collect();
            let is_near = |&k: &usize| {
                all[k][0].abs() < LENGTHS[0]
                    && all[k][1].abs() < RELATIVE_WIDTHS[RELATIVE_WIDTHS.len() - 1] * LENGTHS[0]
            };
            let mut near: Vec<usize> = (0..all.len().saturating_sub(depth)).filter(is_near).collect();
            near.sort_by(|&a, &b| all[a][0].total_cmp(&all[b][0]));
            for long in (0..HALF_LENGTHS.0).map(|n| LENGTHS[0] * HALF_LENGTHS.1.powi(n as i32)) {
                for width in RELATIVE_WIDTHS.map(|width| width * long) {
                    let Some(base) = aligned(guess, making, (centre, along), across, [long, width]) else { continue };
                    let is_inside = |&k: &usize| all[k][0].abs() < long && all[k][1].abs() < width;
                    let inside: Vec<usize> = near.iter().copied().filter(is_inside).collect();
                    let some: Vec<usize> = inside.iter().copied().step_by(inside.len() / SAMPLED_POINTS + 1).collect();
                    let words =
                        returning_words(&all, &some, [CROSSING_PLACES[0] * long, CROSSING_PLACES[1] * width], depth);
                    let worth = entropy(&words, 1, |word| word.sides.len() as i64);
                    if worth > 0.0 {
                        scored.push((worth, base));
                    }
                }
            }
            scored
        };
        let mut scored = each(&self.everywhere(), &of_one).concat();
        scored.sort_by(|a, b| b.0.total_cmp(&a.0));
        scored.into_iter().map(|(_, base)| base).filter(|base| base.is_convex() && base.is_near()).collect()
    }
}

/// H-set with a middle and a direction, with ends along the contracting directions; `None` where a contracting direction rotates too much.
fn aligned(
    guess: &Guess,
    making: Making,
    (centre, along): (State, State),
    across: State,
    [long, width]: [f64; 2],
) -> Option<HSet> {
    let sine = cross(along, across);
    let end = |sign: f64| {
        let at = [0, 1].map(|i| centre[i] + sign * long * along[i]);
        let own = guess.contracting(at, making.ahead)?;
        let cosine = radians(own).iter().zip(radians(across)).map(|(a, b)| a * b).sum::<f64>();
        let own = own.map(|x| x * cosine.signum());
        let part = cross(along, own) / sine;
        let is_good = part * TAU * sine.abs() > LEAST_SINE && cosine.abs() > LEAST_COSINE;
        let half = own.map(|x| x * width / part * sine.signum());
        let to = |sign: f64| [0, 1].map(|i| at[i] + sign * half[i]);
        is_good.then(|| Chord { bottom: to(-1.0), top: to(1.0) })
    };
    Some(HSet { left: end(-1.0)?, right: end(1.0)? })
}

/// Words that an orbit's points in an h-set seem to make, in coordinates of the h-set: consecutive points that cross at one time.
fn returning_words(all: &[[f64; 2]], inside: &[usize], [long, width]: [f64; 2], depth: usize) -> Vec<Path> {
    let mut taken = vec![false; inside.len()];
    let mut words = Vec::new();
    for time in 1..=depth {
        let mut last: Option<(bool, usize)> = None;
        for n in 0..inside.len() {
            let [xi, eta] = all[inside[n] + time];
            if taken[n] || eta.abs() > width || xi.abs() > LENGTHS[0] {
                last = None;
            } else if xi.abs() > long {
                if let Some((was_before, from)) = last
                    && was_before != (xi < 0.0)
                    && n > from + MIN_CROSSING_POINTS
                {
                    words.push(Path {
                        from: 0,
                        to: 0,
                        sides: vec![Side::Far; time],
                        half_turns: 1,
                        ends: [Vec::new(), Vec::new()],
                    });
                    taken[from..n].fill(true);
                }
                last = Some((xi < 0.0, n));
            }
        }
    }
    words
}
