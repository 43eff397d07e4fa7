//! That a list of periodic orbits is complete, proved with the tree of a search (Lemma V41).
//!
//! The tree says at which places the box of all orbits is halved, and nothing else. Each box at a leaf is cut by the equations of the
//! word until nothing is left, or until a listed orbit is proved to be the only one in it.

mod cell;
mod cut;
mod excitation;
mod newton;
#[cfg(test)]
mod tests;
mod tree;

use impact_pair_exact::Real;
use impact_pair_model::Word;
use num_bigint::BigInt;
use num_integer::Integer;

use super::contact::Doubt;
use super::data::Data;
use super::span::Span;
use crate::attraction::ClaimedOrbit;
use cell::{Cell, Equations};
use excitation::Excitation;
use tree::{Node, Tree};

/// Halvings of the box of a leaf, one in another, before it is given up.
const LEAF_HALVINGS: u32 = 32;
/// Parts of a flight at whose ends a ball is looked for that leaves the gap for a short time.
const FINE_PARTS: u32 = 64;
/// Boxes of a tree that wait for their turn.
const MOST_OPEN: usize = 1 << 13;
/// Bits of the parameters and of listed phases before they become doubles.
const BITS: u32 = 192;

/// A list of orbits of a word, of which it is claimed that there are no others.
pub(super) struct List<'d> {
    data: &'d Data<'d>,
    equations: Equations,
    /// Phases of each listed orbit, in forcing periods, from each of its impacts on that the word may begin with.
    listed: Vec<Vec<Span>>,
}

impl<'d> List<'d> {
    /// The list of these orbits, which are confirmed.
    pub fn new(data: &'d Data, word: &Word, cycles: u64, orbits: &[&ClaimedOrbit]) -> Result<Self, Doubt> {
        let turns =
            data.common_turns().ok_or_else(|| Doubt::open("the harmonics are not proved to have a common period"))?;
        if !word.is_closed() || cycles == 0 || !BigInt::from(cycles).is_multiple_of(&turns) {
            return Err(Doubt::open("the word does not close in this number of forcing periods"));
        }
        let small =
            |turns: &BigInt| u32::try_from(turns).map(f64::from).map_err(|_| Doubt::open("the orbits take too long"));
        let [cycles, period] = [small(&cycles.into())?, small(&turns)?];
        let excitation = Excitation::new(data).ok_or_else(|| Doubt::open("the parameters are out of range"))?;
        let restitution = Span::of(&data.restitution.enclose(BITS)).common(Span::new(0.0, 1.0)); // V41: it lies there
        let restitution = restitution.ok_or_else(|| Doubt::open("the restitution coefficient is out of range"))?;
        let walls = word.mappings().iter().map(|mapping| mapping.walls().0).collect();
        let equations = Equations { excitation, restitution, walls, cycles, period };
        let listed = orbits.iter().filter_map(|orbit| equations.places(orbit));
        let listed = listed.flat_map(|phases| equations.views(&phases)).collect();
        Ok(Self { data, equations, listed })
    }

    /// Proves that the word has no other admissible orbit, with the tree of a search. Lemma V41
    pub fn is_complete(&self, tree: &str) -> Result<(), Doubt> {
        let mut tree = Tree::new(tree);
        let mut open = vec![self.equations.everything()?];
        while let Some(cell) = open.pop() {
            if self.data.budget.is_stopped() {
                return Err(Doubt::open("the check was stopped"));
            }
            match (tree.node(self.equations.count())?, cell) {
                (Node::Leaf, Some(cell)) => self.settle(cell)?,
                (Node::Leaf, None) => {}
                (Node::Halved { phase, place }, cell) => {
                    let cell = cell.and_then(|cell| self.equations.contracted(cell));
                    let [first, second] = cell.map_or([None, None], |cell| cell.halved(phase, place));
                    open.extend([second, first]);
                }
            }
            if open.len() > MOST_OPEN {
                return Err(Doubt::open("the tree of the search is too deep"));
            }
        }
        tree.end()
    }

