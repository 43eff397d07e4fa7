//! The input of pictures of grids: a head, and the records of points.

use anyhow::Result;
use impact_pair::sweep::Head;

/// A sweep or an atlas whose records can be read several times.
pub trait Records {
    /// The type of the head.
    type Head: Head;

    /// The head, which holds all data that the points depend on.
    fn head(&self) -> &Self::Head;

    /// Passes each present point to `hand`, in order.
    ///
    /// # Errors
    /// Returns the errors of `hand`, and an error if a record cannot be read.
    fn each_record(&mut self, hand: impl FnMut(<Self::Head as Head>::Record) -> Result<()>) -> Result<()>;
}
