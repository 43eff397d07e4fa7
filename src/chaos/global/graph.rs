//! Boxes as a graph of what may follow: its recurrent components, and which lead to which. Lemmas A3, A6, A10 of `docs/proofs/global.md#A3`.

use std::collections::HashMap;
use std::sync::atomic::{AtomicU64, Ordering};

use super::image::{Next, Space};
use super::walks::Walks;
use crate::chaos::boxes::{Links, parts};
use crate::chaos::trap::{Cell, Grid};
use crate::threads;
use crate::watch::{Stage, Watch};

/// A set of boxes of one grid that motions may stay in for ever, and the release, if it is among them.
#[derive(Clone, Debug)]
pub(super) struct Component {
    pub grid: Grid,
    /// The boxes, in order.
    pub cells: Vec<Cell>,
    pub has_release: bool,
    /// `true` if all motions with an impact in it are in it in the end.
    pub is_closed: bool,
}

impl Component {
    /// Columns of the component's boxes, in order.
    pub fn columns(&self) -> Vec<i32> {
        let mut columns: Vec<i32> = self.cells.iter().map(|(column, _)| *column).collect();
        columns.dedup();
        columns
    }
}

/// The next state, or a bound of it, of a ball that is released.
#[derive(Clone, Debug)]
pub(super) enum Release {
    /// The ball rests again, and is released in the same state.
    Repeats,
    /// Phases, in forcing periods, and speeds of the ball's next impact, or of one that it is proved to have later.
    Lands([f64; 2], [f64; 2]),
}

/// Boxes and the boxes that may follow each. The last node is the release.
pub(super) struct Graph {
    grid: Grid,
    cells: Vec<Cell>,
    next: Links,
    /// The box that each is put together with, where motions may stay in one column.
    merged: Vec<u32>,
    /// For each box, and last the release: whether something that is not among them may follow.
    leaves: Vec<bool>,
}

/// Recurrent components of a graph, the components that each one leads to, and the ends of motions from all other boxes.
pub(super) struct Recurrent {
    pub components: Vec<Component>,
    /// `leads[i][j]`: whether component `i` leads to component `j`.
    pub leads: Vec<Vec<bool>>,
    /// Boxes outside all components, in order, each with the index of its ends: the components that walks lead to.
    pub passed: Vec<(Cell, usize)>,
    pub ends: Vec<Vec<u32>>,
}

/// The reason why a graph is not computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stopped {
    Interrupted,
    /// The images take more work than is allowed.
    Spent,
}

/// Allowed work of images, and the work that all threads have done.
struct Allowance {
    most: u64,
    done: AtomicU64,
}

impl Allowance {
    /// Adds the work of a box: whether a sum exceeds the allowed work depends on the boxes alone, not on the threads.
    fn add(&self, work: u64) -> Result<(), Stopped> {
        let before = self.done.fetch_add(work, Ordering::Relaxed);
        if before.saturating_add(work) > self.most { Err(Stopped::Spent) } else { Ok(()) } // exact: a count
    }
}

/// Edges from the boxes of a share, each with whether it stays in one column, and the boxes that something outside may follow.
type Share = (Vec<(u32, u32, bool)>, Vec<u32>);

impl Graph {
    /// Builds the image graph of `component`'s boxes and of the release, and returns its work; fails when it takes more than `allowed` work.
    pub fn of(
        space: &Space,
        component: &Component,
        release: &Release,
        allowed: u64,
        watch: &dyn Watch,
    ) -> Result<(Self, u64), Stopped> {
        let allowance = Allowance { most: allowed, done: AtomicU64::new(0) };
        let Component { grid, cells, has_release, .. } = component;
        let count = cells.len() as u32; // exact: fewer than 2^32
        let columns = component.columns();
        let found = threads::each(&threads::shares(cells), &|share| {
            images(space, (*grid, &columns), cells, *share, &allowance, watch)
        });
        let mut leaves = vec![false; cells.len() + 1];
        let (mut edges, mut staying) = (Vec::new(), Vec::new());
        for own in found {
            let (own, left): Share = own?;
            left.into_iter().for_each(|from| leaves[from as usize] = true); // exact: an index
            for (from, to, stays) in own {
                if stays {
                    staying.push((from, to));
                } else {
                    edges.push((from, to));
                }
            }
        }
        if !*has_release {
            for &(from, _) in edges.iter().filter(|(_, to)| *to == count) {
                leaves[from as usize] = true; // exact: an index
            }
            edges.retain(|(_, to)| *to != count);
        } else {
            let (own, left) = released(*grid, cells, release);
            leaves[cells.len()] = left;
            edges.extend(own.into_iter().map(|to| (count, to.unwrap_or(count)))); // exact: indices
        }
        let merged = contracted(&mut edges, &staying, cells.len(), *has_release, &mut leaves);
        edges.sort_unstable();
        edges.dedup();
        let next = Links::new(cells.len() + 1, &mut edges);
        let graph = Self { grid: *grid, cells: cells.clone(), next, merged, leaves };
        Ok((graph, allowance.done.into_inner()))
    }

