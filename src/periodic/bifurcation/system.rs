//! The equations whose zeros are bifurcations, the parameter being one of the unknowns: Lemmas Y3, Y5, Y8.

use nalgebra::{DMatrix, Scalar};

use super::super::krawczyk::Equations;
use super::super::precondition;
use super::super::shaking::Shaking;
use super::family::{Family, Varied};
use super::jet::Jet;
use super::ring::Ring;
use crate::pair::Wall;
use crate::several::Turning;

/// Equations in any arithmetic.
pub(super) trait System {
    /// How many unknowns there are.
    fn unknowns(&self) -> usize;

    /// How many equations there are.
    fn equations(&self) -> usize {
        self.unknowns()
    }

    /// What the equations miss at `x`; `None` where they may not be defined.
    fn values<S: Varied, N: Turning>(&self, family: &Family<S, N>, x: &[N]) -> Option<Vec<N>>;

    /// Whether an equation contains an unknown: where it does not, the derivative is 0.
    fn contains(&self, _: usize, _: usize) -> bool {
        true
    }

    /// The coefficients of an equation that is linear, in all unknowns.
    fn linear(&self, _: usize) -> Option<Vec<f64>> {
        None
    }

    /// The Jacobian matrix; over balls, enclosed for all their members.
    ///
    /// Unknowns that no equation contains together are varied at once: an impact knows its neighbours only (Lemma T2).
    fn jacobian<S: Varied, N: Turning + Scalar>(&self, family: &Family<S, N>, x: &[N]) -> Option<DMatrix<N>> {
        let (family, rows) = (family.jets(), self.equations());
        let linear: Vec<Option<Vec<f64>>> = (0..rows).map(|row| self.linear(row)).collect();
        let knows = |row: usize, j: usize| linear[row].is_none() && self.contains(row, j);
        let mut groups: Vec<(Vec<usize>, Vec<bool>)> = Vec::new();
        for j in 0..self.unknowns() {
            let own: Vec<usize> = (0..rows).filter(|&row| knows(row, j)).collect();
            let place = groups.iter().position(|(_, taken)| own.iter().all(|&row| !taken[row]));
            let place = place.unwrap_or_else(|| {
                groups.push((Vec::new(), vec![false; rows]));
                groups.len() - 1
            });
            groups[place].0.push(j);
            own.iter().for_each(|&row| groups[place].1[row] = true);
        }
        let zero = || N::from_f64(0.0);
        let mut matrix = DMatrix::from_fn(rows, self.unknowns(), |row, j| match &linear[row] {
            Some(coefficients) => N::from_f64(coefficients[j]),
            None => zero(),
        });
        for (group, _) in &groups {
            let lift = |(i, x): (usize, &N)| match group.contains(&i) {
                true => Jet::variable(x.clone()),
                false => Jet::constant(x.clone()),
            };
            let x: Vec<_> = x.iter().enumerate().map(lift).collect();
            let values = self.values(&family, &x)?;
            for (row, value) in values.into_iter().enumerate() {
                if let Some(&j) = group.iter().find(|&&j| knows(row, j)) {
                    matrix[(row, j)] = value.slope;
                }
            }
        }
        Some(matrix)
    }
}

/// Whether the equation of an impact of a ring of `m` contains the phase of another one, or what it is varied by.
fn are_neighbours(i: usize, j: usize, m: usize) -> bool {
    i == j || (i + 1) % m == j || (j + 1) % m == i
}

/// A system over a family in one arithmetic.
pub(super) struct Posed<'s, E, S: Varied, N: Turning> {
    pub system: &'s E,
    pub family: &'s Family<S, N>,
    /// Whether the entries that are 0 are left out.
    pub is_sparse: bool,
}

/// A matrix by some of its entries.
pub(super) struct Entries<N>(Vec<(usize, usize, N)>, usize);

impl<N: Scalar> precondition::Jacobian<N> for Entries<N> {
    fn size(&self) -> usize {
        self.1
    }

    fn entries(&self) -> impl Iterator<Item = (usize, usize, &N)> {
        self.0.iter().map(|(i, j, x)| (*i, *j, x))
    }
}

impl<E: System, S: Varied, N: Turning + Scalar> Equations<N> for Posed<'_, E, S, N> {
    type Jacobian = Entries<N>;

    fn values(&self, x: &[N]) -> Option<Vec<N>> {
        self.system.values(self.family, x)
    }

    fn jacobian(&self, x: &[N]) -> Option<Entries<N>> {
        let matrix = self.system.jacobian(self.family, x)?;
        let (rows, columns) = matrix.shape();
        let is_there = |(i, j): &(usize, usize)| {
            !self.is_sparse || self.system.linear(*i).is_some() || self.system.contains(*i, *j)
        };
        let all = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j))).filter(is_there);
        Some(Entries(all.map(|(i, j)| (i, j, matrix[(i, j)].clone())).collect(), rows))
    }
}

/// The orbits of a ring over the parameter: `m` equations in `(u, p)`, a curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct Curve<'r>(pub &'r Ring);

