//! Boxes as a graph of what may follow, its recurrent components, and where motions go on (Lemmas V20, graph, and V27).

use std::collections::HashMap;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

use super::super::span::Span;
use super::parts::{is_acyclic_but_for, parts};
use super::space::{Grid, Next, Space};
use crate::check::blocks::{BLOCK_SIZE, in_blocks};
use crate::check::contact::Doubt;
use impact_pair_model::watch::{Stage, Watch};

/// Boxes of a grid, in order, and the release, if it is among them.
#[derive(Clone, Debug)]
pub(super) struct Set {
    pub grid: Grid,
    pub cells: Vec<[i64; 2]>,
    pub has_release: bool,
    /// True if no motion in it is in another recurrent component later.
    pub is_closed: bool,
}

/// The recurrent components of a set, and where the motions of its other boxes go.
pub(super) struct Split {
    pub components: Vec<Component>,
    /// Number of boxes with each of these ends.
    pub passed: HashMap<Ends, u64>,
    /// True if motions that stay in the set are released again and again. Lemma A10
    pub is_released_always: bool,
}

/// A recurrent component, and where its motions may go.
pub(super) struct Component {
    pub set: Set,
    pub ends: Ends,
}

/// The components, by their places, that walks lead to, and whether they may leave the set.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct Ends {
    pub components: Vec<usize>,
    pub leaves: bool,
}

/// Phase and speed of the first impact after a release; `None` where the ball rests again, and is released in the same state.
pub(super) type Released = Option<[Span; 2]>;

/// Successors of each box of a set, by numbers of boxes, and of the release, which is the last number; `staying` holds the boxes that a
/// motion reaches without leaving its column.
struct Followers {
    next: Vec<Vec<usize>>,
    staying: Vec<Vec<usize>>,
    leaves: Vec<bool>,
}

/// The graph of a set, boxes that a motion may stay between merged into one node; the release is the last node.
struct Merged {
    /// The node of each box.
    node: Vec<usize>,
    next: Vec<Vec<usize>>,
    lost: Vec<bool>,
}

impl Set {
    /// Returns the recurrent components, and where all else goes, with steps of the images taken off `work`; open where that is spent, or it
    /// was stopped.
    pub fn split(
        &self,
        space: &Space<'_>,
        released: &Released,
        work: &mut u64,
        watch: &dyn Watch,
    ) -> Result<Split, Doubt> {
        let merged = self.merged(self.followers(space, released, work, watch)?);
        let Merged { node, next, lost } = &merged;
        let release = next.len() - 1;
        let found = parts(next);
        let (recurrent, ends) = ends(next, &found, lost);
        let is_released_always = self.has_release && is_acyclic_but_for(release, next);
        let mut split = Split { components: Vec::new(), passed: HashMap::new(), is_released_always };
        for (place, &part) in recurrent.iter().enumerate() {
            let is_alone = ends[part].components == [place];
            let is_closed = is_alone && (self.is_closed || !ends[part].leaves);
            let set = Self { grid: self.grid, cells: Vec::new(), has_release: found[release] == part, is_closed };
            split.components.push(Component { set, ends: ends[part].clone() });
        }
        let mut component = vec![None; ends.len()];
        recurrent.iter().enumerate().for_each(|(place, &part)| component[part] = Some(place));
        for (cell, &node) in self.cells.iter().zip(node) {
            let part = found[node];
            match component[part] {
                Some(own) => split.components[own].set.cells.push(*cell),
                None => *split.passed.entry(ends[part].clone()).or_default() += 1,
            }
        }
        Ok(split)
    }

    /// Returns the successors of the boxes and of the release, with steps of the images taken off `work`.
    fn followers(
        &self,
        space: &Space<'_>,
        released: &Released,
        work: &mut u64,
        watch: &dyn Watch,
    ) -> Result<Followers, Doubt> {
        let count = self.cells.len();
        let number = |cell: &[i64; 2]| self.cells.binary_search(cell).ok();
        let (mut next, mut staying) = (vec![Vec::new(); count + 1], vec![Vec::new(); count]);
        let mut leaves = vec![false; count + 1];
        for (from, images) in self.images(space, &number, work, watch)?.into_iter().enumerate() {
            for (to, stays) in images {
                match to {
                    OUTSIDE => leaves[from] = true,
                    to if stays => staying[from].push(to),
                    to => next[from].push(to),
                }
            }
        }
        if self.has_release {
            match released {
                None => next[count].push(count),
                Some(state) => space.met(self.grid, *state, &mut |cell| match number(&cell) {
                    Some(to) => next[count].push(to),
                    None => leaves[count] = true,
                }),
            }
        }
        Ok(Followers { next, staying, leaves })
    }

