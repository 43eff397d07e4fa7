//! Derivatives of many flights from the derivatives of each flight, without boxing the box again at every impact (Lemmas V30, V31).

use super::affine::Affine;
use super::tangency::flights::Flown;
use super::tangency::jet::{D, X};
use impact_pair_exact::{Dyadic, Real};

/// The least radius of a box, as a power of 2.
const MIN_RADIUS_EXPONENT: i64 = -4096;
/// Bits of error bounds.
const SHORT_BITS: u32 = 64;

/// A radius that is not 0: a larger box is as sound.
pub(super) fn not_nothing(radius: Real) -> Real {
    let tiny = Real::point(Dyadic::power_of_two(MIN_RADIUS_EXPONENT), SHORT_BITS); // V30: a larger box is as sound
    Real::point((radius + &tiny).enclosure().mag(), SHORT_BITS)
}

/// Two rows.
pub(super) type Rows<const N: usize> = [[Real; N]; 2];

/// The derivatives of one flight over a box of states and values of `P` parameters.
struct Leg<const P: usize> {
    /// Approximate derivatives by the state, and by the parameters, at the middle: points.
    by_state: Rows<2>,
    by_parameters: Rows<P>,
    /// Bounds of the errors of these approximations over the box.
    state_error: Rows<2>,
    parameter_error: Rows<P>,
    /// The derivatives of the derivative by the state by phase, speed and each parameter, over the box.
    bends: Vec<Rows<2>>,
}

/// The flights of a word over a set of `N` coordinates, under `P` parameters.
pub(super) struct Legs<const N: usize, const P: usize> {
    /// The derivatives of the parameters by the coordinates of the set.
    parameters: [[Real; N]; P],
    legs: Vec<Leg<P>>,
    /// `products[k][j]`: the product of the derivatives at the middle of the flights from `j` to `k`.
    products: Vec<Vec<Rows<2>>>,
    /// Approximate derivatives of the states by the coordinates of the set, at the middle, and bounds of their errors.
    columns: Vec<Rows<N>>,
    column_errors: Vec<Rows<N>>,
    /// Bounds of the errors of the derivatives by the first state.
    errors: Vec<Rows<2>>,
}

pub(super) fn size(x: &Real) -> Real {
    Real::point(x.enclosure().mag(), SHORT_BITS)
}

fn sizes<const N: usize>(x: &Rows<N>) -> Rows<N> {
    x.each_ref().map(|row| row.each_ref().map(size))
}

fn zeros<const N: usize>() -> Rows<N> {
    [(); 2].map(|()| [(); N].map(|()| Real::zero(SHORT_BITS)))
}

pub(super) fn product<const N: usize>(a: &Rows<2>, b: &Rows<N>) -> Rows<N> {
    a.each_ref().map(|row| std::array::from_fn(|j| row[0].clone() * &b[0][j] + &(row[1].clone() * &b[1][j])))
}

pub(super) fn plus<const N: usize>(a: &Rows<N>, b: &Rows<N>) -> Rows<N> {
    [0, 1].map(|i| std::array::from_fn(|j| a[i][j].clone() + &b[i][j]))
}

/// Encloses all matrices whose entries differ from `x` by at most `error`.
fn around<const N: usize>(x: &Rows<N>, error: &Rows<N>) -> Rows<N> {
    [0, 1].map(|i| std::array::from_fn(|j| x[i][j].clone() + &Real::within(error[i][j].enclosure().sup(), SHORT_BITS)))
}

fn unit() -> Rows<2> {
    [[Real::int(1, SHORT_BITS), Real::zero(SHORT_BITS)], [Real::zero(SHORT_BITS), Real::int(1, SHORT_BITS)]]
}

impl<const P: usize> Leg<P> {
    /// The derivatives of a flight of a box with the given radii.
    fn new(flown: &Flown, radii: &[Real], bits: u32) -> Option<Self> {
        let entries = [&flown.state.phase, &flown.state.speed].map(|jet| [jet.at(X, bits), jet.at(D, bits)]);
        let point = |x: &Real| x.rounded(bits).middle();
        let by_state = entries.each_ref().map(|row| row.each_ref().map(|x| point(&x.centre)));
        let off = |x: &Affine, point: &Real| size(&(x.hull() - point));
        let state_error = [0, 1].map(|i| [0, 1].map(|j| off(&entries[i][j], &by_state[i][j])));
        let (mut by_parameters, mut parameter_error) = (zeros::<P>(), zeros::<P>());
        for (i, jet) in [&flown.state.phase, &flown.state.speed].into_iter().enumerate() {
            for j in 0..P {
                let slope = jet.value(bits).column(2 + j).over(&radii[2 + j])?;
                by_parameters[i][j] = point(&slope);
                parameter_error[i][j] = size(&(slope - &by_parameters[i][j]));
            }
        }
        let bend = |a: usize| -> Option<Rows<2>> {
            let [[p, q], [r, s]] = entries.each_ref().map(|row| row.each_ref().map(|x| x.column(a).over(&radii[a])));
            Some([[p?, q?], [r?, s?]])
        };
        let bends = (0..2 + P).map(bend).collect::<Option<_>>()?;
        Some(Self { by_state, by_parameters, state_error, parameter_error, bends })
    }
}

