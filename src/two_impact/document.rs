//! The periodic JSON of two-impact motions, schema `impact-pair/periodic/1`, and that of the manifolds.
//!
//! Bounds are decimal strings rounded outward. Beyond the words of the schema an orbit has its `spacing` `th1 - th0` from left to
//! right \[rad\], the sign of `sin th0` on the left wall as `sine`, and what was solved for, `amplitude` or `gap`; `undecided` lists
//! the spacings at which there may be other orbits.

use std::cmp::Ordering;

use serde_json::{Map, Value, json};

use crate::certificate::{PERIODIC_SCHEMA, PROGRAM, orbit_json, scene};
use crate::exact::decimal_bounds;
use crate::orbit::Start;
use crate::pair::Wall;

use super::manifold::{Axis, Manifold, Part, Point, Range};
use super::orbit::Orbit;
use super::question::{Answer, Unknown};

/// The schema of the manifolds.
pub const MANIFOLD_SCHEMA: &str = "impact-pair/manifold/1";

/// The periodic JSON of an answer, its impacts listed from `wall`, an orbit a line; `start` only names the scene.
pub fn periodic(start: &Start, answer: &Answer, wall: Wall) -> String {
    let question = answer.question();
    let unknown = question.unknown();
    let orbits: Vec<String> = answer.orbits.iter().map(|found| orbit(found, unknown, wall).to_string()).collect();
    let undecided: Value = answer.undecided.iter().map(|spacing| json!({"spacing": decimal_bounds(spacing)})).collect();
    let head = [
        ("schema", json!(PERIODIC_SCHEMA)),
        ("program", json!(PROGRAM)),
        ("scene", scene(question.pair(), start)),
        ("word", json!(word(wall))),
        ("cycles", json!(question.cycles())),
        ("solved_for", json!(unknown.name())),
        ("exhaustive", json!(answer.is_exhaustive)),
        ("certified", json!(true)),
        ("undecided", undecided),
    ];
    let head: Vec<String> = head.iter().map(|(key, value)| format!("\"{key}\":{value}")).collect();
    format!("{{{},\n \"orbits\":[{}]}}", head.join(",\n "), lines(&orbits))
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

fn lines(items: &[String]) -> String {
    if items.is_empty() { String::new() } else { format!("\n  {}", items.join(",\n  ")) }
}

fn orbit(orbit: &Orbit, unknown: &Unknown, wall: Wall) -> Value {
    let mut all = orbit_json(&orbit.measured.told_from(wall));
    all["spacing"] = json!(decimal_bounds(&orbit.spacing));
    all["sine"] = json!(orbit.sine.map(sign));
    match unknown {
        Unknown::Velocity => {}
        Unknown::Amplitude(_) => all["amplitude"] = json!(decimal_bounds(&orbit.amplitude)),
        Unknown::Gap(_) => all["gap"] = json!(decimal_bounds(&orbit.gap)),
    }
    all
}

fn sign(of: Ordering) -> &'static str {
    match of {
        Ordering::Less => "negative",
        Ordering::Equal => "zero",
        Ordering::Greater => "positive",
    }
}

/// The manifolds of one range, a point a line; `start` only names the scene.
pub fn manifolds(range: &Range<'_>, start: &Start, curves: &[Manifold]) -> String {
    let axis = range.axis;
    let curves: Vec<String> = curves
        .iter()
        .map(|curve| {
            let points: Vec<String> = curve.points.iter().map(|at| point(axis, at).to_string()).collect();
            format!("{{\"cycles\":{},\"points\":[{}]}}", curve.cycles, lines(&points))
        })
        .collect();
    format!(
        "{{\"schema\":{},\n \"program\":{},\n \"scene\":{},\n \"over\":{},\n \"certified\":true,\n \"curves\":[{}]}}\n",
        json!(MANIFOLD_SCHEMA),
        json!(PROGRAM),
        scene(range.pair, start),
        json!(axis.name()),
        lines(&curves)
    )
}

fn point(axis: Axis, point: &Point) -> Value {
    let after = point.after.map(|Part { is_solid, is_physical, stability }| {
        let sine = sign(if is_solid { Ordering::Greater } else { Ordering::Less });
        json!({"sine": sine, "physical": is_physical, "stability": stability.name()})
    });
    let mut all = Map::new();
    all.insert(axis.name().to_owned(), json!(decimal_bounds(&point.at)));
    all.insert("amplitude".to_owned(), json!(decimal_bounds(&point.amplitude)));
    all.insert("mark".to_owned(), json!(point.mark.map(|mark| mark.name())));
    all.insert("after".to_owned(), json!(after));
    Value::Object(all)
}
