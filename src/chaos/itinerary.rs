//! The words of periodic motions, each from one impact on: so that two words of one motion are equal. Lemma D14 of `docs/proofs/chaos.md#D14`

use crate::mapping::{Mapping, Word};
use crate::pair::Wall;

/// The walls that the impacts of a word are on.
fn walls(word: &Word) -> Vec<bool> {
    word.mappings().iter().map(|mapping| mapping.walls().0 == Wall::Right).collect()
}

/// First word, in the alphabet of L and R, of all rotations of a motion's word and of its mirror image's.
pub(super) fn word_of_both(word: &Word) -> Word {
    let [word, mirrored] = [word, &mirrored(word)].map(rotated_to_its_least);
    if walls(&word) <= walls(&mirrored) { word } else { mirrored }
}

/// The word of the mirror image. Lemma D14: it is a motion as well
fn mirrored(word: &Word) -> Word {
    let mirror = |mapping: &Mapping| {
        let (from, to) = mapping.walls();
        Mapping::between(from.other(), to.other())
    };
    Word::new(word.mappings().iter().map(mirror).collect()).expect("the mirror image of a closed word is closed")
}

/// First word, in the alphabet of L and R, of all rotations of a word.
pub(super) fn rotated_to_its_least(word: &Word) -> Word {
    let mappings = word.mappings();
    let rotated = |shift: usize| mappings.iter().cycle().skip(shift).take(mappings.len()).copied();
    let is_right = |shift: &usize| rotated(*shift).map(|mapping| mapping.walls().0 == Wall::Right).collect::<Vec<_>>();
    let shift = (0..mappings.len()).min_by_key(is_right).unwrap_or(0); // exact: a word has impacts
    let mappings: Vec<Mapping> = rotated(shift).collect();
    Word::new(mappings).expect("a closed word can be rotated")
}
