//! Regions that no motion leaves, and words of horseshoes, proved again in intervals of doubles (Lemmas V11, V39).
//!
//! The impact map with every impact mirrored to the left wall: a state is a phase in forcing periods and a speed over `A W`, lengths are in
//! amplitudes, times of flight in forcing periods since the departure. Of a region the document's own boxes are proved to be closed
//! ([`region`], [`trap`]), and the words of walls are counted on a graph of its own ([`language`]). Words are proved with the strips that the document
//! has for them ([`strip`]).

mod allowance;
mod bases;
mod beam;
mod blocks;
mod cells;
mod cones;
mod entropy;
mod global;
mod guess;
mod horseshoe;
mod judge;
mod language;
mod region;
mod said;
mod strip;
#[cfg(test)]
mod tests;
mod trap;
mod words;

use impact_pair_exact::Exact;
use impact_pair_model::{Error, ImpactPair};

use super::span;
use super::units::ratio;
pub(in crate::check) use cells::{are_distinct, has_stable_orbit};
use span::Span;

/// The parameters of the map.
#[derive(Clone, Copy, Debug)]
struct Law {
    /// `D = d/A`
    gap: Span,
    /// `e`
    restitution: Span,
}

impl Law {
    /// Returns the law of a pair with one harmonic.
    fn of(pair: &ImpactPair) -> Result<Self, Error> {
        let harmonic = pair.harmonic("the impact map without units")?;
        Error::require_positive("excitation.amplitude", harmonic.amplitude())?;
        let of = |x: &Exact| Span::of(&x.enclose(BITS));
        Ok(Self { gap: of(&ratio(pair, harmonic)?), restitution: of(pair.restitution()) })
    }
}

/// Bits that exact numbers are enclosed with before they become doubles.
const BITS: u32 = 128;
/// Looks at flights of less than a forcing period, in doubles, that are as much work as one place of a flight in many bits.
const STEPS_PER_PLACE: u64 = 1 << 7;
