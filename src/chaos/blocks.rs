//! Words as they are told, and two of them that follow one another in any order.

use super::words::Path;
use crate::mapping::Mapping;
use crate::pair::Wall;

/// A way of the reduced map from one base across another, proved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Word {
    /// The base it starts in.
    pub from: usize,
    /// The one it crosses.
    pub to: usize,
    /// Where its impacts are if it starts on the left wall.
    pub walls: Vec<Wall>,
    /// How many half cycles it takes.
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

    /// In mappings, the first one right-most, as the paper writes them.
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
}

/// The shortest two words that may follow one another in any order.
pub(super) fn horseshoe(words: &[Word], bases: usize) -> Option<[&Word; 2]> {
    let mut names: Vec<&Word> = Vec::new();
    for word in words {
        if names.iter().all(|other| other.walls != word.walls) {
            names.push(word);
        }
    }
    names.sort_by_key(|word| word.walls.len());
    let mut pairs: Vec<[&Word; 2]> =
        names.iter().enumerate().flat_map(|(k, &a)| names[k + 1..].iter().map(move |&b| [a, b])).collect();
    pairs.sort_by_key(|[a, b]| (b.walls.len(), a.walls.len()));
    pairs.into_iter().find(|pair| is_free(words, bases, pair))
}

/// Whether there are bases from each of which both lead to such a base.
fn is_free(words: &[Word], bases: usize, pair: &[&Word; 2]) -> bool {
    let mut alive = vec![true; bases];
    loop {
        let leads = |base: usize, name: &Word| {
            words.iter().any(|word| word.from == base && alive[word.to] && word.walls == name.walls)
        };
        let next: Vec<bool> =
            (0..alive.len()).map(|base| alive[base] && pair.iter().all(|name| leads(base, name))).collect();
        if next == alive {
            return alive.contains(&true);
        }
        alive = next;
    }
}
