//! Chains in a build without multiprecision.

/// The operations on a pair in balls of any precision that proofs of its chains need: none here.
pub(in super::super) trait ChainedPrecisely {}

impl<S> ChainedPrecisely for S {}
