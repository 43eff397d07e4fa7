//! All periodic orbits of period n of the reduced map in a trapping region: Lemmas D20-D23 of `docs/proofs/chaos.md#D20`.
//!
//! The reduced map takes them for its cycles. In `graph` the boxes of the region say where a cycle may be when; in `search`
//! chains of boxes grow impact by impact, cut by all that `relation` and `chain` know of neighbouring impacts, which is smooth at grazes
//! as well; what closes is cut and halved until it is excluded or lies where a proved orbit is the only one.

mod chain;
mod document;
mod graph;
mod relation;
mod search;
#[cfg(test)]
mod tests;
mod word;

use std::collections::BTreeMap;
use std::ops::RangeInclusive;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::law::Law;
use super::refusal::NoTrap;
use super::region::Trap;
use crate::contact::Reason;
use crate::exact::Enclosure;
use crate::number::interval::Interval;
use crate::number::{Ball, Number};
use crate::pair::Wall;
use crate::periodic::{Identity, PeriodicImpact, PeriodicOrbit, Precision, Problem, Region, Stability};
use crate::threads::{answers, available};
use crate::watch::{Stage, Watch};
use crate::{Effort, Error, Scene};
use chain::{Chain, Laws};
use graph::Graph;
use relation::Relation;
use search::{Found, Search, Task};

/// A cycle of the reduced map: a periodic motion, and its mirror image if that is another one.
#[derive(Clone, Debug)]
pub struct Cycle {
    /// Least number of impacts after which the motion repeats itself or its mirror image.
    pub impacts: usize,
    /// The problem that it is an orbit of: its word, from the left wall on, and its cycles of the excitation.
    pub problem: Problem,
    /// The orbit.
    pub orbit: PeriodicOrbit,
}

/// The most impacts of a cycle.
pub const MOST_IMPACTS: u32 = 64;

/// The cycles of a region, proved.
///
/// **Enclosure**: [`fixed_points`](Cycles::fixed_points) of `n` counts all states of the region that the reduced map maps to
/// themselves by `n` impacts. A count exists only where no part of the region is undecided, and all orbits are then listed.
/// Lemmas D20-D23
/// **Cost**: figure 14 to 12 impacts in less than a second; each impact more takes about `exp(h)` times as long, with the topological
/// entropy `h`.
///
/// ```
/// use impact_pair::chaos::Cycles;
/// use impact_pair::watch::Unwatched;
/// use impact_pair::{Effort, Scene};
/// let scene = Scene::parse(r#"
///     excitation = { amplitude = 8, frequency = "pi", phase = 0 }
///     pair = { gap = 9.42497, restitution = 0.5 }
///     start = { time = 0, wall = "left", velocity = -12.56636 }
/// "#)?;
/// let cycles = Cycles::of(&scene, Effort::default(), &(1..=5), Default::default(), &Unwatched)?.expect("a region");
/// assert!(cycles.fixed_points().values().eq(&[1, 1, 4, 1, 11]) && cycles.has_no_attractor());
/// # Ok::<(), impact_pair::Error>(())
/// ```
#[derive(Debug)]
pub struct Cycles {
    trap: Trap,
    requested: RangeInclusive<u32>,
    fixed_points: BTreeMap<usize, usize>,
    cycles: Vec<Cycle>,
    undecided: Vec<(usize, Region)>,
}

