//! The quadratic coefficient of a tangency and its speed of unfolding: Lemma J7 of `docs/proofs/tangency.md#J7`.

use super::chain::{Chain, Moving, power};
use super::saddle::zero;
use super::terms::Terms;
use crate::number::Enclosing;
use crate::periodic::bifurcation::Jet;
use crate::periodic::entries::Entries;
use crate::periodic::krawczyk::{Equations, Limits, polish, prove_inflating};
use crate::periodic::precondition::Preconditioner;

/// `q` and `m` of Lemma J5.
pub(super) struct Unfolding<N> {
    pub quadratic: N,
    pub unfolding: N,
}

/// Linear equations: a matrix and the right-hand side.
pub(super) struct Linear<N> {
    pub matrix: Entries<N>,
    pub right: Vec<N>,
}

impl<N: Enclosing> Equations<N> for Linear<N> {
    fn values(&self, x: &[N]) -> Option<Vec<N>> {
        let mut values: Vec<N> = self.right.iter().map(|x| -x.clone()).collect();
        for (i, j, slope) in self.matrix.iter() {
            values[i] = slope.mul_add_ref(&x[j], values[i].clone());
        }
        Some(values)
    }

    fn jacobian(&self, _: &[N]) -> Option<Entries<N>> {
        Some(self.matrix.clone())
    }
}

/// Encloses the solutions of linear equations for all members; `None` where the matrix is not proved to be regular. Lemma T3
pub(super) fn solved<N: Enclosing>(linear: &Linear<N>, inverse: &Preconditioner) -> Option<Vec<N>> {
    const POLISHING_STEPS: u32 = 6;
    const LIMITS: Limits = Limits { largest: 0.0, domains: 20, images: 30, slow: 3 };
    let start = linear.right.iter().map(|x| x.centre() - x.centre()).collect();
    let guess = polish(linear, inverse, start, POLISHING_STEPS);
    Some(prove_inflating(linear, inverse, &guess, LIMITS)?.at)
}

impl<N: Enclosing> Unfolding<N> {
    /// Encloses `q` and `m` over an enclosure of the zero of a chain. Lemma J7
    pub fn new(chain: &Chain<N>, inverse: &Preconditioner, at: &[N]) -> Option<Self> {
        let end = chain.manifolds[1].at(&chain.pair(at), chain.over, &at[1])?;
        let along = end.along.map(|x| x.value);
        let across = [-along[1].clone(), along[0].clone()];
        let matrix = chain.jacobian(at)?;
        let still = || [0, 1].map(|_| N::from_f64(0.0));
        let jets = |value: [N; 2], slope: [N; 2]| -> Moving<N> {
            let mut pairs = value.into_iter().zip(slope).map(|(value, slope)| Jet { value, slope });
            [0, 1].map(|_| pairs.next().expect("two"))
        };
        let answers =
            |moved: Moving<N>| solved(&Linear { matrix: matrix.clone(), right: chain.end_moved(at, &moved)? }, inverse);
        let by_state = answers(jets(across.clone(), still()))?;
        let by_tangent = answers(jets(still(), across))?;
        let length = along[0].times_ref(&along[0]) + along[1].times_ref(&along[1]);
        let guess = length.as_ball().mid().sqrt();
        let two = N::from_f64(2.0);
        let from = length.centre() - length.centre() + N::from_f64(guess);
        let length = zero(from, |x| Some(x.times_ref(x) - length.clone()), |x| Some(two.times_ref(x)))?;
        // v_n is scaled, and so is its displacement.
        let scaled = power::<N>(-chain.scales[chain.flights.len()]) * length.clone();
        Some(Self {
            quadratic: scaled.checked_div(by_tangent[0].clone())?,
            unfolding: length.checked_div(by_state[2].clone())?,
        })
    }
}
