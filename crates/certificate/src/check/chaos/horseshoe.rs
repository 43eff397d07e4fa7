//! Check of a claimed entropy of h-sets for all parameters of a law, by the words of its witness (Lemmas V35, V37, V39).

use impact_pair_document::{
    BaseDocument, CornersDocument, Depth, EntropyDocument, ProvedHorseshoeDocument, StripDocument, WordDocument,
};
use impact_pair_model::watch::Watch;

use super::Law;
use super::allowance::End;
use super::bases::HSet;
use super::said::{follows, is_none, sound_bases};
use super::strip::left_open;
use super::words::Word;
use crate::check::contact::Doubt;

/// A horseshoe that is claimed: words of at most `depth` impacts between h-sets that are disjoint, of a positive entropy.
pub(super) struct Horseshoe<'h> {
    bases: Vec<HSet>,
    entropy: &'h EntropyDocument,
    depth: u32,
}

impl<'h> Horseshoe<'h> {
    pub fn claimed(bases: &[BaseDocument], entropy: &'h EntropyDocument, depth: Depth) -> Result<Self, Doubt> {
        if is_none(entropy) {
            return Err(Doubt::False("a horseshoe is claimed, but no entropy".into()));
        }
        Ok(Self { bases: sound_bases(bases)?, entropy, depth: depth.get() })
    }

    /// Words and strips prove it for all parameters of a law, or why that is not so.
    pub fn is_proved(
        &self,
        law: &Law,
        (words, strips): (&[WordDocument], &[StripDocument]),
        work: (u64, &dyn Watch),
    ) -> Result<(), Doubt> {
        let bases = self.bases.len();
        let read = |word: &WordDocument| Word::of(word, bases).filter(|_| word.impacts <= self.depth);
        let Some(words) = words.iter().map(read).collect::<Option<Vec<_>>>() else {
            return Err(Doubt::open("its witness has words that contradict themselves, the depth or the h-sets"));
        };
        if let Err(what) = follows(&words, bases, self.entropy) {
            return Err(Doubt::Open(format!("entropy.{what} does not follow from the words of its witness")));
        }
        match left_open(law, (&self.bases, &words), strips, work, &mut |_| {}) {
            Ok(None) => Ok(()),
            Err(End::Stopped) => Err(Doubt::open("its horseshoe is not proved again")),
            Ok(Some(_)) | Err(End::Spent) => Err(Doubt::open("its horseshoe is not proved again by its witness")),
        }
    }
}

/// The map has the horseshoe, or why that is not so or not proved. Lemma V37
pub(super) fn is_proved(claimed: &ProvedHorseshoeDocument, law: &Law, work: (u64, &dyn Watch)) -> Result<(), Doubt> {
    let horseshoe = Horseshoe::claimed(&claimed.bases, &claimed.entropy, claimed.depth)?;
    let Some(witness) = &claimed.witness else { return Err(Doubt::open("its horseshoe has no witness")) };
    horseshoe.is_proved(law, (&witness.words, &witness.strips), work)
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
