//! The boxes of a region as a graph, whose edges are flights: Lemma D4.

use std::collections::HashSet;
use std::sync::Mutex;
use std::thread;

use super::law::{Law, Side};
use super::quad::Quad;
use super::trap::{Cell, Grid};

/// A flight from a box to a box that may exist, by their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Edge {
    pub from: u32,
    /// The wall that it ends on.
    pub side: Side,
    pub to: u32,
}

/// For each box those linked to it.
pub(super) struct Links {
    start: Vec<u32>,
    to: Vec<u32>,
}

impl Links {
    /// From pairs, in any order.
    pub fn new(count: usize, pairs: &mut [(u32, u32)]) -> Self {
        pairs.sort_unstable();
        let start = |cell: usize| pairs.partition_point(|&(from, _)| (from as usize) < cell) as u32; // exact: fewer than 2^32
        Self { start: (0..=count).map(start).collect(), to: pairs.iter().map(|&(_, to)| to).collect() }
    }

    pub fn of(&self, cell: u32) -> &[u32] {
        let cell = cell as usize; // exact: an index
        let [from, to] = [self.start[cell], self.start[cell + 1]].map(|at| at as usize); // exact: an index
        &self.to[from..to]
    }
}

/// Returns all edges between the boxes of a region, in order: the images of each, or of its quarters where `in_quarters`. Lemma D4
pub(super) fn edges(law: &Law, grid: Grid, cells: &[Cell], in_quarters: bool) -> Vec<Edge> {
    let edges = Mutex::new(Vec::new());
    let threads = thread::available_parallelism().map_or(1, usize::from); // exact: threads decide nothing
    let share = cells.len().div_ceil(threads).max(1); // exact: a length
    thread::scope(|scope| {
        for (part, some) in cells.chunks(share).enumerate() {
            let edges = &edges;
            scope.spawn(move || {
                let (mut own, mut found) = (Vec::new(), HashSet::new());
                for (i, &cell) in some.iter().enumerate() {
                    found.clear();
                    let mut note = |side, cell| _ = found.insert((side, cell));
                    for part in parts(grid, cell, in_quarters) {
                        grid.image(law, &part, &mut note).expect("all flights of a region are followed");
                    }
                    let from = (part * share + i) as u32; // exact: fewer than 2^32
                    let number = |cell| cells.binary_search(&cell).expect("a region holds its images") as u32; // exact: fewer than 2^32
                    own.extend(found.iter().map(|&(side, cell)| Edge { from, side, to: number(cell) }));
                }
                edges.lock().expect("no thread has panicked").append(&mut own);
            });
        }
    });
    let mut edges = edges.into_inner().expect("no thread has panicked");
    edges.sort_unstable();
    edges
}

/// A box, or its quarters.
fn parts(grid: Grid, (column, row): Cell, in_quarters: bool) -> Vec<Quad> {
    if !in_quarters {
        return vec![grid.quad((column, row))];
    }
    let finer = Grid { columns: 2 * grid.columns, rows: 2.0 * grid.rows };
    let quarter = |[i, j]: [i32; 2]| finer.quad((2 * column + i, 2 * row + j));
    [[0, 0], [0, 1], [1, 0], [1, 1]].map(quarter).into()
}
