//! The derivatives of many flights by those of each, without the growth of boxes that are boxed again at every impact (Lemma V30).

use crate::check::affine::Affine;
use crate::check::tangency::flights::Flown;
use crate::check::tangency::jet::{D, X};
use impact_pair_exact::{Dyadic, Real};

/// The least radius of a box, as a power of 2.
const LEAST: i64 = -4096;
/// Bits of bounds.
const SHORT_BITS: u32 = 64;

/// Two rows.
pub(super) type Rows<const N: usize> = [[Real; N]; 2];

/// What one flight does with a box of states and values of the parameter.
struct Leg {
    /// About the derivative by the state, and by the parameter, at the middle: points.
    by_state: Rows<2>,
    by_parameter: Rows<1>,
    /// Bounds of what they are off by over the box.
    state_error: Rows<2>,
    parameter_error: Rows<1>,
    /// The derivatives of the derivative by the state by phase, speed and parameter, over the box.
    bends: [Rows<2>; 3],
}

/// The flights of a period over a set, as far as they are known.
pub(super) struct Legs {
    /// The derivatives of the parameter by the coordinates of the set.
    parameter: [Real; 3],
    legs: Vec<Leg>,
    /// `products[k][j]`: the product of the derivatives at the middle of the flights from `j` to `k`.
    products: Vec<Vec<Rows<2>>>,
    /// Derivatives of the states by the coordinates of the set, at the middle, and bounds of what they are off by.
    columns: Vec<Rows<3>>,
    column_errors: Vec<Rows<3>>,
    /// Bounds of what the derivatives by the first state are off by.
    errors: Vec<Rows<2>>,
}

fn size(x: &Real) -> Real {
    Real::point(x.enclosure().mag(), SHORT_BITS)
}

fn sizes<const N: usize>(x: &Rows<N>) -> Rows<N> {
    x.each_ref().map(|row| row.each_ref().map(size))
}

fn zeros<const N: usize>() -> Rows<N> {
    [(); 2].map(|()| [(); N].map(|()| Real::zero(SHORT_BITS)))
}

fn product<const N: usize>(a: &Rows<2>, b: &Rows<N>) -> Rows<N> {
    a.each_ref().map(|row| std::array::from_fn(|j| row[0].clone() * &b[0][j] + &(row[1].clone() * &b[1][j])))
}

fn plus<const N: usize>(a: &Rows<N>, b: &Rows<N>) -> Rows<N> {
    [0, 1].map(|i| std::array::from_fn(|j| a[i][j].clone() + &b[i][j]))
}

/// All matrices whose entries are off by no more than that.
fn around<const N: usize>(x: &Rows<N>, error: &Rows<N>) -> Rows<N> {
    [0, 1].map(|i| std::array::from_fn(|j| x[i][j].clone() + &Real::within(error[i][j].enclosure().sup(), SHORT_BITS)))
}

fn unit() -> Rows<2> {
    [[Real::int(1, SHORT_BITS), Real::zero(SHORT_BITS)], [Real::zero(SHORT_BITS), Real::int(1, SHORT_BITS)]]
}

impl Leg {
    /// From a flight of a box whose radii are known.
    fn new(flown: &Flown, radii: &[Real; 3], bits: u32) -> Option<Self> {
        let entries = [&flown.state.phase, &flown.state.speed].map(|jet| [jet.at(X, bits), jet.at(D, bits)]);
        let point = |x: &Real| x.rounded(bits).middle();
        let by_state = entries.each_ref().map(|row| row.each_ref().map(|x| point(&x.centre)));
        let off = |x: &Affine, point: &Real| size(&(x.hull() - point));
        let state_error = [0, 1].map(|i| [0, 1].map(|j| off(&entries[i][j], &by_state[i][j])));
        let moved = [&flown.state.phase, &flown.state.speed].map(|jet| jet.value(bits).column(2).over(&radii[2]));
        let [Some(a), Some(b)] = moved else { return None };
        let by_parameter = [[point(&a)], [point(&b)]];
        let parameter_error = [[size(&(a - &by_parameter[0][0]))], [size(&(b - &by_parameter[1][0]))]];
        let bend = |a: usize| -> Option<Rows<2>> {
            let [[p, q], [r, s]] = entries.each_ref().map(|row| row.each_ref().map(|x| x.column(a).over(&radii[a])));
            Some([[p?, q?], [r?, s?]])
        };
        let bends = [bend(0)?, bend(1)?, bend(2)?];
        Some(Self { by_state, by_parameter, state_error, parameter_error, bends })
    }
}

impl Legs {
    /// Returns those of a set whose members have these derivatives by its coordinates.
    pub fn new(columns: Rows<3>, parameter: [Real; 3]) -> Self {
        Self {
            parameter,
            legs: Vec::new(),
            products: vec![Vec::new()],
            columns: vec![columns],
            column_errors: vec![zeros()],
            errors: vec![zeros()],
        }
    }

