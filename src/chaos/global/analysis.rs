//! Components that are refined one by one, the smallest first, and the tree of the components that they split into. Lemmas A6, A10 of
//! `docs/proofs/global.md#A6`.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::f64::consts::TAU;

use super::graph::{Component, Graph, Recurrent, Stopped};
use super::image::Space;
use super::known::{self, Kind, LimitCycle, Released};
use super::{GlobalSettings, OpenReason, Recurrence, attractors, cycle, horseshoes, saddles};
use crate::chaos::trap::Grid;
use crate::pair::ImpactPair;
use crate::watch::Watch;

/// Greatest number of components in which horseshoes are looked for.
const MOST_SEARCHED: usize = 4;

/// The map, and how far it is analysed.
pub(super) struct Request<'a> {
    pub pair: &'a ImpactPair,
    pub space: Space,
    pub released: Released,
    pub settings: &'a GlobalSettings,
    pub watch: &'a dyn Watch,
}

/// Component, the proved kind, and the components that a refinement splits the component into.
pub(super) struct Node {
    pub component: Component,
    /// Number of times that its boxes have been halved.
    halved: u32,
    pub kind: Kind,
    pub split: Option<Split>,
}

/// The components that the boxes of a component, once more halved, fall into.
pub(super) struct Split {
    /// The nodes of its components.
    children: Vec<usize>,
    /// `leads[i][j]`: whether the first of these leads to the second.
    leads: Vec<Vec<bool>>,
}

/// An analysis as far as it is done: a tree, whose first node is the whole state space.
pub(super) struct Analysis<'a> {
    pub request: Request<'a>,
    pub nodes: Vec<Node>,
    /// Boxes whose images are computed so far, and the work of these.
    mapped: usize,
    work: u64,
    /// The limit or the interruption that ended it while components could still be refined; `None` if neither did.
    stopped: Option<OpenReason>,
}

impl<'a> Analysis<'a> {
    /// Analyses all states that motions have in the end. The smallest undecided component is refined first: thin sets that need many boxes wait
    /// for those that shrink.
    pub fn of(request: Request<'a>) -> Self {
        let mut analysis = Self { request, nodes: Vec::new(), mapped: 0, work: 0, stopped: None };
        let whole = analysis.whole(analysis.request.settings.boxes);
        analysis.nodes.push(Node { component: whole, halved: 0, kind: Kind::Undecided, split: None });
        let mut waiting = BinaryHeap::from([Reverse((0, 0))]);
        while let Some(Reverse((boxes, node))) = waiting.pop() {
            if analysis.mapped + 2 * boxes > analysis.request.settings.most {
                analysis.stopped = Some(OpenReason::Most);
                break;
            }
            let children = analysis.refine(node);
            if analysis.stopped.is_some() {
                break;
            }
            for child in children.filter(|&child| analysis.is_refined(child)) {
                waiting.push(Reverse((analysis.nodes[child].component.cells.len(), child)));
            }
        }
        analysis
    }

    /// Whether the analysis was interrupted.
    pub fn is_interrupted(&self) -> bool {
        self.stopped == Some(OpenReason::Interrupted)
    }

    /// Components that are left, those first from which motions may go on to others.
    pub fn components(&self) -> Vec<Recurrence> {
        let leaves = self.leaves(0);
        let mut found: Vec<Recurrence> = leaves.iter().map(|&leaf| self.recurrence(leaf)).collect();
        if let Some(depth) = self.request.settings.horseshoes {
            self.add_horseshoes(depth, &leaves, &mut found);
        }
        found
    }

    /// Adds the horseshoes that are proved to be in components of which nothing else is, the largest few. Lemma A13
    fn add_horseshoes(&self, depth: usize, leaves: &[usize], found: &mut [Recurrence]) {
        let mut open: Vec<usize> = (0..found.len()).filter(|&i| found[i].kind.is_undecided()).collect();
        open.sort_by_key(|&i| Reverse(found[i].boxes));
        let component = |i: usize| &self.nodes[leaves[i]].component;
        for i in open.into_iter().take(MOST_SEARCHED).take_while(|_| self.request.watch.goes_on()) {
            let others: Vec<&Component> = (0..leaves.len()).filter(|&j| j != i).map(component).collect();
            let Request { space, watch, .. } = &self.request;
            found[i].horseshoe = horseshoes::within(space, component(i), &others, depth, *watch);
        }
    }

