//! Attracting periodic motions of a global analysis, also those in components of which nothing else is decided (Lemma A14), against true motions:
//! their least periods, what a period contracts by, and that each is listed once.

use impact_pair::Error;
use impact_pair::chaos::{Global, GlobalSettings};
use impact_pair::periodic::Precision;
use impact_pair::watch::Unwatched;
use impact_pair_truth::{Wall, float};
use rug::Float;
use rug::float::Constant;
use serde_json::{Value, json};

use super::members::{Bounds, Member};
use super::motion::{Compared, Halt, wrong};
use super::orbits::{self, ClaimedState, apart, speed};
use super::questions::Answer;
use super::scenes::Case;

/// States that are nearer are one, in radians and speeds of the box: bounds of `10^-9`.
const SAME_STATE_DISTANCE: f64 = 1e-6;
/// Error allowed in a spectral radius by differences of true motions, of an orbit with such bounds.
const RADIUS_TOLERANCE: f64 = 1e-3;

impl Case {
    /// Asks for a global analysis by so few boxes that the components of attractors stay undecided.
    pub fn attractors(&mut self) -> Result<Answer, Error> {
        self.keep_one_harmonic();
        let settings = GlobalSettings {
            boxes: 1 << 8,
            halvings: self.random.pick(&[0, 1, 3]),
            most: 2_000,
            work: 1 << 20,
            precision: Precision { digits: 9, max_bits: 512 },
            ..GlobalSettings::default()
        };
        let found = Global::of(self.scene.pair(), &settings, &Unwatched)?;
        Ok(Answer::Global(json!(found.document(&self.scene, &settings)?)))
    }
}

/// The components with a periodic motion that attracts, each with its place.
fn attracting(document: &Value) -> Vec<(usize, &Value)> {
    let listed = document["components"].as_array().map_or(&[][..], Vec::as_slice);
    listed.iter().enumerate().filter(|(_, own)| own["kind"] == "attracting").collect()
}

/// Whether a component lies in a component of which nothing else is decided: such a component has no boxes of its own.
fn is_within(own: &Value) -> bool {
    own["boxes"] == 0
}

/// The states of a period of the reduced map: phases and speeds, mirrored to the left wall.
fn states(member: &Member, expected: &[ClaimedState]) -> Vec<[Float; 2]> {
    let pi = float(Constant::Pi);
    let state = |expected: &ClaimedState| {
        let lead = float(&pi * u32::from(expected.wall == Wall::Right));
        [float(&expected.phase + &lead), float(expected.velocity.abs_ref()) / float(speed(&member.tones))]
    };
    expected.iter().map(state).collect()
}

fn is_one([phase, speed]: &[Float; 2], [other, its_speed]: &[Float; 2]) -> bool {
    apart(phase, other) < SAME_STATE_DISTANCE && float(speed - its_speed).to_f64().abs() < SAME_STATE_DISTANCE
}

/// The reduced map has the same state again after as many impacts as are claimed, and not after fewer.
fn repeats(states: &[[Float; 2]], reduced: usize) -> bool {
    let count = states.len();
    let is_again = |n: usize| (0..count).all(|i| is_one(&states[i], &states[(i + n) % count]));
    reduced > 0 && count.is_multiple_of(reduced) && is_again(reduced) && !(1..reduced).any(is_again)
}

/// The greatest modulus of the eigenvalues of a period of the reduced map, of which the orbit has `rounds`.
fn radius([trace, determinant]: [f64; 2], rounds: usize) -> f64 {
    let under = 0.25 * trace * trace - determinant;
    let modulus = if under > 0.0 { 0.5 * trace.abs() + under.sqrt() } else { determinant.abs().sqrt() };
    modulus.powf(1.0 / rounds as f64)
}

/// Each attracting motion contracts as is claimed, has the claimed least period, and is listed once; one within an undecided component is reached from
/// that one alone.
pub fn judge(document: &Value, member: &Member) -> Compared<()> {
    let mut known: Vec<Vec<[Float; 2]>> = Vec::new();
    for (place, own) in attracting(document) {
        let Some(expected) = orbits::impacts(&own["orbit"]) else {
            return wrong("an attracting motion without impacts".into());
        };
        let states = states(member, &expected);
        let reduced = own["reduced_impacts"].as_u64().unwrap_or(0) as usize;
        if !repeats(&states, reduced) {
            return wrong(format!("{reduced} is not the least period of the reduced map: {}", own["orbit"]["impacts"]));
        }
        let found = radius(orbits::trace_and_determinant(&own["orbit"], member)?, states.len() / reduced);
        let Some(Bounds(low, high)) = Bounds::read(&own["spectral_radius"]) else {
            return Err(Halt::Open("no spectral radius"));
        };
        if !(low.to_f64() - RADIUS_TOLERANCE..high.to_f64() + RADIUS_TOLERANCE).contains(&found) || found >= 1.0 {
            return wrong(format!("the spectral radius is {found}, but {} is claimed", own["spectral_radius"]));
        }
        if known.iter().flatten().any(|state| is_one(state, &states[0])) {
            return wrong(format!("component {place} is listed twice"));
        }
        known.push(states);
        let order = document["order"].as_array().map_or(&[][..], Vec::as_slice);
        let from: Vec<&Value> = order.iter().filter(|pair| pair[1] == place).map(|pair| &pair[0]).collect();
        let kind = |from: &Value| &document["components"][from.as_u64().unwrap_or(u64::MAX) as usize]["kind"];
        if is_within(own) && !matches!(from[..], [from] if kind(from) == "undecided") {
            return wrong(format!("component {place} is in no undecided one"));
        }
    }
    Ok(())
}

/// The attractors proved within an undecided component, in words; `None` without any.
pub fn outcome(document: &Value) -> Option<&'static str> {
    let within: Vec<&Value> =
        attracting(document).into_iter().map(|(_, own)| own).filter(|own| is_within(own)).collect();
    let is_long = |own: &&Value| own["reduced_impacts"].as_u64() > Some(1);
    match (within.is_empty(), within.iter().any(is_long)) {
        (true, _) => None,
        (_, true) => Some("global: an attractor of some impacts in an undecided component"),
        _ => Some("global: an attractor of one impact in an undecided component"),
    }
}
