//! Periodic motions with two impacts in N cycles: by the closed forms (61)-(73), or isolated with proof where there are none.
//!
//! The paper's section 4 gives the equispaced motions, but not whether they are admissible or stable, nor the other motions.
//! Here each is enclosed, with its proved properties (`docs/proofs/two-impacts.md#W1`).
//!
//! | equation | what | item |
//! |---|---|---|
//! | (56)-(60) | two impacts in N cycles | [`Problem`], [`Orbit`] |
//! | (61) | `v_i = -v_{i+1}` | [`MeasuredOrbit::impacts`] |
//! | (61)-(63), (66)-(73) | as functions | [`closed_forms`] |
//! | (62), (63) | not equispaced, N odd and even: all of them | `unequispaced`, [`Answer`] |
//! | (64)-(69), (72), (73) | equispaced, N odd, e < 1 | `equispaced`, [`Unknown`] |
//! | (70), (71) | e = 1 | `elastic` |
//! | (38)-(40) | eigenvalues, stability | `stability`, [`MeasuredOrbit::eigenvalues`] |
//! | figs 10, 11 | `A_N` over W and v | [`Manifold`] |
//! | beyond the paper | first contacts | `motion`, [`MeasuredOrbit::physical`] |
//!
//! Modules, in reading order: `jet` (numbers with their derivatives), `isolate` (all zeros of a function), `angle`, `motion`,
//! `stability`, [`closed_forms`], `equispaced`, `elastic`, `unequispaced`, `data`, `orbit`, `problem`, `manifold`.
//!
//! ```
//! use impact_pair::two_impact::{Problem, Stability, Unknown};
//! use impact_pair::{Harmonic, ImpactPair};
//! let harmonic = Harmonic::new("2".parse()?, "pi".parse()?, "0".parse()?)?;
//! let pair = ImpactPair::new(harmonic, "3*pi".parse()?, "0.5".parse()?)?;
//! // Figure 13: the paper calls it quasi-periodic.
//! let answer = Problem::new(&pair, 1, Unknown::Velocity)?.answer(20);
//! assert!(answer.is_complete && answer.is_exhaustive);
//! let stable: Vec<_> = answer.orbits.iter().map(|orbit| &orbit.measured).filter(|orbit| orbit.stability == Stability::Stable).collect();
//! assert!(stable.len() == 1 && stable[0].symmetric == Some(true) && stable[0].physical == Some(true));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod angle;
pub mod closed_forms;
mod data;
mod document;
mod elastic;
mod equispaced;
mod isolate;
mod jet;
mod manifold;
mod motion;
mod orbit;
mod problem;
mod stability;
mod unequispaced;

pub use crate::periodic::{MeasuredOrbit, Stability};
pub use document::word;
pub use manifold::{Axis, COUNTS, Manifold, Mark, Part, Point, Range};
pub use orbit::Orbit;
pub use problem::{Answer, CYCLES, Problem, Unknown, speed};

#[cfg(test)]
mod tests;
