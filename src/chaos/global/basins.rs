//! Basins of attraction, proved: the attractor that the motions from each part of the state space end in. Lemma A11 of `docs/proofs/global.md#A11`.

use std::collections::{BTreeSet, HashMap};

use super::Recurrence;
use super::analysis::{Analysis, Request};
use super::graph::{Component, Graph, Recurrent};
use crate::chaos::trap::{Cell, Grid};

/// The end of the motions from a part of the state space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BasinOutcome {
    /// All of them end in this component, an attractor.
    To(usize),
    /// The part belongs to this component, drawn over the others.
    Within(usize),
    /// Not all of the motions are proved to end in one attractor.
    Undecided,
}

/// A rectangle of states.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// Bounds of phases, in forcing periods, from 0 to 1.
    pub phases: [f64; 2],
    /// Bounds of speeds before the impact, over `A W`.
    pub speeds: [f64; 2],
    /// The end of its motions.
    pub goes: BasinOutcome,
}

/// The part of the basin of an attractor that is proved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Basin {
    /// The attractor, by its place among the components.
    pub component: usize,
    /// A lower bound of the part of the state space, of speeds that motions have in the end, that its motions fill.
    pub area: f64,
}

/// Proved parts of the basins of all attractors; `None` where the state space is not among the patches. Lemma A11
pub(super) fn basins(components: &[Recurrence], patches: &[Patch], fastest: f64) -> Option<Vec<Basin>> {
    let all = || patches.iter().filter(|patch| !matches!(patch.goes, BasinOutcome::Within(_)));
    all().next()?;
    let attractors = (0..components.len()).filter(|&i| components[i].kind.is_attractor());
    let basin = |component: usize| {
        let is_own = |patch: &&Patch| patch.goes == BasinOutcome::To(component);
        if all().all(|patch| is_own(&patch)) {
            return Basin { component, area: 1.0 };
        }
        let own = all().filter(is_own).map(Patch::size);
        // A11: the sides are exact, sums are rounded down
        let sum = own.fold(0.0, |sum: f64, size| if sum == 0.0 { size } else { (sum + size).next_down() });
        Basin { component, area: (sum / fastest).next_down().max(0.0) } // A11: no area is negative
    };
    Some(attractors.map(basin).collect())
}

impl Patch {
    /// Phases times speeds. Lemma A11: sides are multiples of powers of two
    pub(super) fn size(&self) -> f64 {
        let [across, along] = [self.phases, self.speeds].map(|[low, high]| high - low); // exact: multiples of a power of two
        across * along
    }
}

impl Analysis<'_> {
    /// Boxes of all components; with `boxes`, also the state space in about that many rectangles, each with the end of its motions. Lemma A11
    pub fn patches(&self, components: &[Recurrence], boxes: Option<u32>) -> Vec<Patch> {
        let mut patches = Vec::new();
        let leaves: Vec<&Component> = self.leaves(0).into_iter().map(|leaf| &self.nodes[leaf].component).collect();
        for (place, leaf) in leaves.iter().enumerate() {
            leaf.cells.iter().for_each(|&cell| add(&mut patches, leaf.grid, cell, BasinOutcome::Within(place)));
        }
        let Some(boxes) = boxes.filter(|_| components.iter().any(|own| own.kind.is_attractor())) else {
            return patches;
        };
        let whole = self.whole(boxes);
        let Request { space, released, watch, .. } = &self.request;
        let allowed = self.request.settings.work;
        let Ok((graph, _)) = Graph::of(space, &whole, &released.next, allowed, *watch) else {
            // A11: nothing is proved of any box
            let speeds = [0.0, space.fastest()];
            patches.push(Patch { phases: [0.0, 1.0], speeds, goes: BasinOutcome::Undecided });
            return patches;
        };
        let Recurrent { components: found, leads, passed, ends } = graph.recurrent(true);
        let held = held(&found, &leaves);
        let goes = |places: &mut dyn Iterator<Item = usize>| {
            let mut all: Vec<usize> = places.flat_map(|place| held[place].iter().copied()).collect();
            all.sort_unstable();
            all.dedup();
            match all[..] {
                [one] if components[one].kind.is_attractor() => BasinOutcome::To(one),
                _ => BasinOutcome::Undecided,
            }
        };
        let of_ends: Vec<BasinOutcome> =
            ends.iter().map(|ends| goes(&mut ends.iter().map(|&place| place as usize))).collect(); // exact: an index
        let mut boxes: Vec<(Cell, BasinOutcome)> = passed.iter().map(|&(cell, ends)| (cell, of_ends[ends])).collect();
        for (own, leads) in found.iter().zip(&leads) {
            let goes = goes(&mut (0..leads.len()).filter(|&place| leads[place]));
            boxes.extend(own.cells.iter().map(|&cell| (cell, goes)));
        }
        boxes.sort_unstable_by_key(|(cell, _)| *cell);
        boxes.into_iter().for_each(|(cell, goes)| add(&mut patches, whole.grid, cell, goes));
        patches
    }
}

/// For each component of a graph, the recurrent components in which its motions can end: those whose boxes meet its boxes. Lemma A11
fn held(found: &[Component], leaves: &[&Component]) -> Vec<BTreeSet<usize>> {
    let mut held = vec![BTreeSet::new(); found.len()];
    let Some(grid) = found.first().map(|own| own.grid) else { return held };
    let boxes = || found.iter().enumerate().flat_map(|(place, own)| own.cells.iter().map(move |&cell| (cell, place)));
    let place_of: HashMap<Cell, usize> = boxes().collect();
    for (leaf, own) in leaves.iter().enumerate() {
        for &(column, row) in &own.cells {
            let met = |low: i32, size: f64| {
                let [low, high] = [low, low + 1].map(|at| f64::from(at) * size); // exact: powers of two
                (low.ceil() as i64 - 1, high.floor() as i64) // A11: those with an edge in common are among them
            };
            let across = grid.columns as f64 / own.grid.columns as f64; // exact: powers of two
            let [columns, rows] = [met(column, across), met(row, grid.rows / own.grid.rows)];
            for column in columns.0..=columns.1 {
                for row in rows.0..=rows.1 {
                    let cell = (column.rem_euclid(grid.columns) as i32, row as i32); // exact: fewer than 2^31
                    if let Some(&place) = place_of.get(&cell) {
                        held[place].insert(leaf);
                    }
                }
            }
        }
        if own.has_release {
            (0..found.len()).filter(|&place| found[place].has_release).for_each(|place| _ = held[place].insert(leaf));
        }
    }
    held
}

/// Adds a box, to the patch below it if both go to the same.
fn add(patches: &mut Vec<Patch>, grid: Grid, (column, row): Cell, goes: BasinOutcome) {
    let columns = grid.columns as f64; // exact: a power of two
    let phases = [f64::from(column) / columns, f64::from(column + 1) / columns];
    let speeds = [f64::from(row) / grid.rows, f64::from(row + 1) / grid.rows];
    match patches.last_mut() {
        Some(last) if last.goes == goes && last.phases == phases && last.speeds[1] == speeds[0] => {
            last.speeds[1] = speeds[1];
        }
        _ => patches.push(Patch { phases, speeds, goes }),
    }
}
