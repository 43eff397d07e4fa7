//! Words of motions against what the graph allows, counts against an enumeration, growth rates that are known.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::LN_2;

use super::*;
use crate::chaos::cycles::{Cycle, Cycles};
use crate::chaos::guess::Guess;
use crate::watch::{Stage, Unwatched, proceed_if};
use crate::{Effort, Scene, chaos::scene::visited};

fn figure(number: u32) -> Scene {
    crate::tests::scene(&format!("figure-{number}"))
}

fn of(number: u32) -> (Scene, Trap, BoxGraph) {
    let scene = figure(number);
    let trap = Trap::of(&scene, Effort::default(), &Unwatched).unwrap().unwrap();
    let graph = BoxGraph::of(scene.pair(), &trap).unwrap();
    (scene, trap, graph)
}

fn words(graph: &BoxGraph, impacts: u32) -> WallWords {
    WallWords::of(graph, impacts, &Unwatched).unwrap()
}

/// Edges of a graph.
type Edges<'e> = &'e [(u32, char, u32)];

/// Graph of `boxes` boxes with these edges.
fn small(boxes: i32, edges: Edges<'_>) -> BoxGraph {
    let side = |letter| if letter == 'F' { Side::Far } else { Side::Near };
    let edges = edges.iter().map(|&(from, letter, to)| Edge { from, side: side(letter), to }).collect();
    BoxGraph { cells: (0..boxes).map(|column| (column, 0)).collect(), edges }
}

/// The boxes and letters of a floating-point orbit from the region on.
fn orbit(scene: &Scene, trap: &Trap, impacts: usize) -> (Vec<Cell>, String) {
    let law = Law::of(scene.pair()).unwrap();
    let (guess, grid) = (Guess::new(&law), trap.region().grid);
    let mut state = [0.778, 1.2345];
    let (mut cells, mut letters) = (Vec::new(), String::new());
    for k in 0..impacts {
        let next = guess.map(state).unwrap();
        if k >= 1000 {
            cells.push(grid.cell(state[0], state[1]));
            letters.push(letter(next.side));
        }
        state = next.state;
    }
    (cells, letters)
}

/// Number of steps of an orbit that have no edge.
fn missed(graph: &BoxGraph, (cells, letters): &(Vec<Cell>, String)) -> usize {
    let edges: BTreeSet<(Cell, char, Cell)> =
        graph.edges().map(|(from, letter, to)| (graph.cells[from], letter, graph.cells[to])).collect();
    let steps = cells.windows(2).zip(letters.chars());
    steps.filter(|(step, letter)| !edges.contains(&(step[0], *letter, step[1]))).count()
}

/// Lemma D30, against floating-point orbits, the certified beginning of the scene's own and, of figure 14, all short periodic motions.
#[test]
fn motions_make_words_that_are_allowed() {
    for number in [14, 16, 17] {
        let (scene, trap, graph) = of(number);
        let orbit = orbit(&scene, &trap, 5000);
        assert_eq!(missed(&graph, &orbit), 0, "figure {number}");
        let words = words(&graph, 12);
        assert!(words.is_closed() && words.allows(&orbit.1), "figure {number}");
        let entered = trap.entered().unwrap();
        let visited = visited(scene.pair(), scene.start(), 40).unwrap();
        let walls: Vec<_> = visited.iter().filter(|state| state.index >= entered).map(|state| state.wall).collect();
        let own = walls.windows(2).map(|walls| if walls[0] == walls[1] { 'N' } else { 'F' });
        assert!(walls.len() > 20 && words.allows(&own.collect::<String>()), "figure {number}");
    }
    let (scene, _, graph) = of(14);
    let words = words(&graph, 1);
    let cycles = Cycles::of(&scene, Effort::default(), &(1..=9), Default::default(), &Unwatched).unwrap().unwrap();
    for cycle in cycles.cycles() {
        let walls: Vec<_> = cycle.orbit.impacts.iter().map(|impact| impact.wall).collect();
        let next = walls.iter().skip(1).chain(&walls[..1]);
        let word: String = walls.iter().zip(next).map(|(a, b)| if a == b { 'N' } else { 'F' }).collect();
        assert!(words.allows(&word.repeat(20)), "{word}");
    }
    assert!(cycles.cycles().len() > 20);
}

/// Broken on purpose: the orbit takes an edge that is left out, and where one letter is left out its words are none.
#[test]
fn an_edge_that_is_left_out_is_seen() {
    let (scene, trap, graph) = of(14);
    let orbit = orbit(&scene, &trap, 5000);
    let taken = (orbit.0[0], orbit.1.chars().next().unwrap(), orbit.0[1]);
    let is_it =
        |edge: &Edge| (graph.cells[edge.from as usize], letter(edge.side), graph.cells[edge.to as usize]) == taken;
    let without = |is_out: &dyn Fn(&Edge) -> bool| {
        let edges: Vec<Edge> = graph.edges.iter().copied().filter(|edge| !is_out(edge)).collect();
        BoxGraph { cells: graph.cells.clone(), edges }
    };
    let one_less = without(&is_it);
    assert_eq!((one_less.edges.len(), missed(&graph, &orbit)), (graph.edges.len() - 1, 0));
    assert!(missed(&one_less, &orbit) > 0);
    assert!(!words(&without(&|edge| edge.side == Side::Near), 5).allows(&orbit.1));
}

