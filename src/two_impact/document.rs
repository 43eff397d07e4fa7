//! The periodic JSON of two-impact motions, and the manifolds of figures 10 and 11.

use std::cmp::Ordering;

use impact_pair_document::{
    CurveDocument, MANIFOLD_SCHEMA, ManifoldDocument, ManifoldPointDocument, PERIODIC_SCHEMA, PROGRAM, PartDocument,
    PeriodicOrbitDocument, SceneDocument, SpacingDocument, TwoImpactDocument, bounds,
};
use impact_pair_model::Start;
use impact_pair_model::vocabulary::Excludes;
use impact_pair_model::vocabulary::Sign;

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
            solved_for: unknown.kind(),
            exhaustive: self.is_exhaustive,
            excludes: self.is_exhaustive.then_some(Excludes::Resting),
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
        sine: Some(orbit.sine.map(sign)),
        amplitude: matches!(unknown, Unknown::Amplitude(_)).then(|| bounds(&orbit.amplitude)),
        gap: matches!(unknown, Unknown::Gap(_)).then(|| bounds(&orbit.gap)),
        ..periodic_orbit(&orbit.measured.listed_from(wall))
    }
}

fn sign(of: Ordering) -> Sign {
    match of {
        Ordering::Less => Sign::Negative,
        Ordering::Equal => Sign::Zero,
        Ordering::Greater => Sign::Positive,
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
            over: axis.kind(),
            certified: !interrupted,
            interrupted,
            curves: curves.iter().map(curve).collect(),
        }
    }
}

fn point(axis: Axis, point: &Point) -> ManifoldPointDocument {
    let after = point.after.map(|Part { is_solid, is_physical, stability }| PartDocument {
        sine: sign(if is_solid { Ordering::Greater } else { Ordering::Less }),
        physical: is_physical,
        stability,
    });
    let at = bounds(&point.at);
    let (frequency, velocity) = match axis {
        Axis::Frequency => (Some(at), None),
        Axis::Velocity(_) => (None, Some(at)),
    };
    let mark = point.mark;
    ManifoldPointDocument { frequency, velocity, amplitude: bounds(&point.amplitude), mark, after }
}
