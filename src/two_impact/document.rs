//! The periodic JSON of two-impact motions, and the manifolds of figures 10 and 11.

use std::cmp::Ordering;

use impact_pair_document::{
    CurveDocument, MANIFOLD_SCHEMA, ManifoldDocument, ManifoldPointDocument, PERIODIC_SCHEMA, PROGRAM, PartDocument,
    PeriodicOrbitDocument, RESTING, SceneDocument, SpacingDocument, TwoImpactDocument, bounds,
};
use impact_pair_model::Start;

use super::{Answer, Axis, Manifold, Orbit, Part, Point, Range, Unknown};
use crate::pair::Wall;
use crate::periodic::document::periodic_orbit;

impl Answer {
    /// Returns the document of this answer, its impacts listed from `wall`; `start` only names the scene.
    pub fn document(&self, start: &Start, wall: Wall) -> TwoImpactDocument {
        let problem = self.problem();
        let unknown = problem.unknown();
        TwoImpactDocument {
            schema: PERIODIC_SCHEMA.to_owned(),
            program: PROGRAM.to_owned(),
            scene: SceneDocument::new(problem.pair(), start),
            word: word(wall).to_owned(),
            cycles: problem.cycles(),
            solved_for: unknown.name().to_owned(),
            exhaustive: self.is_exhaustive,
            excludes: self.is_exhaustive.then(|| RESTING.to_owned()),
            certified: self.is_complete,
            undecided: self.undecided.iter().map(|spacing| SpacingDocument { spacing: bounds(spacing) }).collect(),
            orbits: self.orbits.iter().map(|found| orbit(found, unknown, wall)).collect(),
        }
    }
}

/// Returns the word of the orbit whose listed impacts begin on this wall: its first mapping, the right-most, starts there.
///
/// Both words are the same motion.
pub fn word(wall: Wall) -> &'static str {
    match wall {
        Wall::Left => "P1 P2",
        Wall::Right => "P2 P1",
    }
}

fn orbit(orbit: &Orbit, unknown: &Unknown, wall: Wall) -> PeriodicOrbitDocument {
    PeriodicOrbitDocument {
        spacing: Some(bounds(&orbit.spacing)),
        sine: Some(orbit.sine.map(|sine| sign(sine).to_owned())),
        amplitude: matches!(unknown, Unknown::Amplitude(_)).then(|| bounds(&orbit.amplitude)),
        gap: matches!(unknown, Unknown::Gap(_)).then(|| bounds(&orbit.gap)),
        ..periodic_orbit(&orbit.measured.listed_from(wall))
    }
}

fn sign(of: Ordering) -> &'static str {
    match of {
        Ordering::Less => "negative",
        Ordering::Equal => "zero",
        Ordering::Greater => "positive",
    }
}

impl Range<'_> {
    /// Returns the document of the parameter manifolds over this range, possibly `interrupted`; `start` only names the scene.
    pub fn document(&self, start: &Start, curves: &[Manifold], interrupted: bool) -> ManifoldDocument {
        let axis = self.axis;
        let curve = |curve: &Manifold| CurveDocument {
            cycles: curve.cycles,
            points: curve.points.iter().map(|at| point(axis, at)).collect(),
        };
        ManifoldDocument {
            schema: MANIFOLD_SCHEMA.to_owned(),
            program: PROGRAM.to_owned(),
            scene: SceneDocument::new(self.pair, start),
            over: axis.name().to_owned(),
            certified: !interrupted,
            interrupted,
            curves: curves.iter().map(curve).collect(),
        }
    }
}

fn point(axis: Axis, point: &Point) -> ManifoldPointDocument {
    let after = point.after.map(|Part { is_solid, is_physical, stability }| PartDocument {
        sine: sign(if is_solid { Ordering::Greater } else { Ordering::Less }).to_owned(),
        physical: is_physical,
        stability: stability.name().to_owned(),
    });
    let at = bounds(&point.at);
    let (frequency, velocity) = match axis {
        Axis::Frequency => (Some(at), None),
        Axis::Velocity(_) => (None, Some(at)),
    };
    let mark = point.mark.map(|mark| mark.name().to_owned());
    ManifoldPointDocument { frequency, velocity, amplitude: bounds(&point.amplitude), mark, after }
}
