//! Documents of certified orbits, and their check by a route of its own.
//!
//! What this crate judges it shares nothing with: it rests on exact numbers and on the model alone.

pub mod document;