impl Cycles {
    /// Proves all cycles of the `requested` numbers of impacts in the region that [`Trap::of`] finds with this effort.
    ///
    /// `watch` receives the progress, and may stop it; numbers of impacts not done then have no count.
    ///
    /// # Errors
    /// With several harmonics, and when a value is beyond the range of double-precision flights.
    pub fn of(
        scene: &Scene,
        effort: Effort,
        requested: &RangeInclusive<u32>,
        precision: Precision,
        watch: &dyn Watch,
    ) -> Result<Result<Self, NoTrap>, Error> {
        let trap = match Trap::of(scene, effort, watch)? {
            Ok(trap) => trap,
            Err(why) => return Ok(Err(why)),
        };
        let law = Law::of(scene.pair())?;
        let graph = Graph::new(&law, trap.region());
        let [shortest, longest] = trap.flight();
        let laws = Laws { relation: Relation::new(&law), times: Interval::new(shortest, longest) };
        let (cycles, undecided) = (Vec::new(), Vec::new());
        let mut all = Self { trap, requested: requested.clone(), fixed_points: BTreeMap::new(), cycles, undecided };
        let numbers = requested.clone().map(|impacts| impacts as usize); // exact: a small whole number
        for impacts in numbers {
            let done = AtomicUsize::new(0);
            let of = graph.blocks.len();
            let blocks = || done.load(Ordering::Relaxed);
            let watch = |_: Stage<'_>| watch.proceed(Stage::Cycles { impacts, blocks: blocks(), of });
            let task = Task { pair: scene.pair(), law, laws, precision, watch: &watch };
            all.collect_blocks(&task, impacts, searched(&task, &graph, impacts, &done));
            if !watch.goes_on() {
                break;
            }
        }
        all.cycles.sort_by(|a, b| {
            let word = |cycle: &Cycle| cycle.problem.word().to_string();
            let phases = [a, b].map(|cycle| cycle.orbit.phases()[0].mid());
            (a.impacts, word(a)).cmp(&(b.impacts, word(b))).then(phases[0].total_cmp(&phases[1]))
        });
        Ok(Ok(all))
    }

    /// Collects the results of all blocks for cycles of `impacts` impacts, block by block. Lemma D23
    fn collect_blocks(&mut self, task: &Task, impacts: usize, blocks: Vec<Block>) {
        let before = self.undecided.len();
        let is_whole = blocks.iter().all(|block| block.is_whole);
        let mut distinct: BTreeMap<String, Vec<PeriodicOrbit>> = BTreeMap::new();
        let mut count = 0;
        for block in blocks {
            self.undecided.extend(block.undecided.iter().map(|chain| (impacts, region(task, chain))));
            for found in block.found {
                match self.is_counted(task, &found) {
                    Some(false) => continue,
                    Some(true) => {}
                    None => {
                        self.leave(impacts, &found.orbit);
                        continue;
                    }
                }
                let key = format!("{} {}", found.problem.chain().cycles(), found.problem.word());
                let known = distinct.entry(key).or_default();
                let guess: Vec<f64> = found.orbit.phases().iter().map(|phase| phase.mid()).collect();
                let proved = found.problem.prove_reduced(&guess, task.precision, known.iter());
                let proved = proved.filter(|(orbit, _)| found.problem.is_reduced(&found.orbit, orbit) == Some(true));
                match proved {
                    Some((_, Identity::Known)) => {}
                    Some((orbit, Identity::New)) => match self.list(task, &found.problem, &orbit) {
                        Some(least) => {
                            count += if impacts.is_multiple_of(least) { least } else { 0 }; // D23: only states with F^n = 1
                            known.push(orbit);
                        }
                        None => self.leave(impacts, &orbit),
                    },
                    _ => self.leave(impacts, &found.orbit),
                }
            }
        }
        if is_whole && self.undecided.len() == before {
            self.fixed_points.insert(impacts, count);
        }
    }

    /// Leaves an orbit undecided.
    fn leave(&mut self, impacts: usize, orbit: &PeriodicOrbit) {
        self.undecided.push((impacts, Region { impacts: orbit.impacts.clone(), reason: Reason::Precision }));
    }

    /// Whether an orbit is admissible and lies in the region; `None` if undecided.
    fn is_counted(&self, task: &Task, found: &Found) -> Option<bool> {
        if !found.orbit.physical? {
            return Some(false);
        }
        let fastest = task.law.beta()?;
        let impacts = found.orbit.impacts.iter().zip(found.orbit.phases());
        let mut places = impacts.map(|(impact, &phase)| {
            let (low, high) = impact.velocity.to_f64_bounds();
            let speed = Ball::from(Interval::new(low, high)).checked_div(fastest)?;
            match impact.wall {
                Wall::Left => self.trap.region().holds(phase, -speed),
                Wall::Right => self.trap.region().holds(phase + Ball::exact(0.5), speed),
            }
        });
        // One impact in the region has all later ones there, so all.
        places.find_map(|place| place)
    }