/// Lemma D30: the words of the graph, one after another, by the ways themselves.
#[test]
fn words_are_counted_as_they_are() {
    let (_, _, graph) = of(14);
    let mut next: BTreeMap<(usize, char), Vec<usize>> = BTreeMap::new();
    graph.edges().for_each(|(from, letter, to)| next.entry((from, letter)).or_default().push(to));
    let all: BTreeSet<usize> = (0..graph.cells.len()).collect();
    let mut ends = BTreeMap::from([(String::new(), all)]);
    for impacts in 1..=9 {
        let mut longer: BTreeMap<String, BTreeSet<usize>> = BTreeMap::new();
        for (word, ends) in &ends {
            for letter in ['F', 'N'] {
                let to = ends.iter().flat_map(|&at| next.get(&(at, letter)).into_iter().flatten()).copied();
                let to: BTreeSet<usize> = to.collect();
                if !to.is_empty() {
                    longer.insert(format!("{word}{letter}"), to);
                }
            }
        }
        ends = longer;
        assert_eq!(*words(&graph, impacts).count(), BigUint::from(ends.len()), "{impacts}");
    }
    assert!(ends.keys().all(|word| words(&graph, 9).allows(word)) && ends.len() < 1 << 9);
}

/// Lemma D31: growth rates that are known, each rounded upward and no further than that.
#[test]
fn growth_rates_are_those_of_known_shifts() {
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    // No two N in a row; every word; even numbers of N between two F; a circle of three boxes; a loop that leads to a faster one.
    let shifts: [(Edges<'_>, i32, f64, u64); 5] = [
        (&[(0, 'F', 0), (0, 'N', 1), (1, 'F', 0)], 2, golden, 8),
        (&[(0, 'F', 0), (0, 'N', 0)], 1, 2.0, 16),
        (&[(0, 'F', 0), (0, 'N', 1), (1, 'N', 0)], 2, golden, 12),
        (&[(0, 'F', 1), (1, 'F', 2), (2, 'N', 0)], 3, 1.0, 3),
        (&[(0, 'F', 0), (0, 'N', 1), (1, 'F', 1), (1, 'N', 2), (2, 'F', 1)], 3, golden, 12),
    ];
    for (edges, boxes, rate, of_four) in shifts {
        let graph = small(boxes, edges);
        assert_eq!(*words(&graph, 4).count(), BigUint::from(of_four), "{edges:?}");
        let found = words(&graph, 1).entropy();
        assert!(found >= rate.ln() && found < rate.ln() + 1e-12, "{edges:?}: {found}");
    }
}

/// Each count bounds the entropy, and the more the longer; what is stopped has none.
#[test]
fn longer_words_bound_the_entropy_more_narrowly() {
    let (_, _, graph) = of(14);
    let all = words(&graph, 400);
    let by_counts: Vec<f64> = [1, 22, 400].map(|n| growth::rate(&all.counts[n as usize - 1], n)).into();
    assert!(by_counts.windows(2).all(|pair| pair[1] < pair[0]) && by_counts.iter().all(|&rate| all.entropy() <= rate));
    // Sound for powers of two, whose logarithm is known.
    let two = growth::rate(&(BigUint::from(1_u32) << 4000_u32), 4000);
    assert!((LN_2..LN_2 + 1e-12).contains(&two));
    assert_eq!(
        WallWords::of(&graph, 22, &|at: Stage<'_>| proceed_if(!matches!(at, Stage::Sets(3..)))).unwrap_err(),
        Unclosed::Interrupted
    );
    assert!(
        !WallWords::of(&graph, 2, &|at: Stage<'_>| proceed_if(!matches!(at, Stage::Sets(20..)))).unwrap().is_closed()
    );
}

/// Bounds that `docs/paper.md` gives for figures 14 and 17, whose horseshoes have more entropy: 0.4704 and 0.569. In figure 14 two cycles
/// of five impacts have one word, and none of fewer. Lemma D32
#[test]
fn walls_do_not_distinguish_motions() {
    for (number, effort, most) in [(14, "1", 0.4224), (14, "8", 0.3814), (17, "1", 0.4816)] {
        let scene = figure(number);
        let trap = Trap::of(&scene, effort.parse().unwrap(), &Unwatched).unwrap().unwrap();
        let found = words(&BoxGraph::of(scene.pair(), &trap).unwrap(), 22).entropy();
        assert!(found < most && found > most - 2e-4, "figure {number}, {effort}: {found}");
    }
    let cycles = Cycles::of(&figure(14), Effort::default(), &(1..=5), Default::default(), &Unwatched).unwrap().unwrap();
    assert!(cycles.is_exhaustive());
    let word = |cycle: &Cycle| (cycle.impacts, cycle.problem.word().to_string(), cycle.problem.chain().cycles());
    let words: Vec<_> = cycles.cycles().iter().map(word).collect();
    let five = (5, "P1 P2 P1 P2 P4".to_owned(), 2);
    assert_eq!(words, [(1, "P1 P2".to_owned(), 1), (3, "P1 P2 P4".to_owned(), 1), five.clone(), five]);
}
