//! The orbits of a ring with one more equation or none: a curve of orbits, a trace, grazes. Lemma Y5

use std::cmp::Ordering;

use super::super::family::{Family, Varied};
use super::super::ring::Ring;
use super::{Jet, Shape, are_neighbours};
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

    /// Whether the touch is proved to lie inside its flight, and the ball to come from inside the gap, accelerated away from the wall. Lemma Y5
    pub fn holds<S: Varied, N: Enclosing + PhaseNumber>(&self, family: &Family<S, N>, x: &[N]) -> Option<bool> {
        let (p, rest) = x.split_last()?;
        let (at, phases) = rest.split_last()?;
        let (phases, chain) = (self.ring.lift(phases), self.ring.chain());
        let next = match self.leg + 1 {
            end if end == chain.impacts() => phases[0].clone() + N::from_f64(f64::from(chain.cycles())),
            i => phases[i].clone(),
        };
        let is_later = |a: &N, b: &N| is_positive(&(a.clone() - b.clone()));
        let [bend, _] = bend(family, self.wall, [at, p]);
        Some(is_later(at, &phases[self.leg]) && is_later(&next, at) && is_positive(&bend))
    }
}

/// Whether a value is proved to be positive.
fn is_positive<N: Enclosing>(x: &N) -> bool {
    x.certain_sign() == Some(Ordering::Greater)
}

/// The acceleration away from a wall at a phase, for a value of the parameter, and its derivative by the phase.
fn bend<S: Varied, N: PhaseNumber>(family: &Family<S, N>, wall: Wall, [phase, p]: [&N; 2]) -> [N; 2] {
    let pair = family.jets().pair(Jet::constant(p.clone()));
    let Jet { value, slope } = wall.inward(pair.acceleration(&pair.moment(0.0, &Jet::variable(phase.clone()))));
    [value, slope]
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
    /// Whether the ball is proved to come from inside the gap, accelerated away from the wall. Lemma Y5
    pub fn holds<S: Varied, N: Enclosing + PhaseNumber>(&self, family: &Family<S, N>, x: &[N]) -> Option<bool> {
        let [bend, _] = bend(family, self.ring.chain().walls()[self.impact], [&x[self.impact], x.last()?]);
        Some(is_positive(&bend))
    }
}

/// An orbit for `e = 0` that leaves the wall of impact `i` as the contact force ends: unknowns `(u, p)`, `S_i = 0`. Lemma Y5
#[derive(Clone, Debug)]
pub struct Releasing<'r> {
    pub ring: &'r Ring,
    pub impact: usize,
}

impl Shape for Releasing<'_> {
    fn unknowns(&self) -> usize {
        self.ring.unknowns() + 1
    }
}

impl Releasing<'_> {
    /// See [`System::values`](super::System::values).
    pub fn values<S: Varied, N: PhaseNumber>(&self, family: &Family<S, N>, x: &[N]) -> Option<Vec<N>> {
        let (p, phases) = x.split_last()?;
        let pair = family.pair(p.clone());
        let legs = self.ring.legs(&pair, phases)?;
        let mut values = self.ring.residual(&pair, &legs);
        values.push(pair.acceleration(&legs.waves[self.impact]));
        Some(values)
    }

    /// Whether `e = 0` is proved, the ball arrives from inside the gap, and the contact force ends there. Lemma Y5
    pub fn holds<S: Varied, N: Enclosing + PhaseNumber>(&self, family: &Family<S, N>, x: &[N]) -> Option<bool> {
        let (p, phases) = x.split_last()?;
        let (pair, chain) = (family.pair(p.clone()), self.ring.chain());
        let wall = chain.walls()[self.impact];
        let legs = self.ring.legs(&pair, phases)?;
        let arrives = is_positive(&-wall.inward(chain.before(&legs.legs, self.impact).clone()));
        let [_, rise] = bend(family, wall, [&x[self.impact], p]);
        Some(pair.restitution().certain_sign() == Some(Ordering::Equal) && arrives && is_positive(&rise))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Ball;
    use crate::pair::Reduced;
    use crate::periodic::bifurcation::family::Unknown;
    use crate::periodic::chain::Chain;
    use crate::periodic::chained::OneHarmonic;

    /// Lemma Y5 (b), (c): what the equations do not say. On the left wall the acceleration away from it is that of the sine.
    #[test]
    fn r62_a_touch_comes_from_inside_and_a_release_ends_a_contact_force() {
        let ring = Ring::whole(Chain::new(&"LR".parse().unwrap(), 1).unwrap());
        let at = |phase: f64| [phase, phase + 0.5, 0.2].map(Ball::exact);
        let family = |restitution: f64| Family::<OneHarmonic, Ball> {
            unknown: Unknown::Ratio(0),
            base: Reduced::new(Ball::exact(0.2), Ball::exact(restitution)),
        };
        let touches = |phase: f64| Vanishing { ring: &ring, impact: 0 }.holds(&family(0.5), &at(phase));
        assert_eq!([0.25, 0.75, 0.0].map(touches), [Some(true), Some(false), Some(false)]);
        let releases =
            |restitution: f64, phase: f64| Releasing { ring: &ring, impact: 0 }.holds(&family(restitution), &at(phase));
        assert_eq!(releases(0.0, 0.0), Some(true));
        assert_eq!([(0.5, 0.0), (0.0, 0.5)].map(|(e, phase)| releases(e, phase)), [Some(false); 2]);
    }
}
