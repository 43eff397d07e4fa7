//! The tests of the public interface, in one executable: a module each.

mod arrows;
mod attractor;
mod bifurcations;
mod check;
mod checked_attractors;
mod checked_bifurcations;
mod checked_chaos;
mod checked_documents;
mod checked_shadows;
mod extremes;
mod flight;
mod forger;
mod labels;
mod orbit;
mod package;
mod periodic;
mod periodic_several;
mod scene;
mod several;
mod soundness;
mod spoiled;
mod starts;
mod straddle;
mod tolerances;
mod two_impact;
mod words;
