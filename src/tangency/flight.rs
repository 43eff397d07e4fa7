//! A flight of the reduced map as equations: `g` of `docs/proofs/tangency.md#J1`, in any arithmetic.

use super::terms::Terms;
use crate::chaos::Side;
use crate::number::{Number, Wave};
use crate::periodic::bifurcation::Jet;

/// A phase in radians and a speed over `A W`, every impact mirrored to the left wall.
pub(super) type State<N> = [N; 2];

/// `(sin x, cos x)` of an angle in radians.
pub(super) fn sin_cos<N: Wave>(angle: &N) -> Option<(N, N)> {
    Some(angle.clone().checked_div(angle.turn())?.wave())
}

/// The reduced map's parameters: `D` and `e`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair<N> {
    pub gap: N,
    pub restitution: N,
}

/// One of the parameters: `D`, or `e` (Lemma J11).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Parameter {
    Gap,
    Restitution,
}

impl Parameter {
    /// The other parameter.
    pub fn other(self) -> Self {
        match self {
            Self::Gap => Self::Restitution,
            Self::Restitution => Self::Gap,
        }
    }
}

impl<N> Pair<N> {
    /// The pair of a value of one parameter and a value of the other.
    pub fn of(parameter: Parameter, own: N, other: N) -> Self {
        match parameter {
            Parameter::Gap => Self { gap: own, restitution: other },
            Parameter::Restitution => Self { gap: other, restitution: own },
        }
    }

    /// A parameter's value.
    pub fn value(&self, parameter: Parameter) -> &N {
        match parameter {
            Parameter::Gap => &self.gap,
            Parameter::Restitution => &self.restitution,
        }
    }

    /// Applies a function to both parameters.
    pub fn map<M>(&self, f: impl Fn(&N) -> M) -> Pair<M> {
        Pair { gap: f(&self.gap), restitution: f(&self.restitution) }
    }
}

impl<N: Number> Pair<N> {
    /// The pair, with the derivatives by one parameter.
    pub fn moving(&self, by: Parameter) -> Pair<Jet<N>> {
        let moved = Jet::variable(self.value(by).clone());
        Pair::of(by, moved, Jet::constant(self.value(by.other()).clone()))
    }
}

impl<N: Wave> Pair<N> {
    /// `g`, which is 0 where a flight leads from one state to another.
    pub fn miss(&self, [theta, w]: &State<N>, [phi, omega]: &State<N>, side: Side) -> Option<State<N>> {
        let (sin0, cos0) = sin_cos(theta)?;
        let (sin1, cos1) = sin_cos(phi)?;
        let sign = side.sign();
        let c = self.restitution.clone() * w.clone() + cos0;
        let time = phi.minus_ref(theta);
        let (time, wall) = match side {
            Side::Near => (time, N::from_f64(0.0)),
            Side::Far => (time - self.gap.turn() * N::from_f64(0.5), self.gap.clone()),
        };
        let height = c.clone() * time + sin1.signed(sign) + sin0 - wall;
        Some([height, omega.minus_ref(&c.signed(sign)) - cos1])
    }
}

/// Solves `J y = -r`, where `J` has the rows `(slope, 0)` and `(bend, 1)`: `dg/dy` of a flight.
pub(super) fn follow<N: Number>([r, s]: State<N>, [slope, bend]: &State<N>) -> Option<State<N>> {
    let phase = -(r.checked_div(slope.clone())?);
    let speed = -(s + bend.clone() * phase.clone());
    Some([phase, speed])
}
