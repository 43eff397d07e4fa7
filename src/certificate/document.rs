//! The orbit JSON: whose orbit it is, what certifies it, how it ended, and its events.

use std::io::{self, Write};

use serde_json::{Map, Value, json};

use super::conclusion::Conclusion;
use super::event::Event;
use crate::exact::Exact;
use crate::excitation::Harmonic;
use crate::orbit::{Arithmetic, Orbit, Place, Settings, Start};
use crate::pair::ImpactPair;

/// The schema of the orbit JSON.
pub const ORBIT_SCHEMA: &str = "impact-pair/orbit/1";
/// The program that certifies.
pub const PROGRAM: &str = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));

/// The orbit JSON without its outcome and its events: whose orbit it is, and what certifies it.
///
/// `computed` is what [`arithmetic`] says of it when it has ended, or [`asked_arithmetic`] before.
pub fn head(pair: &ImpactPair, start: &Start, arithmetic: Arithmetic, computed: Value) -> Map<String, Value> {
    let entries = [
        ("schema", json!(ORBIT_SCHEMA)),
        ("program", json!(PROGRAM)),
        ("scene", scene(pair, start)),
        ("certified", json!(is_certified(arithmetic))),
        ("arithmetic", computed),
    ];
    entries.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
}

/// What computed an orbit: `float`, `interval` or `inari` with 53 bits, or `multiprecision` with those of its first impact.
pub fn arithmetic(orbit: &Orbit) -> Value {
    let kind = match (orbit.arithmetic(), orbit.bits()) {
        (Arithmetic::Float, _) => "float",
        (Arithmetic::Inari, _) => "inari",
        (_, f64::MANTISSA_DIGITS) => "interval",
        _ => "multiprecision",
    };
    json!({"kind": kind, "bits": orbit.bits()})
}

/// The same before the orbit is computed: `auto` does not know yet.
pub fn asked_arithmetic(settings: &Settings) -> Value {
    match settings.arithmetic {
        Arithmetic::Auto => json!({"kind": "auto", "max_bits": settings.max_bits}),
        Arithmetic::Float => json!({"kind": "float", "bits": f64::MANTISSA_DIGITS}),
        Arithmetic::Interval => json!({"kind": "interval", "bits": f64::MANTISSA_DIGITS}),
        Arithmetic::Inari => json!({"kind": "inari", "bits": f64::MANTISSA_DIGITS}),
        Arithmetic::Bits(bits) => json!({"kind": "multiprecision", "bits": bits}),
    }
}

/// The exact parameters and initial data, each in its own words.
pub fn scene(pair: &ImpactPair, start: &Start) -> Value {
    let of_terms = |of: fn(&Harmonic) -> &Exact| -> Vec<String> {
        pair.excitation().terms().iter().map(|term| of(term).text()).collect()
    };
    let [amplitude, frequency, phase] = [Harmonic::amplitude, Harmonic::frequency, Harmonic::phase].map(of_terms);
    let (place, at) = match start.place() {
        Place::Wall(wall) => ("wall", wall.name().to_owned()),
        Place::Inside(position) => ("position", position.text()),
    };
    json!({
        "excitation": {"amplitude": amplitude, "frequency": frequency, "phase": phase},
        "gap": pair.gap().text(),
        "restitution": pair.restitution().text(),
        "start": {"time": start.time().text(), place: at, "velocity": start.velocity().text()},
    })
}

/// Whether the arithmetic proves what it computes.
pub fn is_certified(arithmetic: Arithmetic) -> bool {
    match arithmetic {
        Arithmetic::Float => false,
        Arithmetic::Auto | Arithmetic::Interval | Arithmetic::Inari | Arithmetic::Bits(_) => true,
    }
}

/// Writes the orbit JSON, an event a line.
///
/// # Errors
/// Those of `out`.
pub fn write_json(
    out: &mut impl Write,
    head: &Map<String, Value>,
    conclusion: &Conclusion,
    events: &[Event],
) -> io::Result<()> {
    out.write_all(b"{")?;
    for (key, value) in head {
        writeln!(out, "{}:{value},", json!(key))?;
        out.write_all(b" ")?;
    }
    write!(out, "\"outcome\":{},\n \"events\":[", conclusion.json())?;
    for (i, event) in events.iter().enumerate() {
        write!(out, "{}\n  {event}", if i == 0 { "" } else { "," })?;
    }
    out.write_all(b"]}\n")
}
