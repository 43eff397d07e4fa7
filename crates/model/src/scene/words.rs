//! A scene in words, for people.

use super::Scene;
use crate::excitation::Harmonic;
use crate::start::Place;

impl Scene {
    /// Returns the parameters in the words of the scene.
    pub fn parameters_in_words(&self) -> String {
        let pair = self.pair();
        let [amplitude, frequency, phase] = [Harmonic::amplitude, Harmonic::frequency, Harmonic::phase].map(|of| {
            let terms: Vec<String> = pair.excitation().terms().iter().map(|term| of(term).to_string()).collect();
            if terms.len() == 1 { terms.concat() } else { format!("({})", terms.join(", ")) }
        });
        let (gap, restitution) = (pair.gap(), pair.restitution());
        format!("A = {amplitude}, W = {frequency}, tau = {phase}, d = {gap}, e = {restitution}")
    }

    /// Returns the start in the words of the scene.
    pub fn start_in_words(&self) -> String {
        let (time, velocity) = (self.start().time(), self.start().velocity());
        match self.start().place() {
            Place::Wall(wall) => format!("start: t = {time}, {} wall, v = {velocity}", wall.name()),
            Place::Inside(position) => format!("start: t = {time}, y = {position}, y' = {velocity}"),
        }
    }
}
