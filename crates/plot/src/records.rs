//! The input of pictures of grids: a head, and the records of points.

use anyhow::Result;
use impact_pair::sweep::Head;

/// A sweep or an atlas whose records can be read several times.
pub trait Records {
    /// The kind of its head.
    type Head: Head;

    /// Returns the head, which holds everything that the points depend on.
    fn head(&self) -> &Self::Head;

    /// Hands on the points that are there, in order.
    ///
    /// # Errors
    /// Returns the errors of `hand`, and an error if a record cannot be read.
    fn each_record(&mut self, hand: impl FnMut(<Self::Head as Head>::Record) -> Result<()>) -> Result<()>;
}
