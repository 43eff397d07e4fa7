//! The periodic JSON: proved periodic orbits in the units of the scene.

use impact_pair_document::{
    EigenvalueDocument, MeasuredImpact, PERIODIC_SCHEMA, PeriodicDocument, PeriodicOrbitDocument, RegionDocument,
    SceneDocument, bounds,
};
use impact_pair_model::Start;
use impact_pair_model::vocabulary::Excludes;

use super::{Census, Eigenvalue, MeasuredOrbit, PeriodicImpact, PeriodicOrbit, Problem, Region};
use crate::exact::{Enclosure, Exact};
use crate::turns;
use crate::units::{Units, in_radians};

/// Periodic orbits, found in gaps and gap widths per forcing period, in the units of the scene.
impl Units<Exact> {
    /// Returns an orbit.
    pub fn measured(&self, orbit: &PeriodicOrbit) -> MeasuredOrbit {
        measured(orbit, |velocity| self.velocity(velocity, orbit.bits))
    }

    /// Returns the document of the orbits of a problem; `start` only names the scene.
    pub fn document(&self, problem: &Problem, start: &Start, census: &Census) -> PeriodicDocument {
        let region = |region: &Region| {
            let impact = |impact: &PeriodicImpact| self.impact(impact, (f64::MANTISSA_DIGITS, problem.period()));
            RegionDocument {
                impacts: counted(problem, &region.impacts, region.impacts.iter().map(impact).collect()),
                reason: region.reason,
            }
        };
        let undecided = census.undecided.iter().map(region).collect();
        PeriodicDocument {
            schema: PERIODIC_SCHEMA.to_owned(),
            scene: SceneDocument::new(problem.pair(), start),
            word: problem.word().to_string(),
            cycles: problem.chain().cycles(),
            exhaustive: census.exhaustive,
            excludes: census.exhaustive.then_some(Excludes::Resting),
            certified: census.is_certified(),
            orbits: census.orbits.iter().map(|orbit| self.orbit(problem, orbit)).collect(),
            undecided: (!census.undecided.is_empty()).then_some(undecided),
            witness: None,
        }
    }

    /// An orbit of a problem.
    pub(crate) fn orbit(&self, problem: &Problem, orbit: &PeriodicOrbit) -> PeriodicOrbitDocument {
        let document = periodic_orbit(&self.measured(orbit));
        PeriodicOrbitDocument { impacts: counted(problem, &orbit.impacts, document.impacts), ..document }
    }

    /// An impact of a search or of a bifurcation, in N bits and forcing periods of the common period.
    pub(crate) fn impact(&self, impact: &PeriodicImpact, (bits, period): (u32, u32)) -> MeasuredImpact {
        measured_impact(impact, (bits, period), |velocity| self.velocity(velocity, bits)).map(bounds)
    }
}

/// Impacts with their forcing periods, counted from that of the first one, where the period of the orbit is several common periods: flights that
/// differ by whole common periods differ in nothing else. Lemma T13
fn counted(problem: &Problem, impacts: &[PeriodicImpact], mut listed: Vec<MeasuredImpact>) -> Vec<MeasuredImpact> {
    if problem.chain().cycles() > problem.period() {
        let cycles = impacts.iter().map(|impact| impact.cycle() - impacts[0].cycle());
        listed.iter_mut().zip(cycles).for_each(|(impact, cycle)| impact.cycle = Some(cycle));
    }
    listed
}

/// An orbit in the units that `velocity` forcing periods gap widths per forcing period into.
pub(crate) fn measured(orbit: &PeriodicOrbit, velocity: impl Fn(&Enclosure) -> Enclosure) -> MeasuredOrbit {
    let impact = |impact: &PeriodicImpact| measured_impact(impact, (orbit.bits, orbit.period), &velocity);
    MeasuredOrbit {
        period: orbit.period,
        impacts: orbit.impacts.iter().map(impact).collect(),
        // A box that is not proved to hold exactly one orbit is not listed.
        unique: true,
        physical: orbit.physical,
        symmetric: orbit.symmetric,
        times: orbit.repeats.map(|times| times as u32), // exact: at most as many as impacts
        trace: orbit.trace.clone(),
        determinant: orbit.determinant.clone(),
        eigenvalues: orbit.eigenvalues.clone(),
        stability: orbit.stability,
    }
}

fn measured_impact(
    impact: &PeriodicImpact,
    (bits, period): (u32, u32),
    velocity: impl Fn(&Enclosure) -> Enclosure,
) -> MeasuredImpact<Enclosure> {
    MeasuredImpact {
        wall: impact.wall,
        phase: in_radians(&impact.phase, bits),
        velocity: velocity(&impact.velocity),
        turn: (period > 1).then(|| turns::in_period(&impact.phase, period)),
        cycle: None,
    }
}

/// A periodic orbit; what only two-impact motions have is left out.
pub(crate) fn periodic_orbit(orbit: &MeasuredOrbit) -> PeriodicOrbitDocument {
    let eigenvalue = |value: &Eigenvalue| EigenvalueDocument { re: bounds(&value.re), im: bounds(&value.im) };
    PeriodicOrbitDocument {
        impacts: orbit.impacts.iter().map(|impact| impact.map(bounds)).collect(),
        unique: orbit.unique,
        physical: orbit.physical,
        symmetric: orbit.symmetric,
        times: orbit.times,
        trace: Some(bounds(&orbit.trace)),
        determinant: Some(bounds(&orbit.determinant)),
        eigenvalues: Some(orbit.eigenvalues.each_ref().map(eigenvalue)),
        stability: orbit.stability,
        ..PeriodicOrbitDocument::default()
    }
}
