//! The library against the reference simulator, in one executable: a module each.

mod adversarial;
mod check;
mod closed_forms;
mod common;
mod crossings;
#[path = "../../../tests/environment/mod.rs"]
mod environment;
mod extremes;
mod flights;
mod grazes;
mod impact_maps;
mod intervals;
mod multiprecision;
mod numbers;
mod orbits;
mod random;
mod random_starts;
mod stability;
mod straddle;
mod theory;
#[path = "../../../tests/tolerances/mod.rs"]
mod tolerances;
