//! All closed chains of a given number of impacts through a block of boxes: Lemma D22.

use std::collections::BTreeMap;

use super::chain::{Chain, Laws};
use super::graph::Layer;
use super::word::WallChain;
use crate::chaos::law::{Law, Side};
use crate::chaos::quad::Quad;
use crate::chaos::trap::{Arrivals, Grid};
use crate::number::interval::Interval;
use crate::number::up;
use crate::pair::ImpactPair;
use crate::periodic::{Identity, PeriodicOrbit, Precision, Problem};
use crate::watch::Watch;

/// Greatest width of the boxes of a growing chain is 1 forcing period over this number.
const BOXES_PER_PERIOD: i64 = 32;
/// Flights that are cut anew when a chain grows.
const CUT_FLIGHTS: usize = 6;
/// Columns in a forcing period for landings.
const COLUMNS: Grid = Grid { columns: 256, rows: 1.0 };
/// Chains as narrow as that, in forcing periods, are tested for a known orbit.
const KNOWN_ORBIT_WIDTH: f64 = 1.0 / 16.0;
/// Chains as narrow as that are tested for an unknown orbit, if Newton's equation determines their phases.
const NEW_ORBIT_WIDTH: f64 = 1e-7;
/// Chains as narrow as that are not halved.
const MIN_WIDTH: f64 = 1e-12;
/// The least part of a closed chain that a round takes off for another one to be made.
const MIN_GAIN: f64 = 0.2;
/// Chains left undecided at which a block is given up: there is a continuum of cycles, or nearly one.
const MOST_UNDECIDED: usize = 64;

/// The problem of a search: the pair, the relations of its chains, and the precision.
pub(super) struct Task<'t> {
    pub pair: &'t ImpactPair,
    pub law: Law,
    pub laws: Laws,
    pub precision: Precision,
    /// May stop the search.
    pub watch: &'t dyn Watch,
}

/// Orbit of a closed chain, admissible or virtual.
pub(super) struct Found {
    pub problem: Problem,
    pub orbit: PeriodicOrbit,
}

/// The search in a block.
pub(super) struct Search<'t> {
    task: &'t Task<'t>,
    layers: &'t [Layer],
    /// The orbits found, by walls and cycles.
    pub found: BTreeMap<(String, u32), Vec<Found>>,
    pub undecided: Vec<Chain>,
    /// `true` if the search went through the whole block.
    pub is_whole: bool,
}

impl<'t> Search<'t> {
    pub fn new(task: &'t Task<'t>, layers: &'t [Layer]) -> Self {
        Self { task, layers, found: BTreeMap::new(), undecided: Vec::new(), is_whole: true }
    }

    /// Greatest width of a box, in columns.
    fn width(&self) -> i64 {
        (self.layers[0].columns() / BOXES_PER_PERIOD).max(1) // D22: any width
    }

    /// Whether the search goes on: not after a stop, nor with too many undecided chains.
    fn goes_on(&mut self) -> bool {
        self.is_whole &= self.undecided.len() < MOST_UNDECIDED && self.task.watch.goes_on();
        self.is_whole
    }

    /// Searches the block.
    pub fn search(&mut self) {
        let mut open: Vec<Chain> = self.layers[0].whole(self.width()).into_iter().map(Chain::new).collect();
        while let Some(chain) = open.pop() {
            if !self.goes_on() {
                return;
            }
            let last = chain.sides.len();
            match self.landings(chain.phases[last], chain.speeds[last]) {
                Some(landings) => open.extend(self.longer(&chain, &landings)),
                None => self.cut_off(chain, &mut open),
            }
        }
    }

    /// A chain whose flights on are not followed is halved.
    fn cut_off(&mut self, chain: Chain, open: &mut Vec<Chain>) {
        let last = chain.sides.len();
        if chain.phases[last].wid() <= MIN_WIDTH {
            self.undecided.push(chain);
            return;
        }
        for mut half in chain.halves(last) {
            let [u, w] = [half.phases[last], half.speeds[last]];
            let first = last.saturating_sub(CUT_FLIGHTS); // D22: any flights
            let Some([u, w]) = self.layers[last].hull(u, w) else { continue };
            (half.phases[last], half.speeds[last]) = (u, w);
            if half.narrow(&self.task.laws, first).is_some() {
                open.push(half);
            }
        }
    }

    /// Chains with one flight more; chains that close are searched at once.
    fn longer(&mut self, chain: &Chain, landings: &[(Side, [Interval; 2])]) -> Vec<Chain> {
        let (next, impacts) = (chain.sides.len() + 1, self.layers.len() - 1);
        let mut all = Vec::new();
        for &(side, [phases, speeds]) in landings {
            for [phase, speed] in self.layers[next].parts(phases, speeds, self.width()) {
                let mut longer = chain.clone();
                longer.sides.push(side);
                if next == impacts {
                    self.close(&longer, phase, speed);
                    continue;
                }
                longer.phases.push(phase);
                longer.speeds.push(speed);
                let first = next.saturating_sub(CUT_FLIGHTS); // D22: any flights
                if longer.narrow(&self.task.laws, first).is_some() {
                    all.push(longer);
                }
            }
        }
        all
    }