    /// The nodes that may follow each box, as [`Self::follows`] has them, with their steps taken off `work`.
    fn images(
        &self,
        space: &Space<'_>,
        number: &(impl Fn(&[i64; 2]) -> Option<usize> + Sync),
        work: &mut u64,
        watch: &dyn Watch,
    ) -> Result<Vec<Vec<(usize, bool)>>, Doubt> {
        // The sum is that of all boxes in any order, and so is whether it is more than allowed.
        let spent = AtomicU64::new(0);
        let images = |block: Range<usize>| -> Result<Vec<Vec<(usize, bool)>>, Doubt> {
            let image = |k: usize| {
                let (own, steps) = self.follows(space, self.cells[k], number);
                let sum = spent.fetch_add(steps, Ordering::Relaxed).saturating_add(steps); // exact: what is allowed
                let is_spent = || Doubt::open("where every motion goes: the work allowed is spent");
                if sum > *work { Err(is_spent()) } else { Ok(own) }
            };
            if !watch.goes_on() {
                return Err(Doubt::open("interrupted"));
            }
            block.map(image).collect()
        };
        let progress = |known: usize| watch.note(Stage::Region(known));
        let images = in_blocks(0..self.cells.len(), BLOCK_SIZE, images, progress)?;
        *work -= spent.into_inner();
        Ok(images)
    }

    /// The graph of the set.
    fn merged(&self, Followers { next, staying, leaves }: Followers) -> Merged {
        // V20: boxes between which a motion may stay in its column are one node, and a motion that stays there is released
        let mut node = parts(&staying);
        let release = node.iter().max().map_or(0, |&last| last + 1);
        node.push(release);
        let mut together = vec![Vec::new(); release + 1];
        let mut lost = vec![false; release + 1];
        for (from, own) in node.iter().copied().enumerate() {
            lost[own] |= leaves[from];
            together[own].extend(next[from].iter().map(|&to| node[to]));
            for &to in staying.get(from).into_iter().flatten() {
                let to = node[to];
                if to != own {
                    together[own].push(to);
                } else if self.has_release {
                    together[to].push(release);
                } else {
                    lost[to] = true;
                }
            }
        }
        together.iter_mut().for_each(|to| {
            to.sort_unstable();
            to.dedup();
        });
        Merged { node, next: together, lost }
    }

    /// The nodes that may follow a box, each with whether the motion stays in its column, and the steps it took; the release is the last
    /// one of the set.
    fn follows(
        &self,
        space: &Space<'_>,
        cell: [i64; 2],
        number: &impl Fn(&[i64; 2]) -> Option<usize>,
    ) -> (Vec<(usize, bool)>, u64) {
        let mut own = Vec::new();
        let steps = space.follows(self.grid, cell, &mut |next| match next {
            Next::Release => own.push((if self.has_release { self.cells.len() } else { OUTSIDE }, false)),
            Next::Impact { cell, stays, .. } => own.push((number(&cell).unwrap_or(OUTSIDE), stays)), // exact: no box of the set
        });
        own.sort_unstable();
        own.dedup();
        (own, steps)
    }

    /// Returns the same with each box cut in two, across its longer side.
    pub fn halved(&self) -> Self {
        let Grid { columns, rows } = self.grid;
        let is_wide = std::f64::consts::TAU * rows > columns; // V20: any boxes
        let halves = |&[column, row]: &[i64; 2]| match is_wide {
            true => [[2 * column, row], [2 * column + 1, row]],
            false => [[column, 2 * row], [column, 2 * row + 1]],
        };
        let mut cells: Vec<_> = self.cells.iter().flat_map(halves).collect();
        cells.sort_unstable();
        let grid = if is_wide { Grid { columns: 2.0 * columns, rows } } else { Grid { columns, rows: 2.0 * rows } };
        Self { grid, cells, ..*self }
    }
}

/// Stands for all nodes that are not in a set.
const OUTSIDE: usize = usize::MAX;

/// The recurrent ones of the parts of a graph, and of each part the recurrent ones that walks lead to, by their places, and whether
/// they may be lost.
fn ends(next: &[Vec<usize>], part: &[usize], lost: &[bool]) -> (Vec<usize>, Vec<Ends>) {
    let count = part.iter().max().map_or(0, |&last| last + 1);
    let mut nodes = vec![Vec::new(); count];
    part.iter().enumerate().for_each(|(node, &own)| nodes[own].push(node));
    let (mut recurrent, mut ends) = (Vec::new(), vec![Ends::default(); count]);
    // A part comes after those that it leads to.
    for own in 0..count {
        let to = || nodes[own].iter().flat_map(|&node| &next[node]).map(|&to| part[to]);
        let mut all = Ends { components: Vec::new(), leaves: nodes[own].iter().any(|&node| lost[node]) };
        let mut seen: Vec<usize> = to().filter(|&other| other != own).collect();
        seen.sort_unstable();
        seen.dedup();
        for other in seen {
            all.components.extend(&ends[other].components);
            all.leaves |= ends[other].leaves;
        }
        if to().any(|other| other == own) {
            all.components.push(recurrent.len());
            recurrent.push(own);
        }
        all.components.sort_unstable();
        all.components.dedup();
        ends[own] = all;
    }
    (recurrent, ends)
}
