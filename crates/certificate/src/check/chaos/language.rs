//! Numbers of words of walls that the motions in a region can make (Lemma V16).

use std::collections::{BTreeMap, HashMap, HashSet};
use std::ops::Range;

use impact_pair_document::WallWordsDocument;
use impact_pair_exact::Real;
use impact_pair_model::watch::Watch;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::Law;
use super::entropy::exponential;
use super::guess::Guess;
use super::region::Region;
use crate::check::blocks::{BLOCK_SIZE, in_blocks};
use crate::check::contact::Doubt;

/// Numbers of halvings of boxes for their edges, tried in this order.
const HALVINGS: [u32; 3] = [2, 4, 6];
/// Longer words are not counted.
const MAX_LENGTH: u32 = 1000;
/// Members of all sets together, and boxes that are looked at, of which there are no more.
const MAX_MEMBERS: usize = 1 << 26;
const MAX_BOX_VISITS: u64 = 1 << 33;
/// Bits of powers.
const BITS: u32 = 256;
/// Steps towards a vector.
const POWER_ITERATIONS: u32 = 4000;

/// The sets of boxes that words lead to, numbered from that of all boxes on, and to which ones they lead by each letter.
pub(super) struct Sets {
    next: Vec<Vec<usize>>,
}

/// Proves the claimed number of words and their entropy on a graph of its own: the boxes are cut finer until they are proved.
pub(super) fn says_what_holds(
    claimed: &WallWordsDocument,
    (law, guess): (&Law, &Guess),
    region: &Region,
    boxes: &[[i64; 2]],
    watch: &dyn Watch,
) -> Result<(), Doubt> {
    let WallWordsDocument { impacts, count, entropy_at_most } = claimed;
    if !(1..=MAX_LENGTH).contains(impacts) {
        return Err(Doubt::Open(format!("words.impacts: only words of 1 to {MAX_LENGTH} impacts are counted")));
    }
    let mut open = "words: it is not proved where the flights lead";
    for halvings in HALVINGS {
        let of_block = |block: Range<usize>| {
            block
                .map(|k| if watch.goes_on() { region.reached(law, guess, boxes[k], halvings) } else { None }.ok_or(()))
                .collect()
        };
        let Ok(edges) = in_blocks(0..boxes.len(), BLOCK_SIZE, of_block, |_| ()) else { break };
        let Some(sets) = Sets::of(&edges) else { continue };
        let counts = sets.counts(*impacts);
        open = if counts.last().is_none_or(|own| BigRational::from_integer(own.clone()) > count.value()) {
            "words.count: it is not proved that there are no more words"
        } else if !is_above(&sets, &counts, &entropy_at_most.value()) {
            "words.entropy_at_most is not proved"
        } else {
            return Ok(());
        };
    }
    Err(Doubt::open(open))
}

/// Returns whether the number of words is proved to grow by a factor of `e^h` at most.
pub(super) fn is_above(sets: &Sets, counts: &[BigInt], h: &BigRational) -> bool {
    if *h >= BigRational::one() {
        return true; // V16: there are two letters
    }
    if *h < BigRational::zero() {
        return false; // exact: nothing is proved
    }
    let q = exponential(&Real::rational(h, BITS));
    let mut power = Real::int(1, BITS);
    let is_power = counts.iter().any(|count| {
        power = power.clone() * &q;
        let excess = power.clone() - &Real::rational(&BigRational::from_integer(count.clone()), BITS);
        !excess.enclosure().inf().sign().is_lt()
    });
    is_power || sets.grow_by(&q)
}