    /// Recurrent components: whatever stays among the boxes for ever is in one of them in the end. `is_closed`: nothing leaves the boxes of the
    /// graph. Lemma A6
    pub fn recurrent(&self, is_closed: bool) -> Recurrent {
        let count = self.cells.len() + 1;
        let Walks { parts, number, index, reached, lost } = &Walks::of(&self.next, &self.leaves);
        let recurrent: Vec<usize> = (0..parts.len()).filter(|&i| index[i].is_some()).collect();
        let mut nodes: Vec<Vec<u32>> = vec![Vec::new(); recurrent.len()];
        let (mut passed, mut ends, mut known) = (Vec::new(), Vec::new(), HashMap::new());
        for node in 0..count {
            let part = number[self.merged[node] as usize]; // exact: an index
            if let Some(k) = index[part] {
                nodes[k as usize].push(node as u32); // exact: indices
            } else if let Some(&cell) = self.cells.get(node) {
                let place = *known.entry(&reached[part]).or_insert(ends.len());
                if place == ends.len() {
                    ends.push(reached[part].clone());
                }
                passed.push((cell, place));
            }
        }
        let component = |(k, nodes): (usize, Vec<u32>)| {
            let cells = nodes.iter().filter_map(|&node| self.cells.get(node as usize).copied()).collect(); // exact: an index
            let i = recurrent[k];
            let alone = reached[i] == [k as u32]; // exact: fewer than 2^32
            let has_release = parts[i].contains(&(count - 1));
            let is_closed = alone && (is_closed || !lost[i]);
            Component { grid: self.grid, cells, has_release, is_closed }
        };
        let components = nodes.into_iter().enumerate().map(component).collect();
        let leads = recurrent.iter().map(|&i| {
            let mut row = vec![false; recurrent.len()];
            reached[i].iter().for_each(|&k| row[k as usize] = true); // exact: an index
            row
        });
        let leads = leads.collect();
        Recurrent { components, leads, passed, ends }
    }

    /// Whether motions that stay among the boxes are released infinitely often: none stays in boxes alone. Lemma A10
    pub fn is_released_always(&self) -> bool {
        let release = self.cells.len();
        let boxes = |node: usize| self.next.of(node as u32).iter().map(|&to| to as usize).filter(|&to| to != release); // exact: indices
        let forth: Vec<Vec<usize>> = (0..release).map(|node| boxes(node).collect()).collect();
        parts(&forth).iter().all(|part| part.len() == 1 && !forth[part[0]].contains(&part[0]))
    }
}

/// Edges from the boxes `some`, the first of which has the number `first`, and those boxes that something outside may follow.
fn images(
    space: &Space,
    (grid, columns): (Grid, &[i32]),
    cells: &[Cell],
    (first, some): (usize, &[Cell]),
    allowance: &Allowance,
    watch: &dyn Watch,
) -> Result<Share, Stopped> {
    let (mut edges, mut leaves) = (Vec::new(), Vec::new());
    let release = cells.len() as u32; // exact: fewer than 2^32
    let mut own: Vec<(u32, bool)> = Vec::new();
    for (i, &cell) in some.iter().enumerate() {
        if i % 256 == 0 && watch.proceed(Stage::Region(first + i)).is_break() {
            return Err(Stopped::Interrupted);
        }
        let from = (first + i) as u32; // exact: fewer than 2^32
        own.clear();
        let mut leaves_them = false;
        let work = space.images(grid, cell, columns, &mut |next| match next {
            Next::Release => own.push((release, false)),
            Next::Elsewhere => leaves_them = true,
            Next::Impact { cell, stays, .. } => match cells.binary_search(&cell) {
                Ok(to) => own.push((to as u32, stays)), // exact: fewer than 2^32
                Err(_) => leaves_them = true,
            },
        });
        allowance.add(work)?;
        own.sort_unstable();
        own.dedup();
        edges.extend(own.iter().map(|&(to, stays)| (from, to, stays)));
        if leaves_them {
            leaves.push(from);
        }
    }
    Ok((edges, leaves))
}

