//! The library against the reference simulator, in one executable: a module each.

mod bounds;
mod crossings;
#[path = "../../../tests/environment/mod.rs"]
mod environment;
mod flights;
mod hard;
mod impact_maps;
mod intervals;
mod multiprecision;
mod random;
mod random_starts;
mod straddle;
