//! A closed chain of impacts: its word, and how long it takes.

use super::shaking::Repetition;
use crate::Error;
use crate::mapping::Word;
use crate::pair::Wall;

/// A closed word of `k` impacts that repeats after `cycles` forcing periods. **Equations** (29), (33), (36), (52)-(56)
///
/// Unknowns are the phases `u_0 < u_1 < ... < u_{k-1} < u_0 + cycles` in forcing periods, in time order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chain {
    walls: Vec<Wall>,
    cycles: u32,
    repetition: Repetition,
}

/// The greatest number of cycles of a chain.
pub const MOST_CYCLES: u32 = 1_000_000;

impl Chain {
    /// Chain of a word that closes after `cycles` cycles of one harmonic.
    ///
    /// # Errors
    /// If the word does not end on the wall it starts from, or `cycles` is not in 1 to [`MOST_CYCLES`].
    pub fn new(word: &Word, cycles: u32) -> Result<Self, Error> {
        Self::under(Repetition::ONE_PERIOD, word, cycles)
    }

    /// Chain of a word that closes after `cycles` periods of the fastest harmonic.
    ///
    /// # Errors
    /// If the word does not end on the wall it starts from, or `cycles` is not in 1 to [`MOST_CYCLES`] or no multiple of the common period.
    pub fn under(repetition: Repetition, word: &Word, cycles: u32) -> Result<Self, Error> {
        if !word.is_closed() {
            return Err(open(word));
        }
        if !(1..=MOST_CYCLES).contains(&cycles) {
            return Err(not_so_many(cycles, &format!("must lie in [1, {MOST_CYCLES}]")));
        }
        if !cycles.is_multiple_of(repetition.turns) {
            let period = repetition.turns;
            let accepted =
                format!("must be a multiple of {period}: only after {period} periods of the fastest harmonic");
            return Err(not_so_many(cycles, &format!("{accepted} do all phases repeat")));
        }
        Ok(Self { walls: word.mappings().iter().map(|mapping| mapping.walls().0).collect(), cycles, repetition })
    }

    /// Chain of another word under the same excitation.
    ///
    /// # Errors
    /// Those of [`under`](Self::under).
    pub fn another(&self, word: &Word, cycles: u32) -> Result<Self, Error> {
        Self::under(self.repetition, word, cycles)
    }

    /// Wall of each impact, in time order.
    pub fn walls(&self) -> &[Wall] {
        &self.walls
    }

    /// Forcing periods after which the chain closes.
    pub fn cycles(&self) -> u32 {
        self.cycles
    }

    /// Forcing periods after which the excitation repeats: 1 with one harmonic.
    pub fn period(&self) -> u32 {
        self.repetition.turns
    }

    /// Forcing periods after which the mirrored motion is also a motion: half a period, where the harmonics are odd. Lemma T6
    pub fn mirror(&self) -> Option<f64> {
        (self.repetition.is_odd == Some(true)).then(|| f64::from(self.repetition.turns) / 2.0)
    }

    /// Whether it is decided for all parameters at once if such a mirror exists. Lemma T6
    pub fn is_mirror_decided(&self) -> bool {
        self.repetition.is_odd.is_some()
    }

    /// Number of impacts.
    pub fn impacts(&self) -> usize {
        self.walls.len()
    }

    /// Whether both walls are hit.
    pub fn crosses(&self) -> bool {
        self.walls.iter().any(|&wall| wall != self.walls[0])
    }

    /// Index of the impact after impact `i`.
    #[inline(always)]
    pub fn next(&self, i: usize) -> usize {
        if i + 1 == self.walls.len() { 0 } else { i + 1 }
    }

    /// Index of the impact before impact `i`.
    #[inline(always)]
    pub fn previous(&self, i: usize) -> usize {
        if i == 0 { self.walls.len() - 1 } else { i - 1 }
    }

    /// `D` of flight `i` in gaps: 1 to the right (P2), -1 to the left (P1), 0 back to its wall (P3, P4).
    #[inline(always)]
    pub fn displacement(&self, i: usize) -> f64 {
        (self.walls[i].sign() - self.walls[self.next(i)].sign()) / 2.0
    }
}

fn open(word: &Word) -> Error {
    let accepted = "words that end on the wall they start from, such as \"P2 P1\"";
    Error::word(format!("the word is \"{word}\", but accepted are {accepted}"))
}

fn not_so_many(cycles: u32, accepted: &str) -> Error {
    Error::out_of_range(None, format!("the number of cycles is {cycles}, but {accepted}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ErrorKind;
    use crate::mapping::Mapping;

    #[test]
    fn words_that_do_not_close_and_cycles_out_of_range_are_refused() {
        let open = Word::new(vec![Mapping::P2]).unwrap();
        assert!(Chain::new(&open, 1).unwrap_err().kind() == ErrorKind::Word);
        let closed: Word = "P2 P1".parse().unwrap();
        assert!(
            Chain::new(&closed, 0).unwrap_err().kind() == ErrorKind::OutOfRange
                && Chain::new(&closed, MOST_CYCLES + 1).is_err()
        );
    }
}
