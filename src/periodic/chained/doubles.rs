//! Chains in a build without multiprecision.

/// What proofs of chains need of a pair in balls of any precision.
pub(in super::super) trait ChainedPrecisely {}

impl<S> ChainedPrecisely for S {}
