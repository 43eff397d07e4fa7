//! Words of a document: returns of h-sets to h-sets.

/// A covering relation from one h-set to another.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(in crate::check) struct Word {
    pub from: usize,
    pub to: usize,
    pub half_cycles: i64,
    /// Its flights in order: whether each is to the far wall.
    pub flights: Vec<bool>,
}
