//! The boxes of a region as a graph, and the boxes that a cycle may pass at each impact: Lemma D21.

use std::collections::BTreeMap;
use std::mem;

use crate::chaos::boxes::{Links, edges};
use crate::chaos::law::Law;
use crate::chaos::trap::{Cell, Grid, Region};
use crate::number::interval::Interval;

/// Boxes are put together to blocks until there are no more than that.
const MOST_BLOCKS: usize = 256;

/// The boxes of a region, each with those that it flies to.
pub(super) struct Graph {
    grid: Grid,
    /// The boxes, in order.
    cells: Vec<Cell>,
    next: Links,
    previous: Links,
    /// Blocks of boxes, those with the fastest impacts first; each box is in one block.
    pub blocks: Vec<Vec<u32>>,
    /// The block of each box.
    block: Vec<usize>,
}

impl Graph {
    pub fn new(law: &Law, region: &Region) -> Self {
        let grid = region.grid;
        let mut cells: Vec<Cell> = region.cells.keys().copied().collect();
        cells.sort_unstable();
        let mut pairs: Vec<(u32, u32)> =
            edges(law, grid, &cells, false).iter().map(|edge| (edge.from, edge.to)).collect();
        pairs.sort_unstable();
        pairs.dedup();
        let next = Links::new(cells.len(), &mut pairs);
        pairs.iter_mut().for_each(|(from, to)| mem::swap(from, to));
        let previous = Links::new(cells.len(), &mut pairs);
        let blocks = blocks(&cells);
        let mut block = vec![0; cells.len()];
        for (at, members) in blocks.iter().enumerate() {
            members.iter().for_each(|&cell| block[cell as usize] = at); // exact: an index
        }
        Self { grid, cells, next, previous, blocks, block }
    }

    /// Boxes that a cycle of `impacts` impacts may pass, impact by impact, from a box of `block` on. Cycles through earlier
    /// blocks are left out. `None` where there is none. Lemma D21
    pub fn layers(&self, block: usize, impacts: usize) -> Option<Vec<Layer>> {
        let forth = self.walk(&self.next, &self.blocks[block], block, impacts, None);
        let is_back = |&cell: &u32| forth[impacts][cell as usize]; // exact: an index
        let ends: Vec<u32> = self.blocks[block].iter().copied().filter(is_back).collect();
        if ends.is_empty() {
            return None;
        }
        let mut back = self.walk(&self.previous, &ends, block, impacts, Some(&forth));
        back.reverse();
        Some(back.iter().map(|layer| self.layer(layer)).collect())
    }

    /// Flags of the boxes reached after each number of steps, in this block and later ones. With `held`, read backward, only
    /// its boxes.
    fn walk(
        &self,
        links: &Links,
        from: &[u32],
        block: usize,
        steps: usize,
        held: Option<&[Vec<bool>]>,
    ) -> Vec<Vec<bool>> {
        let none = || vec![false; self.cells.len()];
        let mut layers = vec![none()];
        from.iter().for_each(|&cell| layers[0][cell as usize] = true); // exact: an index
        let mut last = from.to_vec();
        for step in 1..=steps {
            let (mut layer, mut now) = (none(), Vec::new());
            for &to in last.iter().flat_map(|&cell| links.of(cell)) {
                let at = to as usize; // exact: an index
                let is_held = held.is_none_or(|held| held[steps - step][at]);
                if !layer[at] && is_held && self.block[at] >= block {
                    layer[at] = true;
                    now.push(to);
                }
            }
            layers.push(layer);
            last = now;
        }
        layers
    }

    fn layer(&self, is_in: &[bool]) -> Layer {
        let mut start = vec![0; self.grid.columns as usize + 1]; // exact: a length
        let held = self.cells.iter().zip(is_in).filter(|(_, is_in)| **is_in);
        let rows = held.map(|(&(column, row), _)| {
            start[column as usize + 1] += 1; // exact: an index
            row
        });
        let rows = rows.collect();
        for column in 1..start.len() {
            start[column] += start[column - 1];
        }
        Layer { grid: self.grid, start, rows }
    }
}

