//! `impact-pair plot SCENE`: the panels of the paper's figures 12-17, of certified orbits.

pub mod arguments;

use std::io::{self, IsTerminal};

use anyhow::Result;
use impact_pair::orbit::Orbit;

use crate::Answer;
use crate::destination::{Files, OpenOutput};
use crate::output::note;
use crate::progress::Progress;
use crate::scene;
use arguments::PlotArguments;

pub fn plot(arguments: &PlotArguments) -> Result<Answer> {
    let OpenOutput { scene, files: Files { out, quiet, .. }, path } =
        arguments.destination().begin(&arguments.scene, None)?;
    let figure = arguments.figure();
    let settings = figure.settings(&scene);
    let orbit = Orbit::of(&scene, settings.clone()).map_err(|error| scene::of_orbit(error, &settings, path))?;
    let visible = !quiet && io::stderr().is_terminal();
    let progress = Progress::new(settings.impacts, visible);
    let (svg, status) = figure.draw(&scene, (orbit, &settings), &progress);
    progress.clear();
    out.draw(&arguments.output, &arguments.look, svg)?;
    note(quiet, &status.to_string());
    Ok(if status.is_complete() { Answer::Complete } else { Answer::Incomplete })
}
