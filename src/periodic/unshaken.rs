//! Words that are answered without a search: those on one wall (Lemma T7), and all of a box at rest (Lemma T11).

use std::cmp::Ordering;

use super::Problem;
use super::census::{Census, Region};
use super::orbit::PeriodicImpact;
use crate::contact::Reason;
use crate::exact::{Enclosure, Exact};
use crate::shaken::Either;

/// Bits of the bounds of a family.
const BITS: u32 = 64;

impl Problem {
    /// Complete answer for the word, where a lemma gives one; `None` where orbits have to be looked for.
    pub(super) fn settled(&self) -> Option<Census> {
        let settled = Census { exhaustive: true, is_search: true, ..Census::default() };
        if !self.chain.crosses() {
            return Some(settled);
        }
        let Either::One(one) = &self.shaken else { return None };
        if one.exact.alpha.sign() != Some(Ordering::Equal) {
            return None;
        }
        // T11
        match one.exact.restitution.compare(&Exact::from(1))? {
            Ordering::Equal if self.alternates() => {
                let undecided = vec![self.family()];
                Some(Census { exhaustive: false, is_family: true, undecided, ..settled })
            }
            _ => Some(settled),
        }
    }

    /// Whether no wall is hit twice in a row.
    fn alternates(&self) -> bool {
        (0..self.chain.impacts()).all(|i| self.chain.displacement(i) != 0.0) // T11: -1, 0 or 1, exact
    }

    /// Family of orbits of Lemma T11 (b), with the first impact in forcing period 0.
    fn family(&self) -> Region {
        let whole = |n: usize| Enclosure::from_f64_bounds(n as f64, n as f64).expect("a finite number"); // exact: small
        let [impacts, cycles] = [self.chain.impacts(), self.chain.cycles() as usize].map(whole); // exact: small
        let quotient = |x: &Enclosure, y: &Enclosure| x.div(y, BITS).expect("not 0");
        let (time, speed) = (quotient(&cycles, &impacts), quotient(&impacts, &cycles));
        let turn = whole(0).hull(&whole(1));
        let impact = |i: usize| {
            let away = self.chain.displacement(i);
            PeriodicImpact {
                wall: self.chain.walls()[i],
                phase: turn.add(&time.mul(&whole(i), BITS), BITS),
                // It goes on the other way. exact: -1 or 1
                velocity: if away > 0.0 { speed.negated() } else { speed.clone() },
            }
        };
        Region { impacts: (0..self.chain.impacts()).map(impact).collect(), reason: Reason::Width }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::periodic::{Budget, Precision};
    use crate::tests::{pair, start};

    fn census(restitution: &str, word: &str, cycles: u32) -> Census {
        let problem = Problem::new(&pair("0", restitution), &word.parse().unwrap(), cycles).unwrap();
        problem.find_all(&start(), Precision::default(), Budget::default())
    }

    /// A box at rest that takes nothing from the ball: it goes to and fro at one speed, from any time on.
    #[test]
    fn a_box_at_rest_has_only_families_of_orbits() {
        for (word, cycles) in [("LR", 1), ("RL", 3), ("LRLRLR", 2)] {
            let census = census("1", word, cycles);
            assert!(census.is_family && census.orbits.is_empty() && !census.exhaustive && !census.is_certified());
            let impacts = &census.undecided[0].impacts;
            let speed = word.len() as f64 / f64::from(cycles);
            for (i, impact) in impacts.iter().enumerate() {
                let (low, high) = impact.velocity.to_f64_bounds();
                let to = impact.wall.sign() * -speed;
                assert!(low <= to && to <= high && high - low < 1e-12, "{word} {impact:?}");
                let (low, high) = impact.phase.to_f64_bounds();
                let after = i as f64 / speed;
                assert!((low - after).abs() < 1e-12 && (high - after - 1.0).abs() < 1e-12, "{word} {impact:?}");
            }
        }
        for (restitution, word) in [("1", "LLR"), ("1", "LRR"), ("0.5", "LR"), ("0", "LR"), ("0.999", "LLRR")] {
            let census = census(restitution, word, 1);
            assert!(census.is_certified() && census.exhaustive && !census.is_family && census.orbits.is_empty());
        }
        // Neither is proved.
        let open = census("[0.9, 1]", "LR", 1);
        assert!(!open.is_family && !open.exhaustive && !open.undecided.is_empty());
    }
}