    /// Encloses the landings of flights from a rectangle: the wall, and a rectangle of reduced phases and speeds. Lemma D4
    ///
    /// `None` where a flight is not followed.
    fn landings(&self, phases: Interval, speeds: Interval) -> Option<Vec<(Side, [Interval; 2])>> {
        let whole = phases.inf().floor(); // D22: any whole forcing periods
        let [u, w] = [phases - Interval::point(whole), speeds];
        let radius = |x: Interval| up((x.mid() - x.inf()).max(x.sup() - x.mid())); // D22: the farther end
        let quad = Quad::rectangle([u.mid(), w.mid()], [radius(u), radius(w)], w.inf());
        let mut columns = Vec::new();
        let mut note = |landing| columns.push(landing);
        COLUMNS.landings(&self.task.law, &quad, &mut note).ok()?;
        columns.sort_unstable_by_key(|landing| (landing.side, landing.column));
        let runs = columns.chunk_by(|a, b| a.side == b.side && b.column - a.column <= 1);
        let rectangle = |run: &[Arrivals]| {
            let (first, last) = (run[0], run[run.len() - 1]);
            // exact: edges of columns
            let [low, high] = [first.column, last.column + 1].map(|column| column as f64 / COLUMNS.columns as f64);
            let speeds = run.iter().map(|landing| Interval::new(landing.speeds[0], landing.speeds[1]));
            let speeds = speeds.reduce(Interval::hull)?;
            Some((first.side, [Interval::new(low, high) + Interval::point(whole + first.side.shift()), speeds]))
        };
        runs.map(rectangle).collect()
    }

    /// Searches the chains that a last impact in this rectangle closes: the last impact is the first one again.
    fn close(&mut self, chain: &Chain, phase: Interval, speed: Interval) {
        let later = phase - chain.phases[0];
        let [low, high] = [later.inf().ceil(), later.sup().floor()]; // D22: whole forcing periods in between
        let mut turns = low;
        while turns <= high {
            let first = chain.phases[0].intersection(phase - Interval::point(turns));
            if let (Some(phase), Some(speed)) = (first, chain.speeds[0].intersection(speed)) {
                let mut closed = chain.clone();
                (closed.phases[0], closed.speeds[0]) = (phase, speed);
                closed.turns = Some(turns);
                self.settle(closed);
            }
            turns += 1.0;
        }
    }

    /// Cuts and halves a closed chain until nothing is left, or all of it lies where known orbits are the only ones.
    fn settle(&mut self, chain: Chain) {
        let mut open = vec![chain];
        while let Some(mut chain) = open.pop() {
            if !self.goes_on() {
                return;
            }
            let Some(is_regular) = self.cut(&mut chain) else { continue };
            let (widest, wid) = chain.widest();
            let is_last = wid <= MIN_WIDTH;
            if wid <= KNOWN_ORBIT_WIDTH && self.is_known(&chain, is_last || is_regular && wid <= NEW_ORBIT_WIDTH) {
                continue;
            }
            if is_last {
                self.undecided.push(chain);
            } else {
                open.extend(chain.halves(widest));
            }
        }
    }

    /// Cuts a closed chain by all relations. True if Newton's equation determined all phases; `None` when no chain is left.
    fn cut(&self, chain: &mut Chain) -> Option<bool> {
        loop {
            let before = chain.size(0);
            let is_regular = chain.narrow(&self.task.laws, 0)?;
            for (i, layer) in self.layers.iter().enumerate().take(chain.len()) {
                let [u, w] = layer.hull(chain.phases[i], chain.speeds[i])?;
                (chain.phases[i], chain.speeds[i]) = (u, w);
            }
            if chain.size(0) > (1.0 - MIN_GAIN) * before {
                return Some(is_regular);
            }
        }
    }

    /// Whether a known orbit is the only one in the chain's boxes; where none is known and `looks` is set, an orbit is searched for first.
    fn is_known(&mut self, chain: &Chain, looks: bool) -> bool {
        let Some(walled) = WallChain::new(chain) else { return false };
        let known = self.found.entry((walled.walls.clone(), walled.cycles)).or_default();
        if known.iter().any(|found| found.problem.is_all_of(&walled.phases, &found.orbit)) {
            return true;
        }
        let found = looks.then(|| {
            let problem = walled.problem(self.task.pair)?;
            let guess: Vec<f64> = walled.phases.iter().map(|x| x.mid()).collect();
            let orbits = known.iter().map(|found| &found.orbit);
            let (orbit, identity) = problem.prove_reduced(&guess, self.task.precision, orbits)?;
            Some((Found { problem, orbit }, identity))
        });
        let Some((found, identity)) = found.flatten() else { return false };
        let is_known = identity != Identity::Open && found.problem.is_all_of(&walled.phases, &found.orbit);
        if identity == Identity::New {
            known.push(found);
        }
        is_known
    }
}
