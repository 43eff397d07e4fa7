//! An independent judge for `impact-pair`: the motion of a ball in a shaken gap, in MPFR floats.
//!
//! It shares nothing with the library but the physics (Han, Luo & Deng 1995, eqs. (10)-(15)): neither isolation nor units nor arithmetic.
//! It works in physical units and radians, with theta = W t + tau, and *proves nothing*: it is a careful computation in [`BITS`] bits that
//! says [`Next::Touch`] or [`Next::Open`] where these do not tell a touch from a miss. All inputs are exact values of their floats.
//!
//! ```
//! use impact_pair_truth::{Next, Shaken, State, Tone, Wall, float};
//! use rug::float::Constant;
//!
//! // Figure 12 made exact: impacts at every whole time, at 4 pi.
//! let pi = float(Constant::Pi);
//! let tones = vec![Tone { amplitude: float(1), frequency: pi.clone(), phase: float(0) }];
//! let pair = Shaken { tones, gap: float(&pi * 3), restitution: float(0.5) };
//! let start = State::on_wall(&pair, Wall::Left, float(0), float(&pi * 2));
//! let Next::Contact(contact) = pair.next(&start) else { panic!() };
//! assert!(contact.wall == Wall::Right && (contact.time - 1u32).abs() < 1e-130);
//! ```

mod flight;

pub use flight::{BITS, Contact, Next, Shaken, State, Tone, Wall, float};
