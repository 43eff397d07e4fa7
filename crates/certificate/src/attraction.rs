//! Claims of documents about periodic orbits, as exact fractions.

use impact_pair_document::{MeasuredImpact, OutcomeDocument, PeriodicOrbitDocument, Place};
use impact_pair_exact::Enclosure;
use impact_pair_model::vocabulary::{Sign, Stability};
use impact_pair_model::{Error, Word};
use num_bigint::BigInt;
use num_rational::BigRational;

/// Bits of the bound for the widths of phases.
const BITS: u32 = 64;

/// A stable periodic orbit that the motion is claimed to converge to.
#[derive(Clone, Debug)]
pub(super) struct Attraction {
    pub word: Word,
    pub cycles: u64,
    /// Number of the listed impact from which on the motion is in a neighbourhood that the period contracts.
    pub from: u64,
    pub orbit: ClaimedOrbit,
}

/// Claims about a periodic orbit.
#[derive(Clone, Debug)]
pub(super) struct ClaimedOrbit {
    /// The impacts, in time order.
    pub impacts: Vec<Passage>,
    /// Trace, determinant, and both eigenvalues, real and imaginary parts.
    pub numbers: Option<[Bounds; 6]>,
    pub symmetric: Option<bool>,
    /// How often the orbit runs through a shorter orbit, if that is claimed.
    pub times: Option<u32>,
    /// True if the orbit is claimed to be unique in the bounds.
    pub unique: bool,
    pub physical: Option<bool>,
    pub stability: Stability,
    /// Difference of phase from the left wall to the right one, of a two-impact motion \[rad\].
    pub spacing: Option<Bounds>,
    /// The sign of the sine on the left wall, of a two-impact motion.
    pub sine: Option<Sign>,
}

/// An impact of a periodic orbit, as claimed.
pub(super) type Passage = MeasuredImpact<Bounds>;

/// A lower and an upper bound.
pub(super) type Bounds = [BigRational; 2];

impl Attraction {
    /// The claim of an outcome that has an `orbit`; `place` is its place in the document.
    pub fn of(outcome: &OutcomeDocument, place: &Place<'_>) -> Result<Option<Self>, Error> {
        let Some(orbit) = &outcome.orbit else { return Ok(None) };
        if orbit.spacing.is_some() || orbit.sine.is_some() || orbit.amplitude.is_some() || orbit.gap.is_some() {
            return Err(place.refused("only two-impact motions have a spacing, a sine, an amplitude and a gap"));
        }
        Ok(Some(Self {
            word: outcome.word.as_ref().ok_or_else(|| place.missing("word"))?.parse()?,
            cycles: outcome.cycles.ok_or_else(|| place.missing("cycles"))?.into(),
            from: outcome.from.ok_or_else(|| place.missing("from"))?,
            orbit: ClaimedOrbit::of(orbit, &place.get("orbit")?)?,
        }))
    }

    /// Whether the orbit is claimed to be unique in its box, of its least period, admissible and stable, with all numbers. Only the
    /// symmetry may be undecided, where it is undecided whether the forcing has a mirror.
    pub fn is_attractor(&self, is_mirror_decided: bool) -> bool {
        let ClaimedOrbit { unique, physical, stability, numbers, symmetric, times, .. } = &self.orbit;
        *unique
            && *times == Some(1)
            && (symmetric.is_some() || !is_mirror_decided)
            && *physical == Some(true)
            && *stability == Stability::Stable
            && numbers.is_some()
    }
}

impl ClaimedOrbit {
    /// The claims of a document; `place` is its place in the file.
    ///
    /// # Errors
    /// Also for an orbit with its own amplitude or gap: no lemma covers these.
    pub fn of(orbit: &PeriodicOrbitDocument, place: &Place<'_>) -> Result<Self, Error> {
        if orbit.amplitude.is_some() || orbit.gap.is_some() {
            return Err(place.refused("what is solved for the amplitude or the gap is not checked"));
        }
        let values = impact_pair_document::Bounds::values;
        let numbers = match (&orbit.trace, &orbit.determinant, &orbit.eigenvalues) {
            (Some(trace), Some(determinant), Some([one, other])) => {
                Some([trace, determinant, &one.re, &one.im, &other.re, &other.im].map(values))
            }
            (None, None, None) => None,
            _ => return Err(place.refused("it has a trace, a determinant and eigenvalues, or none of them")),
        };
        if orbit.times == Some(0) {
            return Err(place.get("times")?.refused("accepted are whole numbers above 0, and null"));
        }
        // T13: in narrower bounds the forcing period is unique
        let turn = Enclosure::pi(BITS).inf().to_rational() * BigInt::from(2);
        if let Some(i) =
            orbit.impacts.iter().map(|impact| values(&impact.phase)).position(|[low, high]| high - low >= turn)
        {
            let impacts = place.get("impacts")?.list()?;
            return Err(impacts[i].get("phase")?.refused("accepted are bounds less than 2 pi apart"));
        }
        Ok(Self {
            impacts: orbit.impacts.iter().map(|impact| impact.map(values)).collect(),
            numbers,
            symmetric: orbit.symmetric,
            times: orbit.times,
            unique: orbit.unique,
            physical: orbit.physical,
            stability: orbit.stability,
            spacing: orbit.spacing.as_ref().map(values),
            sine: orbit.sine.flatten(),
        })
    }

    /// Whether no requested property is undecided.
    pub fn is_decided(&self) -> bool {
        self.physical.is_some()
            && self.symmetric.is_some()
            && self.times.is_some()
            && self.stability != Stability::Undecided
    }
}
