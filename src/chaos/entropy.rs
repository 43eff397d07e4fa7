//! Entropy of words: Lemma D10 of `docs/proofs/chaos.md#D10`.

use super::words::Path;
use crate::number::{Ball, logarithm};

/// The sums `M_ab = sum q^k` over the words from `a` to `b`.
fn sums(words: &[Path], bases: usize, weight: impl Fn(&Path) -> i64, q: Ball) -> Vec<Vec<Ball>> {
    let mut matrix = vec![vec![Ball::exact(0.0); bases]; bases];
    let most = words.iter().map(&weight).max().unwrap_or(0); // exact: none where there are no words
    let mut powers = vec![Ball::exact(1.0)];
    for k in 0..most {
        powers.push(powers[k as usize] * q); // exact: not negative
    }
    for word in words {
        let entry = &mut matrix[word.from][word.to];
        *entry = *entry + powers[weight(word) as usize]; // exact: not negative
    }
    matrix
}

/// Lower bound of the entropy of all sequences of words, per unit of `weight`: per impact, or per half forcing period.
///
/// 0 where none is proved.
pub(crate) fn entropy(words: &[Path], bases: usize, weight: impl Fn(&Path) -> i64 + Copy) -> f64 {
    if words.len() < 2 || words.iter().any(|word| weight(word) < 1) {
        return 0.0; // exact: nothing is certified; one word has no entropy
    }
    let reached = |q: f64| is_reached(&sums(words, bases, weight, Ball::exact(q)));
    // proposes: the greatest sum is found by halving
    let (mut low, mut high) = (0.0f64, 1.0f64);
    for _ in 0..54 {
        let middle = 0.5 * (low + high);
        if reached(middle) { high = middle } else { low = middle }
    }
    match logarithm(Ball::exact(high)) {
        Some(log) if reached(high) => (-(log.mid() + log.rad())).next_down().max(0.0), // D10: no entropy is negative
        _ => 0.0,
    }
}

/// Whether the spectral radius is proved to be at least 1: a non-negative vector does not shrink.
fn is_reached(matrix: &[Vec<Ball>]) -> bool {
    let size = matrix.len();
    let mut vector = vec![1.0f64; size];
    for _ in 0..400 {
        let image: Vec<f64> =
            (0..size).map(|a| vector[a] + (0..size).map(|b| matrix[a][b].mid() * vector[b]).sum::<f64>()).collect();
        let most = image.iter().fold(0.0, |most: f64, x| most.max(*x)); // proposes: any vector will do
        vector = image.iter().map(|x| if *x < 1e-9 * most { 0.0 } else { x / most }).collect();
    }
    (0..size).all(|a| {
        let sum = (0..size).fold(Ball::exact(0.0), |sum, b| sum + matrix[a][b] * Ball::exact(vector[b]));
        let excess = sum - Ball::exact(vector[a]);
        excess.mid() >= excess.rad() || vector[a] == 0.0 // D10: nothing to reach
    }) && vector.iter().any(|&x| x > 0.0)
}