impl Sets {
    /// Returns the sets for the boxes that each box leads to, by letters; `None` if there are too many.
    pub fn of(edges: &[[Vec<u32>; 2]]) -> Option<Self> {
        let all: Vec<u32> = (0..edges.len() as u32).collect(); // exact: no more boxes than are judged
        let (mut members, mut looks) = (all.len(), 0u64);
        let mut numbers = HashMap::from([(all.clone(), 0)]);
        let (mut open, mut next) = (vec![all], Vec::new());
        while next.len() < open.len() {
            let from = std::mem::take(&mut open[next.len()]);
            let mut own = Vec::new();
            for letter in [0, 1] {
                let mut is_in = vec![false; edges.len()];
                let reached = from.iter().flat_map(|&cell| &edges[cell as usize][letter]); // exact: an index
                for &to in reached {
                    is_in[to as usize] = true; // exact: an index
                    looks += 1;
                }
                let to: Vec<u32> = (0..).zip(&is_in).filter(|(_, is_in)| **is_in).map(|(cell, _)| cell).collect();
                if to.is_empty() {
                    continue;
                }
                let new = numbers.len();
                let number = *numbers.entry(to.clone()).or_insert(new);
                if number == new {
                    members += to.len();
                    open.push(to);
                }
                own.push(number);
            }
            next.push(own);
            if members > MAX_MEMBERS || looks > MAX_BOX_VISITS {
                return None;
            }
        }
        Some(Self { next })
    }

    /// The number of words of 1, 2, ... letters.
    pub fn counts(&self, letters: u32) -> Vec<BigInt> {
        // Of words from each set on, one letter longer each time.
        let mut from = vec![BigInt::one(); self.next.len()];
        let longer = |_| {
            from = self.next.iter().map(|next| next.iter().map(|&to| &from[to]).sum()).collect();
            from[0].clone()
        };
        (0..letters).map(longer).collect()
    }

    /// Returns whether, for a vector without zero members, none of the sums over the next sets in the same part is more than `q` times its member.
    fn grow_by(&self, q: &Real) -> bool {
        let parts = self.parts();
        let inside: Vec<Vec<usize>> = self
            .next
            .iter()
            .enumerate()
            .map(|(from, next)| next.iter().copied().filter(|&to| parts[to] == parts[from]).collect())
            .collect();
        let vector = eigenvector(&inside, &parts);
        let exact = |x: f64| Real::rational(&BigRational::from_float(x).expect("a finite double"), BITS);
        inside.iter().zip(&vector).all(|(next, x)| {
            let sum = next.iter().fold(Real::zero(BITS), |sum, &to| sum + &exact(vector[to]));
            !(q.clone() * &exact(*x) - &sum).enclosure().inf().sign().is_lt()
        })
    }

    /// The strongly connected part of each set, named by its first one.
    fn parts(&self) -> Vec<usize> {
        let mut back = vec![Vec::new(); self.next.len()];
        for (from, next) in self.next.iter().enumerate() {
            next.iter().for_each(|&to| back[to].push(from));
        }
        let mut part = vec![usize::MAX; self.next.len()];
        for root in 0..self.next.len() {
            if part[root] != usize::MAX {
                continue;
            }
            let is_open = |at: usize| part[at] == usize::MAX;
            let (forth, round) = (reach(root, &self.next, is_open), reach(root, &back, is_open));
            forth.into_iter().filter(|at| round.contains(at)).for_each(|at| part[at] = root);
        }
        part
    }
}

/// The nodes that a node leads to, itself included, through nodes that are open.
fn reach(root: usize, next: &[Vec<usize>], is_open: impl Fn(usize) -> bool) -> HashSet<usize> {
    let (mut seen, mut open) = (HashSet::from([root]), vec![root]);
    while let Some(at) = open.pop() {
        open.extend(next[at].iter().copied().filter(|&to| is_open(to) && seen.insert(to)));
    }
    seen
}

/// A vector of positive doubles, about that of the greatest eigenvalue of each part: any will do.
fn eigenvector(inside: &[Vec<usize>], parts: &[usize]) -> Vec<f64> {
    let mut vector = vec![1.0f64; inside.len()];
    for _ in 0..POWER_ITERATIONS {
        let image: Vec<f64> =
            inside.iter().zip(&vector).map(|(next, x)| x + next.iter().map(|&to| vector[to]).sum::<f64>()).collect();
        let mut most: BTreeMap<usize, f64> = BTreeMap::new();
        for (part, x) in parts.iter().zip(&image) {
            let most = most.entry(*part).or_insert(*x);
            *most = most.max(*x); // proposes: a size
        }
        // proposes: any positive vector
        vector = image.iter().zip(parts).map(|(x, part)| (x / most[part]).max(1e-300)).collect();
    }
    vector
}
