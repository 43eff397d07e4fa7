//! Boxes as a graph of what may follow, and its recurrent components (Lemma V20, graph).

use super::super::span::Span;
use super::space::{Grid, Next, Space};
use crate::check::blocks::{BLOCK, in_blocks};
use impact_pair_model::watch::{Stage, Watch};

/// Boxes of a grid, in order, and the release, if it is among them.
#[derive(Clone, Debug)]
pub(super) struct Set {
    pub grid: Grid,
    pub cells: Vec<[i64; 2]>,
    pub has_release: bool,
}

/// Phase and speed of the first impact after a release; `None` where the ball rests again, and is released in the same state.
pub(super) type Released = Option<[Span; 2]>;

impl Set {
    /// Returns the recurrent components; `None` where it was stopped. What leaves the set is left out.
    pub fn recurrent(&self, space: &Space<'_>, released: &Released, watch: &dyn Watch) -> Option<Vec<Self>> {
        let count = self.cells.len();
        let number = |cell: &[i64; 2]| self.cells.binary_search(cell).ok();
        let images = |block: std::ops::Range<usize>| -> Result<Vec<Vec<(usize, bool)>>, ()> {
            if !watch.goes_on() {
                return Err(());
            }
            Ok(block.map(|k| self.follows(space, self.cells[k], &number)).collect())
        };
        let progress = |known: usize| watch.note(Stage::Region(known));
        let images = in_blocks(0..count, BLOCK, images, progress).ok()?;
        let (mut next, mut staying) = (vec![Vec::new(); count + 1], vec![Vec::new(); count]);
        for (from, images) in images.into_iter().enumerate() {
            for (to, stays) in images {
                if stays { staying[from].push(to) } else { next[from].push(to) }
            }
        }
        if self.has_release {
            match released {
                None => next[count].push(count),
                Some(state) => space.met(self.grid, *state, &mut |cell| next[count].extend(number(&cell))),
            }
        }
        // V20: boxes between which a motion may stay in its column are one node, and a motion that stays there is released
        let columns = parts(&staying);
        let size = columns.iter().max().map_or(0, |&last| last + 1);
        let mut together = vec![Vec::new(); size + 1];
        let node = |cell: usize| if cell == count { size } else { columns[cell] };
        for from in 0..=count {
            let own = next[from].iter().map(|&to| node(to));
            together[node(from)].extend(own);
            for &to in staying.get(from).into_iter().flatten() {
                let to = node(to);
                if to != node(from) {
                    together[node(from)].push(to);
                } else if self.has_release {
                    together[to].push(size);
                }
            }
        }
        together.iter_mut().for_each(|to| {
            to.sort_unstable();
            to.dedup();
        });
        let found = parts(&together);
        let components = found.iter().max().map_or(0, |&last| last + 1);
        let mut is_recurrent = vec![false; components];
        for (from, to) in together.iter().enumerate() {
            for &to in to.iter().filter(|&&to| found[to] == found[from]) {
                is_recurrent[found[to]] = true;
            }
        }
        let empty = Self { grid: self.grid, cells: Vec::new(), has_release: false };
        let mut sets = vec![empty; components];
        for (cell, place) in self.cells.iter().enumerate() {
            sets[found[node(cell)]].cells.push(*place);
        }
        sets[found[size]].has_release = self.has_release;
        Some(sets.into_iter().zip(is_recurrent).filter(|(_, is)| *is).map(|(set, _)| set).collect())
    }

    /// The nodes that may follow a box, each with whether the motion stays in its column; the release is the last one.
    fn follows(
        &self,
        space: &Space<'_>,
        cell: [i64; 2],
        number: &impl Fn(&[i64; 2]) -> Option<usize>,
    ) -> Vec<(usize, bool)> {
        let mut own = Vec::new();
        space.follows(self.grid, cell, &mut |next| match next {
            Next::Release => own.extend(self.has_release.then_some((self.cells.len(), false))),
            Next::Impact { cell, stays, .. } => own.extend(number(&cell).map(|to| (to, stays))),
        });
        own.sort_unstable();
        own.dedup();
        own
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
        Self { grid, cells, has_release: self.has_release }
    }
}

/// The strongly connected part of each node, numbered from 0 on (Tarjan's algorithm, without recursion).
fn parts(next: &[Vec<usize>]) -> Vec<usize> {
    const OPEN: usize = usize::MAX;
    let (mut index, mut low) = (vec![OPEN; next.len()], vec![0; next.len()]);
    let (mut part, mut count) = (vec![OPEN; next.len()], 0);
    let (mut stack, mut seen) = (Vec::new(), 0);
    for root in 0..next.len() {
        if index[root] != OPEN {
            continue;
        }
        let mut path = vec![(root, 0)];
        while let Some(&mut (node, ref mut tried)) = path.last_mut() {
            if *tried == 0 {
                (index[node], low[node]) = (seen, seen);
                seen += 1;
                stack.push(node);
            }
            if let Some(&to) = next[node].get(*tried) {
                *tried += 1;
                if index[to] == OPEN {
                    path.push((to, 0));
                } else if part[to] == OPEN {
                    low[node] = low[node].min(index[to]); // exact: numbers of nodes
                }
                continue;
            }
            if low[node] == index[node] {
                while let Some(member) = stack.pop() {
                    part[member] = count;
                    if member == node {
                        break;
                    }
                }
                count += 1;
            }
            path.pop();
            if let Some(&(before, _)) = path.last() {
                low[before] = low[before].min(low[node]); // exact: numbers of nodes
            }
        }
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_strongly_connected() {
        let next = vec![vec![1], vec![2], vec![0, 3], vec![4], vec![3, 5], vec![], vec![6]];
        let part = parts(&next);
        assert!(part[0] == part[1] && part[1] == part[2] && part[3] == part[4]);
        assert_eq!(part.iter().collect::<std::collections::BTreeSet<_>>().len(), 4);
    }
}
