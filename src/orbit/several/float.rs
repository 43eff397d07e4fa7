//! Plain doubles, nothing proved.

// Labels: proposes throughout.

use std::sync::Arc;

#[cfg(feature = "multiprecision")]
use super::super::motion::Swinging;
use super::super::motion::{Motion, carry};
use super::super::origin::{Location, Origin};
use super::{Several, from_wall};
use crate::contact::{Contact, Undecided};
use crate::number::Ball;
use crate::pair::{Reduced, Wall};
use crate::several::{Band, Flight, Harmonics, Launch, Reach, Scan};
use crate::turns;

/// One impact after another.
#[derive(Debug)]
pub(in crate::orbit) struct FloatMotion {
    restitution: f64,
    harmonics: Harmonics<f64>,
    balls: Arc<Harmonics<Ball>>,
    band: Arc<Band>,
    next: Launch<f64>,
}

impl FloatMotion {
    pub fn new(several: &Several, pair: &Reduced<Ball>, origin: &Origin<Ball>) -> Self {
        let harmonics = Harmonics::<f64>::new(&several.spectrum, f64::MANTISSA_DIGITS);
        let (restitution, turns, phase) = (pair.restitution.mid(), several.turns, origin.phase.mid());
        let velocity = origin.velocity.mid();
        let next = match origin.place {
            Location::Wall(wall) => from_wall(wall, turns, phase, -restitution * velocity, several.is_release()),
            Location::Inside(height) => {
                Launch { wall: None, height: height.mid(), turns, phase, velocity, is_release: false }
            }
        };
        let (balls, band) = (several.harmonics.clone(), several.band.clone());
        Self { restitution, harmonics, balls, band, next }
    }
}

impl Motion for FloatMotion {
    fn next_contact(&mut self) -> Result<Contact<Ball>, Undecided> {
        let flight = Flight::new(&self.harmonics, self.next.clone(), None);
        let found = Scan::new(&flight, &flight).first(&mut Reach::new(&self.band, &self.balls));
        let found = found.map_err(|doubt| doubt.undecided(self.next.wall))?;
        let (turns, phase) = carry(found.at.turns as f64, self.next.phase + found.at.rest);
        let velocity = match found.wall {
            Wall::Left => found.centre_velocity.min(0.0),
            Wall::Right => found.centre_velocity.max(0.0),
        };
        let after = -self.restitution * velocity;
        let passed = turns::after(self.next.turns, turns).ok_or(Undecided::endless())?;
        self.next = from_wall(found.wall, passed, phase, after, false);
        let (exact, time) = (Ball::exact, found.at.time());
        Ok(Contact { wall: found.wall, turns, phase: exact(phase), time: exact(time), velocity: exact(velocity) })
    }

    #[cfg(feature = "multiprecision")]
    fn accuracy(&self) -> f64 {
        f64::INFINITY
    }
}

#[cfg(feature = "multiprecision")]
impl Swinging for FloatMotion {
    fn swing(&self) -> f64 {
        self.harmonics.sums(self.next.turns, &self.next.phase).swing
    }
}