/// Squares of boxes, the fastest first: few ways lead from the first ones back to them that pass nothing faster.
fn blocks(cells: &[Cell]) -> Vec<Vec<u32>> {
    let mut size = 1;
    loop {
        let mut blocks: BTreeMap<(i32, i32), Vec<u32>> = BTreeMap::new();
        for (i, &(column, row)) in cells.iter().enumerate() {
            blocks.entry((-(row / size), column / size)).or_default().push(i as u32); // exact: fewer than 2^32
        }
        if blocks.len() <= MOST_BLOCKS {
            return blocks.into_values().collect();
        }
        size *= 2;
    }
}

/// Boxes in which a cycle may be after a given number of impacts.
pub(super) struct Layer {
    grid: Grid,
    /// The place of the first box of each column.
    start: Vec<usize>,
    rows: Vec<i32>,
}

impl Layer {
    /// Number of columns in a forcing period.
    pub fn columns(&self) -> i64 {
        self.grid.columns
    }

    /// The rows of a column from one to another.
    fn rows(&self, column: i64, low: i32, high: i32) -> &[i32] {
        let column = column.rem_euclid(self.grid.columns) as usize; // exact: an index
        let rows = &self.rows[self.start[column]..self.start[column + 1]];
        let from = rows.partition_point(|&row| row < low);
        &rows[from..from + rows[from..].partition_point(|&row| row <= high)]
    }

    /// Rectangles, each at most `width` columns wide, that hold all states of the layer with such phases and speeds.
    pub fn parts(&self, phases: Interval, speeds: Interval, width: i64) -> Vec<[Interval; 2]> {
        let Grid { columns, rows } = self.grid;
        let per_turn = columns as f64; // exact: a power of two
        let across = [phases.inf(), phases.sup()].map(|x| (x * per_turn).floor() as i64); // D21: the box of an end
        let along = [speeds.inf(), speeds.sup()].map(|x| (x * rows).floor() as i32); // D21: the box of an end
        let cut = |[u, w]: [Interval; 2]| phases.intersection(u).zip(speeds.intersection(w)).map(|(u, w)| [u, w]);
        self.rectangles(across, along, width).into_iter().filter_map(cut).collect()
    }

    /// Rectangles, each at most `width` columns wide, that hold the boxes of these columns and rows.
    fn rectangles(&self, [first, last]: [i64; 2], [low, high]: [i32; 2], width: i64) -> Vec<[Interval; 2]> {
        let Grid { columns, rows } = self.grid;
        let per_turn = columns as f64; // exact: a power of two
        let (mut rectangles, mut held) = (Vec::new(), Vec::new());
        let mut from = first;
        while from <= last {
            let to = last.min((from.div_euclid(width) + 1) * width - 1); // D21: any columns
            held.clear();
            for column in from..=to {
                held.extend(self.rows(column, low, high).iter().map(|&row| (row, column)));
            }
            held.sort_unstable();
            for run in held.chunk_by(|a, b| b.0 - a.0 <= 1) {
                let across = run.iter().map(|&(_, column)| column);
                let [Some(left), Some(right)] = [across.clone().min(), across.max()] else { continue };
                let (bottom, top) = (f64::from(run[0].0), f64::from(run[run.len() - 1].0));
                // exact: edges of boxes
                let across = Interval::new(left as f64 / per_turn, (right + 1) as f64 / per_turn);
                let along = Interval::new(bottom / rows, (top + 1.0) / rows);
                rectangles.push([across, along]);
            }
            from = to + 1;
        }
        rectangles
    }

    /// Rectangle that holds all states of the layer with such phases and speeds.
    pub fn hull(&self, phases: Interval, speeds: Interval) -> Option<[Interval; 2]> {
        let parts = self.parts(phases, speeds, self.grid.columns);
        parts.into_iter().reduce(|[u, w], [p, q]| [u.hull(p), w.hull(q)])
    }

    /// Rectangles that hold the whole layer, with phases from 0 to 1.
    pub fn whole(&self, width: i64) -> Vec<[Interval; 2]> {
        self.rectangles([0, self.grid.columns - 1], [0, i32::MAX], width)
    }
}
