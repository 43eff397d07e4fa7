//! Starts of flights, at random, and flights made to come close to a wall without a contact, or just to cut it.

use super::Random;
use super::judge::{Case, From, float};
use rug::Float;
use std::f64::consts::TAU;

/// A wall, or a place inside, near the walls or not.
pub fn from(random: &mut Random) -> From {
    match random.below(3) {
        0 => From::Left,
        1 => From::Right,
        _ => From::Inside(match random.below(4) {
            0 => 0.5,
            1 => random.magnitude(-15.0, -1.0),
            2 => 1.0 - random.magnitude(-15.0, -1.0),
            _ => random.uniform(1e-3, 0.999),
        }),
    }
}

/// Either wall.
pub fn wall(random: &mut Random) -> From {
    if random.below(2) == 0 { From::Left } else { From::Right }
}

/// The phase that is `turns` in the frame mirrored onto the left wall, in [-1/2, 1/2].
pub fn phase_in_frame(from: From, turns: f64) -> f64 {
    let shifted = if from == From::Right { turns + 0.5 } else { turns };
    shifted - shifted.round()
}

/// Time of the extremum of number `k` and `(z - z0) / alpha` there, for drift `q beta` and frame phase `start`.
fn extremum(q: &Float, start: &Float, maximum: bool, k: u32) -> (Float, Float) {
    let two_pi = float(rug::float::Constant::Pi) * 2;
    let critical = float(q.acos_ref()) / &two_pi;
    let at = if maximum { float(1 - &critical) } else { critical };
    let since = float(&at - start);
    let time = float(&since - float(since.floor_ref())) + k;
    let swing = float(start * &two_pi).sin() - float(&at * &two_pi).sin();
    (time.clone(), time * q * two_pi + swing)
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
    let from = from(random);
    let height = if let From::Inside(height) = from { height.clamp(0.01, 0.99) } else { 0.0 };
    let from = if height > 0.0 { From::Inside(height) } else { from };
    let start = random.uniform(0.0, 1.0);
    let phase = phase_in_frame(from, start);
    let frame = {
        let shifted: Float = float(phase) + if from == From::Right { 0.5 } else { 0.0 };
        let whole = shifted.clone().floor();
        shifted - whole
    };
    let (maximum, k) = (random.below(2) == 0, if random.below(3) == 0 { random.below(6) as u32 } else { 0 });
    let goal = if maximum { 1.0 - miss - height } else { miss - height };
    let cos = (TAU * frame.to_f64()).cos();
    let slowest = if matches!(from, From::Inside(_)) { -1.0 } else { cos };
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
    // Two Newton steps from the rounded data: d(height)/d(velocity) is the time of the extremum.
    let beta = float(rug::float::Constant::Pi) * 2 * alpha;
    let resting: Float = float(&frame * float(rug::float::Constant::Pi)) * 2;
    let mut drift = float(&beta * q);
    for _ in 0..4 {
        let ratio = float(&drift / &beta);
        if float(ratio.abs_ref()) >= 1 {
            return None;
        }
        let (time, reach) = extremum(&ratio, &frame, maximum, k);
        drift -= float(reach * alpha - goal) / time;
    }
    let velocity = float(drift - beta * resting.cos()).to_f64();
    (velocity >= 0.0 || height > 0.0).then_some(Case { alpha, phase, velocity, from })
}