impl<const N: usize, const P: usize> Legs<N, P> {
    /// No flights yet: a set whose members have the derivatives `columns` by the coordinates, up to `error`.
    pub fn new((columns, error): (Rows<N>, Rows<N>), parameters: [[Real; N]; P]) -> Self {
        Self {
            parameters,
            legs: Vec::new(),
            products: vec![Vec::new()],
            columns: vec![columns],
            column_errors: vec![error],
            errors: vec![zeros()],
        }
    }

    /// Radii of the set before the next flight: of phase, speed and parameters.
    pub fn reach(&self) -> Vec<Real> {
        let last = self.legs.len();
        let all = plus(&sizes(&self.columns[last]), &self.column_errors[last]);
        let sum = |row: &[Real; N]| row.iter().fold(Real::zero(SHORT_BITS), |sum, x| sum + x);
        let parameters = self.parameters.iter().map(|row| sum(&row.each_ref().map(size)));
        all.iter().map(sum).chain(parameters).map(not_nothing).collect()
    }

    /// Adds a flight of the box with the radii `radii`; `None` where the flight is not differentiable.
    pub fn push(&mut self, flown: &Flown, radii: &[Real], bits: u32) -> Option<()> {
        let leg = Leg::new(flown, radii, bits)?;
        let k = self.legs.len();
        let mut products: Vec<Rows<2>> = self.products[k].iter().map(|x| product(&leg.by_state, x)).collect();
        products.push(leg.by_state.clone());
        let by_parameters = self.by_parameters(&leg.by_parameters, |p| p.clone());
        self.columns.push(plus(&product(&leg.by_state, &self.columns[k]), &by_parameters));
        self.legs.push(leg);
        self.products.push(products);
        let column_errors = self.column_error(&unit());
        let errors = self.added(&unit(), |k| {
            let own = plus(&sizes(&self.product(0, k)), &self.errors[k]);
            product(&self.legs[k].state_error, &own)
        });
        self.column_errors.push(column_errors);
        self.errors.push(errors);
        Some(())
    }

    /// The product of the derivatives at the middle of the flights from `from` to before `to`.
    fn product(&self, from: usize, to: usize) -> Rows<2> {
        self.products[to].get(from).cloned().unwrap_or_else(unit) // exact: of no flight
    }

    /// Derivatives by the parameters times the derivatives of the parameters by the coordinates of the set.
    fn by_parameters(&self, slopes: &Rows<P>, part: impl Fn(&Real) -> Real) -> Rows<N> {
        let sum = |row: &[Real; P], j: usize| {
            row.iter()
                .zip(&self.parameters)
                .fold(Real::zero(SHORT_BITS), |sum, (x, p)| sum + &(x.clone() * &part(&p[j])))
        };
        slopes.each_ref().map(|row| std::array::from_fn(|j| sum(row, j)))
    }

    /// Bounds the error that flight `k` adds to the derivatives by the coordinates of the set.
    fn own_error(&self, k: usize) -> Rows<N> {
        let (leg, own) = (&self.legs[k], plus(&sizes(&self.columns[k]), &self.column_errors[k]));
        plus(&product(&leg.state_error, &own), &self.by_parameters(&leg.parameter_error, size))
    }

    /// Bounds the error of the derivatives of the last state by the coordinates, multiplied by a matrix.
    fn column_error(&self, matrix: &Rows<2>) -> Rows<N> {
        let first = product(&sizes(&product(matrix, &self.product(0, self.legs.len()))), &self.column_errors[0]);
        plus(&first, &self.added(matrix, |k| self.own_error(k)))
    }

    /// The sum of the errors that the flights add, propagated by the derivatives at the middle and multiplied by a matrix.
    fn added<const M: usize>(&self, matrix: &Rows<2>, own: impl Fn(usize) -> Rows<M>) -> Rows<M> {
        let last = self.legs.len();
        let carried = (0..last).map(|k| product(&sizes(&product(matrix, &self.product(k + 1, last))), &own(k)));
        carried.fold(zeros(), |sum, x| plus(&sum, &x))
    }

