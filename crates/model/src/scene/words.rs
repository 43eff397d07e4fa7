//! Pairs and starts in words.

use crate::excitation::Harmonic;
use crate::pair::ImpactPair;
use crate::start::{Place, Start};

impl ImpactPair {
    /// Writes the parameters in the letters of the paper: `A = 8, W = pi, tau = 0, d = 9.42497, e = 0.5`.
    pub fn in_words(&self) -> String {
        let [amplitude, frequency, phase] = [Harmonic::amplitude, Harmonic::frequency, Harmonic::phase].map(|of| {
            let terms: Vec<String> = self.excitation().terms().iter().map(|term| of(term).to_string()).collect();
            if terms.len() == 1 { terms.concat() } else { format!("({})", terms.join(", ")) }
        });
        let (gap, restitution) = (self.gap(), self.restitution());
        format!("A = {amplitude}, W = {frequency}, tau = {phase}, d = {gap}, e = {restitution}")
    }
}

impl Start {
    /// Writes time, place and velocity: `start: t = 0, left wall, v = -12.56636`.
    pub fn in_words(&self) -> String {
        let (time, velocity) = (self.time(), self.velocity());
        match self.place() {
            Place::Wall(wall) => format!("start: t = {time}, {} wall, v = {velocity}", wall.name()),
            Place::Inside(position) => format!("start: t = {time}, y = {position}, y' = {velocity}"),
        }
    }
}
