//! Chaos, proved.
pub(crate) mod flights;
pub(crate) mod guess;
pub(crate) mod trap;
