//! The boxes of a region as a graph, whose edges are flights: Lemma D4.

use std::collections::HashSet;

use super::law::{Law, Side};
use super::quad::Quad;
use super::trap::{Cell, Grid};
use crate::threads;

/// A flight from a box to a box that may exist, by their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Edge {
    pub from: u32,
    /// The wall that it ends on.
    pub side: Side,
    pub to: u32,
}

/// The boxes that are linked to each box.
pub(super) struct Links {
    start: Vec<u32>,
    to: Vec<u32>,
}

impl Links {
    /// The links of pairs, in any order.
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

/// All edges between the boxes of a region, in order: images of each box, or of its quarters where `in_quarters`. Lemma D4
pub(super) fn edges(law: &Law, grid: Grid, cells: &[Cell], in_quarters: bool) -> Vec<Edge> {
    let of_share = |(first, some): &(usize, &[Cell])| {
        let mut own = Vec::new();
        for (i, &cell) in some.iter().enumerate() {
            let finer = in_quarters.then(|| images(law, grid, &quarters(grid, cell), cells)).flatten();
            // D5: the box itself is mapped into the region, whatever is computed of its quarters
            let found = finer.or_else(|| images(law, grid, &[grid.quad(cell)], cells));
            let from = (first + i) as u32; // exact: fewer than 2^32
            let found = found.expect("a region holds its images");
            own.extend(found.into_iter().map(|(side, to)| Edge { from, side, to }));
        }
        own
    };
    let mut edges = threads::each(&threads::shares(cells), &of_share).concat();
    edges.sort_unstable();
    edges
}

/// Walls and numbers of the region's boxes that meet the images of `parts`. `None` where an image lies outside the region, or
/// a flight is not followed.
fn images(law: &Law, grid: Grid, parts: &[Quad], cells: &[Cell]) -> Option<HashSet<(Side, u32)>> {
    let mut noted = HashSet::new();
    for part in parts {
        grid.image(law, part, &mut |side, cell| _ = noted.insert((side, cell))).ok()?;
    }
    let number = |(side, cell)| Some((side, cells.binary_search(&cell).ok()? as u32)); // exact: fewer than 2^32
    noted.into_iter().map(number).collect()
}

/// The quarters of a box.
fn quarters(grid: Grid, (column, row): Cell) -> [Quad; 4] {
    let finer = Grid { columns: 2 * grid.columns, rows: 2.0 * grid.rows };
    [[0, 0], [0, 1], [1, 0], [1, 1]].map(|[i, j]: [i32; 2]| finer.quad((2 * column + i, 2 * row + j)))
}

/// Strongly connected components: nodes that lead to each other, in order.
///
/// A component comes before the components that it leads to.
pub(super) fn parts(forth: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let mut back = vec![Vec::new(); forth.len()];
    for (from, to) in forth.iter().enumerate() {
        to.iter().for_each(|&to| back[to].push(from));
    }
    let mut seen = vec![false; forth.len()];
    let mut order = Vec::new();
    (0..forth.len()).for_each(|root| walk(root, forth, &mut seen, &mut order));
    seen.fill(false);
    let part = |root: &usize| {
        let mut part = Vec::new();
        walk(*root, &back, &mut seen, &mut part);
        part.sort_unstable();
        part
    };
    order.iter().rev().map(part).filter(|part| !part.is_empty()).collect()
}

/// Adds the nodes that a new one leads to, and itself as the last, each when all of its own are done.
fn walk(root: usize, next: &[Vec<usize>], seen: &mut [bool], order: &mut Vec<usize>) {
    let mut path = vec![(root, 0)];
    if seen[root] {
        return;
    }
    seen[root] = true;
    while let Some((node, tried)) = path.pop() {
        match next[node].get(tried) {
            Some(&to) => {
                path.push((node, tried + 1));
                if !seen[to] {
                    seen[to] = true;
                    path.push((to, 0));
                }
            }
            None => order.push(node),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::Exact;
    use crate::number::Ball;

    /// Of quarters more may be noted than of the box, by rounding: such edges are those of the box. A region that is not closed stands for
    /// the rounding.
    #[test]
    fn r40_images_that_are_not_in_the_region_are_none() {
        let ball = |text: &str| Ball::of(&text.parse::<Exact>().unwrap());
        let law = Law { gap: ball("1.178"), restitution: ball("0.5") };
        let grid = Grid { columns: 256, rows: 32.0 };
        let (from, mut cells) = ((10, 40), Vec::new());
        let image = |parts: &[Quad], cells: &[Cell]| images(&law, grid, parts, cells);
        grid.image(&law, &grid.quad(from), &mut |_, cell| cells.push(cell)).unwrap();
        cells.sort_unstable();
        cells.dedup();
        let whole = image(&[grid.quad(from)], &cells).unwrap();
        let parts = image(&quarters(grid, from), &cells).unwrap();
        assert!(whole.len() > 1 && whole.is_superset(&parts));
        // Without one of the boxes.
        let (_, lost) = *parts.iter().next().unwrap();
        cells.remove(lost as usize);
        assert_eq!(image(&quarters(grid, from), &cells), None);
    }
}
