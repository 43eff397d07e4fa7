//! The equations whose zeros are bifurcations, the parameter being one of the unknowns: Lemmas Y3, Y5.

use nalgebra::{DMatrix, Scalar};

use super::super::krawczyk::Equations;
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

    /// What the equations miss at `x`; `None` where they may not be defined.
    fn values<S: Varied, N: Turning>(&self, family: &Family<S, N>, x: &[N]) -> Option<Vec<N>>;

    /// The Jacobian matrix; over balls, enclosed for all their members.
    fn jacobian<S: Varied, N: Turning + Scalar>(&self, family: &Family<S, N>, x: &[N]) -> Option<DMatrix<N>> {
        let family = family.jets();
        let along = |j: usize| -> Option<Vec<N>> {
            let lift = |(i, x): (usize, &N)| if i == j { Jet::variable(x.clone()) } else { Jet::constant(x.clone()) };
            let x: Vec<_> = x.iter().enumerate().map(lift).collect();
            Some(self.values(&family, &x)?.into_iter().map(|value| value.slope).collect())
        };
        let columns: Vec<Vec<N>> = (0..self.unknowns()).map(along).collect::<Option<_>>()?;
        let rows = columns.first()?.len();
        Some(DMatrix::from_iterator(rows, columns.len(), columns.into_iter().flatten()))
    }
}

/// A system over a family in one arithmetic.
pub(super) struct Posed<'s, E, S: Varied, N: Turning> {
    pub system: &'s E,
    pub family: &'s Family<S, N>,
}

impl<E: System, S: Varied, N: Turning + Scalar> Equations<N> for Posed<'_, E, S, N> {
    type Jacobian = DMatrix<N>;

    fn values(&self, x: &[N]) -> Option<Vec<N>> {
        self.system.values(self.family, x)
    }

    fn jacobian(&self, x: &[N]) -> Option<DMatrix<N>> {
        self.system.jacobian(self.family, x)
    }
}

/// The orbits of a ring over the parameter: `m` equations in `(u, p)`, a curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct Curve<'r>(pub &'r Ring);

impl System for Curve<'_> {
    fn unknowns(&self) -> usize {
        self.0.unknowns() + 1
    }

    fn values<S: Varied, N: Turning>(&self, family: &Family<S, N>, x: &[N]) -> Option<Vec<N>> {
        let (p, phases) = x.split_last()?;
        let pair = family.pair(p.clone());
        let legs = self.0.legs(&pair, phases)?;
        Some(self.0.residual(&pair, &legs))
    }
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

    fn values<S: Varied, N: Turning>(&self, family: &Family<S, N>, x: &[N]) -> Option<Vec<N>> {
        let (p, rest) = x.split_last()?;
        let (phases, w) = rest.split_at(self.ring.unknowns());
        let pair = family.pair(p.clone());
        let legs = self.ring.legs(&pair, phases)?;
        let mut values = self.ring.residual(&pair, &legs);
        values.extend(self.ring.twisted(&self.ring.chain().slopes(&pair, &legs)?, w, self.mu));
        let along = |sum: N, (c, w): (&f64, &N)| N::from_f64(*c).mul_add(w.clone(), sum);
        values.push(self.direction.iter().zip(w).fold(N::from_f64(-1.0), along));
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
