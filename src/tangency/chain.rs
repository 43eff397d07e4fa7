//! The equations of a tangency, states and tangents of the flights from one manifold to the other: Lemma J5 of
//! `docs/proofs/tangency.md#J5`.

use super::flight::{Pair, Parameter, State};
use super::manifold::{Manifold, Point};
use super::terms::Terms;
use crate::chaos::Side;
use crate::number::Enclosing;
use crate::periodic::bifurcation::Jet;
use crate::periodic::entries::Entries;
use crate::periodic::krawczyk::Equations;

/// The unknowns before the states: `sigma_u`, `sigma_s`, the parameter, `t`.
pub(super) const FIRST_STATE: usize = 4;
/// The place of the parameter.
const PARAMETER: usize = 2;

/// Flights from the unstable manifold to the stable one. Unknowns are [`FIRST_STATE`] values, then phase, speed and tangent of each state
/// between.
#[derive(Clone, Debug)]
pub(super) struct Chain<N> {
    /// The unknown parameter, and the value of the other one.
    pub over: Parameter,
    pub other: N,
    pub flights: Vec<Side>,
    /// Forcing periods between the phase after the last flight and that of the stable manifold.
    pub turns: f64,
    /// The tangent of each state is scaled by `2^scale`.
    pub scales: Vec<i32>,
    pub manifolds: [Manifold; 2],
}

/// A state with its tangent.
pub(super) type Moving<N> = State<Jet<N>>;

/// Change of a flight with one of the unknowns.
struct Direction<N> {
    unknown: usize,
    start: Moving<N>,
    end: Moving<N>,
    pair: Pair<N>,
}

/// The states at both ends of the chain, with their manifolds.
struct Ends<N> {
    unstable: Point<N>,
    stable: Point<N>,
    stretch: N,
}

fn zero<N: Enclosing>() -> N {
    N::from_f64(0.0)
}

/// A power of two.
pub(super) fn power<N: Enclosing>(exponent: i32) -> N {
    N::from_f64(f64::from(exponent).exp2()) // J5: tangents are scaled by powers of two
}

impl<N: Enclosing> Chain<N> {
    /// `D` and `e` of these unknowns.
    pub fn pair(&self, x: &[N]) -> Pair<N> {
        Pair::of(self.over, x[2].clone(), self.other.clone())
    }

    /// The number of unknowns.
    pub fn unknowns(&self) -> usize {
        FIRST_STATE + 4 * (self.flights.len() - 1)
    }

    /// The ends, with their derivatives by one parameter.
    fn ends(&self, x: &[N], by: Parameter) -> Option<Ends<N>> {
        let pair = self.pair(x);
        let [unstable, stable] = &self.manifolds;
        let (unstable, stable) = (unstable.at(&pair, by, &x[0])?, stable.at(&pair, by, &x[1])?);
        Some(Ends { unstable, stable, stretch: x[3].clone() })
    }

    /// State before flight `k`, with its tangent, given the unknowns.
    fn state(&self, x: &[N], ends: &Ends<N>, k: usize) -> Moving<N> {
        if k == 0 {
            return [0, 1].map(|i| Jet {
                value: ends.unstable.at[i].value.clone(),
                slope: ends.unstable.along[i].value.clone(),
            });
        }
        if k == self.flights.len() {
            let turned = x[2].turn() * N::from_f64(self.turns);
            return [0, 1].map(|i| {
                let value = ends.stable.at[i].value.clone();
                let value = if i == 0 { value + turned.clone() } else { value };
                Jet { value, slope: ends.stretch.times_ref(&ends.stable.along[i].value) }
            });
        }
        let own = &x[FIRST_STATE + 4 * (k - 1)..];
        [0, 1].map(|i| Jet { value: own[i].clone(), slope: own[2 + i].clone() })
    }

    /// All states of the chain with their tangents, given the unknowns.
    pub fn states(&self, x: &[N]) -> Option<Vec<Moving<N>>> {
        let ends = self.ends(x, self.over)?;
        Some((0..=self.flights.len()).map(|k| self.state(x, &ends, k)).collect())
    }

    /// Unknowns on which the state before flight `k` depends, and its derivatives by them.
    fn moves(&self, ends: &Ends<N>, k: usize) -> Vec<(usize, Moving<N>)> {
        let jet = |value: &N, slope: &N| Jet { value: value.clone(), slope: slope.clone() };
        if k == 0 {
            let Point { at, along, bend } = &ends.unstable;
            return vec![
                (0, [0, 1].map(|i| jet(&along[i].value, &bend[i]))),
                (PARAMETER, [0, 1].map(|i| jet(&at[i].slope, &along[i].slope))),
            ];
        }
        if k == self.flights.len() {
            let Point { at, along, bend } = &ends.stable;
            let stretched = |x: &N| ends.stretch.times_ref(x);
            return vec![
                (1, [0, 1].map(|i| jet(&along[i].value, &stretched(&bend[i])))),
                (PARAMETER, [0, 1].map(|i| jet(&at[i].slope, &stretched(&along[i].slope)))),
                (3, [0, 1].map(|i| jet(&zero(), &along[i].value))),
            ];
        }
        let unit = |i: usize, j: usize| if i == j { N::from_f64(1.0) } else { zero() };
        let first = FIRST_STATE + 4 * (k - 1);
        (0..4).map(|j| (first + j, [0, 1].map(|i| jet(&unit(i, j), &unit(i + 2, j))))).collect()
    }

