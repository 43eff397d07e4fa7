//! The description of a motion: its fate, exponent and region, by the verb `describe`.

use impact_pair::chaos::MOST_DEPTH;
use impact_pair::describe::{Request, describe as described, lines};
use impact_pair::json::{self, DescriptionDocument};
use impact_pair::orbit::BITS;
use impact_pair_plot::picture::Look;
use pyo3::prelude::*;

use crate::errors::{Fault, accepted};
use crate::pictures::drawn;
use crate::scene::Scene;
use crate::verbs::{Drawn, text};
use crate::watched::watched;

/// The description of a scene, whose commands name it by a path; with its picture if requested.
#[pyfunction]
pub fn describe(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    name: String,
    question: (u64, u32, u32, bool),
    progress: Option<Py<PyAny>>,
) -> PyResult<Drawn> {
    let (impacts, depth, max_bits, picture) = question;
    let scene = scene.get().scene.clone();
    watched(py, progress, move |monitor| {
        let impacts = accepted("impacts", impacts, 1..=100_000_000)?;
        let depth = accepted("depth", depth, 1..=MOST_DEPTH)? as usize;
        let request = Request { impacts, depth, max_bits: accepted("max_bits", max_bits, BITS)? };
        let found = described(&scene, &request, monitor)?;
        let document = found.document(&scene, &name)?;
        let svg = || drawn(impact_pair_plot::describe::describe(&scene, &found, &document, &Look::default()));
        let svg = picture.then(svg).transpose()?;
        Ok((text(&document), document.certified && !document.interrupted, document.interrupted, svg))
    })
}

/// The lines of a description in words, each with its label.
#[pyfunction]
pub fn description_lines(document: &str) -> PyResult<Vec<(&'static str, String)>> {
    let document: DescriptionDocument = json::read(document).map_err(Fault::from)?;
    Ok(lines(&document))
}
