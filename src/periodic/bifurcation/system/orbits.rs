//! The orbits of a ring with one more equation or none: a curve of orbits, a trace, grazes. Lemma Y5

use std::cmp::Ordering;

use super::super::family::{Family, Varied};
use super::super::ring::Ring;
use super::{Shape, are_neighbours};
use crate::number::Enclosing;
use crate::pair::{Inward, Wall};
use crate::periodic::shaking::Shaking;
use crate::several::PhaseNumber;

/// The orbits of a ring over the parameter: `m` equations in `(u, p)`, a curve.
#[derive(Clone, Copy, Debug)]
pub struct Curve<'r>(pub &'r Ring);

impl Shape for Curve<'_> {
    fn unknowns(&self) -> usize {
        self.0.unknowns() + 1
    }

    fn equations(&self) -> usize {
        self.0.unknowns()
    }

    fn contains(&self, i: usize, j: usize) -> bool {
        j == self.0.unknowns() || are_neighbours(i, j, self.0.unknowns())
    }
}

impl Curve<'_> {
    /// See [`System::values`](super::System::values).
    pub fn values<S: Varied, N: PhaseNumber>(&self, family: &Family<S, N>, x: &[N]) -> Option<Vec<N>> {
        let (p, phases) = x.split_last()?;
        let pair = family.pair(p.clone());
        let legs = self.0.legs(&pair, phases)?;
        Some(self.0.residual(&pair, &legs))
    }
}

/// An orbit whose return map has a given trace: unknowns `(u, p)`. It proposes
#[derive(Clone, Debug)]
pub struct Traced<'r> {
    pub ring: &'r Ring,
    pub trace: f64,
}

impl Shape for Traced<'_> {
    fn unknowns(&self) -> usize {
        self.ring.unknowns() + 1
    }
}

impl Traced<'_> {
    /// See [`System::values`](super::System::values).
    pub fn values<S: Varied, N: PhaseNumber>(&self, family: &Family<S, N>, x: &[N]) -> Option<Vec<N>> {
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
pub struct Graze<'r> {
    pub ring: &'r Ring,
    /// The flight, by its first impact.
    pub leg: usize,
    /// The wall it touches.
    pub wall: Wall,
}

impl Shape for Graze<'_> {
    fn unknowns(&self) -> usize {
        self.ring.unknowns() + 2
    }
}

impl Graze<'_> {
    /// See [`System::values`](super::System::values).
    pub fn values<S: Varied, N: PhaseNumber>(&self, family: &Family<S, N>, x: &[N]) -> Option<Vec<N>> {
        let (p, rest) = x.split_last()?;
        let (at, phases) = rest.split_last()?;
        let pair = family.pair(p.clone());
        let legs = self.ring.legs(&pair, phases)?;
        let mut values = self.ring.residual(&pair, &legs);
        let (leg, at_wall) = (&legs.legs[self.leg], pair.moment(0.0, at));
        let since = at.clone() - self.ring.lift(phases)[self.leg].clone();
        // In gaps from the wall that the flight leaves to the wall it touches.
        let displacement = (self.ring.chain().walls()[self.leg].sign() - self.wall.sign()) / 2.0;
        let travel = pair.travel(&legs.waves[self.leg], &at_wall, displacement);
        values.push(leg.drift.clone().mul_add(since, -travel));
        values.push(pair.relative(&leg.drift, &at_wall));
        Some(values)
    }

    /// Returns whether the touch is proved to lie inside its flight, and the ball to come from inside the gap: it is bent away from the
    /// wall. Lemma Y5
    pub fn holds<N: Enclosing, B: Shaking<N>>(&self, pair: &B, x: &[N], phases: &[N]) -> bool {
        let at = &x[x.len() - 2];
        let chain = self.ring.chain();
        let next = match self.leg + 1 {
            end if end == chain.impacts() => phases[0].clone() + N::from_f64(f64::from(chain.cycles())),
            i => phases[i].clone(),
        };
        let is_later = |a: &N, b: &N| (a.clone() - b.clone()).certain_sign() == Some(Ordering::Greater);
        let bend = self.wall.inward(pair.acceleration(&pair.moment(0.0, at)));
        is_later(at, &phases[self.leg]) && is_later(&next, at) && bend.certain_sign() == Some(Ordering::Greater)
    }
}

/// An orbit whose impact `i` has no velocity left: unknowns `(u, p)`, `v_i = 0`. Lemma Y5
#[derive(Clone, Debug)]
pub struct Vanishing<'r> {
    pub ring: &'r Ring,
    pub impact: usize,
}

impl Shape for Vanishing<'_> {
    fn unknowns(&self) -> usize {
        self.ring.unknowns() + 1
    }
}

impl Vanishing<'_> {
    /// See [`System::values`](super::System::values).
    pub fn values<S: Varied, N: PhaseNumber>(&self, family: &Family<S, N>, x: &[N]) -> Option<Vec<N>> {
        let (p, phases) = x.split_last()?;
        let pair = family.pair(p.clone());
        let legs = self.ring.legs(&pair, phases)?;
        let mut values = self.ring.residual(&pair, &legs);
        values.push(self.ring.chain().before(&legs.legs, self.impact).clone());
        Some(values)
    }
}
