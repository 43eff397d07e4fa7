//! What an orbit JSON claims of the periodic orbit that its motion converges to.

use num_rational::BigRational;
use serde_json::Value;

use super::read::Entry;
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
    /// The claim of an outcome that has an `orbit`.
    pub fn read(outcome: &Entry<'_>, orbit: &Entry<'_>) -> Result<Self, Error> {
        let impact = |impact: &Entry<'_>| {
            let turn = impact.find("turn")?.map_or(Ok(0), |turn| turn.integer())?;
            let (wall, phase) = (impact.get("wall")?.wall()?, impact.get("phase")?.bounds()?);
            Ok(Passage { wall, turn, phase, velocity: impact.get("velocity")?.bounds()? })
        };
        let eigenvalues = orbit.get("eigenvalues")?;
        let [one, other] = eigenvalues.list()?.try_into().map_err(|_| eigenvalues.refused("must be two"))?;
        let is_true = |key| Ok::<_, Error>(orbit.get(key)?.value == &Value::Bool(true));
        Ok(Self {
            word: outcome.get("word")?.text()?.parse()?,
            cycles: outcome.get("cycles")?.integer()?,
            from: outcome.get("from")?.integer()?,
            impacts: orbit.get("impacts")?.list()?.iter().map(impact).collect::<Result<_, Error>>()?,
            numbers: [
                orbit.get("trace")?.bounds()?,
                orbit.get("determinant")?.bounds()?,
                one.get("re")?.bounds()?,
                one.get("im")?.bounds()?,
                other.get("re")?.bounds()?,
                other.get("im")?.bounds()?,
            ],
            symmetric: orbit.get("symmetric")?.value.as_bool(),
            is_attractor: is_true("unique")? && is_true("physical")? && orbit.get("stability")?.text()? == "stable",
        })
    }
}