    /// Lists the cycle that an orbit runs through, if it is not listed, and returns its impacts; `None` where it is not proved which it is.
    fn list(&mut self, task: &Task, problem: &Problem, orbit: &PeriodicOrbit) -> Option<usize> {
        let impacts = problem.reduced_impacts(orbit)?;
        let (problem, phases) = problem.least(impacts, orbit)?;
        let same = |cycle: &&Cycle| {
            let (one, other) = (cycle.problem.chain(), problem.chain());
            cycle.problem.word() == problem.word() && one.cycles() == other.cycles()
        };
        let known = self.cycles.iter().filter(same).map(|cycle| &cycle.orbit);
        let guess: Vec<f64> = phases.iter().map(|phase| phase.mid()).collect();
        let (least, identity) = problem.prove_reduced(&guess, task.precision, known)?;
        let is_it = problem.is_all_of(&phases, &least) && least.physical == Some(true);
        if !is_it || identity == Identity::Open {
            return None;
        }
        if identity == Identity::New {
            self.cycles.push(Cycle { impacts, problem, orbit: least });
        }
        Some(impacts)
    }

    /// Trapping region that holds the cycles.
    pub fn trap(&self) -> &Trap {
        &self.trap
    }

    /// Requested numbers of impacts.
    pub fn requested(&self) -> &RangeInclusive<u32> {
        &self.requested
    }

    /// For each number of impacts, the number of states of the region that return after it, where proved.
    pub fn fixed_points(&self) -> &BTreeMap<usize, usize> {
        &self.fixed_points
    }

    /// Cycles, each once, by their impacts, words and phases.
    pub fn cycles(&self) -> &[Cycle] {
        &self.cycles
    }

    /// Regions where other cycles may be, each with its number of impacts.
    pub fn undecided(&self) -> &[(usize, Region)] {
        &self.undecided
    }

    /// Whether no other cycles exist for all requested numbers of impacts.
    pub fn is_exhaustive(&self) -> bool {
        self.requested.clone().all(|impacts| self.fixed_points.contains_key(&(impacts as usize))) // exact: a small whole number
    }

    /// Whether everything requested is proved: no other cycles, and the stability of each cycle, to the requested width.
    pub fn is_certified(&self) -> bool {
        self.is_exhaustive() && self.cycles.iter().all(|cycle| cycle.orbit.is_decided() && cycle.orbit.is_narrow)
    }

    /// Whether all cycles of the requested numbers of impacts are proved to be unstable.
    pub fn has_no_attractor(&self) -> bool {
        self.is_exhaustive() && self.cycles.iter().all(|cycle| cycle.orbit.stability == Stability::Unstable)
    }
}

/// Result of the search in a block.
struct Block {
    found: Vec<Found>,
    undecided: Vec<Chain>,
    is_whole: bool,
}

/// Searches all blocks, side by side; in their order.
fn searched(task: &Task, graph: &Graph, impacts: usize, done: &AtomicUsize) -> Vec<Block> {
    answers(available(), graph.blocks.len(), &|at| {
        let block = task.watch.goes_on().then(|| searched_block(task, graph, at, impacts));
        let stopped = Block { found: Vec::new(), undecided: Vec::new(), is_whole: false };
        done.fetch_add(1, Ordering::Relaxed);
        Some(block.unwrap_or(stopped)) // exact: nothing is certified
    })
}

fn searched_block(task: &Task, graph: &Graph, block: usize, impacts: usize) -> Block {
    let Some(layers) = graph.layers(block, impacts) else {
        return Block { found: Vec::new(), undecided: Vec::new(), is_whole: true };
    };
    let mut search = Search::new(task, &layers);
    search.search();
    let Search { found, undecided, is_whole, .. } = search;
    Block { found: found.into_values().flatten().collect(), undecided, is_whole }
}

/// A chain that is left undecided, as the whole system sees it.
fn region(task: &Task, chain: &Chain) -> Region {
    let fastest = Interval::from(task.law.beta().expect("a gap is larger than 0"));
    let enclosure = |x: Interval| Enclosure::from_f64_bounds(x.inf(), x.sup()).expect("finite intervals");
    let mut crossed = 0_u32;
    let impact = |i: usize| {
        crossed += u32::from(i > 0 && chain.sides[i - 1].shift() > 0.0);
        let wall = if crossed.is_multiple_of(2) { Wall::Left } else { Wall::Right };
        let phase = chain.phases[i] - Interval::point(0.5 * f64::from(crossed));
        let speed = (chain.speeds[i] * fastest).signed(-wall.sign());
        PeriodicImpact { wall, phase: enclosure(phase), velocity: enclosure(speed) }
    };
    Region { impacts: (0..chain.len()).map(impact).collect(), reason: Reason::Precision }
}
