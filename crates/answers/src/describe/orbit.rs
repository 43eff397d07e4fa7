//! The certified orbit of a description: as few impacts as decide its fate.

use impact_pair::json::{FateName, OrbitDocument};

use impact_pair::json::vocabulary::OutcomeKind;

use super::DescribeOptions;
use impact_pair::lyapunov::{Disturbance, Exponent, limit};
use impact_pair::orbit::{Arithmetic, Orbit, Outcome, Settings};
use impact_pair::watch::Latched;
use impact_pair::{Error, Scene};

/// Impacts that are followed first, and the factor from one attempt to the next.
const FIRST_IMPACTS: u64 = 32;
const GROWTH_FACTOR: u64 = 4;
/// Factor by which more impacts are followed in double precision: a motion that converges slowly costs little there.
const DOUBLES_FACTOR: u64 = 10;

/// An orbit, followed as far as its fate requires.
#[derive(Debug)]
pub(super) struct Followed {
    /// Events and outcome of the orbit.
    pub document: OrbitDocument,
    /// The finite-time exponent over its impacts.
    pub exponent: Exponent,
    /// Bounds of the exponent in the limit, of an attracted orbit.
    pub limit: Option<[f64; 2]>,
}

impl Followed {
    /// The fate that the outcome proves, if any.
    pub fn decides(&self) -> Option<FateName> {
        FateName::of_outcome(self.document.outcome.kind)
    }

    /// Number of certified impacts.
    pub fn impacts(&self) -> u64 {
        self.document.outcome.impacts.unwrap_or_default()
    }

    fn of(scene: &Scene, settings: Settings, watch: &Latched<'_>) -> Result<Self, Error> {
        let mut orbit = Orbit::of(scene, settings)?;
        let mut disturbance = Disturbance::of(&orbit);
        let document = orbit.document_within(watch, |orbit, event| disturbance.follow(orbit, event));
        let exponent = disturbance.exponent();
        let limit = match orbit.outcome() {
            Some(Outcome::Attracted(attractor)) => limit(&attractor.orbit, disturbance.passed()),
            _ => None,
        };
        Ok(Self { document, exponent, limit })
    }
}

/// Follows the orbit until its outcome decides the fate, for at most the requested impacts, and in double precision for ten times as many.
pub(super) fn followed(scene: &Scene, request: &DescribeOptions, watch: &Latched<'_>) -> Result<Followed, Error> {
    let DescribeOptions { impacts: most, max_bits, .. } = *request;
    let settings = |arithmetic: Arithmetic, impacts: u64| Settings {
        impacts: Some(impacts),
        arithmetic,
        max_bits,
        attractor: true,
        ..Settings::default()
    };
    let mut impacts = FIRST_IMPACTS.min(most);
    let found = loop {
        let found = Followed::of(scene, settings(Arithmetic::Auto, impacts), watch)?;
        let is_open = found.document.outcome.kind == OutcomeKind::ImpactsReached;
        if !is_open || impacts >= most || watch.is_stopped() {
            break found;
        }
        impacts = impacts.saturating_mul(GROWTH_FACTOR).min(most);
    };
    if found.decides().is_some() || watch.is_stopped() {
        return Ok(found);
    }
    let longer = Followed::of(scene, settings(Arithmetic::Interval, most.saturating_mul(DOUBLES_FACTOR)), watch)?;
    Ok(if longer.decides().is_some() { longer } else { found })
}
