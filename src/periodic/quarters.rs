//! Orbits whose impacts are at whole quarters of a forcing period, known exactly: Lemma T14

use std::cmp::Ordering;

use super::chain::Chain;
use crate::exact::Exact;
use crate::number::Ball;
use crate::pair::Reduced;

/// Quarters up to here are followed: doubles hold them, and their sums.
const MOST_QUARTERS: f64 = (1u64 << 50) as f64; // exact: a power of two

/// The phases of the one orbit in these bounds, if the whole quarters of a forcing period in them are proved to solve its equations.
pub(super) fn of(pair: &Reduced<Exact>, chain: &Chain, phases: &[Ball]) -> Option<Vec<f64>> {
    let quarter = |phase: &Ball| {
        let nearest = (4.0 * phase.mid()).round(); // T14: any whole number
        let is_held = nearest.abs() < MOST_QUARTERS && (nearest / 4.0 - phase.mid()).abs() <= phase.rad();
        is_held.then_some(nearest as i64) // exact: whole and below 2^50
    };
    let all: Vec<i64> = phases.iter().map(quarter).collect::<Option<_>>()?;
    let solves = (0..chain.impacts())
        .all(|i| misses(pair, chain, &all, i).and_then(|miss| miss.sign()) == Some(Ordering::Equal));
    solves.then(|| all.iter().map(|&quarters| quarters as f64 / 4.0).collect()) // exact: below 2^50
}

/// `F_i` of Lemma T1 at whole quarters.
fn misses(pair: &Reduced<Exact>, chain: &Chain, quarters: &[i64], i: usize) -> Option<Exact> {
    let whole = |n: i64| Exact::from(n);
    // Sine and cosine at whole quarters.
    let sine = |n: i64| [0, 1, 0, -1][n.rem_euclid(4) as usize]; // exact: below 4
    let drift = |i: usize| {
        let (from, to) = (quarters[i], quarters[chain.next(i)]);
        let round = if chain.next(i) == 0 { 4 * i64::from(chain.cycles()) } else { 0 };
        let wave = pair.alpha.checked_mul(&whole(sine(to) - sine(from))).ok()?;
        let displacement = whole(chain.displacement(i) as i64); // exact: -1, 0 or 1
        let travel = displacement.checked_add(&wave).ok()?.checked_mul(&whole(4)).ok()?;
        travel.checked_div(&whole(to + round - from)).ok()
    };
    let speed = pair.beta.checked_mul(&whole(sine(quarters[i] + 1))).ok()?;
    let after = drift(i)?.checked_sub(&speed).ok()?;
    let before = drift(chain.previous(i))?.checked_sub(&speed).ok()?;
    after.checked_add(&pair.restitution.checked_mul(&before).ok()?).ok()
}
