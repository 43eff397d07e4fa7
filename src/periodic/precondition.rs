//! Approximate inverses of the chains' derivatives, in doubles: nothing rests on how good they are.

use nalgebra::DMatrix;

use super::chain::Slopes;

/// An approximate inverse, row by row.
#[derive(Clone, Debug)]
pub struct Preconditioner {
    rows: Vec<f64>,
    count: usize,
}

impl Preconditioner {
    /// The inverse of these derivatives; `None` when they have none in doubles.
    pub fn new(slopes: &Slopes<f64>) -> Option<Self> {
        let count = slopes.0.len();
        let mut matrix = vec![0.0; count * count];
        for (i, j, value) in slopes.entries() {
            matrix[i * count + j] += value;
        }
        let rows = if let [a, b, c, d] = matrix[..] {
            let determinant = a * d - b * c;
            vec![d / determinant, -b / determinant, -c / determinant, a / determinant]
        } else {
            DMatrix::from_row_slice(count, count, &matrix).try_inverse()?.transpose().as_slice().to_vec()
        };
        rows.iter().all(|x| x.is_finite()).then_some(Self { rows, count })
    }

    /// Row `i`.
    #[inline(always)]
    pub fn row(&self, i: usize) -> &[f64] {
        &self.rows[i * self.count..(i + 1) * self.count]
    }
}
