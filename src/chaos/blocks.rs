//! Words as they are written, and two blocks that follow one another in any order: Lemma D9 of `docs/proofs/chaos.md#D9`.

use super::words::Path;
use crate::mapping::Mapping;
use crate::pair::Wall;

/// Proved covering relation of the reduced map from one h-set to another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Word {
    /// Index of the h-set where the covering relation starts.
    pub from: usize,
    /// Index of the covered h-set.
    pub to: usize,
    /// The walls of its impacts if it starts on the left wall.
    pub walls: Vec<Wall>,
    /// Half cycles from start to end, less the difference of the phases of the two h-sets.
    pub half_cycles: i64,
}

impl Word {
    pub(super) fn of(path: &Path) -> Self {
        let mut wall = Wall::Left;
        let walls = path.sides.iter().map(|side| {
            wall = side.lands_on(wall);
            wall
        });
        Self { walls: walls.collect(), from: path.from, to: path.to, half_cycles: path.half_turns }
    }

    /// The word's mappings, the first one right-most, as the paper writes them.
    pub fn in_mappings(&self) -> String {
        let mut from = Wall::Left;
        let mut names: Vec<String> = Vec::new();
        for &to in &self.walls {
            names.push(Mapping::between(from, to).to_string());
            from = to;
        }
        names.reverse();
        names.join(" ")
    }

    /// The word's mappings and half cycles, which name a block.
    pub fn as_block(&self) -> String {
        let unit = if self.half_cycles == 1 { "half cycle" } else { "half cycles" };
        format!("{} ({} {unit})", self.in_mappings(), self.half_cycles)
    }

    /// Whether two words are one block, whatever their h-sets: the same walls after the same number of half cycles. Lemma D9
    pub fn is_same_block(&self, other: &Self) -> bool {
        self.walls == other.walls && self.half_cycles == other.half_cycles
    }
}

/// Words of one block, and the h-sets from which and to which each word leads.
struct Block<'w> {
    word: &'w Word,
    passages: Vec<[usize; 2]>,
}

/// The shortest two blocks that may follow one another in any order in the reduced map.
pub(super) fn horseshoe(words: &[Word], bases: usize) -> Option<[&Word; 2]> {
    let mut blocks: Vec<Block<'_>> = Vec::new();
    for word in words {
        let passage = [word.from, word.to];
        match blocks.iter_mut().find(|block| block.word.is_same_block(word)) {
            Some(block) => block.passages.push(passage),
            None => blocks.push(Block { word, passages: vec![passage] }),
        }
    }
    let length = |block: &Block<'_>| block.word.walls.len();
    blocks.sort_by_key(length);
    let mut start = 0;
    // The longer one first, then the shorter one.
    for group in blocks.chunk_by(|a, b| length(a) == length(b)) {
        let end = start + group.len(); // exact: indices
        for (k, a) in blocks[..end].iter().enumerate() {
            let mut others = blocks[start.max(k + 1)..end].iter(); // exact: indices
            if let Some(b) = others.find(|b| is_free([a, b], bases)) {
                return Some([a.word, b.word]);
            }
        }
        start = end;
    }
    None
}

/// Whether a non-empty set of h-sets exists from each of which a word of each block leads into the set. Lemma D9
fn is_free(blocks: [&Block<'_>; 2], bases: usize) -> bool {
    let mut alive = vec![true; bases];
    loop {
        let leads = |from: usize, block: &Block<'_>| {
            block.passages.iter().any(|passage| passage[0] == from && alive[passage[1]])
        };
        let next: Vec<bool> =
            (0..bases).map(|base| alive[base] && blocks.iter().all(|block| leads(base, block))).collect();
        if next == alive {
            return alive.contains(&true);
        }
        alive = next;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn word(from: usize, to: usize, walls: &str, half_cycles: i64) -> Word {
        let wall = |name| if name == 'R' { Wall::Right } else { Wall::Left };
        Word { from, to, walls: walls.chars().map(wall).collect(), half_cycles }
    }

    /// The words of chaos-0.036: the two that go to the right wall differ in their time, and only one of them leads back to where it
    /// started with the third.
    #[test]
    fn r32_blocks_of_one_name_and_another_time() {
        let words = [word(0, 0, "R", 5), word(1, 1, "R", 7), word(1, 1, "RL", 16)];
        let found = horseshoe(&words, 2).unwrap();
        assert_eq!(found, [&words[1], &words[2]]);
        assert_eq!(found.map(Word::as_block), ["P2 (7 half cycles)", "P1 P2 (16 half cycles)"]);
        // Of the same walls after other times, each from one h-set to the other, no two are free.
        let apart = [word(0, 1, "R", 5), word(1, 0, "R", 7), word(0, 1, "RL", 16), word(1, 0, "RL", 14)];
        assert_eq!(horseshoe(&apart, 2), None);
        // Two times of one sequence of walls are two blocks.
        let times = [word(0, 0, "R", 5), word(0, 0, "R", 7), word(0, 0, "RL", 16)];
        assert_eq!(horseshoe(&times, 1), Some([&times[0], &times[1]]));
    }

    /// By all pairs: the shortest longer block, then the shortest shorter one.
    #[test]
    fn the_shortest_of_all_pairs() {
        let words = [word(0, 0, "RLRL", 8), word(0, 0, "RLR", 5), word(0, 0, "RR", 3), word(0, 0, "RRLL", 6)];
        assert_eq!(horseshoe(&words, 1), Some([&words[2], &words[1]]));
        assert_eq!(horseshoe(&words[..1], 1), None);
    }
}