impl System for Curve<'_> {
    fn unknowns(&self) -> usize {
        self.0.unknowns() + 1
    }

    fn equations(&self) -> usize {
        self.0.unknowns()
    }

    fn contains(&self, i: usize, j: usize) -> bool {
        j == self.0.unknowns() || are_neighbours(i, j, self.0.unknowns())
    }

    fn values<S: Varied, N: Turning>(&self, family: &Family<S, N>, x: &[N]) -> Option<Vec<N>> {
        let (p, phases) = x.split_last()?;
        let pair = family.pair(p.clone());
        let legs = self.0.legs(&pair, phases)?;
        Some(self.0.residual(&pair, &legs))
    }
}

/// Whether one of the equations `F = 0`, `F'_mu w = 0` contains one of the unknowns `(u, w, p)`, or `mu` after them.
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
fn off_norm<N: Turning>(direction: &[f64], w: &[N]) -> N {
    let along = |sum: N, (c, w): (&f64, &N)| N::from_f64(*c).mul_add(w.clone(), sum);
    direction.iter().zip(w).fold(N::from_f64(-1.0), along)
}

/// An orbit with an eigenvalue `mu` of 1 (40) or -1 (39): unknowns `(u, w, p)`, `F'_mu w = 0`, `c w = 1`. Lemma Y3
#[derive(Clone, Debug)]
pub(super) struct Critical<'r> {
    pub ring: &'r Ring,
    pub mu: f64,
    /// `c`
    pub direction: Vec<f64>,
}

impl System for Critical<'_> {
    fn unknowns(&self) -> usize {
        2 * self.ring.unknowns() + 1
    }

    fn contains(&self, i: usize, j: usize) -> bool {
        critical_contains(i, j, self.ring.unknowns())
    }

    fn linear(&self, i: usize) -> Option<Vec<f64>> {
        (i == 2 * self.ring.unknowns()).then(|| normed(&self.direction, self.unknowns()))
    }

    fn values<S: Varied, N: Turning>(&self, family: &Family<S, N>, x: &[N]) -> Option<Vec<N>> {
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
pub(super) struct Multiplied<'r> {
    pub ring: &'r Ring,
    /// `c`
    pub direction: Vec<f64>,
}

impl System for Multiplied<'_> {
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

    fn values<S: Varied, N: Turning>(&self, family: &Family<S, N>, x: &[N]) -> Option<Vec<N>> {
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

/// An orbit whose return map has a given trace: unknowns `(u, p)`. It proposes
#[derive(Clone, Debug)]
pub(super) struct Traced<'r> {
    pub ring: &'r Ring,
    pub trace: f64,
}

impl System for Traced<'_> {
    fn unknowns(&self) -> usize {
        self.ring.unknowns() + 1
    }

    fn values<S: Varied, N: Turning>(&self, family: &Family<S, N>, x: &[N]) -> Option<Vec<N>> {
        let (p, phases) = x.split_last()?;
        let pair = family.pair(p.clone());
        let legs = self.ring.legs(&pair, phases)?;
        let mut values = self.ring.residual(&pair, &legs);
        values.push(self.ring.trace(&pair, &legs)? - N::from_f64(self.trace));
        Some(values)
    }
}

/// An orbit that touches a wall with zero velocity at phase `s` of a flight: unknowns `(u, s, p)`. Lemma Y5
#[derive(Clone, Debug)]
pub(super) struct Graze<'r> {
    pub ring: &'r Ring,
    /// The flight, by its first impact.
    pub leg: usize,
    /// The wall it touches.
    pub wall: Wall,
}

impl System for Graze<'_> {
    fn unknowns(&self) -> usize {
        self.ring.unknowns() + 2
    }

    fn values<S: Varied, N: Turning>(&self, family: &Family<S, N>, x: &[N]) -> Option<Vec<N>> {
        let (p, rest) = x.split_last()?;
        let (at, phases) = rest.split_last()?;
        let pair = family.pair(p.clone());
        let legs = self.ring.legs(&pair, phases)?;
        let mut values = self.ring.residual(&pair, &legs);
        let (leg, at_wall) = (&legs.legs[self.leg], pair.moment(0.0, at));
        let since = at.clone() - self.ring.lift(phases)[self.leg].clone();
        // In gaps from the wall that the flight leaves to the wall it touches.
        let displacement = (self.ring.chain().walls()[self.leg].sign() - self.wall.sign()) / 2.0;
        let way = pair.way(&legs.waves[self.leg], &at_wall, displacement);
        values.push(leg.drift.clone().mul_add(since, -way));
        values.push(pair.relative(&leg.drift, &at_wall));
        Some(values)
    }
}

/// An orbit whose impact `i` has no velocity left: unknowns `(u, p)`, `v_i = 0`. Lemma Y5
#[derive(Clone, Debug)]
pub(super) struct Vanishing<'r> {
    pub ring: &'r Ring,
    pub impact: usize,
}

impl System for Vanishing<'_> {
    fn unknowns(&self) -> usize {
        self.ring.unknowns() + 1
    }

    fn values<S: Varied, N: Turning>(&self, family: &Family<S, N>, x: &[N]) -> Option<Vec<N>> {
        let (p, phases) = x.split_last()?;
        let pair = family.pair(p.clone());
        let legs = self.ring.legs(&pair, phases)?;
        let mut values = self.ring.residual(&pair, &legs);
        values.push(self.ring.chain().before(&legs.legs, self.impact).clone());
        Some(values)
    }
}
