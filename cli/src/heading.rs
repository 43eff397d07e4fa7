//! What a table for people begins with: whose orbit it is.

use std::io::{self, Write};

use impact_pair::Scene;

/// Writes the title, the parameters and the start, a line each.
pub fn write(out: &mut impl Write, scene: &Scene) -> io::Result<()> {
    if let Some(title) = scene.title() {
        writeln!(out, "{title}")?;
    }
    writeln!(out, "{}\n{}", scene.parameters_in_words(), scene.start_in_words())
}
