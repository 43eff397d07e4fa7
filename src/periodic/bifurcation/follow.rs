//! Floating point follows a branch through its folds to its end and notes where something changes sign. Non-rigorous.

// Labels: proposes throughout.

use super::family::{Family, Varied};
use super::ring::Ring;
use super::trace::{Nearest, Station, Tests, correct};
use crate::watch::Watch;

/// An event on a branch.
#[derive(Clone, Copy, Debug)]
pub(super) enum Change {
    /// The branch turns back: an eigenvalue is 1.
    Turn,
    /// An eigenvalue of the ring is -1.
    Flip,
    /// A flight touches a wall.
    Graze(Nearest),
    /// An impact has no velocity left.
    Vanish(usize),
    /// For `e = 0` an impact after which the contact force ends; beyond, the ball would rest.
    Release(usize),
    /// The branch meets the branch of its half: an eigenvalue of the half is -1.
    Join,
}

/// The reason why a branch is followed no further.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stop {
    /// The parameter leaves its range.
    Range,
    /// The branch ends: the last change is its end.
    Change,
    /// The branch is back at its start.
    Loop,
    /// Newton's iteration or the budget gives out.
    Lost,
    /// The caller requested a stop.
    Interrupted,
}

/// A part of a branch in one direction.
#[derive(Clone, Debug)]
pub(super) struct Path {
    pub stations: Vec<Station>,
    /// The changes, each with the phases and the parameter near it.
    pub changes: Vec<(Change, Vec<f64>)>,
    pub stop: Stop,
}

impl Path {
    /// Stations on the branch: at a change that ends the branch, the last station lies beyond and is left out.
    pub fn within(&self) -> &[Station] {
        &self.stations[..self.stations.len() - usize::from(self.stop == Stop::Change)]
    }
}

/// Stations of a path at most.
const MOST_STATIONS: usize = 20_000;
/// The longest step, the shortest one, and the longest in parts of the range.
const MAX_STEP: f64 = 0.01;
const MIN_STEP: f64 = 1e-10;
const MAX_RANGE_STEP: f64 = 0.01;
/// The least cosine of the angle between tangents, and the least for a longer step.
const MIN_COSINE: f64 = 0.99;
const LONGER_STEP_COSINE: f64 = 0.998;
/// Parts that the way to a change of sign is cut into, one after the other: a third of them are halves.
const HALVINGS: u32 = 24;
/// Distance of a ring from its half, in forcing periods, within which a turn of the branch is taken for the meeting with the branch of its half.
const MEETING_DISTANCE: f64 = 1e-3;

/// Follows the branch from a station the way of its tangent until the watch stops it.
pub(super) fn follow<S: Varied>(
    ring: &Ring,
    family: &Family<S, f64>,
    (start, first): (Station, f64),
    [low, high]: [f64; 2],
    watch: &dyn Watch,
) -> Path {
    let longest = MAX_STEP.min(MAX_RANGE_STEP * (high - low) + 1e-6);
    let mut size = first.min(longest);
    let mut path = Path { stations: vec![start], changes: Vec::new(), stop: Stop::Lost };
    while path.stations.len() < MOST_STATIONS && size > MIN_STEP {
        if !watch.goes_on() {
            path.stop = Stop::Interrupted;
            break;
        }
        let last = path.stations.last().expect("a first station");
        let Some((next, cosine)) = advance(ring, family, last, size) else {
            size *= 0.5;
            continue;
        };
        if cosine < MIN_COSINE {
            size *= 0.5;
            continue;
        }
        // Beyond the range nothing is requested, and next to e = 0 nothing is a motion: the last station is at the end of the range.
        let end = next.parameter().clamp(low, high);
        let left = end != next.parameter();
        if left && end == last.parameter().clamp(low, high) {
            path.stop = Stop::Range;
            break;
        }
        let Some(next) = (if left { at_parameter(ring, family, [last, &next], end) } else { Some(next) }) else {
            size *= 0.5;
            continue;
        };
        let ended = note(ring, family, last, &next, &mut path.changes);
        let looped = path.stations.len() > 3 && is_back(&path.stations[0], last, &next);
        path.stations.push(next);
        if ended || left || looped {
            path.stop = match (ended, left) {
                (true, _) => Stop::Change,
                (_, true) => Stop::Range,
                _ => Stop::Loop,
            };
            break;
        }
        size = if cosine > LONGER_STEP_COSINE { (1.3 * size).min(longest) } else { size };
    }
    path
}

/// A step along the branch, and the cosine of the angle between the tangents at its ends.
fn advance<S: Varied>(ring: &Ring, family: &Family<S, f64>, from: &Station, size: f64) -> Option<(Station, f64)> {
    let guess: Vec<f64> = from.x.iter().zip(&from.tangent).map(|(x, t)| size.mul_add(*t, *x)).collect();
    let x = correct(ring, family, &guess, &from.tangent)?;
    let next = Station::new(ring, family, x, &from.tangent)?;
    let cosine = from.tangent.iter().zip(&next.tangent).map(|(a, b)| a * b).sum();
    Some((next, cosine))
}

