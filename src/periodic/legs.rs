//! The equations of a closed chain of impacts, one unknown for each: its phase.
//!
//! The flights' equations (A.2), (A.4), (A.6) are solved for the drift, (A.1), (A.3), (A.5) for the velocities;
//! Newton's impact law (15) at each wall is the equation that is left (Lemma T1). The number type and the excitation ([`Shaking`]) are generic:
//! floating point finds, balls prove, and any other [`Wave`](crate::number::Wave), such as a jet in a parameter, uses the same lines.

use super::chain::Chain;
use super::entries::Entries;
use super::shaking::{Hop, Shaking};
use crate::mapping::jacobian_between;
use crate::number::Number;
use crate::pair::Reduced;

/// Flight of a chain; velocities in gap widths per forcing period, to the right.
#[derive(Clone, Copy, Debug)]
pub struct Leg<N> {
    /// `h`: time of flight, in forcing periods.
    pub time: N,
    /// `c`: the drift, that is the absolute velocity.
    pub drift: N,
    /// `y'` right after the impact at the start.
    pub after: N,
    /// `y'` just before the impact at the end.
    pub before: N,
}

/// The flights through given phases, and the state of the box at each phase.
#[derive(Clone, Debug)]
pub struct Legs<N, M = (N, N)> {
    /// Flight `i` goes from impact `i` to the next one.
    pub legs: Vec<Leg<N>>,
    /// The box at impact `i`; `(sin th_i, cos th_i)` of one harmonic.
    pub waves: Vec<M>,
}

/// Derivatives of equation `i` by the phases of impacts `i - 1`, `i` and `i + 1`.
#[derive(Clone, Debug)]
pub struct Slopes<N>(pub Vec<[N; 3]>);

impl Chain {
    /// Flights through these phases, each of which arrives at its wall; `None` where a flight may take no time.
    pub fn legs<N: Number, S: Shaking<N>>(&self, shaking: &S, phases: &[N]) -> Option<Legs<N, S::Moment>> {
        let waves: Vec<S::Moment> = phases.iter().map(|phase| shaking.moment(0.0, phase)).collect();
        let leg = |i: usize| {
            let j = self.next(i);
            self.leg(shaking, i, [&phases[i], &phases[j]], [&waves[i], &waves[j]])
        };
        let legs = (0..phases.len()).map(leg).collect::<Option<_>>()?;
        Some(Legs { legs, waves })
    }

    /// Flight `i` between two phases; `None` where the flight may take no time.
    pub fn leg<N: Number, S: Shaking<N>>(
        &self,
        shaking: &S,
        i: usize,
        [from, to]: [&N; 2],
        waves: [&S::Moment; 2],
    ) -> Option<Leg<N>> {
        let since = to.clone() - from.clone();
        let time = if self.next(i) == 0 { since + N::from_f64(f64::from(self.cycles())) } else { since };
        let displacement = self.displacement(i);
        // T1: -1, 0 or 1, exact
        match if displacement == 0.0 { shaking.hop(&time, waves[0]) } else { None } {
            Some(Hop { drift, after, before }) => Some(Leg { time, drift, after, before }),
            None => flight(shaking, time, waves, displacement),
        }
    }