    /// Attracting cycles that are proved in undecided components, each with the place of its component. Lemma A14
    pub fn attractors_within(&self, found: &[Recurrence]) -> Vec<(usize, Box<LimitCycle>)> {
        let Request { pair, space, settings, watch, .. } = &self.request;
        let is_open: Vec<bool> = found.iter().map(|own| own.kind.is_undecided()).collect();
        if !is_open.contains(&true) || !watch.goes_on() {
            return Vec::new();
        }
        let leaves: Vec<&Component> = self.leaves(0).into_iter().map(|leaf| &self.nodes[leaf].component).collect();
        attractors::within(pair, space, &leaves, &is_open, settings.precision)
    }

    /// Pairs of components, by their places, of which the first may lead to the second.
    pub fn order(&self) -> Vec<[usize; 2]> {
        let place = self.places();
        let mut order = Vec::new();
        for Split { children, leads } in self.nodes.iter().filter_map(|node| node.split.as_ref()) {
            for (i, row) in leads.iter().enumerate() {
                for j in (0..row.len()).filter(|&j| row[j] && j != i) {
                    let [from, to] = [i, j].map(|k| self.leaves(children[k]));
                    order.extend(from.iter().flat_map(|&from| to.iter().map(move |&to| [from, to])));
                }
            }
        }
        order.iter().map(|pair| pair.map(|leaf| place[leaf])).collect()
    }

    /// For each node that is left, its place among the components.
    pub fn places(&self) -> Vec<usize> {
        let mut places = vec![usize::MAX; self.nodes.len()];
        self.leaves(0).into_iter().enumerate().for_each(|(place, leaf)| places[leaf] = place);
        places
    }

    /// Nodes that a node has fallen into; the node itself if it has not been split.
    pub fn leaves(&self, node: usize) -> Vec<usize> {
        match &self.nodes[node].split {
            Some(split) => split.children.iter().flat_map(|&child| self.leaves(child)).collect(),
            None => vec![node],
        }
    }

    /// All states that motions have in the end, in about `boxes` boxes. Lemma A1
    pub fn whole(&self, boxes: u32) -> Component {
        let fastest = self.request.space.fastest();
        // About as many columns as rows.
        let columns = 1_i64 << (boxes.ilog2() / 2); // A6: any boxes
        let rows = (columns as f64 / fastest).log2().round().exp2().max(64.0); // A1: the greatest speed is a multiple of a row
        let grid = Grid { columns, rows };
        let last = (fastest * rows) as i32; // exact: a whole number
        let cells = (0..columns as i32).flat_map(|column| (0..last).map(move |row| (column, row))).collect(); // exact: fewer than 2^31
        Component { grid, cells, has_release: true, is_closed: true }
    }

    /// Replaces a node by the components of its mapped boxes, and returns these. Lemmas A6, A10
    fn refine(&mut self, node: usize) -> std::ops::Range<usize> {
        let own = &self.nodes[node];
        let component = if node == 0 { own.component.clone() } else { own.component.halved() };
        let (halved, first) = (if node == 0 { 0 } else { own.halved + 1 }, self.nodes.len());
        self.mapped += component.cells.len();
        let Request { space, released, watch, .. } = &self.request;
        let allowed = self.request.settings.work.saturating_sub(self.work); // exact: what is left
        let graph = match Graph::of(space, &component, &released.next, allowed, *watch) {
            Ok((graph, work)) => {
                self.work += work;
                graph
            }
            Err(stopped) => {
                self.stopped = Some(stopped.into());
                return first..first;
            }
        };
        let is_open = component.has_release && component.is_closed && released.cycle.is_none();
        if is_open && graph.is_released_always() {
            self.nodes[node].kind = Kind::RestCycle(None);
            return first..first;
        }
        let Recurrent { components, leads, .. } = graph.recurrent(component.is_closed);
        let leaves: Vec<usize> = self.leaves(0).into_iter().filter(|&leaf| leaf != node).collect();
        let others = |own: usize| -> Vec<&Component> {
            let siblings = components.iter().enumerate().filter(|(i, _)| *i != own).map(|(_, component)| component);
            siblings.chain(leaves.iter().map(|&leaf| &self.nodes[leaf].component)).collect()
        };
        let kinds: Vec<Option<Kind>> =
            components.iter().enumerate().map(|(own, component)| self.kind(component, || others(own))).collect();
        for (component, kind) in components.into_iter().zip(kinds) {
            let split = kind.is_none().then(|| Split { children: Vec::new(), leads: Vec::new() });
            let kind = kind.unwrap_or(Kind::Undecided); // A8: it falls into nothing
            self.nodes.push(Node { component, halved, kind, split });
        }
        let children = first..self.nodes.len();
        self.nodes[node].split = Some(Split { children: children.clone().collect(), leads });
        children
    }

