//! All closed chains through a set of boxes: Lemma D21.

use std::collections::HashMap;

use super::chain::Chain;
use super::graph::Layer;
use super::relation::{Relation, shift};
use crate::chaos::flights::{Law, Quad, Side};
use crate::chaos::trap::Grid;
use crate::number::up;
use crate::pair::{ImpactPair, Wall};
use crate::periodic::{Beside, Interval, PeriodicOrbit, Precision, Problem};

/// Flights that are cut anew when a chain grows.
const FELT: usize = 6;
/// Chains as narrow as that, in turns, are asked whether an orbit is near.
const NEAR: f64 = 1.0 / 16.0;
/// An orbit is looked for in chains as narrow as that.
const CERTAIN: f64 = 1e-7;

pub(super) struct Task<'t> {
    pub pair: &'t ImpactPair,
    pub law: &'t Law,
    pub relation: Relation,
    pub times: Interval,
    /// How wide parts are, in turns.
    pub width: f64,
    /// The columns that images are told in.
    pub march: Grid,
    pub narrowest: f64,
    pub precision: Precision,
    pub goes_on: &'t (dyn Fn() -> bool + Sync),
}

/// An orbit of a closed chain.
pub(super) struct Found {
    pub problem: Problem,
    pub orbit: PeriodicOrbit,
}

/// The search for the closed chains of so many impacts through some boxes.
pub(super) struct Search<'t> {
    task: &'t Task<'t>,
    layers: &'t [Layer],
    impacts: usize,
    pub chains: u64,
    pub closed: u64,
    pub found: HashMap<(Vec<Side>, u32), Vec<Found>>,
    pub undecided: Vec<Chain>,
}

impl<'t> Search<'t> {
    pub fn new(task: &'t Task<'t>, layers: &'t [Layer]) -> Self {
        Self { task, layers, impacts: layers.len() - 1, chains: 0, closed: 0, found: HashMap::new(), undecided: Vec::new() }
    }

    fn width(&self) -> i64 {
        ((self.task.width * self.layers[0].columns() as f64) as i64).max(1)
    }

    /// Searches from all states of the first layer.
    pub fn all(&mut self) {
        let all = Interval::new(0.0, 1f64.next_down());
        for [u, w] in self.layers[0].parts(all, Interval::new(0.0, 1e6), self.width()) {
            let chain = Chain { phases: vec![u], speeds: vec![w], sides: Vec::new(), turns: None };
            self.grow(&chain);
        }
    }

    fn grow(&mut self, chain: &Chain) {
        self.chains += 1;
        let last = chain.sides.len();
        let Some(landings) = self.landings(chain.phases[last], chain.speeds[last]) else {
            self.undecided.push(chain.clone());
            return;
        };
        for (side, phases, speeds) in landings {
            for [u, w] in self.layers[last + 1].parts(phases, speeds, self.width()) {
                if !(self.task.goes_on)() {
                    return;
                }
                let mut longer = chain.clone();
                longer.sides.push(side);
                if last + 1 == self.impacts {
                    let turns = (u.middle() - longer.phases[0].middle()).round();
                    let back = u - Interval::point(turns);
                    let (Some(u), Some(w)) = (longer.phases[0].cut(back), longer.speeds[0].cut(w)) else { continue };
                    (longer.phases[0], longer.speeds[0]) = (u, w);
                    longer.turns = Some(turns);
                    self.close(longer);
                } else {
                    longer.phases.push(u);
                    longer.speeds.push(w);
                    let first = longer.sides.len().saturating_sub(FELT);
                    if longer.narrow(&self.task.relation, self.task.times, first).is_some() {
                        self.grow(&longer);
                    }
                }
            }
        }
    }

    /// Where the flights from a rectangle may land: the wall, and reduced phases and speeds.
    fn landings(&self, phases: Interval, speeds: Interval) -> Option<Vec<(Side, Interval, Interval)>> {
        let whole = phases.lo.floor();
        let (u, w) = (phases - Interval::point(whole), speeds);
        let radius = |x: Interval| up((x.middle() - x.lo).max(x.hi - x.middle()));
        let quad = Quad::rectangle([u.middle(), w.middle()], [radius(u), radius(w)], w.lo.max(0.0));
        let mut columns: Vec<(bool, i64, [f64; 2])> = Vec::new();
        self.task
            .march
            .landings(self.task.law, &quad, &mut |at| columns.push((at.side == Side::Far, at.column, at.speeds)))
            .ok()?;
        columns.sort_unstable_by_key(|&(side, column, _)| (side, column));
        let per_turn = self.task.march.columns as f64;
        let runs = columns.chunk_by(|a, b| a.0 == b.0 && b.1 - a.1 <= 1);
        Some(
            runs.map(|run| {
                let side = if run[0].0 { Side::Far } else { Side::Near };
                let phases = Interval::new(run[0].1 as f64 / per_turn, (run[run.len() - 1].1 + 1) as f64 / per_turn);
                let speeds = run.iter().map(|&(_, _, [low, high])| Interval::new(low, high));
                let speeds = speeds.reduce(Interval::hull).expect("a run is not empty");
                (side, phases + Interval::point(whole + shift(side)), speeds)
            })
            .collect(),
        )
    }

