//! Floating point proposes: Newton's iteration on a chain's equations. Nothing here is proved.

use super::chain::{Chain, Legs};
use super::precondition::Preconditioner;
use crate::pair::Reduced;

/// Steps before a start is given up.
const MOST_STEPS: usize = 60;
/// `2^32` turns, well within the kernel's domain (Lemma K1).
const LARGEST_PHASE: f64 = 4_294_967_296.0;
/// The least part of a flight's time that one step leaves.
const KEPT: f64 = 0.2;

/// Phases near an orbit's from phases that may be far from them; `None` where Newton's iteration does not settle.
pub fn polish(chain: &Chain, pair: &Reduced<f64>, mut phases: Vec<f64>) -> Option<Vec<f64>> {
    let mut legs = chain.legs(pair, &phases)?;
    let mut last = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let inverse = Preconditioner::new(&chain.slopes(pair, &legs)?)?;
        let step = newton_step(chain, pair, &legs, &inverse);
        let size = step.iter().map(|x| x.abs()).fold(0.0, f64::max);
        if !size.is_finite() {
            return None;
        }
        let taken = keep_order(chain, &legs, &step);
        phases.iter_mut().zip(&step).for_each(|(x, s)| *x += taken * s);
        if !phases.iter().all(|x| x.abs() <= LARGEST_PHASE) {
            return None;
        }
        legs = chain.legs(pair, &phases)?;
        // As far as doubles go: a step that is tiny and no longer shrinks.
        if size < 1e-9 && size >= 0.5 * last {
            return Some(phases);
        }
        last = size;
    }
    (last < 1e-9).then_some(phases)
}

/// `-Y F`
fn newton_step(chain: &Chain, pair: &Reduced<f64>, legs: &Legs<f64>, inverse: &Preconditioner) -> Vec<f64> {
    let misses = chain.residual(pair, legs);
    (0..misses.len()).map(|i| -inverse.row(i).iter().zip(&misses).fold(0.0, |sum, (y, f)| y.mul_add(*f, sum))).collect()
}

/// How much of a step keeps the impacts in order.
fn keep_order(chain: &Chain, legs: &Legs<f64>, step: &[f64]) -> f64 {
    let room = |i: usize| {
        let change = step[chain.next(i)] - step[i];
        let time = legs.legs[i].time;
        if change < -(1.0 - KEPT) * time { (1.0 - KEPT) * time / -change } else { 1.0 }
    };
    (0..step.len()).map(room).fold(1.0, f64::min)
}

/// Whether these phases are in order and each impact comes from inside the gap, as far as doubles can tell.
pub fn is_plausible(chain: &Chain, pair: &Reduced<f64>, phases: &[f64]) -> bool {
    chain.legs(pair, phases).is_some_and(|legs| {
        let arrives = |i: usize| chain.walls()[i].inward(*chain.before(&legs, i)) < 0.0;
        legs.legs.iter().all(|leg| leg.time > 0.0) && (0..phases.len()).all(arrives)
    })
}

/// The preconditioner at these phases.
pub fn precondition(chain: &Chain, pair: &Reduced<f64>, phases: &[f64]) -> Option<Preconditioner> {
    Preconditioner::new(&chain.slopes(pair, &chain.legs(pair, phases)?)?)
}