    /// A tangent before flight `k` in the scale of the one after it.
    fn rescaled(&self, state: &Moving<N>, k: usize) -> Moving<N> {
        let scale: N = power(self.scales[k + 1] - self.scales[k]);
        state.each_ref().map(|x| Jet { value: x.value.clone(), slope: scale.times_ref(&x.slope) })
    }

    /// `g` of a flight, and its derivative along the tangents.
    fn miss(&self, x: &[N], k: usize, [from, to]: [&Moving<N>; 2]) -> Option<[Jet<N>; 2]> {
        let pair = self.pair(x);
        pair.map(|x| Jet::constant(x.clone())).miss(&self.rescaled(from, k), to, self.flights[k])
    }

    /// Changes of `g` of a flight, and of its derivative along the tangents, with given changes of states, tangents, `D` and `e`.
    pub fn change(
        &self,
        x: &[N],
        k: usize,
        states: [&Moving<N>; 2],
        by: [&Moving<N>; 2],
        pair: &Pair<N>,
    ) -> Option<[Jet<N>; 2]> {
        let of = |state: Moving<N>, by: Moving<N>| -> [Jet<Jet<N>>; 2] {
            let [value, slope] = [state, by];
            let mut pairs = value.into_iter().zip(slope).map(|(value, slope)| Jet { value, slope });
            [0, 1].map(|_| pairs.next().expect("two"))
        };
        let own = self.pair(x);
        let moved = |x: N, by: &N| Jet { value: Jet::constant(x), slope: Jet::constant(by.clone()) };
        let pair = Pair { gap: moved(own.gap, &pair.gap), restitution: moved(own.restitution, &pair.restitution) };
        let start = of(self.rescaled(states[0], k), self.rescaled(by[0], k));
        let end = of(states[1].clone(), by[1].clone());
        Some(pair.miss(&start, &end, self.flights[k])?.map(|x| x.slope))
    }

    /// The directions in which flight `k` changes: with the states at its ends, and with the parameter itself.
    fn directions(&self, ends: &Ends<N>, k: usize) -> Vec<Direction<N>> {
        let still = || [0, 1].map(|_| Jet::constant(zero()));
        let none = Pair { gap: zero(), restitution: zero() };
        let starts = self.moves(ends, k).into_iter();
        let starts = starts.map(|(unknown, by)| Direction { unknown, start: by, end: still(), pair: none.clone() });
        let arrivals = self.moves(ends, k + 1).into_iter();
        let arrivals = arrivals.map(|(unknown, by)| Direction { unknown, start: still(), end: by, pair: none.clone() });
        let own = Pair::of(self.over, N::from_f64(1.0), zero());
        let own = Direction { unknown: PARAMETER, start: still(), end: still(), pair: own };
        starts.chain(arrivals).chain([own]).collect()
    }
}

impl<N: Enclosing> Chain<N> {
    /// Derivatives of all values by the known parameter.
    pub fn by_other(&self, x: &[N]) -> Option<Vec<N>> {
        let ends = self.ends(x, self.over.other())?;
        let by = Pair::of(self.over, zero(), N::from_f64(1.0));
        let moved = |k: usize| {
            let by_parameter = self.moves(&ends, k).into_iter().find(|(unknown, _)| *unknown == PARAMETER);
            by_parameter.map_or_else(|| [0, 1].map(|_| Jet::constant(zero())), |(_, by)| by)
        };
        let mut values = Vec::with_capacity(self.unknowns());
        for k in 0..self.flights.len() {
            let states = [k, k + 1].map(|k| self.state(x, &ends, k));
            let [height, speed] = self.change(x, k, states.each_ref(), [&moved(k), &moved(k + 1)], &by)?;
            values.extend([height.value, speed.value, height.slope, speed.slope]);
        }
        Some(values)
    }

    /// Change of the equations, with opposite sign, for a displacement of state and tangent after the last flight.
    pub fn end_moved(&self, x: &[N], by: &Moving<N>) -> Option<Vec<N>> {
        let last = self.flights.len() - 1;
        let ends = self.ends(x, self.over)?;
        let states = [last, last + 1].map(|k| self.state(x, &ends, k));
        let still = [0, 1].map(|_| Jet::constant(zero()));
        let none = Pair { gap: zero(), restitution: zero() };
        let [height, speed] = self.change(x, last, states.each_ref(), [&still, by], &none)?;
        let mut values = vec![zero(); 4 * last];
        values.extend([height.value, speed.value, height.slope, speed.slope].map(|x: N| -x));
        Some(values)
    }
}

impl<N: Enclosing> Equations<N> for Chain<N> {
    fn values(&self, x: &[N]) -> Option<Vec<N>> {
        let states = self.states(x)?;
        let mut values = Vec::with_capacity(self.unknowns());
        for k in 0..self.flights.len() {
            let [height, speed] = self.miss(x, k, [&states[k], &states[k + 1]])?;
            values.extend([height.value, speed.value, height.slope, speed.slope]);
        }
        Some(values)
    }

    fn jacobian(&self, x: &[N]) -> Option<Entries<N>> {
        let ends = self.ends(x, self.over)?;
        let states: Vec<Moving<N>> = (0..=self.flights.len()).map(|k| self.state(x, &ends, k)).collect();
        let mut entries = Vec::new();
        for k in 0..self.flights.len() {
            for Direction { unknown, start, end, pair } in self.directions(&ends, k) {
                let [height, speed] = self.change(x, k, [&states[k], &states[k + 1]], [&start, &end], &pair)?;
                let column = [height.value, speed.value, height.slope, speed.slope];
                entries.extend(column.into_iter().enumerate().map(|(i, value)| (4 * k + i, unknown, value)));
            }
        }
        Some(Entries::new(self.unknowns(), entries))
    }
}
