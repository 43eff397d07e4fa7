//! The bifurcation JSON: proved bifurcations over a parameter in the units of the scene.

use serde_json::{Map, Value, json};

use super::document::scene;
use super::periodic::{PeriodicDocument, orbit_json};
use crate::error::Error;
use crate::exact::decimal_bounds;
use crate::mapping::Word;
use crate::orbit::Start;
use crate::periodic::bifurcation::{Branch, Diagram, End, Over, Point, Unproved};

/// The schema of the bifurcation JSON.
pub const BIFURCATION_SCHEMA: &str = "impact-pair/bifurcations/1";

/// Bifurcations of a word's orbits over a parameter as they are handed on.
#[derive(Clone, Debug)]
pub struct BifurcationDocument<'d> {
    /// The start: it only names the scene.
    pub start: &'d Start,
    /// The word asked for.
    pub word: &'d Word,
    /// Its cycles.
    pub cycles: u32,
}

impl BifurcationDocument<'_> {
    /// The document of what is found.
    ///
    /// # Errors
    /// When a value is beyond what exact expressions hold.
    pub fn json(&self, diagram: &Diagram) -> Result<Value, Error> {
        let points = diagram.points.iter().map(|point| self.point(diagram, point)).collect::<Result<Vec<_>, _>>()?;
        let Over { key, low, high } = diagram.over();
        let entries = [
            ("schema", json!(BIFURCATION_SCHEMA)),
            ("program", json!(super::PROGRAM)),
            ("scene", scene(diagram.pair(), self.start)),
            ("word", json!(self.word.to_string())),
            ("cycles", json!(self.cycles)),
            ("over", json!({"key": key.name(), "low": low.text(), "high": high.text()})),
            // Each point is proved; that there are no others is not.
            ("exhaustive", json!(false)),
            ("certified", json!(diagram.is_certified())),
            ("points", json!(points)),
            ("branches", diagram.branches.iter().map(|branch| branch_json(diagram, branch)).collect()),
            ("undecided", diagram.unproved.iter().map(|unproved| unproved_json(diagram, unproved)).collect()),
        ];
        Ok(Value::Object(entries.into_iter().map(|(key, value)| (key.to_owned(), value)).collect::<Map<_, _>>()))
    }

    fn point(&self, diagram: &Diagram, point: &Point) -> Result<Value, Error> {
        let (parameter, pair) = diagram.in_units(point)?;
        let document = PeriodicDocument::new(&pair, self.start, &point.word, point.cycles)?;
        let orbit = match &point.orbit {
            Some(orbit) => orbit_json(&document.measured(orbit)),
            // Where an impact is the graze the Jacobian has no bound.
            None => json!({
                "impacts": point.impacts.iter().map(|impact| document.impact(impact, point.bits)).collect::<Value>(),
                "unique": true, "physical": null, "symmetric": point.symmetric, "trace": null, "determinant": null,
                "eigenvalues": null, "stability": "undecided",
            }),
        };
        Ok(json!({
            "kind": point.kind.name(),
            "parameter": decimal_bounds(&parameter),
            "word": point.word.to_string(),
            "cycles": point.cycles,
            "doublings": point.doublings,
            "orbit": orbit,
        }))
    }
}

/// A branch as it was followed: certified is no more of it than that it is one curve, if `proved`.
fn branch_json(diagram: &Diagram, branch: &Branch) -> Value {
    let end = |end: End| match end {
        End::Range => "range",
        End::At(kind) => kind.name(),
        End::Closed => "closed",
        End::Lost => "lost",
    };
    json!({
        "word": branch.word.to_string(),
        "cycles": branch.cycles,
        "symmetric": branch.symmetric,
        "parameter": diagram.range_f64(branch.range),
        "ends": branch.ends.map(end),
        "proved": branch.is_proved,
    })
}

fn unproved_json(diagram: &Diagram, unproved: &Unproved) -> Value {
    let [near, _] = diagram.range_f64([unproved.near; 2]);
    json!({"kind": unproved.kind.name(), "near": near, "word": unproved.word.to_string()})
}
