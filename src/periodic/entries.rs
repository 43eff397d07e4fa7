//! Square matrices by their entries: all of them, or those that may be other than 0.

use nalgebra::DMatrix;

/// A square matrix by rows, columns and values; values at one place are added.
///
/// A chain has three entries a row. As a dense matrix they would make a proof cost 1.07 times as many instructions with 2 impacts, 1.19
/// with 5 and 3.6 with 20 (`prove/*` of the bench `periodic`).
#[derive(Clone, Debug)]
pub struct Entries<N> {
    size: usize,
    entries: Vec<(usize, usize, N)>,
}

impl<N> Entries<N> {
    /// Matrix with `size` rows and columns.
    pub fn new(size: usize, entries: Vec<(usize, usize, N)>) -> Self {
        Self { size, entries }
    }

    /// Number of rows, and of columns.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Row, column and value of each entry.
    pub fn iter(&self) -> impl Iterator<Item = (usize, usize, &N)> {
        self.entries.iter().map(|(i, j, value)| (*i, *j, value))
    }

    /// Applies a function to each entry.
    pub fn map<M>(&self, f: impl Fn(&N) -> M) -> Entries<M> {
        Entries::new(self.size, self.iter().map(|(i, j, x)| (i, j, f(x))).collect())
    }

    /// The matrix with more entries in one row.
    pub fn with_row(mut self, i: usize, row: impl IntoIterator<Item = (usize, N)>) -> Self {
        self.entries.extend(row.into_iter().map(|(j, value)| (i, j, value)));
        self
    }

    /// The matrix with one more column and one more row, whose only entry is the column's last one.
    pub fn bordered(mut self, column: Vec<N>) -> Self {
        let last = self.size;
        self.entries.extend(column.into_iter().enumerate().map(|(i, value)| (i, last, value)));
        Self { size: last + 1, ..self }
    }
}

impl<N: Clone> Entries<N> {
    /// Entries whose rows and columns have a place in another matrix, as that matrix.
    pub fn part(
        &self,
        size: usize,
        row: impl Fn(usize) -> Option<usize>,
        column: impl Fn(usize) -> Option<usize>,
    ) -> Self {
        let place = |(i, j, x): (usize, usize, &N)| Some((row(i)?, column(j)?, x.clone()));
        Self::new(size, self.iter().filter_map(place).collect())
    }
}

impl Entries<f64> {
    /// The matrix with all its entries.
    pub fn dense(&self) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(self.size, self.size);
        self.iter().for_each(|(i, j, value)| matrix[(i, j)] += value);
        matrix
    }
}
