//! Growth of graphs and ratios around their cycles, proved from vectors and potentials (Lemma V14).

use std::collections::BTreeMap;

use super::super::span::Span;
use super::powers::exponential;

/// A step between nodes: what it weighs, and its length.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    pub from: usize,
    pub to: usize,
    pub weight: Span,
    pub length: f64,
}

/// A graph whose nodes all occur.
pub(super) struct Graph {
    edges: Vec<Edge>,
    nodes: usize,
}

/// Steps towards a vector that grows by one number.
const STEPS: usize = 2000;
/// Rounds in which the shortest ways are found: ways are as long as strings, not as graphs.
const MAX_ROUNDS: usize = 256;
/// What is taken off each edge where the shortest ways are found, so that roundings do not decide.
const SLACK: f64 = 1e-12;

type Matrix = Vec<(usize, usize, f64)>;

impl Graph {
    pub fn new(edges: impl Iterator<Item = Edge>) -> Self {
        let mut numbers = BTreeMap::new();
        let mut number = |node: usize| {
            let next = numbers.len();
            *numbers.entry(node).or_insert(next)
        };
        let edges = edges.map(|edge| Edge { from: number(edge.from), to: number(edge.to), ..edge }).collect();
        Self { edges, nodes: numbers.len() }
    }

    /// Returns whether the growth is proved to be 0 for a number that is at most `t`, or at least.
    pub fn is_root(&self, t: f64, is_at_most: bool) -> bool {
        let Some(matrix) = self.powers(t, is_at_most) else { return false };
        let vector = self.vector(&matrix);
        let mut sums = vec![Span::point(0.0); self.nodes];
        for &(from, to, q) in &matrix {
            sums[from] = sums[from] + Span::point(q) * Span::point(vector[to]);
        }
        let is_kept = |(sum, x): (&Span, &f64)| if is_at_most { sum.hi() <= *x } else { sum.lo() >= *x };
        // V14: a graph without nodes does not grow
        self.nodes > 0 && vector.iter().all(|&x| x > 0.0) && sums.iter().zip(&vector).all(is_kept)
    }

    /// `exp(-t weight)` of each edge, none less than it is, or none more.
    fn powers(&self, t: f64, is_upper: bool) -> Option<Matrix> {
        let t = Span::point(t);
        let of = |edge: &Edge| {
            let x = t * edge.weight;
            let x = if is_upper { x.lo() } else { x.hi() };
            if x < 0.0 {
                return None; // exact: nothing is confirmed
            }
            let q = exponential(-x)?;
            Some((edge.from, edge.to, if is_upper { q.hi() } else { q.lo() }))
        };
        self.edges.iter().map(of).collect()
    }

    /// A positive vector that grows about by one number.
    fn vector(&self, matrix: &Matrix) -> Vec<f64> {
        let mut vector = vec![1.0; self.nodes];
        for _ in 0..STEPS {
            let mut image = vector.clone();
            matrix.iter().for_each(|&(from, to, q)| image[from] += q * vector[to]);
            let [mut least, mut most, mut top] = [f64::MAX, 0.0f64, 0.0f64];
            for (x, y) in vector.iter().zip(&image) {
                (least, most, top) = (least.min(y / x), most.max(y / x), top.max(*y)); // proposes: any positive vector
            }
            vector = image.iter().map(|y| y / top).collect();
            if most - least < 1e-13 {
                break;
            }
        }
        vector
    }

    /// Returns whether the ratio of weight to length around every cycle is proved to be at least `bound`, or at most.
    pub fn is_ratio(&self, bound: f64, is_at_least: bool) -> bool {
        let bound = Span::point(bound);
        let excess = |edge: &Edge| (edge.weight - bound * Span::point(edge.length)).signed(is_at_least);
        let excesses: Vec<Span> = self.edges.iter().map(excess).collect();
        let potentials = self.shortest(&excesses);
        let is_kept = |(edge, excess): (&Edge, &Span)| {
            (*excess + Span::point(potentials[edge.from]) - Span::point(potentials[edge.to])).lo() >= 0.0
        };
        // V14: a graph without edges has no loops
        !self.edges.is_empty() && self.edges.iter().zip(&excesses).all(is_kept)
    }

    /// About the lengths of the shortest ways to all nodes, an edge being as long as the least of its excess, less the slack.
    fn shortest(&self, excesses: &[Span]) -> Vec<f64> {
        let mut lengths = vec![0.0; self.nodes];
        // proposes: how long
        for _ in 0..=self.nodes.min(MAX_ROUNDS) {
            let mut is_done = true;
            for (edge, excess) in self.edges.iter().zip(excesses) {
                let length = lengths[edge.from] + excess.lo() - SLACK;
                if length < lengths[edge.to] - 0.1 * SLACK {
                    lengths[edge.to] = length;
                    is_done = false;
                }
            }
            if is_done {
                break;
            }
        }
        lengths
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::LN_2;

    use super::*;

    fn edge(from: usize, to: usize, weight: [f64; 2], length: f64) -> Edge {
        Edge { from, to, weight: Span::new(weight[0], weight[1]), length }
    }

    /// No number bounds what is not there.
    #[test]
    fn an_empty_graph_has_no_root_and_no_ratio() {
        let none = Graph::new([].into_iter());
        for bound in [-1.0, 0.0, 0.5] {
            assert!([true, false].into_iter().all(|end| !none.is_root(bound, end) && !none.is_ratio(bound, end)));
        }
    }

    /// Two edges at one node: the growth of `2 e^(-t x)` is 0 at `ln 2 / x`.
    #[test]
    fn a_root_is_bounded_by_both_ends_of_the_weights() {
        let graph = Graph::new([edge(0, 0, [2.0, 3.0], 1.0), edge(0, 0, [2.0, 3.0], 1.0)].into_iter());
        assert!(graph.is_root(LN_2 / 2.0 + 1e-9, true) && !graph.is_root(LN_2 / 2.0 - 1e-9, true));
        assert!(graph.is_root(LN_2 / 3.0 - 1e-9, false) && !graph.is_root(LN_2 / 3.0 + 1e-9, false));
        assert!([-1.0, f64::NAN].into_iter().all(|t| !graph.is_root(t, true) && !graph.is_root(t, false)));
    }

    /// Loops of ratios 1 and 1/2, the second one by a weight of 5 and one of -4.
    #[test]
    fn ratios_are_bounded_by_those_of_loops() {
        let graph = |w: f64| {
            let all = [(0, 0, 1.0), (0, 1, 5.0), (1, 0, -4.0)];
            Graph::new(all.into_iter().map(|(from, to, x)| edge(from, to, [x - w, x + w], 1.0)))
        };
        for (width, [least, most]) in [(0.0, [0.5, 1.0]), (0.25, [0.25, 1.25])] {
            let graph = graph(width);
            assert!(graph.is_ratio(least - 1e-9, true) && !graph.is_ratio(least + 1e-9, true));
            assert!(graph.is_ratio(most + 1e-9, false) && !graph.is_ratio(most - 1e-9, false));
            assert!(!graph.is_ratio(f64::NAN, true) && !graph.is_ratio(f64::NAN, false));
        }
    }
}