    /// Returns how far phase, speed and parameter of the members reach before the next flight.
    pub fn reach(&self) -> [Real; 3] {
        let last = self.legs.len();
        let all = plus(&sizes(&self.columns[last]), &self.column_errors[last]);
        let sum = |row: &[Real; 3]| row[0].clone() + &row[1] + &row[2];
        let tiny = Dyadic::power_of_two(LEAST); // V30: a larger box is as sound
        let least = |x: Real| Real::point((x + &Real::point(tiny.clone(), SHORT_BITS)).enclosure().mag(), SHORT_BITS);
        [sum(&all[0]), sum(&all[1]), sum(&self.parameter.each_ref().map(size))].map(least)
    }

    /// Adds a flight of the box of that reach; `None` where it is not differentiable.
    pub fn push(&mut self, flown: &Flown, radii: &[Real; 3], bits: u32) -> Option<()> {
        let leg = Leg::new(flown, radii, bits)?;
        let k = self.legs.len();
        let mut products: Vec<Rows<2>> = self.products[k].iter().map(|x| product(&leg.by_state, x)).collect();
        products.push(leg.by_state.clone());
        let by_parameter: Rows<3> =
            leg.by_parameter.each_ref().map(|x| self.parameter.each_ref().map(|p| x[0].clone() * p));
        self.columns.push(plus(&product(&leg.by_state, &self.columns[k]), &by_parameter));
        self.legs.push(leg);
        self.products.push(products);
        let column_errors = self.added(&unit(), |k| self.own_error(k));
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

    /// Bounds what a flight adds to the errors of the derivatives by the coordinates of the set.
    fn own_error(&self, k: usize) -> Rows<3> {
        let (leg, own) = (&self.legs[k], plus(&sizes(&self.columns[k]), &self.column_errors[k]));
        let parameter = self.parameter.each_ref().map(size);
        let by_parameter = leg.parameter_error.each_ref().map(|x| parameter.each_ref().map(|p| x[0].clone() * p));
        plus(&product(&leg.state_error, &own), &by_parameter)
    }

    /// What each flight adds to an error, carried on by those at the middle and then by a matrix.
    fn added<const N: usize>(&self, matrix: &Rows<2>, own: impl Fn(usize) -> Rows<N>) -> Rows<N> {
        let last = self.legs.len();
        let carried = (0..last).map(|k| product(&sizes(&product(matrix, &self.product(k + 1, last))), &own(k)));
        carried.fold(zeros(), |sum, x| plus(&sum, &x))
    }

    /// Returns the product of a matrix and the derivatives of the last state, less these, by the coordinates, over the set.
    pub fn moved(&self, matrix: &Rows<2>, less: &Rows<3>) -> Rows<3> {
        let minus = less.each_ref().map(|row| row.each_ref().map(|x| -x));
        let middle = product(matrix, &plus(&self.columns[self.legs.len()], &minus));
        around(&middle, &self.added(matrix, |k| self.own_error(k)))
    }

    /// Returns the derivatives of the last state by the coordinates, over the set.
    pub fn slopes(&self) -> Rows<3> {
        let last = self.legs.len();
        around(&self.columns[last], &self.column_errors[last])
    }

    /// The product at the middle of all flights but one, from it on and round.
    fn round(&self, k: usize) -> Rows<2> {
        product(&self.product(0, k), &self.product(k + 1, self.legs.len()))
    }

    /// Returns the trace of the derivative by the first state, over the set.
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

    /// Returns the derivatives of the trace by the coordinates, over the set.
    pub fn trace_slopes(&self) -> [Real; 3] {
        let last = self.legs.len();
        // Of the flights from `k` on: bounds of what the product is off by.
        let mut later: Vec<Rows<2>> = vec![zeros(); last + 1];
        for k in (0..last).rev() {
            let terms = (k..last).map(|j| {
                let after = plus(&sizes(&self.product(j + 1, last)), &later[j + 1]);
                product(&product(&after, &self.legs[j].state_error), &sizes(&self.product(k, j)))
            });
            later[k] = terms.fold(zeros(), |sum, x| plus(&sum, &x));
        }
        let mut sum = [0, 1, 2].map(|_| Real::zero(SHORT_BITS));
        for (k, leg) in self.legs.iter().enumerate() {
            let [before, after] = [self.product(0, k), self.product(k + 1, last)].map(|x| sizes(&x));
            let off = plus(&product(&plus(&before, &self.errors[k]), &later[k + 1]), &product(&self.errors[k], &after));
            let round = around(&self.round(k), &off);
            let columns = around(&self.columns[k], &self.column_errors[k]);
            for (j, sum) in sum.iter_mut().enumerate() {
                let by = [&columns[0][j], &columns[1][j], &self.parameter[j]];
                let bend = (0..3).map(|a| leg.bends[a].each_ref().map(|row| row.each_ref().map(|x| x.clone() * by[a])));
                let bend = bend.fold(zeros(), |sum, x| plus(&sum, &x));
                let [[a, _], [_, d]] = product(&round, &bend);
                *sum = sum.clone() + &a + &d;
            }
        }
        sum
    }
}