/// The nodes that the release leads to, `None` for itself, and whether it leads to others as well. Lemma A7
fn released(grid: Grid, cells: &[Cell], release: &Release) -> (Vec<Option<u32>>, bool) {
    let Release::Lands(phases, speeds) = release else { return (vec![None], false) };
    let columns = phases.map(|phase| (phase * grid.columns as f64).floor() as i64); // A7: the boxes of both ends
    let rows = speeds.map(|speed| (speed * grid.rows).floor() as i32); // A7: the boxes of both ends
    let (mut found, mut is_left) = (Vec::new(), false);
    for column in columns[0]..=columns[1] {
        for row in rows[0]..=rows[1] {
            let cell = (column.rem_euclid(grid.columns) as i32, row); // exact: fewer than 2^31
            match cells.binary_search(&cell) {
                Ok(to) => found.push(Some(to as u32)), // exact: fewer than 2^32
                Err(_) => is_left = true,
            }
        }
    }
    (found, is_left)
}

/// Puts boxes together that lead to one another by impacts of one wall in one column, and lets the release follow them: a motion that stays
/// there chatters completely. Returns which box each is put together with. Lemma A3
fn contracted(
    edges: &mut Vec<(u32, u32)>,
    staying: &[(u32, u32)],
    count: usize,
    has_release: bool,
    leaves: &mut [bool],
) -> Vec<u32> {
    let mut forth = vec![Vec::new(); count];
    staying.iter().for_each(|&(from, to)| forth[from as usize].push(to as usize)); // exact: indices
    let mut merged: Vec<u32> = (0..=count as u32).collect(); // exact: fewer than 2^32
    let mut is_chatter = vec![false; count + 1];
    for part in parts(&forth) {
        if part.len() > 1 || forth[part[0]].contains(&part[0]) {
            part.iter().for_each(|&node| merged[node] = part[0] as u32); // exact: fewer than 2^32
            is_chatter[part[0]] = true;
        }
    }
    edges.extend(staying.iter().copied().filter(|&(from, to)| merged[from as usize] != merged[to as usize])); // exact: indices
    for (from, to) in edges.iter_mut() {
        (*from, *to) = (merged[*from as usize], merged[*to as usize]); // exact: indices
    }
    for node in 0..count {
        let to = merged[node] as usize; // exact: an index
        leaves[to] |= leaves[node];
        if is_chatter[node] {
            if has_release {
                edges.push((node as u32, count as u32)); // exact: fewer than 2^32
            } else {
                leaves[node] = true;
            }
        }
    }
    merged
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lemma A3 (staying): boxes that impacts of one wall in one column lead to and fro between are one, which the release follows and which these
    /// impacts do not lead back to; an impact in one direction only remains an edge. Without the release the motions leave the boxes.
    #[test]
    fn r62_boxes_of_complete_chatter_are_one_that_the_release_follows() {
        // 0 and 1 to and fro, 2 to itself, 3 to 0 only; besides 1 leads to 3 by an impact elsewhere.
        let staying = [(0, 1), (1, 0), (2, 2), (3, 0)];
        let of = |has_release: bool| {
            let (mut edges, mut leaves) = (vec![(1, 3)], vec![false; 5]);
            let merged = contracted(&mut edges, &staying, 4, has_release, &mut leaves);
            edges.sort_unstable();
            (merged, edges, leaves)
        };
        let (merged, edges, leaves) = of(true);
        let (one, other) = (merged[0], merged[3]);
        assert!(merged[1] == one && merged[2] == 2 && other == 3 && merged[4] == 4);
        let mut expected = vec![(one, 3), (3, one), (one, 4), (2, 4)];
        expected.sort_unstable();
        assert_eq!((edges, leaves), (expected, vec![false; 5]));
        let (_, edges, leaves) = of(false);
        assert_eq!(edges.iter().filter(|(_, to)| *to == 4).count(), 0);
        assert!(leaves[one as usize] && leaves[2] && !leaves[3]);
    }
}
