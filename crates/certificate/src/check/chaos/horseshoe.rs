//! Check of a claimed entropy of h-sets for all parameters of a law, by words that are searched for anew (Lemmas V12, V35, V37).

use impact_pair_document::{BaseDocument, CornersDocument, Depth, EntropyDocument, ProvedHorseshoeDocument};

use super::Law;
use super::allowance::{Allowance, End};
use super::bases::HSet;
use super::judge::MAKINGS;
use super::said::{follows, is_none, sound_bases};
use super::words::{Ahead, Search, Word};
use crate::check::contact::Doubt;

/// A horseshoe that is claimed.
pub(super) struct Horseshoe<'h> {
    bases: Vec<HSet>,
    entropy: &'h EntropyDocument,
    depth: u32,
    /// The way to make chains of boxes that sufficed last.
    known: usize,
}

impl<'h> Horseshoe<'h> {
    /// Words of at most `depth` impacts between h-sets that are disjoint, of a positive entropy.
    pub fn claimed(bases: &[BaseDocument], entropy: &'h EntropyDocument, depth: Depth) -> Result<Self, Doubt> {
        if is_none(entropy) {
            return Err(Doubt::False("a horseshoe is claimed, but no entropy".into()));
        }
        Ok(Self { bases: sound_bases(bases)?, entropy, depth: depth.get(), known: 0 })
    }

    /// Returns whether words of at most the claimed number of impacts make the entropy.
    pub fn is_there(&mut self, law: &Law, work: &Allowance) -> Result<bool, End> {
        for making in (self.known..MAKINGS.len()).chain(0..self.known) {
            if self.is_proved(law, making, work)? {
                self.known = making;
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Returns whether they do so along chains of boxes made in one way, `MAKINGS[making]`.
    fn is_proved(&self, law: &Law, making: usize, work: &Allowance) -> Result<bool, End> {
        let ahead = Ahead::new();
        let mut search = Search::new(law, &self.bases, None, (&MAKINGS[making..=making], &ahead), work);
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

/// The map has the horseshoe, or why that is not so or not proved. Lemma V37
pub(super) fn is_proved(claimed: &ProvedHorseshoeDocument, law: &Law, work: &Allowance) -> Result<(), Doubt> {
    match Horseshoe::claimed(&claimed.bases, &claimed.entropy, claimed.depth)?.is_there(law, work) {
        Ok(true) => Ok(()),
        Ok(false) => Err(Doubt::open("its horseshoe is not proved again")),
        Err(_) => Err(Doubt::open("the work allowed is spent on its horseshoe")),
    }
}

/// The h-sets of one component's horseshoe have no state in common with those of another one's, or why both cannot be as claimed, or why that is not
/// proved. Lemma V37
pub(super) fn are_apart(
    own: &ProvedHorseshoeDocument,
    held: &ProvedHorseshoeDocument,
    other: usize,
) -> Result<(), Doubt> {
    let corners = |horseshoe: &ProvedHorseshoeDocument| -> Vec<CornersDocument> {
        horseshoe.bases.iter().map(|base| base.corners).collect()
    };
    let (own, held) = (corners(own), corners(held));
    let are_of = |some: &[CornersDocument], all: &[CornersDocument]| some.iter().all(|corners| all.contains(corners));
    if are_of(&own, &held) || are_of(&held, &own) {
        return Err(Doubt::False(format!("its horseshoe has the h-sets of that of components[{other}]")));
    }
    let is_apart = |corners: &CornersDocument| held.iter().all(|held| HSet::of(corners).is_apart(&HSet::of(held)));
    let open = || Doubt::Open(format!("its h-sets are not proved to be apart from those of components[{other}]"));
    own.iter().all(is_apart).then_some(()).ok_or_else(open)
}
