//! The boxes of a region as a graph, and which of them a cycle may pass when.

use std::sync::Mutex;
use std::thread;

use super::super::flights::Law;
use super::super::trap::{Cell, Grid, Region};
use crate::periodic::Interval;

/// The boxes of a region, each with those that it flies to.
pub(super) struct Graph {
    pub grid: Grid,
    /// In order.
    pub cells: Vec<Cell>,
    next: Links,
    previous: Links,
}

/// For each box those linked to it.
struct Links {
    start: Vec<u32>,
    to: Vec<u32>,
}

impl Links {
    fn of(&self, cell: u32) -> &[u32] {
        let cell = cell as usize;
        &self.to[self.start[cell] as usize..self.start[cell + 1] as usize]
    }

    /// From pairs, sorted by their first members.
    fn new(count: usize, pairs: &[(u32, u32)]) -> Self {
        let start = (0..=count).map(|cell| pairs.partition_point(|&(from, _)| (from as usize) < cell) as u32).collect();
        Self { start, to: pairs.iter().map(|&(_, to)| to).collect() }
    }
}

/// The boxes in which a cycle may be after so many impacts.
pub(super) struct Layer {
    grid: Grid,
    /// The first box of each column.
    start: Vec<u32>,
    rows: Vec<i32>,
}

impl Graph {
    pub fn new(law: &Law, region: &Region) -> Self {
        let grid = region.grid;
        let mut cells: Vec<Cell> = region.cells.keys().copied().collect();
        cells.sort_unstable();
        let pairs = Mutex::new(Vec::new());
        let threads = thread::available_parallelism().map_or(1, usize::from); // exact: threads decide nothing
        let share = cells.len().div_ceil(threads).max(1);
        thread::scope(|scope| {
            for (part, some) in cells.chunks(share).enumerate() {
                let (pairs, cells) = (&pairs, &cells);
                scope.spawn(move || {
                    let mut own = Vec::new();
                    let mut found = std::collections::HashSet::new();
                    for (i, &cell) in some.iter().enumerate() {
                        found.clear();
                        grid.image(law, &grid.quad(cell), &mut found).expect("a box of a region flies into the region");
                        let from = (part * share + i) as u32;
                        own.extend(found.iter().map(|cell| {
                            (from, cells.binary_search(cell).expect("a region holds its images") as u32)
                        }));
                    }
                    pairs.lock().expect("no thread has panicked").append(&mut own);
                });
            }
        });
        let mut pairs = pairs.into_inner().expect("no thread has panicked");
        pairs.sort_unstable();
        let next = Links::new(cells.len(), &pairs);
        pairs.iter_mut().for_each(|(from, to)| std::mem::swap(from, to));
        pairs.sort_unstable();
        let previous = Links::new(cells.len(), &pairs);
        Self { grid, cells, next, previous }
    }

    /// Where the closed ways of so many steps from one of these boxes to itself or another of them are, step by step, as far as
    /// they keep to boxes that are `allowed`; `None` where there are none.
    pub fn layers(&self, first: &[u32], allowed: &dyn Fn(u32) -> bool, steps: usize) -> Option<Vec<Layer>> {
        let count = self.cells.len();
        let walk = |links: &Links, from: &[u32], held: Option<&[Vec<bool>]>| {
            let mut layers = vec![vec![false; count]];
            from.iter().for_each(|&cell| layers[0][cell as usize] = true);
            let mut last = from.to_vec();
            for step in 1..=steps {
                let mut layer = vec![false; count];
                let mut now = Vec::new();
                for &cell in &last {
                    for &to in links.of(cell) {
                        let is_held = held.is_none_or(|held| held[steps - step][to as usize]);
                        if !layer[to as usize] && is_held && allowed(to) {
                            layer[to as usize] = true;
                            now.push(to);
                        }
                    }
                }
                layers.push(layer);
                last = now;
            }
            layers
        };
        let forth = walk(&self.next, first, None);
        let ends: Vec<u32> = first.iter().copied().filter(|&cell| forth[steps][cell as usize]).collect();
        let mut back = walk(&self.previous, &ends, Some(&forth));
        back.reverse();
        if ends.is_empty() || !back[0].iter().any(|&is_in| is_in) {
            return None;
        }
        Some(back.iter().map(|layer| self.layer(layer)).collect())
    }

    fn layer(&self, is_in: &[bool]) -> Layer {
        let mut start = vec![0; self.grid.columns as usize + 1];
        let mut rows = Vec::new();
        for (&(column, row), _) in self.cells.iter().zip(is_in).filter(|(_, is_in)| **is_in) {
            start[column as usize + 1] += 1;
            rows.push(row);
        }
        for column in 1..start.len() {
            start[column] += start[column - 1];
        }
        Layer { grid: self.grid, start, rows }
    }
}

impl Layer {
    /// How many boxes it has.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// The columns in a turn.
    pub fn columns(&self) -> i64 {
        self.grid.columns
    }

    fn rows(&self, column: i64, low: i32, high: i32) -> &[i32] {
        let column = column.rem_euclid(self.grid.columns) as usize; // exact: fewer than 2^31
        let rows = &self.rows[self.start[column] as usize..self.start[column + 1] as usize];
        let from = rows.partition_point(|&row| row < low);
        &rows[from..from + rows[from..].partition_point(|&row| row <= high)]
    }

    /// Parts of a rectangle that hold all its states in the layer, each at most so many columns wide.
    pub fn parts(&self, phases: Interval, speeds: Interval, width: i64) -> Vec<[Interval; 2]> {
        let Grid { columns, rows } = self.grid;
        let per_turn = columns as f64; // exact: a power of two
        // exact: powers of two
        let [first, last] = [phases.lo, phases.hi].map(|x| (x * per_turn).floor() as i64);
        let [low, high] = [speeds.lo, speeds.hi].map(|x| (x * rows).floor() as i32);
        let mut parts = Vec::new();
        let mut from = first;
        let mut held: Vec<(i32, i64)> = Vec::new();
        while from <= last {
            let to = last.min((from.div_euclid(width) + 1) * width - 1);
            held.clear();
            for column in from..=to {
                held.extend(self.rows(column, low, high).iter().map(|&row| (row, column)));
            }
            held.sort_unstable();
            for run in held.chunk_by(|a, b| b.0 - a.0 <= 1) {
                let columns = run.iter().map(|&(_, column)| column);
                let (left, right) = (columns.clone().min().expect("not empty"), columns.max().expect("not empty"));
                let across = Interval::new(left as f64 / per_turn, (right + 1) as f64 / per_turn);
                let along = Interval::new(f64::from(run[0].0) / rows, (f64::from(run[run.len() - 1].0) + 1.0) / rows);
                if let (Some(u), Some(w)) = (phases.cut(across), speeds.cut(along)) {
                    parts.push([u, w]);
                }
            }
            from = to + 1;
        }
        parts
    }

    /// The least rectangle found that holds all states of one that are in the layer.
    pub fn hull(&self, phases: Interval, speeds: Interval) -> Option<[Interval; 2]> {
        let parts = self.parts(phases, speeds, self.grid.columns);
        parts.into_iter().reduce(|[u, w], [p, q]| [u.hull(p), w.hull(q)])
    }
}