    /// Cuts and halves a closed chain until nothing is left, or it lies where a known orbit is the only one.
    fn close(&mut self, chain: Chain) {
        self.closed += 1;
        let mut open = vec![chain];
        while let Some(mut chain) = open.pop() {
            if !(self.task.goes_on)() {
                return;
            }
            let Some(is_regular) = self.narrow_closed(&mut chain) else { continue };
            let wid = chain.wid();
            let is_last = wid <= self.task.narrowest;
            if wid <= NEAR && self.is_known(&chain, is_last || is_regular && wid <= CERTAIN) {
                continue;
            }
            if is_last {
                self.undecided.push(chain);
                continue;
            }
            let widest = (0..chain.len())
                .max_by(|&i, &j| chain.phases[i].wid().total_cmp(&chain.phases[j].wid()))
                .expect("an impact");
            let Interval { lo, hi } = chain.phases[widest];
            let middle = chain.phases[widest].middle();
            let mut other = chain.clone();
            other.phases[widest] = Interval::new(middle, hi);
            chain.phases[widest] = Interval::new(lo, middle);
            open.extend([other, chain]);
        }
    }

    fn narrow_closed(&self, chain: &mut Chain) -> Option<bool> {
        loop {
            let before = chain.size(0);
            let is_regular = chain.narrow(&self.task.relation, self.task.times, 0)?;
            for i in 0..chain.len() {
                let [u, w] = self.layers[i].hull(chain.phases[i], chain.speeds[i])?;
                (chain.phases[i], chain.speeds[i]) = (u, w);
            }
            if chain.size(0) > 0.8 * before {
                return Some(is_regular);
            }
        }
    }

    /// Whether the chain lies where a known orbit is the only one; if not, and if asked, looks for an orbit.
    fn is_known(&mut self, chain: &Chain, looks: bool) -> bool {
        let told = Told::new(chain);
        let key = (told.sides.clone(), told.cycles);
        let known = self.found.entry(key).or_default();
        if known.iter().any(|found| found.problem.holds(&told.phases, &found.orbit)) {
            return true;
        }
        if !looks {
            return false;
        }
        let Some(problem) = told.problem(self.task.pair) else { return false };
        let guess: Vec<f64> = told.phases.iter().map(|x| x.middle()).collect();
        let Some((orbit, identity)) =
            problem.prove_reduced(&guess, self.task.precision, known.iter().map(|found| &found.orbit))
        else {
            return false;
        };
        let is_in = problem.holds(&told.phases, &orbit);
        if identity == Beside::New {
            known.push(Found { problem, orbit });
        }
        is_in && identity != Beside::Open
    }
}

/// A closed chain as the whole system sees it, from the first impact of its least rotation on.
pub(super) struct Told {
    pub sides: Vec<Side>,
    pub cycles: u32,
    /// In turns, from the left wall on.
    pub phases: Vec<Interval>,
    walls: Vec<Wall>,
}

impl Told {
    pub fn new(chain: &Chain) -> Self {
        let (count, turns) = (chain.len(), chain.turns.expect("a closed chain"));
        let is_far = |i: usize| chain.sides[i % count] == Side::Far;
        let word = |from: usize| (0..count).map(move |i| is_far(from + i));
        let first = (0..count).min_by(|&a, &b| word(a).cmp(word(b))).expect("an impact");
        let far = word(0).filter(|far| *far).count();
        let rounds = if far % 2 == 0 { 1 } else { 2 };
        let mut walls = Vec::new();
        let mut phases = Vec::new();
        let mut crossed = 0;
        for i in 0..rounds * count {
            walls.push(if crossed % 2 == 0 { Wall::Left } else { Wall::Right });
            let round = ((first + i) / count) as f64;
            let phase = chain.phases[(first + i) % count];
            phases.push(phase + Interval::point(round * turns) - Interval::point(0.5 * crossed as f64));
            crossed += usize::from(is_far(first + i));
        }
        let cycles = (rounds as f64 * turns - 0.5 * crossed as f64) as u32;
        Self { sides: word(first).map(|far| if far { Side::Far } else { Side::Near }).collect(), cycles, phases, walls }
    }

    pub fn problem(&self, pair: &ImpactPair) -> Option<Problem> {
        let text: String = self.walls.iter().map(|wall| if *wall == Wall::Left { 'L' } else { 'R' }).collect();
        Problem::new(pair, &text.parse().ok()?, self.cycles).ok()
    }
}
