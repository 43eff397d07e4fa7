//! The root of the pressure of words, and the ratios around their cycles, from both sides: Lemmas D27, D28 of `docs/proofs/hyperbolic.md#D27`.

use std::collections::BTreeMap;

use crate::number::{Ball, logarithm};

/// A step between two nodes of a graph, with bounds of its weight, and its length.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    pub from: usize,
    pub to: usize,
    pub weight: [f64; 2],
    pub length: f64,
}

/// Halvings, and steps towards an eigenvector.
const HALVINGS: u32 = 34;
const POWER_ITERATIONS: usize = 2000;
/// Distance from a root at which the first bound is looked for, and the factor by which the next one is farther.
const FIRST_BOUND_DISTANCE: f64 = 1e-9;
const DISTANCE_FACTOR: f64 = 8.0;
const TRIES: u32 = 8;

/// The end of the weights that a bound rests on.
#[derive(Clone, Copy, PartialEq)]
enum End {
    Least,
    Most,
}

fn weight(edge: &Edge, end: End) -> f64 {
    edge.weight[usize::from(end == End::Most)]
}

/// Bounds the number `t >= 0` at which the sum of `exp(-t weight)` over the ways has the growth 0, for all weights within their bounds; all
/// nodes are to be on ways from each to each. Lemma D27
pub(crate) fn root(edges: &[Edge]) -> Option<[f64; 2]> {
    let (edges, nodes) = dense(edges);
    let bound = |end: End| {
        let middle = proposed(&edges, nodes, end);
        let sign = if end == End::Least { 1.0 } else { -1.0 };
        let mut apart = FIRST_BOUND_DISTANCE;
        (0..TRIES).find_map(|_| {
            let at = (middle + sign * apart).max(0.0); // proposes: proved below
            apart *= DISTANCE_FACTOR;
            is_bound(&edges, nodes, end, at).then_some(at)
        })
    };
    Some([bound(End::Most)?, bound(End::Least)?])
}

/// About where the growth is 0, weights being at one end.
fn proposed(edges: &[Edge], nodes: usize, end: End) -> f64 {
    let grows = |t: f64| {
        let matrix: Vec<(usize, usize, f64)> =
            edges.iter().map(|edge| (edge.from, edge.to, (-t * weight(edge, end)).exp())).collect();
        eigenvector(&matrix, nodes).1 > 1.0
    };
    let (mut low, mut high) = (0.0, 1.0);
    while grows(high) && high < 64.0 {
        (low, high) = (high, 2.0 * high);
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        *if grows(middle) { &mut low } else { &mut high } = middle;
    }
    0.5 * (low + high)
}

/// A positive vector about that of the greatest eigenvalue of the matrix, and about this one.
fn eigenvector(matrix: &[(usize, usize, f64)], nodes: usize) -> (Vec<f64>, f64) {
    let (mut vector, mut value) = (vec![1.0; nodes], 0.0);
    for _ in 0..POWER_ITERATIONS {
        // The identity is added, so that all parts of a period are mixed.
        let mut image = vector.clone();
        matrix.iter().for_each(|&(from, to, q)| image[from] += q * vector[to]);
        let [mut least, mut most, mut top] = [f64::INFINITY, 0.0f64, 0.0f64];
        for (x, y) in vector.iter().zip(&image) {
            (least, most, top) = (least.min(y / x), most.max(y / x), top.max(*y)); // proposes: any positive vector will do
        }
        value = 0.5 * (least + most) - 1.0;
        vector = image.iter().map(|y| y / top).collect();
        if most - least < 1e-13 {
            break;
        }
    }
    (vector, value)
}

/// Whether the growth at `t` is proved: at most 0 with all weights at their least, or at least 0 with all weights at their most. Lemma D27
fn is_bound(edges: &[Edge], nodes: usize, end: End, t: f64) -> bool {
    let sign = if end == End::Least { 1.0 } else { -1.0 };
    let mut matrix = Vec::with_capacity(edges.len());
    for edge in edges {
        let exponent = Ball::exact(t) * Ball::exact(-weight(edge, end));
        let q = exponent.mid().exp() * (1.0 + sign * 1e-13); // proposes: proved by its logarithm
        let Some(log) = logarithm(Ball::exact(q)) else { return false };
        let excess = Ball::exact(sign) * (log - exponent);
        if !is_not_negative(excess) {
            return false;
        }
        matrix.push((edge.from, edge.to, q));
    }
    let (vector, _) = eigenvector(&matrix, nodes);
    let mut excess: Vec<Ball> = vector.iter().map(|&x| Ball::exact(x)).collect();
    matrix.iter().for_each(|&(from, to, q)| excess[from] = excess[from] - Ball::exact(q) * Ball::exact(vector[to]));
    vector.iter().all(|&x| x > 0.0) && excess.iter().all(|&x| is_not_negative(Ball::exact(sign) * x))
}

/// Whether no member is negative; `false` for a NaN.
fn is_not_negative(x: Ball) -> bool {
    x.mid() >= x.rad()
}

/// The edges with their nodes numbered anew without gaps, and the number of nodes.
fn dense(edges: &[Edge]) -> (Vec<Edge>, usize) {
    let mut numbers = BTreeMap::new();
    let mut number = |node: usize| {
        let next = numbers.len();
        *numbers.entry(node).or_insert(next)
    };
    let edges = edges.iter().map(|edge| Edge { from: number(edge.from), to: number(edge.to), ..*edge }).collect();
    (edges, numbers.len())
}

/// Bounds the ratio of weight to length around all cycles. Lemma D28
pub(crate) fn ratios(edges: &[Edge]) -> [f64; 2] {
    let (edges, nodes) = dense(edges);
    let mirrored: Vec<Edge> =
        edges.iter().map(|edge| Edge { weight: [-edge.weight[1], -edge.weight[0]], ..*edge }).collect();
    [least_ratio(&edges, nodes), -least_ratio(&mirrored, nodes)]
}

fn least_ratio(edges: &[Edge], nodes: usize) -> f64 {
    let ratio = |edge: &Edge| edge.weight[0] / edge.length;
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    edges.iter().map(ratio).for_each(|x| (low, high) = (low.min(x), high.max(x))); // proposes: where to look
    let mut potentials = vec![0.0; nodes];
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        match shortest(edges, nodes, middle) {
            Some(found) => (low, potentials) = (middle, found),
            None => high = middle,
        }
    }
    // Lemma D28: for whatever potentials
    edges.iter().fold(f64::INFINITY, |least, edge| {
        let sum = Ball::exact(edge.weight[0]) + Ball::exact(potentials[edge.from]) - Ball::exact(potentials[edge.to]);
        let low = (sum.mid() - sum.rad()).next_down();
        // D28: rounded down
        let bound = (low / edge.length).next_down();
        if bound < least { bound } else { least }
    })
}

/// The least ways to all nodes, an edge weighing its least weight less its length times the ratio; `None` where a cycle is negative.
fn shortest(edges: &[Edge], nodes: usize, ratio: f64) -> Option<Vec<f64>> {
    let mut path_weights = vec![0.0; nodes];
    for _ in 0..=nodes {
        let mut is_done = true;
        for edge in edges {
            let path_weight = path_weights[edge.from] + edge.weight[0] - ratio * edge.length;
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
