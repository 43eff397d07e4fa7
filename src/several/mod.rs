//! Several harmonics: flights, first contacts, chatter, rest and release under the excitation of equation (1).
//!
//! One harmonic has its extrema in closed form ([`crate::contact`]); a sum has not. Its derivatives are bounded at all
//! times, though: so a flight is proved free of contacts piece by piece (`scan`), each as long as a cubic bound stays
//! between the walls, and jumps ahead where no wall is in reach (`reach`). Time is in periods of the fastest harmonic,
//! length in gaps. The lemmas H1-H9 are in `docs/proofs/harmonics.md#H1`.

mod flight;
mod graze;
mod harmonics;
mod phased;
mod precise;
mod reach;
mod rest;
mod scan;
mod spectrum;
mod ticks;
mod touch;
mod view;

pub(crate) use flight::SumFlight;
pub(crate) use harmonics::{Harmonics, Partial, Rates, Sums};
pub(crate) use phased::{FlightNumber, PhaseNumber};
pub(crate) use reach::{Band, Reach};
pub(crate) use rest::{Zero, accumulation, release};
pub(crate) use scan::{Doubt, Found, Scan};
pub(crate) use spectrum::{Spectrum, phases_at};
pub(crate) use touch::is_touch;
pub(crate) use {flight::Instant, graze::pass};

#[cfg(test)]
mod tests;
