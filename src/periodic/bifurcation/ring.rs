//! Chains that repeat or mirror themselves after half their impacts, given by that half: Lemma Y1.

use super::super::chain::Chain;
use super::super::legs::{Legs, Slopes};
use super::super::shaking::Shaking;
use crate::mapping::{Mapping, Word};
use crate::number::Number;
use crate::pair::Wall;

/// A chain of `k` impacts in `N` cycles with `m` unknowns: `m = k`, or `m = k/2` for the orbits that are their own mirror image.
///
/// Then `u_{i+m} = u_i + N/2` with `N` an odd number of common periods, and only the first `m` impacts have equations of their own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Ring {
    chain: Chain,
    unknowns: usize,
}

impl Ring {
    /// All orbits of a chain.
    pub fn whole(chain: Chain) -> Self {
        Self { unknowns: chain.impacts(), chain }
    }

    /// Symmetric orbits of a chain; `None` where the chain has none.
    pub fn mirrored(chain: &Chain) -> Option<Self> {
        let (walls, half) = (chain.walls(), chain.impacts() / 2);
        let folds = chain.impacts() == 2 * half && (0..half).all(|i| walls[i + half] == walls[i].other());
        let periods = chain.cycles() / chain.period();
        (folds && chain.mirror().is_some() && !periods.is_multiple_of(2))
            .then(|| Self { chain: chain.clone(), unknowns: half })
    }

    /// Orbits of the chain that `chain` runs through `times` times.
    pub fn repeated(chain: &Chain, times: usize) -> Option<Self> {
        let (walls, part) = (chain.walls(), chain.impacts() / times);
        let is_round = |round: &[Wall]| *round == walls[..part];
        let repeats = part > 0 && chain.impacts() == times * part && walls.chunks(part).all(is_round);
        let rounds = u32::try_from(times).ok().filter(|&rounds| repeats && chain.cycles().is_multiple_of(rounds))?;
        chain.another(&word_of(&walls[..part])?, chain.cycles() / rounds).ok().map(Self::whole)
    }

    /// Ring of the branch that leaves at an eigenvalue -1: all orbits of the chain, or of the chain run through twice.
    pub fn doubled(&self) -> Option<Self> {
        if self.is_mirrored() {
            return Some(Self::whole(self.chain.clone()));
        }
        let walls = self.chain.walls().repeat(2);
        self.chain.another(&word_of(&walls)?, self.chain.cycles().checked_mul(2)?).ok().map(Self::whole)
    }

    /// Rings whose doubled ring this one may be.
    pub fn halves(&self) -> impl Iterator<Item = Self> {
        let whole = !self.is_mirrored();
        [Self::mirrored(&self.chain), Self::repeated(&self.chain, 2)].into_iter().flatten().filter(move |_| whole)
    }

    /// Rings that hold some orbits of this ring with fewer unknowns: those that it runs through several times, then its mirrored half.
    pub fn parts(&self) -> impl Iterator<Item = Self> {
        let whole = !self.is_mirrored();
        let repeated = (2..=self.chain.impacts()).filter_map(|times| Self::repeated(&self.chain, times));
        repeated.chain(Self::mirrored(&self.chain)).filter(move |_| whole)
    }

    /// Chain of all impacts.
    pub fn chain(&self) -> &Chain {
        &self.chain
    }

    /// Number of unknown phases.
    pub fn unknowns(&self) -> usize {
        self.unknowns
    }

    /// Whether the ring holds symmetric orbits only.
    pub fn is_mirrored(&self) -> bool {
        self.unknowns < self.chain.impacts()
    }

    /// Word of the chain.
    pub fn word(&self) -> Word {
        word_of(self.chain.walls()).expect("the walls of a chain chain")
    }

    /// Forcing periods after which the unknowns repeat.
    pub fn turns(&self) -> f64 {
        f64::from(self.chain.cycles()) * self.unknowns as f64 / self.chain.impacts() as f64 // Y1: N or N/2, exact
    }

    /// Phases of all impacts, given the unknown ones.
    pub fn lift<N: Number>(&self, phases: &[N]) -> Vec<N> {
        let later = |i: usize| N::from_f64((i / self.unknowns) as f64 * self.turns()); // Y1: 0 or 1, exact
        (0..self.chain.impacts()).map(|i| phases[i % self.unknowns].clone() + later(i)).collect()
    }

    /// All flights of the chain, given the unknown phases.
    pub fn legs<N: Number, B: Shaking<N>>(&self, shaking: &B, phases: &[N]) -> Option<Legs<N, B::Moment>> {
        self.chain.legs(shaking, &self.lift(phases))
    }

