//! Approximate inverses of Jacobian matrices, in doubles: nothing rests on how good they are.

use nalgebra::{DMatrix, Scalar};

/// A square matrix by its entries: all of them, or those that may be other than 0.
pub trait Jacobian<N: Scalar> {
    /// How many rows it has, and columns.
    fn size(&self) -> usize;
    /// Row, column and value, row by row; what falls on one place is added.
    fn entries(&self) -> impl Iterator<Item = (usize, usize, &N)>;
}

impl<N: Scalar> Jacobian<N> for DMatrix<N> {
    fn size(&self) -> usize {
        self.nrows()
    }

    fn entries(&self) -> impl Iterator<Item = (usize, usize, &N)> {
        (0..self.nrows()).flat_map(move |i| (0..self.ncols()).map(move |j| (i, j, &self[(i, j)])))
    }
}

/// An approximate inverse.
#[derive(Clone, Debug)]
pub struct Preconditioner {
    /// Its columns are the rows.
    transposed: DMatrix<f64>,
}

impl Preconditioner {
    /// Returns the inverse of this matrix; `None` when it has none in doubles.
    pub fn new(jacobian: &impl Jacobian<f64>) -> Option<Self> {
        let mut matrix = DMatrix::<f64>::zeros(jacobian.size(), jacobian.size());
        for (i, j, value) in jacobian.entries() {
            matrix[(i, j)] += value;
        }
        let transposed = matrix.try_inverse()?.transpose();
        transposed.iter().all(|x| x.is_finite()).then_some(Self { transposed })
    }

    /// Row `i`.
    #[inline(always)]
    pub fn row(&self, i: usize) -> &[f64] {
        let count = self.transposed.nrows();
        &self.transposed.as_slice()[i * count..(i + 1) * count]
    }
}
