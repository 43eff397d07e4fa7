//! Newton's iteration on a chain's equations in floating point: non-rigorous.

use super::chain::Chain;
use super::legs::{Leg, Legs};
use super::precondition::Preconditioner;
use super::shaking::Shaking;
use crate::pair::Inward;

/// Steps before a start is given up.
const MOST_STEPS: usize = 60;
/// The greatest phase, in forcing periods, at which an orbit is not lost.
const MAX_PHASE: f64 = 1e9;
/// The least part of a flight's time that one step leaves.
const MIN_FLIGHT_PART: f64 = 0.2;

/// Steps below this are tiny.
const TINY_STEP: f64 = 1e-9;

/// Repeats a step, which returns its size, at most `most` times, until steps are tiny and no longer shrink: as far as doubles go.
///
/// `None` where the steps do not settle.
pub(super) fn settle(most: usize, mut step: impl FnMut() -> Option<f64>) -> Option<()> {
    let mut last = f64::INFINITY;
    for _ in 0..most {
        let size = step()?;
        if size < TINY_STEP && size >= 0.5 * last {
            return Some(());
        }
        last = size;
    }
    (last < TINY_STEP).then_some(())
}

/// Improves phases, which may be far from an orbit's; `None` where Newton's iteration does not settle.
pub fn polish<S: Shaking<f64>>(chain: &Chain, shaking: &S, mut phases: Vec<f64>) -> Option<Vec<f64>> {
    let mut legs = chain.legs(shaking, &phases)?;
    settle(MOST_STEPS, || {
        let inverse = Preconditioner::new(&chain.slopes(shaking, &legs)?.into_entries())?;
        let step = newton_step(chain, shaking, &legs, &inverse);
        let size = step.iter().map(|x| x.abs()).fold(0.0, f64::max); // proposes
        let taken = keep_order(chain, &legs.legs, &step);
        phases.iter_mut().zip(&step).for_each(|(x, s)| *x += taken * s);
        // Lost, or a NaN, which `max` above passes over; the kernel takes 2^40 forcing periods.
        if !phases.iter().all(|x| x.abs() <= MAX_PHASE) {
            return None;
        }
        legs = chain.legs(shaking, &phases)?;
        Some(size)
    })?;
    Some(phases)
}

/// `-Y F`
fn newton_step<S: Shaking<f64>>(
    chain: &Chain,
    shaking: &S,
    legs: &Legs<f64, S::Moment>,
    inverse: &Preconditioner,
) -> Vec<f64> {
    let misses = chain.residual(shaking, legs);
    (0..misses.len()).map(|i| -inverse.row(i).iter().zip(&misses).fold(0.0, |sum, (y, f)| y.mul_add(*f, sum))).collect()
}

/// Part of a step, at most 1, that keeps the impacts in order.
fn keep_order(chain: &Chain, legs: &[Leg<f64>], step: &[f64]) -> f64 {
    let room = |i: usize| {
        let change = step[chain.next(i)] - step[i];
        let time = legs[i].time;
        if change < -(1.0 - MIN_FLIGHT_PART) * time { (1.0 - MIN_FLIGHT_PART) * time / -change } else { 1.0 }
    };
    (0..step.len()).map(room).fold(1.0, f64::min) // proposes
}

/// Whether these phases are in order and each impact comes from inside the gap, as far as doubles can decide.
pub fn is_plausible<S: Shaking<f64>>(chain: &Chain, shaking: &S, phases: &[f64]) -> bool {
    chain.legs(shaking, phases).is_some_and(|legs| {
        let arrives = |i: usize| chain.walls()[i].inward(*chain.before(&legs.legs, i)) < 0.0;
        legs.legs.iter().all(|leg| leg.time > 0.0) && (0..phases.len()).all(arrives)
    })
}

/// Preconditioner at these phases.
pub fn precondition<S: Shaking<f64>>(chain: &Chain, shaking: &S, phases: &[f64]) -> Option<Preconditioner> {
    Preconditioner::new(&chain.slopes(shaking, &chain.legs(shaking, phases)?)?.into_entries())
}
