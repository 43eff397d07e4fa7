//! The two blocks of a horseshoe, judged by the listed words (Lemmas D9, V12, horseshoe).
//!
//! A block is a sequence of walls and a number of half cycles. It leads from h-set to h-set as the words do that are this block; blocks
//! that lead alike are free alike, so they are put together before pairs are looked at.

use std::collections::{BTreeMap, HashMap};

use impact_pair_model::{Mapping, Wall};

use super::words::Word;
use crate::check::contact::Doubt;

/// The pairs of h-sets that a block leads from and to: in order, none twice.
type Passages = Vec<[usize; 2]>;
/// The impacts of the longer block, and of the shorter one: the longer one counts first.
type Size = [usize; 2];

/// More pairs than these are not looked at: documents that the program writes have some hundred.
const MAX_PAIRS: usize = 1 << 20;

/// Proves that the two blocks that are named are free, and that no two blocks of fewer impacts are.
pub(super) fn says_the_shortest(named: Option<&str>, words: &[Word], bases: usize) -> Result<(), Doubt> {
    let mut blocks: HashMap<(&[bool], i64), Passages> = HashMap::new();
    for word in words {
        blocks.entry(block(word)).or_default().push([word.from, word.to]);
    }
    for passages in blocks.values_mut() {
        passages.sort_unstable();
        passages.dedup();
    }
    let mut lengths: BTreeMap<&Passages, Vec<usize>> = BTreeMap::new();
    for ((flights, _), passages) in &blocks {
        lengths.entry(passages).or_default().push(flights.len());
    }
    let open = |message: &str| Err(Doubt::open(message));
    if lengths.len() * lengths.len() > MAX_PAIRS {
        return open("the horseshoe is not checked: the graph of words has too many chains");
    }
    let shortest = shortest(lengths, bases);
    let Some(named) = named else {
        return if shortest.is_none() {
            Ok(())
        } else {
            Err(Doubt::False("two blocks are a horseshoe, but none is given".into()))
        };
    };
    let names: HashMap<String, &Word> = words.iter().map(|word| (name(word), word)).collect();
    let Some([a, b]) = block_names(named).map(|pair| pair.map(|name| names.get(name))) else {
        return open("the horseshoe is not a statement that is checked");
    };
    let (Some(a), Some(b)) = (a, b) else {
        return Err(Doubt::False("the horseshoe has a block that is none of the words".into()));
    };
    let [one, other] = [a, b].map(|word| block(word));
    let size = size(one.0.len(), other.0.len());
    if one != other && is_free([&blocks[&one], &blocks[&other]], bases) && shortest == Some(size) {
        Ok(())
    } else {
        Err(Doubt::False("the horseshoe is not one of two shortest blocks in any order".into()))
    }
}

/// Returns the size of two blocks with these numbers of impacts.
fn size(a: usize, b: usize) -> Size {
    [a.max(b), a.min(b)] // exact: lengths
}

/// The key of a block, which words with the same flights and half cycles share.
fn block(word: &Word) -> (&[bool], i64) {
    (&word.flights, word.half_cycles)
}

/// The size of the shortest two blocks that are free, of the impacts of all blocks that lead in these ways.
fn shortest(mut lengths: BTreeMap<&Passages, Vec<usize>>, bases: usize) -> Option<Size> {
    for of_ways in lengths.values_mut() {
        of_ways.sort_unstable();
    }
    let mut found: Option<Size> = None;
    for (one, these) in &lengths {
        for (other, those) in lengths.range::<&Passages, _>(one..) {
            let pair = if one == other { [these.first(), these.get(1)] } else { [these.first(), those.first()] };
            let [Some(&a), Some(&b)] = pair else { continue };
            let size = size(a, b);
            if found.is_none_or(|found| size < found) && is_free([one, other], bases) {
                found = Some(size);
            }
        }
    }
    found
}

