//! The map in plain doubles: it proposes, and proves nothing.
//!
//! Labels: proposes throughout.

use std::f64::consts::TAU;

use super::Law;
use super::beam::State;

/// The map's parameters, about.
#[derive(Clone, Copy, Debug)]
pub(super) struct Guess {
    gap: f64,
    restitution: f64,
    /// Their radii.
    radii: [f64; 2],
    /// Sine and cosine of one step.
    step: (f64, f64),
}

/// A matrix by rows, of phases and speeds.
pub(super) type Matrix = [[f64; 2]; 2];

/// The approximate image of a state.
#[derive(Clone, Copy, Debug)]
pub(super) struct Image {
    /// Mirrored to the left wall; the phase goes on from that of the start.
    pub state: State,
    pub is_far: bool,
    /// \[forcing periods\]
    pub time: f64,
    pub jacobian: Matrix,
    /// Displacements of it by `D` and `e`, each changed by its radius.
    pub moved: [State; 2],
}

/// Flights are looked at in steps of this, at most N.
const STEP: f64 = 1.0 / 64.0;
const STEPS: u32 = 64 * 64;
/// \[forcing periods\]
pub(super) const MAX_PERIODS: f64 = 64.0;

impl Guess {
    pub fn new(law: &Law) -> Self {
        let radii = [law.gap, law.restitution].map(|x| x.centred_parts().1.hi());
        Self { gap: law.gap.mid(), restitution: law.restitution.mid(), radii, step: (TAU * STEP).sin_cos() }
    }

    /// Returns the next impact; `None` where none is found.
    pub fn map(&self, [start, speed]: State) -> Option<Image> {
        let (sin0, cos0) = (TAU * (start - start.floor())).sin_cos();
        let after = self.restitution * speed;
        let drift = after + cos0;
        // Sine and cosine of the wall's phase by the start's own, which a double holds well.
        let turned = |[sin, cos]: [f64; 2], (s, c): (f64, f64)| [sin * c + cos * s, cos * c - sin * s];
        let at = |time: f64, [sin, cos]: [f64; 2]| (drift * TAU * time - sin + sin0, drift - cos, sin);
        let flight = |time: f64| at(time, turned([sin0, cos0], (TAU * time).sin_cos()));
        let is_inside = |height: f64| height > 0.0 && height < self.gap;
        let (mut from, mut rate_before, mut waves) = (0.0, after, [sin0, cos0]);
        for k in 1..=STEPS {
            let to = STEP * f64::from(k);
            waves = turned(waves, self.step);
            let (height, rate, _) = at(to, waves);
            // The extremum of a step may be beyond a wall, too.
            let turning = if rate_before * rate < 0.0 && k > 1 {
                let sign = rate.signum();
                let time = zero(from, to, |time| {
                    let (_, rate, sin1) = flight(time);
                    [sign * rate, sign * TAU * sin1]
                });
                (!is_inside(flight(time).0)).then_some(time)
            } else {
                None
            };
            if let Some(end) = turning.or((!is_inside(height)).then_some(to)) {
                let is_far = flight(end).0 > 0.5 * self.gap;
                let (sign, level) = if is_far { (1.0, self.gap) } else { (-1.0, 0.0) };
                let begin = if k == 1 { 1e-9 } else { from };
                let time = zero(begin, end, |time| {
                    let (height, rate, _) = flight(time);
                    [sign * (height - level), sign * TAU * rate]
                });
                let (_, rate, sin1) = flight(time);
                let angle = TAU * time;
                // (A.7)
                let by_phase = (after + angle * sin0) / rate;
                let by_speed = -self.restitution * angle / rate / TAU;
                let of_speed = |by: f64, drift: f64| sign * (drift + TAU * sin1 * by);
                let jacobian =
                    [[by_phase, by_speed], [of_speed(by_phase, -TAU * sin0), of_speed(by_speed, self.restitution)]];
                let state = [start + time + if is_far { 0.5 } else { 0.0 }, rate.abs()];
                let [gap, change] = [if is_far { self.radii[0] } else { 0.0 }, self.radii[1] * speed];
                let moved = [[gap, 0.0], [-angle * change, change]].map(|[ahead, drift]| {
                    let by = ahead / (TAU * rate);
                    [by, of_speed(by, drift)]
                });
                return Some(Image { state, is_far, time, jacobian, moved });
            }
            (from, rate_before) = (to, rate);
        }
        None
    }
}

/// The zero of a function that increases, from it and its derivative: by Newton's method, by halving where that leaves the bracket.
fn zero(mut low: f64, mut high: f64, f: impl Fn(f64) -> [f64; 2]) -> f64 {
    let mut at = 0.5 * (low + high);
    for _ in 0..60 {
        let [value, slope] = f(at);
        *if value < 0.0 { &mut low } else { &mut high } = at;
        let newton = at - value / slope;
        let next = if (low..=high).contains(&newton) { newton } else { 0.5 * (low + high) };
        if (next - at).abs() <= f64::EPSILON * high {
            return next;
        }
        at = next;
    }
    at
}

/// A vector's image.
pub(super) fn applied([[a, b], [c, d]]: Matrix, [x, y]: State) -> State {
    [a * x + b * y, c * x + d * y]
}
