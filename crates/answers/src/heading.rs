//! The first lines of a table: title, parameters and start of the scene.

use impact_pair::Scene;

/// The title, the parameters and the start, a line each.
pub fn heading(scene: &Scene) -> String {
    format!("{}{}\n", pair_heading(scene), scene.start().in_words())
}

/// The title and the parameters, a line each.
pub fn pair_heading(scene: &Scene) -> String {
    let title = scene.title().map(|title| format!("{title}\n")).unwrap_or_default();
    format!("{title}{}\n", scene.pair().in_words())
}
