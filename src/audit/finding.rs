//! The result of the comparison for a row of the list or an impact.

use super::verdict::Verdict;
use crate::exact::Enclosure;

/// A row, a certified impact, or both.
#[derive(Clone, Debug)]
pub struct Finding {
    /// Its verdict.
    pub verdict: Verdict,
    /// Position of the row among the rows.
    pub row: Option<usize>,
    /// The contact that it is; of a false row the nearest one.
    pub(super) site: Option<usize>,
    /// The errors of the row, if it is the contact.
    pub errors: Option<Errors>,
}

/// Enclosures of the errors of a row.
#[derive(Clone, Debug)]
pub struct Errors {
    /// \[time\]
    pub time: Enclosure,
    /// \[length/time\]; `None` if there is none to compare.
    pub velocity: Option<Enclosure>,
}
