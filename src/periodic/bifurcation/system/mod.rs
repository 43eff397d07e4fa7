//! The equations whose zeros are bifurcations, the parameter being one of the unknowns: Lemmas Y3, Y5, Y8.

mod eigenvalue;
mod orbits;

use super::super::entries::Entries;
use super::super::krawczyk::Equations;
use super::family::{Family, Varied};
use super::jet::Jet;
use super::tube::Slab;
use crate::number::Enclosing;
use crate::several::PhaseNumber;
pub(super) use eigenvalue::{Critical, Multiplied};
pub(super) use orbits::{Curve, Graze, Releasing, Traced, Vanishing};

/// The unknowns that each equation contains.
pub(super) trait Shape {
    /// Number of unknowns.
    fn unknowns(&self) -> usize;

    /// Number of equations.
    fn equations(&self) -> usize {
        self.unknowns()
    }

    /// Whether an equation contains an unknown: where it does not, the derivative is 0.
    fn contains(&self, _: usize, _: usize) -> bool {
        true
    }

    /// Coefficients of a linear equation, in all unknowns; `None` for an equation that is not linear.
    fn linear(&self, _: usize) -> Option<Vec<f64>> {
        None
    }
}

/// Equations in any arithmetic.
pub(super) enum System<'r> {
    Curve(Curve<'r>),
    Critical(Critical<'r>),
    Multiplied(Multiplied<'r>),
    Traced(Traced<'r>),
    Graze(Graze<'r>),
    Vanishing(Vanishing<'r>),
    Releasing(Releasing<'r>),
    Slab(&'r Slab<'r>),
}

impl System<'_> {
    /// The equations as a pattern of unknowns.
    pub fn shape(&self) -> &dyn Shape {
        match self {
            Self::Curve(system) => system,
            Self::Critical(system) => system,
            Self::Multiplied(system) => system,
            Self::Traced(system) => system,
            Self::Graze(system) => system,
            Self::Vanishing(system) => system,
            Self::Releasing(system) => system,
            Self::Slab(system) => *system,
        }
    }

    /// Residuals of the equations at `x`; `None` where they may not be defined.
    pub fn values<S: Varied, N: PhaseNumber>(&self, family: &Family<S, N>, x: &[N]) -> Option<Vec<N>> {
        match self {
            Self::Curve(system) => system.values(family, x),
            Self::Critical(system) => system.values(family, x),
            Self::Multiplied(system) => system.values(family, x),
            Self::Traced(system) => system.values(family, x),
            Self::Graze(system) => system.values(family, x),
            Self::Vanishing(system) => system.values(family, x),
            Self::Releasing(system) => system.values(family, x),
            Self::Slab(system) => system.values(family, x),
        }
    }

    /// Whether the conditions that the equations do not express are proved at a zero.
    pub fn holds<S: Varied, N: Enclosing + PhaseNumber>(&self, family: &Family<S, N>, x: &[N]) -> bool {
        let holds = match self {
            Self::Graze(system) => system.holds(family, x),
            Self::Vanishing(system) => system.holds(family, x),
            Self::Releasing(system) => system.holds(family, x),
            _ => Some(true),
        };
        holds == Some(true)
    }

    /// The Jacobian matrix, all its entries or those that may be other than 0; over balls, enclosed for all their members. A curve's has a
    /// last row without entries.
    ///
    /// Unknowns that no equation contains together are varied at once: an impact knows its neighbours only (Lemma T2).
    pub fn jacobian<S: Varied, N: PhaseNumber>(
        &self,
        family: &Family<S, N>,
        x: &[N],
        is_sparse: bool,
    ) -> Option<Entries<N>> {
        let (family, shape) = (family.jets(), self.shape());
        let (rows, columns) = (shape.equations(), shape.unknowns());
        let linear: Vec<Option<Vec<f64>>> = (0..rows).map(|row| shape.linear(row)).collect();
        let contains = |row: usize, j: usize| linear[row].is_none() && shape.contains(row, j);
        let mut slopes: Vec<N> = vec![N::from_f64(0.0); rows * columns];
        for (i, slope) in slopes.iter_mut().enumerate() {
            if let Some(coefficients) = &linear[i / columns] {
                *slope = N::from_f64(coefficients[i % columns]);
            }
        }
        for group in groups(rows, columns, &contains) {
            let lift = |(i, x): (usize, &N)| match group.contains(&i) {
                true => Jet::variable(x.clone()),
                false => Jet::constant(x.clone()),
            };
            let x: Vec<_> = x.iter().enumerate().map(lift).collect();
            let values = self.values(&family, &x)?;
            for (row, value) in values.into_iter().enumerate() {
                if let Some(&j) = group.iter().find(|&&j| contains(row, j)) {
                    slopes[row * columns + j] = value.slope;
                }
            }
        }
        let is_there = |i: usize, j: usize| !is_sparse || linear[i].is_some() || shape.contains(i, j);
        let all = slopes.into_iter().enumerate().map(|(place, slope)| (place / columns, place % columns, slope));
        Some(Entries::new(columns, all.filter(|(i, j, _)| is_there(*i, *j)).collect()))
    }
}

/// The unknowns, those together that no equation contains together.
fn groups(rows: usize, columns: usize, contains: &dyn Fn(usize, usize) -> bool) -> Vec<Vec<usize>> {
    let mut groups: Vec<(Vec<usize>, Vec<bool>)> = Vec::new();
    for j in 0..columns {
        let own: Vec<usize> = (0..rows).filter(|&row| contains(row, j)).collect();
        let place = groups.iter().position(|(_, taken)| own.iter().all(|&row| !taken[row]));
        let place = place.unwrap_or_else(|| {
            groups.push((Vec::new(), vec![false; rows]));
            groups.len() - 1
        });
        groups[place].0.push(j);
        own.iter().for_each(|&row| groups[place].1[row] = true);
    }
    groups.into_iter().map(|(group, _)| group).collect()
}

/// Whether the equation of impact `i` of a ring of `m` contains the phase of impact `j`, or its variation.
fn are_neighbours(i: usize, j: usize, m: usize) -> bool {
    i == j || (i + 1) % m == j || (j + 1) % m == i
}

/// A system over a family in one arithmetic.
pub(super) struct Posed<'s, S: Varied, N: PhaseNumber> {
    pub system: &'s System<'s>,
    pub family: &'s Family<S, N>,
    /// `true` if the entries that are 0 are left out.
    pub is_sparse: bool,
}

impl<S: Varied, N: PhaseNumber> Equations<N> for Posed<'_, S, N> {
    fn values(&self, x: &[N]) -> Option<Vec<N>> {
        self.system.values(self.family, x)
    }

    fn jacobian(&self, x: &[N]) -> Option<Entries<N>> {
        self.system.jacobian(self.family, x, self.is_sparse)
    }
}
