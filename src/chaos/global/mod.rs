//! Where every motion of a pair goes: Lemmas A1-A9 of `docs/proofs/global.md#A1`.
//!
//! The speeds that motions have in the end are covered by boxes; `image` encloses what may follow each, `graph` finds the components that
//! motions may stay in for ever, each is refined alone, and `cycle` proves what they tend to there.

mod cycle;
mod graph;
mod image;
mod known;
#[cfg(test)]
mod tests;

use std::f64::consts::TAU;

use super::law::Law;
use super::trap::Grid;
use crate::Error;
use crate::pair::ImpactPair;
use crate::periodic::Precision;
use crate::watch::Watch;
use graph::{Component, Graph, Recurrent};
use image::Space;
use known::Released;
pub(crate) use known::spectral_radius;
pub use known::{Kind, LimitCycle, RestCycle};

/// The settings of a global analysis.
#[derive(Clone, Copy, Debug)]
pub struct GlobalSettings {
    /// Boxes of the first partition, about: a power of two from 2^8 to 2^20.
    pub boxes: u32,
    /// How often the boxes of a component are halved at most.
    pub halvings: u32,
    /// Boxes whose images are computed in all, about.
    pub most: usize,
    /// Requested widths of the enclosures of periodic orbits.
    pub precision: Precision,
}

impl Default for GlobalSettings {
    fn default() -> Self {
        Self { boxes: 1 << 14, halvings: 18, most: 300_000, precision: Precision::default() }
    }
}

/// A set of states that motions may stay in for ever.
#[derive(Clone, Debug)]
pub struct Recurrence {
    /// What is proved of the motions that stay in it.
    pub kind: Kind,
    /// Number of its boxes; 0 of the motion from the release alone.
    pub boxes: usize,
    /// The part of the state space that they cover.
    pub area: f64,
    /// Whether no motion leaves it that is in it: it is an attracting block.
    pub is_closed: bool,
}

/// Where every motion of a pair goes.
///
/// **Enclosure**: for every member of the data the impacts of every motion that touches a wall are in one component in the end, or the
/// motion rests for ever again and again; of each component holds what its [`Kind`] says. Lemmas A1-A9
#[derive(Clone, Debug)]
pub struct Global {
    /// The components, those first from which motions may go on to others.
    pub components: Vec<Recurrence>,
    /// `[i, j]`: motions may go from component `i` to component `j`, as far as the boxes tell.
    pub order: Vec<[usize; 2]>,
    /// The greatest speed over `A W` that motions have in the end.
    pub fastest: f64,
    /// Whether it was interrupted: components may not be refined.
    pub interrupted: bool,
}

/// What all motions do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Every motion ends in one cycle with rests.
    OneRestCycle,
    /// Every motion tends to one attractor, or stays at saddles or grazing states.
    OneAttractor,
    /// Attractors are proved, and others may exist.
    Attractors,
    /// Every motion is in a closed component in the end of which nothing else is known, or stays at saddles.
    Closed,
    /// Nothing of these.
    Undecided,
}

impl Class {
    /// Returns the word of the JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::OneRestCycle => "one-rest-cycle",
            Self::OneAttractor => "one-attractor",
            Self::Attractors => "attractors",
            Self::Closed => "closed",
            Self::Undecided => "undecided",
        }
    }
}

impl Global {
    /// Returns where the motions of a pair go, until the watch stops it.
    ///
    /// # Errors
    /// With several harmonics, with a restitution that is not below 0.99, and when a value is beyond the range of double-precision flights.
    pub fn of(pair: &ImpactPair, settings: &GlobalSettings, watch: &dyn Watch) -> Result<Self, Error> {
        let space = Self::space(pair)?;
        let released = Released::of(pair, &space)?;
        let mut analysis = Analysis { pair, space, released, settings, watch, mapped: 0, interrupted: false };
        let whole = analysis.whole();
        let (components, order) = analysis.decided(&whole, 0);
        let order = order.into_iter().filter(|[i, j]| i != j).collect();
        Ok(Self { components, order, fastest: space.fastest(), interrupted: analysis.interrupted })
    }

    /// Returns whether a pair is one that is analysed.
    ///
    /// # Errors
    /// As of [`of`](Self::of).
    pub fn accepts(pair: &ImpactPair) -> Result<(), Error> {
        Self::space(pair).map(drop)
    }

    fn space(pair: &ImpactPair) -> Result<Space, Error> {
        Space::new(Law::of(pair)?).ok_or_else(|| {
            let said =
                format!("pair.restitution is {}, but must be below 0.99 for a global analysis", pair.restitution());
            Error::out_of_range("pair.restitution", said)
        })
    }

