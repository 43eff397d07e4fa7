//! All periodic motions of a region with so many impacts: Lemmas D20-D22.

mod chain;
mod graph;
mod relation;
mod search;

use std::collections::BTreeMap;
use std::sync::Mutex;
use std::thread;

use super::flights::Law;
use super::region::{Trap, Untrapped};
use super::trap::Grid;
use crate::periodic::{Interval, Precision, PeriodicOrbit};
use crate::{Error, Scene};
use graph::Graph;
use relation::Relation;
use search::{Search, Task};

/// Prototype.
pub fn count(scene: &Scene, finer: u32, impacts: std::ops::RangeInclusive<usize>, width: f64, block: i64, march: i64) -> Result<Result<(), Untrapped>, Error> {
    let law = Law::of(scene.pair())?;
    let trap = match Trap::of(scene, finer, &|_| true)? {
        Ok(trap) => trap,
        Err(why) => return Ok(Err(why)),
    };
    let begun = std::time::Instant::now();
    let graph = Graph::new(&law, trap.region());
    eprintln!("{} cells, grid {:?} flight {:?} graph {:?}", graph.cells.len(), trap.grid(), trap.flight(), begun.elapsed());
    let [shortest, longest] = trap.flight();
    let task = Task {
        pair: scene.pair(),
        law: &law,
        relation: Relation::new(&law),
        times: Interval::new(shortest, longest),
        width,
        march: Grid { columns: march, rows: 1.0 },
        narrowest: 2f64.powi(-40),
        precision: Precision::default(),
        goes_on: &|| true,
    };
    // Blocks, the fastest first.
    let size = block;
    let mut blocks: BTreeMap<(i64, i64), Vec<u32>> = BTreeMap::new();
    let rows_per = (graph.grid.rows / graph.grid.columns as f64 * 8.0).max(1.0);
    let _ = rows_per;
    for (i, &(column, row)) in graph.cells.iter().enumerate() {
        blocks.entry((-(i64::from(row) / size), i64::from(column) / size)).or_default().push(i as u32);
    }
    let mut rank = vec![0_usize; graph.cells.len()];
    let blocks: Vec<Vec<u32>> = blocks.into_values().collect();
    for (at, cells) in blocks.iter().enumerate() {
        for &cell in cells {
            rank[cell as usize] = at;
        }
    }
    for n in impacts {
        let begun = std::time::Instant::now();
        let queue = Mutex::new(0..blocks.len());
        let results = Mutex::new(Vec::new());
        thread::scope(|scope| {
            for _ in 0..2 {
                scope.spawn(|| {
                    loop {
                        let Some(at) = queue.lock().unwrap().next() else { break };
                        let cells = &blocks[at];
                        let Some(layers) = graph.layers(cells, &|cell| rank[cell as usize] >= at, n) else { continue };
                        let mut search = Search::new(&task, &layers);
                        search.all();
                        let found: Vec<_> = search.found.into_values().flatten().collect();
                        results.lock().unwrap().push((at, search.chains, search.closed, found, search.undecided));
                    }
                });
            }
        });
        let results = results.into_inner().unwrap();
        let (chains, closed): (u64, u64) = results.iter().fold((0, 0), |(a, b), r| (a + r.1, b + r.2));
        let undecided: usize = results.iter().map(|r| r.4.len()).sum();
        let mut orbits: Vec<(search::Found, usize)> = Vec::new();
        let mut ghosts = 0;
        for found in results.into_iter().flat_map(|r| r.3) {
            if found.orbit.physical != Some(true) {
                ghosts += 1;
                if found.orbit.physical.is_none() { eprintln!("physical unknown"); }
                continue;
            }
            let phases: Vec<Interval> = found.orbit.phases().iter().map(|&x| Interval::of(x)).collect();
            if orbits.iter().any(|(other, _)| other.problem.word() == found.problem.word() && other.problem.chain().cycles() == found.problem.chain().cycles() && other.problem.holds(&phases, &other.orbit)) {
                continue;
            }
            let period = found.problem.reduced_impacts(&found.orbit).unwrap();
            orbits.push((found, period));
        }
        let points: usize = orbits.iter().map(|(_, period)| *period).sum();
        let unstable = orbits.iter().filter(|(o, _)| o.orbit.stability == crate::periodic::Stability::Unstable).count();
        eprintln!("n={n}: {points} fixed points, {} orbits ({unstable} unstable), {ghosts} ghosts, {undecided} undecided, {chains} chains, {closed} closed, {:?}", orbits.len(), begun.elapsed());
        let _: Vec<&PeriodicOrbit> = orbits.iter().map(|(o, _)| &o.orbit).collect();
    }
    Ok(Ok(()))
}