    /// Encloses `matrix` times the difference of the last state's derivatives by the coordinates and `less`, over the set.
    pub fn moved(&self, matrix: &Rows<2>, less: &Rows<N>) -> Rows<N> {
        let minus = less.each_ref().map(|row| row.each_ref().map(|x| -x));
        let middle = product(matrix, &plus(&self.columns[self.legs.len()], &minus));
        around(&middle, &self.column_error(matrix))
    }

    /// Encloses the derivatives of the state before flight `k` by the coordinates, over the set.
    pub fn slopes(&self, k: usize) -> Rows<N> {
        around(&self.columns[k], &self.column_errors[k])
    }

    /// Encloses the derivatives of the state after flight `k` by the state before, and by the parameters, over the box of the flight.
    pub fn of_flight(&self, k: usize) -> (Rows<2>, Rows<P>) {
        let leg = &self.legs[k];
        (around(&leg.by_state, &leg.state_error), around(&leg.by_parameters, &leg.parameter_error))
    }

    /// Encloses the derivatives of flight `k`'s derivative by phase, speed and each parameter, over the box of the flight.
    pub fn bends(&self, k: usize) -> &[Rows<2>] {
        &self.legs[k].bends
    }

    /// Encloses the derivatives of the last state by the state before each flight, and by the last state, over the set.
    pub fn to_the_end(&self) -> Vec<Rows<2>> {
        let last = self.legs.len();
        self.later().iter().enumerate().map(|(k, error)| around(&self.product(k, last), error)).collect()
    }

    /// The product at the middle of all flights but `k`, in cyclic order from `k + 1` on.
    fn round(&self, k: usize) -> Rows<2> {
        product(&self.product(0, k), &self.product(k + 1, self.legs.len()))
    }

    /// Encloses the trace of the derivative by the first state, over the set.
    pub fn trace(&self) -> Real {
        let last = self.legs.len();
        let [[a, _], [_, d]] = self.product(0, last);
        let error = |k: usize| {
            let [[a, _], [_, d]] = product(&sizes(&self.round(k)), &self.legs[k].state_error);
            let carried = product(&sizes(&self.product(k + 1, last)), &self.legs[k].state_error);
            let [[b, _], [_, c]] = product(&carried, &self.errors[k]);
            a + &d + &b + &c
        };
        let error = (0..last).map(error).fold(Real::zero(SHORT_BITS), |sum, x| sum + &x);
        a + &d + &Real::within(error.enclosure().sup(), SHORT_BITS)
    }

    /// Bounds the errors of the products of flights `k` to the last, for each `k`.
    fn later(&self) -> Vec<Rows<2>> {
        let last = self.legs.len();
        let mut later: Vec<Rows<2>> = vec![zeros(); last + 1];
        for k in (0..last).rev() {
            let terms = (k..last).map(|j| {
                let after = plus(&sizes(&self.product(j + 1, last)), &later[j + 1]);
                product(&product(&after, &self.legs[j].state_error), &sizes(&self.product(k, j)))
            });
            later[k] = terms.fold(zeros(), |sum, x| plus(&sum, &x));
        }
        later
    }

    /// Encloses the derivatives of the trace by the coordinates, over the set.
    pub fn trace_slopes(&self) -> [Real; N] {
        let (last, later) = (self.legs.len(), self.later());
        let mut sum = std::array::from_fn(|_| Real::zero(SHORT_BITS));
        for (k, leg) in self.legs.iter().enumerate() {
            let [before, after] = [self.product(0, k), self.product(k + 1, last)].map(|x| sizes(&x));
            let off = plus(&product(&plus(&before, &self.errors[k]), &later[k + 1]), &product(&self.errors[k], &after));
            let round = around(&self.round(k), &off);
            let columns = around(&self.columns[k], &self.column_errors[k]);
            for (j, sum) in sum.iter_mut().enumerate() {
                let by = columns.iter().chain(&self.parameters).map(|row| &row[j]);
                let bend = leg.bends.iter().zip(by);
                let bend = bend.map(|(bend, by)| bend.each_ref().map(|row| row.each_ref().map(|x| x.clone() * by)));
                let bend = bend.fold(zeros(), |sum, x| plus(&sum, &x));
                let [[a, _], [_, d]] = product(&round, &bend);
                *sum = sum.clone() + &a + &d;
            }
        }
        sum
    }
}
