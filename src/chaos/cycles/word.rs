//! Closed chains of the reduced map as the whole system sees them: words of both walls, from the left one on.

use super::chain::Chain;
use crate::chaos::law::Side;
use crate::number::interval::Interval;
use crate::pair::ImpactPair;
use crate::periodic::Problem;

/// Closed chain in the whole system: once around, or twice where the walls are exchanged after one round. The chain begins at the impact that
/// makes its word the least, so that all rotations have one word.
pub(super) struct WallChain {
    /// The walls of its impacts, `L` or `R`.
    pub walls: String,
    pub cycles: u32,
    /// The phases of its impacts, in forcing periods.
    pub phases: Vec<Interval>,
}

impl WallChain {
    /// `None` where the number of whole forcing periods would be less than 1: no motion has such impacts.
    pub fn new(chain: &Chain) -> Option<Self> {
        let (count, turns) = (chain.len(), chain.turns?);
        let is_far = |i: usize| chain.sides[i % count] == Side::Far;
        let word = |from: usize| (from..from + count).map(is_far);
        let first = (0..count).min_by(|&a, &b| word(a).cmp(word(b)))?;
        let crossings = word(0).filter(|is_far| *is_far).count();
        let rounds = if crossings.is_multiple_of(2) { 1 } else { 2 };
        let (mut walls, mut phases, mut crossed) = (String::new(), Vec::new(), 0_u32);
        for i in first..first + rounds * count {
            walls.push(if crossed.is_multiple_of(2) { 'L' } else { 'R' });
            let added = (i / count) as f64 * turns - 0.5 * f64::from(crossed); // exact: multiples of a half
            phases.push(chain.phases[i % count] + Interval::point(added));
            crossed += u32::from(is_far(i));
        }
        let cycles = rounds as f64 * turns - 0.5 * f64::from(crossed); // exact: a small whole number
        (cycles >= 1.0).then_some(Self { walls, cycles: cycles as u32, phases }) // exact: a small whole number
    }

    /// Periodic-orbit problem of the chain's walls and forcing periods.
    pub fn problem(&self, pair: &ImpactPair) -> Option<Problem> {
        Problem::new(pair, &self.walls.parse().ok()?, self.cycles).ok()
    }
}
