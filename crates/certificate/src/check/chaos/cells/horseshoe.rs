//! Whether h-sets make a claimed entropy for all parameters of a law, by words that are searched for anew (Lemmas V12, V35).

use impact_pair_document::EntropyDocument;

use super::super::Law;
use super::super::allowance::{Allowance, End};
use super::super::bases::Base;
use super::super::judge::MAKINGS;
use super::super::said::follows;
use super::super::words::{Ahead, Search, Word};
use super::orbit::Found;

/// A horseshoe that is claimed.
pub(super) struct Horseshoe<'h> {
    bases: &'h [Base],
    entropy: &'h EntropyDocument,
    depth: usize,
    /// The way to make chains of boxes that sufficed last.
    known: usize,
}

impl<'h> Horseshoe<'h> {
    pub fn new(bases: &'h [Base], entropy: &'h EntropyDocument, depth: usize) -> Self {
        Self { bases, entropy, depth, known: 0 }
    }

    /// Whether words of at most the claimed number of impacts make the entropy.
    pub fn is_there(&mut self, law: &Law, work: &Allowance) -> Result<Found, End> {
        for making in (self.known..MAKINGS.len()).chain(0..self.known) {
            if self.is_proved(law, making, work)? {
                self.known = making;
                return Ok(Found::Proved);
            }
        }
        Ok(Found::Nothing)
    }

    /// Whether they do along chains of boxes of one kind.
    fn is_proved(&self, law: &Law, making: usize, work: &Allowance) -> Result<bool, End> {
        let ahead = Ahead::new();
        let mut search = Search::new(law, self.bases, None, (&MAKINGS[making..=making], &ahead), work);
        for _ in 0..self.depth {
            search.deepen()?;
            let each = |(word, count): (&Word, &usize)| vec![word.clone(); *count];
            let words: Vec<Word> = search.found.iter().flat_map(each).collect();
            if follows(&words, self.bases.len(), self.entropy).is_ok() {
                return Ok(true);
            }
        }
        Ok(false)
    }
}
