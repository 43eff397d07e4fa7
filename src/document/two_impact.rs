//! The periodic JSON of two-impact motions, and the manifolds of figures 10 and 11.

use std::cmp::Ordering;

use impact_pair_certificate::document::{
    CurveDocument, EigenvalueDocument, MANIFOLD_SCHEMA, ManifoldDocument, ManifoldPointDocument, PERIODIC_SCHEMA,
    PROGRAM, PartDocument, PeriodicImpactDocument, PeriodicOrbitDocument, SceneDocument, SpacingDocument,
    TwoImpactDocument, bounds,
};

use crate::ImpactPair;
use crate::orbit::Start;
use crate::pair::Wall;
use crate::two_impact::{Answer, Axis, Manifold, Orbit, Part, Point, Unknown};

/// An answer for N `cycles`, its impacts listed from `wall`.
pub fn two_impact(
    (pair, start): (&ImpactPair, &Start),
    unknown: &Unknown,
    (cycles, answer): (u32, &Answer),
    wall: Wall,
) -> TwoImpactDocument {
    TwoImpactDocument {
        schema: PERIODIC_SCHEMA.to_owned(),
        program: PROGRAM.to_owned(),
        scene: SceneDocument::new(pair, start),
        word: word(wall).to_owned(),
        cycles,
        solved_for: unknown.name().to_owned(),
        exhaustive: answer.is_exhaustive,
        certified: true,
        undecided: answer.undecided.iter().map(|spacing| SpacingDocument { spacing: bounds(spacing) }).collect(),
        orbits: answer.orbits.iter().map(|found| orbit(found, unknown, wall)).collect(),
    }
}

/// The word of the orbit whose listed impacts begin on this wall: its first mapping, the right-most, leads to it.
///
/// Both words are the same motion.
pub fn word(wall: Wall) -> &'static str {
    match wall {
        Wall::Left => "P2 P1",
        Wall::Right => "P1 P2",
    }
}

fn orbit(orbit: &Orbit, unknown: &Unknown, wall: Wall) -> PeriodicOrbitDocument {
    let impacts = orbit.impacts_from(wall);
    let impacts = impacts.iter().map(|impact| PeriodicImpactDocument {
        wall: impact.wall,
        phase: bounds(&impact.phase),
        velocity: bounds(&impact.velocity),
        turn: None,
    });
    PeriodicOrbitDocument {
        impacts: impacts.collect(),
        unique: orbit.is_unique,
        physical: orbit.is_physical,
        symmetric: Some(orbit.is_symmetric),
        trace: Some(bounds(&orbit.trace)),
        determinant: Some(bounds(&orbit.determinant)),
        eigenvalues: Some(
            orbit.eigenvalues.each_ref().map(|[re, im]| EigenvalueDocument { re: bounds(re), im: bounds(im) }),
        ),
        stability: orbit.stability.name().to_owned(),
        spacing: Some(bounds(&orbit.spacing)),
        sine: Some(orbit.sine.map(|sine| sign(sine).to_owned())),
        amplitude: matches!(unknown, Unknown::Amplitude(_)).then(|| bounds(&orbit.amplitude)),
        gap: matches!(unknown, Unknown::Gap(_)).then(|| bounds(&orbit.gap)),
    }
}

fn sign(of: Ordering) -> &'static str {
    match of {
        Ordering::Less => "negative",
        Ordering::Equal => "zero",
        Ordering::Greater => "positive",
    }
}

/// The manifolds of one range.
pub fn manifolds((pair, start): (&ImpactPair, &Start), axis: Axis, curves: &[Manifold]) -> ManifoldDocument {
    let curve = |curve: &Manifold| CurveDocument {
        cycles: curve.cycles,
        points: curve.points.iter().map(|at| point(axis, at)).collect(),
    };
    ManifoldDocument {
        schema: MANIFOLD_SCHEMA.to_owned(),
        program: PROGRAM.to_owned(),
        scene: SceneDocument::new(pair, start),
        over: axis.name().to_owned(),
        certified: true,
        curves: curves.iter().map(curve).collect(),
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
