//! Where motions go from each part of the state space: basins of attraction, proved. Lemma A11 of `docs/proofs/global.md#A11`.

use super::Recurrence;
use super::analysis::{Analysis, Node};
use super::graph::Ends;
use crate::chaos::trap::{Cell, Grid};

/// Where the motions from a part of the state space go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Goes {
    /// All of them end in this component, an attractor.
    To(usize),
    /// The part is one of this component, which motions may stay in or leave.
    Within(usize),
    /// To one of several components, or not even that is proved.
    Undecided,
}

/// A rectangle of states.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// Bounds of phases, in forcing periods, from 0 to 1.
    pub phases: [f64; 2],
    /// Bounds of speeds before the impact, over `A W`.
    pub speeds: [f64; 2],
    /// Where its motions go.
    pub goes: Goes,
}

/// What is proved of the basin of an attractor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Basin {
    /// The attractor, by its place among the components.
    pub component: usize,
    /// A lower bound of the part of the state space, of speeds that motions have in the end, that its motions fill.
    pub area: f64,
}

/// Returns the basins of all attractors, as far as they are proved. Lemma A11
pub(super) fn basins(components: &[Recurrence], patches: &[Patch], fastest: f64) -> Vec<Basin> {
    let attractors = (0..components.len()).filter(|&i| components[i].kind.is_attractor());
    let basin = |component: usize| {
        let is_own = |patch: &&Patch| patch.goes == Goes::To(component);
        if patches.iter().all(|patch| is_own(&patch)) {
            return Basin { component, area: 1.0 };
        }
        let own = patches.iter().filter(is_own);
        // A11: the sides are exact, sums are rounded down
        let sum =
            own.map(Patch::size).fold(0.0, |sum: f64, size| if sum == 0.0 { size } else { (sum + size).next_down() });
        Basin { component, area: (sum / fastest).next_down().max(0.0) } // A11: no area is negative
    };
    attractors.map(basin).collect()
}

impl Patch {
    /// Phases times speeds. Lemma A11: sides are multiples of powers of two
    fn size(&self) -> f64 {
        let [across, along] = [self.phases, self.speeds].map(|[low, high]| high - low); // exact: multiples of a power of two
        across * along
    }
}

/// What is placed: the components, the place of each node that is left, and the patches so far.
struct Placed<'p> {
    components: &'p [Recurrence],
    places: Vec<usize>,
    patches: Vec<Patch>,
}

impl Analysis<'_> {
    /// Returns the state space in rectangles, each with where its motions go. Lemma A11
    pub fn patches(&self, components: &[Recurrence]) -> Vec<Patch> {
        let mut placed = Placed { components, places: self.places(), patches: Vec::new() };
        self.place(0, &[], &mut placed);
        placed.patches
    }

    /// Adds the patches of a node, from which motions may leave for some components besides its own.
    fn place(&self, node: usize, outside: &[usize], placed: &mut Placed<'_>) {
        let Node { component, split, .. } = &self.nodes[node];
        let Some(split) = split else {
            let own = placed.places[node];
            let is_basin = component.is_closed && placed.components[own].kind.is_attractor();
            let goes = if is_basin { Goes::To(own) } else { Goes::Within(own) };
            component.cells.iter().for_each(|&cell| placed.add(component.grid, cell, goes));
            return;
        };
        let places = |child: usize| self.leaves(split.children[child]).into_iter().map(|leaf| placed.places[leaf]);
        let of_children: Vec<Vec<usize>> = (0..split.children.len()).map(|child| places(child).collect()).collect();
        let goes: Vec<Goes> =
            split.found.ends.iter().map(|ends| goes(ends, &of_children, outside, placed.components)).collect();
        split.found.passed.iter().for_each(|&(cell, ends)| placed.add(split.grid, cell, goes[ends]));
        for (i, &child) in split.children.iter().enumerate() {
            let led = split.found.leads[i].iter().enumerate().filter(|&(j, &leads)| leads && j != i);
            let mut beyond: Vec<usize> = led.flat_map(|(j, _)| of_children[j].iter().copied()).collect();
            if !self.nodes[child].component.is_closed {
                beyond.extend(outside);
            }
            self.place(child, &beyond, placed);
        }
    }
}

/// Where all motions go that have such ends. Lemma A11
fn goes(ends: &Ends, of_children: &[Vec<usize>], outside: &[usize], components: &[Recurrence]) -> Goes {
    let inside = ends.components.iter().flat_map(|&child| &of_children[child as usize]); // exact: an index
    let beyond = outside.iter().filter(|_| ends.leaves);
    let mut all: Vec<usize> = inside.chain(beyond).copied().collect();
    all.sort_unstable();
    all.dedup();
    match all[..] {
        [one] if components[one].kind.is_attractor() => Goes::To(one),
        _ => Goes::Undecided,
    }
}

impl Placed<'_> {
    /// Adds a box, to the patch below it if both go to the same.
    fn add(&mut self, grid: Grid, (column, row): Cell, goes: Goes) {
        let columns = grid.columns as f64; // exact: a power of two
        let phases = [f64::from(column) / columns, f64::from(column + 1) / columns];
        let speeds = [f64::from(row) / grid.rows, f64::from(row + 1) / grid.rows];
        match self.patches.last_mut() {
            Some(last) if last.goes == goes && last.phases == phases && last.speeds[1] == speeds[0] => {
                last.speeds[1] = speeds[1];
            }
            _ => self.patches.push(Patch { phases, speeds, goes }),
        }
    }
}