    /// `y'` just before impact `i`.
    #[inline(always)]
    pub fn before<'l, N>(&self, legs: &'l [Leg<N>], i: usize) -> &'l N {
        &legs[self.previous(i)].before
    }

    /// Residual of Newton's impact law at each impact: `v+ + e v-`, zero at an orbit. **Equation** (15), Lemma T1
    pub fn residual<N: Number, S: Shaking<N>>(&self, shaking: &S, legs: &Legs<N, S::Moment>) -> Vec<N> {
        let e = shaking.restitution();
        let miss = |i: usize| e.clone().mul_add(self.before(&legs.legs, i).clone(), legs.legs[i].after.clone());
        (0..self.impacts()).map(miss).collect()
    }

    /// Derivatives of [`Chain::residual`] by the phases. Lemma T2
    pub fn slopes<N: Number, S: Shaking<N>>(&self, shaking: &S, legs: &Legs<N, S::Moment>) -> Option<Slopes<N>> {
        let e = shaking.restitution();
        let both = e.clone() + N::from_f64(1.0);
        let row = |i: usize| {
            let (to, from) = (&legs.legs[self.previous(i)], &legs.legs[i]);
            let over_from = |x: &N| x.clone().checked_div(from.time.clone());
            let over_to = |x: &N| (e.clone() * x.clone()).checked_div(to.time.clone());
            let own = over_from(&from.after)? - over_to(&to.before)?;
            Some([
                over_to(&to.after)?,
                both.clone().mul_add(shaking.acceleration(&legs.waves[i]), own),
                -over_from(&from.before)?,
            ])
        };
        (0..self.impacts()).map(row).collect::<Option<_>>().map(Slopes)
    }

    /// Derivatives of [`Chain::residual`] by `alpha = A/d`. Lemma T2
    pub fn by_alpha<N: Number>(&self, pair: &Reduced<N>, legs: &Legs<N>) -> Option<Vec<N>> {
        let wave = |i: usize| {
            let sines = legs.waves[self.next(i)].0.clone() - legs.waves[i].0.clone();
            sines.checked_div(legs.legs[i].time.clone())
        };
        let e = &pair.restitution;
        let turn = (e.clone() + N::from_f64(1.0)) * pair.alpha.turn();
        let row = |i: usize| {
            let drifts = e.clone().mul_add(wave(self.previous(i))?, wave(i)?);
            Some((-turn.clone()).mul_add(legs.waves[i].1.clone(), drifts))
        };
        (0..self.impacts()).map(row).collect()
    }

    /// Derivatives of [`Chain::residual`] by `e`: the velocities before the impacts. Lemma T2
    pub fn by_restitution<N: Number>(&self, legs: &Legs<N>) -> Vec<N> {
        (0..self.impacts()).map(|i| self.before(&legs.legs, i).clone()).collect()
    }

    /// Product of the Jacobians (A.7) over the period, from impact 0 on. **Equations** (31), (37), (53)
    ///
    /// `None` when an arrival may be a graze.
    pub fn monodromy<N: Number, S: Shaking<N>>(&self, shaking: &S, legs: &Legs<N, S::Moment>) -> Option<[[N; 2]; 2]> {
        self.monodromy_of(shaking, legs, self.impacts())
    }

    /// Product of the Jacobians (A.7) of the first `flights` flights, at least one.
    pub(super) fn monodromy_of<N: Number, S: Shaking<N>>(
        &self,
        shaking: &S,
        legs: &Legs<N, S::Moment>,
        flights: usize,
    ) -> Option<[[N; 2]; 2]> {
        let of = |i: usize| {
            let accelerations = [i, self.next(i)].map(|impact| shaking.acceleration(&legs.waves[impact]));
            let velocities = [self.before(&legs.legs, i).clone(), legs.legs[i].before.clone()];
            jacobian_between(shaking.restitution().clone(), legs.legs[i].time.clone(), accelerations, velocities)
        };
        let mut product = of(0)?;
        for i in 1..flights {
            product = times(&of(i)?, &product);
        }
        Some(product)
    }
}

/// A flight of displacement `D` between two phases: (A.2), (A.4), (A.6) solved for the drift.
fn flight<N: Number, S: Shaking<N>>(
    shaking: &S,
    time: N,
    [from, to]: [&S::Moment; 2],
    displacement: f64,
) -> Option<Leg<N>> {
    let drift = shaking.travel(from, to, displacement).checked_div(time.clone())?;
    let (after, before) = (shaking.relative(&drift, from), shaking.relative(&drift, to));
    Some(Leg { time, drift, after, before })
}