/// The station at a value of the parameter between those of two stations.
fn at_parameter<S: Varied>(ring: &Ring, family: &Family<S, f64>, [a, b]: [&Station; 2], value: f64) -> Option<Station> {
    let part = (value - a.parameter()) / (b.parameter() - a.parameter());
    let between = |(a, b): (&f64, &f64)| part.mul_add(b - a, *a);
    let mut guess: Vec<f64> = a.x.iter().zip(&b.x).map(between).collect();
    let mut across = vec![0.0; guess.len()];
    (*guess.last_mut()?, *across.last_mut()?) = (value, 1.0);
    let mut x = correct(ring, family, &guess, &across)?;
    *x.last_mut()? = value;
    Station::new(ring, family, x, &a.tangent)
}

/// Notes the changes of sign between two stations; true if the branch ends there.
fn note<S: Varied>(
    ring: &Ring,
    family: &Family<S, f64>,
    a: &Station,
    b: &Station,
    changes: &mut Vec<(Change, Vec<f64>)>,
) -> bool {
    let room = |tests: &Tests| tests.room.distance;
    let speed = |tests: &Tests| tests.arrival.0;
    if speed(&b.tests) <= 0.0 {
        let at = locate(ring, family, a, b, speed);
        changes.push((Change::Vanish(at.tests.arrival.1), at.x));
        return true;
    }
    let bend = |tests: &Tests| tests.bend.0;
    // Where e falls to 0 on the way, an acceleration towards the wall has let a flight come back to it before: a graze.
    if bend(&a.tests).is_finite() && bend(&b.tests) <= 0.0 {
        let at = locate(ring, family, a, b, bend);
        changes.push((Change::Release(at.tests.bend.1), at.x));
        return true;
    }
    if room(&b.tests) <= 0.0 {
        let at = locate(ring, family, a, b, room);
        changes.push((Change::Graze(at.tests.room), at.x));
        return true;
    }
    let turn = |tests: &Tests| tests.turn;
    let flip = |tests: &Tests| tests.flip;
    if turn(&a.tests) * turn(&b.tests) < 0.0 {
        let at = locate(ring, family, a, b, turn);
        if at.tests.apart < MEETING_DISTANCE {
            changes.push((Change::Join, at.x));
            return true;
        }
        changes.push((Change::Turn, at.x));
    }
    if flip(&a.tests) * flip(&b.tests) < 0.0 {
        let at = locate(ring, family, a, b, flip);
        changes.push((Change::Flip, at.x));
    }
    false
}

/// Station at which a test changes sign between two stations, by halving and secants.
fn locate<S: Varied>(
    ring: &Ring,
    family: &Family<S, f64>,
    a: &Station,
    b: &Station,
    test: impl Fn(&Tests) -> f64,
) -> Station {
    let (mut a, mut b) = (a.clone(), b.clone());
    for i in 0..HALVINGS {
        let (at_a, at_b) = (test(&a.tests), test(&b.tests));
        let secant = at_a / (at_a - at_b);
        // There is no secant where a test is infinite: a flight without extrema has all the room.
        let part = if i % 3 == 2 || secant.is_nan() { 0.5 } else { secant.clamp(0.02, 0.98) };
        let chord: Vec<f64> = a.x.iter().zip(&b.x).map(|(a, b)| b - a).collect();
        let guess: Vec<f64> = a.x.iter().zip(&chord).map(|(a, c)| part.mul_add(*c, *a)).collect();
        let corrected = correct(ring, family, &guess, &chord);
        // Where branches meet, corrections fail.
        let Some(middle) = corrected.and_then(|x| Station::new(ring, family, x, &a.tangent)) else { break };
        let (from, to) = if test(&middle.tests) * at_a > 0.0 { (middle, b) } else { (a, middle) };
        (a, b) = (from, to);
    }
    if test(&a.tests).abs() < test(&b.tests).abs() { a } else { b }
}

/// Whether the way from station `a` to station `b` passes the station `first`.
fn is_back(first: &Station, a: &Station, b: &Station) -> bool {
    let chord: Vec<f64> = a.x.iter().zip(&b.x).map(|(a, b)| b - a).collect();
    let square: f64 = chord.iter().map(|c| c * c).sum();
    let along: f64 = chord.iter().zip(first.x.iter().zip(&a.x)).map(|(c, (f, a))| c * (f - a)).sum();
    let part = along / square;
    if !(0.0..=1.0).contains(&part) {
        return false;
    }
    let missed = |((f, a), c): ((&f64, &f64), &f64)| (f - part.mul_add(*c, *a)).powi(2);
    let distance: f64 = first.x.iter().zip(&a.x).zip(&chord).map(missed).sum();
    distance < 0.01 * square && first.tangent.iter().zip(&b.tangent).map(|(a, b)| a * b).sum::<f64>() > 0.5
}
