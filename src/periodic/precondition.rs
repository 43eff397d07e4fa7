//! Approximate inverses of Jacobian matrices, in doubles: nothing rests on how good they are.

use nalgebra::DMatrix;

use super::entries::Entries;

/// An approximate inverse.
#[derive(Clone, Debug)]
pub struct Preconditioner {
    /// The transpose of the inverse: its columns are the inverse's rows.
    transposed: DMatrix<f64>,
}

impl Preconditioner {
    /// Inverse of this matrix; `None` when it has none in doubles.
    pub fn new(jacobian: &Entries<f64>) -> Option<Self> {
        let transposed = jacobian.dense().try_inverse()?.transpose();
        transposed.iter().all(|x| x.is_finite()).then_some(Self { transposed })
    }

    /// Row `i`.
    #[inline(always)]
    pub fn row(&self, i: usize) -> &[f64] {
        let count = self.transposed.nrows();
        &self.transposed.as_slice()[i * count..(i + 1) * count]
    }
}
