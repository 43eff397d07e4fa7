//! `impact-pair plot SCENE`: the panels of the paper's figures 12-17, of certified orbits.

pub mod arguments;

use std::io::{self, IsTerminal, Write};

use anyhow::{Context, Result};
use impact_pair::orbit::Orbit;

use crate::Answer;
use crate::output::Output;
use crate::progress::{Progress, catch_interruption};
use crate::scene;
use arguments::PlotArguments;

pub fn plot(arguments: &PlotArguments) -> Result<Answer> {
    let scene = scene::read(&arguments.scene)?;
    scene::keep(&arguments.scene, Some(&arguments.output))?;
    let figure = arguments.figure();
    let settings = figure.settings(&scene);
    let orbit = Orbit::of(&scene, settings.clone()).with_context(|| scene::name(&arguments.scene))?;

    // From here on Ctrl-C keeps what is certified.
    catch_interruption();
    let out = Output::open(Some(&arguments.output))?;
    let visible = !arguments.quiet && io::stderr().is_terminal();
    let progress = Progress::new(settings.impacts, visible);
    let (svg, ending) = figure.draw(&scene, (orbit, &settings), &progress);
    progress.clear();
    out.draw(&arguments.output, arguments.theme, || svg)?;
    if !arguments.quiet {
        // Nobody may be listening.
        let _ = writeln!(io::stderr(), "{ending}");
    }
    Ok(if ending.is_complete() { Answer::Complete } else { Answer::Incomplete })
}
