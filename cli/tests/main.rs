//! The tests of the command line, in one executable: a module each.

mod atlas;
mod audit;
mod bad_scenes;
mod certificates;
mod chaos;
mod common;
mod cycles;
mod describe;
mod documents;
mod endings;
mod global;
mod help;
mod looks;
mod mistakes;
mod output;
mod periodic;
mod plot;
mod run;
mod schemas;
mod sweep;
mod sweep_tables;
mod tangency;
#[path = "../../tests/tolerances/mod.rs"]
mod tolerances;
mod trade;
mod two_impact;
mod verified;
mod windows;
