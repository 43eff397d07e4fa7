//! The reduced map of a scene, and the first states of its orbit.

use super::law::Law;
use super::quad::State;
use crate::Error;
use crate::number::{Ball, Number};
use crate::orbit::{Impact, Orbit, Place, Settings, Start};
use crate::pair::{ImpactPair, Reduced, Wall, within};
use crate::units::{self, Phases, Units};

/// The name of the map in messages.
const MAP_NAME: &str = "the reduced impact map";
/// Impacts of the scene's own orbit that are looked at.
pub(super) const ORBIT_IMPACTS: u64 = 100;

impl Law {
    /// The law of a pair with one harmonic.
    ///
    /// # Errors
    /// With several harmonics, where the amplitude may be 0: lengths are in amplitudes, and if `A/d` is beyond `2^400`.
    pub fn of(pair: &ImpactPair) -> Result<Self, Error> {
        let harmonic = pair.harmonic(MAP_NAME)?;
        Error::require_positive("excitation.amplitude", harmonic.amplitude())?;
        Reduced::exact(pair)?.enclosed()?;
        Ok(Self { gap: Ball::of(&units::ratio(pair)?), restitution: Ball::of(pair.restitution()) })
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
    /// A state in the enclosure, near its middle.
    pub fn middle(&self) -> State {
        [self.phase.mid(), self.speed.mid().abs()]
    }
}

/// The start of an orbit and its first `impacts` impacts, each mirrored to the left wall: certified.
pub(super) fn visited(pair: &ImpactPair, start: &Start, impacts: u64) -> Result<Vec<Visited>, Error> {
    let harmonic = pair.harmonic(MAP_NAME)?;
    let mut found = Vec::new();
    if let Place::Wall(wall) = start.place() {
        let phase = within("start.time", start.time(), Phases::of(harmonic)?.at(start.time()))?;
        let speed = start.velocity().checked_div(&Units::amplitudes(harmonic)?.velocity);
        let speed = within("start.velocity", start.velocity(), speed)?;
        found.push(mirrored(0, *wall, Ball::of(&phase), Ball::of(&speed)));
    }
    let settings = Settings { impacts: Some(impacts), ..Settings::default() };
    let fastest = Ball::of(&Reduced::exact(pair)?.beta);
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
