//! The JSON of all cycles, read back: its orbits and their claimed number.

use std::collections::BTreeMap;

use impact_pair_model::vocabulary::Stability;
use serde_json::Value;

use super::marks::{self, Mark};
use crate::periodic::OrbitOf;
use crate::periodic::PeriodicCertificate;
use impact_pair_document::{CYCLES_SCHEMA, CyclesDocument, Place};
use impact_pair_model::Error;

/// The claims of a JSON of all cycles.
#[derive(Clone, Debug)]
pub(crate) struct CyclesCertificate {
    pub(super) orbits: PeriodicCertificate,
    pub(super) contradiction: Option<String>,
}

impl CyclesCertificate {
    /// Reads the JSON of all cycles: its orbits and whether its counts fit them.
    pub(super) fn read(values: &[Value]) -> Result<(Self, Mark), Error> {
        let whole = Place::alone_of_schema(values, CYCLES_SCHEMA)?;
        let document: CyclesDocument = whole.read()?;
        let orbits = PeriodicCertificate::of_cycles(&whole, &document)?;
        let contradiction = contradiction(&document, &orbits.orbits);
        Ok((Self { orbits, contradiction }, marks::cycles(&document)))
    }

    /// Number of claimed cycles.
    pub fn count(&self) -> usize {
        self.orbits.count()
    }
}

/// Whether an orbit of `impacts` impacts, not a repeated shorter orbit, may have the least period `claimed` under the reduced map.
///
/// Lemma D23: an orbit that is its own mirror image is mapped to it after half of its impacts.
pub(super) fn is_reduced_period(claimed: u32, impacts: usize, symmetric: Option<bool>) -> bool {
    let (claimed, impacts) = (u64::from(claimed), impacts as u64); // exact: a length
    let is_least = match symmetric {
        Some(true) => 2 * claimed == impacts,
        Some(false) => claimed == impacts,
        None => claimed == impacts || 2 * claimed == impacts,
    };
    claimed > 0 && is_least
}

/// A statement of the document that its own fields contradict.
///
/// Lemma D23: the fixed points of `n` impacts belong to the cycles whose least number of impacts divides `n`, one fixed point for each
/// impact of the cycle. So a document with a count lists all these cycles, also those of fewer impacts.
fn contradiction(document: &CyclesDocument, orbits: &[OrbitOf]) -> Option<String> {
    let CyclesDocument { certified, exhaustive, impacts, fixed_points, no_attractor, .. } = document;
    let [least, most] = **impacts;
    if *certified && !exhaustive {
        return Some("certified: by its own statement there may be others".to_owned());
    }
    if *exhaustive && (least..=most).any(|impacts| !fixed_points.contains_key(&impacts)) {
        return Some("exhaustive: the fixed points of some number of impacts are not counted".to_owned());
    }
    let attracts = |orbit: &OrbitOf| orbit.orbit.stability != Stability::Unstable;
    if *no_attractor && (!exhaustive || orbits.iter().any(attracts)) {
        return Some("no_attractor: a cycle is not unstable, or there may be others".to_owned());
    }
    for (i, (cycle, orbit)) in document.orbits.iter().zip(orbits).enumerate() {
        if !is_reduced_period(cycle.reduced_impacts, orbit.orbit.impacts.len(), orbit.orbit.symmetric) {
            return Some(format!("orbits[{i}].reduced_impacts: contradicts its impacts and its symmetry"));
        }
        if orbit.orbit.physical == Some(false) {
            return Some(format!("orbits[{i}].physical: a cycle of the map has first contacts alone"));
        }
    }
    let mut by_impacts: BTreeMap<u32, u64> = BTreeMap::new();
    for (cycle, orbit) in document.orbits.iter().zip(orbits) {
        if orbit.orbit.physical == Some(true) {
            *by_impacts.entry(cycle.reduced_impacts).or_default() += u64::from(cycle.reduced_impacts);
        }
    }
    let listed = |impacts: u32| {
        by_impacts.iter().filter(|(least, _)| impacts.is_multiple_of(**least)).map(|(_, n)| n).sum::<u64>()
    };
    let wrong = fixed_points.iter().find(|(impacts, claimed)| **impacts == 0 || listed(**impacts) != **claimed)?;
    let (impacts, claimed) = wrong;
    Some(format!(
        "fixed_points: {claimed} of {impacts} impacts, but those of the listed orbits are {}",
        listed(*impacts)
    ))
}