/// Returns whether there is a set of h-sets from each of which each of two blocks leads to one of the set.
fn is_free(blocks: [&Passages; 2], bases: usize) -> bool {
    let mut alive = vec![true; bases];
    loop {
        let leads =
            |from: usize, passages: &Passages| passages.iter().any(|passage| passage[0] == from && alive[passage[1]]);
        let next: Vec<bool> =
            (0..bases).map(|base| alive[base] && blocks.iter().all(|passages| leads(base, passages))).collect();
        if next == alive {
            return alive.contains(&true);
        }
        alive = next;
    }
}

/// The names of the two blocks in the statement.
fn block_names(statement: &str) -> Option<[&str; 2]> {
    let blocks = statement.strip_prefix("each block is ")?.strip_suffix(
        ", in any order in the map mirrored to one wall: \
         each is written as it starts on the left wall, and mirrored where it starts on the right one",
    )?;
    let (a, b) = blocks.split_once(" or ")?;
    Some([a, b])
}

/// The name of the block that a word is: its mappings from the left wall, the first one right-most, and its half cycles.
fn name(word: &Word) -> String {
    let mut from = Wall::Left;
    let mut mappings = Vec::new();
    for &is_far in &word.flights {
        let to = if is_far { from.other() } else { from };
        mappings.push(Mapping::between(from, to).to_string());
        from = to;
    }
    mappings.reverse();
    let unit = if word.half_cycles == 1 { "half cycle" } else { "half cycles" };
    format!("{} ({} {unit})", mappings.join(" "), word.half_cycles)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn word(from: usize, to: usize, flights: &str, half_cycles: i64) -> Word {
        Word { from, to, half_cycles, flights: flights.chars().map(|name| name == 'F').collect() }
    }

    fn statement(a: &str, b: &str) -> String {
        format!(
            "each block is {a} or {b}, in any order in the map mirrored to one wall: \
             each is written as it starts on the left wall, and mirrored where it starts on the right one"
        )
    }

    /// The words of chaos-0.036: only the one to the right wall that takes 7 half cycles comes again to where it started with the third.
    #[test]
    fn r32_blocks_of_one_name_and_another_time() {
        let words = [word(0, 0, "F", 5), word(1, 1, "F", 7), word(1, 1, "FF", 16)];
        let says = |a: &str, b: &str| says_the_shortest(Some(&statement(a, b)), &words, 2);
        assert!(says("P2 (7 half cycles)", "P1 P2 (16 half cycles)").is_ok());
        assert!(says("P1 P2 (16 half cycles)", "P2 (7 half cycles)").is_ok());
        for (a, b) in [
            ("P2 (5 half cycles)", "P1 P2 (16 half cycles)"),
            ("P2 (5 half cycles)", "P2 (7 half cycles)"),
            ("P2 (7 half cycles)", "P2 (7 half cycles)"),
            ("P2 (7 half cycles)", "P1 P2 (14 half cycles)"),
        ] {
            assert!(matches!(says(a, b), Err(Doubt::False(_))), "{a}, {b}");
        }
        let before = says_the_shortest(Some("each block is P2 or P1 P2, in any order"), &words, 2);
        assert!(matches!(before, Err(Doubt::Open(_))), "{before:?}");
        assert!(says_the_shortest(None, &words, 2).is_err() && says_the_shortest(None, &words[..2], 2).is_ok());
    }

    /// Two longer blocks that are free are not the shortest, whichever h-sets they lead between.
    #[test]
    fn a_longer_pair_is_refused() {
        let words = [word(0, 0, "NN", 2), word(0, 0, "NNN", 3), word(1, 1, "N", 1), word(1, 1, "NNF", 3)];
        let says = |a: &str, b: &str| says_the_shortest(Some(&statement(a, b)), &words, 2);
        assert!(says("P2 P4 P4 (3 half cycles)", "P4 (1 half cycle)").is_ok());
        assert!(says("P4 P4 (2 half cycles)", "P4 P4 P4 (3 half cycles)").is_err());
    }
}
