//! What an orbit JSON claims, checked by a route of its own, and as a theorem for Coq.

mod attraction;
mod check;
mod prove;
mod read;

pub use check::{Effort, Finding, Verdict};
pub use impact_pair_certificate::document;
pub use prove::Theorem;
pub use read::{Certificate, Claim, ClaimKind};
