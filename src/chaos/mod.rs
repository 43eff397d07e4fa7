//! Chaos, proved.
pub(crate) mod entropy;
pub(crate) mod flights;
pub(crate) mod guess;
pub(crate) mod propose;
pub(crate) mod trap;
pub(crate) mod tube;
pub(crate) mod words;
