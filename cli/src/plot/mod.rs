//! `impact-pair plot SCENE`: the panels of the paper's figures 12-17, of certified orbits.

pub mod arguments;

use std::io::{self, IsTerminal, Write};
use std::ops::ControlFlow;

use anyhow::{Context, Result};
use impact_pair::document::{Conclusion, Event, is_certified};
use impact_pair::orbit::Orbit;
use impact_pair_plot::orbit::{Recorder, Sheet, Style, end_of};

use crate::Answer;
use crate::ending::Ending;
use crate::output::Output;
use crate::progress::{Progress, interruption};
use crate::scene;
use arguments::PlotArguments;

pub fn plot(arguments: &PlotArguments) -> Result<Answer> {
    let scene = scene::read(&arguments.scene)?;
    scene::keep(&arguments.scene, Some(&arguments.output))?;
    let settings = arguments.settings(&scene, |cycles| end_of(&scene, cycles));
    let mut orbit = Orbit::of(&scene, settings.clone()).with_context(|| scene::name(&arguments.scene))?;

    // From here on Ctrl-C keeps what is certified.
    interruption();
    let out = Output::open(Some(&arguments.output))?;
    let visible = !arguments.quiet && io::stderr().is_terminal();
    let progress = Progress::new(settings.impacts, visible);
    let mut recorder = Recorder::new(&orbit, arguments.curve_cycles());
    let mut last: Option<Event> = None;
    let _ = orbit.follow(&progress, |orbit, step| {
        recorder.record(orbit, &step);
        let index = last.as_ref().map_or(0, |event| event.index);
        last = Event::of(orbit, &step, index).or(last.take());
        ControlFlow::<()>::Continue(())
    });
    progress.clear();
    let impacts = last.as_ref().map_or(0, |event| event.index);
    let conclusion = Conclusion::of(&orbit, scene.start(), last.as_ref());
    let ending = Ending::of(&orbit, conclusion, &settings);
    let trace = recorder.finish(&orbit, &settings, impacts);
    let style = Style { is_certified: is_certified(settings.arithmetic), transient: arguments.transient };
    let sheet = Sheet {
        scene: &scene,
        trace: &trace,
        panels: arguments.panels(),
        cycles: arguments.cycles,
        orbit_cycles: arguments.orbit_cycles,
        zoom: arguments.zoom,
        style,
        verdict: ending.to_string(),
    };
    out.draw(&arguments.output, || Ok(arguments.theme.of(&sheet.svg()?)))?;
    if !arguments.quiet {
        // Nobody may be listening.
        let _ = writeln!(io::stderr(), "{ending}");
    }
    Ok(if ending.is_complete() { Answer::Complete } else { Answer::Incomplete })
}
