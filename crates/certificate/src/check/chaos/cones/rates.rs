//! Growth of graphs and ratios around their cycles, proved from vectors and potentials (Lemma V14).

use std::collections::BTreeMap;

use super::super::span::Span;
use super::powers::{MAX_EXPONENT, exponential};

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

const STEPS: usize = 2000;
const HALVINGS: u32 = 40;
/// Potentials that are not found in N rounds are not looked for: ways are as long as strings, not as graphs.
const MAX_ROUNDS: usize = 256;
/// Distance of the first bound beyond an approximate root, and the greatest one of the last bound.
const FIRST_BOUND_DISTANCE: f64 = 1e-9;
const LAST_BOUND_DISTANCE: f64 = 1e-2;

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
        let vector = self.vector(&matrix).0;
        let mut sums = vec![Span::point(0.0); self.nodes];
        for &(from, to, q) in &matrix {
            sums[from] = sums[from] + Span::point(q) * Span::point(vector[to]);
        }
        let is_kept = |(sum, x): (&Span, &f64)| if is_at_most { sum.hi() <= *x } else { sum.lo() >= *x };
        vector.iter().all(|&x| x > 0.0) && sums.iter().zip(&vector).all(is_kept)
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

    /// A positive vector that about grows by one number, and about that one.
    fn vector(&self, matrix: &Matrix) -> (Vec<f64>, f64) {
        let (mut vector, mut growth) = (vec![1.0; self.nodes], 0.0);
        for _ in 0..STEPS {
            let mut image = vector.clone();
            matrix.iter().for_each(|&(from, to, q)| image[from] += q * vector[to]);
            let [mut least, mut most, mut top] = [f64::MAX, 0.0f64, 0.0f64];
            for (x, y) in vector.iter().zip(&image) {
                (least, most, top) = (least.min(y / x), most.max(y / x), top.max(*y)); // proposes: any positive vector
            }
            growth = 0.5 * (least + most) - 1.0;
            vector = image.iter().map(|y| y / top).collect();
            if most - least < 1e-13 {
                break;
            }
        }
        (vector, growth)
    }

    /// Returns numbers at most and at least that at which the growth is 0, for all weights.
    pub fn root(&self) -> Option<[f64; 2]> {
        let bound = |is_at_most: bool| {
            let weight = |edge: &Edge| if is_at_most { edge.weight.lo() } else { edge.weight.hi() };
            let (mut low, mut high) = (0.0, MAX_EXPONENT);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                let matrix =
                    self.edges.iter().map(|edge| (edge.from, edge.to, (-middle * weight(edge)).exp())).collect();
                *if self.vector(&matrix).1 > 1.0 { &mut low } else { &mut high } = middle;
            }
            let mut apart = FIRST_BOUND_DISTANCE;
            while apart < LAST_BOUND_DISTANCE {
                let t = if is_at_most { high + apart } else { (low - apart).max(0.0) }; // proposes: proved here
                if self.is_root(t, is_at_most) {
                    return Some(t);
                }
                apart *= 8.0;
            }
            None
        };
        Some([bound(false)?, bound(true)?])
    }

    /// Returns a number that is at most the ratio of weight to length around every cycle, or one that is at least it.
    pub fn ratio(&self, is_least: bool) -> f64 {
        let weights: Vec<f64> =
            self.edges.iter().map(|edge| if is_least { edge.weight.lo() } else { -edge.weight.hi() }).collect();
        let ratio = |(edge, weight): (&Edge, &f64)| weight / edge.length;
        let (mut low, mut high) = (f64::MAX, f64::MIN);
        self.edges.iter().zip(&weights).map(ratio).for_each(|x| (low, high) = (low.min(x), high.max(x))); // proposes: where to look
        let mut potentials = vec![0.0; self.nodes];
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            match self.shortest(&weights, middle) {
                Some(found) => (low, potentials) = (middle, found),
                None => high = middle,
            }
        }
        let mut least = f64::MAX;
        for (edge, weight) in self.edges.iter().zip(&weights) {
            let sum = Span::point(*weight) + Span::point(potentials[edge.from]) - Span::point(potentials[edge.to]);
            let Some(ratio) = sum.over(Span::point(edge.length)) else { return f64::NAN };
            // V14: the least of all, or NaN
            least = if ratio.lo() >= least { least } else { ratio.lo() };
        }
        if is_least { least } else { -least }
    }

    fn shortest(&self, weights: &[f64], ratio: f64) -> Option<Vec<f64>> {
        let mut path_weights = vec![0.0; self.nodes];
        // proposes: how long
        for _ in 0..=self.nodes.min(MAX_ROUNDS) {
            let mut is_done = true;
            for (edge, weight) in self.edges.iter().zip(weights) {
                let path_weight = path_weights[edge.from] + weight - ratio * edge.length;
                if path_weight < path_weights[edge.to] - 1e-13 {
                    path_weights[edge.to] = path_weight;
                    is_done = false;
                }
            }
            if is_done {
                return Some(path_weights);
            }
        }
        None
    }
}
