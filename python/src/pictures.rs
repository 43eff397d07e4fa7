//! Pictures as the command line draws them.

use impact_pair::orbit::Orbit;
use impact_pair_plot::orbit::{Caption, Figure, Panel};
use impact_pair_plot::picture::Look;
use pyo3::prelude::*;

use crate::errors::{Fault, accepted};
use crate::orbit::read_run;
use crate::scene::Scene;
use crate::watched::watched;

/// The letter, title and quantities on the axes of a panel.
type PanelCaption = (char, &'static str, [&'static str; 2]);

/// The captions of all panels, in the order of the paper.
pub fn captions() -> [PanelCaption; 8] {
    Panel::ALL.map(|panel| {
        let Caption { letter, title, quantities, .. } = panel.caption();
        (letter, title, quantities)
    })
}

/// The panels of a scene as SVG, whether all that is drawn is certified, whether Ctrl-C ended the orbit, and how it ended.
#[pyfunction]
pub fn plot(
    py: Python<'_>,
    scene: &Bound<'_, Scene>,
    panels: &str,
    cycles: (u32, u32),
    options: &str,
    progress: Option<Py<PyAny>>,
) -> PyResult<(String, bool, bool, String)> {
    let scene = scene.get().scene.clone();
    let panel = |letter: char| Panel::ALL.into_iter().find(|panel| panel.caption().letter == letter);
    let found: Option<Vec<Panel>> = panels.chars().map(panel).collect();
    let found = found.filter(|found| !found.is_empty());
    let panels =
        found.ok_or_else(|| Fault::range("panels", format!("{panels:?}"), "must be some of a, b, c, d, e, f, g, h"))?;
    let figure = Figure {
        panels,
        cycles: accepted("cycles", cycles.0, 1..=10_000)?,
        orbit_cycles: accepted("orbit_cycles", cycles.1, 1..=10_000)?,
        transient: 0,
        zoom: None,
        run: read_run(options)?,
        look: Look::default(),
    };
    watched(py, progress, move |monitor| {
        let settings = figure.settings(&scene);
        let orbit = Orbit::of(&scene, settings.clone())?;
        let (svg, status) = figure.draw(&scene, (orbit, &settings), monitor);
        Ok((svg.map_err(Fault::other)?, status.is_complete(), monitor.is_stopped(), status.in_python()))
    })
}
