//! Verified numerics for the horizontal impact pair.
#![forbid(unsafe_code)]

pub mod certificate;
pub mod contact;
mod error;
pub mod exact;
pub mod excitation;
pub mod flight;
pub mod mapping;
pub mod number;
pub mod orbit;
pub mod pair;
pub mod scene;

pub use error::Error;
pub use excitation::Harmonic;
pub use pair::ImpactPair;
pub use scene::Scene;
