//! Independent check of certified orbits.
//!
//! This crate checks the claims of an orbit JSON, and makes a theorem for Coq of them. It shares no code with the computation of the
//! claims except the exact numbers and the model.
//!
//! ```
//! use impact_pair_certificate::{Claims, Limits, Verdict};
//! use impact_pair_model::watch::Unwatched;
//!
//! // What `impact-pair run scenes/figure-14.toml --impacts 6 --format json` writes.
//! let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/documents/count.jsonl"));
//! let claims = Claims::parse(text)?;
//! assert_eq!(claims.all(), "6 events and the outcome");
//! assert!(matches!(claims.check_within(&Limits::default(), &Unwatched)?, Verdict::Confirmed { .. }));
//!
//! // The ball hits the right wall first.
//! let claims = Claims::parse(&text.replacen("\"right\"", "\"left\"", 1).replacen("P2", "P4", 1))?;
//! let Verdict::Refuted(finding) = claims.check_within(&Limits::default(), &Unwatched)? else { panic!("it is false") };
//! assert!(claims.described(&finding).starts_with("events[0], impact 1: "));
//! # Ok::<(), impact_pair_model::Error>(())
//! ```

mod atlas;
mod attraction;
mod bifurcation;
mod cells;
mod chaos;
mod check;
mod checked;
mod claims;
mod cycles;
mod description;
mod global;
mod grid;
mod judged;
mod leaves;
mod marks;
mod periodic;
mod prove;
mod read;
mod sweep;
mod tangency;
mod theorem;
mod tiles;
#[cfg(test)]
#[path = "../../../tests/tolerances/mod.rs"]
mod tolerances;
mod trap;
mod windows;

pub use check::{Finding, Limits, Verdict};
pub use claims::Claims;
use claims::{Of, boxed};
#[doc(inline)]
pub use impact_pair_document as document;
pub use judged::CheckResult;
pub use prove::Theorem;
pub use read::{Certificate, Claim};
