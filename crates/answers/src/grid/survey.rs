//! Sweeps and atlases: points of a grid, each a function of the exact scene and its number.

use anyhow::{Context, Result};
use impact_pair::Error;
use impact_pair::exact::Exact;
use impact_pair::scene::Key;
use impact_pair::watch::Watch;

use super::head::Head;
use super::journal::Points;
use super::record::line;
use crate::{Failure, Status};

/// The summary of a sweep or an atlas.
pub trait Tally: Head {
    /// How much is proved at the points that are there, and what.
    ///
    /// # Errors
    /// If a record cannot be read.
    fn tally(points: &mut Points<Self>) -> Result<Status>;
}

/// A sweep or an atlas of a scene: its points may be computed in any order.
pub trait Survey: Send + Sync {
    /// The first line.
    type Head: Tally;

    /// All that the points depend on.
    fn head(&self) -> &Self::Head;

    /// Refuses a grid whose corners are not accepted; if the corners are, all points are.
    ///
    /// # Errors
    /// The error of a corner: of an axis that gives the value at fault, else of the scene.
    fn check(&self) -> Result<(), Failure>;

    /// Exact values of a point, one per axis.
    ///
    /// # Errors
    /// If a value is beyond the range of exact expressions.
    fn values(&self, point: u64) -> Result<Vec<(Key, Exact)>, Error>;

    /// Computes the record of a point with these values; `None` if the watch stops it.
    ///
    /// # Errors
    /// If a value is not accepted.
    fn record(
        &self,
        point: u64,
        values: &[(Key, Exact)],
        watch: &dyn Watch,
    ) -> Result<Option<<Self::Head as Head>::Record>, Error>;

    /// Computes the line of a point; `None` if the watch stops it.
    ///
    /// # Errors
    /// If a value is not accepted: the error of the library, in the context of the point.
    fn line(&self, point: u64, watch: &dyn Watch) -> Result<Option<String>> {
        let values = self.values(point).with_context(|| format!("point {point}"))?;
        let found = self.record(point, &values, watch).with_context(|| {
            let values: Vec<String> = values.iter().map(|(key, value)| format!("{key} = {value}")).collect();
            format!("point {point} ({})", values.join(", "))
        })?;
        Ok(found.map(|record| line(&record)))
    }
}