/// The product of two matrices.
pub(super) fn times<N: Number>(a: &[[N; 2]; 2], b: &[[N; 2]; 2]) -> [[N; 2]; 2] {
    let entry = |i: usize, j: usize| a[i][0].clone().mul_add(b[0][j].clone(), a[i][1].clone() * b[1][j].clone());
    [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
}

impl<N> Slopes<N> {
    /// The matrix of the derivatives. Two entries may fall on one place.
    pub fn into_entries(self) -> Entries<N> {
        let count = self.0.len();
        let entries = self.0.into_iter().enumerate().flat_map(|(i, row)| {
            let columns = [(i + count - 1) % count, i, (i + 1) % count];
            columns.into_iter().zip(row).map(move |(j, value)| (i, j, value))
        });
        Entries::new(count, entries.collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Wave;
    use crate::tolerances::{DIFFERENCE, HOP_OF_DOUBLES};
    use approx::abs_diff_eq;
    use proptest::prelude::*;

    fn pair(alpha: f64, restitution: f64) -> Reduced<f64> {
        Reduced::new(alpha, restitution)
    }

    fn misses(chain: &Chain, pair: &Reduced<f64>, phases: &[f64]) -> Vec<f64> {
        chain.residual(pair, &chain.legs(pair, phases).unwrap())
    }

    proptest! {
        /// Lemma T2 against central differences, hops of every length included.
        #[test]
        fn derivatives_agree_with_differences(
            alpha in 0.1..3.0f64, e in 0.0..=1.0f64, first in -0.5..0.5f64, steps in prop::array::uniform3(0.01..0.6f64),
        ) {
            let chain = Chain::new(&"RRLL".parse().unwrap(), 2).unwrap();
            let phases = [first, first + steps[0], first + steps[0] + steps[1], first + steps.iter().sum::<f64>()];
            let the_pair = pair(alpha, e);
            let legs = chain.legs(&the_pair, &phases).unwrap();
            let size = 1e-6;
            let is_near = |exact: f64, up: f64, down: f64| {
                let found = (up - down) / (2.0 * size);
                abs_diff_eq!(found, exact, epsilon = DIFFERENCE * (exact.abs() + 1e2))
            };
            let mut matrix = [[0.0; 4]; 4];
            for (i, j, slope) in chain.slopes(&the_pair, &legs).unwrap().into_entries().iter() {
                matrix[i][j] += slope;
            }
            for j in 0..4 {
                let moved = |by: f64| { let mut moved = phases; moved[j] += by; misses(&chain, &the_pair, &moved) };
                let (up, down) = (moved(size), moved(-size));
                prop_assert!((0..4).all(|i| is_near(matrix[i][j], up[i], down[i])), "{matrix:?}");
            }
            let by_alpha = chain.by_alpha(&the_pair, &legs).unwrap();
            let moved = |by: f64| misses(&chain, &pair(alpha + by, e), &phases);
            let (up, down) = (moved(size), moved(-size));
            prop_assert!((0..4).all(|i| is_near(by_alpha[i], up[i], down[i])));
            let by_restitution = chain.by_restitution(&legs);
            let moved = |by: f64| misses(&chain, &pair(alpha, e + by), &phases);
            let (up, down) = (moved(size), moved(-size));
            prop_assert!((0..4).all(|i| is_near(by_restitution[i], up[i], down[i])));
        }

        /// Lemma T1: short and long hops are one formula.
        #[test]
        fn hops_are_flights(alpha in 0.1..3.0f64, phase in 0.0..1.0f64, time in 1e-3..0.12f64) {
            let pair = pair(alpha, 0.5);
            let waves = [phase.wave(), (phase + time).wave()];
            let long = flight(&pair, time, [&waves[0], &waves[1]], 0.0).unwrap();
            let short = pair.hop(&time, &waves[0]).unwrap();
            prop_assert!(abs_diff_eq!(long.after, short.after, epsilon = HOP_OF_DOUBLES));
            prop_assert!(abs_diff_eq!(long.before, short.before, epsilon = HOP_OF_DOUBLES));
        }
    }
}
