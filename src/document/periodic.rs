//! The periodic JSON: proved periodic orbits in the units of the scene.

use impact_pair_certificate::document::{
    EigenvalueDocument, PERIODIC_SCHEMA, PeriodicDocument, PeriodicImpactDocument, PeriodicOrbitDocument,
    RegionDocument, SceneDocument, bounds,
};

use crate::exact::{Enclosure, Exact};
use crate::mapping::Word;
use crate::orbit::Start;
use crate::pair::{ImpactPair, within};
use crate::periodic::{Census, Eigenvalue, PeriodicImpact, PeriodicOrbit, Region};
use crate::{Error, turns};

/// The units that periodic orbits are told in: those of a pair.
#[derive(Clone, Debug)]
pub struct Units {
    /// `W d / (2 pi)`
    speed: Exact,
}

impl Units {
    /// The units of `pair`.
    ///
    /// # Errors
    /// When `W d` is beyond what exact expressions hold.
    pub fn new(pair: &ImpactPair) -> Result<Self, Error> {
        let turn = Exact::pi() * Exact::from(2);
        let speed = pair
            .excitation()
            .reference()
            .frequency()
            .checked_mul(pair.gap())
            .and_then(|speed| speed.checked_div(&turn));
        Ok(Self { speed: within("pair.gap", pair.gap(), speed)? })
    }

    /// A velocity \[length/time\] given in gaps a turn.
    pub fn velocity(&self, velocity: &Enclosure, bits: u32) -> Enclosure {
        velocity.mul(&self.speed.enclose(bits + 64), bits + 64)
    }

    /// The document of what is found of a word of `pair`; `start` only names the scene.
    pub fn document(
        &self,
        (pair, start): (&ImpactPair, &Start),
        (word, cycles): (&Word, u32),
        census: &Census,
    ) -> PeriodicDocument {
        let region = |region: &Region| RegionDocument {
            impacts: region.impacts.iter().map(|impact| self.impact(impact, f64::MANTISSA_DIGITS)).collect(),
            reason: region.reason.name().to_owned(),
        };
        let undecided = census.undecided.iter().map(region).collect();
        PeriodicDocument {
            schema: PERIODIC_SCHEMA.to_owned(),
            scene: SceneDocument::new(pair, start),
            word: word.to_string(),
            cycles,
            exhaustive: census.exhaustive,
            certified: census.is_certified(),
            orbits: census.orbits.iter().map(|orbit| self.orbit(orbit)).collect(),
            undecided: (!census.undecided.is_empty()).then_some(undecided),
        }
    }

    /// An impact of a search or of a bifurcation: under one harmonic.
    pub(super) fn impact(&self, impact: &PeriodicImpact, bits: u32) -> PeriodicImpactDocument {
        periodic_impact(impact, bits, 1, |velocity| self.velocity(velocity, bits))
    }

    pub(super) fn orbit(&self, orbit: &PeriodicOrbit) -> PeriodicOrbitDocument {
        periodic_orbit(orbit, |velocity| self.velocity(velocity, orbit.bits))
    }
}

fn periodic_impact(
    impact: &PeriodicImpact,
    bits: u32,
    period: u32,
    velocity: impl Fn(&Enclosure) -> Enclosure,
) -> PeriodicImpactDocument {
    PeriodicImpactDocument {
        wall: impact.wall,
        phase: bounds(&turns::in_radians(&impact.phase, bits)),
        velocity: bounds(&velocity(&impact.velocity)),
        turn: (period > 1).then(|| turns::in_period(&impact.phase, period)),
    }
}

/// A periodic orbit, its velocities in the units that `velocity` turns gaps a turn into.
pub(super) fn periodic_orbit(
    orbit: &PeriodicOrbit,
    velocity: impl Fn(&Enclosure) -> Enclosure,
) -> PeriodicOrbitDocument {
    let eigenvalue = |value: &Eigenvalue| EigenvalueDocument { re: bounds(&value.re), im: bounds(&value.im) };
    let impact = |impact: &PeriodicImpact| periodic_impact(impact, orbit.bits, orbit.period, &velocity);
    PeriodicOrbitDocument {
        impacts: orbit.impacts.iter().map(impact).collect(),
        // A box that is not proved to hold exactly one orbit is not listed.
        unique: true,
        physical: orbit.physical,
        symmetric: orbit.symmetric,
        trace: Some(bounds(&orbit.trace)),
        determinant: Some(bounds(&orbit.determinant)),
        eigenvalues: Some(orbit.eigenvalues.each_ref().map(eigenvalue)),
        stability: orbit.stability.name().to_owned(),
        spacing: None,
        sine: None,
        amplitude: None,
        gap: None,
    }
}
