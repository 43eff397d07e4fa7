//! Verified numerics for the horizontal impact pair.
#![forbid(unsafe_code)]

pub mod contact;
mod error;
pub mod exact;
pub mod excitation;
pub mod flight;
pub mod mapping;
pub mod number;
pub mod orbit;
pub mod pair;

pub use error::Error;
pub use excitation::Harmonic;
pub use pair::ImpactPair;
