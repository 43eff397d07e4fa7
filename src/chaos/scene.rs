//! From a scene to the reduced map, and to the first states of its orbit.

use super::law::Law;
use super::quad::State;
use crate::Error;
use crate::exact::Exact;
use crate::number::{Ball, Number};
use crate::orbit::{Impact, Orbit, Place, Settings, Start};
use crate::pair::{ImpactPair, Wall, within};

/// What a region or a horseshoe is about.
const WHAT: &str = "the reduced impact map";
const RATIO: &str = "pair.gap / excitation.amplitude";
/// Impacts of the scene's own orbit that are looked at.
pub(super) const IMPACTS: u64 = 100;

impl Law {
    /// That of a pair with one harmonic.
    ///
    /// # Errors
    /// With several harmonics, and where the amplitude may be 0: lengths are in amplitudes.
    pub fn of(pair: &ImpactPair) -> Result<Self, Error> {
        let harmonic = pair.harmonic(WHAT)?;
        Error::require_positive("excitation.amplitude", harmonic.amplitude())?;
        let gap = within(RATIO, pair.gap(), pair.gap().checked_div(harmonic.amplitude()))?;
        let (gap, restitution) = (Ball::of(&gap), Ball::of(pair.restitution()));
        Ok(Self { gap, restitution })
    }
}

/// A state of the orbit, enclosed; its index is 0 at the start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Visited {
    pub index: u64,
    pub wall: Wall,
    pub phase: Ball,
    pub speed: Ball,
}

impl Visited {
    /// Some state in it, about the middle.
    pub fn middle(&self) -> State {
        [self.phase.mid(), self.speed.mid().abs()]
    }
}

/// The start of an orbit and its first impacts, N, each mirrored to the left wall: certified.
pub(super) fn visited(pair: &ImpactPair, start: &Start, impacts: u64) -> Result<Vec<Visited>, Error> {
    let harmonic = pair.harmonic(WHAT)?;
    let mut found = Vec::new();
    if let Place::Wall(wall) = start.place() {
        let turn = Exact::pi() * Exact::from(2);
        let phase = harmonic.frequency().checked_mul(start.time()).and_then(|x| x.checked_add(harmonic.phase()));
        let phase = within("start.time", start.time(), phase.and_then(|x| x.checked_div(&turn)))?;
        let fastest = harmonic.amplitude().checked_mul(harmonic.frequency());
        let speed = fastest.and_then(|fastest| start.velocity().checked_div(&fastest));
        let speed = Ball::of(&within("start.velocity", start.velocity(), speed)?);
        found.push(mirrored(0, *wall, Ball::of(&phase), speed));
    }
    let settings = Settings { impacts: Some(impacts), ..Settings::default() };
    let fastest = Ball::of(&within(RATIO, harmonic.amplitude(), harmonic.amplitude().checked_div(pair.gap()))?);
    let fastest = fastest.turn() * fastest;
    for Impact { index, wall, phase, velocity, .. } in Orbit::new(pair, start, settings)? {
        let Some(speed) = velocity.checked_div(fastest) else { break };
        found.push(mirrored(index, wall, phase, speed));
    }
    Ok(found)
}

fn mirrored(index: u64, wall: Wall, phase: Ball, velocity: Ball) -> Visited {
    match wall {
        Wall::Left => Visited { index, wall, phase, speed: -velocity },
        Wall::Right => Visited { index, wall, phase: phase + Ball::exact(0.5), speed: velocity },
    }
}
