//! The orbits of a ring with an eigenvalue: a given one, or any. Lemmas Y3, Y8

use super::super::family::{Family, Varied};
use super::super::ring::Ring;
use super::{Shape, are_neighbours};
use crate::several::PhaseNumber;

/// Whether equation `i` of `F = 0`, `F'_mu w = 0` contains unknown `j` of `(u, w, p)`, or `mu` after them.
fn critical_contains(i: usize, j: usize, m: usize) -> bool {
    match (i < m, j / m) {
        (true, 1) if j < 2 * m => false,
        (true, _) => j == 2 * m || j < m && are_neighbours(i, j, m),
        (false, _) => j >= 2 * m || are_neighbours(i % m, j % m, m),
    }
}

/// The coefficients of `c w` in all unknowns.
fn normed(direction: &[f64], unknowns: usize) -> Vec<f64> {
    let (m, mut all) = (direction.len(), vec![0.0; unknowns]);
    all[m..2 * m].copy_from_slice(direction);
    all
}

/// `c w - 1`
fn off_norm<N: PhaseNumber>(direction: &[f64], w: &[N]) -> N {
    let along = |sum: N, (c, w): (&f64, &N)| N::from_f64(*c).mul_add(w.clone(), sum);
    direction.iter().zip(w).fold(N::from_f64(-1.0), along)
}

/// An orbit with an eigenvalue `mu` of 1 (40) or -1 (39): unknowns `(u, w, p)`, `F'_mu w = 0`, `c w = 1`. Lemma Y3
#[derive(Clone, Debug)]
pub struct Critical<'r> {
    pub ring: &'r Ring,
    pub mu: f64,
    /// `c`
    pub direction: Vec<f64>,
}

impl Shape for Critical<'_> {
    fn unknowns(&self) -> usize {
        2 * self.ring.unknowns() + 1
    }

    fn contains(&self, i: usize, j: usize) -> bool {
        critical_contains(i, j, self.ring.unknowns())
    }

    fn linear(&self, i: usize) -> Option<Vec<f64>> {
        (i == 2 * self.ring.unknowns()).then(|| normed(&self.direction, self.unknowns()))
    }
}

impl Critical<'_> {
    /// See [`System::values`](super::System::values).
    pub fn values<S: Varied, N: PhaseNumber>(&self, family: &Family<S, N>, x: &[N]) -> Option<Vec<N>> {
        let (p, rest) = x.split_last()?;
        let (phases, w) = rest.split_at(self.ring.unknowns());
        let pair = family.pair(p.clone());
        let legs = self.ring.legs(&pair, phases)?;
        let mut values = self.ring.residual(&pair, &legs);
        values.extend(self.ring.twisted(&self.ring.chain().slopes(&pair, &legs)?, w, self.mu));
        values.push(off_norm(&self.direction, w));
        Some(values)
    }
}

/// The orbits with a real eigenvalue `mu`: unknowns `(u, w, p, mu)`, `F'_mu w = 0`, `c w = 1`, a curve. Lemma Y8
#[derive(Clone, Debug)]
pub struct Multiplied<'r> {
    pub ring: &'r Ring,
    /// `c`
    pub direction: Vec<f64>,
}

impl Shape for Multiplied<'_> {
    fn unknowns(&self) -> usize {
        2 * self.ring.unknowns() + 2
    }

    fn equations(&self) -> usize {
        2 * self.ring.unknowns() + 1
    }

    fn contains(&self, i: usize, j: usize) -> bool {
        critical_contains(i, j, self.ring.unknowns())
    }

    fn linear(&self, i: usize) -> Option<Vec<f64>> {
        (i == 2 * self.ring.unknowns()).then(|| normed(&self.direction, self.unknowns()))
    }
}

impl Multiplied<'_> {
    /// See [`System::values`](super::System::values).
    pub fn values<S: Varied, N: PhaseNumber>(&self, family: &Family<S, N>, x: &[N]) -> Option<Vec<N>> {
        let (mu, rest) = x.split_last()?;
        let (p, rest) = rest.split_last()?;
        let (phases, w) = rest.split_at(self.ring.unknowns());
        let pair = family.pair(p.clone());
        let legs = self.ring.legs(&pair, phases)?;
        let mut values = self.ring.residual(&pair, &legs);
        let slopes = self.ring.chain().slopes(&pair, &legs)?;
        let ends = [w.last()?.clone().checked_div(mu.clone())?, w[0].clone() * mu.clone()];
        values.extend(self.ring.continued(&slopes, w, ends));
        values.push(off_norm(&self.direction, w));
        Some(values)
    }
}
