//! What an orbit JSON claims of the periodic orbit that its motion converges to.

use crate::document::{Decimal, OutcomeDocument, PeriodicImpactDocument, Place};
use num_rational::BigRational;

use impact_pair_model::Error;
use impact_pair_model::Wall;
use impact_pair_model::Word;

/// A stable periodic orbit that the motion is claimed to converge to.
#[derive(Clone, Debug)]
pub(super) struct Attraction {
    pub word: Word,
    pub cycles: u64,
    /// From this impact on it is in a neighbourhood that the period contracts.
    pub from: u64,
    /// The impacts, in time order.
    pub impacts: Vec<Passage>,
    /// Trace, determinant, and both eigenvalues, real and imaginary parts.
    pub numbers: [Bounds; 6],
    pub symmetric: Option<bool>,
    /// Whether it is claimed to be the only one in its box, physical and stable.
    pub is_attractor: bool,
}

/// An impact of it.
#[derive(Clone, Debug)]
pub(super) struct Passage {
    pub wall: Wall,
    /// Whole turns of the common period of all harmonics before the phase; 0 where it says nothing.
    pub turn: u64,
    pub phase: Bounds,
    pub velocity: Bounds,
}

/// A lower and an upper bound.
pub(super) type Bounds = [BigRational; 2];

impl Attraction {
    /// What an outcome claims, if it has an `orbit`; it stands at `place`.
    pub fn of(outcome: &OutcomeDocument, place: &Place<'_>) -> Result<Option<Self>, Error> {
        let Some(orbit) = &outcome.orbit else { return Ok(None) };
        let values = |bounds: &[Decimal; 2]| bounds.each_ref().map(Decimal::value);
        let impact = |impact: &PeriodicImpactDocument| Passage {
            wall: impact.wall,
            turn: impact.turn.map_or(0, u64::from),
            phase: values(&impact.phase),
            velocity: values(&impact.velocity),
        };
        let there = |key: &str| place.missing(&format!("orbit.{key}"));
        let [one, other] = orbit.eigenvalues.as_ref().ok_or_else(|| there("eigenvalues"))?;
        Ok(Some(Self {
            word: outcome.word.as_ref().ok_or_else(|| place.missing("word"))?.parse()?,
            cycles: outcome.cycles.ok_or_else(|| place.missing("cycles"))?.into(),
            from: outcome.from.ok_or_else(|| place.missing("from"))?,
            impacts: orbit.impacts.iter().map(impact).collect(),
            numbers: [
                values(orbit.trace.as_ref().ok_or_else(|| there("trace"))?),
                values(orbit.determinant.as_ref().ok_or_else(|| there("determinant"))?),
                values(&one.re),
                values(&one.im),
                values(&other.re),
                values(&other.im),
            ],
            symmetric: orbit.symmetric,
            is_attractor: orbit.unique && orbit.physical == Some(true) && orbit.stability == "stable",
        }))
    }
}
