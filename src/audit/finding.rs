//! The result of the comparison for a row of the list or an impact.

use super::verdict::Verdict;
use crate::exact::Enclosure;

/// A row, a certified impact, or both.
#[derive(Clone, Debug)]
pub struct Finding {
    /// Verdict on the row or impact.
    pub verdict: Verdict,
    /// Index of the row in the list.
    pub row: Option<usize>,
    /// Contact that the row is; for a false row the nearest contact.
    pub(super) site: Option<usize>,
    /// Errors of the row, where the row is matched to the contact.
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
