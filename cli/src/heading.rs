//! What a table for people begins with: whose orbit it is.

use std::io::{self, Write};

use impact_pair::orbit::Place;
use impact_pair::{Harmonic, Scene};

/// Writes the title, the parameters and the start, a line each.
pub fn write(out: &mut impl Write, scene: &Scene) -> io::Result<()> {
    if let Some(title) = scene.title() {
        writeln!(out, "{title}")?;
    }
    writeln!(out, "{}\n{}", parameters(scene), start(scene))
}

/// The parameters in the words of the scene.
pub fn parameters(scene: &Scene) -> String {
    let pair = scene.pair();
    let [amplitude, frequency, phase] = [Harmonic::amplitude, Harmonic::frequency, Harmonic::phase].map(|of| {
        let terms: Vec<String> = pair.excitation().terms().iter().map(|term| of(term).to_string()).collect();
        if terms.len() == 1 { terms.concat() } else { format!("({})", terms.join(", ")) }
    });
    let (gap, restitution) = (pair.gap(), pair.restitution());
    format!("A = {amplitude}, W = {frequency}, tau = {phase}, d = {gap}, e = {restitution}")
}

/// The start in the words of the scene.
pub fn start(scene: &Scene) -> String {
    let (time, velocity) = (scene.start().time(), scene.start().velocity());
    match scene.start().place() {
        Place::Wall(wall) => format!("start: t = {time}, {} wall, v = {velocity}", wall.name()),
        Place::Inside(position) => format!("start: t = {time}, y = {position}, y' = {velocity}"),
    }
}