    /// Whether a node is to be refined: undecided, and its boxes may be halved once more.
    fn is_refined(&self, node: usize) -> bool {
        let Node { component, kind, halved, split } = &self.nodes[node];
        kind.is_undecided()
            && split.is_none()
            && *halved < self.request.settings.halvings
            && !component.is_finest(self.request.space.fastest())
    }

    /// Kind of a component beside others, as far as proved; `None` where no motion stays in the component.
    fn kind<'c>(&self, component: &Component, others: impl Fn() -> Vec<&'c Component>) -> Option<Kind> {
        let Request { pair, space, released, settings, .. } = &self.request;
        if component.cells.is_empty() {
            return Some(released.cycle.map_or(Kind::Undecided, |cycle| Kind::RestCycle(Some(cycle))));
        }
        if known::is_grazing(space, component) {
            return Some(Kind::Grazing);
        }
        let Some(limit) = cycle::limit(space, component) else {
            let is_saddle = !component.is_closed && saddles::is_of_saddle_type(space, component);
            return Some(if is_saddle { Kind::SaddleSet } else { Kind::Undecided });
        };
        let Some(orbit) = LimitCycle::of(pair, space.law(), &limit, settings.precision) else {
            return Some(Kind::Undecided);
        };
        match orbit.is_in(space.law(), component, &others()) {
            Some(true) if limit.attracts => Some(Kind::Attracting(orbit)),
            Some(true) => Some(Kind::Saddle(orbit)),
            Some(false) => None,
            None => Some(Kind::Undecided),
        }
    }

    fn recurrence(&self, node: usize) -> Recurrence {
        let Node { component, kind, .. } = &self.nodes[node];
        let Grid { columns, rows } = component.grid;
        let boxes = component.cells.len();
        let area = boxes as f64 / (columns as f64 * rows * self.request.space.fastest()); // shown
        let limits = || if self.is_refined(node) { self.stopped } else { Some(OpenReason::Halvings) };
        let reason = if kind.is_undecided() { limits() } else { None };
        Recurrence { kind: kind.clone(), boxes, area, is_closed: component.is_closed, reason, horseshoe: None }
    }
}

impl From<Stopped> for OpenReason {
    fn from(stopped: Stopped) -> Self {
        match stopped {
            Stopped::Interrupted => Self::Interrupted,
            Stopped::Spent => Self::Work,
        }
    }
}

impl Component {
    /// Whether the numbers of columns or rows of smaller boxes may exceed 32 bits.
    pub(super) fn is_finest(&self, fastest: f64) -> bool {
        const MAX_COUNT: f64 = (1_u32 << 30) as f64; // exact: a power of two
        self.grid.columns as f64 >= MAX_COUNT || fastest * self.grid.rows >= MAX_COUNT // exact: a power of two
    }

    /// The component with each box cut into two, across the longer side.
    fn halved(&self) -> Self {
        let Grid { columns, rows } = self.grid;
        let is_wide = TAU / columns as f64 > 1.0 / rows; // A6: any boxes
        let halves = |&(column, row): &(i32, i32)| {
            if is_wide {
                [(2 * column, row), (2 * column + 1, row)]
            } else {
                [(column, 2 * row), (column, 2 * row + 1)]
            }
        };
        let mut cells: Vec<_> = self.cells.iter().flat_map(halves).collect();
        cells.sort_unstable();
        let grid = if is_wide { Grid { columns: 2 * columns, rows } } else { Grid { columns, rows: 2.0 * rows } };
        Self { grid, cells, ..self.clone() }
    }
}
