//! What an orbit is handed on as: the orbit JSON, schema `impact-pair/orbit/1`, and its lines; periodic orbits as the
//! periodic JSON, schema `impact-pair/periodic/1` ([`PeriodicDocument`]); bifurcations as `impact-pair/bifurcations/1`.
//!
//! Bounds are decimal strings rounded outward: the truth lies in `[lower, upper]`. A document is one object: the [`head`], the
//! `outcome` and the `events`. As JSON Lines it is the head alone, one event a line, and at last `{"outcome": ..., "arithmetic":
//! ...}`, which are not known before. Runs in `float` have `"certified": false`, and both bounds are the double itself.

mod attraction;
mod bifurcation;
mod check;
mod conclusion;
mod document;
mod event;
mod periodic;
mod prove;
mod read;

pub use bifurcation::{BIFURCATION_SCHEMA, BifurcationDocument};
pub use check::{Effort, Finding, Verdict};
pub use conclusion::Conclusion;
pub use document::{ORBIT_SCHEMA, PROGRAM, arithmetic, asked_arithmetic, head, is_certified, scene, write_json};
pub use event::{Bounds, Event, Kind};
pub use periodic::{PERIODIC_SCHEMA, PeriodicDocument};
pub(crate) use periodic::{orbit_json, phase_in_radians};
pub use prove::Theorem;
pub use read::{Certificate, Claim, ClaimKind};

#[cfg(test)]
mod tests;