    /// `F_i` of the first `m` impacts. Lemma T1
    pub fn residual<N: Number, B: Shaking<N>>(&self, shaking: &B, legs: &Legs<N, B::Moment>) -> Vec<N> {
        let mut misses = self.chain.residual(shaking, legs);
        misses.truncate(self.unknowns);
        misses
    }

    /// `F'_mu w`: the derivatives of `F` along `w` with `w_{i+m} = mu w_i`, for `mu` of 1 or -1. Lemma Y2
    pub fn twisted<N: Number>(&self, slopes: &Slopes<N>, w: &[N], mu: f64) -> Vec<N> {
        let ends = [&w[self.unknowns - 1], &w[0]].map(|w| w.clone().signed(mu));
        self.continued(slopes, w, ends)
    }

    /// Derivatives of `F` along `w`, given the values of `w` before the first and after the last impact. Lemmas Y2, Y8
    pub fn continued<N: Number>(&self, slopes: &Slopes<N>, w: &[N], [first, last]: [N; 2]) -> Vec<N> {
        let row = |i: usize| {
            let [before, own, after] = slopes.0[i].clone();
            let previous = if i == 0 { first.clone() } else { w[i - 1].clone() };
            let next = if i + 1 == self.unknowns { last.clone() } else { w[i + 1].clone() };
            before.mul_add(previous, own.mul_add(w[i].clone(), after * next))
        };
        (0..self.unknowns).map(row).collect()
    }

    /// Trace of the derivative of the ring's return map: of the period, or of half a period followed by the mirror.
    pub fn trace<N: Number, B: Shaking<N>>(&self, shaking: &B, legs: &Legs<N, B::Moment>) -> Option<N> {
        let [[a, _], [_, d]] = self.chain.monodromy_of(shaking, legs, self.unknowns)?;
        Some(if self.is_mirrored() { a - d } else { a + d })
    }
}

/// Word of impacts on these walls, one after the other.
fn word_of(walls: &[Wall]) -> Option<Word> {
    let next = walls.iter().cycle().skip(1);
    Word::new(walls.iter().zip(next).map(|(&a, &b)| Mapping::between(a, b)).collect()).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::periodic::shaking::Repetition;

    fn chain(word: &str, cycles: u32) -> Chain {
        Chain::new(&word.parse().unwrap(), cycles).unwrap()
    }

    #[test]
    fn only_odd_cycles_and_mirrored_walls_fold() {
        assert!(Ring::mirrored(&chain("RL", 1)).is_some() && Ring::mirrored(&chain("RRLL", 3)).is_some());
        assert!(Ring::mirrored(&chain("RL", 2)).is_none() && Ring::mirrored(&chain("RRL", 1)).is_none());
        assert_eq!(Ring::repeated(&chain("RLRL", 2), 2), Some(Ring::whole(chain("RL", 1))));
        assert_eq!(Ring::repeated(&chain("RLRLRL", 3), 3), Some(Ring::whole(chain("RL", 1))));
        assert!(Ring::repeated(&chain("RLRLRL", 2), 3).is_none() && Ring::repeated(&chain("RLRLRL", 2), 2).is_none());
        assert_eq!(Ring::whole(chain("RL", 1)).doubled(), Some(Ring::whole(chain("RLRL", 2))));
    }

    /// Harmonics 1 and 2 have no mirror; 1 and 3 have a mirror half of their three forcing periods later.
    #[test]
    fn only_odd_harmonics_fold_and_halves_are_whole_periods() {
        let under = |turns, is_odd, word: &str, cycles| {
            Chain::under(Repetition { turns, is_odd: Some(is_odd) }, &word.parse().unwrap(), cycles).unwrap()
        };
        assert!(
            Ring::mirrored(&under(2, false, "RL", 2)).is_none() && Ring::mirrored(&under(1, false, "RL", 1)).is_none()
        );
        let odd = Ring::mirrored(&under(3, true, "RL", 3)).unwrap();
        assert_eq!(odd.lift(&[0.25]), [0.25, 1.75]);
        assert!(Ring::mirrored(&under(3, true, "RL", 6)).is_none());
        assert_eq!(odd.doubled(), Some(Ring::whole(under(3, true, "RL", 3))));
        assert!(Ring::repeated(&under(2, false, "RLRL", 2), 2).is_none());
        assert_eq!(Ring::repeated(&under(2, false, "RLRL", 4), 2), Some(Ring::whole(under(2, false, "RL", 2))));
    }

    #[test]
    fn a_mirrored_ring_lifts_to_the_chain() {
        let ring = Ring::mirrored(&chain("RRLL", 1)).unwrap();
        assert_eq!(ring.lift(&[0.1, 0.2]), [0.1, 0.2, 0.6, 0.7]);
    }
}
