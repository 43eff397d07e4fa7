//! Quantities that depend on the data nearly linearly: sets without the wrapping of boxes.

use impact_pair_exact::{Dyadic, Real};

/// Bits of error terms, and of columns.
pub(super) const COLUMN_BITS: u32 = 96;

/// `x = centre + sum_j columns[j] q_j + r` with `|q_j| <= 1` and `|r| <= error`.
///
/// The `q_j` are the deviations of those data of the scene that are intervals, shared by all quantities of an orbit.
/// Data that are points have no deviation; without interval data the set is a ball.
#[derive(Clone, Debug)]
pub(crate) struct Affine {
    /// Encloses the value at the middle of the data.
    pub centre: Real,
    columns: Vec<Real>,
    error: Dyadic,
}

impl Affine {
    /// A quantity that does not depend on the interval data.
    pub fn fixed(centre: Real) -> Self {
        Self { centre, columns: Vec::new(), error: Dyadic::zero() }
    }

    /// `centre + radius q_j`
    pub fn varied(centre: Real, radius: Dyadic, j: usize) -> Self {
        let zero = Real::zero(COLUMN_BITS);
        let mut columns = vec![zero; j];
        columns.push(Real::point(radius, COLUMN_BITS));
        Self { centre, columns, error: Dyadic::zero() }
    }

    /// `centre + columns[0] q_first + columns[1] q_(first + 1)`
    pub fn spanned(centre: Real, first: usize, columns: [Real; 2]) -> Self {
        let mut all = vec![Real::zero(COLUMN_BITS); first];
        all.extend(columns);
        Self { centre, columns: all, error: Dyadic::zero() }
    }

    /// Number of deviations that have a column.
    pub fn length(&self) -> usize {
        self.columns.len()
    }

    /// Greatest number of bits of the columns.
    pub fn column_bits(&self) -> u32 {
        self.columns.iter().map(Real::bits).max().unwrap_or(COLUMN_BITS) // X1: any number of bits encloses
    }

    /// Encloses its derivative by `q_j`.
    pub fn column(&self, j: usize) -> Real {
        self.columns.get(j).cloned().unwrap_or_else(|| Real::zero(COLUMN_BITS)) // exact: it does not depend on it
    }

    /// A superset whose columns before `first` are points: their widths are part of its error.
    pub fn with_exact_columns(mut self, first: usize) -> Self {
        let mut off = Real::point(self.error, COLUMN_BITS);
        for column in self.columns.iter_mut().take(first) {
            let point = Real::point(column.mid(), COLUMN_BITS);
            off = off + &Real::point((column.clone() - &point).enclosure().mag(), COLUMN_BITS);
            *column = point;
        }
        Self { error: off.enclosure().sup().clone(), ..self }
    }

    /// The same centre and columns before `first`, with two columns from `first` on, and no error.
    pub fn with_own(self, first: usize, own: [Real; 2]) -> Self {
        let mut columns = self.columns;
        columns.resize(first, Real::zero(COLUMN_BITS));
        columns.extend(own);
        Self { centre: self.centre, columns, error: Dyadic::zero() }
    }

    /// The values where the deviations from `first` on are 0.
    pub fn without(&self, first: usize) -> Self {
        let columns = self.columns.iter().take(first).cloned().collect();
        Self { columns, ..self.clone() }
    }

    /// Mean value form of a function of `terms`: `f = centre + sum_k slope_k (x_k - centre of x_k)`.
    ///
    /// Each slope encloses the partial derivative over the hulls of all terms. `centre` encloses the values where each term is
    /// at any point of its own `centre`.
    pub fn of(centre: Real, terms: &[(&Real, &Self)]) -> Self {
        let length = terms.iter().map(|(_, x)| x.columns.len()).max().unwrap_or(0); // exact: no terms, no columns
        let mut columns = vec![Real::zero(COLUMN_BITS); length];
        let mut spread = Real::zero(COLUMN_BITS);
        for (slope, x) in terms {
            let slope = slope.rounded(x.column_bits());
            for (sum, column) in columns.iter_mut().zip(&x.columns) {
                *sum = sum.clone() + &(column.clone() * &slope);
            }
            spread = spread + &Real::point(slope.enclosure().mag().times(&x.error), COLUMN_BITS);
        }
        Self { centre, columns, error: spread.enclosure().sup().clone() }
    }

    /// Whether the quantity is known as well as its centre: no deviations, no error.
    pub fn is_fixed(&self) -> bool {
        self.columns.is_empty() && self.error.is_zero()
    }

    /// A superset whose centre is a point.
    pub fn recentred(self) -> Self {
        let middle = Real::point(self.centre.mid(), self.centre.bits());
        let off = Real::point((self.centre - &middle).enclosure().mag(), COLUMN_BITS);
        let error = off + &Real::point(self.error, COLUMN_BITS);
        Self { centre: middle, columns: self.columns, error: error.enclosure().sup().clone() }
    }

    /// The same deviations around 0.
    pub fn less_centre(self) -> Self {
        Self { centre: Real::zero(self.centre.bits()), ..self }
    }

    /// All values of the error.
    pub fn spread(&self) -> Real {
        Real::within(&self.error, COLUMN_BITS)
    }

    /// The sum with a number.
    pub fn shifted(self, by: &Real) -> Self {
        Self { centre: self.centre.clone() + by, ..self }.recentred()
    }

    /// Index of the deviation before `first` that the quantity depends on most.
    pub fn widest(&self, first: usize) -> Option<usize> {
        let sizes = self.columns.iter().take(first).map(|column| column.enclosure().mag()).enumerate();
        sizes.filter(|(_, size)| !size.is_zero()).max_by(|a, b| a.1.cmp(&b.1)).map(|(j, _)| j)
    }

    /// Leading known bits of the sum of this quantity with numbers around `2^beside`; `None` if the quantity is known exactly.
    pub fn accuracy(&self, beside: i64) -> Option<u32> {
        let unknown =
            (Real::point(self.error.clone(), COLUMN_BITS) + &Real::point(self.reach(), COLUMN_BITS)).enclosure().mag();
        let size = self.centre.enclosure().mag().top().map_or(beside, |top| top.max(beside)); // proposes: bits to compute with
        unknown.top().map(|unknown| u32::try_from(size.saturating_sub(unknown)).unwrap_or(0)) // proposes
    }

    /// Upper bound of the part that depends on the deviations.
    pub fn reach(&self) -> Dyadic {
        let reach = |sum: Real, column: &Real| sum + &Real::point(column.enclosure().mag(), COLUMN_BITS);
        self.columns.iter().fold(Real::zero(COLUMN_BITS), reach).enclosure().sup().clone()
    }

    /// The interval of all values.
    pub fn hull(&self) -> Real {
        self.centre.clone() + &Real::within(&self.reach(), COLUMN_BITS) + &self.spread()
    }

    /// Whether the deviations of the data, those before `first`, make up most of the width.
    pub fn is_wide_by_data(&self, first: usize) -> bool {
        self.without(first).reach() > self.own_reach(first)
    }

    /// Upper bound of the part that does not depend on the deviations before `first`.
    pub fn own_reach(&self, first: usize) -> Dyadic {
        let own = self.columns.iter().skip(first).map(|column| Real::point(column.enclosure().mag(), COLUMN_BITS));
        let sum = own.fold(Real::point(self.error.clone(), COLUMN_BITS), |sum, x| sum + &x);
        sum.enclosure().sup().clone()
    }
}
