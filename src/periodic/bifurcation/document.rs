//! The bifurcation JSON: proved bifurcations over a parameter in the units of the scene.

use impact_pair_document::{
    BIFURCATION_SCHEMA, BifurcationDocument, BifurcationPointDocument, BranchDocument, PROGRAM, PeriodicOrbitDocument,
    SceneDocument, UnprovedDocument, bounds,
};
use impact_pair_model::Start;

use super::{Branch, Diagram, Point, Unproved};
use crate::Error;
use crate::mapping::Word;
use crate::periodic::document::periodic_orbit;
use crate::units::Units;

impl Diagram {
    /// Returns the document of the bifurcations of a word's orbits; the parameter's own value in the pair, and `start`, only name the scene.
    ///
    /// # Errors
    /// If a value exceeds the range of exact expressions.
    pub fn document(&self, start: &Start, (word, cycles): (&Word, u32)) -> Result<BifurcationDocument, Error> {
        Ok(BifurcationDocument {
            schema: BIFURCATION_SCHEMA.to_owned(),
            program: PROGRAM.to_owned(),
            scene: SceneDocument::new(self.pair(), start),
            word: word.to_string(),
            cycles,
            over: self.over().into(),
            exhaustive: false,
            certified: self.is_certified(),
            interrupted: self.interrupted,
            points: self.points.iter().map(|found| point(found, self)).collect::<Result<_, _>>()?,
            branches: self.branches.iter().map(|followed| branch(followed, self)).collect(),
            undecided: self.unproved.iter().map(|open| unproved(open, self)).collect(),
        })
    }
}

fn point(point: &Point, diagram: &Diagram) -> Result<BifurcationPointDocument, Error> {
    let (parameter, pair) = diagram.in_units(point)?;
    let units = Units::gaps(&pair)?;
    let orbit = match &point.orbit {
        Some(orbit) => periodic_orbit(&units.measured(orbit)),
        // The Jacobian of an orbit with a graze has no bound.
        None => PeriodicOrbitDocument {
            impacts: point.impacts.iter().map(|impact| units.impact(impact, (point.bits, point.period))).collect(),
            unique: true,
            symmetric: point.symmetric,
            times: Some(1),
            ..PeriodicOrbitDocument::default()
        },
    };
    Ok(BifurcationPointDocument {
        kind: point.kind,
        parameter: bounds(&parameter),
        word: point.word.to_string(),
        cycles: point.cycles,
        doublings: point.doublings,
        orbit,
    })
}

fn branch(branch: &Branch, diagram: &Diagram) -> BranchDocument {
    BranchDocument {
        word: branch.word.to_string(),
        cycles: branch.cycles,
        symmetric: branch.symmetric,
        parameter: diagram.range_f64(branch.range),
        ends: branch.ends,
        proved: branch.is_proved,
    }
}

fn unproved(unproved: &Unproved, diagram: &Diagram) -> UnprovedDocument {
    let [near, _] = diagram.range_f64([unproved.near; 2]);
    UnprovedDocument { kind: unproved.kind, near, word: unproved.word.to_string() }
}
