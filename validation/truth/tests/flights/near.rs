//! Flights made to come close to a wall without a contact, or just to cut it.

use impact_pair_truth::float;
use rug::Float;
use std::f64::consts::TAU;

use super::judge::{Case, From, turn};
use super::{from, phase_in_frame};
use crate::random::Random;

/// Time of the extremum of number `k` and `(z - z0) / alpha` there, for drift `q beta` and frame phase `start`.
fn extremum(q: &Float, start: &Float, maximum: bool, k: u32) -> (Float, Float) {
    let critical = float(q.acos_ref()) / turn();
    let at = if maximum { float(1 - &critical) } else { critical };
    let since = float(&at - start);
    let time = float(&since - float(since.floor_ref())) + k;
    let swing = float(start * turn()).sin() - float(&at * turn()).sin();
    (time.clone(), time * q * turn() + swing)
}

/// A double-precision q at which [`extremum`] reaches `target`; `None` if it does not.
fn solve_drift(target: f64, start: f64, maximum: bool, k: u32, low: f64) -> Option<f64> {
    let height = |q: f64| {
        let p = q.acos() / TAU;
        let at = if maximum { 1.0 - p } else { p };
        let since = at - start;
        (since - since.floor() + f64::from(k)) * TAU * q + (TAU * start).sin() - (TAU * at).sin() - target
    };
    let (mut low, mut high) = (low, 1.0);
    if height(low) > 0.0 || height(high) < 0.0 {
        return None;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if height(middle) < 0.0 { low = middle } else { high = middle }
    }
    (height(high).abs() < 1e-6).then_some(high)
}

/// A flight an extremum of which comes within about `miss` gaps of a wall (beyond it if negative).
pub fn near_graze(random: &mut Random, miss: f64) -> Option<Case> {
    let from = match from(random) {
        From::Inside(height) => From::Inside(height.clamp(0.01, 0.99)),
        wall => wall,
    };
    let height = if let From::Inside(height) = from { height } else { 0.0 };
    let phase = phase_in_frame(from, random.uniform(0.0, 1.0));
    let shifted: Float = float(phase) + if from == From::Right { 0.5 } else { 0.0 };
    let frame: Float = shifted.clone() - shifted.floor();
    let (maximum, k) = (random.below(2) == 0, if random.below(3) == 0 { random.below(6) as u32 } else { 0 });
    let goal = if maximum { 1.0 - miss - height } else { miss - height };
    let slowest = if height > 0.0 { -1.0 } else { (TAU * frame.to_f64()).cos() };
    // Any drift will do for a maximum seen from a wall: alpha scales it. Otherwise the drift is solved for.
    let (alpha, q) = if maximum && random.below(2) == 0 {
        let q = random.uniform(slowest, 1.0);
        let (_, reach) = extremum(&float(q), &frame, true, k);
        (goal / reach.to_f64(), q)
    } else {
        let alpha = random.magnitude(-2.0, 2.0);
        (alpha, solve_drift(goal / alpha, frame.to_f64(), maximum, k, slowest)?)
    };
    if !(1e-4..1e6).contains(&alpha) {
        return None;
    }
    // Newton's steps from the rounded data: d(height)/d(velocity) is the time of the extremum.
    let beta = turn() * alpha;
    let mut drift = float(&beta * q);
    for _ in 0..4 {
        let ratio = float(&drift / &beta);
        if float(ratio.abs_ref()) >= 1 {
            return None;
        }
        let (time, reach) = extremum(&ratio, &frame, maximum, k);
        drift -= float(reach * alpha - goal) / time;
    }
    let velocity = float(drift - beta * float(&frame * turn()).cos()).to_f64();
    (velocity >= 0.0 || height > 0.0).then_some(Case { alpha, phase, velocity, from })
}