    /// Proves that the box of a leaf has no admissible orbit that is not listed.
    fn settle(&self, cell: Cell) -> Result<(), Doubt> {
        let mut open = vec![(cell, 0)];
        while let Some((cell, halvings)) = open.pop() {
            let Some(cell) = self.equations.contracted(cell) else { continue };
            if self.is_listed(&cell) || !self.equations.is_in_gap(&cell, FINE_PARTS) {
                continue;
            }
            self.data.budget.spend(f64::MANTISSA_DIGITS, self.equations.count() * self.data.tones.len());
            if halvings == LEAF_HALVINGS || self.data.budget.is_spent() {
                let [from, to] = [cell.phases[0].lo(), cell.phases[0].hi()].map(|phase| phase * std::f64::consts::TAU);
                return Err(Doubt::Open(format!(
                    "exhaustive: there may be an orbit that is not listed, with its first impact at phases {from:.4} to {to:.4}"
                )));
            }
            let widest = cell.widest();
            let middle = cell.phases[widest].mid();
            open.extend(cell.halved(widest, middle).into_iter().flatten().map(|half| (half, halvings + 1)));
        }
        Ok(())
    }

    /// Whether a listed orbit is the only solution in the hull of the box and of its own phases.
    fn is_listed(&self, cell: &Cell) -> bool {
        self.listed.iter().any(|phases| {
            let equations = &self.equations;
            let periods = ((cell.phases[0].mid() - phases[0].mid()) / equations.period).round(); // V41: any whole number
            let later = Span::point(periods * equations.period);
            let phases: Vec<Span> = phases.iter().map(|&phase| phase + later).collect();
            let is_near = |(own, its): (&Span, &Span)| (own.mid() - its.mid()).abs() <= own.hi() - own.lo() + NEAR;
            if !cell.phases.iter().zip(&phases).all(is_near) {
                return false;
            }
            let time = |i: usize| cell.times[i].hull(equations.end(&phases, i) - phases[i]);
            let times = (0..equations.count()).map(time).collect();
            let phases = cell.phases.iter().zip(&phases).map(|(own, its)| own.hull(*its)).collect();
            equations.is_injective(&Cell { phases, times, drifts: cell.drifts.clone() })
        })
    }
}

/// Distance from a box beyond which no listed orbit is tried, more than the width of the box, in forcing periods.
const NEAR: f64 = 1e-3;

impl Equations {
    /// Phases of a confirmed orbit, in time order, in forcing periods; `None` where the list does not say in which ones they lie. Lemma T13
    fn places(&self, orbit: &ClaimedOrbit) -> Option<Vec<Span>> {
        let turn = Real::pi(BITS) * 2;
        let mut places: Vec<Span> = Vec::new();
        for impact in &orbit.impacts {
            let [low, high] = impact.phase.each_ref().map(|phase| Real::rational(phase, BITS));
            let phase = Span::of(low.hull(&high).over(&turn)?.enclosure());
            let own = f64::from(impact.turn.unwrap_or(0)); // exact: without a forcing period, the common period is one
            let Some(first) = places.first().copied() else {
                places.push(phase + Span::point(own));
                continue;
            };
            if let Some(cycle) = impact.cycle {
                let start = f64::from(orbit.impacts[0].turn.unwrap_or(0)); // exact: likewise
                let cycle = i32::try_from(cycle).ok().map(f64::from)?;
                places.push(phase + Span::point(start + cycle));
                continue;
            }
            // V41: impacts of one common period lie less than that period after the first one
            if self.cycles != self.period {
                return None;
            }
            let own = phase + Span::point(own);
            let place = if (own - first).is_negative() { own + Span::point(self.period) } else { own };
            let is_next = (place - first).is_positive() && (first + Span::point(self.period) - place).is_positive();
            places.push(is_next.then_some(place)?);
        }
        Some(places)
    }

    /// The phases of an orbit from each of its impacts on from which its walls are those of the word.
    fn views(&self, phases: &[Span]) -> Vec<Vec<Span>> {
        let count = self.count();
        let fits = |shift: &usize| (0..count).all(|i| self.walls[(i + shift) % count] == self.walls[i]);
        let at = |i: usize| phases[i % count] + Span::point(if i < count { 0.0 } else { self.cycles });
        (0..count).filter(fits).map(|shift| (shift..shift + count).map(at).collect()).collect()
    }
}