    /// Returns what all motions do.
    pub fn class(&self) -> Class {
        let count = |is: fn(&Kind) -> bool| self.components.iter().filter(|component| is(&component.kind)).count();
        let attractors = count(Kind::is_attractor);
        let undecided = count(Kind::is_undecided);
        let rests = count(|kind| matches!(kind, Kind::RestCycle(_)));
        let closed = self.components.iter().all(|component| !component.kind.is_undecided() || component.is_closed);
        match (attractors, undecided) {
            (1, 0) if rests == 1 && self.components.len() == 1 => Class::OneRestCycle,
            (1, 0) => Class::OneAttractor,
            (0, 1..) if closed => Class::Closed,
            (1.., _) => Class::Attractors,
            _ => Class::Undecided,
        }
    }
}

/// A component as it is handed on: what is proved of it, or of those it falls into, and which lead to which.
type Parts = (Vec<Recurrence>, Vec<[usize; 2]>);

struct Analysis<'a> {
    pair: &'a ImpactPair,
    space: Space,
    released: Released,
    settings: &'a GlobalSettings,
    watch: &'a dyn Watch,
    /// Boxes whose images are computed so far.
    mapped: usize,
    interrupted: bool,
}

impl Analysis<'_> {
    /// All states that motions have in the end, in boxes. Lemma A1
    fn whole(&self) -> Component {
        let fastest = self.space.fastest();
        // About as many columns as rows.
        let columns = 1_i64 << (self.settings.boxes.ilog2() / 2); // A6: any boxes
        let rows = (columns as f64 / fastest).log2().round().exp2().max(64.0); // A1: the greatest speed is a multiple of a row
        let grid = Grid { columns, rows };
        let last = (fastest * rows) as i32; // exact: a whole number
        let cells = (0..columns as i32).flat_map(|column| (0..last).map(move |row| (column, row))).collect(); // exact: fewer than 2^31
        Component { grid, cells, has_release: true, is_closed: true }
    }

    /// What is proved of a component: of itself, or of those that its boxes fall into where they are mapped. Lemma A6
    fn decided(&mut self, component: &Component, halved: u32) -> Parts {
        self.mapped += component.cells.len();
        let Some(graph) = Graph::of(&self.space, component, &self.released.next, self.watch) else {
            self.interrupted = true;
            return (vec![self.recurrence(component, Kind::Undecided)], Vec::new());
        };
        let Recurrent { components, leads } = graph.recurrent(component.is_closed);
        drop(graph);
        // The smallest first, as long as boxes may be mapped.
        let mut by_size: Vec<usize> = (0..components.len()).collect();
        by_size.sort_by_key(|&i| components[i].cells.len());
        let mut parts: Vec<Parts> = vec![Parts::default(); components.len()];
        for i in by_size {
            parts[i] = self.refined(&components[i], halved);
        }
        let mut first = Vec::with_capacity(parts.len());
        let (mut all, mut order) = (Vec::new(), Vec::new());
        for (own, between) in parts {
            let from = all.len();
            first.push(from);
            all.extend(own);
            order.extend(between.into_iter().map(|pair| pair.map(|i| i + from)));
        }
        first.push(all.len());
        for (i, row) in leads.iter().enumerate() {
            for j in (0..row.len()).filter(|&j| row[j] && j != i) {
                for from in first[i]..first[i + 1] {
                    order.extend((first[j]..first[j + 1]).map(|to| [from, to]));
                }
            }
        }
        (all, order)
    }

    /// What is proved of a recurrent component, refined as often as is asked.
    fn refined(&mut self, component: &Component, halved: u32) -> Parts {
        let kind = self.kind(component);
        let is_final = !kind.is_undecided()
            || halved >= self.settings.halvings
            || self.mapped + 2 * component.cells.len() > self.settings.most
            || component.is_finest(self.space.fastest())
            || self.interrupted;
        if is_final {
            return (vec![self.recurrence(component, kind)], Vec::new());
        }
        self.decided(&component.halved(), halved + 1)
    }

    /// What is proved of a component.
    fn kind(&self, component: &Component) -> Kind {
        if component.cells.is_empty() {
            return self.released.cycle.map_or(Kind::Undecided, Kind::RestCycle);
        }
        if known::is_grazing(&self.space, component) {
            return Kind::Grazing;
        }
        let Some(limit) = cycle::limit(&self.space, component) else { return Kind::Undecided };
        let Some(orbit) = LimitCycle::of(self.pair, self.space.law(), &limit, self.settings.precision) else {
            return Kind::Undecided;
        };
        if limit.attracts { Kind::Attracting(orbit) } else { Kind::Saddle(orbit) }
    }

    fn recurrence(&self, component: &Component, kind: Kind) -> Recurrence {
        let Grid { columns, rows } = component.grid;
        let boxes = component.cells.len();
        let area = boxes as f64 / (columns as f64 * rows * self.space.fastest()); // shown
        Recurrence { kind, boxes, area, is_closed: component.is_closed }
    }
}

impl Component {
    /// Whether the places of smaller boxes may exceed 32 bits.
    fn is_finest(&self, fastest: f64) -> bool {
        const MOST: f64 = (1_u32 << 30) as f64; // exact: a power of two
        self.grid.columns as f64 >= MOST || fastest * self.grid.rows >= MOST // exact: a power of two
    }

    /// The same with each box cut into two, across its longer side.
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
