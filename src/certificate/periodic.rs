//! The periodic JSON: proved periodic orbits in the units of the scene.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::ToPrimitive;
use serde_json::{Map, Value, json};

use super::document::scene;
use crate::error::Error;
use crate::exact::{Enclosure, Exact, decimal_bounds};
use crate::mapping::Word;
use crate::orbit::Start;
use crate::pair::{ImpactPair, within};
use crate::periodic::{Census, Eigenvalue, MeasuredImpact, MeasuredOrbit, PeriodicImpact, PeriodicOrbit};

/// The schema of the periodic JSON.
pub const PERIODIC_SCHEMA: &str = "impact-pair/periodic/1";

/// Periodic orbits of a word as they are handed on.
#[derive(Clone, Debug)]
pub struct PeriodicDocument<'d> {
    pair: &'d ImpactPair,
    start: &'d Start,
    word: &'d Word,
    cycles: u32,
    /// `W d / (2 pi)`
    speed: Exact,
}

impl<'d> PeriodicDocument<'d> {
    /// A document about a word of `pair`; `start` only names the scene.
    ///
    /// # Errors
    /// When `W d` is beyond what exact expressions hold.
    pub fn new(pair: &'d ImpactPair, start: &'d Start, word: &'d Word, cycles: u32) -> Result<Self, Error> {
        let turn = Exact::pi() * Exact::from(2);
        let speed = pair
            .excitation()
            .reference()
            .frequency()
            .checked_mul(pair.gap())
            .and_then(|speed| speed.checked_div(&turn));
        Ok(Self { pair, start, word, cycles, speed: within("pair.gap", pair.gap(), speed)? })
    }

    /// An orbit in the units of the scene.
    pub fn measured(&self, orbit: &PeriodicOrbit) -> MeasuredOrbit {
        measured(orbit, |velocity| self.velocity(velocity, orbit.bits))
    }

    /// A velocity \[length/time\] given in gaps a turn.
    pub fn velocity(&self, velocity: &Enclosure, bits: u32) -> Enclosure {
        velocity.mul(&self.speed.enclose(bits + 64), bits + 64)
    }

    /// The document of what is found.
    pub fn json(&self, census: &Census) -> Value {
        let mut entries = vec![
            ("schema", json!(PERIODIC_SCHEMA)),
            ("scene", scene(self.pair, self.start)),
            ("word", json!(self.word.to_string())),
            ("cycles", json!(self.cycles)),
            ("exhaustive", json!(census.exhaustive)),
            ("certified", json!(census.is_certified())),
            ("orbits", census.orbits.iter().map(|orbit| orbit_json(&self.measured(orbit))).collect()),
        ];
        if !census.undecided.is_empty() {
            let region = |region: &crate::periodic::Region| {
                let impacts = region.impacts.iter().map(|impact| self.impact(impact, f64::MANTISSA_DIGITS));
                json!({"impacts": impacts.collect::<Value>(), "reason": region.reason.name()})
            };
            entries.push(("undecided", census.undecided.iter().map(region).collect()));
        }
        Value::Object(entries.into_iter().map(|(key, value)| (key.to_owned(), value)).collect::<Map<_, _>>())
    }

    /// An impact of a search or of a bifurcation: under one harmonic.
    pub(super) fn impact(&self, impact: &PeriodicImpact, bits: u32) -> Value {
        impact_json(&measured_impact(impact, (bits, 1), |velocity| self.velocity(velocity, bits)), 1)
    }
}

/// An orbit in the units that `velocity` turns gaps a turn into.
pub(super) fn measured(orbit: &PeriodicOrbit, velocity: impl Fn(&Enclosure) -> Enclosure) -> MeasuredOrbit {
    let impact = |impact: &PeriodicImpact| measured_impact(impact, (orbit.bits, orbit.period), &velocity);
    MeasuredOrbit {
        period: orbit.period,
        impacts: orbit.impacts.iter().map(impact).collect(),
        // A box that is not proved to hold exactly one orbit is not listed.
        unique: true,
        physical: orbit.physical,
        symmetric: orbit.symmetric,
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
) -> MeasuredImpact {
    MeasuredImpact {
        wall: impact.wall,
        phase: phase_in_radians(&impact.phase, bits),
        turn: turn(&impact.phase, period),
        velocity: velocity(&impact.velocity),
    }
}

/// The phase `W t + tau` \[rad\] of one in turns, its lower bound in `[0, 2 pi)`.
pub(crate) fn phase_in_radians(turns: &Enclosure, bits: u32) -> Enclosure {
    let bits = bits + 64;
    let whole = Enclosure::from_rational(&turns.lo().to_rational().floor(), bits);
    let two_pi = Enclosure::pi(bits).add(&Enclosure::pi(bits), bits);
    turns.sub(&whole, bits).mul(&two_pi, bits)
}

/// The turn of the fastest harmonic, less whole common periods of so many, that the phase is told from.
fn turn(turns: &Enclosure, period: u32) -> u32 {
    let turn = turns.lo().to_rational().floor().to_integer().mod_floor(&BigInt::from(period));
    turn.to_u32().expect("less than the period")
}

fn impact_json(impact: &MeasuredImpact, period: u32) -> Value {
    let mut json = json!({
        "wall": impact.wall.name(),
        "phase": decimal_bounds(&impact.phase),
        "velocity": decimal_bounds(&impact.velocity),
    });
    if period > 1 {
        json["turn"] = json!(impact.turn);
    }
    json
}

/// An entry of `orbits`.
pub(crate) fn orbit_json(orbit: &MeasuredOrbit) -> Value {
    let eigenvalue = |value: &Eigenvalue| json!({"re": decimal_bounds(&value.re), "im": decimal_bounds(&value.im)});
    let impact = |impact: &MeasuredImpact| impact_json(impact, orbit.period);
    json!({
        "impacts": orbit.impacts.iter().map(impact).collect::<Value>(),
        "unique": orbit.unique,
        "physical": orbit.physical,
        "symmetric": orbit.symmetric,
        "trace": decimal_bounds(&orbit.trace),
        "determinant": decimal_bounds(&orbit.determinant),
        "eigenvalues": orbit.eigenvalues.iter().map(eigenvalue).collect::<Value>(),
        "stability": orbit.stability.name(),
    })
}
