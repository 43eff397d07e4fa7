//! The words of walls that motions in a region can make: Lemmas D30-D32 of `docs/proofs/hyperbolic.md#D30`.
//!
//! In `subsets` the words that the graph of boxes allows become the paths of a deterministic automaton; `growth` bounds how fast their
//! number grows.

mod growth;
mod subsets;
#[cfg(test)]
mod tests;

use num_bigint::BigUint;

use super::boxes::{Edge, Links, edges};
use super::law::{Law, Side};
use super::region::Trap;
use super::trap::Cell;
use crate::Error;
use crate::pair::ImpactPair;
use crate::watch::Watch;
use subsets::Subsets;
pub use subsets::Unclosed;

/// The most impacts of the words that are counted.
pub const MOST_COUNTED: u32 = 1000;

/// The letters of flights, as words have them: to the far wall, and back to the near one.
const LETTERS: [(Side, char); 2] = [(Side::Far, 'F'), (Side::Near, 'N')];

/// The boxes of a region as a graph: an edge for each flight that its boxes allow, by the wall that it ends on. Lemma D30
#[derive(Debug)]
pub struct BoxGraph {
    cells: Vec<Cell>,
    edges: Vec<Edge>,
}

impl BoxGraph {
    /// Graph of a region of a pair.
    ///
    /// # Errors
    /// As [`Trap::of`].
    pub fn of(pair: &ImpactPair, trap: &Trap) -> Result<Self, Error> {
        let law = Law::of(pair)?;
        let mut cells: Vec<Cell> = trap.region().cells.keys().copied().collect();
        cells.sort_unstable();
        let edges = edges(&law, trap.region().grid, &cells, true);
        Ok(Self { cells, edges })
    }

    /// Nodes: columns and rows of the boxes.
    pub fn boxes(&self) -> &[(i32, i32)] {
        &self.cells
    }

    /// Edges: from which box, `F` to the far wall or `N` back to the near one, to which box, by their positions among the boxes.
    pub fn edges(&self) -> impl Iterator<Item = (usize, char, usize)> {
        self.edges.iter().map(|edge| (edge.from as usize, letter(edge.side), edge.to as usize)) // exact: indices
    }

    /// For each letter, the boxes that it leads to from each box.
    fn links(&self) -> [Links; 2] {
        LETTERS.map(|(side, _)| {
            let own = self.edges.iter().filter(|edge| edge.side == side);
            Links::new(self.cells.len(), &mut own.map(|edge| (edge.from, edge.to)).collect::<Vec<_>>())
        })
    }
}

fn letter(side: Side) -> char {
    let [(_, far), (_, near)] = LETTERS;
    if side == Side::Far { far } else { near }
}

/// The words of walls that the graph of a region's boxes allows, counted.
///
/// **Enclosure**: motions with an impact in the region make, from there on and mirrored to one wall, at most [`count`](Self::count)
/// different words of `impacts` flights, `F` to the far wall and `N` back to the near one; so their growth rate, the topological entropy of
/// the words per impact, is at most [`entropy`](Self::entropy). Of P1-P4 there are at most twice as many words, as each begins on either
/// wall. Lemmas D30, D31
///
/// ```
/// use impact_pair::{Effort, Scene};
/// use impact_pair::watch::Unwatched;
/// use impact_pair::chaos::{BoxGraph, Trap, WallWords};
/// let scene = Scene::parse(r#"
///     excitation = { amplitude = 8, frequency = "pi", phase = 0 }
///     pair = { gap = 9.42497, restitution = 0.5 }
///     start = { time = 0, wall = "left", velocity = -12.56636 }
/// "#)?;
/// let trap = Trap::of(&scene, Effort::default(), &Unwatched)?.expect("a region");
/// let words = WallWords::of(&BoxGraph::of(scene.pair(), &trap)?, 22, &Unwatched).expect("few sets of boxes");
/// assert!(words.entropy() < 0.4224 && words.allows("FNFFN"));
/// # Ok::<(), impact_pair::Error>(())
/// ```
#[derive(Debug)]
pub struct WallWords {
    impacts: u32,
    counts: Vec<BigUint>,
    subsets: Subsets,
    entropy: f64,
}

impl WallWords {
    /// Counts the words of `impacts` flights, at most [`MOST_COUNTED`], that a graph allows.
    ///
    /// `watch` receives the number of sets of boxes.
    ///
    /// # Errors
    /// If there are too many sets of boxes, or it is stopped, before the words are that long.
    pub fn of(graph: &BoxGraph, impacts: u32, watch: &dyn Watch) -> Result<Self, Unclosed> {
        let subsets = Subsets::of(&graph.links(), graph.cells.len(), impacts as usize, watch)?; // exact: a small whole number
        let counts = subsets.counts(impacts as usize); // exact: a small whole number
        let limit = subsets.is_closed().then(|| growth::limit(subsets.steps()));
        let bounds = counts.iter().zip(1..).map(|(count, n)| growth::rate(count, n));
        let entropy = bounds.chain(limit).fold(f64::INFINITY, f64::min); // D30, D31: each is a bound
        Ok(Self { impacts, counts, subsets, entropy })
    }

    /// Number of impacts of the counted words.
    pub fn impacts(&self) -> u32 {
        self.impacts
    }

    /// Number of words of `impacts` impacts that the graph allows.
    pub fn count(&self) -> &BigUint {
        self.counts.last().expect("words have an impact at least")
    }

    /// Upper bound of the growth rate of the number of words, in nats per impact.
    pub fn entropy(&self) -> f64 {
        self.entropy
    }

    /// Whether all sets of boxes are found: then the graph of words holds words of all lengths.
    pub fn is_closed(&self) -> bool {
        self.subsets.is_closed()
    }

    /// Number of sets of boxes: the nodes of the graph of words.
    pub fn sets(&self) -> usize {
        self.subsets.len()
    }

    /// Edges of the graph of words, whose paths from node 0 on are the words: from which set, by which letter, to which set.
    pub fn edges(&self) -> impl Iterator<Item = (usize, char, usize)> {
        self.subsets.steps().iter().enumerate().flat_map(|(from, steps)| {
            let step = |((_, letter), to): ((Side, char), &Option<u32>)| Some((from, letter, (*to)? as usize)); // exact: an index
            LETTERS.into_iter().zip(steps).filter_map(step).collect::<Vec<_>>()
        })
    }

    /// Whether a word of `F` and `N` is allowed, as far as the sets of boxes are known.
    pub fn allows(&self, word: &str) -> bool {
        let step = |at: usize, found: char| {
            let letter = LETTERS.iter().position(|(_, letter)| *letter == found)?;
            self.subsets.steps().get(at)?[letter].map(|to| to as usize) // exact: an index
        };
        word.chars().try_fold(0, step).is_some()
    }
}
