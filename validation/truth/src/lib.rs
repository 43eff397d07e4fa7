//! An independent judge for `impact-pair`: the free flight of a ball in a shaken gap, in MPFR floats.
//!
//! It shares nothing with the library but the physics (Han, Luo & Deng 1995, eqs. (10)-(15)). It works in physical
//! units and radians, with theta = W t + tau, and *proves nothing*: it is a careful computation at P >= 256 bits that
//! says [`Truth::Graze`] when P bits do not tell a touch from a miss.
//!
//! - [`number`]: exact numbers ([`Number`]).
//! - [`problem`]: the box ([`Problem`]), walls ([`Wall`]) and states ([`Start`]).
//! - [`flight`]: [`first_contact`], by monotone pieces of y(t), and the answer [`Truth`].
//! - `extremes`: the extremes of a flight that goes up and down, and the jump over forcing periods.
//! - `root`: the contact on one monotone piece: double-precision guess, bracketed Newton, sign check.
//! - [`mod@orbit`]: [`orbit()`], many impacts in a row, v+ = -e v-.
//! - [`mod@scan`]: [`scan()`], a dense double-precision scan that knows nothing of pieces; it judges the judge.
//!
//! # Accuracy
//! Let P be [`Problem::precision`]. Every input is taken as the exact value of its float. A reported contact time is
//! within 2^-(P-40) / W of the true one plus the rounding of the absolute time to P bits; velocities are within
//! 2^-(P-40) of the larger of |v+| and A W. Only `2 pi`-reduction and flight are computed with more bits, as many as
//! a huge W t, a long flight or a slow contact eats; W and tau rounded to P bits (`pi`!) are the caller's business.
//!
//! ```
//! use impact_pair_truth::{Problem, Start, Truth, Wall, first_contact};
//!
//! // Figure 12 made exact: impacts at every whole time, at 4 pi.
//! let problem = Problem::new(256, 1, "pi", 0, "3*pi", "1/2");
//! let start = Start::on_wall(&problem, Wall::Left, 0, "2*pi");
//! let Truth::Contact { time, wall, .. } = first_contact(&problem, &start) else { panic!() };
//! assert!(wall == Wall::Right && (time - 1u32).abs() < 1e-65);
//! ```

mod extremes;
pub mod flight;
pub mod number;
pub mod orbit;
pub mod problem;
mod root;
pub mod scan;

pub use flight::{Truth, first_contact};
pub use number::{Number, pi_times};
pub use orbit::{Contact, orbit};
pub use problem::{Problem, Start, Wall};
pub use scan::{displacement_f64, scan};
