//! The bifurcation JSON: proved bifurcations over a parameter in the units of the scene.

use impact_pair_certificate::document::{
    BIFURCATION_SCHEMA, BifurcationDocument, BifurcationPointDocument, BranchDocument, PROGRAM, ParameterRange,
    PeriodicOrbitDocument, SceneDocument, UnprovedDocument, bounds,
};

use super::periodic::Units;
use crate::mapping::Word;
use crate::orbit::Start;
use crate::periodic::bifurcation::{Branch, Diagram, End, Over, Point, Unproved};
use crate::{Error, ImpactPair};

/// Bifurcations of a word's orbits over a parameter; its own value in `pair`, and `start`, only name the scene.
///
/// # Errors
/// When a value is beyond what exact expressions hold.
pub fn bifurcations(
    (pair, start): (&ImpactPair, &Start),
    (word, cycles): (&Word, u32),
    over: &Over,
    diagram: &Diagram,
) -> Result<BifurcationDocument, Error> {
    Ok(BifurcationDocument {
        schema: BIFURCATION_SCHEMA.to_owned(),
        program: PROGRAM.to_owned(),
        scene: SceneDocument::new(pair, start),
        word: word.to_string(),
        cycles,
        over: ParameterRange { key: over.key.name().to_owned(), low: (&over.low).into(), high: (&over.high).into() },
        exhaustive: false,
        certified: diagram.is_certified(),
        points: diagram.points.iter().map(|found| point(found, over, pair)).collect::<Result<_, _>>()?,
        branches: diagram.branches.iter().map(|followed| branch(followed, over, pair)).collect(),
        undecided: diagram.unproved.iter().map(|open| unproved(open, over, pair)).collect(),
    })
}

fn point(point: &Point, over: &Over, pair: &ImpactPair) -> Result<BifurcationPointDocument, Error> {
    let (parameter, pair) = point.in_units(over, pair)?;
    let units = Units::new(&pair)?;
    let orbit = match &point.orbit {
        Some(orbit) => units.orbit(orbit),
        // Where an impact is the graze the Jacobian has no bound.
        None => PeriodicOrbitDocument {
            impacts: point.impacts.iter().map(|impact| units.impact(impact, point.bits)).collect(),
            unique: true,
            physical: None,
            symmetric: point.symmetric,
            trace: None,
            determinant: None,
            eigenvalues: None,
            stability: "undecided".to_owned(),
            spacing: None,
            sine: None,
            amplitude: None,
            gap: None,
        },
    };
    Ok(BifurcationPointDocument {
        kind: point.kind.name().to_owned(),
        parameter: bounds(&parameter),
        word: point.word.to_string(),
        cycles: point.cycles,
        doublings: point.doublings,
        orbit,
    })
}

fn branch(branch: &Branch, over: &Over, pair: &ImpactPair) -> BranchDocument {
    let end = |end: End| match end {
        End::Range => "range",
        End::At(kind) => kind.name(),
        End::Closed => "closed",
        End::Lost => "lost",
    };
    BranchDocument {
        word: branch.word.to_string(),
        cycles: branch.cycles,
        symmetric: branch.symmetric,
        parameter: over.range_f64(pair, branch.range),
        ends: branch.ends.map(|reached| end(reached).to_owned()),
        proved: branch.is_proved,
    }
}

fn unproved(unproved: &Unproved, over: &Over, pair: &ImpactPair) -> UnprovedDocument {
    let [near, _] = over.range_f64(pair, [unproved.near; 2]);
    UnprovedDocument { kind: unproved.kind.name().to_owned(), near, word: unproved.word.to_string() }
}
