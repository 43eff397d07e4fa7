//! What an orbit JSON claims of the periodic orbit that its motion converges to.

use impact_pair_certificate::document::{Bounds, Decimal, OutcomeDocument, PeriodicImpactDocument, Place};
use num_rational::BigRational;

use crate::Error;
use crate::mapping::Word;
use crate::pair::Wall;

/// A stable periodic orbit that the motion is claimed to converge to.
#[derive(Clone, Debug)]
pub(super) struct Attraction {
    pub word: Word,
    pub cycles: u64,
    /// From this impact on it is in a neighbourhood that the period contracts.
    pub from: u64,
    /// Wall, phase, velocity of each impact.
    pub impacts: Vec<(Wall, [[BigRational; 2]; 2])>,
    /// Trace, determinant, and both eigenvalues, real and imaginary parts.
    pub numbers: [[BigRational; 2]; 6],
    pub symmetric: Option<bool>,
    /// Whether it is claimed to be the only one in its box, physical and stable.
    pub is_attractor: bool,
}

impl Attraction {
    /// What an outcome claims, if it has an `orbit`; it stands at `place`.
    pub fn of(outcome: &OutcomeDocument, place: &Place<'_>) -> Result<Option<Self>, Error> {
        let Some(orbit) = &outcome.orbit else { return Ok(None) };
        let values = |bounds: &Bounds| bounds.each_ref().map(Decimal::value);
        let impact = |impact: &PeriodicImpactDocument| (impact.wall, [values(&impact.phase), values(&impact.velocity)]);
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
